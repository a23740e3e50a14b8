"""Bounded non-linear least squares by Levenberg and Marquardt, for many channels that share a shape.

    minimise  Σ_s Σ_c r_sc²  over  shared (p,)  and  own (channels, q),   low <= each <= high

The residuals of a channel depend on the shared parameters and on its own; the normal equations are then an
arrow, and eliminating each channel's own block (Schur complement) makes 31 channels cost little more than one.
A problem without channels is the case channels = 1, q = 0.

Source: Levenberg 1944; Marquardt 1963; the damping rule of Nielsen 1999 ("Damping parameter in Marquardt's
method"); bounds by projection with an active set, as in Kanzow, Yamashita and Fukushima 2004.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

# residuals(shared, own) -> (r (samples, channels), j_shared (channels, samples, p), j_own (channels, samples, q));
# only r where its third argument is False
Residuals = Callable[..., tuple[np.ndarray, np.ndarray, np.ndarray] | np.ndarray]

FIRST_DAMPING = 1e-3
MOST_DAMPING = 1e16
STALL = 25  # evaluations that together gain less than two tolerances each: a long flat valley, whose bottom is known well enough


@dataclass(frozen=True)
class Normal:
    """JᵀJ of an arrow-shaped problem: shared (p, p), between (channels, p, q), own (channels, q, q)."""

    shared: np.ndarray
    between: np.ndarray
    own: np.ndarray

    def covariance(self) -> tuple[np.ndarray, np.ndarray]:
        """(JᵀJ)⁻¹ of the shared (p, p) and of each channel's own (channels, q, q) parameters.

        A direction that the residuals do not depend on gets an enormous variance, never an arbitrary one.
        """
        shared, inverse_own, lever = self._inverses
        return shared, inverse_own + lever @ shared @ np.swapaxes(lever, 1, 2)

    def variances(self, variance: float) -> tuple[np.ndarray, np.ndarray]:
        """Of the shared (p,) and of each channel's own (channels, q) parameters, where every residual has this `variance`."""
        shared, own = self.covariance()
        return variance * shared.diagonal(), variance * own.diagonal(0, 1, 2)

    def scatter(self, spread, j_shared, j_own) -> tuple[np.ndarray, np.ndarray]:
        """The same where each residual has a standard deviation of its own, `spread` (samples, channels): a sandwich."""
        moved, own_moved, lever = self._moved(spread, j_shared, j_own)
        by_channel = np.swapaxes(moved, 1, 2) @ moved
        of_others = lever @ (by_channel.sum(0) - by_channel) @ np.swapaxes(lever, 1, 2)
        own = np.sum((own_moved - moved @ np.swapaxes(lever, 1, 2)) ** 2, axis=1)
        return by_channel.sum(0).diagonal(), own + of_others.diagonal(0, 1, 2)

    def influence(self, r, j_shared, j_own) -> tuple[np.ndarray, np.ndarray]:
        """(JᵀJ)⁻¹ Jᵀr sample by sample: how far each moves the shared (samples, p) and each channel's own (channels, samples, q) parameters."""
        moved, own_moved, lever = self._moved(r, j_shared, j_own)
        moved = moved.sum(0)
        return moved, own_moved - moved @ np.swapaxes(lever, 1, 2)

    def _moved(self, r, j_shared, j_own):
        """How far residuals move the shared parameters, channel by channel, and own ones where shared ones stay; and what own ones follow shared ones by."""
        shared, inverse_own, lever = self._inverses
        pull, own_pull = j_shared * r.T[:, :, None], j_own * r.T[:, :, None]
        return (pull - own_pull @ lever) @ shared, own_pull @ inverse_own, lever

    @cached_property
    def _inverses(self):
        """Inverse of the shared block, others eliminated; of each channel's own; and what own parameters follow shared ones by."""
        inverse_own = covariance_of(self.own, self.own.diagonal(0, 1, 2))
        lever = inverse_own @ np.swapaxes(self.between, 1, 2)
        reduced = self.shared - np.einsum("cpq,cqs->ps", self.between, lever)
        return covariance_of(reduced, np.diag(self.shared)), inverse_own, lever

    def condition(self) -> float:
        """Condition number of the shared block, other parameters eliminated, each scaled to unit length."""
        reduced = self.shared - np.einsum("cpq,cqr,csr->ps", self.between, _inverse(self.own), self.between)
        scale = np.sqrt(np.maximum(np.diag(self.shared), 1e-300))
        values = np.linalg.eigvalsh(reduced / np.outer(scale, scale)) if len(scale) else np.ones(1)
        return float(np.sqrt(values[-1] / values[0])) if values[0] > 0 else float("inf")


@dataclass(frozen=True)
class Minimum:
    """Where the search ended."""

    shared: np.ndarray  # (p,)
    own: np.ndarray  # (channels, q)
    cost: float  # sum of squares
    seen: tuple[np.ndarray, np.ndarray, np.ndarray]  # what `residuals` gave there
    normal: Normal
    evaluations: int
    converged: bool


@np.errstate(over="ignore", invalid="ignore")
def minimise(
    residuals: Residuals,
    shared,
    own=None,
    *,
    low=-np.inf,
    high=np.inf,
    own_low=-np.inf,
    own_high=np.inf,
    tolerance: float = 1e-9,
    most: int = 100,
) -> Minimum:
    """The least sum of squares that a descent from (`shared`, `own`) reaches.

    Takes  shared (p,), own (channels, q), bounds that broadcast to them; `tolerance` on the relative decrease of the
    cost and on the step; at most `most` evaluations.    Gives  Minimum; `converged` is False if `most` ran out.
    Raises nothing: a residual that is not finite only rejects the step that led there.
    """
    shared = _within(np.asarray(shared, float), low, high)
    own = _within(np.zeros((1, 0)) if own is None else np.asarray(own, float), own_low, own_high)
    low, high = np.broadcast_to(low, shared.shape), np.broadcast_to(high, shared.shape)
    own_low, own_high = np.broadcast_to(own_low, own.shape), np.broadcast_to(own_high, own.shape)

    seen = residuals(shared, own, True)
    cost = _sum_of_squares(seen[0])
    damping, grow, evaluations, converged = FIRST_DAMPING, 2.0, 1, False
    normal, g_shared, g_own = _normal(*seen)
    scale, own_scale = np.full(shared.shape, 1e-30), np.full(own.shape, 1e-30)
    history = [cost]  # the least cost after each evaluation
    while not converged and evaluations < most and damping < MOST_DAMPING:
        stuck = ((shared <= low) & (g_shared > 0)) | ((shared >= high) & (g_shared < 0))
        own_stuck = ((own <= own_low) & (g_own > 0)) | ((own >= own_high) & (g_own < 0))
        # the steepest that each parameter has been: a step into a flat region is not taken for free (Moré 1978)
        scale = np.maximum(scale, normal.shared.diagonal())
        own_scale = np.maximum(own_scale, normal.own.diagonal(0, 1, 2))
        step, own_step = _step(normal, g_shared, g_own, damping * scale, damping * own_scale, stuck, own_stuck)
        trial, own_trial = _within(shared + step, low, high), _within(own + own_step, own_low, own_high)
        step, own_step = trial - shared, own_trial - own
        if _largest(step, shared) + _largest(own_step, own) < tolerance * 1e-2:
            converged = True
            break
        expected = -_model_change(normal, g_shared, g_own, step, own_step)
        if 0 < expected < tolerance * 1e-1 * cost and damping < FIRST_DAMPING:
            converged = True  # what is left to gain is too little to go and look
            break
        if not expected > 0:  # a bound cut the step so that it climbs, or it is no number: a shorter one will not
            damping, grow = damping * grow, grow * 2
            continue
        hopeful = grow == 2.0  # the last step was taken; so will be this one, most likely, and then needs the slopes
        there = residuals(trial, own_trial, True) if hopeful else (residuals(trial, own_trial, False),)
        evaluations += 1
        cost_trial = _sum_of_squares(there[0])
        gain = (cost - cost_trial) / expected
        if np.isfinite(cost_trial) and gain > 0:
            # the promise was small and came true in part: the next one will be smaller still
            converged = expected < tolerance * cost and gain > 0.1 and damping < 1.0
            shared, own, cost = trial, own_trial, cost_trial
            damping, grow = damping * max(1 / 3, 1 - (2 * gain - 1) ** 3), 2.0
            seen = there if hopeful else residuals(shared, own, True)
            normal, g_shared, g_own = _normal(*seen)
            converged = converged or cost == 0
        else:
            # the quadratic model cannot promise a decrease that arithmetic could show
            converged = expected < 1e-15 * cost
            damping, grow = damping * grow, grow * 2
        history.append(cost)
        converged = converged or (len(history) > STALL and history[-STALL - 1] - cost < 2 * STALL * tolerance * cost)
    return Minimum(shared, own, cost, seen, normal, evaluations, np.isfinite(cost) and (converged or damping >= MOST_DAMPING))


def _within(at, low, high):
    """`np.clip` in a fifth of its time, which many small fits feel."""
    return np.minimum(np.maximum(at, low), high)


def _sum_of_squares(r) -> float:
    """Infinite where a residual is not a number, so that the step is rejected."""
    flat = r.ravel("K")
    total = float(flat @ flat)
    return total if total == total else float("inf")


def _normal(r, j_shared, j_own):
    """JᵀJ and Jᵀr by channel, the shared part summed."""
    by_shared, by_own, r = np.swapaxes(j_shared, 1, 2), np.swapaxes(j_own, 1, 2), r.T[:, :, None]
    normal = Normal((by_shared @ j_shared).sum(0), by_shared @ j_own, by_own @ j_own)
    return normal, (by_shared @ r)[:, :, 0].sum(0), (by_own @ r)[:, :, 0]


def _step(normal: Normal, g_shared, g_own, damping, own_damping, stuck, own_stuck):
    """The damped Gauss-Newton step; parameters stuck at a bound stay."""
    shared, between, own = normal.shared.copy(), normal.between, normal.own.copy()
    np.einsum("pp->p", shared)[:] += damping
    np.einsum("cqq->cq", own)[:] += own_damping
    if stuck.any() or own_stuck.any():
        between = between.copy()
        g_shared, g_own = np.where(stuck, 0.0, g_shared), np.where(own_stuck, 0.0, g_own)
        shared[stuck, :], shared[:, stuck] = 0.0, 0.0
        shared[stuck, stuck] = 1.0
        between[:, stuck, :] = 0.0
        channel, place = np.nonzero(own_stuck)
        own[channel, place, :], own[channel, :, place], between[channel, :, place] = 0.0, 0.0, 0.0
        own[channel, place, place] = 1.0
    inverse_own = _inverse(own)
    lever = between @ inverse_own
    reduced = shared - (lever @ np.swapaxes(between, 1, 2)).sum(0)
    step = -_inverse(reduced) @ (g_shared - (lever @ g_own[:, :, None]).sum(0)[:, 0])
    own_step = -(inverse_own @ (g_own + step @ between)[:, :, None])[:, :, 0]
    return step, own_step


def _model_change(normal: Normal, g_shared, g_own, step, own_step) -> float:
    """Change of the cost that the quadratic model promises for a step."""
    column = own_step[:, :, None]
    rise = 2 * g_shared + normal.shared @ step + 2 * (normal.between @ column).sum(0)[:, 0]
    own_rise = 2 * g_own + (normal.own @ column)[:, :, 0]
    return float(rise @ step + own_rise.ravel() @ own_step.ravel())


def _inverse(matrix):
    """Inverse of symmetric positive matrices, scaled to a unit diagonal first; singular ones through the pseudo-inverse."""
    if matrix.shape[-1] == 0:
        return matrix
    scale = np.sqrt(np.maximum(matrix.diagonal(0, -2, -1), 0.0))
    if not scale.all():
        scale = np.where(scale > 0, scale, 1.0)
    outer = scale[..., :, None] * scale[..., None, :]
    try:
        inverse = np.linalg.inv(matrix / outer)
        if not np.isfinite(inverse).all():
            raise np.linalg.LinAlgError
    except np.linalg.LinAlgError:
        inverse = np.linalg.pinv(matrix / outer, hermitian=True)
    return inverse / outer


def covariance_of(matrix, diagonal):
    """Inverse for a covariance, scaled by this diagonal: eigenvalues that rounding could have made count as 1e-15 of the scaled matrix."""
    if matrix.shape[-1] == 0:
        return matrix
    scale = 1 / np.sqrt(np.where(diagonal > 1e-200, diagonal, 1.0))
    outer = scale[..., :, None] * scale[..., None, :]
    values, vectors = np.linalg.eigh(matrix * outer)
    return np.einsum("...ij,...j,...kj->...ik", vectors, 1 / np.maximum(values, 1e-15), vectors) * outer


def _largest(step, at) -> float:
    return float((np.abs(step) / (1e-3 + np.abs(at))).max(initial=0.0))
