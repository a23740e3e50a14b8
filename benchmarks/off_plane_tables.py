"""What data in the plane of incidence cost, foretold and found, on scans taken of the given tables.

    python benchmarks/off_plane_tables.py [--choose] [--every]

Of every table the directions in the plane of incidence make up to nine measurements, by incidence and by how far from
the normal they go. `fit` foretells what the recommended law misses outside; found is what it misses of the table
there. With --choose the three constants of the price that are a matter of choice are those by which the other tables
are foretold best, table by table, and all are tried on each. --every prints every measurement. Six minutes, or ten.

The tables `UNSEEN` were looked at, but chose nothing.
"""

import argparse
import itertools
import os
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from benchmarks.given_tables import DATA, THETA_MAX_DEG, nearest_rows, tables
from brdfguide.data.measurement import Measurement
from brdfguide.face.functions import fit
from brdfguide.fitting import missed
from brdfguide.fitting import off_plane_price as pricing
from brdfguide.fitting.job import Job, read_for_fit
from brdfguide.fitting.ranked import Ranking
from brdfguide.fitting.residuals import ln_residuals
from tests import synthetic

UNSEEN = {
    "anodised black (UA LOFT)": "ua_loft/AnoBlackEC1onAlum.bsdf",
    "anodised black, nickel (UA LOFT)": "ua_loft/AnoBlackNiTEonSteel.bsdf",
}
WITHIN = (1.25, 1.6, 2.0)
CHOICES = {"MISSED": (0.025, 0.05, 0.1), "MOVES": (0.05, 0.1, 0.2), "ABOUT_MIRROR": (0.1, 0.5)}
PLANE_DEG = 0.1
MANY = 20  # incidences, from which a table is a grid of directions and not scans
SCANNED, STEP_DEG = 25, 5.0  # directions of a scan, of a grid's how far apart
LEAST = 8


@dataclass(frozen=True)
class Case:
    """A measurement in the plane, and what the recommended law misses outside: up to GRAZING_DEG, beyond, all."""

    table: str
    name: str
    ranking: Ranking
    measurement: Measurement
    below: float
    beyond: float
    found: float


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--choose", action="store_true", help="the constants, each table by the others")
    parser.add_argument("--every", action="store_true", help="print every measurement")
    asked = parser.parse_args()
    made = list(cases())
    told = [pricing.off_plane_price(each.ranking, each.measurement) for each in made]
    if asked.every:
        for case, price in zip(made, told, strict=True):
            print(f"{case.table} {case.name}: {case.ranking.recommended.fit.name}, {_shown(price)}; found", end=" ")
            print(f"{case.below:.3f}, toward grazing {case.beyond:.3f}, all {case.found:.3f}")
    print(page(made, told))
    if asked.choose:
        choose(made)


def cases() -> Iterator[Case]:
    """All measurements that are fitted, one after another."""
    for name, table in _with_unseen():
        for label, rows in in_plane_parts(table):
            answer = fit(table[rows], timing=False, anyway=True)
            if not answer.no_answer:
                yield _case(name, label, table, answer)


def _with_unseen() -> Iterator[tuple[str, Measurement]]:
    for name, table, _ in tables():
        yield name, table
    for name, path in UNSEEN.items():
        if (DATA / path).exists():
            table = read_for_fit(DATA / path, Job(reading=(("theta_max", THETA_MAX_DEG),), anyway=True))
            yield name, table[table.has_value]


def in_plane_parts(table: Measurement) -> Iterator[tuple[str, np.ndarray]]:
    """(name, rows) of scans in the plane of incidence: of some incidences, up to some angle from the normal."""
    flat = np.flatnonzero(table.geom.off_plane_deg[:, 0] < PLANE_DEG)
    incidences = np.unique(np.round(table.geom.theta_i_deg[flat, 0], 1))
    if len(incidences) > MANY:
        incidences = np.arange(5.0, THETA_MAX_DEG, 10.0)
    parts = {
        "all": (incidences, 80.0),
        "all up to 70": (incidences, 70.0),
        "all up to 60": (incidences, 60.0),
        "low": (incidences[incidences <= 62], 80.0),
        "three": (_near(incidences, 15, 45, 65), 80.0),
        "three up to 60": (_near(incidences, 15, 40, 58), 61.0),
        "two": (_near(incidences, 30, 60), 80.0),
        "every other": (incidences[::2], 80.0),
        "the others": (incidences[1::2], 75.0),
    }
    for name, (some, highest) in parts.items():
        scans = [_scan(table, flat, each, highest) for each in some if each <= highest]
        rows = np.unique(np.concatenate(scans)) if scans else np.array([], int)
        if len(rows) >= LEAST:
            yield name, rows


def _near(incidences: np.ndarray, *wanted: float) -> np.ndarray:
    return np.unique([incidences[np.argmin(np.abs(incidences - each))] for each in wanted])


def _scan(table: Measurement, flat: np.ndarray, theta_i: float, highest: float) -> np.ndarray:
    """Rows of one incidence; of a grid those nearest to a scan's directions."""
    theta_r = table.geom.signed_theta_r_deg[flat, 0]
    here = (np.abs(table.geom.theta_i_deg[flat, 0] - theta_i) < 0.06) & (np.abs(theta_r) <= highest)
    if np.any(here) and len(np.unique(np.round(table.geom.theta_i_deg[flat, 0], 1))) <= MANY:
        rows = flat[here][np.argsort(theta_r[here], kind="stable")]
        return rows[:: -(-len(rows) // SCANNED)]
    scan = synthetic.scan((theta_i,), STEP_DEG)
    scan = scan[scan.theta_r_deg[:, 0] <= highest]
    return flat[nearest_rows(table.geom[flat], scan)]


def _case(name: str, label: str, table: Measurement, answer) -> Case:
    there, weights = pricing.outside_plane(answer.measurement)
    left = ln_residuals(answer.surface, table[nearest_rows(table.geom, there.geom)])
    steep = pricing.toward_grazing(there.geom)
    every = np.ones(len(steep), bool)
    found = [rms_over(left[here], weights[here]) for here in (~steep, steep, every)]
    return Case(name, label, answer.ranking, answer.measurement, *found)


def rms_over(left: np.ndarray, weights: np.ndarray) -> float:
    """Of what a law misses (directions, channels), where there is a value."""
    known = weights[:, None] * np.isfinite(left)
    squares = np.where(np.isfinite(left), left, 0.0) ** 2
    return float(np.sqrt(np.sum(known * squares) / known.sum())) if np.any(known) else 0.0


def page(made: list[Case], told: list) -> str:
    """How often the error found is what was said, by table."""
    lines = ["| table | cases | within 25 % | factor of 1.6 | of 2 | said/found (middle) | toward grazing found/said |"]
    lines.append("|---|---|---|---|---|---|---|")
    for name in (*dict.fromkeys(each.table for each in made), "all", "all but the unseen"):
        pairs = [
            (case, price)
            for case, price in zip(made, told, strict=True)
            if price and (case.table == name or name == "all" or (name[:3] == "all" and case.table not in UNSEEN))
        ]
        if not pairs:
            continue
        ln = np.log([price.rms_ln / case.below for case, price in pairs])
        shares = " | ".join(f"{100 * np.mean(np.abs(ln) <= np.log(each)):.0f} %" for each in WITHIN)
        steep = [case.beyond / price.grazing for case, price in pairs if price.grazing and case.beyond]
        beyond = " to ".join(f"{each:.2f}" for each in np.quantile(steep, (0.1, 0.5, 0.9))) if steep else ""
        lines.append(f"| {name} | {len(pairs)} | {shares} | {np.exp(np.median(ln)):.2f} | {beyond} |")
    return "\n".join(lines)


def choose(made: list[Case]) -> None:
    """For each table the constants that foretell the others best, and how well it is foretold with them."""
    names = list(dict.fromkeys(each.table for each in made))
    table, off = np.array([each.table for each in made]), {}
    for values in itertools.product(*CHOICES.values()):
        for key, value in zip(CHOICES, values, strict=True):
            setattr(missed, key, value)
        told = [pricing.off_plane_price(each.ranking, each.measurement) for each in made]
        off[values] = np.array([
            abs(np.log(price.rms_ln / case.below)) if price else np.nan
            for case, price in zip(made, told, strict=True)
        ])  # fmt: skip
        within = np.mean(off[values] <= np.log(WITHIN[0]))
        print(*values, f"middle error {_loss(off[values]):.3f}, within 25 % {100 * within:.0f} %", flush=True)
    left = np.concatenate([_left_out(each, table, off) for each in names])
    print("left out:", *(f"within {each} {100 * np.mean(left <= np.log(each)):.0f} %" for each in WITHIN))


def _left_out(name: str, table: np.ndarray, off: dict) -> np.ndarray:
    others = (table != name) & ~np.isin(table, list(UNSEEN))
    best = min(off, key=lambda each: _loss(off[each][others]))
    print(f"{name}: by the others {best}")
    return off[best][table == name]


def _loss(off: np.ndarray) -> float:
    return float(np.nanmean(np.minimum(off, 1.5)))


def _shown(price) -> str:
    grazing = f"{price.grazing:.3f}" if price and price.grazing else "-"
    return f"in the plane {price.in_plane:.3f}, foretold {price.rms_ln:.3f}, toward grazing {grazing}" if price else "-"


if __name__ == "__main__":
    main()
