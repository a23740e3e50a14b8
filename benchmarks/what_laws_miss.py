"""How quickly what laws miss of the given tables changes with the directions: the kernel's widths of the price.

    python benchmarks/what_laws_miss.py

To some directions of each table four laws are fitted; what the best of them leaves in the middle channel is taken for a
smooth unknown with noise. The widths are those, a half to twice as large in turn, that make what is left most probable
over all tables (`fitting.off_plane_price`, which holds them rounded).
"""

import os
import sys
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from benchmarks.given_tables import tables
from brdfguide import models
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.missed import WIDTHS, places_of_missed
from brdfguide.numerics.gaussian_process import Places, weighed

LAWS = ("lambertian+ggx", "lambertian+student-t", "lambertian+beckmann", "oren-nayar+ggx")
DIRECTIONS = 300
BEGIN = (1.2, 50.0, 100.0, 1.0)
STEPS = (0.5, 0.7, 1.4, 2.0)
SWEEPS = 2


def main() -> None:
    left = []
    for name, _, judged in tables():
        random = np.random.default_rng(26)
        rows = np.sort(random.choice(len(judged.brdf), min(DIRECTIONS, len(judged.brdf)), replace=False))
        best = min(fitting.fit_all([models.get(each) for each in LAWS], judged[rows]), key=lambda each: each.rms_ln)
        values = -best.residuals[:, best.residuals.shape[1] // 2]
        known = np.isfinite(values)
        left.append((places_of_missed(judged[rows].geom)[known] * np.array(WIDTHS), values[known]))
        print(f"{name}: {best.name} misses {best.rms_ln:.3f}", flush=True)
    widths, least = np.array(BEGIN), probable(left, np.array(BEGIN))
    for place in list(range(len(BEGIN))) * SWEEPS:
        tried = [widths * np.where(np.arange(len(BEGIN)) == place, step, 1.0) for step in STEPS]
        evidence = [probable(left, each) for each in tried]
        if max(evidence) > least:
            widths, least = tried[int(np.argmax(evidence))], max(evidence)
    print("widths", *np.round(widths, 2), f"; ln probability by direction {least:.2f}")


def probable(left, widths) -> float:
    """ln of how probable all is, mean over the directions of each table, summed."""
    total = 0.0
    for points, values in left:
        places = Places.between(points / widths, points[:1] / widths)
        total += weighed(places, values, np.zeros((len(values), 0))).evidence / len(values)
    return total


if __name__ == "__main__":
    main()
