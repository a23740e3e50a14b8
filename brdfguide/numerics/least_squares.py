"""Bounded non-linear least squares in a trust region, for many channels that share a shape.

    minimise  Σ_s Σ_c r_sc²  over  shared (p,)  and  per channel (channels, q),   low <= each <= high

The residuals of a channel depend on the shared parameters and on its own; the normal equations are then an
arrow (covariance.py). The step is that of a trust region (trust_region.py).
A problem without channels is the case channels = 1, q = 0.

Source: Levenberg 1944; Marquardt 1963; Moré 1978 ("The Levenberg-Marquardt algorithm: implementation and theory");
Nielsen 1999 ("Damping parameter in Marquardt's method"); bounds by projection with an active set, as in Kanzow,
Yamashita and Fukushima 2004.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..records import dataclass
from .covariance import Normal
from .trust_region import ParameterRow, Point, TrustRegion

# residuals(shared, per_channel) -> (r (samples, channels), j_shared (channels, samples, p),
# j_per_channel (channels, samples, q)); only r where its third argument is False
Residuals = Callable[..., Any]  # an array, or with slopes (array, by shared, by own)

MOST_DAMPING = 1e16  # steps are too short to matter
# evaluations that together gain less than two tolerances each: a long flat valley, whose bottom is known well enough
STALL = 25


@dataclass(frozen=True)
class Minimum:
    """Where the search ended."""

    shared: np.ndarray  # (p,)
    per_channel: np.ndarray  # (channels, q)
    cost: float  # sum of squares
    at_minimum: tuple[np.ndarray, np.ndarray, np.ndarray]  # what `residuals` gave there
    normal: Normal
    evaluations: int
    converged: bool


@np.errstate(over="ignore", invalid="ignore")
def minimise(
    residuals: Residuals,
    shared,
    per_channel=None,
    *,
    low=-np.inf,
    high=np.inf,
    per_channel_low=-np.inf,
    per_channel_high=np.inf,
    tolerance: float = 1e-9,
    most: int = 100,
) -> Minimum:
    """The least sum of squares that a descent from (`shared`, `per_channel`) reaches.

    Takes  shared (p,), per_channel (channels, q), bounds that broadcast to them; `tolerance` on the relative decrease
    of the cost and on the step; at most `most` evaluations.    Gives  Minimum; `converged` is False if `most` ran out.
    Raises nothing: a residual that is not finite only rejects the step that led there.
    """
    shared = np.asarray(shared, float)
    per_channel = np.zeros((1, 0)) if per_channel is None else np.asarray(per_channel, float)
    row = ParameterRow(len(shared), per_channel.shape)
    low, high = row.of(low, per_channel_low), row.of(high, per_channel_high)
    start = _within(row.of(shared, per_channel), low, high)
    here = _point(row, start, residuals(*row.apart(start), True))
    region, evaluations, converged, accepted = TrustRegion(row, here), 1, False, True
    history = [here.cost]  # the least cost after each evaluation
    while not converged and evaluations < most and region.damping < MOST_DAMPING:
        trial = _within(here.at + region.step(here, _stuck(here, low, high)), low, high)
        step = trial - here.at
        promised = here.promised(row, step)
        converged = _nothing_left(here, step, promised, region.damping, tolerance)
        if converged:
            break
        if not promised > 0:  # a bound cut the step so that it climbs, or it is no number: a shorter one will not
            region.shorten()
            continue
        hopeful = accepted  # the last step was taken; so will be this one, most likely, and then needs the slopes
        there = residuals(*row.apart(trial), True) if hopeful else (residuals(*row.apart(trial), False),)
        evaluations += 1
        gain = (here.cost - _sum_of_squares(there[0])) / promised
        accepted = gain > 0
        converged = _done(here, promised, gain, region.damping, tolerance)
        if accepted:
            here = _point(row, trial, there if hopeful else residuals(*row.apart(trial), True))
        region.learn(gain, step)
        history.append(here.cost)
        converged = converged or here.cost == 0 or _stalled(history, tolerance)
    converged = bool(np.isfinite(here.cost)) and (converged or region.damping >= MOST_DAMPING)
    shared, per_channel = row.apart(here.at)
    return Minimum(shared, per_channel, here.cost, here.evaluated, here.normal, evaluations, converged)


def standing(residuals: Residuals, shared, per_channel, evaluations: int, converged: bool) -> Minimum:
    """Where a search that began elsewhere has ended, as `minimise` tells it."""
    row = ParameterRow(len(shared), per_channel.shape)
    here = _point(row, row.of(shared, per_channel), residuals(shared, per_channel, True))
    return Minimum(shared, per_channel, here.cost, here.evaluated, here.normal, evaluations, converged)


def _within(at, low, high):
    """`np.clip` in a fifth of its time, which many small fits feel."""
    return np.minimum(np.maximum(at, low), high)


def _stuck(here: Point, low, high):
    """Which parameters are at a bound that the cost would have them cross."""
    return ((here.at <= low) & (here.slope > 0)) | ((here.at >= high) & (here.slope < 0))


def _nothing_left(here: Point, step, promised: float, damping: float, tolerance: float) -> bool:
    """Whether what is left to gain is too little to go and look."""
    short = float((np.abs(step) / (1e-3 + np.abs(here.at))).max(initial=0.0)) < tolerance * 1e-2
    return short or (damping < 1e-3 and 0 < promised < tolerance * 1e-1 * here.cost)


def _done(here: Point, promised: float, gain: float, damping: float, tolerance: float) -> bool:
    """Whether a step's promise ends the search: a small one that came true in part, so that the next will be smaller
    still; or one that did not, of a decrease that arithmetic could not show.
    """
    if gain > 0:
        return promised < tolerance * here.cost and gain > 0.1 and damping < 1.0
    return promised < 1e-15 * here.cost


def _stalled(history, tolerance: float) -> bool:
    return len(history) > STALL and history[-STALL - 1] - history[-1] < 2 * STALL * tolerance * history[-1]


def _point(row: ParameterRow, at, evaluated) -> Point:
    normal, slope, per_channel_slope = _normal(*evaluated)
    steep = np.concatenate((normal.shared.diagonal(), normal.per_channel.diagonal(0, 1, 2).ravel()))
    return Point(
        at, _sum_of_squares(evaluated[0]), evaluated, normal, np.concatenate((slope, per_channel_slope.ravel())), steep
    )


def _sum_of_squares(r) -> float:
    """Infinite where a residual is not a number, so that the step is rejected."""
    flat = r.ravel("K")
    total = float(flat @ flat)
    return total if total == total else float("inf")


def _normal(r, j_shared, j_per_channel):
    """JᵀJ and Jᵀr by channel, the shared part summed."""
    by_shared, by_per_channel, r = np.swapaxes(j_shared, 1, 2), np.swapaxes(j_per_channel, 1, 2), r.T[:, :, None]
    normal = Normal((by_shared @ j_shared).sum(0), by_shared @ j_per_channel, by_per_channel @ j_per_channel)
    return normal, (by_shared @ r)[:, :, 0].sum(0), (by_per_channel @ r)[:, :, 0]
