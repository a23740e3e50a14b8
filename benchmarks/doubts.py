"""Is a wrong law accused and a right one not; is a difference between two fits as uncertain as printed?

Under drift (2 % of gain for each scan, an arm's zero 0.2 degrees off, both normal) the instrument is to be named in
place of the right law.

python benchmarks/doubts.py [draws]
"""

import os
import sys
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from functools import partial

import numpy as np

from benchmarks.recovery import dome, drifted
from brdfguide import models
from brdfguide.fitting import fit, ranking
from brdfguide.fitting.diagnostics import standard_errors
from brdfguide.fitting.residuals import ln_residuals
from tests import synthetic

GGX, COOK = models.get("lambertian+ggx"), models.get("lambertian+cook-torrance")
TRUTH = {**GGX.defaults(), "lambertian.albedo": 0.3, "ggx.alpha": 0.22, "ggx.n": 1.5}
OTHERS = {
    "alpha + 2 %": ("ggx.alpha", 0.225),
    "alpha + 18 %": ("ggx.alpha", 0.26),
    "n + 0.1": ("ggx.n", 1.6),
    "albedo + 2 %": ("lambertian.albedo", 0.305),
}


def surface_of(seed: int) -> dict:
    random = np.random.default_rng(seed)
    return {
        "lambertian.albedo": random.uniform(0.05, 0.6),
        "ggx.alpha": random.uniform(0.1, 0.5),
        "ggx.n": random.uniform(1.3, 2),
    }


def discrepancies(geom, channels: int, samples: int) -> tuple[int, int]:
    """How often the flag is raised on GGX data at 2 % noise: fitted with Cook-Torrance, and with GGX."""
    wrong = right = 0
    for seed in range(samples):
        data = synthetic.surface(GGX, geom, surface_of(seed), noise=0.02, seed=seed, channels=channels)
        wrong += fit.fit(COOK, data).has("discrepancy")
        right += fit.fit(GGX, data).has("discrepancy")
    return wrong, right


def under_drift(geom, channels: int, samples: int) -> tuple[int, int, int]:
    """How often, of GGX data from an instrument that drifts, the right law is accused, the instrument is named in its
    place, and the wrong law is accused all the same."""
    accused = named = wrong = 0
    for seed in range(samples):
        values = {**GGX.defaults(), **surface_of(seed)}
        data = synthetic.surface(GGX, geom, values, noise=0.02, seed=seed, channels=channels)
        data = drifted(data, partial(GGX, values=values), np.random.default_rng([seed, 77]), 0.02)
        found = fit.fit(GGX, data)
        accused += found.has("discrepancy")
        named += found.has("instrument") and not found.has("discrepancy")
        wrong += fit.fit(COOK, data).has("discrepancy")
    return accused, named, wrong


def scores(geom, key: str, value: float, samples: int) -> np.ndarray:
    """Printed difference over its printed error, of two laws on either side of the truth."""
    data = synthetic.surface(GGX, geom, TRUTH)
    blocks = standard_errors.blocks_of(data, standard_errors.along_scans(data))
    bend = ln_residuals(synthetic.fitted(GGX, {**TRUTH, key: value}, data), data)
    out = []
    for seed in range(samples):
        noise = 0.03 * np.random.default_rng([seed, 31]).standard_normal(data.brdf.shape)
        behind, error = ranking.rms_difference(noise + 0.5 * bend, noise - 0.5 * bend, blocks)
        out.append(behind / error)
    return np.array(out)


def main(samples: int) -> None:
    print(f"discrepancy raised in {samples} draws: by Cook-Torrance, by GGX itself")
    for name, geom in (("six scans", synthetic.scan()), ("600 scattered", synthetic.hemisphere(600))):
        for channels in (1, 3):
            theirs, own = discrepancies(geom, channels, samples)
            print(f"  {name:16} {channels} channels  {theirs:4} {own:4}", flush=True)
    print(f"under drift, {samples} draws: GGX itself accused, the instrument named in its place, Cook-Torrance accused")
    for name, geom in (("six scans", synthetic.scan()), ("five incidences over the hemisphere", dome())):
        for channels in (1, 3):
            print(f"  {name:36} {channels} channels  {under_drift(geom, channels, samples)}", flush=True)
    print(f"two laws equally wrong, {10 * samples} draws: mean, width and share within 2 of the printed z")
    places = {
        "scans, 4 deg": synthetic.scan(),
        "scans, 1 deg": synthetic.scan(step=1.0),
        "one scan": synthetic.scan((30,), step=2.0),
        "600 scattered": synthetic.hemisphere(600),
        "3000 scattered": synthetic.hemisphere(3000),
    }
    for name, geom in places.items():
        for title, (key, value) in OTHERS.items():
            z = scores(geom, key, value, 10 * samples)
            print(f"  {name:16} {title:14} {z.mean():+.2f}  {z.std():.2f}  {100 * np.mean(np.abs(z) < 2):.1f} %")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100)
