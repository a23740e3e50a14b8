"""How a fitted model behaves where it was not fitted: left-out angles and turns, toward grazing, imitated spikes."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ..data.measurement import Measurement
from ..data.turning import turn_of_each, turns_deg
from ..finding import Finding
from ..flags import Effect
from ..formed import formed
from ..models import Composite
from ..models.surface import Surface
from ..physics.aperture import Instrument
from ..physics.directions import gathered
from ..physics.geometry import Geometry, in_plane, rows
from ..records import dataclass
from . import starting_grid
from .choosing import recommending
from .fit import Fit, FitOptions
from .followed import End, Following, follow
from .layout import Layout, layout_of
from .objective import Misfit, metric
from .prepared import few_channels
from .ranked import HeldOut, LeftOut, Ranking
from .reading import kept_of, many, reading
from .residuals import ln_residuals

FOLDS = 4  # groups of incidence angles, each left out in turn; the highest angles are the last
SAMPLES = 500  # directions for the repeated fits
WORSE = 1.25  # times the held-out error of the best single lobe, beyond which the same is said (ours)
MOST_GROWN = 88.0  # degrees of incidence; nothing is compared at the horizon itself
IMITATION = 2.5  # held-out error over fitted error beyond which a model is said to imitate (ours)


def held_out(fits: Sequence[Fit], used: Measurement, options: FitOptions = FitOptions()) -> list[HeldOut | None]:
    """Refits each without each group of incidence angles and predicts it; None with fewer than two groups that can be
    told.

    A group none of whose values is clear of the dark level has no error on a scale of ratios: it helps to fit the
    others and is not held out itself. `used` is what `thinned` leaves of the measurement that the fits were made to.
    """
    return held_out_from([(fit.model, fit.thinned.values) for fit in fits], used, options)


def held_out_from(
    models: Sequence[tuple[Composite, Mapping]], used: Measurement, options: FitOptions = FitOptions()
) -> list[HeldOut | None]:
    """The same of models that were fitted to all of `used` with these values."""
    if not can_hold_out(used):
        return [None] * len(models)
    folds = _divided(used)
    kept, followings = np.array([fold.kept for fold in folds]), []
    for model, values in models:
        layout = layout_of(model, used.brdf.shape[1], options.shape_per_channel)
        misfit = Misfit(layout, used, metric(options.metric), np.ones_like(used.brdf))
        known = kept_of(Surface(model, values, used.channels, used.geom.wavelength), used.instrument)
        begun = known if known is not None and known.layout is layout else None
        followings.append(Following(misfit, [layout.encode(values)] * len(folds), kept, begun=begun))
    found = follow(followings, 1e-4, 20, foreseen=True)
    return [_held_out(each, ends, folds) for each, ends in zip(followings, found, strict=True)]


def _held_out(following: Following, ends: list[End], folds: list["_Fold"]) -> HeldOut:
    squares, counts, last = 0.0, 0, np.nan
    for residuals in _foretold(following, ends, folds):
        known = residuals[np.isfinite(residuals)]
        square = float(known @ known)
        squares, counts = squares + square, counts + known.size
        last = float(np.sqrt(square / known.size)) if known.size else np.nan
    highest = folds[-1].inside
    told = highest.clear.any(axis=1)
    steepest = float(highest.geom.theta_i_deg[told].max())
    without = tuple(_left_out(following.misfit.layout, end, fold) for end, fold in zip(ends, folds, strict=True))
    return HeldOut(float(np.sqrt(squares / counts)), last, steepest, without)


def _left_out(layout: Layout, end: End, fold: "_Fold") -> LeftOut:
    values, theta_i = layout.decode(end.shared, end.per_channel), fold.inside.geom.theta_i_deg
    searched = {key: values[key] for key in (*layout.shared, *layout.per_channel)}
    return LeftOut((float(theta_i.min()), float(theta_i.max())), searched, fold.turns_deg)


def _foretold(following: Following, ends: list[End], folds: list["_Fold"]) -> Iterator[np.ndarray]:
    """ln(model/data) of each fold where it was left out; of all folds in one call where one can evaluate them."""
    layout, used = following.misfit.layout, following.misfit.measurement
    if not following.goes_together:
        for end, fold in zip(ends, folds, strict=True):
            yield ln_residuals(layout.surface(end.shared, end.per_channel, fold.inside), fold.inside)
        return
    at = np.array([np.concatenate((end.shared, end.per_channel.ravel())) for end in ends])
    read = many(layout, layout.decode_all(at), used.instrument)
    for each, fold in zip(read, folds, strict=True):
        inside = ~fold.kept
        residuals = np.log(np.maximum(each[:, inside].T, used.least)) - used.ln[inside]
        yield np.where(used.clear[inside], residuals, np.nan)


def can_hold_out(used: Measurement) -> bool:
    """Whether there are two groups of incidence angles that can be told."""
    return len(_divided(used)) > 1


def growth(fit: Fit, measurement: Measurement) -> dict | None:
    """R-mirror and R-max of model and data between the lowest and the highest incidence angle at which the mirror
    direction was measured (FIELDGUIDE section 6).

    R-mirror = f(mirror, high) / f(mirror, low);  R-max the same for the largest value in the plane of incidence. The
    model is taken at the measured direction nearest to the mirror's.
    """
    grown = _grown(measurement)
    if grown is None:
        return None
    read = reading(fit.surface.channel(measurement.brdf.shape[1] // 2), grown.at)
    model = [tuple(float(np.max(read[part])) for part in parts) for parts in grown.parts]
    angles, data = grown.angles, grown.data

    def ratio(pair, place):
        return pair[1][place] / pair[0][place] if pair[0][place] else np.nan

    return {
        "theta_i_deg": list(angles), "r_mirror": ratio(model, 0), "r_max": ratio(model, 1),
        "r_mirror_data": ratio(data, 0), "r_max_data": ratio(data, 1),
    }  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Grown:
    """Where the growth of a model is looked at, and what the data have there."""

    angles: tuple[float, float]  # of incidence [deg], the lowest and the highest
    at: Instrument  # all directions
    parts: list[tuple[slice, slice]]  # of each incidence the one nearest to the mirror's, and a scan
    data: list[tuple[float, float]]  # of each the value nearest to the mirror direction, and the largest


@formed
def _grown(measurement: Measurement) -> _Grown | None:
    """None where there are not two incidences to compare."""
    angles = _compared_incidences(measurement)
    if angles is None:
        return None
    # a peak beyond the last detector angle is in no data
    angular_range = min(85.0, float(np.max(measurement.geom.theta_r_deg)))
    theta_r = np.linspace(-angular_range, angular_range, 171)
    at, parts, data = list[Geometry](), [], []
    for place, theta in enumerate(angles):
        nearest, mirror, largest = _peaks(measurement, theta, measurement.brdf.shape[1] // 2)
        at += [nearest or rows(in_plane(theta, [theta])), rows(in_plane(theta, theta_r))]
        first = place * (1 + len(theta_r))
        parts.append((slice(first, first + 1), slice(first + 1, first + 1 + len(theta_r))))
        data.append((mirror, largest))
    together = Geometry(gathered([each.directions for each in at]))
    return _Grown(angles, Instrument(together, measurement.solid_angle), parts, data)


def imitation(fit: Fit, held: HeldOut | None, single: float = np.inf) -> Finding | None:
    """A model of several lobes that is right only at the angles it was fitted to: held out it errs several times as
    much, or clearly more than the best model of one lobe does there (`single`)."""
    if held is None or _lobes(fit) < 2 or held.rms_ln < min(IMITATION * fit.rms_ln, WORSE * single):
        return None
    text = f"held-out error {held.rms_ln:.2g} against {fit.rms_ln:.2g} fitted"
    text += f", where a single lobe has {single:.2g}" if held.rms_ln >= WORSE * single else ""
    text += ": its lobes imitate the data at the fitted angles only"
    return Finding("imitates", text, "warning", "do not use it between or beyond these angles")


def _lobes(fit: Fit) -> int:
    """How many of its terms are lobes of one kind."""
    return sum(term.label.rpartition(".")[2].isdigit() for term in fit.model.terms)


@formed
def thinned(measurement: Measurement) -> Measurement:
    """Few enough directions and channels for repeated fits."""
    rows, channels = thinned_rows(measurement), few_channels(measurement.brdf.shape[1])
    few = measurement if len(rows) == len(measurement.brdf) else measurement[rows]
    return few if len(channels) == measurement.brdf.shape[1] else few.of_channels(channels)


@formed
def thinned_rows(measurement: Measurement) -> np.ndarray:
    """Which rows those are, ascending: of those with a value about as many as repeated fits look at."""
    if measurement.has_value.all():
        return starting_grid.spread_rows(measurement, SAMPLES)
    known = np.flatnonzero(measurement.has_value)
    return known[starting_grid.spread_rows(measurement[measurement.has_value], SAMPLES)]


@dataclass(frozen=True, eq=False)
class _Fold:
    """What is kept, a mask (samples,), and what is held out."""

    kept: np.ndarray
    inside: Measurement
    turns_deg: tuple[float, ...]  # azimuths of the light that are held out; none where incidences are


@formed
def _divided(measurement: Measurement) -> list[_Fold]:
    """Only groups with a value that is clear of the dark level, in turn."""
    clear = measurement.clear.any(axis=1)
    by_incidence = [(inside, tuple[float, ...]()) for inside in _folds(measurement.geom.theta_i_deg[:, 0])]
    folds = [*_turned_folds(measurement), *by_incidence]
    return [_Fold(~inside, measurement[inside], turns) for inside, turns in folds if np.any(clear & inside)]


def _turned_folds(measurement: Measurement) -> list[tuple[np.ndarray, tuple[float, ...]]]:
    """Masks of turns of the sample, each left out, and their azimuths; none where what is left would be one turn."""
    turns = turn_of_each(measurement.geom)
    if turns is None or turns.max() < 2:
        return []
    groups, known = turns % FOLDS, turns_deg(measurement.geom.directions)
    return [(groups == each, tuple(known[each::FOLDS].tolist())) for each in np.unique(groups)]


def _folds(angles) -> list[np.ndarray]:
    """Masks of groups of like size of ascending incidences; the last holds the steepest alone if they are few."""
    distinct = np.unique(np.round(angles, 1))
    if len(distinct) <= FOLDS:
        return [np.abs(angles - each) < 0.06 for each in distinct] if len(distinct) > 1 else []
    edges = np.quantile(angles, np.linspace(0, 1, FOLDS + 1))
    edges[0], edges[-1] = -1.0, 91.0
    masks = [(angles > lower) & (angles <= upper) for lower, upper in pairwise(edges)]
    return [mask for mask in masks if np.any(mask) and not np.all(mask)]


@formed
def _compared_incidences(measurement: Measurement) -> tuple[float, float] | None:
    """The lowest and the highest incidence [deg] with a value near the mirror direction; with any value, where there
    are no two such; None where there are no two at all."""
    seen, low = _incidences_with_values(measurement), mirror_from_deg(measurement)
    high = next((theta for theta in reversed(seen) if _reads_mirror(measurement, theta)), None)
    if low is None or high is None or not low < high:
        return (seen[0], seen[-1]) if len(seen) > 1 else None
    return low, high


@formed
def mirror_from_deg(measurement: Measurement) -> float | None:
    """The lowest incidence [deg] with a value near the mirror direction; None where there is none."""
    seen = _incidences_with_values(measurement)
    return next((theta for theta in seen if _reads_mirror(measurement, theta)), None)


def _incidences_with_values(measurement: Measurement) -> list[float]:
    """In ascending order [deg]."""
    clear = measurement.clear[:, measurement.brdf.shape[1] // 2]
    return sorted(theta for theta, rows in measurement.incidences.items() if theta < MOST_GROWN and clear[rows].any())


def _reads_mirror(measurement: Measurement, theta: float) -> bool:
    return _peaks(measurement, theta, measurement.brdf.shape[1] // 2)[0] is not None


def _peaks(measurement: Measurement, theta: float, channel: int) -> tuple[Geometry | None, float, float]:
    """The direction nearest to the mirror's and its value (None and NaN where none lies within 3°), and the largest
    value in the plane of incidence."""
    part = measurement[measurement.incidences[theta]]
    part = part[part.clear[:, channel] & (part.geom.off_plane_deg[:, 0] < 3)]
    if not len(part.geom):
        return None, np.nan, np.nan
    values, away = part.brdf[:, channel], part.geom.mirror_distance2[:, 0]
    nearest = int(np.argmin(away))
    if away[nearest] > np.radians(3) ** 2:
        return None, np.nan, float(values.max())
    return part.geom[[nearest]], float(values[nearest]), float(values.max())


def validated(
    ranking: Ranking, measurement: Measurement, options: FitOptions = FitOptions(), progress=lambda name: None
) -> Ranking:
    """The same ranking with growth, held-out errors of what was refined, and a warning for models that imitate."""
    few, refined = thinned(measurement), []
    for row in ranking.rows:
        if not any(warning.effect is Effect.UNREFINED for warning in row.fit.warnings):
            progress(row.fit.name)
            refined.append(row.fit)
    found = dict(zip(map(id, refined), held_out(refined, few, options), strict=True))
    helds = [found.get(id(row.fit)) for row in ranking.rows]
    single = min(
        (held.rms_ln for row, held in zip(ranking.rows, helds, strict=True) if held and _lobes(row.fit) < 2),
        default=np.inf,
    )
    rows, lowest = [], mirror_from_deg(measurement)
    for row, held in zip(ranking.rows, helds, strict=True):
        warning = imitation(row.fit, held, single)
        warnings, grown = row.warnings + ((warning,) if warning else ()), growth(row.fit, measurement)
        rows.append(replace(row, held_out=held, growth=grown, mirror_from_deg=lowest, warnings=warnings))
    return recommending(replace(ranking, rows=tuple(rows)), measurement)
