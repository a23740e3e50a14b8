"""Fits against each other: which difference is real, which models tie, and error against run time. Never fits."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import sqrt
from time import perf_counter_ns

import numpy as np

from . import costs, sampling, uncertainty, weights
from .fitting import Fit, Options
from .measurement import Finding, Measurement
from .misfit import METRICS, evaluate

REPEATS, TIMED_SAMPLES = 7, 2048
COMPARED_SAMPLES = 40_000  # of a larger table, for all but the rms over everything
DISTRUSTED = ("not-converged", "imitates")  # doubts with which no model is recommended
REAL = 2.0  # standard errors from which a difference counts


@dataclass(frozen=True, eq=False)
class Row:
    """One candidate in its place."""

    fit: Fit
    rank: int
    tied: bool  # with the best
    rms_ln: float
    rms_ln_by_theta_i: dict[float, float]
    errors: dict[str, float]  # by metric
    behind: float  # rms ln behind the best
    behind_se: float
    ns_per_sample: float
    work: float  # operations in the time of one addition: orders equals, the same in every run
    on_front: bool  # no other is better in both error and time
    held_out: object = None  # validation.HeldOut
    growth: dict | None = None
    warnings: tuple[Finding, ...] = ()


@dataclass(frozen=True, eq=False)
class Ranking:
    """Candidates, best first, and the one to use."""

    rows: tuple[Row, ...]
    recommended: Row
    because: str
    metric: str
    noise: float  # relative standard deviation of a single value, estimated from neighbours
    winners: dict[str, str]  # by metric
    warnings: tuple[Finding, ...] = ()
    weighing: tuple[Finding, ...] = ()  # what weighs the values


def rank(fits: Sequence[Fit], measurement: Measurement, options: Options = Options()) -> Ranking:
    """Fits in order of error; ties are broken by fewest parameters, then by operations.

    The difference from the best is taken pointwise, and its standard error over segments of neighbouring
    directions. Two models whose predictions differ by less than the noise of a single value also tie.
    """
    metric, part, votes = options.metric, sampling.representative_rows(measurement, COMPARED_SAMPLES), weights.votes(measurement, options.weights)
    compared = measurement if len(part) == len(measurement.brdf) else measurement[part]
    votes = None if votes is None else votes[part]
    residuals = [fit.residuals[part] for fit in fits]
    errors = [{**all_errors(each, compared, votes), "ln": fit.rms_ln} for each, fit in zip(residuals, fits)]
    # errors alike to five digits are alike, and the simpler comes first
    order = sorted(range(len(fits)), key=lambda i: (not np.isfinite(errors[i][metric]), float(f"{errors[i][metric]:.5g}"), fits[i].free))
    best = residuals[order[0]]
    along = uncertainty.along_scans(compared)
    noise = noise_of(best[along])
    segments, bins = uncertainty.segments_of(compared, along), incidence_bins(measurement)
    times, works = time_all(fits, measurement), [work_of(fit, compared) for fit in fits]
    rows = []
    for place, index in enumerate(order):
        fit = fits[index]
        behind, error = difference(residuals[index], best, segments, votes)
        apart = weights.rms(residuals[index] - best, votes)
        tied = index == order[0] or apart < noise or behind < REAL * error
        front = not any(_dominates(errors[other], times[other], errors[index], times[index], metric) for other in order)
        rows.append(Row(
            fit, place + 1, tied, fit.rms_ln, by_theta_i(fit.residuals, *bins), errors[index],
            behind, error, times[index], works[index], front, warnings=fit.warnings,
        ))  # fmt: skip
    rows = _with_ranks(rows)
    recommended, because = recommend(rows)
    winners = {name: fits[_winner(name, fits, errors)].name for name in METRICS}
    return Ranking(tuple(rows), recommended, because, metric, noise, winners, _overall(rows, winners, noise), weights.stated(measurement, options.weights))


def all_errors(residuals, measurement: Measurement, votes=None) -> dict[str, float]:
    """The rms error on every scale, relative to the data's own rms on it where the scale is not logarithmic; `votes` as in `weights.rms`."""
    data = np.where(np.isfinite(residuals), measurement.brdf, np.nan)
    third = np.exp(np.minimum(residuals, 300.0) / 3)
    ratio = third**3
    cosine = measurement.geom.cos_i * measurement.geom.cos_r
    root = lambda values: weights.rms(values, votes)  # noqa: E731
    return {
        "ln": root(residuals),
        "cube-root": root(np.cbrt(data) * (third - 1)) / root(np.cbrt(data)),
        "relative": root(ratio - 1),
        "cosine": root(data * (ratio - 1) * cosine) / root(data * cosine),
    }


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
    squares[lacking], counts[lacking] = np.nansum(residuals[lacking] ** 2, axis=1), np.count_nonzero(np.isfinite(residuals[lacking]), axis=1)
    squares, counts = (np.bincount(places, each, minlength=len(angles)) for each in (squares, counts))
    return {float(angle): float(np.sqrt(square / count)) for angle, square, count in zip(angles, squares, counts) if count}


def difference(one, best, segments, votes=None) -> tuple[float, float]:
    """How far one rms lies behind the other, and the standard error of that.

    rms_a - rms_b = mean(a² - b²)/(rms_a + rms_b)   and   a² - b² = (a - b)² + 2 b (a - b)

    The two models are given and d = a - b with them. What chance could have made otherwise is the part of the best
    model's residual b that no multiple of d explains: b - c d with c = Σ b d / Σ d². The error is that of the mean of
    2 d (b - c d), taken between whole segments of neighbours, which err together; a segment that has a large share of
    Σ d² has drawn c to itself, and its sum is widened for it (Bell and McCaffrey 2002, CR2). Where d lives in few
    segments the error is itself uncertain; it is widened as Student's t is at two standard errors.
    """
    seen = np.isfinite(one - best)
    count = max(np.count_nonzero(seen), 1)
    one, best = (np.where(seen, each if votes is None else each * np.sqrt(votes), 0.0) for each in (one, best))
    apart = one - best
    total = sqrt(np.vdot(one, one) / count) + sqrt(np.vdot(best, best) / count)
    squares = np.einsum("sc,sc->s", apart, apart)
    power = float(squares.sum())
    if total == 0 or power == 0:
        return 0.0, 0.0
    share = float(np.vdot(best, apart)) / power
    sums = np.bincount(segments, np.einsum("sc,sc->s", 2 * apart, best - share * apart))
    leverage = np.bincount(segments, squares) / power
    freedom = max(1 / np.sum(leverage**2) - 1, 1.0)
    student = 1 + 1.25 / freedom + 1.53 / freedom**2  # t/z at z = 2, to second order
    spread = student * np.sqrt(np.sum(sums**2 / np.maximum(1 - leverage, 1e-3))) / count
    return power * (1 + 2 * share) / count / total, float(spread / total)


def noise_of(along) -> float:
    """Relative standard deviation of one value, from differences of residuals that are neighbours along the scans, which any smooth model leaves in."""
    steps = along[2:] - 2 * along[1:-1] + along[:-2]
    steps = steps[np.isfinite(steps)]
    return float(1.4826 * np.median(np.abs(steps)) / np.sqrt(6)) if steps.size else 0.0


def time_all(fits: Sequence[Fit], measurement: Measurement) -> list[float]:
    """Nanoseconds per sample of one channel with the geometry at hand: least of interleaved repeats, one thread."""
    geom = measurement.geom[: min(TIMED_SAMPLES, len(measurement.brdf))]
    geom = geom.at(np.atleast_1d(measurement.geom.wavelength)[:1])
    values = [{key: value[0] if np.ndim(value) else value for key, value in fit.values.items()} for fit in fits]
    least = [float("inf")] * len(fits)
    for _ in range(REPEATS):
        for place, fit in enumerate(fits):
            began = perf_counter_ns()
            evaluate(fit.model, geom, values[place])
            least[place] = min(least[place], (perf_counter_ns() - began) / len(geom))
    return least


def work_of(fit: Fit, measurement: Measurement) -> float:
    """Operations for one direction and channel."""
    geom = measurement.geom[:64].at(np.atleast_1d(measurement.geom.wavelength)[:1])
    values = {key: value[0] if np.ndim(value) else value for key, value in fit.values.items()}
    return costs.work(costs.operations(lambda each: fit.model(each, values), geom))


def _dominates(error, time, other_error, other_time, metric: str) -> bool:
    return error[metric] <= other_error[metric] and time <= other_time and (error[metric] < other_error[metric] or time < other_time)


def _winner(metric: str, fits, errors) -> int:
    """The least error on a scale; the simplest of those that come within a thousandth of it."""
    known = [place for place in range(len(fits)) if np.isfinite(errors[place][metric])] or list(range(len(fits)))
    least = min(errors[place][metric] for place in known)
    return min((place for place in known if not errors[place][metric] > 1.001 * least), key=lambda place: fits[place].free)


def _with_ranks(rows: list[Row]) -> list[Row]:
    """Tied rows share rank 1; the others keep their place."""
    ties = sum(row.tied for row in rows)
    return [replace(row, rank=1 if row.tied and ties > 1 else place) for place, row in enumerate(rows, start=1)]


def recommend(rows: Sequence[Row]) -> tuple[Row, str]:
    """The simplest of those that cannot be told from the best that can be trusted, and the reason in words."""
    trusted = [row for row in rows if not any(warning.code in DISTRUSTED for warning in row.warnings)] or list(rows)
    best = trusted[0]
    equal = [row for row in trusted if row.tied] if best.tied else [best]
    pick = min(equal, key=lambda row: (row.fit.free, row.work))
    passed = [row for row in rows[: rows.index(best)]]
    aside = f"; {', '.join(row.fit.name for row in passed)} {'has' if len(passed) == 1 else 'have'} less error but cannot be trusted" if passed else ""
    if pick is not best:
        reasons = []
        if pick.fit.free < best.fit.free:
            reasons.append(f"has {best.fit.free - pick.fit.free} fewer parameters")
        if pick.work < 0.8 * best.work:
            reasons.append("is cheaper to evaluate")
        return pick, f"cannot be told from {best.fit.name} by these data, and {' and '.join(reasons) or 'comes first in the list'}{aside}"
    if len(equal) > 1:
        others = ", ".join(row.fit.name for row in equal if row is not pick)
        return pick, f"least error, and the simplest of those that cannot be told apart by these data ({others}){aside}"
    behind = [row for row in trusted if row is not pick]
    if not behind:
        return pick, f"the only candidate{aside}"
    gap = behind[0].rms_ln - pick.rms_ln
    return pick, f"least error; {behind[0].fit.name} follows {gap:.2g} behind in rms ln{aside}"


def _overall(rows: list[Row], winners: dict[str, str], noise: float) -> tuple[Finding, ...]:
    found = []
    if len(set(winners.values())) > 1:
        scales = {model: [name for name, other in winners.items() if other == model] for model in winners.values()}
        by_winner = "; ".join(f"{', '.join(names)}: {model}" for model, names in scales.items())
        found.append(Finding("metric-decides", f"the winner depends on the scale: {by_winner}", "warning", "choose the scale that matters to you", "--metric"))
    if rows and noise > 0 and rows[0].rms_ln > 2 * noise:
        text = f"even the best error, {rows[0].rms_ln:.2g}, is {rows[0].rms_ln / noise:.0f} times the noise of a single value, {noise:.2g}"
        found.append(Finding("above-noise", text, "warning", "no candidate describes this surface fully"))
    return tuple(found)
