"""The sum for few samples: parts of its cells with as many coefficients each, which every sample fetches for itself.

A cell of `_series_cells` divided into 16 patches along g, and along y into as many as it takes, needs in each no power
above the fifth. So no sample has to be sorted, none waits for another, and a few calls do for all of them, whatever
cells they lie in. Patches are formed from a cell's own polynomial when it is first touched, and kept.
"""

from functools import cache
from math import comb, log
from threading import Lock

import numpy as np

from ..numerics.chebyshev import transform
from ._series import by_terms
from ._series_cells import (
    CELLS,
    G_FIRST,
    MANY,
    OCTAVES_G,
    OCTAVES_Y,
    PARTS,
    SIZES,
    SPLIT,
    by_cells,
    compute_cells,
    to_powers,
)

ALONG_G = 16  # patches of a cell along g
ALONG_Y = (4, 8, 16, 32)  # patches along y: the fewest that keep to TAIL
TAIL = 1e-11  # of ln S, or of 1/650 of its largest in the cell: what the powers left out may come to
DEGREE = 5  # greatest sum of both powers
MOST = max(map(max, SIZES))  # powers of a cell
TERMS = (DEGREE + 1) * (DEGREE + 2) // 2
ROUND = 1024  # samples at once, so that what is fetched for them stays in the processor's cache
UNKNOWN, BY_TERMS = -2, -1  # in place of a cell: not yet divided; to be summed term by term
BEYOND = OCTAVES_G * OCTAVES_Y * PARTS  # the number of what lies in no cell
PLACES = np.full(BEYOND + 1, UNKNOWN, np.intp)  # of each cell its first patch
PLACES[BEYOND] = BY_TERMS
COUNTS = np.ones(BEYOND + 1)  # of each cell its patches along y
COEFFICIENTS = [np.zeros((1, TERMS))]  # of each patch, cell after cell; longer than it need be
KNOWN = [0]  # patches
GROWS = Lock()


def ln_series(g, y, derivatives: bool = False):
    """ln S to 2e-11, for g > 0 and y >= 0, which broadcast.

    With `derivatives`: (ln S, d ln S/d ln g, d ln S/dy), these to 1e-8.
    """
    g, y = np.broadcast_arrays(np.asanyarray(g, float), np.asanyarray(y, float), subok=True)
    shape, g, y = g.shape, g.ravel(), y.ravel()
    if g.size >= MANY:
        out = by_cells(g, y, derivatives)
    else:
        out = np.empty((3 if derivatives else 1, g.size))
        for first in range(0, g.size, ROUND):
            part = slice(first, first + ROUND)
            _evaluate(g[part], y[part], out[:, part])
    values = [row.reshape(shape) for row in out]
    return tuple(values) if derivatives else values[0]


def _evaluate(g, y, out) -> None:
    """ln S into out[0], its derivatives by ln g and by y into out[1] and out[2] where these exist."""
    cell, patch, x_g, x_y, split, larger = _places(g, y)
    place = PLACES.take(cell)
    least = place.min()
    if least == UNKNOWN:
        _divide(sorted({*cell[place == UNKNOWN].tolist()}))
        place = PLACES.take(cell)
        least = place.min()
    count = COUNTS.take(cell)
    x_y *= count
    row = np.floor(x_y)
    x_y -= row
    x_y -= 0.5
    row *= ALONG_G
    place += row.astype(np.intp)
    place += patch
    fetched = COEFFICIENTS[0].take(place, axis=0, mode="clip")  # of each sample in turn; in the next line of each power
    _polynomials(np.ascontiguousarray(fetched.T), x_g, x_y, out)
    if len(out) > 1:
        larger += y
        split *= count
        split /= larger
        out[2] *= split
        out[2] *= 1 / log(2)
        out[1] *= ALONG_G / log(2)
        out[1] -= np.where(g > 4, out[2] * y, 0.0)
    if least == BY_TERMS:
        rows = np.flatnonzero(PLACES.take(cell) == BY_TERMS)
        out[:, rows] = by_terms(g[rows], y[rows])[: len(out)]


def _places(g, y):
    """The cell of each sample, the patch along g, where in it: -1/2..1/2, and where along y in the cell: 0..1; into
    how many parts the octave is divided, and max(g, 4)."""
    larger = np.maximum(g, 4.0)
    a, b = np.log2(g), y / larger
    a -= G_FIRST
    b += 1
    np.log2(b, out=b)
    inside = None
    if not (a.min() >= 0 and a.max() < OCTAVES_G and b.max() < OCTAVES_Y):
        inside = (a >= 0) & (a < OCTAVES_G) & (b < OCTAVES_Y)
        a, b = np.where(inside, a, 0.0), np.where(inside, b, 0.0)
    a *= ALONG_G
    row, column = np.floor(a), np.floor(b)
    a -= row
    a -= 0.5
    b -= column
    patch, cell = row.astype(np.intp), column.astype(np.intp)
    cell += patch // ALONG_G * OCTAVES_Y
    patch %= ALONG_G
    split = SPLIT.take(cell)
    b *= split
    np.floor(b, out=column)
    b -= column
    cell *= PARTS
    cell += column.astype(np.intp)
    if inside is not None:
        cell = np.where(inside, cell, BEYOND)
    return cell, patch, a, b, split, larger


def _polynomials(coefficients, x_g, x_y, out) -> None:
    """Polynomials with coefficients (powers, samples), which this overwrites, into out[0]; their derivatives by x_g
    and x_y into out[1] and out[2] where these exist. The greatest power of x_y comes first, in each of these the
    powers of x_g that it goes with from none upward."""
    sums, slopes, first = coefficients[:1], None, 1
    for count in range(1, DEGREE + 1):
        if len(out) > 1:
            steeper = np.empty((count, x_y.size))
            if slopes is not None:
                np.multiply(slopes, x_y, out=steeper[:-1])
                steeper[:-1] += sums[:-1]
            steeper[-1] = sums[-1]
            slopes = steeper
        sums *= x_y
        following = coefficients[first : first + count + 1]
        following[:-1] += sums
        sums, first = following, first + count + 1
    _along(sums, x_g, out[0], out[1] if slopes is not None else None)
    if slopes is not None:
        _along(slopes, x_g, out[2])


def _along(coefficients, x, value, slope=None) -> None:
    """A polynomial with coefficients (powers of x, samples), and its derivative."""
    np.multiply(coefficients[-1], x, out=value)
    if slope is not None:
        slope[:] = coefficients[-1]
    for power in range(len(coefficients) - 2, -1, -1):
        value += coefficients[power]
        if power:
            if slope is not None:
                slope *= x
                slope += value
            value *= x


def _divide(codes) -> None:
    """Patches of these cells behind those that are known; of what is no cell that it is summed term by term."""
    compute_cells(codes)
    with GROWS:
        codes = [code for code in codes if PLACES[code] == UNKNOWN]
        PLACES[[code for code in codes if CELLS[code] is None]] = BY_TERMS
        cells = {code: cell[0] for code in codes if (cell := CELLS[code]) is not None}
        counts = _enough(list(cells.values()))
        first, last = KNOWN[0], KNOWN[0] + ALONG_G * sum(counts)
        if last > len(COEFFICIENTS[0]):
            table = np.zeros((2 * last, TERMS))
            table[:first] = COEFFICIENTS[0][:first]
            COEFFICIENTS[0] = table
        for (code, cell), count in zip(cells.items(), counts, strict=True):
            COEFFICIENTS[0][first : first + ALONG_G * count] = _patches(cell, count)
            COUNTS[code] = count
            PLACES[code] = first  # last of all: now anybody may look there
            first += ALONG_G * count
        KNOWN[0] = first


def _patches(cell, count) -> np.ndarray:
    """(patches, powers as `_polynomials` takes them) from the powers of a whole cell."""
    n_y, n_g = cell.shape
    lines = (_to_patches(count).reshape(-1, MOST)[:, :n_y] @ cell).reshape(count, -1)
    return (lines @ _to_powers(n_g)).reshape(-1, TERMS)


def _enough(cells) -> list[int]:
    """Of each cell the patches along y for which the powers left out stay below TAIL, judged by the first of them at
    the cell's corners and middles."""
    powers = np.zeros((len(cells), MOST, MOST))
    for place, cell in enumerate(cells):
        powers[place, : len(cell), : cell.shape[1]] = cell
    slopes = np.abs(_slopes() @ powers @ _slopes().T).reshape(-1, DEGREE + 2, 3, DEGREE + 2, 3)
    orders = np.arange(DEGREE + 2)
    first = slopes[:, orders, :, orders[::-1]].reshape(DEGREE + 2, -1)  # orders, and cells at their points
    tails = (_weights() @ first).reshape(len(ALONG_Y), len(cells), 9).max(axis=2)
    too_few = tails[:-1] > TAIL * np.maximum(1.0, np.abs(powers[:, 0]).max(axis=1) / 650)
    return [ALONG_Y[few] for few in too_few.sum(axis=0).tolist()]


@cache
def _weights():
    """(numbers of patches along y, orders a): what (d/dt_y)^a (d/dt_g)^b/(a! b!) of a cell, a + b = DEGREE + 1, comes
    to in a patch, where its lower powers take of it what they can."""
    order = np.arange(DEGREE + 2)
    left = 2.0 ** -np.where(order % (DEGREE + 1) == 0, DEGREE, DEGREE - 1)
    return left / np.array(ALONG_Y)[:, None] ** order / ALONG_G ** order[::-1]


@cache
def _slopes():
    """(orders · 3, MOST): (d/dt)^order/order! of the powers of t at -1, 0 and 1."""
    return np.array(
        [
            [comb(power, order) * float(t) ** max(power - order, 0) for power in range(MOST)]
            for order in range(DEGREE + 2)
            for t in (-1, 0, 1)
        ]
    )


@cache
def _to_patches(count):
    """(patches, degrees, MOST): Chebyshev's coefficients in each patch of -1..1 from the powers of t over all of
    it."""
    nodes = np.cos(np.pi * (np.arange(DEGREE + 2) + 0.5) / (DEGREE + 2))
    at = (2 * np.arange(count)[:, None] + 1 + nodes) / count - 1
    powers = np.vander(at.ravel(), MOST, increasing=True).reshape(count, -1, MOST)
    return transform(DEGREE + 2)[:-1] @ powers


@cache
def _to_powers(n_g):
    """(degrees along y · n_g, patches along g · powers as `_polynomials` takes them): from Chebyshev's coefficients
    along y and powers of t_g. Of Chebyshev's polynomials those beyond DEGREE are left out, not of the powers."""
    one = to_powers(DEGREE + 1) * 2.0 ** np.arange(DEGREE + 1)[:, None]  # of x = t/2
    degree = np.arange(DEGREE + 1)
    kept = degree[:, None] + degree <= DEGREE
    along_y, along_g = np.nonzero(kept[::-1])
    both = one[DEGREE - along_y].T[:, None] * one[along_g].T * kept[:, :, None]  # degrees along y, along g, powers
    along_g = _to_patches(ALONG_G)[:, :, :n_g].transpose(2, 0, 1)
    return (along_g.reshape(-1, DEGREE + 1) @ both).reshape((DEGREE + 1) * n_g, -1)
