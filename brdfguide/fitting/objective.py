"""What a fit makes small: the distance between a model and a measurement, and its derivatives."""

from collections.abc import Callable
from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from ..data.measurement import SMALLEST, Measurement
from ..errors import choices
from ..numerics import least_squares
from ..numerics.least_squares import Minimum
from ..records import dataclass
from . import reading
from .layout import Layout

STEEPEST = 1e140  # d residual / d coordinate beyond which only its sign is kept


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
        Metric(
            "cube-root", np.cbrt, lambda f: np.cbrt(f) / (3 * f), "lightness: the bright parts more than the flanks"
        ),
        Metric("relative", lambda f: f, np.ones_like, "too much is worse than too little", relative=True),
        Metric(
            "cosine",
            lambda f: f,
            np.ones_like,
            "energy: the peak near normal incidence, hardly anything at grazing",
            cosine=True,
        ),
    )
}


SEEN = "seen"  # orders fits by what people see (`physics.seen`); it is no loss, and the fits are those of ln


def metric(name: str) -> Metric:
    """The loss of a scale. Raises InputError for one that is not SEEN or one of METRICS."""
    if name == SEEN:
        return METRICS["ln"]
    if name not in METRICS:
        raise choices("metric", name, [*METRICS, SEEN])
    return METRICS[name]


def _generalised(floor, f):
    """asinh(f / 2c): ln(f / c) where f is bright, f / 2c where it is dim, for which it need not be positive."""
    return np.arcsinh(f / (2 * floor))


def _generalised_slope(floor, f):
    return 1 / np.hypot(f, 2 * floor)


@dataclass(frozen=True, eq=False)
class Misfit:
    """Weighted residuals of a sum against a measurement, as `least_squares.minimise` wants them."""

    layout: Layout
    measurement: Measurement
    metric: Metric
    weights: np.ndarray  # (samples, channels), 0 where the value is missing; residuals are multiplied by their roots

    @cached_property
    def _metric(self) -> Metric:
        """The scale; in place of ln the generalised logarithm where values lie near the dark level."""
        noise = self.measurement.noise
        if self.metric.name != "ln" or noise is None or not noise.matters:
            return self.metric
        floor = noise.floor[:, None]
        return replace(self.metric, scale=partial(_generalised, floor), slope=partial(_generalised_slope, floor))

    @cached_property
    def _weighed(self):
        """Values that are looked at: on a scale of ratios only those clear of the dark level."""
        return self.measurement.clear if self.metric.relative else self.measurement.weighed

    @cached_property
    def _root_weights(self):
        """(channels, samples): channel by channel, as laws are evaluated."""
        weights = np.where(self._weighed, self.weights, 0.0)
        geom = self.measurement.geom
        weights = np.sqrt(weights) * (geom.cos_i * geom.cos_r if self.metric.cosine else 1.0)
        return np.ascontiguousarray(weights.T)

    @cached_property
    def _data(self):
        """The measurement, a harmless 1 where there is none, (channels, samples)."""
        return np.ascontiguousarray(np.where(self._weighed, self.measurement.brdf, 1.0).T)

    @cached_property
    def _scaled_data(self):
        return 1.0 if self.metric.relative else self._metric.scale(self._data)

    def __call__(self, shared, per_channel, want_jacobian: bool):
        if want_jacobian:
            return self.with_reading(shared, per_channel)[1:]
        surface = self.layout.surface(shared, per_channel, self.measurement)
        return self.of_reading(reading.reading(surface, self.measurement.instrument))

    def with_reading(self, shared, per_channel):
        """What the instrument would read (samples, channels); and residuals with their derivatives."""
        surface = self.layout.surface(shared, per_channel, self.measurement)
        f, slopes = reading.with_slopes(self.layout, surface, self.measurement.instrument)
        r, factor, least = self.residuals_and_factor(f.T)
        stacked = self._stack(slopes, factor)
        self.within_range(least, stacked)
        return f, r.T, *np.split(np.swapaxes(stacked, 1, 2), [len(self.layout.shared)], axis=2)

    def of_reading(self, f) -> np.ndarray:
        """Residuals of what an instrument would read, both (samples, channels)."""
        f = f.T
        return self._residual(f if f.min() > SMALLEST else np.maximum(f, SMALLEST), self._root_weights).T

    def between(self, one, other) -> np.ndarray:
        """Differences of the residuals of two readings, (samples, channels) each."""
        apart = self._metric.scale(np.maximum(one.T, SMALLEST)) - self._metric.scale(np.maximum(other.T, SMALLEST))
        return (self._root_weights * apart).T

    def residuals_and_factor(self, f, kept=None):
        """Residuals of f (..., channels, samples), and what makes slopes of f slopes of them; 0 where not `kept`. And
        the least of f."""
        least = f.min()
        lit = f if least > SMALLEST else np.maximum(f, SMALLEST)
        root_weights = self._root_weights if kept is None else self._root_weights * kept
        factor = root_weights * (1 / self._data if self.metric.relative else self._metric.slope(lit))
        if lit is not f and self._metric is METRICS["ln"]:  # a law that has underflowed has no slope left to follow
            factor = np.where(f > SMALLEST, factor, 0.0)
        return self._residual(lit, root_weights), factor, least

    @staticmethod
    def within_range(least, slopes) -> None:
        """Where a whole sum has underflowed, an amplitude's slope must not overflow when it is squared; `least` of the
        sum's values."""
        if not least > 1 / STEEPEST:
            np.clip(slopes, -STEEPEST, STEEPEST, out=slopes)

    def descend(self, start, tolerance: float, most: int = 400) -> Minimum:
        """The minimum that lies downhill from a start (shared, per_channel)."""
        (low, high), (per_channel_low, per_channel_high) = map(
            self.layout.bounds, (self.layout.shared, self.layout.per_channel)
        )
        bounds = {"low": low, "high": high, "per_channel_low": per_channel_low, "per_channel_high": per_channel_high}
        return least_squares.minimise(self, *start, **bounds, tolerance=tolerance, most=most)

    def _residual(self, f, root_weights):
        """Of f (..., channels, samples)."""
        scaled = f / self._data if self.metric.relative else self._metric.scale(f)
        scaled = scaled - self._scaled_data
        scaled *= root_weights
        return scaled

    def _stack(self, slopes, factor):
        """(channels, parameters, samples) of d residual / d coordinate, the shared ones first."""
        keys = self.layout.shared + self.layout.per_channel
        stacked = np.empty((len(factor), len(keys), factor.shape[1]))
        for place, key in enumerate(keys):
            np.multiply(slopes[key].T, factor, out=stacked[:, place])
        return stacked
