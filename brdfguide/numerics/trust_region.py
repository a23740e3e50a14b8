"""How far a quadratic model of a cost is trusted, and the step that stays within.

A step is that of Gauss and Newton unless it is longer than the quadratic model can be trusted, each parameter measured
in units of the steepest it has been; then Levenberg's damping is found that makes it as long as that. A damping stays,
and fades by Nielsen's rule, while the model keeps its promises only in part.

Source: Levenberg 1944; Marquardt 1963; Moré 1978 ("The Levenberg-Marquardt algorithm: implementation and theory");
Nielsen 1999 ("Damping parameter in Marquardt's method").
"""

from math import sqrt
from typing import NamedTuple

import numpy as np

from ..records import dataclass
from .covariance import Normal

LEAST_DAMPING = 1e-14  # of the squared scale of each parameter: what rounding does to the normal equations
POOR = 0.25  # share of the promised gain up to which the radius is halved (Moré 1978)
# from which it is three times the step (Moré 1978; three is ours: of the 480 fits tried the fewest end worse)
GOOD = 0.75
LOOSE = 0.1  # a step within so much of the radius is as long as the radius (Moré 1978)
MANY = 16  # numbers of a single channel, from which all are solved for at once: inverses of blocks cost more
TURNS = 10  # at most, to find the damping; one or two are common


@dataclass(frozen=True)
class ParameterRow:
    """How the shared (count,) and each channel's own (channels, q) parameters lie in one row of numbers."""

    count: int
    shape: tuple[int, ...]

    def of(self, shared, per_channel):
        """One row of both blocks, or of what broadcasts to them."""
        shared, per_channel = np.broadcast_to(shared, self.count), np.broadcast_to(per_channel, self.shape)
        return np.concatenate((shared, per_channel.ravel()))

    def apart(self, row):
        return row[: self.count], row[self.count :].reshape(self.shape)


class Point(NamedTuple):
    """Where the search is, and the quadratic model of the cost there."""

    at: np.ndarray
    cost: float
    evaluated: tuple
    normal: Normal
    slope: np.ndarray  # Jᵀr
    steep: np.ndarray  # diagonal of JᵀJ

    def promised(self, row: ParameterRow, step) -> float:
        """Decrease of the cost that the quadratic model promises for a step."""
        shared, per_channel = row.apart(step)
        normal, column = self.normal, per_channel[:, :, None]
        bent = shared @ (normal.shared @ shared + 2 * (normal.between @ column).sum(0)[:, 0])
        return -float(2 * (self.slope @ step) + bent + per_channel.ravel() @ (normal.per_channel @ column).ravel())


class TrustRegion:
    """How far the quadratic model is trusted, and the damping that keeps a step within.

    Each parameter counts by the steepest that it has been: a step into a flat region is not taken for free.
    """

    def __init__(self, row: ParameterRow, here: Point):
        self.row = row
        self.damping = self.least = LEAST_DAMPING
        self.scale = np.sqrt(np.maximum(here.steep, 1e-30))
        self.radius = _length(self.scale * here.at) or 1.0
        self.here: Point | None = None

    def step(self, here: Point, stuck):
        """The step to the least of the quadratic model within the radius; parameters stuck at a bound stay."""
        if here is not self.here:
            self.here, self.scale = here, np.maximum(self.scale, np.sqrt(here.steep))
            self.equations = _scaled(self.row, here.normal, self.scale, stuck)
            self.down = np.where(stuck, 0.0, -here.slope / self.scale)
            self._solve()
        for _ in range(TURNS):
            ratio = self.reached / self.radius
            if ratio <= 1 + LOOSE and (self.damping <= self.least or ratio >= 1 - LOOSE):
                break
            # 1/length is nearly a straight line over the damping, and Newton's step on it never goes too far
            slope = float(self.best @ self.factors.solve(self.row, self.best))
            change = (ratio - 1) * self.reached**2 / slope if slope > 0 else 1e3 * self.damping
            self.damping = max(self.damping + change, self.least)
            self._solve()
        return self.best / self.scale

    def learn(self, gain: float, step) -> None:
        """Fits the radius to the share of the promised gain that came true; and the damping where a step was taken."""
        length = _length(self.scale * step)
        if not gain > POOR:
            self.radius = 0.5 * length
        elif gain >= GOOD or self.damping <= LEAST_DAMPING:
            self.radius = max(self.radius, 3 * length)
        if gain > 0:
            self.damping = max(self.damping * max(1 / 3, 1 - (2 * gain - 1) ** 3), LEAST_DAMPING)
            # a promise kept in part: the cost bends more than its model, and a longer step would go astray again
            self.least = LEAST_DAMPING if gain >= GOOD else self.damping

    def shorten(self) -> None:
        self.radius = 0.5 * min(self.radius, self.reached)

    def _solve(self) -> None:
        self.factors = _factors(self.equations, self.damping)
        self.best = self.factors.solve(self.row, self.down)
        self.reached = _length(self.best)


def _length(step) -> float:
    return sqrt(step @ step)


def _scaled(row: ParameterRow, normal: Normal, scale, stuck) -> Normal:
    """The normal equations for parameters in units of 1/scale; those stuck at a bound stay."""
    scale, per_channel_scale = row.apart(scale)
    shared = normal.shared / (scale[:, None] * scale)
    between = normal.between / (scale[:, None] * per_channel_scale[:, None, :])
    per_channel = normal.per_channel / (per_channel_scale[:, :, None] * per_channel_scale[:, None, :])
    if stuck.any():
        stuck, per_channel_stuck = row.apart(stuck)
        shared[stuck, :], shared[:, stuck] = 0.0, 0.0
        shared[stuck, stuck] = 1.0
        between[:, stuck, :] = 0.0
        channel, place = np.nonzero(per_channel_stuck)
        per_channel[channel, place, :], per_channel[channel, :, place], between[channel, :, place] = 0.0, 0.0, 0.0
        per_channel[channel, place, place] = 1.0
    return Normal(shared, between, per_channel)


class _Factors(NamedTuple):
    """Damped normal equations made ready to be solved."""

    between: np.ndarray
    coupling: np.ndarray
    inverse: np.ndarray
    inverse_per_channel: np.ndarray

    def solve(self, row: ParameterRow, right):
        """The parameters that the equations take to `right`."""
        shared, per_channel = row.apart(right)
        step = self.inverse @ (shared - (self.coupling @ per_channel[:, :, None]).sum(0)[:, 0])
        per_channel_step = self.inverse_per_channel @ (per_channel - step @ self.between)[:, :, None]
        return np.concatenate((step, per_channel_step.ravel()))


class _Whole(NamedTuple):
    """The same of one channel with many numbers, as one matrix."""

    matrix: np.ndarray

    def solve(self, row: ParameterRow, right):
        """The parameters that the equations take to `right`."""
        try:
            found = np.linalg.solve(self.matrix, right)
            if not np.isfinite(found).all():
                raise np.linalg.LinAlgError
        except np.linalg.LinAlgError:
            found = np.linalg.pinv(self.matrix, hermitian=True) @ right
        return found


def _factors(equations: Normal, damping: float) -> "_Factors | _Whole":
    """The equations with a damping on their diagonal, each channel's own parameters eliminated."""
    count = len(equations.shared)
    if len(equations.per_channel) == 1 and count + equations.per_channel.shape[1] >= MANY:
        matrix = np.empty(2 * (count + equations.per_channel.shape[1],))
        matrix[:count, :count], matrix[count:, count:] = equations.shared, equations.per_channel[0]
        matrix[:count, count:], matrix[count:, :count] = equations.between[0], equations.between[0].T
        matrix.reshape(-1)[:: len(matrix) + 1] += damping
        return _Whole(matrix)
    inverse_per_channel = _inverse(_damped(equations.per_channel, damping))
    coupling = equations.between @ inverse_per_channel
    reduced = _damped(equations.shared, damping) - (coupling @ np.swapaxes(equations.between, 1, 2)).sum(0)
    return _Factors(equations.between, coupling, _inverse(reduced), inverse_per_channel)


def _damped(matrix, damping: float):
    """Square matrices with a damping on their diagonals."""
    size, matrix = matrix.shape[-1], matrix.copy()
    if size:
        matrix.reshape(-1, size * size)[:, :: size + 1] += damping
    return matrix


def _inverse(matrix):
    """Inverse of symmetric positive matrices; of singular ones the pseudo-inverse."""
    if matrix.shape[-1] == 0:
        return matrix
    try:
        inverse = np.linalg.inv(matrix)
        if not np.isfinite(inverse).all():
            raise np.linalg.LinAlgError
    except np.linalg.LinAlgError:
        inverse = np.linalg.pinv(matrix, hermitian=True)
    return inverse
