"""Many least-squares problems, each minimised as `least_squares.minimise` does it, side by side.

    minimise  Σ_s Σ_c r_sc²  over  shared (p,)  and  per channel (channels, q),  for each of the problems

Those of a family are of one shape, and their residuals are formed in one call; they differ in where they begin and in
what they look at. Each walks for itself: its radius, damping and end are its own. What a step costs beside arithmetic
is paid once for all families, which is most of what small problems cost: of a problem with fewer coordinates than
others the rest stand still. Normal equations are formed and inverted whole, without the arrow of covariance.py: for a
few channels only.

Source: as in least_squares.py and trust_region.py.
"""

from collections.abc import Callable, Sequence
from dataclasses import field

import numpy as np

from ..records import dataclass
from .least_squares import MOST_DAMPING, STALL
from .trust_region import GOOD, LEAST_DAMPING, LOOSE, POOR, TURNS

SHORT = 0.02  # of a coordinate: a step that the quadratic model describes (ours)
# evaluate(which (b,), at (b, parameters)) -> (b, channels, p + q + 1, samples): derivatives of each residual by the
# shared coordinates, by its channel's own, and in the last row the residuals
Evaluate = Callable[[np.ndarray, np.ndarray], np.ndarray]
Equations = tuple[np.ndarray, np.ndarray, np.ndarray]  # cost (b,), slope (b, P) and normal equations (b, P, P)


@dataclass(frozen=True, eq=False)
class Descents:
    """Problems of one shape."""

    evaluate: Evaluate
    starts: np.ndarray  # (problems, p + channels q): the shared coordinates, then those of each channel
    shared: int  # p
    channels: int = 1
    low: np.ndarray = field(default_factory=lambda: np.array(-np.inf))  # bounds, which broadcast to a start
    high: np.ndarray = field(default_factory=lambda: np.array(np.inf))
    known: Equations | None = None  # those at the starts, where they were formed before

    @property
    def own(self) -> int:
        """q."""
        return (self.starts.shape[1] - self.shared) // self.channels

    def equations(self, which, at) -> Equations:
        """Of these problems."""
        grams = _grams(self.evaluate(which, at))
        p, q = self.shared, self.own
        cost = grams[:, :, -1, -1].sum(axis=1)
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


@dataclass(frozen=True)
class Ends:
    """Where each of the problems of a family ended."""

    at: np.ndarray  # (problems, p + channels q): the shared coordinates, then those of each channel
    cost: np.ndarray  # (problems,) sums of squares
    evaluations: np.ndarray  # (problems,)
    converged: np.ndarray  # (problems,)
    slope: np.ndarray  # (problems, P)
    normal: np.ndarray  # (problems, P, P)


class _All:
    """Problems of all families in rows, one family after another, with as many coordinates as the longest has."""

    def __init__(self, families: Sequence[Descents]):
        self.families = families
        self.firsts = np.cumsum([0, *(len(each.starts) for each in families)])
        self.size = max(each.starts.shape[1] for each in families)
        shape = int(self.firsts[-1]), self.size
        self.low, self.high, starts = np.full(shape, -np.inf), np.full(shape, np.inf), np.zeros(shape)
        for each, first in zip(families, self.firsts.tolist(), strict=False):
            part = slice(first, first + len(each.starts)), slice(each.starts.shape[1])
            self.low[part], self.high[part], starts[part] = each.low, each.high, each.starts
        self.starts, self.unit = np.minimum(np.maximum(starts, self.low), self.high), np.eye(self.size)

    def equations(self, which, at, begins: bool = False) -> Equations:
        """Of these problems, in ascending order; `begins`: all of them where they start."""
        cost, slope = np.empty(len(at)), np.zeros(at.shape)
        normal = np.empty((*at.shape, self.size))
        normal[:] = self.unit
        bounds = np.searchsorted(which, self.firsts).tolist()
        for each, first, start, stop in zip(self.families, self.firsts.tolist(), bounds, bounds[1:], strict=False):
            if start < stop:
                count, part = each.starts.shape[1], slice(start, stop)
                known = each.known if begins else None
                found = known or each.equations(which[part] - first, at[part, :count])
                cost[part], slope[part, :count], normal[part, :count, :count] = found
        return np.where(np.isnan(cost), np.inf, cost), slope, normal


class _State:
    """Where the problems are that have not ended, one in each row."""

    def __init__(self, problems: _All):
        count = len(problems.starts)
        self.which, self.at = np.arange(count), problems.starts.copy()
        self.low, self.high = problems.low, problems.high
        self.cost, self.slope, self.normal = problems.equations(self.which, self.at, begins=True)
        self.damping, self.least = np.full(count, LEAST_DAMPING), np.full(count, LEAST_DAMPING)
        self.scale = np.sqrt(np.maximum(_diagonal(self.normal), 1e-30))
        length = _length(self.scale * self.at)
        self.radius = np.where(length > 0, length, 1.0)
        self.evaluations, self.converged = np.ones(count, int), np.zeros(count, bool)
        self.new = np.ones(count, bool)  # whether the point is one from which no step was formed yet
        self.history = np.full((count, STALL + 1), np.inf)  # the least costs after the last evaluations
        self.history[:, -1] = self.cost
        self.down = np.zeros_like(self.at)  # in units of 1/scale, as what follows
        self.scaled, self.inverse = np.zeros_like(self.normal), np.zeros_like(self.normal)
        self.best, self.reached = np.zeros_like(self.at), np.zeros(count)

    def kept(self, rows) -> None:
        """Those rows alone."""
        if not rows.all():
            rows = np.flatnonzero(rows)
            for name, value in vars(self).items():
                setattr(self, name, value[rows])

    def take(self, rows, at, cost, slope, normal) -> None:
        """The problems in these rows have moved."""
        self.at[rows], self.cost[rows], self.slope[rows], self.normal[rows] = at, cost, slope, normal
        self.new[rows] = True

    def solve(self, rows) -> None:
        """The steps of these rows for their damping."""
        damped = self.scaled[rows].copy()
        damped.reshape(len(damped), damped.shape[-1] ** 2)[:, :: damped.shape[-1] + 1] += self.damping[rows, None]
        self.inverse[rows] = inverse = _inverses(damped)
        self.best[rows] = best = (inverse @ self.down[rows, :, None])[:, :, 0]
        self.reached[rows] = _length(best)

    def steps(self):
        """Of each problem the step to the least of its quadratic model within its radius."""
        if self.new.any():
            rows = _rows(self.new)
            slope, at = self.slope[rows], self.at[rows]
            stuck = ((at <= self.low[rows]) & (slope > 0)) | ((at >= self.high[rows]) & (slope < 0))
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
            rows = _rows(~good)
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
        faded = np.maximum(damping * np.maximum(1 / 3, 1 - (2 * gain - 1) ** 3), LEAST_DAMPING)
        taken = gain > 0
        self.damping[rows] = np.where(taken, faded, damping)
        self.least[rows] = np.where(taken, np.where(gain >= GOOD, LEAST_DAMPING, faded), least)  # no number: not taken

    def remember(self, rows) -> None:
        self.history[rows, :-1] = self.history[rows, 1:]
        self.history[rows, -1] = self.cost[rows]


@np.errstate(over="ignore", invalid="ignore")
def minimise_all(
    families: Sequence[Descents], *, tolerance: float = 1e-9, most: int = 100, foreseen: bool = False
) -> list[Ends]:
    """The least sums of squares that descents from the starts of each family reach.

    Takes  `tolerance` and `most` as in `least_squares.minimise`, which gives the same for each alone; `foreseen`: a
    short step that would be the last is taken without looking, and cost and equations are those before it. Raises
    nothing.
    """
    if not families:
        return []
    problems = _All(families)
    count = len(problems.starts)
    state = _State(problems)
    ends = Ends(
        problems.starts.copy(), np.full(count, np.inf), np.ones(count, int), np.zeros(count, bool),
        np.zeros_like(state.slope), np.zeros_like(state.normal),
    )  # fmt: skip
    while True:
        live = ~state.converged & (state.evaluations < most) & (state.damping < MOST_DAMPING)
        if not live.all():
            _put(ends, state, ~live)
            state.kept(live)
            if not live.any():
                return [_of(ends, first, each) for first, each in zip(problems.firsts.tolist(), families, strict=False)]
        _step(problems, state, tolerance, foreseen)


def _step(problems: _All, state: _State, tolerance: float, foreseen: bool) -> None:
    """One step of every problem that is left; of those that end before it, none."""
    trial = np.minimum(np.maximum(state.at + state.steps(), state.low), state.high)
    step = trial - state.at
    promised = -np.einsum("bk,bk->b", step, 2 * state.slope + (state.normal @ step[:, :, None])[:, :, 0])
    length = (np.abs(step) / (1e-3 + np.abs(state.at))).max(axis=1, initial=0.0)
    hopeful, left = promised > 0, tolerance * state.cost
    state.converged = (length < tolerance * 1e-2) | (hopeful & (state.damping < 1e-3) & (promised < 1e-1 * left))
    climbs = ~state.converged & ~hopeful
    if foreseen:
        last = ~state.converged & hopeful & (state.damping < 1.0) & (promised < left) & (length < SHORT)
        state.at[last] = trial[last]
        state.evaluations[last] += 1
        state.converged |= last
    state.radius = np.where(climbs, 0.5 * np.minimum(state.radius, state.reached), state.radius)
    goes = ~state.converged & ~climbs
    if not goes.any():
        return
    rows = _rows(goes)
    trial, step, promised = trial[rows], step[rows], promised[rows]
    cost, slope, normal = problems.equations(state.which[rows], trial)
    state.evaluations[rows] += 1
    gain = (state.cost[rows] - cost) / promised
    accepted = gain > 0
    here = state.cost[rows]
    done = np.where(
        accepted, (promised < tolerance * here) & (gain > 0.1) & (state.damping[rows] < 1.0), promised < 1e-15 * here
    )
    if accepted.all():
        state.take(rows, trial, cost, slope, normal)
    elif accepted.any():
        taken = np.arange(len(goes))[rows][accepted]
        state.take(taken, trial[accepted], cost[accepted], slope[accepted], normal[accepted])
    state.learn(rows, gain, step)
    state.remember(rows)
    stalled = state.history[rows, 0] - state.history[rows, -1] < 2 * STALL * tolerance * state.history[rows, -1]
    state.converged[rows] = done | (state.cost[rows] == 0) | stalled


def _put(ends: Ends, state: _State, rows) -> None:
    """Notes where these have ended."""
    which = state.which[rows]
    ends.at[which], ends.cost[which] = state.at[rows], state.cost[rows]
    ends.slope[which], ends.normal[which] = state.slope[rows], state.normal[rows]
    ends.evaluations[which] = state.evaluations[rows]
    ends.converged[which] = np.isfinite(state.cost[rows]) & (
        state.converged[rows] | (state.damping[rows] >= MOST_DAMPING)
    )


def _of(ends: Ends, first: int, family: Descents) -> Ends:
    """Those of one family."""
    rows, size = slice(first, first + len(family.starts)), family.starts.shape[1]
    return Ends(
        ends.at[rows, :size], ends.cost[rows], ends.evaluations[rows], ends.converged[rows], ends.slope[rows, :size],
        ends.normal[rows, :size, :size],
    )  # fmt: skip


def _grams(stacked) -> np.ndarray:
    """(b, channels, k + 1, k + 1): products of all rows with all rows, over the samples."""
    return stacked @ np.swapaxes(stacked, 2, 3)


def _rows(some) -> slice | np.ndarray:
    """Those places, as an index; of all a slice, which copies nothing."""
    return slice(None) if some.all() else np.flatnonzero(some)


def _diagonal(matrices) -> np.ndarray:
    return matrices.diagonal(0, 1, 2)


def _length(steps) -> np.ndarray:
    return np.sqrt(np.einsum("bk,bk->b", steps, steps))


def _inverses(matrices) -> np.ndarray:
    """Inverses of symmetric positive matrices; of singular ones the pseudo-inverses."""
    if matrices.shape[-1] == 0:
        return matrices
    try:
        found = np.linalg.inv(matrices)
        if np.isfinite(found).all():
            return found
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
