"""Each law against a straightforward NumPy transcription of its formula, on the same directions in the same run.

    python benchmarks/models.py [samples]

Ours works in blocks with the directions kept, as in a fit; the transcription gets its angles (first ratio), or its half
vectors and cosines as well (second ratio). Least thread CPU time of interleaved repeats.
"""

import sys
from functools import partial
from time import thread_time_ns

import naive
import numpy as np

from brdfguide import models
from brdfguide.physics.geometry import Geometry, rows

REPEATS, BLOCK = 9, 16384


def in_blocks(term, blocks, values):
    return [term(block, **values) for block in blocks]


def at_angles(model, angles, values):
    return model(naive.directions(*angles), **values)


def main(samples: int = 100_000) -> None:
    rng = np.random.default_rng(5)
    theta_i, theta_r, phi = rng.uniform(1, 88, samples), rng.uniform(1, 88, samples), rng.uniform(0, 360, samples)
    blocks = [block for _, block in rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi)).blocks(BLOCK)]
    angles = tuple(np.radians(a) for a in (theta_i, theta_r, phi))
    given = naive.directions(*angles)
    names = [name for name in models.names() if name in naive.LAWS]
    least = {}
    for _ in range(REPEATS):
        for name in names:
            term, model = models.term(name), naive.LAWS[name]
            values = term.defaults()
            ways = {
                "ours": partial(in_blocks, term, blocks, values),
                "angles": partial(at_angles, model, angles, values),
                "given": partial(model, given, **values),
            }
            results = {}
            for way, run in ways.items():
                began = thread_time_ns()
                results[way] = run()
                least[name, way] = min(least.get((name, way), np.inf), (thread_time_ns() - began) / samples)
            ours = np.concatenate(results["ours"])[:, 0]
            bright = ours > 1e-12 * ours.max()
            error = np.abs(results["given"] / np.where(bright, ours, 1) - 1)[bright].max()
            assert error < 1e-6, (name, error)
    print(
        f"{'law':15s} {'ours ns':>8s} {'from angles':>12s} {'ratio':>6s} {'given':>8s} {'ratio':>6s}   "
        f"({samples} samples)"
    )
    for name in names:
        ours, from_angles, from_given = (least[name, way] for way in ("ours", "angles", "given"))
        print(
            f"{name:15s} {ours:8.1f} {from_angles:12.1f} {from_angles / ours:6.1f} {from_given:8.1f} "
            f"{from_given / ours:6.1f}"
        )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
