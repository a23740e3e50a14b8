"""How a fitted model behaves where it was not fitted: held-out incidence angles, growth toward grazing, imitated spikes."""

from dataclasses import dataclass, replace

import numpy as np

from . import fitting, levenberg, starts
from .fitting import Fit, Options
from .geometry import in_plane, once
from .measurement import Finding, Measurement
from .misfit import Layout, Misfit, metric
from .ranking import Ranking, recommend

FOLDS = 4  # groups of incidence angles, each left out in turn; the highest angles are the last
SAMPLES = 500  # directions for the repeated fits
WORSE = 1.25  # times the held-out error of the best single lobe, beyond which the same is said (ours)
IMITATION = 2.5  # held-out error over fitted error beyond which a model is said to imitate (ours)


@dataclass(frozen=True)
class HeldOut:
    """Errors at incidence angles that the fit did not see."""

    rms_ln: float  # over all folds
    highest_rms_ln: float  # the steepest incidence angles, predicted from the others
    highest_theta_i_deg: float


def held_out(fit: Fit, used: Measurement, options: Options = Options()) -> HeldOut | None:
    """Refits without each group of incidence angles and predicts it; None with fewer than two incidence angles.

    `used` is what `thinned` leaves of the measurement that the fit was made to.
    """
    folds = _divided(used)
    if len(folds) < 2:
        return None
    layout = Layout(fit.model, used.brdf.shape[1], options.shape_per_channel)
    picked = fitting.few_channels(max(np.size(value) for value in fit.values.values()))
    values = {key: value[picked] if np.ndim(value) else value for key, value in fit.values.items()}
    start = layout.encode(values)
    low, high = layout.bounds(layout.shared)
    own_low, own_high = layout.bounds(layout.own)
    squares, counts, last = 0.0, 0, np.nan
    for rest, inside in folds:
        misfit = Misfit(layout, rest, metric(options.metric), np.ones_like(rest.brdf))
        end = levenberg.minimise(misfit, *start, low=low, high=high, own_low=own_low, own_high=own_high, tolerance=1e-4, most=20)
        residuals = fitting.ln_residuals(fit.model, inside, layout.decode(end.shared, end.own))
        squares, counts = squares + np.nansum(residuals**2), counts + np.count_nonzero(np.isfinite(residuals))
        last = float(np.sqrt(np.nanmean(residuals**2)))
    return HeldOut(float(np.sqrt(squares / counts)), last, float(folds[-1][1].geom.theta_i_deg.max()))


def growth(fit: Fit, measurement: Measurement) -> dict | None:
    """R-mirror and R-max of model and data between the lowest and the highest incidence angle (FIELDGUIDE section 6).

    R-mirror = f(mirror, high) / f(mirror, low);  R-max the same for the largest value in the plane of incidence.
    """
    groups = measurement.theta_i_groups
    if len(groups) < 2:
        return None
    low, high = min(groups), max(groups)
    channel = measurement.brdf.shape[1] // 2
    values = {key: value[channel] if np.ndim(value) else value for key, value in fit.values.items()}
    wavelength = np.atleast_1d(measurement.geom.wavelength)[min(channel, np.size(measurement.geom.wavelength) - 1)]
    reach = min(85.0, float(np.max(measurement.geom.theta_r_deg)))  # a peak beyond the last detector angle is in no data
    theta_r = np.linspace(-reach, reach, 171)
    model = {}
    for name, theta in (("low", low), ("high", high)):
        sweep = fit.model(in_plane(theta, theta_r, wavelength), values)
        model[name] = float(fit.model(in_plane(theta, theta, wavelength), values)), float(np.max(sweep))
    data = {name: _peaks(measurement, groups[theta], channel, theta) for name, theta in (("low", low), ("high", high))}
    ratio = lambda pair, place: pair["high"][place] / pair["low"][place] if pair["low"][place] else np.nan  # noqa: E731
    return {
        "theta_i_deg": [low, high], "r_mirror": ratio(model, 0), "r_max": ratio(model, 1),
        "r_mirror_data": ratio(data, 0), "r_max_data": ratio(data, 1),
    }  # fmt: skip


def imitation(fit: Fit, held: HeldOut | None, single: float = np.inf) -> Finding | None:
    """A model of several lobes that is right only at the angles it was fitted to: held out it errs several times as much, or
    clearly more than the best model of one lobe does there (`single`)."""
    if held is None or _lobes(fit) < 2 or held.rms_ln < min(IMITATION * fit.rms_ln, WORSE * single):
        return None
    text = f"held-out error {held.rms_ln:.2g} against {fit.rms_ln:.2g} fitted"
    text += f", where a single lobe has {single:.2g}" if held.rms_ln >= WORSE * single else ""
    text += ": its lobes imitate the data at the fitted angles only"
    return Finding("imitates", text, "warning", "do not use it between or beyond these angles")


def _lobes(fit: Fit) -> int:
    """How many of its terms are lobes of one kind."""
    return sum(term.label.rpartition(".")[2].isdigit() for term in fit.model.terms)


def thinned(measurement: Measurement) -> Measurement:
    """Few enough directions and channels for repeated fits."""
    seen = measurement[measurement.seen]
    rows = starts.spread_rows(seen, SAMPLES)
    return seen[rows].of_channels(fitting.few_channels(measurement.brdf.shape[1]))


@once
def _divided(measurement: Measurement) -> list[tuple[Measurement, Measurement]]:
    """What is kept and what is held out, in turn."""
    return [(measurement[~inside], measurement[inside]) for inside in _folds(measurement.geom.theta_i_deg[:, 0])]


def _folds(angles) -> list[np.ndarray]:
    """Masks of groups of incidence angles of like size, in ascending order; the last holds the steepest alone if they are few."""
    distinct = np.unique(np.round(angles, 1))
    if len(distinct) <= FOLDS:
        return [np.abs(angles - each) < 0.06 for each in distinct] if len(distinct) > 1 else []
    edges = np.quantile(angles, np.linspace(0, 1, FOLDS + 1))
    edges[0], edges[-1] = -1.0, 91.0
    masks = [(angles > lower) & (angles <= upper) for lower, upper in zip(edges[:-1], edges[1:])]
    return [mask for mask in masks if np.any(mask) and not np.all(mask)]


def _peaks(measurement: Measurement, rows, channel: int, theta: float) -> tuple[float, float]:
    """Value nearest the mirror direction (NaN if none within 3°) and the largest in the plane of incidence."""
    part = measurement[rows]
    good = part.usable[:, channel] & (part.geom.off_plane_deg[:, 0] < 3)
    if not np.any(good):
        return np.nan, np.nan
    values, away = part.brdf[good, channel], np.abs(part.geom.signed_theta_r_deg[good, 0] - theta)
    return (float(values[np.argmin(away)]) if away.min() <= 3 else np.nan), float(values.max())


def validated(ranking: Ranking, measurement: Measurement, options: Options = Options(), progress=lambda name: None) -> Ranking:
    """The same ranking with growth, held-out errors of those that were refined, and a warning for models that only imitate."""
    few, helds = thinned(measurement), []
    for row in ranking.rows:
        progress(row.fit.name)
        helds.append(None if row.fit.has("coarse") else held_out(row.fit, few, options))
    single = min((held.rms_ln for row, held in zip(ranking.rows, helds) if held and _lobes(row.fit) < 2), default=np.inf)
    rows = []
    for row, held in zip(ranking.rows, helds):
        warning = imitation(row.fit, held, single)
        warnings = row.warnings + ((warning,) if warning else ())
        rows.append(replace(row, held_out=held, growth=growth(row.fit, measurement), warnings=warnings))
    recommended, because = recommend(rows)
    return replace(ranking, rows=tuple(rows), recommended=recommended, because=because)
