"""Many least-squares problems of one shape, each minimised as `least_squares.minimise` does it, side by side.

    minimise  Σ_s Σ_c r_sc²  over  shared (p,)  and  per channel (channels, q),  for each of the problems

They differ in where they begin and in their residuals, and each walks for itself: its radius, damping and end are its
own. What a step costs beside arithmetic is paid once for all of them, which is most of what small problems cost.
Normal equations are formed and inverted whole, without the arrow of covariance.py: for a few channels only.

Source: as in least_squares.py and trust_region.py.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .least_squares import MOST_DAMPING, STALL
from .trust_region import GOOD, LEAST_DAMPING, LOOSE, POOR, TURNS

# evaluate(which (b,), at (b, parameters)) -> (b, channels, p + q + 1, samples): derivatives of each residual by the
# shared coordinates, by its channel's own, and in the last row the residuals
Evaluate = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Ends:
    """Where each of the problems ended."""

    at: np.ndarray  # (problems, p + channels q): the shared coordinates, then those of each channel
    cost: np.ndarray  # (problems,) sums of squares
    evaluations: np.ndarray  # (problems,)
    converged: np.ndarray  # (problems,)


class _State:
    """Where the problems are that have not ended, one in each row."""

    def __init__(self, which, at, row, grams):
        self.which, self.at, self.row = which, at, row
        self.cost, self.slope, self.normal = row.equations(grams)
        count = len(which)
        self.damping, self.least = np.full(count, LEAST_DAMPING), np.full(count, LEAST_DAMPING)
        self.scale = np.sqrt(np.maximum(_diagonal(self.normal), 1e-30))
        length = _length(self.scale * at)
        self.radius = np.where(length > 0, length, 1.0)
        self.evaluations, self.converged = np.ones(count, int), np.zeros(count, bool)
        self.new = np.ones(count, bool)  # whether the point is one from which no step was formed yet
        self.history = np.full((count, STALL + 1), np.inf)  # the least costs after the last evaluations
        self.history[:, -1] = self.cost
        self.down = np.zeros_like(at)  # in units of 1/scale, as what follows
        self.scaled, self.inverse = np.zeros_like(self.normal), np.zeros_like(self.normal)
        self.best, self.reached = np.zeros_like(at), np.zeros(count)

    def kept(self, rows) -> None:
        """Those rows alone."""
        if not rows.all():
            for name, value in vars(self).items():
                if name != "row":
                    setattr(self, name, value[rows])

    def take(self, rows, at, cost, slope, normal) -> None:
        """The problems in these rows have moved."""
        self.at[rows], self.cost[rows], self.slope[rows], self.normal[rows] = at, cost, slope, normal
        self.new |= rows

    def solve(self, rows) -> None:
        """The steps of these rows for their damping."""
        damped, diagonal = self.scaled[rows], np.arange(self.scaled.shape[-1])
        damped[:, diagonal, diagonal] += self.damping[rows, None]
        self.inverse[rows] = inverse = _inverses(damped)
        self.best[rows] = best = (inverse @ self.down[rows, :, None])[:, :, 0]
        self.reached[rows] = _length(best)

    def steps(self, low, high):
        """Of each problem the step to the least of its quadratic model within its radius."""
        if self.new.any():
            rows = np.flatnonzero(self.new)
            slope = self.slope[rows]
            stuck = ((self.at[rows] <= low) & (slope > 0)) | ((self.at[rows] >= high) & (slope < 0))
            self.scale[rows] = scale = np.maximum(self.scale[rows], np.sqrt(_diagonal(self.normal)[rows]))
            scaled = self.normal[rows] / (scale[:, :, None] * scale[:, None, :])
            if stuck.any():
                scaled[stuck[:, :, None] | stuck[:, None, :]] = 0.0
                problem, place = np.nonzero(stuck)
                scaled[problem, place, place] = 1.0
            self.scaled[rows], self.down[rows] = scaled, np.where(stuck, 0.0, -slope / scale)
            self.new[:] = False
            self.solve(rows)
        for _ in range(TURNS):
            ratio = self.reached / self.radius
            good = (ratio <= 1 + LOOSE) & ((self.damping <= self.least) | (ratio >= 1 - LOOSE))
            if good.all():
                break
            rows = np.flatnonzero(~good)
            best = self.best[rows]
            slope = (best[:, None, :] @ self.inverse[rows] @ best[:, :, None])[:, 0, 0]
            positive = slope > 0
            change = (ratio[rows] - 1) * self.reached[rows] ** 2 / np.where(positive, slope, 1.0)
            change = np.where(positive, change, 1e3 * self.damping[rows])
            self.damping[rows] = np.maximum(self.damping[rows] + change, self.least[rows])
            self.solve(rows)
        return self.best / self.scale

    def learn(self, rows, gain, step) -> None:
        """Fits radius and damping of these rows to the share of the promised gain that came true."""
        length, radius = _length(self.scale[rows] * step), self.radius[rows]
        damping, least = self.damping[rows], self.least[rows]
        grows = (gain >= GOOD) | (damping <= LEAST_DAMPING)
        kept = np.where(grows, np.maximum(radius, 3 * length), radius)
        self.radius[rows] = np.where(gain > POOR, kept, 0.5 * length)
        with np.errstate(invalid="ignore"):  # where a gain is no number nothing was taken
            faded = np.maximum(damping * np.maximum(1 / 3, 1 - (2 * gain - 1) ** 3), LEAST_DAMPING)
        taken = gain > 0
        self.damping[rows] = np.where(taken, faded, damping)
        self.least[rows] = np.where(taken, np.where(gain >= GOOD, LEAST_DAMPING, faded), least)

    def remember(self, rows) -> None:
        self.history[rows, :-1] = self.history[rows, 1:]
        self.history[rows, -1] = self.cost[rows]


@dataclass(frozen=True)
class _Row:
    """How the coordinates of a problem lie in one row of numbers."""

    shared: int
    channels: int
    own: int

    def equations(self, grams):
        """Cost (b,), slope (b, P) and normal equations (b, P, P) from (b, channels, k + 1, k + 1)."""
        p, q = self.shared, self.own
        cost = grams[:, :, -1, -1].sum(axis=1)
        cost = np.where(np.isnan(cost), np.inf, cost)
        if self.channels == 1:
            return cost, grams[:, 0, :-1, -1], grams[:, 0, :-1, :-1]
        size = p + self.channels * q
        normal, slope = np.zeros((len(grams), size, size)), np.empty((len(grams), size))
        normal[:, :p, :p], slope[:, :p] = grams[:, :, :p, :p].sum(axis=1), grams[:, :, :p, -1].sum(axis=1)
        for channel in range(self.channels):
            part = slice(p + channel * q, p + (channel + 1) * q)
            between = grams[:, channel, :p, p:-1]
            normal[:, :p, part], normal[:, part, :p] = between, np.swapaxes(between, 1, 2)
            normal[:, part, part] = grams[:, channel, p:-1, p:-1]
            slope[:, part] = grams[:, channel, p:-1, -1]
        return cost, slope, normal


@np.errstate(over="ignore", invalid="ignore")
def minimise_all(
    evaluate: Evaluate,
    starts,
    *,
    shared: int,
    channels: int = 1,
    low=-np.inf,
    high=np.inf,
    tolerance: float = 1e-9,
    most: int = 100,
) -> Ends:
    """The least sums of squares that descents from `starts` (problems, p + channels q) reach.

    Takes  how many coordinates all channels share, bounds that broadcast to a start; `tolerance` and `most` as in
    `least_squares.minimise`, which gives the same for each alone.    Raises nothing.
    """
    starts = np.asarray(starts, float)
    row = _Row(shared, channels, (starts.shape[1] - shared) // channels)
    at = np.minimum(np.maximum(starts, low), high)
    everything = np.arange(len(at))
    ends = Ends(at.copy(), np.full(len(at), np.inf), np.ones(len(at), int), np.zeros(len(at), bool))
    state = _State(everything, at, row, _grams(evaluate(everything, at)))
    while True:
        live = ~state.converged & (state.evaluations < most) & (state.damping < MOST_DAMPING)
        if not live.all():
            _put(ends, state, ~live)
            state.kept(live)
            if not live.any():
                return ends
        _step(evaluate, state, low, high, tolerance)


def _step(evaluate: Evaluate, state: _State, low, high, tolerance: float) -> None:
    """One step of every problem that is left; of those that end before it, none."""
    trial = np.minimum(np.maximum(state.at + state.steps(low, high), low), high)
    step = trial - state.at
    promised = -(2 * (state.slope * step).sum(axis=1) + (step[:, None, :] @ state.normal @ step[:, :, None])[:, 0, 0])
    short = (np.abs(step) / (1e-3 + np.abs(state.at))).max(axis=1, initial=0.0) < tolerance * 1e-2
    state.converged = short | ((state.damping < 1e-3) & (promised > 0) & (promised < tolerance * 1e-1 * state.cost))
    climbs = ~state.converged & ~(promised > 0)
    state.radius = np.where(climbs, 0.5 * np.minimum(state.radius, state.reached), state.radius)
    rows = np.flatnonzero(~state.converged & ~climbs)
    if not len(rows):
        return
    trial, step, promised = trial[rows], step[rows], promised[rows]
    cost, slope, normal = state.row.equations(_grams(evaluate(state.which[rows], trial)))
    state.evaluations[rows] += 1
    gain = (state.cost[rows] - cost) / promised
    accepted = gain > 0
    here = state.cost[rows]
    done = np.where(
        accepted, (promised < tolerance * here) & (gain > 0.1) & (state.damping[rows] < 1.0), promised < 1e-15 * here
    )
    taken = np.zeros(len(state.which), bool)
    taken[rows[accepted]] = True
    state.take(taken, trial[accepted], cost[accepted], slope[accepted], normal[accepted])
    state.learn(rows, gain, step)
    state.remember(rows)
    stalled = state.history[rows, 0] - state.history[rows, -1] < 2 * STALL * tolerance * state.history[rows, -1]
    state.converged[rows] = done | (state.cost[rows] == 0) | stalled


def _put(ends: Ends, state: _State, rows) -> None:
    """Notes where these have ended."""
    which = state.which[rows]
    ends.at[which], ends.cost[which] = state.at[rows], state.cost[rows]
    ends.evaluations[which] = state.evaluations[rows]
    ends.converged[which] = np.isfinite(state.cost[rows]) & (
        state.converged[rows] | (state.damping[rows] >= MOST_DAMPING)
    )


def _grams(stacked) -> np.ndarray:
    """(b, channels, k + 1, k + 1): products of all rows with all rows, over the samples."""
    return stacked @ np.swapaxes(stacked, 2, 3)


def _diagonal(matrices) -> np.ndarray:
    return matrices.diagonal(0, 1, 2)


def _length(steps) -> np.ndarray:
    return np.sqrt((steps * steps).sum(axis=1))


def _inverses(matrices) -> np.ndarray:
    """Inverses of symmetric positive matrices; of singular ones the pseudo-inverses."""
    if matrices.shape[-1] == 0:
        return matrices
    try:
        found = np.linalg.inv(matrices)
        bad = ~np.isfinite(found).all(axis=(1, 2))
    except np.linalg.LinAlgError:
        found, bad = np.empty_like(matrices), np.ones(len(matrices), bool)
    for place in np.flatnonzero(bad):
        found[place] = _inverse(matrices[place])
    return found


def _inverse(matrix) -> np.ndarray:
    try:
        inverse = np.linalg.inv(matrix)
        if np.isfinite(inverse).all():
            return inverse
    except np.linalg.LinAlgError:
        pass
    return np.linalg.pinv(matrix, hermitian=True)
