"""What of a metal the data tell: F0 and F at 82 degrees, and n and k, with n held at 1 and with an edge of its own.

    python benchmarks/metals.py [draws]

Each draw: a metal of Table 1's range (n 0.1 to 4, k 1.5 to 7) under GGX's facets, six scans in the plane of incidence,
one channel, 2 % of noise. *Covered*: the truth lies within 1.96 printed standard errors; *apart*: n and k are printed
beside F0 and F82.
"""

import os
import sys
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from brdfguide import models
from brdfguide.fitting import fit as fitting
from brdfguide.models import candidates
from brdfguide.physics.fresnel import fresnel
from brdfguide.report.documents.reflectances import reflectances
from tests import synthetic

LAW = models.get("ggx")
SCORES = ("F0", "F82", "n", "k")


def drawn(seed: int) -> dict[str, float]:
    random = np.random.default_rng([seed, 82])
    return {
        "ggx.alpha": float(random.uniform(0.1, 0.4)),
        "ggx.n": float(np.exp(random.uniform(np.log(0.1), np.log(4.0)))),
        "ggx.k": float(random.uniform(1.5, 7.0)),
    }


def inside(truth: dict[str, float], found, data) -> dict[str, bool]:
    """Whether each printed number's interval holds the truth."""
    told = {key.rpartition(".")[2]: entry for key, entry in reflectances(found, data).items()}
    right = {f"F{deg}": fresnel(np.cos(np.radians(deg)), truth["ggx.n"], truth["ggx.k"]) for deg in (0, 82)}
    out = {name: _holds(right[name], told[name]["value"], told[name]["stderr"]) for name in right if name in told}
    if not any(entry["in_place_of"] for entry in told.values()):
        out |= {
            name: _holds(truth[f"ggx.{name}"], found.values[f"ggx.{name}"], found.stderr[f"ggx.{name}"])
            for name in "nk"
        }
    return out


def _holds(truth, value, stderr) -> bool:
    return bool(abs(np.ravel(value)[0] - truth) < 1.96 * np.ravel(stderr)[0])


def main(draws: int) -> None:
    for label in ("ggx (metal)", "ggx (metal, edge free)"):
        scores: dict[str, list[bool]] = {name: [] for name in SCORES}
        accused, errors = 0, []
        for seed in range(draws):
            truth = drawn(seed)
            data = synthetic.surface(LAW, synthetic.scan(), truth, noise=0.02, seed=seed)
            found = fitting.fit(candidates.named(label), data)
            accused += found.has("discrepancy")
            errors.append(found.rms_ln)
            for name, holds in inside(truth, found, data).items():
                scores[name].append(holds)
        covered = ", ".join(
            f"{name} {100 * np.mean(each):.0f} % of {len(each)}" for name, each in scores.items() if each
        )
        print(
            f"{label:24} rms ln {np.median(errors):.4f} in the median, accused {accused} of {draws}; covered: {covered}"
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200)
