"""Relative and absolute doubt of single values from how far they depart at which level, once more.

Median sizes in bins of equally many levels against √((relative level)² + absolute²), least mean |ln ratio|, over a grid
of what the bins themselves show. That mean is flat between the two middle bins of an even number: where several
points of the grid are as good, rounding decided which was taken, and all of them are given.
"""

from collections.abc import Sequence
from math import hypot, log
from statistics import median
from typing import NamedTuple

from mpmath import mpf

from .exact_errors import PER_MEDIAN

MOST_BINS, LEAST_BINS, IN_BIN = 12, 3, 20
SHARES = (mpf(1), mpf("0.7"))  # of what a bin shows
SHOWS = 0.7  # times the mean without an absolute part, to which it must come down
LEAST_GAIN = 0.1  # by which it must come down
TINY = 2.2250738585072014e-308  # 1/sr, the smallest normal double
FAINTEST = 1e-100  # of the highest level
LEAST_SIZE = 1e-12  # of a level
AS_GOOD = 1e-11  # of two means, where rounding decides


class Departure(NamedTuple):
    """One comparison: the level that puts it in order, as the double that it is, the same exactly, and how far."""

    order: float
    level: mpf  # [1/sr]
    size: mpf  # [1/sr], of either sign


def relative_and_absolute(departures: Sequence[Departure], in_bin: int = IN_BIN, shows: float = SHOWS) -> list:
    """(relative, absolute) of every choice that is as good as the best; none for too few departures."""
    highest = max((each.order for each in departures), default=0.0)
    known = sorted(
        (each for each in departures if each.order > max(TINY, FAINTEST * highest)), key=lambda each: each.order
    )
    count = min(len(known) // in_bin, MOST_BINS)
    if count < LEAST_BINS:
        return []
    levels, sizes = _bins(known, count)
    relative = _grid([size / level for size, level in zip(sizes, levels, strict=True)], 2 * count)
    absolute = [mpf(0), *_grid(sizes, 4 * count)]
    means = _means(levels, sizes, relative, absolute)
    alone = _as_good([row[0] for row in means])
    if shows >= 1:
        return _distinct([(relative[i], absolute[j]) for i, j in _best(means)])
    out, least = [], min(row[0] for row in means)
    for i, j in _best(means):
        hidden = absolute[j] < relative[i] * levels[0]
        if hidden or means[i][j] > shows * least or least - means[i][j] < LEAST_GAIN:
            out += [(relative[place], mpf(0)) for place in alone]
        else:
            out.append((relative[i], absolute[j]))
    return _distinct(out)


def _bins(known: list[Departure], count: int) -> tuple[list, list]:
    """Median level and size of as many bins, the first of which hold one more where they do not come out even."""
    each, more = divmod(len(known), count)
    levels, sizes, first = [], [], 0
    for number in range(count):
        some = known[first : first + each + (number < more)]
        first += len(some)
        levels.append(median(one.level for one in some))
        sizes.append(max(PER_MEDIAN * median(abs(one.size) for one in some), mpf(LEAST_SIZE) * levels[-1], mpf(TINY)))
    return levels, sizes


def _grid(values: list, steps: int) -> list:
    """Quantiles in even steps, and the lesser share of each."""
    at = [quantile(values, mpf(number) / steps) for number in range(steps + 1)]
    return [share * each for share in SHARES for each in at]


def quantile(values: Sequence, part):
    """Straight between two of them."""
    ordered = sorted(values)
    place = part * (len(ordered) - 1)
    low = min(int(place), len(ordered) - 2) if len(ordered) > 1 else 0
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (place - low) * (ordered[high] - ordered[low])


def _means(levels: list, sizes: list, relative: list, absolute: list) -> list[list[float]]:
    """Mean |ln ratio| of each pair, in doubles: they only choose."""
    bins = [(float(level), log(float(size))) for level, size in zip(levels, sizes, strict=True)]
    parts, every = [float(each) for each in relative], [float(each) for each in absolute]
    return [
        [sum(abs(log(max(hypot(one * level, other), TINY)) - ln) for level, ln in bins) / len(bins) for other in every]
        for one in parts
    ]


def _best(means: list[list[float]]) -> list[tuple[int, int]]:
    places = [(i, j) for i, row in enumerate(means) for j in range(len(row))]
    return [places[number] for number in _as_good([value for row in means for value in row])]


def _as_good(means: list[float]) -> list[int]:
    least = min(means)
    return [place for place, value in enumerate(means) if value <= least + AS_GOOD * (1 + least)]


def _distinct(pairs: list) -> list:
    return list(dict.fromkeys(pairs))
