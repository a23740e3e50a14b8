"""The unit square carried by the cumulative distribution of a density: first along x within the row, then along y.

A density is a table [..., y, x] between whose nodes one goes linearly. `pushed` blends the slices of a table; `pulled`
inverts one of them. Where a table is even in the pushed coordinates, it is fine where the density is high.
"""

import numpy as np


def cell_of(u, shape):
    """Indices and weights of the cell of [0,1]² in which `u` lies; tables are [y, x]."""
    x, y = u[0] * (shape[-1] - 1), u[1] * (shape[-2] - 1)
    i, j = np.clip(x.astype(int), 0, shape[-1] - 2), np.clip(y.astype(int), 0, shape[-2] - 2)
    return i, j, x - i, y - j


def bilinear(table, u, where=None):
    """Values of a table [y, x], or of the slice `where` of [phi, theta, (channel,) y, x] as (samples, channels)."""
    i, j, a, b = cell_of(u, table.shape)
    one = () if where is None else (*where, slice(None))
    if where is not None:
        a, b = a[:, None], b[:, None]

    def corner(dj, di):
        return table[(*one, j + dj, i + di)].astype(float)

    return (1 - b) * ((1 - a) * corner(0, 0) + a * corner(0, 1)) + b * ((1 - a) * corner(1, 0) + a * corner(1, 1))


def pushed(density, slices, u):
    """Where `u` (2, samples) goes; `slices` are pairs of (slice of each sample as (phi index, theta index), weight)."""
    along = _rising(density)
    row = along[..., -1]
    upward = _rising(row)
    total = upward[..., -1:]
    along, density, row, upward = along / total[..., None], density / total[..., None], row / total, upward / total
    i, j, a, b = cell_of(u, density.shape)

    def blended(table, *index):
        return sum(weight * table[(*where, *index)] for where, weight in slices)

    left = (1 - b) * blended(density, j, i) + b * blended(density, j + 1, i)
    right = (1 - b) * blended(density, j, i + 1) + b * blended(density, j + 1, i + 1)
    below, above = blended(row, j), blended(row, j + 1)
    x = a * (left + 0.5 * a * (right - left)) + (1 - b) * blended(along, j, i) + b * blended(along, j + 1, i)
    width = (1 - b) * below + b * above
    y = b * (below + 0.5 * b * (above - below)) + blended(upward, j)
    x = np.divide(x, width, out=np.full_like(x, 0.5), where=width > 0)
    return np.stack([np.clip(x, 0, 1), np.clip(y, 0, 1)])


def pulled(density, shape) -> np.ndarray:
    """Where the nodes of an even grid of `shape` (rows, columns) come from: (2, rows, columns), of one slice [y, x]."""
    row = _rising(density)[:, -1]
    y = _reached(row[None], np.linspace(0, 1, shape[0]))[0]
    j = np.minimum(y.astype(int), len(density) - 2)
    b = (y - j)[:, None]
    x = _reached((1 - b) * density[j] + b * density[j + 1], np.linspace(0, 1, shape[1]))
    return np.stack([x / (density.shape[1] - 1), np.broadcast_to(y[:, None] / (len(density) - 1), x.shape)])


def _rising(density):
    """The integral from the first node to each, linear in between, over the last axis."""
    return np.concatenate(
        [np.zeros_like(density[..., :1]), np.cumsum(0.5 * (density[..., 1:] + density[..., :-1]), axis=-1)], axis=-1
    )


def _reached(density, shares):
    """(rows, shares): how many nodes along each row of `density` the given shares of its integral lie; the middle where
    it is zero."""
    count, last = density.shape
    cumulative = _rising(density)
    total = cumulative[:, -1:]
    start = 2.0 * np.arange(count)[:, None]  # every row on a stretch of its own, so that one search serves all
    flat = np.divide(cumulative, total, out=np.full_like(cumulative, 0.5), where=total > 0) + start
    node = np.searchsorted(flat.ravel(), shares + start, side="right") - 1 - last * np.arange(count)[:, None]
    node = np.clip(node, 0, last - 2)
    left, right = np.take_along_axis(density, node, 1), np.take_along_axis(density, node + 1, 1)
    rest = shares * total - np.take_along_axis(cumulative, node, 1)
    root = left + np.sqrt(np.maximum(left**2 + 2 * (right - left) * rest, 0.0))
    part = np.clip(np.divide(2 * rest, root, out=np.zeros_like(root), where=root > 0), 0, 1)
    return np.where(total > 0, node + part, 0.5 * (last - 1))
