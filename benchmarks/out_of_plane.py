"""The report's open task: laws fitted in the plane of incidence, and judged out of it.

    python benchmarks/out_of_plane.py [--write docs/out_of_plane.md --plot docs/pictures/out_of_plane.png]

Every lobe of the catalogue, on a Lambertian body, is fitted to the directions of each given table that lie in the
plane of incidence, and to all of them. Told is the error over the directions outside the plane of the first over that
of the second, and where it comes from. In under five minutes.
"""

import argparse
import os
import sys
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np
from matplotlib.ticker import NullLocator

from benchmarks.given_tables import rms, tables
from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.errors import BrdfguideError
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.fit import ln_residuals
from brdfguide.report.figures import style

WIDE = ("openpbr", "standard-surface", "disney", "gltf")  # shaders: bundles of the lobes below
FLAT_DEG = (0.5, 1.5, 3.0)  # from the plane, the first that leaves enough directions
LEAST = 40
IN_PLANE, OUTSIDE = 160, 700  # directions of a fit, and to judge by
BESIDE_DEG = 25.0  # tilt of the half vector: beside the highlight
GRAZING_DEG = 65.0
TRAVELS, STAYS = 1.25, 1.5
NINTH = {"color": style.INK, "marker": "h"}


@dataclass(frozen=True)
class Cell:
    """One law on one table."""

    inside: float  # error in the plane, of the fit there
    flat: float  # error outside, of the fit in the plane
    whole: float  # error outside, of the fit to all
    beside: float  # mean ln(model/data) outside beside the highlight, of the fit in the plane less that of the whole
    across: float  # far from it
    grazing: float
    colour: float  # rms over channels of what is left of them, over the error

    @property
    def cost(self) -> float:
        return self.flat / self.whole


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", type=Path)
    parser.add_argument("--plot", type=Path)
    asked = parser.parse_args()
    laws = [models.get(name) for name in _names()]
    cells: dict[str, dict[str, Cell]] = defaultdict(dict)
    for name, _, judged in tables():
        flat = in_plane(judged)
        print(f"{name}: {len(flat)} of {len(judged.brdf)} directions in the plane", file=sys.stderr, flush=True)
        if len(flat) >= LEAST:
            for model in laws:
                cell = one(model, judged, flat)
                if cell is not None:
                    cells[model.name][name] = cell
    text = page(cells)
    print(text)
    if asked.write:
        head = asked.write.read_text().split(MARK)[0] if asked.write.exists() else ""
        asked.write.write_text(head + MARK + "\n\n" + text)
    if asked.plot:
        with style.look():
            style.save(picture(cells), asked.plot)


MARK = "<!-- from here on written by benchmarks/out_of_plane.py -->"


def _names() -> list[str]:
    """Every law with a lobe of its own, on a body; bodies alone."""
    found = []
    for law in models.every():
        if law.name in WIDE or law.turns or law.is_coat or law.is_mirror:
            continue
        found.append(law.name if law.is_body else f"lambertian+{law.name}")
    return found


def in_plane(table: Measurement) -> np.ndarray:
    """Rows in the plane of incidence, as near to it as leaves enough of them."""
    for width in FLAT_DEG:
        rows = np.flatnonzero(table.geom.off_plane_deg[:, 0] <= width)
        if len(rows) >= LEAST:
            break
    return rows[:: -(-len(rows) // IN_PLANE)]


def one(model, table: Measurement, flat: np.ndarray) -> Cell | None:
    """One law on one table; None where it does not converge."""
    outside = np.flatnonzero(table.geom.off_plane_deg[:, 0] > 10)
    outside = outside[:: -(-len(outside) // OUTSIDE)]
    try:
        from_plane = fitting.fit(model, table[flat])
        from_all = fitting.fit(model, table[np.union1d(flat, outside)])
    except BrdfguideError:
        return None
    part = table[outside]
    left, best = (ln_residuals(each.surface, part) for each in (from_plane, from_all))
    tilt = np.degrees(np.arctan(np.sqrt(part.geom.tan2_h)))[:, 0]
    steep = np.maximum(part.geom.theta_i_deg, part.geom.theta_r_deg)[:, 0]
    beside, grazing = tilt < BESIDE_DEG, steep > GRAZING_DEG
    known = np.isfinite(left).any(axis=1)
    left, best, beside, grazing = left[known], best[known], beside[known], grazing[known]
    shift = np.nanmean(left, axis=1) - np.nanmean(best, axis=1)
    return Cell(
        inside=rms(from_plane.residuals),
        flat=rms(left),
        whole=rms(best),
        beside=_mean(shift[beside & ~grazing]),
        across=_mean(shift[~beside & ~grazing]),
        grazing=_mean(shift[grazing]),
        colour=rms(left - np.nanmean(left, axis=1, keepdims=True)) / rms(left),
    )


def _mean(values) -> float:
    return float(np.nanmean(values)) if len(values) else float("nan")


def page(cells) -> str:
    """Laws in order of what the plane costs them, with why."""
    order = sorted(cells, key=lambda law: np.median([each.cost for each in cells[law].values()]))
    lines = [
        "| law | cost of the plane | worst, on | tables | error outside | beside the highlight | far from it | "
        "toward grazing | colour |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for law in order:
        row = cells[law]
        cost = {name: each.cost for name, each in row.items()}
        worst = max(cost, key=lambda name: cost[name])
        whole = np.median([each.whole for each in row.values()])
        zones = [
            np.nanmedian([getattr(each, zone) for each in row.values()]) for zone in ("beside", "across", "grazing")
        ]
        lines.append(
            f"| {law} | {np.median(list(cost.values())):.2f} | {cost[worst]:.2f}, {worst} | {len(row)} | {whole:.2f} | "
            f"{' | '.join(f'{100 * np.expm1(each):+.0f} %' for each in zones)} | "
            f"{np.median([each.colour for each in row.values()]):.2f} |"
        )
    return "\n".join([*lines, "", *_sums(cells, order)]) + "\n"


def _sums(cells, order) -> list[str]:
    """What the columns say in all."""
    costs = {law: float(np.median([each.cost for each in cells[law].values()])) for law in order}
    travels = [law for law in order if costs[law] <= TRAVELS]
    stays = [law for law in order if costs[law] > STAYS]
    every = [each.cost for law in order for each in cells[law].values()]
    by_table: dict[str, list[float]] = defaultdict(list)
    for law in order:
        for name, each in cells[law].items():
            by_table[name].append(each.cost)
    dear = ", ".join(f"{name} {np.median(each):.2f}" for name, each in sorted(by_table.items()))
    return [
        f"Over all laws and tables the plane costs {np.median(every):.2f} times (middle), "
        f"{np.quantile(every, 0.9):.2f} times in one of ten cases. By table (middle over the laws): {dear}.",
        "",
        f"Travel, at most {TRAVELS:g} times in the middle: {', '.join(travels) or 'none'}.",
        "",
        f"Do not, more than {STAYS:g} times: {', '.join(stays) or 'none'}.",
    ]


def picture(cells):
    """Every law a line of dots, one for each table, in order of the middle."""
    order = sorted(cells, key=lambda law: np.median([each.cost for each in cells[law].values()]), reverse=True)
    names = sorted({name for row in cells.values() for name in row})
    fig = style.figure(180, 30 + 5.6 * len(order))
    axis = fig.subplots()
    for number, name in enumerate(names):
        places = [(cells[law][name].cost, place) for place, law in enumerate(order) if name in cells[law]]
        look = {"color": style.COLOURS[number], "marker": style.MARKERS[number]} if number < 8 else NINTH
        axis.scatter(*zip(*places, strict=True), s=16, linewidths=0, alpha=0.85, label=name, zorder=2, **look)
    middles = [np.median([each.cost for each in cells[law].values()]) for law in order]
    axis.plot(middles, range(len(order)), "|", color=style.INK, ms=11, mew=1.4, label="middle of the tables", zorder=3)
    axis.axvline(1, color=style.INK, lw=0.7)
    axis.set_xscale("log")
    axis.set_xticks([1, 1.2, 1.5, 2, 3, 5], ["1", "1.2", "1.5", "2", "3", "5"])
    axis.xaxis.set_minor_locator(NullLocator())
    axis.set_xlim(0.9, max(3.0, 1.05 * max(each.cost for row in cells.values() for each in row.values())))
    axis.set_yticks(range(len(order)), [law.removeprefix("lambertian+") for law in order])
    axis.set_ylim(-0.7, len(order) - 0.3)
    axis.grid(True, axis="both")
    axis.set_xlabel("error outside the plane of a fit in the plane, over that of a fit to all directions")
    fig.legend(loc="outside upper center", ncols=4)
    return fig


if __name__ == "__main__":
    main()
