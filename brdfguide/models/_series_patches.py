"""The sum for few samples: parts of its cells with as many coefficients each, which every sample fetches for itself.

A cell of `_series_cells` divided into 8 by 8 patches needs 7 by 7 coefficients in each. So no sample has to be sorted,
none waits for another, and a few calls do for all of them, whatever cells they lie in. Patches are formed from a cell's
own polynomial when it is first touched, and kept.
"""

from functools import cache
from math import log
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
    SPLIT,
    by_cells,
    compute_cells,
    to_powers,
)

PATCHES = 8  # along each side of a cell
TERMS = 7  # powers along each side of a patch
ROUND = 1024  # samples at once, so that what is fetched for them stays in the processor's cache
UNKNOWN, BY_TERMS = -2, -1  # in place of a cell: not yet divided; to be summed term by term
BEYOND = OCTAVES_G * OCTAVES_Y * PARTS  # the number of what lies in no cell
PLACES = np.full(BEYOND + 1, UNKNOWN, np.intp)  # of each cell among those that were divided
PLACES[BEYOND] = BY_TERMS
COEFFICIENTS = [np.zeros((PATCHES * PATCHES, TERMS * TERMS))]  # of each patch, cell after cell; longer than it need be
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
    cell, patch, t_g, t_y, split = _places(g, y)
    place = PLACES.take(cell)
    least = place.min()
    if least == UNKNOWN:
        _divide(sorted({*cell[place == UNKNOWN].tolist()}))
        place = PLACES.take(cell)
        least = place.min()
    place *= PATCHES * PATCHES
    place += patch
    if least == BY_TERMS:
        place = np.maximum(place, 0)
    fetched = COEFFICIENTS[0].take(place, axis=0)  # of each sample in turn, and in the next line of each power
    _polynomials(np.ascontiguousarray(fetched.T).reshape(TERMS, TERMS, -1), t_g, t_y, out)
    if len(out) > 1:
        out[2] *= split
        out[2] *= 2 * PATCHES / log(2)
        out[2] /= np.maximum(g, 4.0) + y
        out[1] *= 2 * PATCHES / log(2)
        out[1] -= np.where(g > 4, out[2] * y, 0.0)
    if least == BY_TERMS:
        rows = np.flatnonzero(PLACES.take(cell) == BY_TERMS)
        out[:, rows] = by_terms(g[rows], y[rows])[: len(out)]


def _places(g, y):
    """The cell of each sample, the patch of the cell, and where it lies in it: -1..1 along both sides; and into how
    many parts the octave is divided."""
    a, b = np.log2(g), np.log2(1 + y / np.maximum(g, 4.0))
    a -= G_FIRST
    a *= PATCHES
    row, column = np.floor(a), np.floor(b)
    a -= row
    outside = (row < 0) | (row >= OCTAVES_G * PATCHES) | (column >= OCTAVES_Y)
    some = outside.any()
    if some:
        row, column = np.where(outside, 0.0, row), np.where(outside, 0.0, column)
    b -= column
    row, octave = row.astype(np.intp), column.astype(np.intp)
    octave += (row >> 3) * OCTAVES_Y
    split = SPLIT.take(octave)
    b *= split
    b *= PATCHES
    part = np.floor(b)
    b -= part
    part = part.astype(np.intp)
    patch = (part & 7) * PATCHES
    patch += row & 7
    octave *= PARTS
    octave += part >> 3
    if some:
        octave = np.where(outside, BEYOND, octave)
    return octave, patch, 2 * a - 1, 2 * b - 1, split


def _polynomials(coefficients, t_g, t_y, out) -> None:
    """Polynomials with coefficients (powers of t_y, of t_g, samples) into out[0]; their derivatives by t_g and t_y
    into out[1] and out[2] where these exist."""
    inner = coefficients[:, -1] * t_g
    slope = coefficients[:, -1].copy() if len(out) > 1 else None
    for power in range(TERMS - 2, -1, -1):
        inner += coefficients[:, power]
        if power:
            if slope is not None:
                slope *= t_g
                slope += inner
            inner *= t_g
    _along(inner, t_y, out[0], out[2] if slope is not None else None)
    if slope is not None:
        _along(slope, t_y, out[1])


def _along(coefficients, t, value, slope=None) -> None:
    """A polynomial with coefficients (powers of t, samples), and its derivative."""
    np.multiply(coefficients[-1], t, out=value)
    if slope is not None:
        slope[:] = coefficients[-1]
    for power in range(TERMS - 2, -1, -1):
        value += coefficients[power]
        if power:
            if slope is not None:
                slope *= t
                slope += value
            value *= t


def _divide(codes) -> None:
    """Patches of these cells behind those that are known; of what is no cell that it is summed term by term."""
    compute_cells(codes)
    with GROWS:
        codes = [code for code in codes if PLACES[code] == UNKNOWN]
        cells = [cell for code in codes if (cell := CELLS[code]) is not None]
        first, table, size = int(PLACES.max()) + 1, COEFFICIENTS[0], PATCHES * PATCHES
        if (first + len(cells)) * size > len(table):
            table = np.zeros((2 * (first + len(cells)) * size, TERMS * TERMS))
            table[: first * size] = COEFFICIENTS[0][: first * size]
        for place, cell in enumerate(cells, first):
            table[place * size : (place + 1) * size] = _patches(cell[0])
        COEFFICIENTS[0] = table  # before anybody hears where they lie
        place = first
        for code in codes:
            known = CELLS[code] is not None
            PLACES[code] = place if known else BY_TERMS
            place += known


def _patches(cell) -> np.ndarray:
    """(patches, powers of t_y and of t_g) from the powers of a whole cell."""
    n_y, n_g = cell.shape
    both = (_to_patches(n_y) @ cell @ _to_patches(n_g).T).reshape(PATCHES, TERMS, PATCHES, TERMS)
    return both.transpose(0, 2, 1, 3).reshape(PATCHES * PATCHES, TERMS * TERMS)


@cache
def _to_patches(n):
    """(patches powers, n): the powers of t in each patch of -1..1 from those over all of it."""
    nodes = np.cos(np.pi * (np.arange(TERMS) + 0.5) / TERMS)
    at = (2 * np.arange(PATCHES)[:, None] + 1 + nodes) / PATCHES - 1
    return (to_powers(TERMS) @ transform(TERMS) @ at[:, :, None] ** np.arange(n)).reshape(PATCHES * TERMS, n)
