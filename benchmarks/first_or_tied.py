"""Is the law that made the data first, or tied with the first; do its parameters lie within three printed errors?

    python benchmarks/first_or_tied.py [draws]

Each draw: a single-lobe law over a body, or a metal, with random parameters; three angles in the plane of incidence or
600 directions over the hemisphere; 0.5, 3 or 10 % of noise; one channel; the default candidates, those that grow too.
*Factor*: error against the noise-free truth of the recommended model over that of the least of all rows, median.
"""

import os
import sys
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

import brdfguide
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.residuals import ln_residuals
from brdfguide.models import candidates
from tests import synthetic

NAMES = (
    "lambertian+ggx",
    "lambertian+beckmann",
    "lambertian+cook-torrance",
    "lambertian+ward",
    "lambertian+blinn",
    "ggx (metal)",
    "beckmann (metal)",
)
NOISES = (0.005, 0.03, 0.10)


def draw(seed: int):
    """Name, values, measurement and noise-free values of one draw."""
    random = np.random.default_rng(seed)
    name = NAMES[seed % len(NAMES)]
    model = candidates.named(name)
    values = synthetic.random_values(Layout(model, 1), random)
    values |= {key: random.uniform(0.08, 0.5) for key in values if key.endswith(".alpha")}
    geom = synthetic.scan((10, 45, 70)) if random.uniform() < 0.5 else synthetic.hemisphere(600, seed)
    noise = NOISES[random.integers(3)]
    return (
        name,
        values,
        synthetic.surface(model, geom, values, noise=noise, seed=seed),
        synthetic.surface(model, geom, values),
    )


def main(draws: int) -> None:
    first, within, factors, missed = 0, [], [], []
    for seed in range(draws):
        name, values, data, truth = draw(seed)
        kind = "metal" if "metal" in name else "dielectric"
        answer = brdfguide.fit(data, kind=kind, close="none", anyway=True, timing=False)
        row = next((row for row in answer.rows if row.fit.name == name), None)
        tied = row is not None and row.tied
        first += tied
        if not tied:
            missed.append(f"{seed}: {name}, first {answer.rows[0].fit.name}")
        if row is not None:
            fit = row.fit
            for key, error in fit.stderr.items():
                if not (fit.has("undetermined", key) or fit.has("at-bound", key) or fit.has("ridge")):
                    within += list(np.ravel(np.abs(fit.values[key] - values[key]) < 3 * np.asarray(error)))
        off = [_off(each.fit, truth) for each in answer.rows]
        factors.append(_off(answer.recommended, truth) / max(min(off), 1e-12))
    print(f"{draws} draws: first or tied {first / draws:.1%}; parameters within three errors {np.mean(within):.1%}")
    print(f"recommended over nearest to the truth, median factor {np.median(factors):.2f}")
    print("\n".join(missed))


def _off(fit, truth) -> float:
    left = ln_residuals(fit.surface, truth)
    return float(np.sqrt(np.nanmean(left**2)))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 250)
