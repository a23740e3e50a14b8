"""Fits a target's own law to the chosen model: bounded, in ln, from several starts.

A `TargetModel` is a renderer's BRDF as that renderer evaluates it. Its parameters are the numbers of its file, so that
their bounds are the ranges its reader documents and nothing outside them can be written.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import product

import numpy as np

from ..fitting.layout import coordinate_bounds, from_coordinate, to_coordinate
from ..models.model import Parameter
from ..numerics import least_squares
from ..numerics.nonnegative import non_negative
from ..physics.geometry import Geometry
from ._directions import rms_ln

FAR = 1.5  # a second start this much worse than the first is not searched from
STEP = 1e-6  # of a parameter's scale, for differences
DARKEST = 1e-13  # of what is wanted: bounds the residual of a law that vanishes, in the search only


@dataclass(frozen=True)
class TargetModel:
    """brdf(geom, **values) -> (samples, colours) [1/sr]; per-channel parameters have one value a colour."""

    parameters: tuple[Parameter, ...]
    brdf: Callable[..., np.ndarray]
    fixed: Mapping = field(default_factory=dict)  # held parameters, which the file needs too

    def at(self, geom: Geometry, values: Mapping) -> np.ndarray:
        return self.brdf(geom, **values)

    def with_fixed(self, **fixed) -> "TargetModel":
        """The same law with some parameters held; alike for all colours as one number, so that grey stays grey."""
        fixed = {name: float(np.ravel(value)[0]) if np.ptp(value) == 0 else value for name, value in fixed.items()}
        free = tuple(p for p in self.parameters if p.name not in fixed)
        return TargetModel(free, lambda geom, **values: self.brdf(geom, **fixed, **values), {**self.fixed, **fixed})


@dataclass(frozen=True)
class Refit:
    """Parameters of the law (per-channel ones as arrays) and what is left."""

    values: dict
    rms_ln: float


def refit(target: TargetModel, wanted: np.ndarray, geom: Geometry, refine: int = 2) -> Refit:
    """The law's parameters nearest to `wanted` (samples, colours; NaN: does not count) in rms ln."""
    grey = bool(np.all((wanted == wanted[:, :1]) | ~np.isfinite(wanted)))
    shown = wanted[:, :1] if grey else wanted
    begun = sorted((_start(target, values, shown, geom) for values in _starts(target)), key=lambda each: each[0])
    near = [values for error, values in begun[:refine] if error <= FAR * begun[0][0]]
    return min((_search(target, values, shown, geom) for values in near), key=lambda each: each.rms_ln)


def _starts(target: TargetModel):
    searched = [p for p in target.parameters if not p.linear]
    for combination in product(*(p.starts or (p.default,) for p in searched)):
        yield dict(zip((p.name for p in searched), combination, strict=True))


def _start(target: TargetModel, values: dict, wanted, geom) -> tuple[float, dict]:
    """Amplitudes for given shapes: least squares of the relative error, none negative; with its rms ln."""
    colours = wanted.shape[1]
    values = {
        name: np.full(colours, value) if _parameter(target, name).per_channel else value
        for name, value in values.items()
    }
    linear = [p for p in target.parameters if p.linear]
    nothing: dict = {p.name: np.zeros(colours) if p.per_channel else 0.0 for p in linear}
    if linear:
        rest = np.broadcast_to(target.brdf(geom, **values, **nothing), wanted.shape)
        basis = [
            np.broadcast_to(target.brdf(geom, **values, **{**nothing, p.name: nothing[p.name] + 1.0}), wanted.shape)
            - rest
            for p in linear
        ]
        for colour in range(colours):
            counted = np.isfinite(wanted[:, colour])
            # beyond 1e100 times what is wanted it does not matter by how much, and its square must not overflow
            columns = np.minimum([each[counted, colour] / wanted[counted, colour] for each in (*basis, rest)], 1e100).T[
                None
            ]
            held = np.array([False] * len(basis) + [True])
            amounts = non_negative(columns, held, np.full(len(held), np.inf))[0]
            for p, amount in zip(linear, amounts[:-1], strict=True):
                # a zero amplitude has no logarithm's slope to leave it by, and a bound none to come back
                amount = np.clip(amount, max(p.low, 1e-4), 0.98 * p.high)
                if p.per_channel:
                    nothing[p.name][colour] = amount
                else:
                    nothing[p.name] = max(nothing[p.name], amount)
    values = {**values, **nothing}
    residual = _residual(target.brdf(geom, **values), wanted)
    return float(np.sqrt(np.mean(residual**2))), values


def _search(target: TargetModel, values: dict, wanted, geom) -> Refit:
    """Levenberg-Marquardt from `values`; shapes shared by the colours, amplitudes of their own."""
    shared = [p for p in target.parameters if not p.per_channel]
    per_channel = [p for p in target.parameters if p.per_channel]
    colours = wanted.shape[1]
    start = np.array([to_coordinate(p, values[p.name]) for p in shared])
    per_channel_start = np.array(
        [[to_coordinate(p, values[p.name][c]) for p in per_channel] for c in range(colours)]
    ).reshape(colours, len(per_channel))

    def unpack(x, y):
        named = {p.name: from_coordinate(p, x[i]) for i, p in enumerate(shared)}
        return named | {p.name: from_coordinate(p, y[:, j]) for j, p in enumerate(per_channel)}

    def residuals(x, y, slopes):
        r = _residual(target.brdf(geom, **unpack(x, y)), wanted)
        if not slopes:
            return r
        j_shared = np.empty((colours, len(geom), len(shared)))
        j_per_channel = np.empty((colours, len(geom), len(per_channel)))
        for i, p in enumerate(shared):
            step = _step(p, x[i])
            moved = x.copy()
            moved[i] += step
            j_shared[:, :, i] = ((_residual(target.brdf(geom, **unpack(moved, y)), wanted) - r) / step).T
        for j, p in enumerate(per_channel):
            steps = np.array([_step(p, value) for value in y[:, j]])
            moved = y.copy()
            moved[:, j] += steps
            j_per_channel[:, :, j] = ((_residual(target.brdf(geom, **unpack(x, moved)), wanted) - r) / steps).T
        return r, j_shared, j_per_channel

    low, high = coordinate_bounds(shared)
    per_channel_low, per_channel_high = coordinate_bounds(per_channel)
    found = least_squares.minimise(
        residuals,
        start,
        per_channel_start,
        low=low,
        high=high,
        per_channel_low=per_channel_low,
        per_channel_high=per_channel_high,
        tolerance=1e-6,
        most=40,
    )
    values = unpack(np.clip(found.shared, low, high), np.clip(found.per_channel, per_channel_low, per_channel_high))
    return Refit(values, rms_ln(target.brdf(geom, **values), wanted))


def _residual(written, wanted):
    """ln(written / wanted), 0 where it does not count."""
    counted = np.isfinite(wanted)
    wanted = np.where(counted, wanted, 1.0)
    written = np.where(counted, np.broadcast_to(written, wanted.shape), 1.0)
    return np.where(counted, np.log(np.maximum(written, DARKEST * wanted) / wanted), 0.0)


def _parameter(target: TargetModel, name: str) -> Parameter:
    return next(p for p in target.parameters if p.name == name)


def _step(p: Parameter, coordinate: float) -> float:
    """A difference that stays within the bounds."""
    step = STEP if p.log else STEP * max(p.high - p.low, 1e-3)
    return -step if coordinate + step > to_coordinate(p, p.high) else step
