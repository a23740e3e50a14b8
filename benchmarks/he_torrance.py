"""What He-Torrance costs: ns per evaluation against our own ggx and against a plain sum of 40 terms, in turns in one
run.

    python benchmarks/he_torrance.py [seconds [directions]]

One thread, float64, arrays of 1e5 directions, or of as many as are told, spread at random over the hemisphere, all
different; the geometry is kept between calls, as in a fit, where only the parameters change. The least processor time
of all turns counts.
"""

import os
import sys
import time

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np

from brdfguide import models
from brdfguide.models import he_torrance
from brdfguide.models._series import by_terms
from brdfguide.models._series_patches import ln_series
from brdfguide.physics.geometry import Geometry

SAMPLES = 100_000
SURFACES = {
    "smooth metal 0.05, 2 um": (0.05, 2.0),
    "rough metal 0.28, 1.77 um": (0.28, 1.77),
    "rough 2, 10 um": (2.0, 10.0),
    "polished 0.005, 3 um": (0.005, 3.0),
}
METAL = {"n": 0.958, "k": 6.69, "scale": 1.0}


def forty_terms(g, y):
    """What public implementations do: a fixed number of terms (0.1 % wrong beyond g = 25)."""
    term, total = np.exp(-g), np.zeros_like(g)
    for m in range(1, 41):
        term = term * g / m
        total += term / m * np.exp(-y / m)
    return total


def least(evaluators, seconds, samples):
    """ns per sample of each law; they take turns."""
    best = dict.fromkeys(evaluators, np.inf)
    for evaluator in evaluators.values():
        evaluator()
    end = time.perf_counter() + seconds
    while time.perf_counter() < end:
        for name, evaluator in evaluators.items():
            start = time.process_time_ns()
            evaluator()
            best[name] = min(best[name], time.process_time_ns() - start)
    return {name: each / samples for name, each in best.items()}


def costs(geom, sigma, tau, seconds: float) -> dict[str, float]:
    """Least time of each way [ns per evaluation] for one surface."""
    he, ggx = models.term("he-torrance"), models.term("ggx")
    values = {"sigma": sigma, "slope": sigma / tau, **METAL}
    _, g, y = he_torrance.in_blocks(he_torrance._parts, geom, *values.values())
    cost = least(
        {
            "he": lambda: he(geom, **values),
            "ggx": lambda: ggx(geom, alpha=2 * sigma / tau, **METAL),
            "sum": lambda: ln_series(g, y),
            "gradient": lambda: he.gradient(geom, ("sigma", "slope"), **values),
            "forty": lambda: forty_terms(g, y),
        },
        seconds,
        g.size,
    )
    return cost | least({"terms": lambda: by_terms(g, y)}, seconds / 4, g.size)


def main(seconds: float, samples: int) -> None:
    random = np.random.default_rng(1)
    geom = Geometry.from_degrees(
        random.uniform(1, 87, samples), 0, random.uniform(1, 87, samples), random.uniform(0, 360, samples)
    )
    print(
        f"{'surface':26}  {'he':>6}  {'+ d/dsigma, d/dslope':>20}  {'its sum':>8}  {'ggx':>6}  {'he/ggx':>6}  "
        f"{'40 terms':>8}  {'by terms':>8}   ns per evaluation"
    )
    for name, (sigma, tau) in SURFACES.items():
        cost = costs(geom, sigma, tau, seconds)
        print(
            f"{name:26}  {cost['he']:6.0f}  {cost['gradient']:20.0f}  {cost['sum']:8.0f}  {cost['ggx']:6.0f}  "
            f"{cost['he'] / cost['ggx']:6.1f}  {cost['forty']:8.0f}  {cost['terms']:8.0f}"
        )


if __name__ == "__main__":
    main(
        float(sys.argv[1]) if len(sys.argv) > 1 else 4.0,
        int(sys.argv[2]) if len(sys.argv) > 2 else SAMPLES,
    )
