"""Starts of models, or held-out folds of them, followed side by side down to their minima."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from ..numerics.descents import Descents, Ends, Equations, minimise_all
from ..records import dataclass
from . import reading
from .layout import Layout
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
    equations: tuple[np.ndarray, np.ndarray] | None = None  # slope and normal equations there, if others may go on


@dataclass(frozen=True, eq=False)
class Together:
    """Residuals of many surfaces of one model and their slopes, as `numerics.descents` wants them."""

    misfit: Misfit
    kept: np.ndarray | None = None  # (surfaces, samples): which values each of them looks at; None: at all
    begun: tuple[np.ndarray, reading.Kept] | None = None  # coordinates of a surface of which the reading is kept

    def __call__(self, which, at) -> np.ndarray:
        misfit, layout = self.misfit, self.misfit.layout
        p, q = len(layout.shared), len(layout.per_channel)
        one = at[0, 0] == at[-1, 0] and len(at) > 1 and bool((at == at[0]).all())  # folds begin at one surface
        f, slopes = self._reading(at[:1] if one else at)
        shape = len(at), layout.channels, len(misfit.weights)
        kept = None if self.kept is None else self.kept[which, None, :]
        stacked = np.empty((*shape[:2], p + q + 1, shape[2]))
        whole = (1, *shape[1:]) if one else shape
        f = f if np.shape(f) == whole else np.broadcast_to(f, whole)
        residual, factor, least = misfit.residuals_and_factor(f, None if one else kept)
        if one and kept is not None:
            residual, factor = residual * kept, factor * kept
        stacked[:, :, -1] = residual
        for place, key in enumerate(layout.shared + layout.per_channel):
            np.multiply(slopes[key], factor, out=stacked[:, :, place])
        misfit.within_range(least, stacked[:, :, :-1])
        return stacked

    def _reading(self, at) -> tuple[np.ndarray, dict[str, np.ndarray]]:
        if self.begun is not None and len(at) == 1 and bool((at[0] == self.begun[0]).all()):
            known = self.begun[1]
            return known.reading.T[None], {key: slope.T[None] for key, slope in known.slopes.items()}
        layout, instrument = self.misfit.layout, self.misfit.measurement.instrument
        return reading.many_with_slopes(layout, layout.decode_all(at), instrument, self._constant)

    @cached_property
    def _constant(self) -> dict:
        """What terms of which nothing but the amplitude is searched for give at each view."""
        return {}


@dataclass(frozen=True, eq=False)
class Following:
    """Descents of one model."""

    misfit: Misfit
    starts: Sequence[tuple[np.ndarray, np.ndarray]]  # (shared, per_channel)
    kept: np.ndarray | None = None  # (starts, samples): which values each of them looks at; None: at all
    known: Sequence[End] | None = None  # where other descents on the same values ended, if these begin there
    begun: reading.Kept | None = None  # what is read of the surface at which all begin

    @classmethod
    def on(cls, misfit: Misfit, ends: Sequence[End]) -> "Following":
        """Descents that go on, on the same values, from where others ended."""
        return cls(misfit, [(end.shared, end.per_channel) for end in ends], known=ends)

    @property
    def goes_together(self) -> bool:
        """Whether one call can evaluate all of them, and is worth it."""
        layout, instrument = self.misfit.layout, self.misfit.measurement.instrument
        beam = instrument.solid_angle is not None and layout.model.has_mirror
        few = layout.channels <= MOST_CHANNELS and len(self.starts) * self.misfit.weights.size <= MOST_VALUES
        searched = bool(self.starts) and bool(layout.shared or layout.per_channel)
        return searched and few and not (layout.walks or beam)

    def family(self) -> Descents:
        """The same as `numerics.descents` wants it."""
        layout = self.misfit.layout
        low, high = (
            np.concatenate((shared, np.tile(own, layout.channels)))
            for shared, own in zip(layout.bounds(layout.shared), layout.bounds(layout.per_channel), strict=True)
        )
        at = np.array([np.concatenate((shared, per_channel.ravel())) for shared, per_channel in self.starts])
        together = Together(self.misfit, self.kept, None if self.begun is None else (at[0], self.begun))
        known = _known(self.known or ())
        return Descents(together, at, len(layout.shared), layout.channels, low, high, known)

    def one_by_one(self, tolerance: float, most: int) -> list[End]:
        """Each of them by itself."""
        return [
            _end(self.misfit if self.kept is None else _part(self.misfit, self.kept[place]), start, tolerance, most)
            for place, start in enumerate(self.starts)
        ]


def follow(followings: Sequence[Following], tolerance: float, most: int, foreseen: bool = False) -> list[list[End]]:
    """Where the descents of each model end, those of all models side by side; `foreseen` as in `minimise_all`."""
    together = [each for each in followings if each.goes_together]
    families = [each.family() for each in together]
    found = iter(minimise_all(families, tolerance=tolerance, most=most, foreseen=foreseen))
    return [
        _ends(each.misfit.layout, next(found), foreseen) if each.goes_together else each.one_by_one(tolerance, most)
        for each in followings
    ]


def _ends(layout: Layout, ends: Ends, foreseen: bool) -> list[End]:
    p, shape = len(layout.shared), (layout.channels, len(layout.per_channel))
    found = zip(ends.at, ends.cost.tolist(), ends.evaluations.tolist(), ends.converged.tolist(), strict=True)
    return [
        End(
            row[:p],
            row[p:].reshape(shape),
            cost,
            evaluations,
            converged,
            None if foreseen else (ends.slope[place], ends.normal[place]),
        )
        for place, (row, cost, evaluations, converged) in enumerate(found)
    ]


def _known(ends: Sequence[End]) -> Equations | None:
    """The equations where these ended; None where those of any are not known."""
    found = [end.equations for end in ends if end.equations is not None]
    if not found or len(found) < len(ends):
        return None
    slope, normal = map(np.array, zip(*found, strict=True))
    return np.array([end.cost for end in ends]), slope, normal


def _part(misfit: Misfit, kept) -> Misfit:
    return replace(misfit, measurement=misfit.measurement[kept], weights=misfit.weights[kept])


def _end(misfit: Misfit, start, tolerance: float, most: int) -> End:
    found = misfit.descend(start, tolerance, most)
    return End(found.shared, found.per_channel, found.cost, found.evaluations, found.converged)
