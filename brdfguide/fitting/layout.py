"""Which parameters of a model a fit searches for, and the coordinates that it walks in.

Parameters live in two blocks, those that all channels share and those that each channel has for itself,
and in coordinates in which a fit walks well: the logarithm for widths, the value itself for amplitudes.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cached_property, lru_cache

import numpy as np

from ..data.measurement import Measurement
from ..models import Composite
from ..models.facts import Grain
from ..models.model import Parameter, Term
from ..models.surface import Surface
from ..records import dataclass
from . import grain_walk


@dataclass(frozen=True, eq=False)
class Layout:
    """Which parameters of a sum are searched for, and where in the two blocks each stands."""

    model: Composite
    channels: int
    shape_per_channel: bool = False
    walks: bool = False  # whether a grain's widths and axis are searched for together, see `grain_walk`

    @cached_property
    def parameters(self) -> dict[str, Parameter]:
        """Those that are free, in the order of the sum."""
        freed = set(self.model.free)
        found = {
            key: p
            for key, p in self.model.parameters.items()
            if key not in self.model.fixed and (p.free or key in freed)
        }
        absorbing = {f"{key.removesuffix('k')}n" for key in found if key.endswith(".k")}
        return {key: _below_one(p) if key in absorbing else p for key, p in found.items()}

    @cached_property
    def shared(self) -> tuple[str, ...]:
        return tuple(key for key, p in self.parameters.items() if not (p.per_channel or self.shape_per_channel))

    @cached_property
    def per_channel(self) -> tuple[str, ...]:
        return tuple(key for key, p in self.parameters.items() if p.per_channel or self.shape_per_channel)

    @cached_property
    def grains(self) -> list[tuple[Grain, tuple[str, str, str]]]:
        """The grains of which both widths and the axis are free and shared, and their keys."""
        found = []
        for term in self.model.terms:
            grain = term.model.grain
            keys = grain and (term.key(grain.first), term.key(grain.second), term.key("axis"))
            if grain and keys and set(keys) <= set(self.shared):
                found.append((grain, keys))
        return found

    def walking(self) -> "Layout":
        """The same in which a search walks: itself without a grain to look for."""
        return replace(self, walks=True) if self.grains else self

    def standing(self) -> "Layout":
        """The same in the law's own parameters."""
        return replace(self, walks=False) if self.walks else self

    @cached_property
    def by_term(self) -> list[tuple]:
        """Each term with the keys of its parameters by bare name, and the names of those that are searched for."""
        out = []
        for term in self.model.terms:
            free = [name for name, key in term.keys.items() if key in self.parameters]
            out.append((term.model, term.keys, free))
        return out

    @cached_property
    def by_law(self) -> list[list[int]]:
        """Places in `by_term` of terms of one law of which the same is searched for."""
        laws: dict[tuple, list[int]] = {}
        for place, (model, _, free) in enumerate(self.by_term):
            laws.setdefault((id(model), tuple(free)), []).append(place)
        return [places for places in laws.values() if len(places) > 1]

    @property
    def count(self) -> int:
        """Free numbers in all."""
        return len(self.shared) + self.channels * len(self.per_channel)

    def bounds(self, keys) -> tuple[np.ndarray, np.ndarray]:
        keys = tuple(keys)
        if keys not in self._bounds:
            self._bounds[keys] = coordinate_bounds([self.parameters[key] for key in keys])
        low, high = (each.copy() for each in self._bounds[keys])
        for _, of_grain in self.grains if self.walks else ():
            for key, least, most in zip(of_grain, *grain_walk.walk_bounds(), strict=True):
                if key in keys:
                    low[keys.index(key)], high[keys.index(key)] = least, most
        return low, high

    @cached_property
    def _bounds(self) -> dict[tuple[str, ...], tuple[np.ndarray, np.ndarray]]:
        """Of some keys."""
        return {}

    @cached_property
    def alike(self) -> list[list[str]]:
        """Groups of labels that stand for the same law: lobes that may be exchanged. Of lobes that share an index and
        one that has its own only the former may; nor may that of a metal whose height is F0.
        """
        laws: dict[tuple, list[Term]] = {}
        for term in self.model.terms:
            own_height = term.model.amplitude and term.key(term.model.amplitude) in self.parameters
            laws.setdefault((id(term.model), bool(own_height)), []).append(term)
        groups: list[list[str]] = []
        for terms in laws.values():
            owners = [term.key("k") if term.model.has_index else term.label for term in terms]
            if len(set(owners)) in (1, len(owners)):
                groups.append([term.label for term in terms])
            else:
                groups += [
                    [term.label for term, each in zip(terms, owners, strict=True) if each == owner]
                    for owner in dict.fromkeys(owners)
                ]
        return [labels for labels in groups if len(labels) > 1]

    def in_order(self, shared, per_channel) -> tuple[np.ndarray, np.ndarray]:
        """The same surface with lobes of one kind in ascending order of their first shape, so that two fits compare."""
        shared, per_channel = shared.copy(), per_channel.copy()
        for labels in self.alike:
            for keys, block in ((self.shared, shared), (self.per_channel, per_channel.T)):
                names = [key.removeprefix(labels[0] + ".") for key in keys if key.startswith(labels[0] + ".")]
                names = [name for name in names if all(f"{label}.{name}" in keys for label in labels)]
                places = np.array([[keys.index(f"{label}.{name}") for name in names] for label in labels], int)
                if keys is self.shared:
                    order = np.argsort(shared[places[:, 0]], kind="stable") if names else np.arange(len(labels))
                block[places] = block[places[order]].copy()
        return shared, per_channel

    def encode(self, values: Mapping) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates (p,) and (channels, q) of `values`; what is not given keeps its default."""
        values = {**self.model.defaults(), **values}
        shared = np.array([_mean(to_coordinate(self.parameters[key], values[key])) for key in self.shared])
        for grain, keys in self.grains if self.walks else ():
            start = (float(np.mean(values[key])) for key in keys)
            shared[[self.shared.index(key) for key in keys]] = grain_walk.walk_of(grain, *start)
        per_channel = np.empty((self.channels, len(self.per_channel)))
        for place, key in enumerate(self.per_channel):
            per_channel[:, place] = to_coordinate(self.parameters[key], np.asarray(values[key], float))
        return shared, per_channel

    def decode(self, shared, per_channel) -> dict:
        """Values of every parameter of the sum: floats, or arrays (channels,) for those that each channel has."""
        values = self.model.defaults()
        values.update(
            {
                key: float(from_coordinate(self.parameters[key], at))
                for key, at in zip(self.shared, shared.tolist(), strict=True)
            }
        )
        for grain, keys in self.grains if self.walks else ():
            at = [float(shared[self.shared.index(key)]) for key in keys]
            found = zip(keys, grain_walk.parameters_of(grain, *at), strict=True)
            values.update({key: float(_inside(self.parameters[key], value)) for key, value in found})
        values.update(
            {
                key: from_coordinate(self.parameters[key], per_channel[:, place])
                for place, key in enumerate(self.per_channel)
            }
        )
        return values

    def decode_all(self, at) -> dict:
        """Of many surfaces: coordinates (surfaces, p + channels q), the shared ones and then those of each channel, as
        values (surfaces, 1, 1), or (surfaces, channels, 1) of those that each channel has; floats of what is not
        searched for. No walks."""
        values, found, p = self._held.copy(), self._from_row(at), len(self.shared)
        for place, key in enumerate(self.shared):
            values[key] = found[:, place, None, None]
        own = found[:, p:].reshape(len(at), self.channels, -1)
        for place, key in enumerate(self.per_channel):
            values[key] = own[:, :, place, None]
        return values

    @cached_property
    def _held(self) -> dict:
        return self.model.defaults()

    @cached_property
    def _from_row(self) -> "_FromCoordinates":
        own = [self.parameters[key] for key in self.per_channel]
        return _FromCoordinates([*(self.parameters[key] for key in self.shared), *own * self.channels])

    def walked(self, slopes: dict, values: Mapping) -> dict:
        """Derivatives by the coordinates, from those by the coordinates of each parameter by itself."""
        for grain, keys in self.grains if self.walks else ():
            at = [float(values[key]) for key in keys]
            by = [
                slopes[key] / slope_of_coordinate(self.parameters[key], value)
                for key, value in zip(keys, at, strict=True)
            ]
            slopes |= dict(zip(keys, grain_walk.walk_slopes(grain, (at[0], at[1], at[2]), by), strict=True))
        return slopes

    def surface(self, shared, per_channel, measurement: Measurement) -> Surface:
        """What the coordinates stand for, in the channels of the measurement."""
        key = shared.tobytes(), per_channel.tobytes()
        if self._latest.get("key") != key:
            self._latest.update(key=key, values=self.decode(shared, per_channel))
        return Surface(self.model, self._latest["values"], measurement.channels, measurement.geom.wavelength)

    @cached_property
    def _latest(self) -> dict:
        """The coordinates that were last asked for, and what they stand for: one object, by which it is known again."""
        return {}


def _below_one(index: Parameter) -> Parameter:
    """An index that is searched for beside k: of a metal it may lie below 1."""
    return replace(index, low=index.least, origin=0.0)


def _mean(value) -> float:
    return float(np.mean(value)) if np.ndim(value) else float(value)


def to_coordinate(parameter: Parameter, value):
    return np.log(np.maximum(np.asarray(value) - parameter.origin, 1e-300)) if parameter.log else value


def from_coordinate(parameter: Parameter, coordinate):
    if parameter.period is not None:
        return np.remainder(coordinate, parameter.period)
    if not parameter.log:
        return coordinate
    return _inside(parameter, parameter.origin + np.exp(coordinate))


@lru_cache(maxsize=512)
def layout_of(model: Composite, channels: int, shape_per_channel: bool = False) -> Layout:
    """The layout of a sum, with what was formed of it for the last measurement."""
    return Layout(model, channels, shape_per_channel)


class _FromCoordinates:
    """Coordinates (..., parameters) as values, all of them at once."""

    def __init__(self, parameters: Sequence[Parameter]):
        self.log = np.array([p.log and p.period is None for p in parameters], bool)
        self.some, self.share = bool(self.log.any()), self.log.astype(float)
        self.low, self.high, self.origin = (
            np.array([getattr(p, name) for p in parameters], float) for name in ("low", "high", "origin")
        )
        self.periods = [(place, p.period) for place, p in enumerate(parameters) if p.period is not None]

    def __call__(self, at):
        values = at
        if self.some:
            values = self.origin + np.exp(at * self.share)
            values = np.where(self.log, np.minimum(np.maximum(values, self.low), self.high), at)
        if self.periods:
            values = values.copy()
            for place, period in self.periods:
                values[..., place] = np.remainder(at[..., place], period)
        return values


def _inside(parameter: Parameter, value):
    return np.minimum(np.maximum(value, parameter.low), parameter.high)


def coordinate_bounds(parameters: Sequence[Parameter]) -> tuple[np.ndarray, np.ndarray]:
    """The least and the greatest coordinates."""
    low, high = ([to_coordinate(p, getattr(p, end)) for p in parameters] for end in ("low", "high"))
    beyond = np.array([p.period or 0.0 for p in parameters])  # no end lies in the way of what comes back
    return np.array(low) - beyond, np.array(high) + beyond


def slope_of_coordinate(parameter: Parameter, value):
    """dp/du."""
    return value - parameter.origin if parameter.log else 1.0
