"""What a fit makes small: the distance between a model and a measurement, and its derivatives.

Parameters live in two blocks, those that all channels share and those that each channel has for itself,
and in coordinates in which a fit walks well: the logarithm for widths, the value itself for amplitudes.
"""

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from . import predict
from .errors import choices
from .geometry import Geometry
from .measurement import Measurement
from .models import Sum
from .models._base import Parameter

LARGE, THREADS = 32_768, 2  # directions beyond which blocks and threads pay
STEP = 1e-5  # of a coordinate, for central differences
STEEPEST = 1e140  # d residual / d coordinate beyond which only its sign is kept
SMALLEST = 1e-300  # where a law underflows its logarithm is taken here: far off, but finite


@dataclass(frozen=True)
class Metric:
    """A scale on which reflectances are compared: residual = scale(model) - scale(data)."""

    name: str
    scale: Callable[[np.ndarray], np.ndarray]
    slope: Callable[[np.ndarray], np.ndarray]  # d scale / d f
    emphasis: str
    relative: bool = False  # divide by the data: the scale then sees model/data
    cosine: bool = False  # weigh by the light that arrives and leaves


METRICS = {
    metric.name: metric
    for metric in (
        Metric("ln", np.log, np.reciprocal, "every ratio alike, the dark flanks as much as the peak (Weber's law)"),
        Metric("cube-root", np.cbrt, lambda f: np.cbrt(f) / (3 * f), "lightness: the bright parts more than the flanks"),
        Metric("relative", lambda f: f, np.ones_like, "too much is worse than too little", relative=True),
        Metric("cosine", lambda f: f, np.ones_like, "energy: the peak near normal incidence, hardly anything at grazing", cosine=True),
    )
}


def metric(name: str) -> Metric:
    """Raises InputError for a scale that is not one of METRICS."""
    if name not in METRICS:
        raise choices("metric", name, METRICS)
    return METRICS[name]


@dataclass(frozen=True, eq=False)
class Layout:
    """Which parameters of a sum are searched for, and where in the two blocks each stands."""

    model: Sum
    channels: int
    shape_per_channel: bool = False

    @cached_property
    def parameters(self) -> dict[str, Parameter]:
        """Those that are free, in the order of the sum."""
        freed = set(self.model.free)
        return {
            key: p for key, p in self.model.parameters.items() if key not in self.model.fixed and (p.free or key in freed)
        }  # fmt: skip

    @cached_property
    def shared(self) -> tuple[str, ...]:
        return tuple(key for key, p in self.parameters.items() if not (p.per_channel or self.shape_per_channel))

    @cached_property
    def own(self) -> tuple[str, ...]:
        return tuple(key for key, p in self.parameters.items() if p.per_channel or self.shape_per_channel)

    @cached_property
    def by_term(self) -> list[tuple]:
        """Each term with the keys of its parameters by their bare names, and the names of those that are searched for."""
        out = []
        for term in self.model.terms:
            keys = {p.name: f"{term.label}.{p.name}" for p in term.model.parameters}
            out.append((term.model, keys, [name for name, key in keys.items() if key in self.parameters]))
        return out

    @property
    def count(self) -> int:
        """Free numbers in all."""
        return len(self.shared) + self.channels * len(self.own)

    def bounds(self, keys) -> tuple[np.ndarray, np.ndarray]:
        ends = [(to_coordinate(self.parameters[key], self.parameters[key].low), to_coordinate(self.parameters[key], self.parameters[key].high)) for key in keys]
        return np.array([low for low, _ in ends]), np.array([high for _, high in ends])

    @cached_property
    def alike(self) -> list[list[str]]:
        """Groups of labels that stand for the same law: lobes that may be exchanged."""
        groups: dict[int, list[str]] = {}
        for term in self.model.terms:
            groups.setdefault(id(term.model), []).append(term.label)
        return [labels for labels in groups.values() if len(labels) > 1]

    def in_order(self, shared, own) -> tuple[np.ndarray, np.ndarray]:
        """The same surface with lobes of one kind in ascending order of their first shape, so that two fits compare."""
        shared, own = shared.copy(), own.copy()
        for labels in self.alike:
            for keys, block in ((self.shared, shared), (self.own, own.T)):
                names = [key.removeprefix(labels[0] + ".") for key in keys if key.startswith(labels[0] + ".")]
                places = np.array([[keys.index(f"{label}.{name}") for name in names] for label in labels], int)
                if keys is self.shared:
                    order = np.argsort(shared[places[:, 0]], kind="stable") if names else np.arange(len(labels))
                block[places] = block[places[order]].copy()
        return shared, own

    def encode(self, values: Mapping) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates (p,) and (channels, q) of `values`; what is not given keeps its default."""
        values = {**self.model.defaults(), **values}
        shared = np.array([float(np.mean(to_coordinate(self.parameters[key], np.asarray(values[key], float)))) for key in self.shared])
        own = np.empty((self.channels, len(self.own)))
        for place, key in enumerate(self.own):
            own[:, place] = to_coordinate(self.parameters[key], np.asarray(values[key], float))
        return shared, own

    def decode(self, shared, own) -> dict:
        """Values of every parameter of the sum: floats, or arrays (channels,) for those that each channel has."""
        values = self.model.defaults()
        values.update({key: float(from_coordinate(self.parameters[key], at)) for key, at in zip(self.shared, shared.tolist())})
        values.update({key: from_coordinate(self.parameters[key], own[:, place]) for place, key in enumerate(self.own)})
        return values


def to_coordinate(parameter: Parameter, value):
    return np.log(np.maximum(np.asarray(value) - parameter.origin, 1e-300)) if parameter.log else value


def from_coordinate(parameter: Parameter, coordinate):
    if not parameter.log:
        return coordinate
    return np.minimum(np.maximum(parameter.origin + np.exp(coordinate), parameter.low), parameter.high)


def slope_of_coordinate(parameter: Parameter, value):
    """dp/du."""
    return value - parameter.origin if parameter.log else 1.0


@dataclass(frozen=True, eq=False)
class Misfit:
    """Weighted residuals of a sum against a measurement, as `levenberg.minimise` wants them."""

    layout: Layout
    measurement: Measurement
    metric: Metric
    weights: np.ndarray  # (samples, channels), 0 where the value is missing; residuals are multiplied by their roots

    @cached_property
    def _root_weights(self):
        weights = np.where(self.measurement.usable, self.weights, 0.0)
        geom = self.measurement.geom
        return np.asfortranarray(np.sqrt(weights) * (geom.cos_i * geom.cos_r if self.metric.cosine else 1.0))

    @cached_property
    def _data(self):
        """The measurement with a harmless 1 where there is none; in memory channel by channel, as the laws are evaluated."""
        return np.asfortranarray(np.where(self.measurement.usable, self.measurement.brdf, 1.0))

    @cached_property
    def _scaled_data(self):
        return 1.0 if self.metric.relative else self.metric.scale(self._data)

    def __call__(self, shared, own, want_jacobian: bool):
        values = self.layout.decode(shared, own)
        if not want_jacobian:
            f = seen(self.layout.model, self.measurement, values)
            return self._residual(f if f.min() > SMALLEST else np.maximum(f, SMALLEST))
        f, slopes = seen_with_slopes(self.layout, self.measurement, values)
        least = f.min()
        lit = f if least > SMALLEST else np.maximum(f, SMALLEST)
        factor = self._root_weights * (1 / self._data if self.metric.relative else self.metric.slope(lit))
        if lit is not f and not self.metric.relative:  # a law that has underflowed has no slope left to follow
            factor = np.where(f > SMALLEST, factor, 0.0)
        stacked = self._stack(slopes, factor)
        if not least > 1 / STEEPEST:  # where the whole sum has underflowed, an amplitude's slope must not overflow when it is squared
            np.clip(stacked, -STEEPEST, STEEPEST, out=stacked)
        return self._residual(lit), *np.split(np.swapaxes(stacked, 1, 2), [len(self.layout.shared)], axis=2)

    def _residual(self, f):
        scaled = f / self._data if self.metric.relative else self.metric.scale(f)
        return self._root_weights * (scaled - self._scaled_data)

    def _stack(self, slopes, factor):
        """(channels, parameters, samples) of d residual / d coordinate, the shared ones first."""
        keys = self.layout.shared + self.layout.own
        stacked = np.empty((factor.shape[1], len(keys), len(factor)))
        for place, key in enumerate(keys):
            np.multiply(slopes[key].T, factor.T, out=stacked[:, place])
        return stacked


def seen(model: Sum, measurement: Measurement, values: Mapping) -> np.ndarray:
    """What the instrument would read (samples, channels): the mean over its aperture, and the mirror beam inside it."""
    total = sum(weight * evaluate(model, geom, values) for weight, geom in measurement.views)
    if measurement.solid_angle is None or not model.has_mirror:
        return total
    return total + model.mirror(measurement.geom.where_lit(), values) * predict.spike(measurement.geom, measurement.solid_angle)


def seen_with_slopes(layout: Layout, measurement: Measurement, values: Mapping):
    """`seen`, and its derivative with respect to each free coordinate; the mirror beam's by central differences."""
    if len(measurement.views) == 1:
        total, slopes = with_slopes(layout, measurement.geom, values)
    else:
        total, slopes = 0.0, dict.fromkeys(layout.parameters, 0.0)
        for weight, geom in measurement.views:
            part, part_slopes = with_slopes(layout, geom, values)
            total = total + weight * part
            slopes = {key: slopes[key] + weight * slope for key, slope in part_slopes.items()}
    if measurement.solid_angle is None or not layout.model.has_mirror:
        return total, slopes
    beam, geom = predict.spike(measurement.geom, measurement.solid_angle), measurement.geom.where_lit()
    total = total + layout.model.mirror(geom, values) * beam
    for key, parameter in layout.parameters.items():
        at = to_coordinate(parameter, np.asarray(values[key], float))
        ends = [layout.model.mirror(geom, {**values, key: from_coordinate(parameter, at + step)}) for step in (STEP, -STEP)]
        slopes[key] = slopes[key] + (ends[0] - ends[1]) / (2 * STEP) * beam
    return total, slopes


def evaluate(model: Sum, geom: Geometry, values: Mapping) -> np.ndarray:
    """The sum at every direction (samples, channels), in blocks that fit the cache; two threads for a large table."""
    channels = max((np.size(value) for value in values.values()), default=1)
    channels = max(channels, np.size(geom.wavelength))
    lying = _lying(values)
    if len(geom) <= LARGE:
        return np.broadcast_to(model(geom.lying, lying).T, (len(geom), channels))
    out = np.empty((len(geom), channels))

    def fill(block) -> None:
        rows, part = block
        out[rows] = model(part.lying, lying).T

    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(fill, geom.blocks()))
    return out


def with_slopes(layout: Layout, geom: Geometry, values: Mapping) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """The sum and its derivative with respect to each free coordinate, amplitudes taken out of the laws.

    A law without an analytic gradient is differenced centrally in the coordinate of its parameter.
    """
    total, slopes = 0.0, {}
    geom, values = geom.lying, _lying(values)
    for model, keys, free in layout.by_term:
        own = {name: values[key] for name, key in keys.items()}
        amplitude = model.amplitude
        height = own.get(amplitude, 1.0)
        unit = {**own, amplitude: 1.0} if amplitude else own
        wanted = [name for name in free if name != amplitude]
        known = model.gradient(geom, wanted, **unit) if model.gradient and wanted else {}
        shape = known[amplitude] if amplitude in known else model(geom, **unit)
        total = total + height * shape
        if amplitude in free:
            slopes[keys[amplitude]] = shape
        for name in wanted:
            parameter = model.parameter(name)
            if name in known:
                slope = known[name] * (slope_of_coordinate(parameter, own[name]) * height)
            else:
                slope = height * _difference(model, geom, unit, parameter)
            slopes[keys[name]] = slope
    return np.transpose(total), {key: np.transpose(slope) for key, slope in slopes.items()}


def _lying(values: Mapping) -> dict:
    """Values of each channel (channels,) as (channels, 1), to go with `Geometry.lying`."""
    return {key: np.reshape(value, (-1, 1)) if np.ndim(value) else value for key, value in values.items()}


def _difference(model, geom: Geometry, values: dict, parameter: Parameter):
    """Central difference in the coordinate, one-sided at a bound."""
    at = to_coordinate(parameter, np.asarray(values[parameter.name], float))
    low, high = to_coordinate(parameter, parameter.low), to_coordinate(parameter, parameter.high)
    above, below = np.minimum(at + STEP, high), np.maximum(at - STEP, low)
    ends = [model(geom, **{**values, parameter.name: from_coordinate(parameter, end)}) for end in (above, below)]
    return (ends[0] - ends[1]) / (above - below)
