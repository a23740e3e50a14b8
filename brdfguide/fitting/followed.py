"""Starts of one model, or held-out folds of it, followed side by side down to their minima."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ..numerics.descents import minimise_all
from . import reading
from .objective import Misfit

MOST_CHANNELS = 8  # with more, each by itself: the arrow of its normal equations is then worth more
MOST_VALUES = 40_000  # residuals of all together, which fit the processor's cache


@dataclass(frozen=True, eq=False)
class End:
    """Where a descent ended."""

    shared: np.ndarray  # (p,)
    per_channel: np.ndarray  # (channels, q)
    cost: float
    evaluations: int
    converged: bool


@dataclass(frozen=True, eq=False)
class Together:
    """Residuals of many surfaces of one model and their slopes, as `numerics.descents` wants them."""

    misfit: Misfit
    kept: np.ndarray | None = None  # (surfaces, samples): which values each of them looks at; None: at all

    def __call__(self, which, at) -> np.ndarray:
        misfit, layout = self.misfit, self.misfit.layout
        p, q = len(layout.shared), len(layout.per_channel)
        values = layout.decode_all(at[:, :p], at[:, p:].reshape(len(at), layout.channels, q))
        f, slopes = reading.many_with_slopes(layout, values, misfit.measurement.instrument)
        shape = len(at), layout.channels, len(misfit.weights)
        kept = None if self.kept is None else self.kept[which, None, :]
        stacked = np.empty((*shape[:2], p + q + 1, shape[2]))
        stacked[:, :, -1], factor = misfit.residuals_and_factor(np.broadcast_to(f, shape), kept)
        for place, key in enumerate(layout.shared + layout.per_channel):
            np.multiply(slopes[key], factor, out=stacked[:, :, place])
        misfit.within_range(f, stacked[:, :, :-1])
        return stacked


def follow(
    misfit: Misfit, starts: Sequence[tuple[np.ndarray, np.ndarray]], tolerance: float, most: int, kept=None
) -> list[End]:
    """Where descents from `starts` (shared, per_channel) end; those of `kept` (starts, samples) look at these values
    alone."""
    if not _goes_together(misfit, len(starts)):
        return [
            _end(misfit if kept is None else _part(misfit, kept[place]), start, tolerance, most)
            for place, start in enumerate(starts)
        ]
    layout = misfit.layout
    p, shape = len(layout.shared), (layout.channels, len(layout.per_channel))
    at = np.array([np.concatenate((shared, per_channel.ravel())) for shared, per_channel in starts])
    bounds = (
        np.concatenate((shared, np.tile(own, layout.channels)))
        for shared, own in zip(layout.bounds(layout.shared), layout.bounds(layout.per_channel), strict=True)
    )
    low, high = bounds
    ends = minimise_all(
        Together(misfit, kept),
        at,
        shared=p,
        channels=layout.channels,
        low=low,
        high=high,
        tolerance=tolerance,
        most=most,
    )
    found = zip(ends.at, ends.cost.tolist(), ends.evaluations.tolist(), ends.converged.tolist(), strict=True)
    return [End(row[:p], row[p:].reshape(shape), *rest) for row, *rest in found]


def _goes_together(misfit: Misfit, count: int) -> bool:
    """Whether one call can evaluate all of them, and is worth it."""
    layout, instrument = misfit.layout, misfit.measurement.instrument
    beam = instrument.solid_angle is not None and layout.model.has_mirror
    few = layout.channels <= MOST_CHANNELS and count * misfit.weights.size <= MOST_VALUES
    return count > 1 and few and not (layout.walks or beam)


def _part(misfit: Misfit, kept) -> Misfit:
    return replace(misfit, measurement=misfit.measurement[kept], weights=misfit.weights[kept])


def _end(misfit: Misfit, start, tolerance: float, most: int) -> End:
    found = misfit.descend(start, tolerance, most)
    return End(found.shared, found.per_channel, found.cost, found.evaluations, found.converged)
