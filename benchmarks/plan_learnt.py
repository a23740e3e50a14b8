"""Finds directions as those of `brdfguide/fitting/learnt_design.py`, and tells what they are worth.

    python benchmarks/plan_learnt.py [--in-plane] [--minutes 10] [--begin shipped] [--without WORD]

A plan before any data is the same for every surface, so it may be learnt. The search begins with the best of general
plans for random thirds of the surfaces, their angles moved. Then one direction after another is replaced, by one of
those that the laws made linear about their fits to the whole tables (`plan_bounds.py`) say is best there, the tables
weighed at random, or by one nearby; and kept where the loss falls. The loss is of real fits: for every table how far
the error of nine laws' fits to the nearest directions, over the whole table's, the median of the laws, is above 1 in
parts of the bar, levelled off so that no one table decides, and whether it is beyond the bar; as the plan is, and with
every angle moved by about two degrees. Out of the plane sixteen and the first eight of them are judged together. A
table with the word of `--without` is left out and told at the end; made tables always are. What is shipped came from
several such runs, the first of which looked for eight alone, the last two from what was shipped before.
"""

import argparse
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from benchmarks.given_tables import at_most, moved, nearest, nearest_rows, rms, tables, vectors
from benchmarks.plan_bounds import Linear
from benchmarks.plan_made import made_tables
from benchmarks.plans import LAWS
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import fit as fitting
from brdfguide.fitting import goniometer, hypotheses, learnt_design, planning
from brdfguide.fitting.fit import ln_residuals
from brdfguide.fitting.goniometer import Goniometer
from brdfguide.physics.geometry import Geometry, rows

BARS = {8: 1.15, 16: 1.05, 32: 1.15}
BEYOND = 6.0  # how steeply it counts that a bar is missed
LEVEL = 4.0  # bars above 1, from which on a table counts little more
BELOW = -0.5  # what counts of an error that is below the whole table's
MOVED = 2  # times that a plan is moved
JUDGED = 1300  # directions of a table that errors are told over
APART_DEG = 4.0
SHORTLIST = 25  # of the directions that are best made linear
TRIED = 5  # replacements of a direction before the next
POOL = 60  # general plans to begin with
STEP_DEG = np.array([3.0, 3.0, 6.0])
SPREAD = 0.6  # of ln of the tables' weights
MEAN = 0.3  # of the laws, beside their median
UNLIKE = ("cayman", "sunflower vinyl")  # what the linear form foretells there is not what fits do


@dataclass(frozen=True, eq=False)
class Judged:
    """A table, its laws' errors over it, and the laws made linear at the rows nearest to what is offered."""

    name: str
    table: Measurement
    judged: Measurement
    whole: dict[str, float]
    linear: list[Linear]
    back: np.ndarray  # offered direction -> row of the linear form

    @classmethod
    def of(cls, name: str, table: Measurement, judged: Measurement, offered: Geometry | None) -> "Judged":
        found = fitting.fit_all(LAWS, judged)
        linear, back = [], np.zeros(0, int)
        if offered is not None and not name.startswith(UNLIKE):
            some, back = np.unique(nearest_rows(table.geom, offered, either_way=True), return_inverse=True)
            linear = [Linear.of(each, judged, table[some]) for each in found]
        few = at_most(judged, JUDGED)
        whole = {each.name: rms(ln_residuals(each.surface, few)) for each in found}
        return cls(name, table, few, whole, linear, back)

    def cost(self, geom: Geometry) -> float:
        found = fitting.fit_all(LAWS, self.table[nearest(self.table, geom, either_way=True)])
        return float(
            np.median([rms(ln_residuals(each.surface, self.judged)) / self.whole[each.name] for each in found])
        )

    def with_each(self, some: list[int]) -> np.ndarray:
        """(offered,): the same made linear, of some directions and one more."""
        ratios = [law.with_each(self.back[some])[self.back] for law in self.linear]
        return (1 - MEAN) * np.median(ratios, axis=0) + MEAN * np.mean(ratios, axis=0)


def off_the_bar(cost, bar: float) -> np.ndarray:
    """By how many bars an error is above 1, levelled off."""
    off = np.maximum((np.asarray(cost) - 1) / (bar - 1), BELOW)
    return off / np.sqrt(1 + (np.maximum(off, 0) / LEVEL) ** 2)


def missed(cost, bar: float) -> np.ndarray:
    """Whether an error is beyond the bar, from 0 to 1."""
    return 1 / (1 + np.exp(-BEYOND * (np.asarray(cost) - bar) / (bar - 1)))


class Search:
    """A plan that is learnt from some tables, and judged by its first directions as well."""

    def __init__(self, learnt_from: list[Judged], offered: Geometry, reach: Goniometer, counts: tuple[int, ...]):
        self.tables, self.offered, self.reach, self.counts = learnt_from, offered, reach, counts
        self.random = np.random.default_rng(sum(counts))

    def loss(self, angles: np.ndarray, most: float = np.inf) -> float:
        """Of a plan (directions, 3) [deg]; infinite as soon as it is sure to be above what is wanted."""
        jobs = []
        for count in self.counts:
            geom, random = geometry(angles[:count]), np.random.default_rng(3)
            jobs += [(1.5, geom, BARS[count]), *((1 / MOVED, moved(geom, random), BARS[count]) for _ in range(MOVED))]
        total, left = 0.0, BELOW * sum(weight for weight, _, _ in jobs)
        for weight, geom, bar in sorted(jobs, key=lambda job: -job[0]):
            costs = [each.cost(geom) for each in self.tables]
            total += weight * float(np.mean(off_the_bar(costs, bar)))
            total += weight * float(np.mean(missed(costs, bar))) if weight > 1 else 0.0
            left -= BELOW * weight
            if total + left > most:
                return np.inf
        return total

    def best_general(self, begin: np.ndarray) -> np.ndarray:
        """The best of general plans for random surfaces, each moved, and of one to begin with."""
        known, target = hypotheses.unknown(), goniometer.hemisphere(80.0)
        best, least = begin, self.loss(begin)
        for _ in range(POOL):
            some = tuple(known[each] for each in self.random.choice(len(known), len(known) // 3, replace=False))
            geom = planning.plan_everywhere(target, self.reach, some, len(begin)).geom
            angles = self.tidy(degrees(moved(geom, self.random)))
            loss = self.loss(angles, least) if self.allowed(angles) else np.inf
            if loss < least:
                best, least = angles, loss
        return best

    def polished(self, angles: np.ndarray, seconds: float) -> np.ndarray:
        """Directions replaced one by one while time lasts."""
        least, ends = self.loss(angles), time.monotonic() + seconds
        while time.monotonic() < ends:
            place = int(self.random.integers(len(angles)))
            ranked = self._ranked(angles, place)
            for number in range(TRIED):
                other = angles.copy()
                if number % 2:
                    other[place] = self.tidy(other[[place]] + STEP_DEG * self.random.standard_normal(3))[0]
                else:
                    other[place] = ranked[int(len(ranked) * self.random.random() ** 2)]
                loss = self.loss(other, least) if self.allowed(other) else np.inf
                if loss < least:
                    angles, least = other, loss
                    left = max(ends - time.monotonic(), 0.0)
                    print(f"{left:5.0f} s left, loss {least:.3f}", file=sys.stderr, flush=True)
        return angles

    def _ranked(self, angles: np.ndarray, place: int) -> np.ndarray:
        """What is offered in place of a direction, the best first, by the linear form."""
        linear = [each for each in self.tables if each.linear]
        weights = np.exp(SPREAD * self.random.standard_normal(len(linear)))
        total = np.zeros(len(self.offered))
        for count in self.counts:
            if place < count:
                rest = nearest_rows(self.offered, geometry(np.delete(angles[:count], place, axis=0)), either_way=True)
                off = [off_the_bar(each.with_each(rest), BARS[count]) for each in linear]
                total += np.average(off, axis=0, weights=weights)
        return self.tidy(degrees(self.offered[np.argsort(total)[:SHORTLIST]]))

    def tidy(self, angles: np.ndarray) -> np.ndarray:
        """Whole degrees, the larger angle first, the azimuth from 0 to 180, or its ends in the plane."""
        theta = np.sort(np.abs(np.round(angles[:, :2])), axis=1)[:, ::-1]
        phi = np.abs((np.round(angles[:, 2]) + 180) % 360 - 180)
        phi = np.where(phi < 90, 0.0, 180.0) if self.reach.in_plane else phi
        return np.column_stack([theta, phi])

    def allowed(self, angles: np.ndarray) -> bool:
        geom = geometry(angles)
        place = vectors(geom)
        apart = np.sum((place[:, None] - place) ** 2, axis=2) + np.eye(len(place))
        return bool(np.all(self.reach.reaches(geom)) and apart.min() > np.radians(APART_DEG) ** 2)


def geometry(angles: np.ndarray) -> Geometry:
    return rows(Geometry.from_degrees(angles[:, 0], 0.0, angles[:, 1], angles[:, 2]))


def degrees(geom: Geometry) -> np.ndarray:
    """(directions, 3): both zeniths and the azimuth between them [deg]."""
    return np.concatenate([geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg], axis=1)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--in-plane", action="store_true", help="32 directions in the plane of incidence")
    parser.add_argument("--minutes", type=float, default=10.0, help="for the replacements, after the general plans")
    parser.add_argument("--begin", default="general", choices=("general", "shipped"), help="with which plan")
    parser.add_argument("--without", default="", help="leave out tables with this in their names")
    asked = parser.parse_args()
    reach = Goniometer(in_plane=asked.in_plane)
    counts = (32,) if asked.in_plane else (8, 16)
    target = goniometer.hemisphere(80.0)
    offered = target[0][reach.reaches(target[0])]
    given = [Judged.of(*each, offered) for each in tables()]
    left_out = [each for each in given if asked.without and asked.without in each.name]
    search = Search([each for each in given if each not in left_out], offered, reach, counts)
    general = [planning.plan_everywhere(target, reach, hypotheses.unknown(), count).geom for count in counts]
    begin = degrees(learnt_design.learnt_directions(counts[-1], asked.in_plane))
    if asked.begin == "general":
        begin = search.best_general(search.tidy(degrees(general[-1])))
    angles = search.polished(begin, 60 * asked.minutes)
    print("(" + ", ".join(f"({a:g}, {b:g}, {c:g})" for a, b, c in angles) + ")")
    made = [Judged.of(*each, None) for each in made_tables(list(tables()))]
    for count, plan in zip(counts, general, strict=True):
        plans = [plan, learnt_design.learnt_directions(count, asked.in_plane), geometry(angles[:count])]
        _told(count, plans, left_out, search.tables, made)


def _told(count: int, plans: list[Geometry], left_out: list[Judged], learnt_from: list[Judged], made: list[Judged]):
    print(f"\n| table, {count} directions | general | shipped | found |\n|---|---|---|---|")
    for each in (*left_out, *learnt_from):
        name = f"{each.name}, left out" if each in left_out else each.name
        print(f"| {name} | {' | '.join(f'{each.cost(geom):.3f}' for geom in plans)} |", flush=True)
    for name, change in (("", None), (", moved", np.random.default_rng(26))):
        some = plans if change is None else [moved(geom, change) for geom in plans]
        costs = np.array([[each.cost(geom) for geom in some] for each in made])
        cells = [f"{np.median(each):.3f} ({np.mean(each <= BARS[count]):.0%})" for each in costs.T]
        print(f"| middle of {len(made)} made{name} (within {BARS[count]}) | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
