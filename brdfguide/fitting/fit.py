"""One model, one measurement, one fit; `fit_all` maps it over the candidates. Never compares models."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np

from ..data.measurement import Measurement
from ..errors import choices
from ..finding import Finding
from ..models import Composite
from ..models.candidates import candidate_label
from ..models.surface import Surface
from ..numerics.least_squares import Minimum, standing
from ..records import dataclass
from . import drift, weights
from .coarse_search import OUTRUN, Search, Sought, followed_on, search, search_all
from .diagnostics import profile_intervals, scan_gains, sigma_bound, standard_errors, unnoticed_faults
from .fit_options import FitOptions
from .followed import End, Following, follow
from .layout import Layout
from .objective import METRICS, metric
from .prepared import Prepared, Subset, expecting, few_channels, prepare
from .reading import keep
from .residuals import ln_residuals, rms, rms_over_all

PRUNED = 4.0  # times the best error beyond which a model is not refined
LEAST_PRUNED = 0.5  # rms below which every model is refined
ASKED_OF_DRIFT = 3  # of the best models, whose misfit may be the instrument's
MAY_BE_BEST = 1.5  # times the least squares that one step beside the instrument promises, up to which one may be (ours)
TWINS = 1.15  # times the least error where models are compared, up to which one is told over a whole table (ours)
ROBUST_ROUNDS = 4
ROUNDING = 1e-12  # of a sum of squares
MOST_TO_SETTLE = 400  # evaluations


@dataclass(frozen=True, eq=False, repr=False)
class Fit:
    """The surface that comes closest to a measurement, and the doubts about it."""

    surface: Surface  # with a value for every parameter
    stderr: dict  # of those that were free; infinite where the data say nothing
    # ln(model/data), (samples, channels), NaN where no error is told; of a table larger than `COMPARED_SAMPLES` on
    # `compared_rows` of it
    residuals: np.ndarray
    rms_ln: float
    free: int  # how many numbers were fitted
    evaluations: int
    seconds: float
    converged: bool
    warnings: tuple[Finding, ...] = ()
    instrument: drift.Drift | None = None  # fitted beside the model, and not in the residuals
    missed: float | None = None  # relative error that was expected of bright values; None where that decides nothing
    ln_scan_gains: float = 0.0  # standard deviation of ln gain between the scans of a turned sample, beyond their noise

    @property
    def model(self) -> Composite:
        return self.surface.model

    @property
    def values(self) -> Mapping:
        return self.surface.values

    @property
    def name(self) -> str:
        return candidate_label(self.model)

    def __repr__(self) -> str:
        doubts = f"; {', '.join(each.printed for each in self.warnings)}" if self.warnings else ""
        return f"{self.name}: rms ln {self.rms_ln:.4f}, {self.free} numbers fitted{doubts}"

    @property
    def thinned(self) -> Surface:
        """The fitted surface in the few channels that stand for all."""
        channels = few_channels(len(self.surface.channels))
        same = len(channels) == len(self.surface.channels)
        return self.surface if same else self.surface.of_channels(channels)

    def residuals_on(self, measurement: Measurement) -> np.ndarray:
        """`residuals` on all directions of the measurement that was fitted, or of a part of it."""
        known = measurement if self.missed is None else expecting(measurement, self.missed)
        found = self.instrument
        return ln_residuals(self.surface, known if found is None else drift.without_drift(known, found))

    def has(self, code: str, subject: str = "") -> bool:
        """Whether there is a warning with this code, about this parameter."""
        return any((warning.code, warning.subject) == (code, subject) for warning in self.warnings)


def fit(model: Composite, measurement: Measurement | Prepared, options: FitOptions = FitOptions()) -> Fit:
    """The values of `model` closest to a measurement, from the best two starts of a grid and from the user's own.

    Raises InputError where nothing can be fitted.
    """
    data = measurement if isinstance(measurement, Prepared) else prepare(measurement, options.weights)
    found = search(model, data, options)
    data = data.expecting(found.rms)
    fits = _over_all([settle(found, data, data.settle, options)], data)
    return _beside_the_instrument(fits, [found.layout], data, options)[0]


def settle(searched: Search, data: Prepared, on: Subset | None, options: FitOptions, ended: End | None = None) -> Fit:
    """The fit that a search leads to, on that part of the data; on none it stays where the search ended and says so.
    `ended`: where that is, if it is known (`_ended_together`)."""
    began, layout, pruned = perf_counter(), searched.layout, on is None
    if on is None or ended is None:
        best, on, evaluations = _settled(searched, data, on, options)
    else:
        best, on, evaluations = _told(searched, data, on, options, ended)
    surface = layout.surface(best.shared, best.per_channel, data.whole)
    values, residuals = surface.values, ln_residuals(surface, data.compared)
    part = _where_settled(data, residuals, surface)
    correlation, score = standard_errors.serial_correlation(part, data.orders)
    variance = best.cost / max(int(np.count_nonzero(on.measurement.weighed)) - layout.count, 1)
    unlike = weights.unlike(on.measurement, data.sample_weights, data.used, on.rows, float(np.nanmean(part**2)))
    if unlike is None:
        variances = best.normal.variances(variance)
    else:
        variances = best.normal.scatter(np.sqrt(variance * unlike), *best.at_minimum[1:])
    stderr = standard_errors.standard_errors(layout, values, *variances, part, correlation)
    of_model = on.misfit(layout, metric(options.metric))
    scans = None if pruned or data.scans is None else data.scans[on.rows]
    stderr, ln_scan_gains = scan_gains.with_scan_gains(layout, values, stderr, best, of_model, scans)
    wrong = standard_errors.discrepancy(part, correlation, score)
    if wrong and not pruned:
        wide = standard_errors.errors_of_a_wrong_model(
            layout, values, best.normal, best.at_minimum, [each[on.rows] for each in data.blocks]
        )
        stderr = {key: np.maximum(error, wide[key]) for key, error in stderr.items()}
    stderr = unnoticed_faults.with_faults(layout, values, stderr, best, of_model)
    together = variance * standard_errors.serial_widening(correlation) * standard_errors.common_channels(part)
    warnings = list(standard_errors.parameter_doubts(layout, values, stderr, best.normal, together))
    warnings += [wrong] if wrong and standard_errors.worth_telling(wrong) else []
    warnings += [each for each in (standard_errors.starts_disagree(layout, searched.ends),) if each]
    slopes_alone = sigma_bound.rough_regime_doubts(
        layout, on.measurement, best.shared, best.per_channel, together, stderr
    )
    warnings = sigma_bound.in_place_of(warnings, slopes_alone)
    if not wrong and not pruned:
        warnings += profile_intervals.curved_doubts(layout, of_model, best, values, stderr)
    if pruned:
        text = f"its error is more than {PRUNED:g} times the best: searched for, not refined"
        warnings.append(Finding("coarse", text, "note"))
    if not best.converged:
        text = "the search was still moving when it was stopped"
        warnings.append(Finding("not-converged", text, "warning", "do not use the values"))
    return Fit(
        surface,
        stderr,
        residuals,
        rms(residuals, data.compared_weights),
        layout.count,
        evaluations,
        searched.seconds + perf_counter() - began,
        best.converged,
        tuple(warnings),
        missed=data.missed,
        ln_scan_gains=ln_scan_gains,
    )


def _where_settled(
    data: Prepared, residuals: np.ndarray, surface: Surface, found: drift.Drift | None = None
) -> np.ndarray:
    """Residuals, known where models are compared, on the directions on which the best settle."""
    if data.compared is data.whole:
        return residuals[data.used]
    few = data.settle.measurement
    return ln_residuals(surface, few if found is None else drift.without_drift(few, found))


def _ended_together(
    searches: Sequence[Search], data: Prepared, parts: Sequence[Subset | None], options: FitOptions
) -> list[End | None]:
    """Where the descents of those end that take their steps side by side; None of the others, and where a part of the
    data comes first or weights change on the way."""
    if options.robust or len(data.near.weights) < len(data.settle.weights):
        return [None] * len(searches)
    goes = {}
    for place, (each, on) in enumerate(zip(searches, parts, strict=True)):
        if on is not None:
            misfit = on.misfit(each.layout, metric(options.metric))
            following = Following(misfit, [_start(each)], known=each.known_on(on))
            if following.goes_together:
                goes[place] = following
    found = follow(list(goes.values()), 1e-6, MOST_TO_SETTLE, foreseen=True)
    ends = dict(zip(goes, (ends[0] for ends in found), strict=True))
    return [ends.get(place) for place in range(len(searches))]


def _told(searched: Search, data: Prepared, on: Subset, options: FitOptions, ended: End) -> tuple[Minimum, Subset, int]:
    """The same as `_settled`, of a descent that has ended; by itself where its last step went astray."""
    misfit, layout = on.misfit(searched.layout, metric(options.metric)), searched.layout
    keep(layout, layout.surface(ended.shared, ended.per_channel, on.measurement), on.measurement.instrument)
    best = standing(misfit, ended.shared, ended.per_channel, ended.evaluations, ended.converged)
    if best.cost > ended.cost * (1 + ROUNDING):
        return _settled(searched, data, on, options)
    return best, on, searched.evaluations + ended.evaluations


def _start(searched: Search) -> tuple[np.ndarray, np.ndarray]:
    """Where its search ended best, in all channels."""
    shared, per_channel, _ = searched.ends[0]
    return shared, _spread_over_channels(per_channel, searched.layout.channels)


def _settled(searched: Search, data: Prepared, on: Subset | None, options: FitOptions) -> tuple[Minimum, Subset, int]:
    """The minimum on that part of the data, the part with its last weights, and all evaluations so far."""
    scale, layout, evaluations = metric(options.metric), searched.layout, searched.evaluations
    start = _start(searched)
    if on is None or len(data.near.weights) < len(data.settle.weights):
        best = data.near.misfit(layout, scale).descend(start, 1e-5)
        start, evaluations = (best.shared, best.per_channel), evaluations + best.evaluations
    if on is None:
        return best, data.near, evaluations
    for turn in range(ROBUST_ROUNDS if options.robust else 1):
        if turn:
            on = replace(on, weights=weights.robust(on.weights, best.at_minimum[0], on.measurement))
        best = on.misfit(layout, scale).descend(start, 1e-6)
        start, evaluations = (best.shared, best.per_channel), evaluations + best.evaluations
    return best, on, evaluations


def fit_all(
    models: Iterable[Composite],
    measurement: Measurement,
    options: FitOptions = FitOptions(),
    progress: Callable[[str], None] = lambda name: None,
    more: "Callable[[list[Search], Prepared], list[Search]]" = lambda searches, data: [],
) -> tuple[Fit, ...]:
    """One fit for each model, and for those that `more` searched after them; `progress` hears each name before its fit
    begins.

    Raises InputError where a fixed or start value names no parameter of any of them.
    """
    models = tuple(models)
    for name in (*options.fixed, *options.start):
        if not any(model.has(name) for model in models):
            raise choices(
                "parameter of any candidate", name, sorted({key for model in models for key in model.parameters})
            )
    data = prepare(measurement, options.weights)
    searches = search_all([Sought(model) for model in models], data, options, progress)
    if data.missed is not None:  # how well the best does says which values are too dim to tell
        data = data.expecting(_best(searches))
        searches = followed_on(searches, data, options)
    searches += more(searches, data)
    best, fits = _best(searches), []
    data = data.expecting(best)
    pruned = [each.rms > max(PRUNED * best, LEAST_PRUNED) for each in searches]
    near = [data.fewer if each.rms > OUTRUN * best else data.settle for each in searches]
    parts = [None if left else on for left, on in zip(pruned, near, strict=True)]
    ends = _ended_together(searches, data, parts, options)
    for each, on, end in zip(searches, parts, ends, strict=True):
        progress(f"fitting {candidate_label(each.layout.model)}")
        fits.append(settle(each, data, on, options, end))
    fits = _over_all(fits, data)
    return tuple(_beside_the_instrument(fits, [each.layout for each in searches], data, options))


def _best(searches: Iterable[Search]) -> float:
    """The least error of any."""
    return min((each.rms for each in searches), default=0.0)


def _over_all(fits: list[Fit], data: Prepared) -> list[Fit]:
    """The same with the error of the best and of what comes near it over a whole table, not only where models are
    compared: directions enough to tell the others from them."""
    if data.compared is data.whole:
        return fits
    least = min((each.rms_ln for each in fits), default=0.0)
    places = [place for place, each in enumerate(fits) if each.rms_ln <= TWINS * least]
    errors = rms_over_all([fits[place].surface for place in places], data.whole, data.sample_weights)
    known = dict(zip(places, errors, strict=True))
    return [replace(each, rms_ln=known.get(place, each.rms_ln)) for place, each in enumerate(fits)]


def _beside_the_instrument(fits: list[Fit], layouts: list[Layout], data: Prepared, options: FitOptions) -> list[Fit]:
    """The same with gains of scans and the zero of the arm fitted beside every refined model, where they explain what
    the best of them misses."""
    if options.robust or metric(options.metric) is not METRICS["ln"]:
        return fits
    refined = [place for place, each in enumerate(fits) if not each.has("coarse")]
    nearest = sorted(refined, key=lambda place: fits[place].rms_ln)[:ASKED_OF_DRIFT]

    def begun(place: int) -> drift.Begun | None:
        left = _where_settled(data, fits[place].residuals, fits[place].surface)
        return drift.begun(layouts[place], fits[place].values, data, left)

    asked = {place: each for place in nearest if (each := begun(place)) is not None}
    least = min((each.squares for each in asked.values()), default=0.0)
    likely = {place: each for place, each in asked.items() if each.squares <= MAY_BE_BEST * least}
    if all(each.hopeless for each in likely.values()):
        return fits
    known = {place: drift.adjusted(each, data) for place, each in likely.items()}
    best = min(known, key=lambda place: known[place].penalised * known[place].variance)
    if not drift.explains(known[best], data, _adjusted_residuals(fits[best], known[best], data)[1]):
        return fits
    more = {place: asked.get(place) or begun(place) for place in refined if place not in known}
    known |= {place: drift.adjusted(each, data) for place, each in more.items() if each is not None}
    return [
        _adjusted(each, layouts[place], known[place], data) if place in known else each
        for place, each in enumerate(fits)
    ]


def _adjusted_residuals(one: Fit, found: drift.Adjusted, data: Prepared) -> tuple[np.ndarray, np.ndarray]:
    """Where models are compared, and where they settle."""
    surface = replace(one.surface, values=found.values)
    residuals = ln_residuals(surface, drift.without_drift(data.compared, found.drift))
    return residuals, _where_settled(data, residuals, surface, found.drift)


def _adjusted(one: Fit, layout: Layout, found: drift.Adjusted, data: Prepared) -> Fit:
    """A fit with what was fitted beside it; its errors are without what the instrument did."""
    residuals, part = _adjusted_residuals(one, found, data)
    correlation, score = standard_errors.serial_correlation(part, data.orders)
    wrong = standard_errors.discrepancy(part, correlation, score)
    widening = np.sqrt(standard_errors.serial_widening(correlation))
    stderr = {key: widening * error for key, error in found.stderr.items()}
    if wrong:
        stderr = {key: np.maximum(error, one.stderr[key]) for key, error in stderr.items()}
    ln_scan_gains = 0.0
    if data.scans is not None:
        left = drift.without_drift(data.fewer.measurement, found.drift)
        misfit = replace(data.fewer.misfit(layout, METRICS["ln"]), measurement=left)
        best, scans = misfit.descend(found.at, 1e-6), data.scans[data.fewer.rows]
        stderr, ln_scan_gains = scan_gains.with_scan_gains(layout, found.values, stderr, best, misfit, scans)
    doubts = [wrong] if wrong else [drift.instrument_finding(found.drift)]
    return replace(
        one,
        surface=replace(one.surface, values=found.values),
        stderr=stderr,
        residuals=residuals,
        rms_ln=rms(residuals, data.compared_weights),
        warnings=(*drift.without_discrepancy(one.warnings), *doubts),
        instrument=found.drift,
        ln_scan_gains=ln_scan_gains,
    )


def _spread_over_channels(per_channel, channels: int):
    """Own coordinates of a few channels, interpolated to all."""
    if not per_channel.shape[1]:
        return np.zeros((channels, 0))
    at = few_channels(channels)
    return np.stack([np.interp(np.arange(channels), at, column) for column in per_channel.T], axis=1)
