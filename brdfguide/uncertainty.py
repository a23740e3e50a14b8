"""How far a fitted number can be trusted: standard errors, what the data do not determine, and a wrong model's traces."""

from math import erfc, sqrt

import numpy as np

from . import optics
from .levenberg import Normal, covariance_of
from .measurement import Finding, Measurement
from .misfit import Layout, slope_of_coordinate

SEGMENTS = 8  # of each incidence angle: neighbours in one segment err together
LOOSE = 0.5  # standard error of a logarithm beyond which a parameter counts as not determined: a factor 1.6
ILL = 1e3  # condition number of the scaled problem beyond which single intervals mislead (ours)
MOST_POWER = 10.0  # of one parameter beside another in a product that is worth telling
DISCREPANT = 3.5  # standard deviations of the lag-one correlation, over four orderings: under 1 in 1000 by chance


def orderings(measurement: Measurement) -> list[np.ndarray]:
    """Row orders in which neighbours lie close: along scans, by tilt of the half vector, by half angle, by incidence."""
    geom = measurement.geom
    flat = lambda values: np.ravel(np.broadcast_to(values, geom.shape))  # noqa: E731
    return [
        along_scans(measurement),
        np.lexsort((flat(geom.cos_d), np.round(np.sqrt(flat(geom.tan2_h)), 3))),
        np.lexsort((flat(geom.tan2_h), np.round(flat(geom.cos_d), 3))),
        np.lexsort((flat(geom.tan2_h), np.round(flat(geom.theta_r_deg), 1))),
    ]


def along_scans(measurement: Measurement) -> np.ndarray:
    """The row order by incidence, azimuth and reflected angle."""
    geom = measurement.geom
    azimuth = np.round(np.abs(np.remainder(geom.phi_deg + 180, 360) - 180), 1)
    return np.lexsort((geom.signed_theta_r_deg[:, 0], azimuth[:, 0], np.round(geom.theta_i_deg[:, 0], 1)))


def segments_of(measurement: Measurement, order) -> np.ndarray:
    """A number for each row: rows with the same one are neighbours in `order` and are not counted as independent."""
    angles = np.round(measurement.geom.theta_i_deg[order, 0], 1)
    starts = np.flatnonzero(np.diff(angles, prepend=-1.0))
    sizes = np.diff(np.append(starts, len(order)))
    if len(starts) > 64:  # scattered incidence: the order alone decides
        return stretches(order)
    each = SEGMENTS if len(starts) > 1 else _pieces(len(order))
    segments = np.empty(len(order), int)
    for group, (start, size) in enumerate(zip(starts, sizes)):
        segments[order[start : start + size]] = group * each + np.arange(size) * each // size
    return segments


def stretches(order) -> np.ndarray:
    """A number for each row: the order cut into 32 to 256 pieces of equal length."""
    segments = np.empty(len(order), int)
    segments[order] = np.arange(len(order)) * _pieces(len(order)) // len(order)
    return segments


def _pieces(count: int) -> int:
    return int(np.clip(count // 50, 4 * SEGMENTS, 256))


def serial_correlation(residuals: np.ndarray, orders) -> tuple[float, float]:
    """Largest lag-one correlation of residuals (samples, channels; NaN missing) over the orders, and its z-score."""
    worst, score = 0.0, 0.0
    for order in orders:
        along = residuals[order]
        ahead, behind = along[1:], along[:-1]
        both = np.isfinite(ahead + behind)
        if not both.all():
            ahead, behind = ahead[both], behind[both]
        count = ahead.size
        if count < 8:
            continue
        power = 0.5 * (np.mean(ahead**2) + np.mean(behind**2))
        correlation = float(np.mean(ahead * behind) / power) if power > 0 else 0.0
        if correlation > worst:
            # channels that err together count once
            worst, score = correlation, correlation * sqrt(count / common_channels(residuals))
    return worst, score


def common_channels(residuals: np.ndarray) -> float:
    """How many channels say the same: 1 for independent residuals, the number of channels for identical ones."""
    channels = residuals.shape[1]
    if channels == 1:
        return 1.0
    filled = np.where(np.isfinite(residuals), residuals, 0.0)
    squares = filled.T @ filled
    scale = np.sqrt(np.maximum(np.diag(squares), 1e-300))
    correlation2 = (squares / np.outer(scale, scale)) ** 2
    chance = (channels - 1) / max(len(residuals), 1)  # what independent channels show by chance
    return float(np.clip(correlation2.sum() / channels - chance, 1.0, channels))


def serial_widening(correlation: float) -> float:
    """How many neighbours in a row say what one says."""
    return (1 + correlation) / (1 - min(correlation, 0.95))


def standard_errors(layout: Layout, values: dict, shared, own, residuals: np.ndarray, correlation: float) -> dict:
    """Standard error of each free parameter, in its own unit; infinite where the data say nothing.

    From variances of the shared (p,) and own (channels, q) coordinates by residuals that know nothing of each other, widened where
    neighbours or channels err together: (1+ρ)/(1-ρ) for a serial correlation ρ, and the number of channels that say the same for
    what all channels share.
    """
    wider = serial_widening(correlation)
    return _in_units(layout, values, wider * common_channels(residuals) * shared, wider * own)


def errors_of_a_wrong_model(layout: Layout, values: dict, normal: Normal, misfit, segments) -> dict:
    """Standard error of each free parameter of a model whose residuals are no noise: from what segments of neighbours pull it by.

    (JᵀJ)⁻¹ Σ_segments (Jᵀr)(Jᵀr)ᵀ (JᵀJ)⁻¹, so that a few directions that carry a parameter, such as a narrow peak, tell how
    loosely (White 1980, "A heteroskedasticity-consistent covariance matrix estimator"; by segments, Liang and Zeger 1986).
    The largest over several ways to cut the data into segments.

    Takes  `misfit` as (r (samples, channels), j_shared, j_own) at `values`, `segments` as arrays (samples,).
    """
    moved, own_moved = normal.influence(*misfit)
    variance = lambda pulls: max(float(np.sum(np.bincount(each, pulls) ** 2)) for each in segments)  # noqa: E731
    shared = np.array([variance(column) for column in moved.T])
    own = np.array([[variance(column) for column in channel.T] for channel in own_moved]).reshape(own_moved.shape[::2])
    return _in_units(layout, values, shared, own)


def _in_units(layout: Layout, values: dict, shared, own) -> dict:
    """Standard errors from variances (p,) and (channels, q) of the coordinates."""
    errors = {}
    for keys, variances in ((layout.shared, shared), (layout.own, own.T)):
        for key, variance in zip(keys, variances):
            slope = slope_of_coordinate(layout.parameters[key], np.asarray(values[key]))
            errors[key] = np.abs(slope) * np.sqrt(np.maximum(variance, 0.0))
    return {key: float(error) if np.ndim(error) == 0 else error for key, error in errors.items()}


def doubts(layout: Layout, values: dict, errors: dict, normal: Normal, variance: float) -> tuple[Finding, ...]:
    """Parameters at a bound, parameters that the data do not determine, and pairs of which only a combination is.

    `variance` of one residual, widened for neighbours and channels that err together.
    """
    found = []
    for key, parameter in layout.parameters.items():
        value, error = np.atleast_1d(values[key]), np.atleast_1d(errors[key])
        span = parameter.high - parameter.low
        for end, bound in (("low", parameter.low), ("high", parameter.high)):
            at = _at(bound, value)
            if np.any(at) and not (parameter.linear and end == "low"):
                found.append(Finding(f"at-bound:{key}", f"{key} ended at its {end} bound {parameter.outside(bound):.4g}", "warning", "its true value may lie beyond"))
            elif np.all(at):
                found.append(Finding(f"unused:{key}", f"{key} is 0: the term is not needed", "note", "leave it out"))
        away = np.abs(value - parameter.origin) if parameter.log else np.maximum(np.abs(value), 1e-3 * span)
        if np.median(error / np.maximum(away, 1e-300)) > LOOSE and np.any(value > parameter.low):
            found.append(Finding(f"undetermined:{key}", f"the data do not determine {key}", "warning", "do not use its value by itself"))
    found += _lobes_not_shown(layout, found)
    found += _ridge(layout, values, normal, variance)
    return tuple(found)


def _lobes_not_shown(layout: Layout, found) -> list[Finding]:
    """Of two lobes of one law: where one shape of a lobe is not determined, nothing else of that lobe is."""
    loose = [each.code.removeprefix("undetermined:") for each in found if each.code.startswith("undetermined:")]
    lobes = {key.rpartition(".")[0] for key in loose if key.rpartition(".")[0][-1].isdigit()}
    rest = [key for key in layout.parameters if key.rpartition(".")[0] in lobes and key not in loose]
    return [Finding(f"undetermined:{key}", f"the data do not determine {key}, since they hardly show its lobe", "warning", "do not use its value by itself") for key in rest]


def _ridge(layout: Layout, values: dict, normal: Normal, variance: float) -> list[Finding]:
    """Names the combination along which the misfit hardly changes, and gives the one across it that the data determine."""
    keys = layout.shared + layout.own
    p = len(layout.shared)
    full = np.zeros((len(keys), len(keys)))
    full[:p, :p] = normal.shared
    full[:p, p:] = normal.between.sum(0)
    full[p:, :p] = full[:p, p:].T
    full[p:, p:] = normal.own.sum(0)  # the channels together: one amplitude of each kind
    free = [place for place, key in enumerate(keys) if full[place, place] > 0 and not np.any([_at(bound, values[key]) for bound in (layout.parameters[key].low, layout.parameters[key].high)])]
    if len(free) < 2:
        return []
    keys, full = [keys[place] for place in free], full[np.ix_(free, free)]
    scale = np.sqrt(np.diag(full))
    strength, vectors = np.linalg.eigh(full / np.outer(scale, scale))
    condition = sqrt(strength[-1] / strength[0]) if strength[0] > 0 else float("inf")
    weak = [place for place in np.argsort(-np.abs(vectors[:, 0])) if abs(vectors[place, 0]) > 0.3]
    if condition < ILL or len(weak) < 2:
        return []
    text = f"only a combination of {' and '.join(keys[place] for place in weak)} is determined (condition number {condition:.0f})"
    if len(weak) == 2 and strength[0] > 0:
        inverse, pair = covariance_of(full, np.diag(full)), sorted(weak)
        text += _across(layout, values, [keys[place] for place in pair], vectors[pair, 0] / scale[pair], variance * inverse[np.ix_(pair, pair)])
    return [Finding("ridge", text, "warning", "move them together or fix one", "--fix", (("condition", condition),))]


def _at(bound: float, value):
    """Where a value stands at a bound."""
    return np.abs(value - bound) <= 1e-9 * abs(bound)


def _across(layout: Layout, values: dict, keys: list[str], along, covariance) -> str:
    """The product of powers of two parameters that stays put `along` the ridge, with its standard error; nothing where one of them hardly enters."""
    names, sizes, rates = zip(*(_logarithmic(layout.parameters[key], key, values) for key in keys))
    power = -rates[0] * along[0] / (rates[1] * along[1])
    if not 1 / MOST_POWER < abs(power) < MOST_POWER:
        return ""
    value, slope = sizes[0] * sizes[1] ** power, np.array([rates[0], power * rates[1]])
    error = sqrt(max(slope @ covariance @ slope, 0.0))
    shown = f"{np.min(value):.3g}..{np.max(value):.3g}" if np.size(value) > 1 else f"{float(np.ravel(value)[0]):.4g}"
    return f": {names[0]} * {names[1]}^{power:.3g} = {shown}, to {100 * error:.2g} %"


def _logarithmic(parameter, key: str, values: dict):
    """Name and size of what enters a product, and d ln(size) by the coordinate: F0 for an index, else what is above the origin."""
    value = np.asarray(values[key], float)
    slope = slope_of_coordinate(parameter, value)
    if parameter.name == "n":
        k, step = np.asarray(values[key[:-1] + "k"], float), 1e-6 * (value - 1)
        rate = (np.log(optics.f0(value + step, k)) - np.log(optics.f0(value - step, k))) / (2 * step)
        return f"F0 of {key[:-2]}", optics.f0(value, k), float(np.mean(rate * slope))
    size = value - parameter.origin
    return key, size, float(np.mean(slope / size))


def discrepancy(residuals: np.ndarray, correlation: float, score: float) -> Finding | None:
    """A model that is wrong leaves neighbouring residuals alike, however narrow its intervals."""
    if score < DISCREPANT:
        return None
    rms = float(np.sqrt(np.nanmean(residuals**2)))
    part = rms * sqrt(correlation)
    text = f"the model is systematically off by about {part:.2g} in ln (residuals of neighbours correlate by {correlation:.2f})"
    numbers = (("systematic_rms_ln", part), ("correlation", correlation), ("z", score), ("chance", 0.5 * erfc(score / sqrt(2))))
    return Finding("discrepancy", text, "warning", "its intervals say how well this model is placed, not how right it is", "", numbers)
