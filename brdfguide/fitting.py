"""One model, one measurement, one fit; `fit_all` maps it over the candidates. Never compares models."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from time import perf_counter

import numpy as np

from . import levenberg, profile, sampling, starts, uncertainty, waves, weights
from .errors import InputError, choices
from .measurement import Finding, Measurement
from .misfit import SMALLEST, Layout, Metric, Misfit, metric, seen
from .models import Sum

SEARCH_SAMPLES = 400  # directions on which the starts are followed
SEARCH_CHANNELS = 4
NEAR_SAMPLES = 2000  # directions on which all channels come close
SETTLE_VALUES, SETTLE_SAMPLES = 75_000, 8_000  # all of so many values settle the answer; of a larger table so many directions do, its error is over all
HEAT, OUTRUN = 8, 1.5  # evaluations after which a start whose rms is this many times the best is followed no further; a model then settles on SETTLE_SAMPLES
HOPELESS, LEAST_HOPELESS = 4.0, 0.5  # times the best error, and rms, beyond which a model is not refined
ROBUST_ROUNDS, ROBUST_WIDTH = 4, 2.385  # Cauchy weights, 95 % efficient for Gaussian noise (Holland and Welsch 1977)


@dataclass(frozen=True)
class Options:
    """What a user may decide about a fit."""

    metric: str = "ln"
    weights: str = "auto"  # auto, none, stderr, sampling
    robust: bool = False
    shape_per_channel: bool = False
    fixed: Mapping[str, float] = field(default_factory=dict)
    start: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Fit:
    """A model with the values that bring it closest to a measurement, and the doubts about them."""

    model: Sum
    values: dict  # every parameter: a float, or (channels,) for those that each channel has
    stderr: dict  # of those that were free; infinite where the data say nothing
    residuals: np.ndarray  # ln(model/data), (samples, channels), NaN where nothing was measured
    rms_ln: float
    free: int  # how many numbers were fitted
    evaluations: int
    seconds: float
    converged: bool
    warnings: tuple[Finding, ...] = ()

    @property
    def name(self) -> str:
        return label(self.model)

    def has(self, code: str) -> bool:
        return any(warning.code == code for warning in self.warnings)


def label(model: Sum) -> str:
    """The name a candidate is shown under: `ggx (metal)` where k is what is fitted."""
    return model.name + (" (metal)" if any(key.endswith(".k") for key in model.free) else "")


@dataclass(frozen=True, eq=False)
class Part:
    """Some of the directions, all channels."""

    rows: np.ndarray | slice  # of those on which the best models settle
    measurement: Measurement
    weights: np.ndarray  # (samples, channels)

    def some(self, rows) -> "Part":
        """Those of its rows; itself where that is all."""
        return self if len(rows) == len(self.weights) else Part(rows, self.measurement[rows], self.weights[rows])


@dataclass(frozen=True, eq=False)
class Data:
    """A measurement made ready for many fits: what each stage looks at, chosen once."""

    whole: Measurement
    used: np.ndarray  # rows of `whole` on which the best models settle
    settle: Part  # these
    fewer: Part  # for models that are far behind
    near: Part  # enough to come close
    search: Part  # few directions, few channels
    orders: list  # of the rows of `settle`
    segments: list  # of neighbours in each order
    votes: np.ndarray | None  # of the directions of `whole`


def prepare(measurement: Measurement, options: Options = Options()) -> Data:
    """Chooses the directions to search on and to settle on. Raises InputError where there is nothing to fit."""
    if not measurement.seen.any():
        raise InputError(f"{measurement.name or 'the data'}: no positive value above the horizon to fit")
    size = np.count_nonzero(measurement.seen)
    rows = sampling.representative_rows(measurement, size if size * measurement.brdf.shape[1] <= SETTLE_VALUES else SETTLE_SAMPLES, among=measurement.seen)
    settle = Part(slice(None), measurement, weights.of_samples(measurement, options.weights))
    if len(rows) < len(measurement.brdf):
        settle = Part(slice(None), measurement[rows], settle.weights[rows])
    fewer, near = (settle.some(sampling.representative_rows(settle.measurement, count)) for count in (SETTLE_SAMPLES, NEAR_SAMPLES))
    thin, channels = starts.spread_rows(settle.measurement, SEARCH_SAMPLES), few_channels(measurement.brdf.shape[1])
    search = Part(thin, settle.measurement[thin].of_channels(channels), settle.weights[thin][:, channels])
    orders = uncertainty.orderings(settle.measurement)
    segments = [uncertainty.segments_of(settle.measurement, orders[0]), *map(uncertainty.stretches, orders[1:])]
    return Data(measurement, rows, settle, fewer, near, search, orders, segments, weights.votes(measurement, options.weights))


@dataclass(frozen=True, eq=False)
class Search:
    """Where the starts of one model ended, on few directions and channels."""

    layout: Layout
    ends: list  # (shared, own, rms), best first
    evaluations: int
    seconds: float

    @property
    def rms(self) -> float:
        return self.ends[0][2]


def fit(model: Sum, measurement: Measurement | Data, options: Options = Options()) -> Fit:
    """The values of `model` closest to a measurement, from the best two starts of a grid and from the user's own.

    Raises InputError where nothing can be fitted.
    """
    data = measurement if isinstance(measurement, Data) else prepare(measurement, options)
    return settle(search(model, data, options), data, data.settle, options)


def settle(searched: Search, data: Data, on: Part | None, options: Options) -> Fit:
    """The fit that a search leads to, on that part of the data; on none, it stays near where the search ended and says so."""
    began = perf_counter()
    scale, layout, found, evaluations = metric(options.metric), searched.layout, searched.ends, searched.evaluations
    model = layout.model
    start = found[0][0], _spread_over_channels(found[0][1], layout.channels)
    hopeless, on = on is None, on or data.near
    if hopeless or len(data.near.weights) < len(data.settle.weights):
        best = _descend(layout, data.near, scale, start, 1e-5)
        start, evaluations = (best.shared, best.own), evaluations + best.evaluations
    for turn in range(0 if hopeless else ROBUST_ROUNDS if options.robust else 1):
        on = replace(on, weights=_robust(on.weights, best.seen[0], on.measurement)) if turn else on
        best = _descend(layout, on, scale, start, 1e-6)
        start, evaluations = (best.shared, best.own), evaluations + best.evaluations
    values = layout.decode(*start)
    residuals = ln_residuals(model, data.whole, values)
    part = residuals[data.used]
    correlation, score = uncertainty.serial_correlation(part, data.orders)
    variance = best.cost / max(np.count_nonzero(on.measurement.usable) - layout.count, 1)
    if data.votes is None:
        variances = best.normal.variances(variance)
    else:  # they say how much a value counts, not how sure it is
        spread = np.sqrt(variance * data.votes[data.used][on.rows]) * np.ones(layout.channels)
        variances = best.normal.scatter(spread, *best.seen[1:])
    stderr = uncertainty.standard_errors(layout, values, *variances, part, correlation)
    wrong = uncertainty.discrepancy(part, correlation, score)
    if wrong and not hopeless:
        wide = uncertainty.errors_of_a_wrong_model(layout, values, best.normal, best.seen, [each[on.rows] for each in data.segments])
        stderr = {key: np.maximum(error, wide[key]) for key, error in stderr.items()}
    together = variance * uncertainty.serial_widening(correlation) * uncertainty.common_channels(part)
    warnings = list(uncertainty.doubts(layout, values, stderr, best.normal, together))
    warnings += [warning for warning in (wrong, _disagreement(layout, found)) if warning]
    warnings = waves.in_place_of(warnings, waves.doubts(layout, on.measurement, *start, together, stderr))
    if not wrong and not hopeless:
        warnings += profile.doubts(layout, Misfit(layout, on.measurement, scale, on.weights), best, values, stderr)
    if hopeless:
        warnings.append(Finding("coarse", f"its error is more than {HOPELESS:g} times the best: searched for, not refined", "note"))
    if not best.converged:
        warnings.append(Finding("not-converged", "the search was still moving when it was stopped", "warning", "do not use the values"))
    return Fit(
        model, values, stderr, residuals, weights.rms(residuals, data.votes), layout.count,
        evaluations, searched.seconds + perf_counter() - began, best.converged, tuple(warnings),
    )  # fmt: skip


def fit_all(models: Iterable[Sum], measurement: Measurement, options: Options = Options(), progress: Callable[[str], None] = lambda name: None) -> tuple[Fit, ...]:
    """One fit for each model; `progress` hears each name before its fit begins.

    Raises InputError where a fixed or start value names no parameter of any of them.
    """
    models = tuple(models)
    for name in (*options.fixed, *options.start):
        if not any(model.has(name) for model in models):
            raise choices("parameter of any candidate", name, sorted({key for model in models for key in model.parameters}))
    data = prepare(measurement, options)
    searches = []
    for model in models:
        progress(f"searching {label(model)}")
        searches.append(search(model, data, options))
    best, fits = min((each.rms for each in searches), default=0.0), []
    for each in searches:
        progress(f"fitting {label(each.layout.model)}")
        on = None if each.rms > max(HOPELESS * best, LEAST_HOPELESS) else data.fewer if each.rms > OUTRUN * best else data.settle
        fits.append(settle(each, data, on, options))
    return tuple(fits)


def ln_residuals(model: Sum, measurement: Measurement, values: Mapping) -> np.ndarray:
    """ln(model/data), (samples, channels), NaN where nothing was measured."""
    ln_model = np.maximum(seen(model, measurement, values), SMALLEST)
    np.log(ln_model, out=ln_model)
    ln_model -= measurement.ln
    return ln_model


def _with_options(model: Sum, options: Options) -> Sum:
    """The sum with those of the user's fixed and start values that it has; `fit_all` refuses a name that none has."""
    own = lambda wanted: model.qualified({name: value for name, value in wanted.items() if model.has(name)})  # noqa: E731
    fixed, start = own(options.fixed), own(options.start)
    free = tuple(key for key in model.free if key not in fixed)
    return replace(model, fixed={**model.fixed, **fixed}, start={**model.start, **start}, free=free)


def search(model: Sum, data: Data, options: Options) -> Search:
    """Follows the grid's starts on few directions and channels."""
    began = perf_counter()
    few = data.search.measurement
    layout = Layout(_with_options(model, options), data.settle.weights.shape[1], options.shape_per_channel)
    narrow, scale = replace(layout, channels=few.brdf.shape[1]), metric(options.metric)
    descend = lambda start, most: _descend(narrow, data.search, scale, start, 1e-5, most)  # noqa: E731
    ahead = [descend(narrow.encode(start), HEAT) for start in starts.grid_starts(narrow, few)]
    evaluations, best = sum(end.evaluations for end in ahead), min(end.cost for end in ahead)
    ends = []
    for end in ahead:
        if not end.converged and end.cost <= OUTRUN**2 * best:
            end = descend((end.shared, end.own), 100)
            evaluations += end.evaluations
        ends.append((*narrow.in_order(end.shared, end.own), float(np.sqrt(end.cost / max(np.count_nonzero(few.usable), 1)))))
    return Search(layout, sorted(ends, key=lambda end: end[2]), evaluations, perf_counter() - began)


def few_channels(count: int) -> np.ndarray:
    """Numbers of at most four channels, spread over the spectrum."""
    return np.unique(np.linspace(0, count - 1, min(count, SEARCH_CHANNELS)).round().astype(int))


def _spread_over_channels(own, channels: int):
    """Own coordinates of a few channels, interpolated to all."""
    at = few_channels(channels)
    return np.stack([np.interp(np.arange(channels), at, column) for column in own.T], axis=1) if own.shape[1] else np.zeros((channels, 0))


def _descend(layout: Layout, part: Part, scale: Metric, start, tolerance: float, most: int = 400) -> levenberg.Minimum:
    low, high = layout.bounds(layout.shared)
    own_low, own_high = layout.bounds(layout.own)
    misfit = Misfit(layout, part.measurement, scale, part.weights)
    return levenberg.minimise(misfit, *start, low=low, high=high, own_low=own_low, own_high=own_high, tolerance=tolerance, most=most)


def _robust(weights, residuals, measurement: Measurement):
    """Cauchy's weights: a sample many times farther off than the median counts little."""
    size = np.abs(residuals[measurement.usable])
    spread = 1.4826 * np.median(size)
    return weights / (1 + (residuals / max(ROBUST_WIDTH * spread, 1e-12)) ** 2)


def _disagreement(layout: Layout, ends) -> Finding | None:
    """Two starts that ended equally well in different places."""
    if len(ends) < 2:
        return None
    (best, _, error), (other, _, worse) = ends[:2]
    if worse > 1.02 * error + 1e-6 or np.max(np.abs(best - other), initial=0.0) < 0.1:
        return None
    own = np.zeros((layout.channels, len(layout.own)))
    shown = lambda key, shared: layout.parameters[key].outside(layout.decode(shared, own)[key])  # noqa: E731
    places = [", ".join(f"{key} {shown(key, shared):.3g}" for key in layout.shared) for shared in (best, other)]
    return Finding("starts-disagree", f"two starts ended equally well in different places: {places[0]}; or {places[1]}", "warning", "look at both")
