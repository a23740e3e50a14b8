"""Finds directions as those of `brdfguide/fitting/learnt_design.py`, and tells what they are worth.

    python benchmarks/plan_learnt.py [--in-plane] [--counts 8 16] [--keep 0] [--minutes 10] [--begin shipped]
        [--made] [--without WORD]

A plan before any data is the same for every surface, so it may be learnt. The search begins with the best of general
plans for random thirds of the surfaces, their angles moved. Then one direction or two are replaced, by one of those
that the laws made linear about their fits to the whole tables (`plan_bounds.py`) say are best there, the tables weighed
at random, by one nearby, by a mirror direction or by any; and kept where the loss falls. The loss is of real fits: for
every table how far the error of nine laws' fits to the nearest directions, over the whole table's, the median of the
laws, is above 1 in parts of the bar, levelled off so that no one table decides, and whether it is beyond the bar; as
the plan is, and with every angle moved by about two degrees. Tables that are farthest off come first, so that what
makes them worse is soon dropped. A table with the word of `--without` is left out and told at the end; the other
made tables always are. What is shipped came from several such runs: eight alone, then (`--counts 16 --keep 8`) eight
more, then both with --made.
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

from benchmarks.given_tables import moved, nearest, nearest_rows, rms, tables, vectors
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
SLACK = 0.02  # by which a loss may be above the best one before all of it is known
MOVED = 2  # times that a plan is moved
APART_DEG = 4.0
SHORTLIST = 25  # of the directions that are best made linear
TRIED = 10  # replacements of a direction before the next
TWO = 0.2  # share of the trials in which another direction is replaced as well
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
        whole = {each.name: rms(ln_residuals(each.surface, judged)) for each in found}
        return cls(name, table, judged, whole, linear, back)

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


@dataclass(frozen=True, eq=False)
class Search:
    """A plan that is learnt from tables, given and made, and judged by its first directions as well."""

    tables: list[Judged]
    made: list[Judged]
    offered: Geometry
    reach: Goniometer
    counts: tuple[int, ...]
    keep: int
    random: np.random.Generator

    def terms(self, angles: np.ndarray, best: np.ndarray | None = None) -> np.ndarray | None:
        """(judged plans * tables,): what the loss of a plan (directions, 3) [deg] is the sum of. None as soon as the
        sum is by `SLACK` above that of the best ones so far."""
        random, found = np.random.default_rng(3), []
        jobs = [(1.5, geometry(angles[:count]), BARS[count]) for count in self.counts]
        jobs += [(1 / MOVED, moved(geom, random), bar) for _, geom, bar in jobs for _ in range(MOVED)]
        for weight, geom, bar in jobs:
            for each in (*self.tables, *self.made):
                cost = each.cost(geom)
                is_made = each in self.made
                term = off_the_bar(cost, bar) + (missed(cost, bar) if weight > 1 and not is_made else 0.0)
                found.append(weight * float(term) / len(self.made if is_made else self.tables))
                if best is not None and sum(found) > np.sum(best[: len(found)]) + SLACK:
                    return None
        return np.array(found)

    def best_general(self, begin: np.ndarray) -> np.ndarray:
        """The best of general plans for random surfaces, each moved, and of one to begin with."""
        known, target = hypotheses.unknown(), goniometer.hemisphere(80.0)
        angles, best = begin, self.terms(begin)
        for _ in range(POOL):
            some = tuple(known[each] for each in self.random.choice(len(known), len(known) // 3, replace=False))
            geom = planning.plan_everywhere(target, self.reach, some, len(begin)).geom
            angles, best = self._better(angles, best, self.tidy(degrees(moved(geom, self.random))))
        return angles

    def polished(self, angles: np.ndarray, seconds: float) -> np.ndarray:
        """Directions replaced one by one, or two at once, while time lasts; those to keep stay."""
        geom, ends = geometry(angles), time.monotonic() + seconds
        self.tables.sort(key=lambda each: -each.cost(geom))
        best = self.terms(angles)
        while time.monotonic() < ends:
            place = int(self.random.integers(self.keep, len(angles)))
            ranked = self._ranked(angles, place)
            for number in range(TRIED):
                other = angles.copy()
                other[place] = self._proposed(angles[place], ranked, number)
                if self.random.random() < TWO:
                    second = int(self.random.integers(self.keep, len(angles)))
                    other[second] = self._proposed(other[second], ranked, number + 1)
                angles, best = self._better(angles, best, other)
        return angles

    def _better(self, angles: np.ndarray, best: np.ndarray, other: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The better of two plans, and its terms."""
        terms = self.terms(other, best) if self.allowed(other) else None
        if terms is None or terms.sum() >= best.sum():
            return angles, best
        print(f"loss {terms.sum():.3f}", file=sys.stderr, flush=True)
        return other, terms

    def _proposed(self, direction: np.ndarray, ranked: np.ndarray, number: int) -> np.ndarray:
        """(3,) [deg]: in place of a direction one nearby, one of the best by the linear form, any, or a mirror's."""
        if number % 5 < 2:
            return self.tidy((direction + STEP_DEG * self.random.standard_normal(3))[None])[0]
        if number % 5 == 2:
            return ranked[int(len(ranked) * self.random.random() ** 2)]
        if number % 10 == 4:
            return np.array([*[float(self.random.integers(5, 80))] * 2, 180.0])
        return self.tidy(degrees(self.offered[[int(self.random.integers(len(self.offered)))]]))[0]

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
    parser.add_argument("--counts", type=int, nargs="+", default=[8, 16], help="so many first directions are judged")
    parser.add_argument("--keep", type=int, default=0, help="so many first directions stay as they are")
    parser.add_argument("--made", action="store_true", help="every other made table counts as well")
    parser.add_argument("--without", default="", help="leave out tables with this in their names")
    asked = parser.parse_args()
    reach = Goniometer(in_plane=asked.in_plane)
    counts = (32,) if asked.in_plane else tuple(asked.counts)
    target = goniometer.hemisphere(80.0)
    offered = target[0][reach.reaches(target[0])]
    given = [Judged.of(*each, offered) for each in tables()]
    left_out = [each for each in given if asked.without and asked.without in each.name]
    learnt_from = [each for each in given if each not in left_out]
    learnt_made = [Judged.of(*each, None) for each in made_tables(list(tables()), 0)] if asked.made else []
    search = Search(learnt_from, learnt_made, offered, reach, counts, asked.keep, np.random.default_rng(sum(counts)))
    general = [planning.plan_everywhere(target, reach, hypotheses.unknown(), count).geom for count in counts]
    begin = degrees(learnt_design.learnt_directions(counts[-1], asked.in_plane))
    if asked.begin == "general":
        begin = search.best_general(search.tidy(degrees(general[-1])))
    angles = search.polished(begin, 60 * asked.minutes)
    print("(" + ", ".join(f"({a:g}, {b:g}, {c:g})" for a, b, c in angles) + ")")
    made = [Judged.of(*each, None) for each in made_tables(list(tables()), 1 if asked.made else None)]
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
