"""Plans against whole tables: what a law fitted to a few planned directions misses over all of them.

    python benchmarks/plans.py [--draws 5] [--moved 5] [--only WORD]

For each given table nine laws are fitted to the directions of the table nearest to a plan's, and to the whole table;
told is the ratio of the two errors over the whole table, the median over the laws. `random` draws directions of the
table itself, of which no plan knows. `8 then 8` measures eight, and plans eight more after them; before any data the
sixteen are that. `500 like it` is no plan: so many directions drawn as a general plan before any data supposes that a
table's lie, which tells what that supposition costs. In brackets after a blind plan: the middle of the same plan with
its directions moved by a few degrees. Plans among a table's own directions are three, for all surfaces of which nothing
is known and for either half of them: told is the middle one, in brackets the worst.
"""

import argparse
import os
import sys
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from benchmarks.given_tables import moved, nearest, rms, tables
from brdfguide import models
from brdfguide.fitting import fit as fitting
from brdfguide.fitting import hypotheses, learnt_design, planning, ranking
from brdfguide.fitting.fit import ln_residuals
from brdfguide.fitting.goniometer import Goniometer, hemisphere

LAWS = [
    models.get(name)
    for name in (
        *("lambertian+ggx", "lambertian+beckmann", "lambertian+cook-torrance", "lambertian+ward", "lambertian+blinn"),
        *("lambertian+lafortune", "lambertian+he-torrance", "lambertian+student-t", "oren-nayar+ggx"),
    )
]
BARS = {
    **{"8": 1.15, "8 among its own": 1.15, "16": 1.05, "16 among its own": 1.05},
    **{"8 then 8 among its own": 1.05, "32 in plane": 1.15, "500 like it": 1.05},
}
HALVES = (slice(None), slice(0, None, 2), slice(1, None, 2))  # of the surfaces that are thought possible
MANY = 500


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=5, help="random draws of 16 directions")
    parser.add_argument("--moved", type=int, default=5, help="times that a blind plan is moved by a few degrees")
    parser.add_argument("--only", default="", help="tables with this in their names")
    asked = parser.parse_args()
    blind = {
        "8": learnt_design.learnt_directions(8, in_plane=False),
        "16": learnt_design.learnt_directions(16, in_plane=False),
        "32 in plane": learnt_design.learnt_directions(32, in_plane=True),
    }
    print(f"| table | {' | '.join(BARS)} | 16 random (worst) |")
    print("|---" * (len(BARS) + 2) + "|")
    rows = [_of_table(*each, blind, asked.draws, asked.moved) for each in tables() if asked.only in each[0]]
    for name, bar in BARS.items():
        found = [[row[each] <= bar for row in rows] for each in (name, f"{name} moved") if each in rows[0]]
        told = ", moved ".join(str(sum(each)) for each in found)
        print(f"{name}: at most {bar} on {told} of {len(rows)} tables")


def _of_table(name, table, judged, blind, draws: int, times: int) -> dict:
    whole = {each.name: rms(each.residuals) for each in fitting.fit_all(LAWS, judged)}

    def cost(rows) -> float:
        found = fitting.fit_all(LAWS, table[rows])
        return float(np.median([rms(ln_residuals(each.surface, judged)) / whole[each.name] for each in found]))

    told = {plan: cost(nearest(table, geom, either_way=True)) for plan, geom in blind.items()}
    random = np.random.default_rng(26)
    for plan, geom in blind.items():
        off = [cost(nearest(table, moved(geom, random), either_way=True)) for _ in range(times)]
        told[f"{plan} moved"] = float(np.median(off)) if off else told[plan]
    everywhere, weights = hemisphere(80.0)
    like_it = everywhere[random.choice(len(weights), MANY, p=weights)]
    told["500 like it"] = cost(nearest(table, like_it, either_way=True))
    among = planning.some_directions(table)
    brackets = {each: told[f"{each} moved"] for each in blind}
    first = {count: [nearest(table, _own(among, half, count)) for half in HALVES] for count in (8, 16)}
    plans = {f"{count} among its own": rows for count, rows in first.items()}
    plans["8 then 8 among its own"] = [_sequential(table, rows, among) for rows in first[8]]
    for plan, found in plans.items():
        costs = [cost(rows) for rows in found]
        told[plan], brackets[plan] = float(np.median(costs)), max(costs)
    chance = [cost(np.sort(random.choice(len(table.brdf), 16, replace=False))) for _ in range(draws)]
    cells = [f"{told[each]:.3f}" + (f" ({brackets[each]:.2f})" if each in brackets else "") for each in BARS]
    print(f"| {name} | {' | '.join(cells)} | {np.median(chance):.3f} ({max(chance):.2f}) |", flush=True)
    return told


def _own(among, half: slice, count: int):
    """Directions planned among those of a table."""
    target = planning.evenly(among, 80.0)
    return planning.plan_everywhere(target, Goniometer(), hypotheses.unknown()[half], count, among=among).geom


def _sequential(table, rows, among) -> np.ndarray:
    """Rows of eight directions, and of eight planned among those of a table after they were measured."""
    few = table[rows]
    ranked = ranking.rank(fitting.fit_all(LAWS, few), few)
    geom = planning.measured_part(few)
    known = hypotheses.after(ranked)
    target = planning.evenly(among, 80.0)
    more = planning.plan_everywhere(target, Goniometer(), known, 8, measured=geom, among=among).geom
    return np.union1d(rows, nearest(table, more))


if __name__ == "__main__":
    main()
