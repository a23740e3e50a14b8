"""Distances to near points, exact, without a tree: for some thousand points in a plane, in groups that do not mix."""

import numpy as np

FIRST = 16  # points looked at on either side to begin with, in the order of x


def squared_distance(x, y, group, k: int) -> np.ndarray:
    """Squared distance from each point to the k-th nearest other point of its group (numbered 0, 1, ...), (points,).

    A group with no more than k points counts its farthest; a point alone has 0. In the order of x, a point further than
    the k-th nearest so far ends the search.
    """
    far = 4 * (np.ptp(x) + np.ptp(y)) + 1.0
    order = np.lexsort((x, group))
    along, y = (x - x.min() + far * group)[order], y[order]  # groups stand apart, so that one order serves all
    sizes = np.bincount(group)[group[order]]
    rank = np.minimum(k, sizes - 1)
    found = np.zeros(len(x))
    asked, offset = np.flatnonzero(rank > 0), FIRST
    while len(asked):
        apart = _to_both_sides(along, y, asked, offset)
        nearest = np.sort(np.partition(apart, min(k, apart.shape[1] - 1), axis=1)[:, :k], axis=1)
        best = nearest[np.arange(len(asked)), rank[asked] - 1]
        ends = (along[asked] - along[np.maximum(asked - offset, 0)], along[np.minimum(asked + offset, len(x) - 1)])
        below = (asked - offset < 0) | (ends[0] ** 2 >= best)
        above = (asked + offset >= len(x)) | ((ends[1] - along[asked]) ** 2 >= best)
        found[asked] = best
        asked, offset = asked[~(below & above)], 2 * offset
    out = np.empty(len(x))
    out[order] = found
    return out


def _to_both_sides(along, y, asked, offset: int) -> np.ndarray:
    """Squared distances (asked, 2 reach) to those before and after in the order; infinite where there are none."""
    offsets = np.r_[-offset:0, 1 : offset + 1]
    others = asked[:, None] + offsets
    there = (others >= 0) & (others < len(along))
    others = np.clip(others, 0, len(along) - 1)
    apart = (along[others] - along[asked, None]) ** 2 + (y[others] - y[asked, None]) ** 2
    return np.where(there, apart, np.inf)
