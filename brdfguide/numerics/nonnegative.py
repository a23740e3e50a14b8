"""Non-negative least squares of few columns, many problems at a time."""

from itertools import combinations

import numpy as np

SMALLEST = 1e-300  # keeps a column of zeros from a division by zero
RIDGE = 1e-12  # of each column's own square, which keeps columns that are alike apart


def non_negative(columns: np.ndarray, fixed: np.ndarray, limits: np.ndarray, usable=True) -> np.ndarray:
    """Amplitudes (shapes, terms) in 0..limits that bring columns (shapes, samples, terms) closest to 1 where
    `usable`; fixed ones stay 1.

    The terms are few, so every subset of them is solved and the best feasible one kept.
    """
    shapes, _, terms = columns.shape
    squares = np.swapaxes(columns, 1, 2) @ columns
    target = 1 - columns[:, :, fixed].sum(axis=2) if fixed.any() else np.ones(columns.shape[:2])
    target *= usable
    right = (target[:, None, :] @ columns)[:, 0]
    best = np.where(fixed, 1.0, 0.0) * np.ones((shapes, terms))
    best_cost = np.zeros(shapes)
    loose = [term for term in range(terms) if not fixed[term]]
    for size in range(1, len(loose) + 1):
        for subset in combinations(loose, size):
            solved, cost = (_one, _two, _several)[min(size, 3) - 1](squares, right, list(subset), limits)
            better = np.all(solved >= 0, axis=1) & (cost < best_cost)
            if better.any():
                best[better] = np.where(fixed, 1.0, 0.0)
                for place, term in enumerate(subset):
                    best[better, term] = solved[better, place]
                best_cost[better] = cost[better]
    return best


def _one(squares, right, subset, limits):
    """The amplitude (shapes, 1) of a single column, and the cost (shapes,)."""
    (term,) = subset
    square, aim = squares[:, term, term], right[:, term]
    found = np.minimum(aim / (np.maximum(square, SMALLEST) * (1 + RIDGE)), limits[term])
    return found[:, None], found * (found * square - 2 * aim)


def _two(squares, right, subset, limits):
    """The same of two columns."""
    one, other = subset
    root, root_other = (np.sqrt(np.maximum(squares[:, term, term], SMALLEST)) for term in subset)
    alike = squares[:, one, other] / (root * root_other)
    own, own_other = (
        squares[:, term, term] / (each * each) + RIDGE for term, each in ((one, root), (other, root_other))
    )
    aim, aim_other = right[:, one] / root, right[:, other] / root_other
    share = alike / own
    second = (aim_other - share * aim) / (own_other - share * alike)
    first = np.minimum((aim - alike * second) / own / root, limits[one])
    second = np.minimum(second / root_other, limits[other])
    cost = first * (first * squares[:, one, one] - 2 * right[:, one])
    cost += second * (second * squares[:, other, other] - 2 * right[:, other])
    cost += 2 * first * second * squares[:, one, other]
    return np.stack((first, second), axis=1), cost


def _several(squares, right, subset, limits):
    """The same of more."""
    part = squares[:, subset][:, :, subset]
    scale = np.sqrt(np.maximum(part.diagonal(0, 1, 2), SMALLEST))
    scaled = part / (scale[:, :, None] * scale[:, None, :]) + RIDGE * np.eye(len(subset))
    solved = np.linalg.solve(scaled, (right[:, subset] / scale)[:, :, None])[:, :, 0] / scale
    solved = np.minimum(solved, limits[subset])
    bent = (part @ solved[:, :, None])[:, :, 0] - 2 * right[:, subset]
    return solved, (solved * bent).sum(axis=1)
