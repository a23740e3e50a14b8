"""The same sum at a tenth of the cost: ln S as polynomials in cells of log2 g and log2(1 + y/max(g, 4)).

Each cell is one octave in g and an octave or a part of one in the other variable, finer where the sum hops from one
order to the next. In these logarithms 8 by 11 coefficients do on average, since the nearest zeros of S lie at
imaginary parts of ln g near π. A cell is computed from the terms when first touched, and kept; samples outside all
cells are summed term by term.
"""

from functools import partial
from math import log

import numpy as np

from ._series import by_terms, hump

TAIL, NOISE = 1e-12, 4e-15  # Chebyshev coefficients below it, and below this share of |ln S|, are dropped
SIZES = (12, 20)  # nodes along each side, tried in turn
G_FIRST, OCTAVES_G, OCTAVES_Y, PARTS = -42, 70, 16, 8
OUTSIDE = 2**16 - 1
BLOCK = 2048  # samples at once, so that they stay in the processor's cache
SPARSE = 24  # samples in a cell below which a loop over cells costs more than their coefficients for each sample


def ln_series(g, y, derivatives: bool = False):
    """ln S to 1e-11, for g > 0 and y >= 0, which broadcast. With `derivatives`: (ln S, d ln S/d ln g, d ln S/dy), these to 1e-8."""
    g, y = np.broadcast_arrays(np.asanyarray(g, float), np.asanyarray(y, float), subok=True)
    shape, g, y = g.shape, g.ravel(), y.ravel()
    code, t_g, t_y = _places(g, y)
    order = np.argsort(code, kind="stable")
    code, t_g, t_y = code[order], t_g[order], t_y[order]
    starts = np.flatnonzero(np.diff(code, prepend=-1))
    touched = code[starts].tolist()
    _fill([each for each in touched if each not in CELLS])
    cells = [CELLS[each] for each in touched]
    out = np.empty((3 if derivatives else 1, code.size))
    if code.size < SPARSE * len(cells):
        every = _stacked(cells)
        which = np.repeat(np.arange(len(cells)), np.diff(starts, append=code.size))
        for first in range(0, code.size, BLOCK):
            part = slice(first, first + BLOCK)
            stack = every[which[part]]
            _evaluate(lambda powers: np.einsum("nij,jn->in", stack, powers), stack.shape[1:], t_g[part], t_y[part], out[:, part])  # noqa: B023
    else:
        for cell, start, stop in zip(cells, starts, [*starts[1:], code.size]):
            for first in range(start, stop if cell is not None else start, BLOCK):
                part = slice(first, min(first + BLOCK, stop))
                _evaluate(partial(np.matmul, cell), cell.shape, t_g[part], t_y[part], out[:, part])
    result = np.empty_like(out)
    result[:, order] = out
    if derivatives:
        result[1:, order] = _by_chain_rule(code, *out[1:], g[order], y[order])
    for cell, start, stop in zip(cells, starts, [*starts[1:], code.size]):
        if cell is None:
            rows = order[start:stop]
            result[:, rows] = by_terms(g[rows], y[rows])[: len(result)]
    values = [row.reshape(shape) for row in result]
    return tuple(values) if derivatives else values[0]


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
    """Parts of each octave: the humps of neighbouring orders stand apart by π/u in ln y."""
    g = 2.0 ** np.arange(G_FIRST, G_FIRST + OCTAVES_G)[:, None]
    y = (2.0 ** (np.arange(OCTAVES_Y) + 0.3) - 1) * np.maximum(g, 4)
    u = hump(np.broadcast_to(g, y.shape), y)[0]
    return np.select([u < 1.3, u < 4.5, u < 9], [1.0, 2.0, 4.0], 8.0).ravel()


SPLIT = _split()
CELLS: dict[int, np.ndarray | None] = {OUTSIDE: None}  # powers of t_g in rows, of t_y in columns; None: not resolved


def _fill(codes):
    """Compute cells; those that the smaller size does not resolve with the larger, else they stay sums of terms."""
    for size in SIZES:
        if not codes:
            return
        nodes = np.cos(np.pi * (np.arange(size) + 0.5) / size)
        octave, part = np.divmod(np.array(codes), PARTS)
        row, column = np.divmod(octave, OCTAVES_Y)
        g = 2.0 ** (G_FIRST + row[:, None, None] + (1 + nodes[:, None]) / 2)
        b = column[:, None, None] + (part[:, None, None] + (1 + nodes) / 2) / SPLIT[octave][:, None, None]
        g, b = np.broadcast_arrays(g, b)
        y = (2.0**b - 1) * np.maximum(g, 4.0)
        values = by_terms(g.ravel(), y.ravel())[0].reshape(g.shape)
        transform = np.cos(np.pi * np.arange(size)[:, None] * (np.arange(size) + 0.5) / size) * 2 / size
        transform[0] /= 2
        tails = TAIL + NOISE * np.abs(values).max(axis=(1, 2))
        CELLS.update((code, _powers(each, tail)) for code, each, tail in zip(codes, transform @ values @ transform.T, tails))
        codes = [code for code in codes if CELLS[code] is None]


def _powers(chebyshev, tail):
    """Coefficients of powers from Chebyshev's, without their tail; None if the tail has not died out."""
    large = np.abs(chebyshev) > tail
    n_g, n_y = (np.flatnonzero(large.any(axis=axis)).max() + 1 for axis in (1, 0))
    if max(n_g, n_y) > len(chebyshev) - 2:
        return None
    return np.ascontiguousarray(_to_powers(n_g) @ chebyshev[:n_g, :n_y] @ _to_powers(n_y).T)


def _to_powers(n):
    """Column k holds the powers of Chebyshev's polynomial k."""
    polynomials = np.eye(n)
    for k in range(2, n):
        polynomials[k, : k + 1] = np.concatenate([[0], 2 * polynomials[k - 1, :k]]) - polynomials[k - 2, : k + 1]
    return polynomials.T


def _stacked(cells):
    """All cells in one array, padded with zeros."""
    shapes = [cell.shape for cell in cells if cell is not None] or [(1, 1)]
    stack = np.zeros((len(cells), *np.max(shapes, axis=0)))
    for place, cell in enumerate(cells):
        if cell is not None:
            stack[place, : cell.shape[0], : cell.shape[1]] = cell
    return stack


def _evaluate(times_powers, shape, t_g, t_y, out):
    """The polynomial into out[0]; its derivatives by t_g and t_y into out[1] and out[2] where these exist."""
    powers_g, powers_y = _powers_of(t_g, shape[0]), _powers_of(t_y, shape[1])
    inner = times_powers(powers_y)
    np.einsum("in,in->n", powers_g, inner, out=out[0])
    if len(out) == 3:
        np.einsum("in,in->n", _derived(powers_g), inner, out=out[1])
        np.einsum("in,in->n", powers_g, times_powers(_derived(powers_y)), out=out[2])


def _powers_of(t, count):
    powers = np.empty_like(t, shape=(count, t.size))
    powers[0] = 1.0
    powers[1:2] = t
    for k in range(2, count):
        np.multiply(powers[k - 1], t, out=powers[k])
    return powers


def _derived(powers):
    derived = np.zeros_like(powers)
    np.multiply(powers[:-1], np.arange(1.0, len(powers))[:, None], out=derived[1:])
    return derived


def _by_chain_rule(code, by_t_g, by_t_y, g, y):
    """d ln S/d ln g and d ln S/dy from the derivatives by a cell's own coordinates."""
    octave = np.where(code == OUTSIDE, 0, code // PARTS)
    by_y = by_t_y * (2 / log(2)) * SPLIT.take(octave) / (np.maximum(g, 4.0) + y)
    return by_t_g * (2 / log(2)) - np.where(g > 4, by_y * y, 0.0), by_y
