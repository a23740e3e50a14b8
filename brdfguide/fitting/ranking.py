"""Fits against each other: which difference is real, which models tie, and error against run time. Never fits."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property, partial
from math import sqrt

import numpy as np

from ..data import noise as smoothness
from ..data.measurement import Measurement
from ..finding import Finding
from ..flags import Effect
from ..formed import formed
from ..models import cost
from ..numerics import pareto
from ..physics import seen
from ..physics.geometry import Geometry
from ..printable import LEAST_NOISE
from ..records import dataclass
from . import appearance, prepared, weights
from .choosing import recommending
from .diagnostics import standard_errors
from .fit import Fit, FitOptions
from .objective import METRICS, SEEN
from .ranked import BETTER, REAL, Ranking, Row
from .reading import evaluate
from .residuals import NO_ERROR, rms

REPEATS = 7  # of a timing, the least of which counts
TIMED_SAMPLES = 2048  # directions of a timing, repeated where there are fewer: a long batch that fits the cache
IN_COMMON = 2.0  # times the scatter between neighbours, from which a stated error is one that they share (ours)
SHARPER = 0.5  # times the scatter about neighbours, below which what the best law leaves is the scatter (ours)
SAME = 1e-5  # times the best error: alike to the digits that order them


def rank(fits: Sequence[Fit], measurement: Measurement, options: FitOptions = FitOptions(), *, timed=True) -> Ranking:
    """Fits in order of error; ties are broken by fewest parameters, then by operations.

    The difference from the best is taken pointwise, and its standard error over blocks of neighbouring directions.
    What is more than two standard errors behind is behind, and so is what has more error than that. Two models whose
    predictions differ by less than the error that the instrument states and neighbours have in common tie as well.
    """
    metric, compared = options.metric, prepared.compared(measurement)
    sample_weights = prepared.weights_where_compared(measurement, weights.sample_weights(measurement, options.weights))
    residuals = [fit.residuals for fit in fits]
    look = appearance.of_fits(fits, residuals, compared)
    errors = [
        {**all_errors(each, compared, sample_weights), "ln": fit.rms_ln, SEEN: look.seen(place)}
        for place, (each, fit) in enumerate(zip(residuals, fits, strict=True))
    ]
    # errors alike to five digits are alike, as are those that are none, and the simpler comes first
    order = sorted(
        range(len(fits)),
        key=lambda i: (not np.isfinite(errors[i][metric]), _digits(errors[i][metric]), fits[i].free),
    )
    best = residuals[order[0]]
    along = standard_errors.along_scans(compared)
    noise = _scatter(measurement, compared, best[along], errors[order[0]]["ln"])
    stated = stated_noise(compared)
    common = stated if stated > IN_COMMON * noise else 0.0
    noise = max(noise, stated)
    blocks, bins = standard_errors.blocks_of(compared, along), incidence_bins(compared)
    times = time_all(fits, measurement) if timed else [0.0] * len(fits)
    counted = _Counted(tuple(fits), compared.geom[: cost.COUNTED], tuple(each[metric] for each in errors))
    nearest = min(range(len(fits)), key=lambda i: (not np.isfinite(errors[i][SEEN]), errors[i][SEEN]))
    rows, tied = [], True
    for place, index in enumerate(order):
        fit = fits[index]
        behind, error = rms_difference(residuals[index], best, blocks, sample_weights)
        apart = rms(residuals[index] - best, sample_weights)
        chance = max(REAL * error, SAME * errors[order[0]]["ln"], NO_ERROR)
        alike = index == order[0] or apart < common or behind <= chance
        tied = tied and alike
        rows.append(Row(
            fit, place + 1, tied, fit.rms_ln, by_theta_i(fit.residuals, *bins), errors[index],
            behind, error, times[index], _CountedOne(counted, index), warnings=fit.warnings,
            from_best=look.between(index, order[0]),
            alike=seen.alike(errors[index][SEEN], errors[nearest][SEEN], look.between(index, nearest)),
        ))  # fmt: skip
    winners = {name: fits[_winner(name, fits, errors)].name for name in (*METRICS, SEEN)}
    ranked = Ranking(
        rows=tuple(_with_ranks(rows)),
        recommended=rows[0],
        because="",
        metric=metric,
        noise=noise,
        winners=winners,
        warnings=_overall(rows, winners, metric, noise),
        weighing=weights.weighing(measurement, options.weights, options.robust),
        seen_weights=look.kind,
        close=options.close,
    )
    return recommending(ranked, measurement)


def _scatter(measurement: Measurement, compared: Measurement, along, least: float) -> float:
    """By how much single values scatter: about their neighbours, or about the best law (residuals `along` the scans,
    rms `least`) where that is much less, since a lobe bends between neighbours that lie far apart."""
    worth = smoothness.estimated_noise(measurement)
    found = noise_of(along) if worth.relative is None else worth.expected(compared.brdf, compared.clear)
    return least if least < SHARPER * found else found


def _digits(error: float) -> float:
    """The digits of an error that order two."""
    return float(f"{max(error, NO_ERROR):.5g}")


def all_errors(residuals, measurement: Measurement, sample_weights=None) -> dict[str, float]:
    """The rms error on every scale, relative to the data's own rms on it where the scale is not logarithmic;
    `sample_weights` as in `residuals.rms`."""
    known = np.isfinite(residuals)
    data = np.where(known, measurement.brdf, np.nan)
    third = np.exp(np.minimum(residuals, 300.0) / 3)
    ratio = third * third * third
    cosine = measurement.geom.cos_i * measurement.geom.cos_r

    def root(values):
        return rms(values, sample_weights)

    return {
        "ln": root(residuals),
        "cube-root": root(_cube_root(measurement) * (third - 1))
        / root(np.where(known, _cube_root(measurement), np.nan)),
        "relative": root(ratio - 1),
        "cosine": root(data * (ratio - 1) * cosine) / root(data * cosine),
    }


@formed
def _cube_root(measurement: Measurement) -> np.ndarray:
    return np.cbrt(measurement.brdf)


def incidence_bins(measurement: Measurement) -> tuple[np.ndarray, np.ndarray]:
    """Incidence angles [deg], in bins of 10° where there are more than twenty, and the bin of each row."""
    angles = np.round(measurement.geom.theta_i_deg[:, 0], 1)
    values, places = np.unique(angles, return_inverse=True)
    if len(values) > 20:
        values, places = np.unique(np.round(angles / 10) * 10, return_inverse=True)
    return values, places


def by_theta_i(residuals, angles, places) -> dict[float, float]:
    """rms ln at each of `incidence_bins`."""
    squares = np.einsum("sc,sc->s", residuals, residuals)  # a sum over few channels is slow
    counts = np.full(len(squares), float(residuals.shape[1]))
    lacking = np.flatnonzero(np.isnan(squares))
    squares[lacking] = np.nansum(residuals[lacking] ** 2, axis=1)
    counts[lacking] = np.count_nonzero(np.isfinite(residuals[lacking]), axis=1)
    squares, counts = (np.bincount(places, each, minlength=len(angles)) for each in (squares, counts))
    return {
        float(angle): float(np.sqrt(square / count))
        for angle, square, count in zip(angles, squares, counts, strict=True)
        if count
    }


def rms_difference(one, best, blocks, sample_weights=None) -> tuple[float, float]:
    """How far one rms lies behind the other, and the standard error of that.

    rms_a - rms_b = mean(a² - b²)/(rms_a + rms_b)   and   a² - b² = (a - b)² + 2 b (a - b)

    The two models are given and d = a - b with them. What chance could have made otherwise is the part of the best
    model's residual b that no multiple of d explains: b - c d with c = Σ b d / Σ d². The error is that of the mean of
    2 d (b - c d), taken between whole blocks of neighbours, which err together; a block that has a large share of
    Σ d² has drawn c to itself, and its sum is widened for it (Bell and McCaffrey 2002, CR2). Where d lives in few
    blocks the error is itself uncertain; it is widened as Student's t is at two standard errors.
    """
    finite = np.isfinite(one - best)
    count = max(int(np.count_nonzero(finite)), 1)
    one, best = (
        np.where(finite, each if sample_weights is None else each * np.sqrt(sample_weights), 0.0)
        for each in (one, best)
    )
    apart = one - best
    total = sqrt(np.vdot(one, one) / count) + sqrt(np.vdot(best, best) / count)
    squares = np.einsum("sc,sc->s", apart, apart)
    power = float(squares.sum())
    if total == 0 or power == 0:
        return 0.0, 0.0
    share = float(np.vdot(best, apart)) / power
    sums = np.bincount(blocks, np.einsum("sc,sc->s", 2 * apart, best - share * apart))
    leverage = np.bincount(blocks, squares) / power
    freedom = max(1 / float(np.sum(leverage**2)) - 1, 1.0)
    student = standard_errors.student_widening(freedom)
    spread = student * np.sqrt(np.sum(sums**2 / np.maximum(1 - leverage, 1e-3))) / count
    return power * (1 + 2 * share) / count / total, float(spread / total)


def noise_of(along) -> float:
    """Relative standard deviation of one value, from differences of residuals that are neighbours along the scans,
    which any smooth model leaves in."""
    steps = along[2:] - 2 * along[1:-1] + along[:-2]
    steps = steps[np.isfinite(steps)]
    return float(1.4826 * np.median(np.abs(steps)) / np.sqrt(6)) if steps.size else 0.0


def stated_noise(measurement: Measurement) -> float:
    """Relative standard error of a single value as it is stated, median; 0 where none is."""
    if measurement.stated_errors is None:
        return 0.0
    relative = measurement.stated_errors[measurement.clear] / measurement.brdf[measurement.clear]
    relative = relative[np.isfinite(relative)]
    return float(np.median(relative)) if relative.size else 0.0


def time_all(fits: Sequence[Fit], measurement: Measurement) -> list[float]:
    """Nanoseconds per sample of one channel with the geometry at hand: least of interleaved repeats, one thread."""
    first = np.atleast_1d(measurement.geom.wavelength)[:1]
    geom = measurement.geom[np.resize(np.arange(len(measurement.brdf)), TIMED_SAMPLES)].at(first)
    surfaces = [fit.surface.channel(0).at(first) for fit in fits]
    evaluators = {place: partial(evaluate, surface) for place, surface in enumerate(surfaces)}
    ns = cost.interleaved(evaluators, lambda: geom, REPEATS)
    return [min(ns[place]) / len(geom) for place in range(len(fits))]


@dataclass(frozen=True, eq=False)
class _Counted:
    """Operations of fits, counted when somebody asks for them."""

    fits: tuple[Fit, ...]
    geom: Geometry
    errors: tuple[float, ...]

    @cached_property
    def known(self) -> dict[int, float]:
        return {}

    def work(self, place: int) -> float:
        """Operations for one direction and channel."""
        if place not in self.known:
            surface = self.fits[place].surface.channel(0)
            self.known[place] = cost.work(cost.operations(surface.brdf, self.geom))
        return self.known[place]

    @cached_property
    def on_front(self) -> list[bool]:
        return pareto.on_front([(error, self.work(place)) for place, error in enumerate(self.errors)])


@dataclass(frozen=True, eq=False)
class _CountedOne:
    """One of them."""

    counted: _Counted
    place: int

    @property
    def work(self) -> float:
        return self.counted.work(self.place)

    @property
    def on_front(self) -> bool:
        return self.counted.on_front[self.place]


def _winner(metric: str, fits, errors) -> int:
    """The least error on a scale; the simplest of those that come within a thousandth of it or have none. To the eye
    those within a quarter are alike, and the one with the least error in ln stands for them."""
    known = [place for place in range(len(fits)) if np.isfinite(errors[place][metric])] or list(range(len(fits)))
    least = min(errors[place][metric] for place in known)
    within = seen.TIE if metric == SEEN else 1.001
    alike = [place for place in known if not errors[place][metric] > within * max(least, NO_ERROR)]
    return min(alike, key=lambda place: (metric == SEEN and _digits(errors[place]["ln"]), fits[place].free))


def _with_ranks(rows: list[Row]) -> list[Row]:
    """Tied rows share rank 1; the others keep their place."""
    ties = sum(row.tied for row in rows)
    return [replace(row, rank=1 if row.tied and ties > 1 else place) for place, row in enumerate(rows, start=1)]


def _overall(rows: list[Row], winners: dict[str, str], metric: str, noise: float) -> tuple[Finding, ...]:
    """Doubts about all rows. Where the first leaves noise alone, it is chance that orders what it leaves alike."""
    if not rows:
        return ()
    above = noise > 0 and rows[0].rms_ln > max(2 * noise, NO_ERROR)
    off = above or any(each.effect is Effect.OF_MISFIT for each in rows[0].warnings)
    found = [_by_scale(rows, winners, metric)] if off else []
    if above:
        times = f"{rows[0].rms_ln / noise:.0f} times the noise of a single value, {noise:.2g}"
        far = times if noise >= LEAST_NOISE else f"far above the noise of a single value, less than {LEAST_NOISE:g}"
        text = f"even the best error, {rows[0].rms_ln:.2g}, is {far}"
        found.append(Finding("above-noise", text, "warning", "no candidate describes this surface fully"))
    return tuple(each for each in found if each)


def _by_scale(rows: list[Row], winners: dict[str, str], metric: str) -> Finding | None:
    """Where on another scale another law errs less in earnest than the first, or is seen to be closer."""
    first, least = rows[0], {row.fit.name: row for row in rows}

    def stands(scale: str) -> bool:
        error = least[winners[scale]].errors[scale]
        if scale == SEEN:
            return seen.close_enough(first.seen, error)
        return not BETTER * first.errors[scale] > error

    other = {scale: name for scale, name in winners.items() if scale != metric and not stands(scale)}
    if not other:
        return None
    winner = {scale: other.get(scale, first.fit.name) for scale in winners}
    scales = {model: [name for name, its in winner.items() if its == model] for model in winner.values()}
    by_winner = "; ".join(f"{', '.join(names)}: {model}" for model, names in scales.items())
    text = f"the winner depends on the scale: {by_winner}"
    return Finding("metric-decides", text, "warning", "choose the scale that matters to you", "--metric")
