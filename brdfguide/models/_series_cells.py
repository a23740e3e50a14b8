"""The same sum at a tenth of the cost: ln S as polynomials in cells of log2 g and log2(1 + y/max(g, 4)).

Each cell is one octave in g and an octave or a part of one in the other variable, finer where the sum hops from one
order to the next. In these logarithms 8 by 11 coefficients do on average, since the nearest zeros of S lie at
imaginary parts of ln g near π. A cell is computed from the terms when first touched, and kept; samples outside all
cells are summed term by term. Of many samples those of a cell are products of matrices; few would pay more for the
calls, and fetch the coefficients of a part of their cell (`_series_patches`).
"""

from functools import cache
from math import log

import numpy as np

from ..numerics.chebyshev import transform
from ._series import by_products, by_terms, peak_of_summand

TAIL = 1e-12  # of ln S: smaller Chebyshev coefficients are dropped
NOISE = 4e-15  # of the largest |ln S| of a cell: below it coefficients are rounding, and are dropped
SIZES = ((12, 16), (20, 20))  # nodes along g and along y, tried in turn
G_FIRST = -42  # log2 of the least g that has a cell
OCTAVES_G = 70  # of g that have cells
OCTAVES_Y = 16  # of 1 + y/max(g, 4) that have cells
PARTS = 8  # most into which an octave of the second is divided
OUTSIDE = 2**16 - 1  # the number of what lies in no cell
BLOCK = 4096  # samples at once, so that they stay in the processor's cache
MANY = 16_384  # samples from which on those of a cell are evaluated together: below, calls cost more than products


def by_cells(g, y, derivatives: bool = False):
    """ln S, with its derivatives by ln g and by y: three rows, or one. Takes flat g > 0 and y >= 0."""
    code, t_g, t_y = np.empty(g.size, np.uint16), np.empty_like(g), np.empty_like(g)
    for first in range(0, g.size, BLOCK):
        part = slice(first, first + BLOCK)
        code[part], t_g[part], t_y[part] = _places(g[part], y[part])
    order = np.argsort(code, kind="stable")
    code, t_g, t_y = code[order], t_g[order], t_y[order]
    starts = np.flatnonzero(np.diff(code, prepend=-1))
    touched = code[starts].tolist()
    compute_cells(touched)
    groups = [
        (CELLS[each], start, stop)
        for each, start, stop in zip(touched, starts.tolist(), [*starts[1:].tolist(), code.size], strict=True)
    ]
    out = np.empty((3 if derivatives else 1, code.size))
    _evaluate([group for group in groups if group[0] is not None], t_g, t_y, out)
    if derivatives:
        _chain(code, out, g[order], y[order])
    for cell, start, stop in groups:
        if cell is None:
            rows = order[start:stop]
            out[:, start:stop] = by_terms(g[rows], y[rows])[: len(out)]
    back = np.empty_like(order)
    back[order] = np.arange(order.size)
    return out.take(back, axis=1)


def _places(g, y):
    """The cell of each sample, and where it lies in it: -1..1 along both sides."""
    a, b = np.log2(g), np.log2(1 + y / np.maximum(g, 4.0))
    row, column = np.floor(a), np.floor(b)
    t_g = 2 * (a - row) - 1
    row -= G_FIRST
    outside = (row < 0) | (row >= OCTAVES_G) | (column >= OCTAVES_Y)
    if outside.any():
        row, column = np.where(outside, 0.0, row), np.where(outside, 0.0, column)
    octave = (row * OCTAVES_Y + column).astype(np.intp)
    b = (b - column) * SPLIT.take(octave)
    part = np.floor(b)
    code = octave * PARTS + part.astype(np.intp)
    if outside.any():
        code[outside] = OUTSIDE
        b = np.where(outside, part, b)
    return code.astype(np.uint16), t_g, 2 * (b - part) - 1


def _split():
    """Parts of each octave: the peaks of neighbouring orders stand apart by π/u in ln y."""
    g = 2.0 ** np.arange(G_FIRST, G_FIRST + OCTAVES_G)[:, None]
    y = (2.0 ** (np.arange(OCTAVES_Y) + 0.3) - 1) * np.maximum(g, 4)
    u = peak_of_summand(np.broadcast_to(g, y.shape), y)[0]
    return np.select([u < 1.3, u < 4.5, u < 9], [1.0, 2.0, 4.0], 8.0).ravel()


SPLIT = _split()
CELLS: dict[int, np.ndarray | None] = {
    OUTSIDE: None
}  # ln S and its slopes by t_g and t_y: powers of t_y in rows, of t_g in columns; None: not resolved


def compute_cells(codes) -> None:
    """Those not yet known; those that the smaller size does not resolve with the larger, else they stay sums of
    terms."""
    codes = [code for code in codes if code not in CELLS]
    for size in SIZES:
        if not codes:
            return
        along_g, along_y = (np.cos(np.pi * (np.arange(count) + 0.5) / count) for count in size)
        octave, part = np.divmod(np.array(codes), PARTS)
        row, column = np.divmod(octave, OCTAVES_Y)
        g = 2.0 ** (G_FIRST + row[:, None] + (1 + along_g) / 2)
        b = column[:, None] + (part[:, None] + (1 + along_y) / 2) / SPLIT[octave][:, None]
        values = _at_nodes(g, 2.0**b - 1)
        by_g, by_y = (transform(count) for count in size)
        tails = TAIL + NOISE * np.abs(values).max(axis=(1, 2))
        CELLS.update(zip(codes, _powers(by_g @ values @ by_y.T, tails[:, None, None]), strict=True))
        codes = [code for code in codes if CELLS[code] is None]


def _at_nodes(g, ratio):
    """ln S of every g (cells, n) and every y/max(g, 4) (cells, k): (cells, n, k)."""
    values = np.empty((*g.shape, ratio.shape[1]))
    apart = g.max(axis=1) <= 4  # y does not depend on g
    if apart.any():
        values[apart] = by_products(g[apart], 4.0 * ratio[apart])
    if not apart.all():
        every_g, y = np.broadcast_arrays(g[~apart, :, None], g[~apart, :, None] * ratio[~apart, None, :])
        values[~apart] = by_terms(every_g.ravel(), y.ravel(), derivatives=False)[0].reshape(y.shape)
    return values


def _powers(chebyshev, tails):
    """Of each cell the coefficients of powers from Chebyshev's, without their tail, and of both derivatives; None if
    the tail has not died out."""
    _, most_g, most_y = chebyshev.shape
    large = np.abs(chebyshev) > tails
    n_g = most_g - large.any(axis=2)[:, ::-1].argmax(axis=1)
    n_y = most_y - large.any(axis=1)[:, ::-1].argmax(axis=1)
    kept = (np.arange(most_g) < n_g[:, None])[:, :, None] & (np.arange(most_y) < n_y[:, None])[:, None]
    cells = np.zeros((len(chebyshev), 3, most_y, most_g))
    cells[:, 0] = to_powers(most_y) @ np.where(kept, chebyshev, 0.0).transpose(0, 2, 1) @ to_powers(most_g).T
    cells[:, 1, :, :-1] = np.arange(1, most_g) * cells[:, 0, :, 1:]
    cells[:, 2, :-1] = np.arange(1, most_y)[:, None] * cells[:, 0, 1:]
    return [
        None if g > most_g - 2 or y > most_y - 2 else cell[:, :y, :g].copy()
        for cell, g, y in zip(cells, n_g.tolist(), n_y.tolist(), strict=True)
    ]


@cache
def to_powers(n):
    """Column k holds the powers of Chebyshev's polynomial k."""
    polynomials = np.eye(n)
    for k in range(2, n):
        polynomials[k, : k + 1] = np.concatenate([[0], 2 * polynomials[k - 1, :k]]) - polynomials[k - 2, : k + 1]
    return polynomials.T


def _evaluate(groups, t_g, t_y, out):
    """The polynomials into out[0]; their derivatives by t_g and t_y into out[1] and out[2] where these exist.

    Powers are formed for a block of neighbours at once, whatever their cells. Never for one sample alone, whose last
    digits would be summed in another order than among others.
    """
    for first in range(0, t_g.size, BLOCK):
        here = [
            (cell, max(start, first) - first, min(stop, first + BLOCK) - first)
            for cell, start, stop in groups
            if start < first + BLOCK and stop > first
        ]
        if not here:
            continue
        (_, most_y, most_g), part = np.max([cell.shape for cell, *_ in here], axis=0), slice(first, first + BLOCK)
        powers_g, powers_y = _powers_of(t_g[part], most_g), _powers_of(t_y[part], most_y)
        for cell, start, stop in here:
            _, n_y, n_g = cell.shape
            cut = slice(start, max(stop, start + 2))
            inner = cell[: len(out)].reshape(-1, n_g) @ powers_g[:n_g, cut]
            values = np.einsum("kin,in->kn", inner.reshape(len(out), n_y, -1), powers_y[:n_y, cut])
            out[:, first + start : first + stop] = values[:, : stop - start]


def _powers_of(t, count):
    """Powers of t in rows, and those of a spare 0 at the end."""
    powers = np.empty((count, t.size + 1))
    powers[0] = 1.0
    powers[1:2, :-1] = t
    powers[1:, -1] = 0.0
    done = 2
    while done < count:  # twice as many at each step
        more = min(done - 1, count - done)
        np.multiply(powers[1 : 1 + more], powers[done - 1], out=powers[done : done + more])
        done += more
    return powers


def _chain(code, out, g, y):
    """The derivatives by a cell's own coordinates in out[1] and out[2] into d ln S/d ln g and d ln S/dy."""
    octave = np.where(code == OUTSIDE, 0, code // PARTS)
    out[2] *= SPLIT.take(octave)
    out[2] *= 2 / log(2)
    out[2] /= np.maximum(g, 4.0) + y
    out[1] *= 2 / log(2)
    out[1] -= np.where(g > 4, out[2] * y, 0.0)
