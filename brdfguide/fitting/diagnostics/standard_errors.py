"""How far a fitted number can be trusted: standard errors, what the data leave open, and a wrong model's traces."""

from collections.abc import Mapping
from math import erfc, expm1, sqrt

import numpy as np

from ...data.measurement import Measurement
from ...data.turning import turn_of_each
from ...finding import Finding
from ...flags import Effect
from ...models.model import Parameter
from ...numerics.covariance import Normal, covariance_of
from ...physics import fresnel
from ...printable import off_words
from ..layout import Layout, slope_of_coordinate

BLOCKS = 8  # of each incidence angle: neighbours in one block err together
APART = 9  # decimals of cosines by which neighbours are put in order
LOOSE = 0.5  # standard error of a logarithm beyond which a parameter counts as not determined: a factor 1.6
ILL = 1e3  # condition number of the scaled problem beyond which single intervals mislead (ours)
LOOSE_AXIS = 1 / 6 / np.pi  # standard error of an axis over half a turn, beyond which there is none
MOST_POWER = 10.0  # of one parameter beside another in a product that is worth telling
LEAST_TOLD = (
    0.02  # rms ln of a discrepancy below which it widens errors and is not told: 2 %, a good calibration (ours)
)
DISCREPANT = 3.5  # standard deviations of the lag-one correlation, over four orderings: under 1 in 1000 by chance


def orderings(measurement: Measurement) -> list[np.ndarray]:
    """Row orders in which neighbours lie close: along scans, by tilt of the half vector, half angle, incidence.

    cos² of the tilt and the cosine of the half angle are told apart to nine decimals, and rows that are alike stay in
    the order of the file: in scans many are, and the last digits would otherwise decide.
    """
    geom = measurement.geom

    def flat(values):
        return np.ravel(np.broadcast_to(values, geom.shape))

    half, upright = np.round(flat(geom.cos_d), APART), np.round(1 / (1 + flat(geom.tan2_h)), APART)
    return [
        along_scans(measurement),
        np.lexsort((half, np.round(np.sqrt(flat(geom.tan2_h)), 3))),
        np.lexsort((-upright, np.round(flat(geom.cos_d), 3))),
        np.lexsort((-upright, np.round(flat(geom.theta_r_deg), 1))),
    ]


def along_scans(measurement: Measurement) -> np.ndarray:
    """The row order by turn of the sample, incidence, azimuth and reflected angle."""
    geom, turns = measurement.geom, turn_of_each(measurement.geom)
    azimuth = np.round(np.abs(np.remainder(geom.phi_deg + 180, 360) - 180), 1)
    keys = (geom.signed_theta_r_deg[:, 0], azimuth[:, 0], np.round(geom.theta_i_deg[:, 0], 1))
    return np.lexsort(keys if turns is None else (*keys, turns))


def blocks_of(measurement: Measurement, order) -> np.ndarray:
    """A number for each row: rows with the same one are neighbours in `order` and are not counted as independent."""
    angles = np.round(measurement.geom.theta_i_deg[order, 0], 1)
    starts = np.flatnonzero(np.diff(angles, prepend=-1.0))
    sizes = np.diff(np.append(starts, len(order)))
    if len(starts) > 64:  # scattered incidence: the order alone decides
        return even_blocks(order)
    each = BLOCKS if len(starts) > 1 else _pieces(len(order))
    blocks = np.empty(len(order), int)
    for group, (start, size) in enumerate(zip(starts, sizes, strict=True)):
        blocks[order[start : start + size]] = group * each + np.arange(size) * each // size
    return blocks


def whole_scans(measurement: Measurement) -> np.ndarray | None:
    """A number for each row, that of its turn of the sample and its incidence: a scan under another turn is mounted
    anew, and its gain is its own. None where the sample was not turned, and of scattered incidence."""
    turns, angles = turn_of_each(measurement.geom), np.round(measurement.geom.theta_i_deg[:, 0], 1)
    incidences, place = np.unique(angles, return_inverse=True)
    if turns is None or len(incidences) > 64:
        return None
    return turns * len(incidences) + place


def even_blocks(order) -> np.ndarray:
    """A number for each row: the order cut into 32 to 256 pieces of equal length."""
    blocks = np.empty(len(order), int)
    blocks[order] = np.arange(len(order)) * _pieces(len(order)) // len(order)
    return blocks


def _pieces(count: int) -> int:
    return int(np.clip(count // 50, 4 * BLOCKS, 256))


def serial_correlation(residuals: np.ndarray, orders) -> tuple[float, float]:
    """Largest lag-one correlation of residuals (samples, channels; NaN missing) over the orders, and its z-score."""
    worst, score = 0.0, 0.0
    complete = np.isfinite(residuals).all()
    for order in orders:
        along = residuals.take(order, axis=0)
        ahead, behind = along[1:].ravel(), along[:-1].ravel()
        if not complete:
            both = np.isfinite(ahead + behind)
            ahead, behind = ahead[both], behind[both]
        count = ahead.size
        if count < 8:
            continue
        power = 0.5 * (ahead @ ahead + behind @ behind)
        correlation = float(ahead @ behind / power) if power > 0 else 0.0
        if correlation > worst:
            # channels that err together count once
            worst, score = correlation, correlation * sqrt(count / common_channels(residuals))
    return worst, score


def common_channels(residuals: np.ndarray) -> float:
    """How many channels say the same: 1 for independent residuals, the number of channels for identical ones."""
    channels = residuals.shape[1]
    if channels == 1:
        return 1.0
    finite = np.isfinite(residuals)
    filled = residuals if finite.all() else np.where(finite, residuals, 0.0)
    squares = filled.T @ filled
    scale = np.sqrt(np.maximum(np.diag(squares), 1e-300))
    correlation2 = (squares / np.outer(scale, scale)) ** 2
    chance = (channels - 1) / max(len(residuals), 1)  # what independent channels show by chance
    return float(np.clip(correlation2.sum() / channels - chance, 1.0, channels))


def student_widening(freedom: float) -> float:
    """Student's t over the normal deviate at two standard errors, to second order in 1/freedom."""
    return 1 + 1.25 / freedom + 1.53 / freedom**2


def serial_widening(correlation: float) -> float:
    """How many neighbours in a row say what one says."""
    return (1 + correlation) / (1 - min(correlation, 0.95))


def standard_errors(
    layout: Layout, values: Mapping, shared, per_channel, residuals: np.ndarray, correlation: float
) -> dict:
    """Standard error of each free parameter, in its own unit; infinite where the data say nothing.

    From variances of the shared (p,) and per-channel (channels, q) coordinates by residuals that know nothing of each
    other, widened where neighbours or channels err together: (1+ρ)/(1-ρ) for a serial correlation ρ, and the number of
    channels that say the same for what all channels share.
    """
    wider = serial_widening(correlation)
    return in_units(layout, values, wider * common_channels(residuals) * shared, wider * per_channel)


def errors_of_a_wrong_model(layout: Layout, values: Mapping, normal: Normal, misfit, blocks) -> dict:
    """Standard error of each free parameter of a model whose residuals are no noise: from what blocks of neighbours
    pull it by.

    (JᵀJ)⁻¹ Σ_blocks (Jᵀr)(Jᵀr)ᵀ (JᵀJ)⁻¹, so that a few directions that carry a parameter, such as a narrow peak, tell
    how loosely (White 1980, "A heteroskedasticity-consistent covariance matrix estimator"; by blocks, Liang and Zeger
    1986). The largest over several ways to cut the data into blocks.

    Takes  `misfit` as (r (samples, channels), j_shared, j_per_channel) at `values`, `blocks` as arrays (samples,).
    """
    moved, per_channel_moved = normal.influence(*misfit)

    def variance(pulls):
        return max(float(sums @ sums) for sums in (np.bincount(each, pulls) for each in blocks))

    shared = np.array([variance(column) for column in moved.T])
    per_channel = np.array([[variance(column) for column in channel.T] for channel in per_channel_moved]).reshape(
        per_channel_moved.shape[::2]
    )
    return in_units(layout, values, shared, per_channel)


def in_units(layout: Layout, values: Mapping, shared, per_channel) -> dict:
    """Standard errors from variances (p,) and (channels, q) of the coordinates."""
    errors = {}
    for keys, variances in ((layout.shared, shared), (layout.per_channel, per_channel.T)):
        for key, variance in zip(keys, variances, strict=True):
            slope = slope_of_coordinate(layout.parameters[key], np.asarray(values[key]))
            errors[key] = np.abs(slope) * np.sqrt(np.maximum(variance, 0.0))
    return {key: float(error) if np.ndim(error) == 0 else error for key, error in errors.items()}


def parameter_doubts(
    layout: Layout, values: Mapping, errors: dict, normal: Normal, variance: float
) -> tuple[Finding, ...]:
    """Parameters at a bound, parameters that the data do not determine, and pairs of which only a combination is.

    `variance` of one residual, widened for neighbours and channels that err together.
    """
    found = []
    for key, parameter in layout.parameters.items():
        value, error = np.atleast_1d(values[key]), np.atleast_1d(errors[key])
        if parameter.period is not None:
            found += _axis_doubt(key, parameter, errors[key])
            continue
        span = parameter.high - parameter.low
        for end, bound in (("low", parameter.low), ("high", parameter.high)):
            at = _at(bound, value)
            if at.any() and not (parameter.linear and end == "low"):
                found.append(
                    Finding(
                        "at-bound",
                        f"{key} ended at its {end} bound {parameter.outside(bound):.4g}",
                        "warning",
                        "its true value may lie beyond",
                        subject=key,
                    )
                )
            elif at.all():
                found.append(
                    Finding("unused", f"{key} is 0: the term is not needed", "note", "leave it out", subject=key)
                )
        away = np.abs(value - parameter.origin) if parameter.log else np.maximum(np.abs(value), 1e-3 * span)
        loose = error / np.maximum(away, 1e-300)
        if (loose[0] if loose.size == 1 else np.median(loose)) > LOOSE and (value > parameter.low).any():
            found.append(
                Finding(
                    "undetermined",
                    f"the data do not determine {key}",
                    "warning",
                    "do not use its value by itself",
                    subject=key,
                )
            )
    found += _lobes_not_shown(layout, found)
    found += _ridge(layout, values, normal, variance)
    return tuple(found)


def _axis_doubt(key: str, parameter: Parameter, error) -> list[Finding]:
    """Where a lobe is round within its error: sigma(axis) = sigma(q)/2q, so that q < 3 sigma(q) is 1/6 rad."""
    if np.median(error) <= LOOSE_AXIS * (parameter.period or 0.0):
        return []
    text = f"the lobe is round within its error: it has no axis, and {key} says nothing"
    return [Finding("axis-undetermined", text, "warning", "take the law without a grain", subject=key)]


def _lobes_not_shown(layout: Layout, found) -> list[Finding]:
    """Of two lobes of one law: where one shape of a lobe is not determined, nothing else of that lobe is."""
    loose = [each.subject for each in found if each.effect is Effect.LOOSENS]
    lobes = {key.rpartition(".")[0] for key in loose if key.rpartition(".")[0][-1].isdigit()}
    rest = [key for key in layout.parameters if key.rpartition(".")[0] in lobes and key not in loose]
    return [
        Finding(
            "undetermined",
            f"the data do not determine {key}, since they hardly show its lobe",
            "warning",
            "do not use its value by itself",
            subject=key,
        )
        for key in rest
    ]


def _ridge(layout: Layout, values: Mapping, normal: Normal, variance: float) -> list[Finding]:
    """Names the combination along which the misfit hardly changes, and the one across it that the data determine."""
    keys = layout.shared + layout.per_channel
    p = len(layout.shared)
    full = np.zeros((len(keys), len(keys)))
    full[:p, :p] = normal.shared
    full[:p, p:] = normal.between.sum(0)
    full[p:, :p] = full[:p, p:].T
    full[p:, p:] = normal.per_channel.sum(0)  # the channels together: one amplitude of each kind
    free = [
        place
        for place, key in enumerate(keys)
        if full[place, place] > 0
        and not any(
            np.any(_at(bound, values[key])) for bound in (layout.parameters[key].low, layout.parameters[key].high)
        )
    ]
    if len(free) < 2:
        return []
    keys, full = tuple(keys[place] for place in free), full[np.ix_(free, free)]
    scale = np.sqrt(np.diag(full))
    strength, vectors = np.linalg.eigh(full / np.outer(scale, scale))
    condition = sqrt(strength[-1] / max(strength[0], strength[-1] * np.finfo(float).eps))  # no further than rounding
    weak = [place for place in np.argsort(-np.abs(vectors[:, 0])) if abs(vectors[place, 0]) > 0.3]
    if condition < ILL or len(weak) < 2:
        return []
    text = (
        f"only a combination of {' and '.join(keys[place] for place in weak)} is determined (condition number "
        f"{condition:.0f})"
    )
    if len(weak) == 2 and strength[0] > 0:
        inverse, pair = covariance_of(full, np.diag(full)), sorted(weak)
        text += _across(
            layout,
            values,
            [keys[place] for place in pair],
            vectors[pair, 0] / scale[pair],
            variance * inverse[np.ix_(pair, pair)],
        )
    return [Finding("ridge", text, "warning", "move them together or fix one", "--fix", (("condition", condition),))]


def _at(bound: float, value):
    """Where a value stands at a bound."""
    return np.abs(value - bound) <= 1e-9 * abs(bound)


def _across(layout: Layout, values: Mapping, keys: list[str], along, covariance) -> str:
    """The product of powers of two parameters that stays put `along` the ridge, with its standard error; nothing where
    one of them hardly enters."""
    names, sizes, rates = zip(*(_logarithmic(layout.parameters[key], key, values) for key in keys), strict=True)
    power = -rates[0] * along[0] / (rates[1] * along[1])
    if not 1 / MOST_POWER < abs(power) < MOST_POWER:
        return ""
    value, slope = sizes[0] * sizes[1] ** power, np.array([rates[0], power * rates[1]])
    error = sqrt(max(slope @ covariance @ slope, 0.0))
    shown = f"{np.min(value):.3g}..{np.max(value):.3g}" if np.size(value) > 1 else f"{float(np.ravel(value)[0]):.4g}"
    return f": {names[0]} * {names[1]}^{power:.3g} = {shown}, to {100 * error:.2g} %"


def _logarithmic(parameter, key: str, values: Mapping):
    """Name and size of what enters a product, and d ln(size) by the coordinate: F0, or what is above the origin."""
    value = np.asarray(values[key], float)
    slope = slope_of_coordinate(parameter, value)
    if parameter.name == "n":
        # a coat has no k
        k, step = np.asarray(values.get(key[:-1] + "k", 0.0), float), 1e-6 * np.maximum(np.abs(value - 1), 1e-3)
        rate = (np.log(fresnel.f0(value + step, k)) - np.log(fresnel.f0(value - step, k))) / (2 * step)
        return f"F0 of {key[:-2]}", fresnel.f0(value, k), float(np.mean(rate * slope))
    size = value - parameter.origin
    return key, size, float(np.mean(slope / size))


def worth_telling(wrong: Finding | None) -> bool:
    """Whether a discrepancy is more than data and laws ever agree to."""
    return wrong is not None and dict(wrong.numbers)["systematic_rms_ln"] >= LEAST_TOLD


def discrepancy(residuals: np.ndarray, correlation: float, score: float) -> Finding | None:
    """A model that is wrong leaves neighbouring residuals alike, however narrow its intervals."""
    if score < DISCREPANT:
        return None
    rms = float(np.sqrt(np.nanmean(residuals**2)))
    part = rms * sqrt(correlation)
    percent = 100 * expm1(min(part, 300.0))
    text = (
        f"the model is systematically off by about {off_words(percent)}, alike over neighbouring directions "
        f"(correlation {correlation:.2f})"
    )
    numbers = (
        ("percent", percent),
        ("systematic_rms_ln", part),
        ("correlation", correlation),
        ("z", score),
        ("chance", 0.5 * erfc(score / sqrt(2))),
    )
    return Finding(
        "discrepancy",
        text,
        "warning",
        "its standard errors say how sure its own best numbers are, not how near they come to the surface",
        "",
        numbers,
    )


def starts_disagree(layout: Layout, ends) -> Finding | None:
    """Two starts that ended equally well in different places."""
    if len(ends) < 2:
        return None
    (best, _, error), (other, _, worse) = ends[:2]
    if worse > 1.02 * error + 1e-6 or np.max(np.abs(best - other), initial=0.0) < 0.1:
        return None
    per_channel = np.zeros((layout.channels, len(layout.per_channel)))
    ends_at = [layout.decode(shared, per_channel) for shared in (best, other)]
    one, two = (
        ", ".join(f"{key} {layout.parameters[key].outside(values[key]):.3g}" for key in layout.shared)
        for values in ends_at
    )
    text = f"two starts ended equally well in different places: {one}; or {two}"
    return Finding("starts-disagree", text, "warning", "look at both")
