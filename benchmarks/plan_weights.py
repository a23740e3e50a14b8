"""Whether the directions of a plan should count unlike, told without fits: the linear form of `plan_bounds.py`.

    python benchmarks/plan_weights.py [--times 4] [--only WORD]

A plan stands for all directions of a table. Weights that make its mean of every smooth misfit nearest to the table's
solve K w = μ, none below zero (the kernel's quadrature; Huszár and Duvenaud 2012, "Optimally-weighted herding is
Bayesian quadrature"). Of eight and sixteen directions, planned among some of the table's or drawn from these, the error
over the table is told with the same weight for each and with those weights: the median over the laws, and of as many
choices of what is offered.
"""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np
from scipy.optimize import nnls

from benchmarks.given_tables import nearest, tables
from benchmarks.plan_bounds import Linear
from benchmarks.plans import LAWS
from brdfguide.fitting import fit as fitting
from brdfguide.fitting import hypotheses, planning
from brdfguide.fitting.goniometer import Goniometer

OFFERED = 600
EVERY = 4  # of the surfaces of which nothing is known
COUNTS = (8, 16)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--times", type=int, default=4, help="choices of what is offered")
    parser.add_argument("--only", default="", help="tables with this in their names")
    asked = parser.parse_args()
    kinds = ("planned, alike", "planned, weighed", "drawn, alike", "drawn, weighed")
    print(f"| table | {' | '.join(f'{count} {kind}' for count in COUNTS for kind in kinds)} |")
    print("|---" * (1 + len(COUNTS) * len(kinds)) + "|")
    for name, table, judged in tables():
        if asked.only in name:
            _of_table(name, table, judged, asked.times)


def _of_table(name: str, table, judged, times: int) -> None:
    whole = fitting.fit_all(LAWS, judged)
    cells = []
    for number in range(times):
        random = np.random.default_rng([26, number])
        some = table[np.sort(random.choice(len(table.brdf), min(OFFERED, len(table.brdf)), replace=False))]
        laws = [Linear.of(each, judged, some) for each in whole]
        cells.append([each for count in COUNTS for each in _alike_and_weighed(some, laws, count, number, random)])
    print(f"| {name} | {' | '.join(f'{each:.3f}' for each in np.median(cells, axis=0))} |", flush=True)


def _alike_and_weighed(some, laws: list[Linear], count: int, number: int, random):
    """Of planned directions, then of drawn ones, the error with one weight and with the kernel's."""
    geom = some.geom.at(np.atleast_1d(some.geom.wavelength)[:1])
    weights = np.full(len(geom), 1 / len(geom))
    surfaces = hypotheses.unknown()[number % EVERY :: EVERY]
    everywhere = planning.Everywhere(geom, weights, surfaces)
    plan = planning.plan_everywhere((geom, weights), Goniometer(), surfaces, count, among=geom).geom
    for rows in (nearest(some, plan), random.choice(len(geom), count, replace=False)):
        groups = everywhere.groups([np.array([row]) for row in rows], squares=True)
        root = np.linalg.cholesky(groups.between + 1e-9 * np.trace(groups.between) * np.eye(len(rows)))
        found = nnls(root.T, np.linalg.solve(root, groups.toward))[0]
        for each in (np.ones(len(rows)), found * len(rows) / found.sum()):
            yield float(np.median([law.weighed(rows, each) for law in laws]))


if __name__ == "__main__":
    main()
