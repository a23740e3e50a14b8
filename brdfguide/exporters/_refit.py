"""Fits a target's own law to the chosen model: bounded, in ln, from several starts.

A `TargetModel` is a renderer's BRDF as that renderer evaluates it. Its parameters are the numbers of its file, so that
their bounds are the ranges its reader documents and nothing outside them can be written. A law whose values may have an
axis before the directions is evaluated for all starts, and for all differences of a step, at once. Starts are searched
from over a few hundred directions; what is found there is settled over more.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, replace
from functools import cached_property, partial
from itertools import product

import numpy as np

from ..fitting.layout import coordinate_bounds, from_coordinate, to_coordinate
from ..models.model import Parameter
from ..numerics import least_squares
from ..numerics.nonnegative import non_negative
from ..physics.geometry import Geometry
from ..records import dataclass
from ._mirrored import BesideMirror

Places = Geometry | BesideMirror  # where a law is evaluated
FAR = 1.2  # a second start this much worse than the first is not searched from
STEP = 1e-6  # of a parameter's scale, for differences
DARKEST = 1e-13  # of what is wanted: bounds the residual of a law that vanishes, in the search only
FEW = 160  # directions among which a search begins
MANY = 1500  # and those over which it is settled; the error is taken over all
BEGUN, SETTLED = (1e-3, 15), (1e-6, 40)  # relative decrease of the cost that ends a search, and most evaluations


@dataclass(frozen=True)
class TargetModel:
    """brdf(geom, **values) -> (samples, colours) [1/sr]; per-channel parameters have one value a colour."""

    parameters: tuple[Parameter, ...]
    brdf: Callable[..., np.ndarray]
    fixed: Mapping = field(default_factory=dict)  # held parameters, which the file needs too
    broadcasts: bool = False  # whether values (sets, 1, colours) give (sets, samples, colours)

    def at(self, geom: Places, values: Mapping) -> np.ndarray:
        return self.brdf(geom, **values)

    def with_fixed(self, **fixed) -> "TargetModel":
        """The same law with some parameters held; alike for all colours as one number, so that grey stays grey."""
        fixed = {name: float(np.ravel(value)[0]) if np.ptp(value) == 0 else value for name, value in fixed.items()}
        free = tuple(p for p in self.parameters if p.name not in fixed)
        return replace(self, parameters=free, brdf=partial(self.brdf, **fixed), fixed={**self.fixed, **fixed})

    def of_sets(self, geom: Places, sets: Mapping[str, np.ndarray], colours: int) -> np.ndarray:
        """(sets, samples, colours) of values (sets,), or (sets, colours) of per-channel parameters."""
        several = {
            p.name: sets[p.name][:, None, :] if p.per_channel else sets[p.name][:, None, None] for p in self.parameters
        }
        count = len(next(iter(sets.values()))) if sets else 1
        if self.broadcasts:
            return np.broadcast_to(self.brdf(geom, **several), (count, len(geom), colours))
        found = []
        for row in range(count):
            one = {name: each[row, 0] if each.shape[2] > 1 else each[row, 0, 0] for name, each in several.items()}
            found.append(np.broadcast_to(self.brdf(geom, **one), (len(geom), colours)))
        return np.stack(found)


@dataclass(frozen=True, eq=False)
class Goal:
    """What is wanted (samples, colours; NaN: does not count) in some directions, and how many each stands for."""

    geom: Places
    wanted: np.ndarray
    weights: np.ndarray | float = 1.0  # (samples,)

    @cached_property
    def counted(self) -> np.ndarray:
        return np.isfinite(self.wanted)

    @cached_property
    def _scale(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """What is wanted, its ln, and the root of what each counts."""
        wanted = np.where(self.counted, self.wanted, 1.0)
        root = np.sqrt(np.broadcast_to(self.weights, len(wanted)))[:, None] * self.counted
        return wanted, np.log(wanted), root

    @property
    def root(self) -> np.ndarray:
        """Root of what each value counts, (samples, colours); 0 where it does not."""
        return self._scale[2]

    def residual(self, written: np.ndarray) -> np.ndarray:
        """ln(written / wanted) by the root of its weight, (..., samples, colours); 0 where it does not count."""
        wanted, ln_wanted, root = self._scale
        return (np.log(np.maximum(written, DARKEST * wanted)) - ln_wanted) * root

    def error(self, written: np.ndarray) -> float:
        """rms ln by weight where it counts; infinite where what is written is 0 and the surface is not."""
        wanted, _, root = self._scale
        written = np.broadcast_to(written, wanted.shape)
        if np.any((written <= 0) & self.counted):
            return float("inf")
        apart = np.log(np.where(self.counted, written / wanted, 1.0)) * root
        return self.rms(float(np.sum(apart * apart)))

    def rms(self, cost: float) -> float:
        """rms ln of a sum of squared residuals."""
        return float(np.sqrt(cost / self._total))

    @cached_property
    def _total(self) -> float:
        """The weights of all that counts."""
        return max(float(np.sum(self._scale[2] ** 2)), 1e-300)

    def relative(self, written: np.ndarray, colour: int) -> np.ndarray:
        """written / wanted of a colour, (..., samples that count)."""
        # beyond 1e100 times what is wanted it does not matter by how much, and its square must not overflow
        here = self.counted[:, colour]
        root = self._scale[2][here, colour]
        return np.minimum(written[..., here, colour] / self.wanted[here, colour], 1e100) * root

    def roots(self, colour: int) -> np.ndarray:
        """Root of the weight where a colour counts."""
        return self._scale[2][self.counted[:, colour], colour]

    def grey(self) -> "Goal":
        """The same in one colour where all are alike."""
        alike = np.all((self.wanted == self.wanted[:, :1]) | ~self.counted)
        return replace(self, wanted=self.wanted[:, :1]) if alike else self

    @cached_property
    def few(self) -> "Goal":
        """The directions among which a search begins."""
        return self.grey().fewer(FEW)

    @cached_property
    def many(self) -> "Goal":
        """And those over which it is settled."""
        return self.grey().fewer(MANY)

    def fewer(self, most: int) -> "Goal":
        """About `most` of the directions, in even steps through all by incidence and distance from the mirror
        direction; those that stand for others are kept."""
        alone = np.broadcast_to(self.weights, len(self.geom)) == 1
        if np.sum(alone) <= most:
            return self
        [own] = np.nonzero(alone)
        incidence, distance = (each[own].ravel() for each in (self.geom.cos_i, self.geom.mirror_distance2))
        taken = np.linspace(0, len(own) - 1, most).round().astype(int)
        kept = np.sort(own[np.lexsort((distance, np.round(incidence, 3)))][taken])
        rows = np.concatenate((kept, np.nonzero(~alone)[0]))
        weights = np.where(alone, len(own) / most, np.broadcast_to(self.weights, len(alone)))[rows]
        return Goal(self.geom[rows], self.wanted[rows], weights)


def refit(target: TargetModel, goal: Goal, refine: int = 2) -> tuple[float, dict]:
    """rms ln over a few directions, and the values that are nearest there."""
    few = goal.few
    begun = _starts(target, few)
    near = [values for error, values in begun[:refine] if error <= FAR * begun[0][0]]
    return min((_search(target, values, few, BEGUN) for values in near), key=lambda each: each[0])


def settled_over_many(target: TargetModel, values: Mapping, goal: Goal) -> dict:
    """Values found over a few directions, settled over many. Per-channel ones as arrays."""
    return _search(target, values, goal.many, SETTLED)[1]


def least_of_amplitude(target: TargetModel, goal: Goal) -> float:
    """rms ln over a few directions that is left of a law which is nothing but an amplitude for each colour, whatever
    that is; 0 of any other law."""
    if len(target.parameters) != 1 or not (target.parameters[0].linear and target.parameters[0].per_channel):
        return 0.0
    few, name = goal.few, target.parameters[0].name
    colours = few.wanted.shape[1]
    nothing, one = target.of_sets(few.geom, {name: np.repeat([[0.0], [1.0]], colours, axis=1)}, colours)
    if np.any(nothing):
        return 0.0
    residual, root = few.residual(one), few.root
    along = np.sum(root * residual, axis=0) ** 2 / np.maximum(np.sum(root * root, axis=0), 1e-300)
    return few.rms(max(float(np.sum(residual * residual) - np.sum(along)), 0.0))


def _starts(target: TargetModel, goal: Goal) -> list[tuple[float, dict]]:
    """rms ln and values from each start, the nearest first: its amplitudes by least squares of the relative error,
    none negative."""
    colours, linear = goal.wanted.shape[1], [p for p in target.parameters if p.linear]
    searched = [p for p in target.parameters if not p.linear]
    combinations = list(product(*(p.starts or (p.default,) for p in searched)))
    shapes = np.array(combinations, float).reshape(len(combinations), len(searched))
    sets = {p.name: _spread(p, shapes[:, i], colours) for i, p in enumerate(searched)}
    nothing = {p.name: _spread(p, np.zeros(len(shapes)), colours) for p in linear}
    if linear:
        rest = target.of_sets(goal.geom, sets | nothing, colours)
        unit = [target.of_sets(goal.geom, sets | nothing | {p.name: nothing[p.name] + 1.0}, colours) for p in linear]
        for colour in range(colours):
            columns = np.stack([goal.relative(each, colour) for each in (*(u - rest for u in unit), rest)], axis=-1)
            _amounts(linear, nothing, columns, goal.roots(colour), colour)
    sets = sets | nothing
    residual = goal.residual(target.of_sets(goal.geom, sets, colours))
    errors = np.sqrt(np.mean(residual**2, axis=(1, 2)))
    values = [{name: each[row] for name, each in sets.items()} for row in range(len(shapes))]
    return sorted(zip(errors.tolist(), values, strict=True), key=lambda each: each[0])


def _spread(p: Parameter, values: np.ndarray, colours: int) -> np.ndarray:
    return np.repeat(values[:, None], colours, axis=1) if p.per_channel else values


def _amounts(linear: Sequence[Parameter], amounts: dict, columns: np.ndarray, roots: np.ndarray, colour: int) -> None:
    """Writes the amplitudes of a colour, (starts,) each, that bring columns (starts, samples, amplitudes and what is
    there without any) nearest to 1, each direction by its root."""
    held = np.array([False] * len(linear) + [True])
    weighted = np.concatenate((columns[..., :-1], columns[..., -1:] + 1 - roots[:, None]), axis=-1)
    found = non_negative(weighted, held, np.full(len(held), np.inf))
    for i, p in enumerate(linear):
        # a zero amplitude has no logarithm's slope to leave it by, and a bound none to come back
        amount = np.clip(found[:, i], max(p.low, 1e-4), 0.98 * p.high)
        if p.per_channel:
            amounts[p.name][:, colour] = amount
        else:
            amounts[p.name] = np.maximum(amounts[p.name], amount)


def _search(target: TargetModel, values: Mapping, goal: Goal, ends: tuple[float, int]) -> tuple[float, dict]:
    """Levenberg-Marquardt from `values`; shapes shared by the colours, amplitudes of their own. Gives rms ln too."""
    shared = [p for p in target.parameters if not p.per_channel]
    per_channel = [p for p in target.parameters if p.per_channel]
    colours = goal.wanted.shape[1]
    start = np.array([to_coordinate(p, values[p.name]) for p in shared])
    per_channel_start = np.array(
        [[to_coordinate(p, np.ravel(values[p.name])[c]) for p in per_channel] for c in range(colours)]
    ).reshape(colours, len(per_channel))
    low, high = coordinate_bounds(shared)
    per_channel_low, per_channel_high = coordinate_bounds(per_channel)

    def evaluated(x, y):
        """Residuals of coordinates x (sets, shared), y (sets, colours, per channel)."""
        sets = {p.name: from_coordinate(p, x[:, i]) for i, p in enumerate(shared)}
        sets |= {p.name: from_coordinate(p, y[:, :, j]) for j, p in enumerate(per_channel)}
        return goal.residual(target.of_sets(goal.geom, sets, colours))

    def residuals(x, y, slopes):
        if not slopes:
            return evaluated(x[None], y[None])[0]
        count = len(shared) + len(per_channel)
        xs, ys = np.repeat(x[None], 1 + count, axis=0), np.repeat(y[None], 1 + count, axis=0)
        steps = np.empty((count, colours))
        for i, p in enumerate(shared):
            steps[i] = _step(p, x[i])
            xs[1 + i, i] += steps[i, 0]
        for j, p in enumerate(per_channel, len(shared)):
            steps[j] = [_step(p, value) for value in y[:, j - len(shared)]]
            ys[1 + j, :, j - len(shared)] += steps[j]
        here, *moved = evaluated(xs, ys)
        slope = np.array([(each - here) / step for each, step in zip(moved, steps, strict=True)])
        slope = slope.reshape(count, *here.shape).transpose(2, 1, 0)
        return here, slope[:, :, : len(shared)], slope[:, :, len(shared) :]

    found = least_squares.minimise(
        residuals,
        start,
        per_channel_start,
        low=low,
        high=high,
        per_channel_low=per_channel_low,
        per_channel_high=per_channel_high,
        tolerance=ends[0],
        most=ends[1],
    )
    x, y = np.clip(found.shared, low, high), np.clip(found.per_channel, per_channel_low, per_channel_high)
    values = {p.name: from_coordinate(p, x[i]) for i, p in enumerate(shared)}
    values |= {p.name: from_coordinate(p, y[:, j]) for j, p in enumerate(per_channel)}
    return goal.rms(found.cost), values


def _step(p: Parameter, coordinate: float) -> float:
    """A difference that stays within the bounds."""
    step = STEP if p.log else STEP * max(p.high - p.low, 1e-3)
    return -step if coordinate + step > to_coordinate(p, p.high) else step
