"""Coordinates in which a search walks from one axis of a grain to any other, through a round lobe and without an end.

    Sigma = alpha² exp([[q1, q2], [q2, -q1]]),   widths alpha e^(±q/2), q = |(q1, q2)|,   axis = ½ atan2(q2, q1)

is smooth where a lobe is round, where an axis says nothing. The law itself is evaluated from widths and axis, of which
no digits are lost at long streaks.
"""

from math import log, pi

import numpy as np

from ..models.facts import Grain

MOST_Q = log(100.0)  # of the ratio's logarithm
LEAST_Q = 1e-6  # below it a lobe is round, and any axis will do
ALPHA = (1e-4, 2.0)


def walk_of(grain: Grain, first: float, second: float, axis: float) -> tuple[float, float, float]:
    """(ln alpha, q1, q2) of the law's own parameters."""
    wide, narrow = grain.widths(first, second)
    q = np.clip(np.log(wide / narrow), -MOST_Q, MOST_Q)
    return 0.5 * float(np.log(wide * narrow)), float(q * np.cos(2 * axis)), float(q * np.sin(2 * axis))


def parameters_of(grain: Grain, ln_alpha: float, q1: float, q2: float) -> tuple[float, float, float]:
    """The law's own parameters (first, second, axis): the wider of both first, 0 <= axis < π."""
    q = max(float(np.hypot(q1, q2)), LEAST_Q)
    alpha = float(np.exp(ln_alpha))
    first, second = grain.values(alpha * np.exp(0.5 * q), alpha * np.exp(-0.5 * q))
    return float(first), float(second), float(np.remainder(0.5 * np.arctan2(q2, q1), pi))


def walk_slopes(grain: Grain, at: tuple[float, float, float], by):
    """d f by (ln alpha, q1, q2) `at` (first, second, axis) from `by`, its derivatives by these.

    d/dq_1 = cos 2a d/dq - sin 2a d/da/(2q),   d/dq_2 = sin 2a d/dq + cos 2a d/da/(2q),   d/dq = ½ (d/dln wide - d/dln
    narrow)
    """
    first, second, axis = at
    (first_wide, first_narrow), (second_wide, second_narrow) = grain.by_ln_widths(first, second)
    by_wide = by[0] * first_wide + by[1] * second_wide
    by_narrow = by[0] * first_narrow + by[1] * second_narrow
    wide, narrow = grain.widths(first, second)
    q = max(float(np.log(wide / narrow)), LEAST_Q)
    cos, sin = np.cos(2 * axis), np.sin(2 * axis)
    by_q, across = 0.5 * (by_wide - by_narrow), by[2] / (2 * q)
    return by_wide + by_narrow, cos * by_q - sin * across, sin * by_q + cos * across


def walk_bounds() -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """The least and the greatest coordinates."""
    return (log(ALPHA[0]), -MOST_Q, -MOST_Q), (log(ALPHA[1]), MOST_Q, MOST_Q)
