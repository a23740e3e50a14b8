"""What the settings of a plan among a file's directions are worth, told without fits: linear as in `plan_bounds.py`.

    python benchmarks/plan_settings.py [--draws 6] [--only WORD]

For each given table some of its directions are offered, by several draws, and eight and sixteen planned among them with
one setting of `planning.py` changed at a time. Told is the mean over tables and draws of the error over the table, the
median over the laws, over that of a fit to all, and in how many of them it is within the bar. A difference counts
against its standard error, that of the pairs. The directions by which a narrow lobe is seen are left out.
"""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from benchmarks.given_tables import tables
from benchmarks.plan_bounds import BARS, Linear
from benchmarks.plans import LAWS
from brdfguide.fitting import fit as fitting
from brdfguide.fitting import hypotheses, planning
from brdfguide.numerics.herding import Groups, representatives

OFFERED = 600
WIDTHS, LENGTHS = planning.WIDTHS, planning.LENGTHS
SETTINGS = {
    "as it is": {},
    "one length": {"LENGTHS": (1.0,)},
    "five lengths": {"LENGTHS": (0.35, 0.6, 1.0, 1.7, 2.8)},
    "lengths 0.25 to 1": {"LENGTHS": (0.25, 0.5, 1.0)},
    "lengths 1 to 4": {"LENGTHS": (1.0, 2.0, 4.0)},
    "tilt's width halved": {"WIDTHS": (WIDTHS[0] / 2, *WIDTHS[1:])},
    "tilt's width doubled": {"WIDTHS": (WIDTHS[0] * 2, *WIDTHS[1:])},
    "grazing's width halved": {"WIDTHS": (*WIDTHS[:2], WIDTHS[2] / 2)},
    "grazing's width doubled": {"WIDTHS": (*WIDTHS[:2], WIDTHS[2] * 2)},
    "difference's width halved": {"WIDTHS": (WIDTHS[0], WIDTHS[1] / 2, WIDTHS[2])},
    "difference's width doubled": {"WIDTHS": (WIDTHS[0], WIDTHS[1] * 2, WIDTHS[2])},
    "rough part 0.5": {"ROUGH": 0.5},
    "rough part 2": {"ROUGH": 2.0},
    "rough within 10 deg": {"ROUGH_DEG": 10.0},
    "squares 0": {"SQUARES": 0.0},
    "squares 1.5": {"SQUARES": 1.5},
    "squares 5": {"SQUARES": 5.0},
    "6 deg apart": {"APART_DEG": 6.0},
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=6, help="of the directions that are offered")
    parser.add_argument("--only", default="", help="tables with this in their names")
    asked = parser.parse_args()
    known = hypotheses.unknown()
    found = [
        _of_draw(table, fitting.fit_all(LAWS, judged), judged, known, number)
        for name, table, judged in tables()
        if asked.only in name
        for number in range(asked.draws)
    ]
    ratios = np.array(found)  # (tables and draws, settings, counts)
    print(
        "| setting | " + " | ".join(f"{count} mean | against as it is | within {BARS[count]}" for count in BARS) + " |"
    )
    print("|---" * (1 + 3 * len(BARS)) + "|")
    for place, name in enumerate(SETTINGS):
        cells = []
        for number, bar in enumerate(BARS.values()):
            costs = ratios[:, place, number]
            less = costs - ratios[:, 0, number]
            doubt = less.std() / np.sqrt(len(less))
            cells += [f"{costs.mean():.3f}", f"{less.mean():+.4f} ± {doubt:.4f}", f"{np.mean(costs <= bar):.0%}"]
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


def _of_draw(table, whole, judged, known, number: int) -> list[list[float]]:
    """(settings, counts) of the error where some directions of a table are offered."""
    random = np.random.default_rng([26, number])
    some = table[np.sort(random.choice(len(table.brdf), min(OFFERED, len(table.brdf)), replace=False))]
    laws = [Linear.of(each, judged, some) for each in whole]
    geom = some.geom.at(np.atleast_1d(some.geom.wavelength)[:1])
    weights, numbers = np.full(len(geom), 1 / len(geom)), [np.array([row]) for row in range(len(geom))]
    everywhere = planning.Everywhere(geom, weights, known, None, LENGTHS)
    return [_with(setting, everywhere, laws, numbers) for setting in SETTINGS.values()]


def _with(setting: dict, everywhere: planning.Everywhere, laws: list[Linear], numbers) -> list[float]:
    """The error of eight and of sixteen directions, with one setting changed."""
    before = {name: getattr(planning, name) for name in setting}
    for name, value in setting.items():
        setattr(planning, name, value)
    try:
        tangents = everywhere._tangents  # the same in all settings
        other = planning.Everywhere(everywhere.geom, everywhere.weights, everywhere.hypotheses, None, planning.LENGTHS)
        other.__dict__["_tangents"] = tangents
        groups: Groups = other.groups(numbers, squares=True)
        near = planning._too_near(everywhere.geom, numbers)
    finally:
        for name, value in before.items():
            setattr(planning, name, value)
    free = np.ones(len(numbers), bool)
    picked = [representatives(groups, count, free, near) for count in BARS]
    return [float(np.median([law.of_sets(np.array([rows]))[0] for law in laws])) for rows in picked]


if __name__ == "__main__":
    main()
