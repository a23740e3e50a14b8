"""Non-negative least squares of few columns, many problems at a time."""

from itertools import combinations

import numpy as np

SMALLEST = 1e-300  # keeps a column of zeros from a division by zero


def non_negative(columns: np.ndarray, fixed: np.ndarray, limits: np.ndarray, usable=True) -> np.ndarray:
    """Amplitudes (shapes, terms) in 0..limits that bring columns (shapes, samples, terms) closest to 1 where
    `usable`; fixed ones stay 1.

    The terms are few, so every subset of them is solved and the best feasible one kept.
    """
    shapes, _, terms = columns.shape
    squares = np.swapaxes(columns, 1, 2) @ columns
    target = np.where(usable, 1 - columns[:, :, fixed].sum(axis=2), 0.0)
    right = np.einsum("gst,gs->gt", columns, target)
    best = np.where(fixed, 1.0, 0.0) * np.ones((shapes, terms))
    best_cost = np.zeros(shapes)
    loose = [term for term in range(terms) if not fixed[term]]
    for size in range(1, len(loose) + 1):
        for subset in combinations(loose, size):
            part = squares[np.ix_(range(shapes), subset, subset)]
            scale = np.sqrt(np.maximum(np.einsum("gtt->gt", part), SMALLEST))
            scaled = part / (scale[:, :, None] * scale[:, None, :]) + 1e-12 * np.eye(size)
            solved = np.linalg.solve(scaled, (right[:, subset] / scale)[:, :, None])[:, :, 0] / scale
            solved = np.minimum(solved, limits[list(subset)])
            cost = np.einsum("gt,gtu,gu->g", solved, part, solved) - 2 * np.einsum("gt,gt->g", right[:, subset], solved)
            better = np.all(solved >= 0, axis=1) & (cost < best_cost)
            best[np.ix_(better, subset)] = solved[better]
            others = [term for term in loose if term not in subset]
            best[np.ix_(better, others)] = 0.0
            best_cost[better] = cost[better]
    return best
