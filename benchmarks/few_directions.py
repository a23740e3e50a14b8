"""From a plan to a law: is what `fit` recommends of a few directions good for the whole table?

    python benchmarks/few_directions.py [--made] [--only WORD]

The directions of each given table nearest to a learnt plan's (8, 16, and 32 in the plane of incidence), or drawn from
its own (12, 24 and 48), are fitted as a file of measurements is, with all candidates and what grows, and without what
the table tells of its noise. Told is the error over the table, rms of ln, of the law that is recommended, over that of
the candidate which is nearest to the table, fitted to the same directions: 1 is the best choice. In brackets the error
itself over that of the law recommended for the whole table, fitted to the whole table. `--made`: of 50 made tables
(`plan_made`) in place of the given ones.
"""

import argparse
import os
import sys
from dataclasses import replace
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

import brdfguide
from benchmarks.given_tables import nearest, rms, tables
from benchmarks.plan_made import made_tables
from brdfguide.fitting import learnt_design
from brdfguide.fitting.residuals import ln_residuals

PLANS = {"8": (8, False), "16": (16, False), "32 in plane": (32, True)}
DRAWN = (12, 24, 48)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--made", action="store_true", help="made tables in place of the given ones")
    parser.add_argument("--only", default="", help="tables with this in their names")
    asked = parser.parse_args()
    given = list(tables())
    named = [each for each in (made_tables(given) if asked.made else given) if asked.only in each[0]]
    columns = [*PLANS, *(f"{count} random" for count in DRAWN)]
    print(f"| table | {' | '.join(columns)} |")
    print("|---" * (len(columns) + 1) + "|")
    found = [_of_table(*each) for each in named]
    choice, whole = (np.exp(np.mean(np.log([each[place] for each in found]), axis=0)) for place in (0, 1))
    print(_row("all (geometric mean)", choice, whole))


def _of_table(name: str, table, judged) -> tuple[list[float], list[float]]:
    best = _error(brdfguide.fit(judged, anyway=True, timing=False).surface, judged)
    random = np.random.default_rng(26)
    chosen = [
        nearest(table, learnt_design.learnt_directions(count, in_plane=plane), either_way=True)
        for count, plane in PLANS.values()
    ]
    chosen += [np.sort(random.choice(len(table.brdf), count, replace=False)) for count in DRAWN]
    choice, whole = [], []
    for rows in chosen:
        answer = brdfguide.fit(replace(table[rows], noise=None), anyway=True, timing=False)
        error = _error(answer.surface, judged)
        choice.append(error / min(_error(row.fit.surface, judged) for row in answer.rows))
        whole.append(error / best)
    print(_row(name, choice, whole), flush=True)
    return choice, whole


def _error(surface, judged) -> float:
    return rms(ln_residuals(surface, judged))


def _row(name: str, choice, whole) -> str:
    cells = " | ".join(f"{each:.2f} ({beside:.2f})" for each, beside in zip(choice, whole, strict=True))
    return f"| {name} | {cells} |"


if __name__ == "__main__":
    main()
