"""Which directions are neighbours, and how far what a law leaves is alike there and in all channels."""

from dataclasses import replace
from functools import lru_cache
from math import fsum as rounded_once
from math import sqrt as root
from operator import mul

from mpmath import mpf, sqrt

from .exact_errors import SMALLEST, Readings, block_number, neighbours_of_scans, scan_order
from .rederived import Comparisons

MOST_VALUES = 75_000  # beyond which a fit settles on some of them
DECIMALS = 9  # of cosines by which neighbours are put in order
FEWEST_PAIRS = 8


def with_values(data: Readings, residuals: list[list]) -> tuple[Readings, list[list]]:
    """The directions where a fit looks at a value in any channel, and the residuals there."""
    kept, few = _looked_at(data)
    return few, [residuals[place] for place in kept]


@lru_cache(maxsize=4)
def _looked_at(data: Readings) -> tuple[list[int], Readings]:
    """Once for all rows: which directions, and their values."""
    kept = [place for place, known in enumerate(data.looked_at) if any(known)]
    if len(kept) == len(data.angles):
        return kept, data
    few = replace(
        data,
        angles=tuple(data.angles[place] for place in kept),
        values=tuple(data.values[place] for place in kept),
        stated=None if data.stated is None else tuple(data.stated[place] for place in kept),
        taken=None if data.taken is None else [data.taken[place] for place in kept],
        beyond=tuple(data.beyond[place] for place in kept) if data.beyond else (),
    )
    return kept, few


def compare_discrepancy(told: dict, residuals: list[list], place: str, data: Readings, found: Comparisons) -> None:
    """How far neighbours err together, as a flag `discrepancy` tells it."""
    few, left = with_values(data, residuals)
    if len(few.angles) * len(few.wavelengths) > MOST_VALUES:
        return
    correlation, score, _ = alike_neighbours(left, orders_of_neighbours(few))
    found.check(f"{place}.correlation", told["correlation"], correlation)
    found.check(f"{place}.z", told["z"], score)


def alike_neighbours(rows: list[list], orders: list[list[int]]) -> tuple[float, float, float]:
    """Largest correlation of neighbours over some orders, its size in standard deviations, and how many channels say
    the same.

    From the residuals as doubles, with sums that are rounded once: 1e-15 of a correlation is lost.
    """
    rough = [[None if v is None else float(v) for v in row] for row in rows]
    common, worst, score = channels_alike(rough), 0.0, 0.0
    for order in orders:
        pairs = [
            (a, b)
            for one, other in zip(order[1:], order, strict=False)
            for a, b in zip(rough[one], rough[other], strict=True)
            if a is not None and b is not None
        ]
        if len(pairs) < FEWEST_PAIRS:
            continue
        power = rounded_once(a * a + b * b for a, b in pairs) / 2
        correlation = rounded_once(a * b for a, b in pairs) / power if power else 0.0
        if correlation > worst:
            worst, score = correlation, correlation * root(len(pairs) / common)
    return worst, score, common


def channels_alike(rows: list[list]) -> float:
    """How many channels say the same: Σ r²_cd over the number of channels, less what chance gives."""
    channels = len(rows[0])
    if channels == 1:
        return 1.0
    columns = [[0.0 if row[c] is None else row[c] for row in rows] for c in range(channels)]
    squares = [rounded_once(v * v for v in column) for column in columns]
    sizes, total = [max(each, float(SMALLEST)) for each in squares], float(sum(each > 0 for each in squares))
    for a in range(channels):
        for b in range(a):
            both = rounded_once(map(mul, columns[a], columns[b]))
            total += 2 * (both / sizes[a]) * (both / sizes[b])
    chance = (channels - 1) / max(len(rows), 1)
    return min(max(total / channels - chance, 1.0), float(channels))


@lru_cache(maxsize=4)
def orders_of_neighbours(data: Readings) -> list[list[int]]:
    """Rows along scans, by tilt of the half vector, by half angle, by reflected angle; those alike as in the file."""
    half = [float(sight.pair.cos_d) for sight in data.sights]
    tilt = [float(sqrt(max(sight.pair.tan2_h, mpf(0)))) for sight in data.sights]
    upright = [round(float(1 / (1 + sight.pair.tan2_h)), DECIMALS) for sight in data.sights]
    numbers = range(len(half))
    return [
        scan_order(data),
        sorted(numbers, key=lambda s: (round(tilt[s], 3), round(half[s], DECIMALS))),
        sorted(numbers, key=lambda s: (round(half[s], 3), -upright[s])),
        sorted(numbers, key=lambda s: (round(10 * data.angles[s][2]) / 10, -upright[s])),
    ]


@lru_cache(maxsize=4)
def ways_to_cut(data: Readings) -> list[list[int]]:
    """The number of the block of each row: along scans by incidence, in the other orders evenly."""
    ways = [neighbours_of_scans(data)]
    for order in orders_of_neighbours(data)[1:]:
        blocks = [0] * len(order)
        for rank, row in enumerate(order):
            blocks[row] = block_number(rank, len(order))
        ways.append(blocks)
    return ways
