"""How much each value counts: by its standard error where it has one, and so that no dense scan outvotes others."""

import numpy as np

from ..data.measurement import Measurement
from ..data.noise import DENSE
from ..errors import InputError, choices
from ..finding import Finding
from ..formed import formed

KINDS = ("auto", "none", "stderr", "sampling")
ALIKE = 2.0  # scans up to this many times as dense as others are alike
APART_DEG = 0.25  # between two incidences
HELD_DEG = 1.0  # how far one wanders that was held
LEAST_SCAN = 5  # directions; fewer are no scan, and gain nothing by being few
ROBUST_WIDTH = 2.385  # Cauchy weights, 95 % efficient for Gaussian noise (Holland and Welsch 1977)
MOST_WEIGHT = 10.0  # times that one direction counts more than another
SUREST = 1e-12  # of the mean variance: no value is surer, so that ratios stay finite


def of_values(measurement: Measurement, kind: str = "auto") -> np.ndarray:
    """Weights (samples, channels) with mean 1: from standard errors, times `sample_weights`, or all alike.

    `auto` takes the standard errors where the data bring them, and lets no dense scan outvote the others.
    Raises InputError for `stderr` where there are none.
    """
    if kind not in KINDS:
        raise choices("weighting", kind, KINDS)
    weights = np.ones_like(measurement.brdf)
    errors = measurement.stated_errors
    if kind == "stderr" and errors is None:
        raise InputError(f"{measurement.name}: the data bring no standard errors to weigh by")
    if kind in ("auto", "stderr") and errors is not None:
        size = (
            measurement.brdf if measurement.noise is None else np.hypot(measurement.brdf, 2 * measurement.noise.floor)
        )
        relative = np.where(measurement.weighed, errors / np.where(measurement.weighed, size, 1.0), np.nan)
        floor = 0.1 * np.nanmedian(relative[measurement.clear])  # one lucky sample must not decide
        weights = np.where(np.isfinite(relative), 1 / np.clip(relative, max(floor, 1e-12), 1e6) ** 2, 0.0)
    counted = sample_weights(measurement, kind)
    if counted is None and not (kind in ("auto", "stderr") and errors is not None):
        return weights
    weights = weights if counted is None else weights * counted
    return weights / np.mean(weights[measurement.weighed])


def sample_weights(measurement: Measurement, kind: str = "auto") -> np.ndarray | None:
    """How often each direction counts, (samples, 1) with mean 1, so that every incidence angle counts alike; None where
    all do.

    For `auto` scans up to twice as dense as others are alike; `sampling` makes up for less. No direction counts more
    than ten times another. Within a scan directions crowd where the lobe is, and that is left to them.
    """
    counts = _directions_of_scans(measurement) if kind in ("auto", "sampling") else None
    if counts is None:
        return None
    most, least = counts[measurement.has_value].max(), counts[measurement.has_value].min()
    if most <= (ALIKE if kind == "auto" else 1.0) * least:
        return None
    counted = np.minimum(most / np.maximum(counts, 1), MOST_WEIGHT)
    return (counted / counted[measurement.has_value].mean())[:, None]


def weighing(measurement: Measurement, kind: str = "auto", robustly: bool = False) -> tuple[Finding, ...]:
    """What weighs the values, for people."""
    found = []
    if kind in ("auto", "stderr") and measurement.stated_errors is not None:
        found.append(
            Finding("weighed-by-stderr", "each value is weighed by its standard error", option="--weights none")
        )
    if sample_weights(measurement, kind) is not None:
        counts = _directions_of_scans(measurement)[measurement.has_value]
        text = (
            f"the scans hold {counts.min()} to {counts.max()} directions: every incidence counts alike in fits and "
            f"errors, no direction over {MOST_WEIGHT:g} times another"
        )
        found.append(Finding("weighed-by-scan", text, option="--weights none"))
    if robustly:
        found.append(Finding("weighed-robustly", "values far off the model count little"))
    return tuple(found)


def unlike(measurement: Measurement, sample_weights, used, rows, variance: float) -> np.ndarray | None:
    """Variance of each residual over their mean, (samples, channels), where they are not alike; None where they are.

    Directions that count more say how much a value counts, not how sure it is. Near the dark level the generalised
    logarithm of a value is surer than its ln; `variance` is that of bright values.
    """
    noise, factor = measurement.noise, None
    if noise is not None and noise.matters:
        value = np.where(measurement.weighed, measurement.brdf, 0.0)
        factor = (variance * value**2 + np.array(noise.absolute) ** 2) / (value**2 + 4 * noise.floor**2)
        factor = np.maximum(factor / np.mean(factor[measurement.weighed]), SUREST)
    if sample_weights is None:
        return factor
    counted = sample_weights[used][rows]
    return counted * np.ones(measurement.brdf.shape[1]) if factor is None else counted * factor


def robust(weights, residuals, measurement: Measurement):
    """Cauchy's weights: a sample many times farther off than the median counts little."""
    size = np.abs(residuals[measurement.weighed])
    spread = 1.4826 * np.median(size)
    return weights / (1 + (residuals / max(ROBUST_WIDTH * spread, 1e-12)) ** 2)


@formed
def _directions_of_scans(measurement: Measurement) -> np.ndarray | None:
    """For each direction, how many with a value there are at its incidence; None where no incidence was held."""
    theta_i, has_value = measurement.geom.theta_i_deg[:, 0], measurement.has_value
    if len(theta_i) > DENSE or not has_value.any():
        return None
    order = np.argsort(theta_i, kind="stable")
    ascending, scan = theta_i[order], np.empty(len(order), int)
    ends = np.flatnonzero(np.diff(ascending) > APART_DEG)
    scan[order] = np.searchsorted(ends, np.arange(len(order)))
    counts = np.bincount(scan[has_value], minlength=len(ends) + 1)
    wandered = ascending[np.r_[ends, -1]] - ascending[np.r_[0, ends + 1]]
    if wandered.max() > HELD_DEG or np.median(counts[counts > 0]) < LEAST_SCAN:
        return None
    return np.where(counts < LEAST_SCAN, counts.max(), counts)[scan]
