"""What an instrument does to whole scans: a gain for each incidence and the zero of the detector's arm, beside a model.

    ln(value) = ln f(theta_i, theta_r + zero) + gain(theta_i) + noise

Both are unknown and small: normal about 0 with `GAIN` and `ZERO_DEG` as their standard deviations. They are fitted
together with the model by Gauss-Newton steps in which the priors count as values, so that its standard errors hold what
they leave open; and only where they take away what the model could not follow. Each step is taken where the arm stands
after the last: over the core of a narrow lobe ln f is not straight in its zero.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ..data.measurement import Measurement
from ..data.noise_model import SIGMA_PER_MEDIAN
from ..data.scans import arm_turned
from ..finding import Finding
from ..flags import Effect
from ..formed import formed
from ..numerics.covariance import covariance_of
from ..physics.aperture import Instrument
from ..records import dataclass
from . import weights
from .diagnostics import standard_errors
from .layout import Layout
from .objective import METRICS, Misfit
from .prepared import Prepared
from .reading import reading

GAIN = 0.02  # prior standard deviation of ln gain between scans: lamp and detector of a goniometer (ours)
ZERO_DEG = 0.2  # prior standard deviation of the arm's zero (ours)
MOST_SCANS = 40  # with more incidences none was held
LEAST_IN_SCAN = 6  # directions
STEP = 1e-3  # of ln gain and of degrees, for differences
STEPS = 8  # of Gauss and Newton, the most
SETTLED = 0.02  # standard errors, below which a step of all numbers is the last
SURE = 4.0  # standard deviations of chi² by which the misfit must fall
HOPELESS = 0.5  # of that fall, which the first step must promise (ours)
CERTAINLY = 1.5  # times the score of a discrepancy, from which after the first step one stays (ours)
MOST_CHANNELS = 31  # more make the joint problem dear
LEAST = 2e-3  # rms of ln that it does to the values: less is no instrument's, but rounding or the law's own (ours)
IN_COMMON = 3.0  # standard deviations of the mean of gains, beyond which it is a scale that the law lacks (ours)
LIKELY = 4.0  # prior standard deviations; what is farther off is no drift
WILD = 3.0  # robust standard deviations beyond which a residual is cut, lest a few hide that the others correlate


@dataclass(frozen=True, eq=False)
class Drift:
    """What was found of an instrument beside one model."""

    theta_i_deg: np.ndarray  # (scans,)
    ln_gains: np.ndarray  # (scans,): the values were that much too bright
    ln_gains_stderr: np.ndarray
    zero_deg: float  # the true angle is the reported one plus this
    zero_stderr_deg: float


@dataclass(frozen=True, eq=False)
class Adjusted:
    """A model and an instrument that were fitted together."""

    drift: Drift
    values: dict
    stderr: dict
    penalised: float  # sum of squares, those of the priors included, in units of `variance`
    variance: float  # of one residual, as many times as channels say the same
    before: float  # sum of squares of the model alone
    did: float  # rms of ln that the instrument does to the values
    at: tuple[np.ndarray, np.ndarray]  # coordinates


def scans_of(measurement: Measurement) -> tuple[np.ndarray, np.ndarray] | None:
    """Incidence angles [deg] and the number of each row's scan; None where no incidence was held."""
    angles, scan = np.unique(np.round(measurement.geom.theta_i_deg[:, 0], 1), return_inverse=True)
    if not 2 <= len(angles) <= MOST_SCANS or np.median(np.bincount(scan)) < LEAST_IN_SCAN:
        return None
    return angles, scan.reshape(-1)


def without_drift(measurement: Measurement, drift: Drift) -> Measurement:
    """The values without their gains, the directions with the arm's zero."""
    scan = np.argmin(np.abs(measurement.geom.theta_i_deg - drift.theta_i_deg), axis=1)
    gain = np.exp(drift.ln_gains[scan])[:, None]
    stderr = None if measurement.stderr is None else measurement.stderr / gain
    return replace(_turned(measurement, drift.zero_deg), brdf=measurement.brdf / gain, stderr=stderr)


@dataclass(frozen=True, eq=False)
class Begun:
    """A model and an instrument before they are fitted together, and the first step of Gauss and Newton."""

    layout: Layout
    angles: np.ndarray  # (scans,), degrees
    scan: np.ndarray  # (samples,), the number of each row's
    misfit: Misfit
    at: tuple[np.ndarray, np.ndarray]  # coordinates
    here: "_Around"
    priors: np.ndarray  # standard deviations
    freedom: int  # values less numbers of the model
    variance: float  # of one residual
    first: tuple[np.ndarray, np.ndarray, np.ndarray]  # what is free, its step and covariance
    squares: float  # sum, those of the priors included, that the step promises
    hopeless: bool  # what it promises is far from an answer


def begun(layout: Layout, values: Mapping, data: Prepared, residuals: np.ndarray) -> Begun | None:
    """Looks ahead from the model's own values by one step; None where the data have no scans.

    `residuals` ln(model/data) of the model alone, where the best models settle.
    """
    found = scans_of(data.fewer.measurement)
    if found is None or layout.channels > MOST_CHANNELS:
        return None
    angles, scan = found
    misfit, alike = _by_noise(layout, data, residuals)
    at = layout.encode(values)
    if not alike:
        alone = misfit.descend(at, 1e-6)
        at = alone.shared, alone.per_channel
    priors = np.r_[np.full(len(angles), GAIN), ZERO_DEG]
    here = _around(misfit, *at, scan, len(angles))
    before = float(np.sum(here.residual**2))
    freedom = int(np.count_nonzero(data.fewer.measurement.weighed)) - layout.count
    variance = standard_errors.common_channels(here.residual) * before / max(freedom, 1)
    free = _inside(layout, *at)
    step, covariance = _step(here, free, np.zeros(len(priors)), variance / priors**2)
    left = here.residual + _by_step(here, free, step)
    then = _variance(left, freedom - len(priors))
    squares = float(np.sum(left**2) + then * np.sum((step[-len(priors) :] / priors) ** 2))
    hopeless = (before - squares) / then < HOPELESS * _least_fall(len(priors)) or _alike(left, misfit, data)
    first = free, step, covariance
    return Begun(layout, angles, scan, misfit, at, here, priors, freedom, variance, first, squares, hopeless)


def adjusted(begun: Begun, data: Prepared) -> Adjusted:
    """Model and instrument together, from the model's own values."""
    layout, priors, here, misfit, variance = begun.layout, begun.priors, begun.here, begun.misfit, begun.variance
    shared, per_channel = begun.at
    before, nuisance, scans = float(np.sum(here.residual**2)), np.zeros(len(priors)), len(begun.angles)
    free, step, covariance = begun.first
    for turn in range(STEPS):
        if turn:
            free = _inside(layout, shared, per_channel)
            step, covariance = _step(here, free, nuisance, variance / priors**2)
        shared, per_channel = _moved(layout, shared, per_channel, step[: len(step) - len(priors)], free)
        nuisance = nuisance + step[-len(priors) :]
        misfit = replace(misfit, measurement=_turned(data.fewer.measurement, float(nuisance[-1])))
        here = _around(misfit, shared, per_channel, begun.scan, scans)
        left = _left(here, nuisance)
        variance = _variance(left, begun.freedom - len(priors))
        if np.all(np.abs(step) < SETTLED * np.sqrt(variance * np.diag(covariance))):
            break
    errors = np.sqrt(variance * np.diag(covariance))
    drift = Drift(begun.angles, nuisance[:-1], errors[-len(priors) : -1], float(nuisance[-1]), float(errors[-1]))
    all_values = layout.decode(shared, per_channel)
    return Adjusted(
        drift=drift,
        values=all_values,
        stderr=_errors(layout, all_values, errors[: -len(priors)] ** 2, free),
        penalised=float(np.sum(left**2) / variance + np.sum((nuisance / priors) ** 2)),
        variance=variance,
        before=before / variance,
        did=float(np.sqrt(np.mean((here.columns @ nuisance) ** 2))),
        at=(shared, per_channel),
    )


def _variance(left: np.ndarray, freedom: int) -> float:
    """Of one residual, as many times as channels say the same."""
    return max(standard_errors.common_channels(left) * float(np.sum(left**2)) / max(freedom, 1), 1e-30)


def _least_fall(count: int) -> float:
    """Of chi², by far more than by chance, for so many numbers of the instrument."""
    return count + SURE * np.sqrt(2 * count)


def _alike(left: np.ndarray, misfit: Misfit, data: Prepared) -> bool:
    """Whether neighbours among the residuals that a step leaves are alike by far more than where none errs."""
    if len(data.fewer.weights) < len(data.settle.weights):
        return False  # their order is not known
    with np.errstate(divide="ignore", invalid="ignore"):
        part = np.where(misfit.weights > 0, left / np.sqrt(misfit.weights), np.nan)
    return standard_errors.serial_correlation(part, data.orders)[1] > CERTAINLY * standard_errors.DISCREPANT


def _by_noise(layout: Layout, data: Prepared, residuals: np.ndarray) -> tuple[Misfit, bool]:
    """The misfit in which every residual has one variance, without which its fall is no chi²; and whether it is the
    fit's own: there a sparse scan counts more than it is sure, and dim values as much as bright ones."""
    own, few = data.fewer.misfit(layout, METRICS["ln"]), data.fewer
    variance = float(np.nanmean(residuals**2))
    unlike = weights.unlike(few.measurement, data.sample_weights, data.used, few.rows, variance)
    if unlike is None:
        return own, True
    counted = few.weights / np.where(few.measurement.weighed, unlike, 1.0)
    return replace(own, weights=counted / np.mean(counted[few.measurement.weighed])), False


def _turned(measurement: Measurement, zero_deg: float) -> Measurement:
    return replace(measurement, geom=arm_turned(measurement.geom, zero_deg))


@formed
def _either_side(measurement: Measurement) -> Instrument:
    """The directions with the arm a little farther from the normal, and then all of them a little nearer."""
    count = len(measurement.brdf)
    twice = measurement.geom[np.tile(np.arange(count), 2)]
    return Instrument(arm_turned(twice, np.repeat((STEP, -STEP), count)[:, None]), measurement.solid_angle)


class _Around(NamedTuple):
    """Residuals where the search is and the arm stands, and their derivatives."""

    residual: np.ndarray  # (samples, channels)
    by_shared: np.ndarray  # (channels, samples, p)
    by_own: np.ndarray  # (channels, samples, q)
    columns: np.ndarray  # (samples, channels, scans + 1) by what the instrument does: the gains, then the zero


def _around(misfit: Misfit, shared, per_channel, scan, scans: int) -> _Around:
    """A gain is taken of the model: of a value near the dark level it would follow that value's own noise."""
    measurement = misfit.measurement
    read, residual, by_shared, by_own = misfit.with_reading(shared, per_channel)
    surface = misfit.layout.surface(shared, per_channel, measurement)
    farther, nearer = np.split(reading(surface, _either_side(measurement)), 2)
    columns = np.zeros((*residual.shape, scans + 1))
    columns[np.arange(len(scan)), :, scan] = misfit.between(np.exp(STEP) * read, np.exp(-STEP) * read) / (2 * STEP)
    columns[..., -1] = misfit.between(farther, nearer) / (2 * STEP)
    return _Around(residual, by_shared, by_own, columns)


def _left(here: _Around, nuisance) -> np.ndarray:
    """Residuals (samples, channels), taken where the arm stands, without the gains."""
    return here.residual + np.tensordot(here.columns[..., :-1], nuisance[:-1], axes=(2, 0))


def _design(here: _Around, free) -> np.ndarray:
    """Derivatives (channels x samples, numbers) by all that is `free` and by what the instrument does."""
    channels, samples, count = here.by_shared.shape
    own = here.by_own.shape[2]
    design = np.zeros((channels, samples, count + channels * own + here.columns.shape[2]))
    design[:, :, :count] = here.by_shared
    for channel in range(channels):
        design[channel, :, count + channel * own : count + (channel + 1) * own] = here.by_own[channel]
    design[:, :, count + channels * own :] = np.swapaxes(here.columns, 0, 1)
    kept = np.r_[np.flatnonzero(free), np.arange(len(free), design.shape[2])]
    return design.reshape(channels * samples, -1)[:, kept]


def _by_step(here: _Around, free, step) -> np.ndarray:
    """What a step changes of the residuals (samples, channels), to first order."""
    return (_design(here, free) @ step).reshape(here.residual.T.shape).T


def _step(here: _Around, free, nuisance, weights):
    """One step of all that is `free`, and its covariance in units of the variance."""
    design, right = _design(here, free), -np.ravel(_left(here, nuisance).T)
    normal = design.T @ design
    normal[np.diag_indices(len(normal))] += np.r_[np.zeros(int(free.sum())), weights]
    aim = design.T @ right - np.r_[np.zeros(int(free.sum())), weights * nuisance]
    covariance = covariance_of(normal, np.diag(normal))
    return covariance @ aim, covariance


def _inside(layout: Layout, shared, per_channel) -> np.ndarray:
    """Which coordinates, shared ones first and then channel by channel, stand off their bounds."""
    low, high = layout.bounds(layout.shared)
    own_low, own_high = layout.bounds(layout.per_channel)
    of_shared = (shared > low + 1e-9) & (shared < high - 1e-9)
    of_channels = (per_channel > own_low + 1e-9) & (per_channel < own_high - 1e-9)
    return np.r_[of_shared, np.ravel(of_channels)]


def _moved(layout: Layout, shared, per_channel, step, free):
    """The coordinates after a step, within their bounds."""
    moved = np.zeros(len(free))
    moved[free] = step
    low, high = layout.bounds(layout.shared)
    own_low, own_high = layout.bounds(layout.per_channel)
    return (
        np.clip(shared + moved[: len(shared)], low, high),
        np.clip(per_channel + moved[len(shared) :].reshape(per_channel.shape), own_low, own_high),
    )


def _errors(layout: Layout, values: dict, variances, free) -> dict:
    """Standard error of each free parameter in its own unit; 0 of one at a bound."""
    spread = np.zeros(len(free))
    spread[free] = variances
    count = len(layout.shared)
    per_channel = spread[count:].reshape(layout.channels, len(layout.per_channel))
    return standard_errors.in_units(layout, values, spread[:count], per_channel)


def explains(found: Adjusted, data: Prepared, residuals: np.ndarray) -> bool:
    """Whether the instrument takes away what the model alone could not follow: chi² falls by far more than as many
    numbers would by chance, no discrepancy is left, not even beside a few wild values, and nothing is larger or smaller
    than an instrument drifts, or the same in all scans.

    `residuals` ln(model/data) of the adjusted, where the best models settle.
    """
    drift = found.drift
    count = len(drift.ln_gains) + 1
    fallen = found.before - found.penalised
    if fallen < _least_fall(count) or found.did < LEAST:
        return False
    if np.any(np.abs(drift.ln_gains) > LIKELY * GAIN) or abs(drift.zero_deg) > LIKELY * ZERO_DEG:
        return False
    if _is_scale(drift):
        return False
    widest = WILD * SIGMA_PER_MEDIAN * float(np.nanmedian(np.abs(residuals)))
    return all(
        standard_errors.discrepancy(each, *standard_errors.serial_correlation(each, data.orders)) is None
        for each in (residuals, np.clip(residuals, -widest, widest))
    )


def _is_scale(drift: Drift) -> bool:
    """Whether the gains are alike and far from none: no lamp drifts so, but a law has a wrong level."""
    gains = drift.ln_gains
    chance = np.hypot(np.std(gains) / np.sqrt(len(gains)), np.mean(drift.ln_gains_stderr))
    return bool(abs(np.mean(gains)) > IN_COMMON * chance)


def instrument_finding(drift: Drift) -> Finding:
    """What was found, in a sentence."""
    spread = float(np.sqrt(np.mean((drift.ln_gains - drift.ln_gains.mean()) ** 2)))
    text = (
        f"the instrument, not the model: the scans' gains differ by {100 * spread:.2g} % (rms), and the detector's arm "
        f"stands {drift.zero_deg:+.2f} ± {drift.zero_stderr_deg:.2f} degrees from its zero"
    )
    numbers = [("gains_rms", spread), ("zero_deg", drift.zero_deg), ("zero_stderr_deg", drift.zero_stderr_deg)]
    for theta, gain, error in zip(drift.theta_i_deg, drift.ln_gains, drift.ln_gains_stderr, strict=True):
        numbers += [(f"ln_gain_{theta:g}", float(gain)), (f"ln_gain_stderr_{theta:g}", float(error))]
    consequence = "fitted beside every model, and held in their intervals; errors are told without it"
    return Finding("instrument", text, "warning", consequence, numbers=tuple(numbers))


def without_discrepancy(findings: Sequence[Finding]) -> tuple[Finding, ...]:
    """The doubts about a model that stay once the instrument explains its misfit."""
    return tuple(each for each in findings if each.effect is not Effect.OF_MISFIT)
