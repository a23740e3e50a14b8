"""How much each value counts: by its standard error where there is one, and so that no dense scan outvotes the others."""

import numpy as np

from .errors import InputError, choices
from .geometry import once
from .measurement import Finding, Measurement
from .smoothness import DENSE

KINDS = ("auto", "none", "stderr", "sampling")
ALIKE = 2.0  # scans up to this many times as dense as others are alike
APART_DEG, HELD_DEG = 0.25, 1.0  # between two incidences; how far one wanders that was held
LEAST_SCAN = 5  # directions; fewer are no scan, and gain nothing by being few
MOST_VOTES = 10.0  # times that one direction counts more than another


def of_samples(measurement: Measurement, kind: str = "auto") -> np.ndarray:
    """Weights (samples, channels) with mean 1: from standard errors, times `votes`, or all alike.

    `auto` takes the standard errors where the data bring them, and lets no dense scan outvote the others.
    Raises InputError for `stderr` where there are none.
    """
    if kind not in KINDS:
        raise choices("weighting", kind, KINDS)
    weights = np.ones_like(measurement.brdf)
    if kind == "stderr" and measurement.stderr is None:
        raise InputError(f"{measurement.name}: the data bring no standard errors to weigh by")
    if kind in ("auto", "stderr") and measurement.stderr is not None:
        relative = np.where(measurement.usable, measurement.stderr / np.where(measurement.usable, measurement.brdf, 1.0), np.nan)
        floor = 0.1 * np.nanmedian(relative)  # one lucky sample must not decide
        weights = np.where(np.isfinite(relative), 1 / np.clip(relative, max(floor, 1e-12), 1e6) ** 2, 0.0)
    counted = votes(measurement, kind)
    weights = weights if counted is None else weights * counted
    return weights / np.mean(weights[measurement.usable])


def votes(measurement: Measurement, kind: str = "auto") -> np.ndarray | None:
    """How often each direction counts, (samples, 1) with mean 1, so that every incidence angle counts alike; None where all do.

    For `auto` scans up to twice as dense as others are alike; `sampling` makes up for less. No direction counts more than
    ten times another. Within a scan directions crowd where the lobe is, and that is left to them.
    """
    counts = _directions_of_scans(measurement) if kind in ("auto", "sampling") else None
    if counts is None:
        return None
    most, least = counts[measurement.seen].max(), counts[measurement.seen].min()
    if most <= (ALIKE if kind == "auto" else 1.0) * least:
        return None
    counted = np.minimum(most / np.maximum(counts, 1), MOST_VOTES)
    return (counted / counted[measurement.seen].mean())[:, None]


def stated(measurement: Measurement, kind: str = "auto") -> tuple[Finding, ...]:
    """What weighs the values, for people."""
    found = []
    if kind in ("auto", "stderr") and measurement.stderr is not None:
        found.append(Finding("weighed-by-stderr", "each value is weighed by its standard error", option="--weights none"))
    if votes(measurement, kind) is not None:
        counts = _directions_of_scans(measurement)[measurement.seen]
        text = f"the scans hold {counts.min()} to {counts.max()} directions: every incidence counts alike in fits and errors, no direction over {MOST_VOTES:g} times another"
        found.append(Finding("weighed-by-scan", text, option="--weights none"))
    return tuple(found)


def rms(residuals, votes=None) -> float:
    """Root mean square of those that are known, each direction counted as often as its votes (samples, 1) say."""
    return float(np.sqrt(np.nanmean(residuals**2 if votes is None else residuals**2 * votes)))


@once
def _directions_of_scans(measurement: Measurement) -> np.ndarray | None:
    """For each direction, how many with a value there are at its incidence; None where no incidence was held."""
    theta_i, seen = measurement.geom.theta_i_deg[:, 0], measurement.seen
    if len(theta_i) > DENSE or not seen.any():
        return None
    order = np.argsort(theta_i, kind="stable")
    ascending, scan = theta_i[order], np.empty(len(order), int)
    ends = np.flatnonzero(np.diff(ascending) > APART_DEG)
    scan[order] = np.searchsorted(ends, np.arange(len(order)))
    counts = np.bincount(scan[seen], minlength=len(ends) + 1)
    wandered = ascending[np.r_[ends, -1]] - ascending[np.r_[0, ends + 1]]
    if wandered.max() > HELD_DEG or np.median(counts[counts > 0]) < LEAST_SCAN:
        return None
    return np.where(counts < LEAST_SCAN, counts.max(), counts)[scan]
