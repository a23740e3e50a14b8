"""What gains of whole scans of a turned sample leave open of a row's numbers, once more.

    r = J δ + Z g + noise,   E Σ t²/n = σ² tr(n⁻¹G) + τ² tr(n⁻¹G²),   variance of δ by gains = τ² Σ ((JᵀJ)⁻¹ JᵀZ)²

Z has a column for each scan, d residual/d ln f; t = Zᵀr, n = diag ZᵀZ, G = ZᵀZ - ZᵀJ (JᵀJ)⁻¹ JᵀZ; σ² is that within
scans, as many times as neighbours and channels say the same; τ times Student's factor of tr(n⁻¹G) (Henderson 1953).
"""

from collections import defaultdict
from functools import lru_cache

from mpmath import fdot, fsum, mpf

from .exact_errors import Readings, numbers_of_turns, scan_order
from .exact_neighbours import alike_neighbours
from .rederived import CLOSE

FEWEST = 3  # scans beyond what the fit took of them
MOST_INCIDENCES = 64
MOST_CORRELATED = mpf("0.95")


class GainsUndecided(Exception):
    """Rounding decides whether scans stand farther apart than their noise lets them."""


@lru_cache(maxsize=4)
def scans_of_turns(data: Readings) -> list[int] | None:
    """The number of each row's scan, of one incidence under one turn; None where the sample was not turned, and of
    scattered incidence."""
    turns, angles = numbers_of_turns(data), [round(10 * each[0]) for each in data.angles]
    if not any(turns) or len(set(angles)) > MOST_INCIDENCES:
        return None
    known = sorted(set(zip(turns, angles, strict=True)))
    return [known.index(each) for each in zip(turns, angles, strict=True)]


def variances_by_gains(data: Readings, residual: dict, column: dict, columns: list[dict], inverse) -> list:
    """What gains add to the variance of each number; zeros where they do not show.

    Takes  residual, `column` d residual/d ln f, and `columns` d residual/d p, by row and channel; (JᵀJ)⁻¹.    Raises
    GainsUndecided.
    """
    scan, count = scans_of_turns(data), len(columns)
    nothing = [mpf(0)] * count
    if scan is None:
        return nothing
    size: dict[int, mpf] = defaultdict(mpf)
    together: dict[int, mpf] = defaultdict(mpf)
    for at, z in column.items():
        size[scan[at[0]]] += z * z
        together[scan[at[0]]] += z * residual[at]
    size = {each: n for each, n in size.items() if n}
    pull: dict[int, list] = {each: [mpf(0)] * count for each in size}
    for place, of_number in enumerate(columns):
        for at, slope in of_number.items():
            if column[at]:
                pull[scan[at[0]]][place] += slope * column[at]
    moved = {each: [fdot(zip(inverse[i, :], p, strict=True)) for i in range(count)] for each, p in pull.items()}
    taken = {each: fdot(zip(pull[each], moved[each], strict=True)) for each in size}
    left = len(size) - fsum(taken[each] / n for each, n in size.items())
    if left < FEWEST:
        return nothing
    between = fsum(together[each] ** 2 / n for each, n in size.items())
    noise = _noise(data, residual, column, {each: together[each] / n for each, n in size.items()}, scan, count)
    if abs(between - noise * left) <= CLOSE * between:
        raise GainsUndecided
    if between < noise * left:
        return nothing
    variance = (between - noise * left) / _squared(size, taken, pull, moved)
    student = 1 + mpf("1.25") / left + mpf("1.53") / left**2
    return [student**2 * variance * fsum(each[i] ** 2 for each in moved.values()) for i in range(count)]


def _squared(size: dict, taken: dict, pull: dict, moved: dict) -> mpf:
    """tr(n⁻¹G²)."""
    count = len(next(iter(pull.values())))
    crossed = [
        fsum(pull[each][i] * pull[each][j] / n for each, n in size.items())
        * fsum(moved[each][i] * moved[each][j] for each in size)
        for i in range(count)
        for j in range(count)
    ]
    return fsum(n - 2 * taken[each] for each, n in size.items()) + fsum(crossed)


def _noise(data: Readings, residual: dict, column: dict, mean: dict, scan: list[int], fitted: int) -> mpf:
    """Variance of one value within its scan, as many times as neighbours and channels say the same."""
    within: list[list] = [[None] * len(data.wavelengths) for _ in data.angles]
    for (row, channel), z in column.items():
        if z:
            within[row][channel] = residual[row, channel] - z * mean[scan[row]]
    squares = [v * v for row in within for v in row if v is not None]
    correlation, _, common = alike_neighbours(within, [scan_order(data)])
    widened = (1 + mpf(correlation)) / (1 - min(mpf(correlation), MOST_CORRELATED))
    return fsum(squares) / max(len(squares) - fitted - len(mean), 1) * widened * common
