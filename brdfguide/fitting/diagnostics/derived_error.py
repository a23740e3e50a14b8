"""Standard error of a number that follows from several fitted ones, which err together.

    Var ln y = gᵀ C g,   g_k = d ln y/dp_k,   C_kl = ρ_kl s_k s_l

The s are the fit's standard errors, with all that widens them; the ρ are those of (JᵀJ)⁻¹, J of ln f by the parameters,
and where scans of a turned sample have gains of their own those of (JᵀJ)⁻¹Jᵀ(σ² + τ² ZZᵀ)J(JᵀJ)⁻¹, as in `scan_gains`.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ...data.measurement import Measurement
from ..fit import Fit
from ..reading import reading
from .standard_errors import whole_scans

STEP = 1e-4  # of a value, for central differences


def ln_stderr(fit: Fit, measurement: Measurement, of: Callable[[Mapping], float]) -> float:
    """Standard error of ln of(values); infinite where the data say nothing of a parameter that it depends on."""
    return ln_stderrs(fit, measurement, [of])[0]


def ln_stderrs(fit: Fit, measurement: Measurement, numbers: Sequence[Callable[[Mapping], float]]) -> list[float]:
    """The same of several numbers, with J formed once."""
    free = [(key, place) for key, error in fit.stderr.items() for place in range(np.size(error))]
    slopes = np.stack([_slope(fit, measurement, key, place) for key, place in free], axis=1)
    known = np.isfinite(slopes).all(axis=1)
    size = np.linalg.norm(slopes[known], axis=0)
    if not np.all(size > 0):
        return [float("inf")] * len(numbers)
    inverse = np.linalg.pinv((slopes[known] / size).T @ (slopes[known] / size))
    covariance = inverse + _by_gains(fit, measurement, inverse, slopes / size)
    variances = np.diag(covariance)
    if not np.all(variances > 0):  # of a matrix that cannot be inverted, by rounding
        return [float("inf")] * len(numbers)
    spread = np.sqrt(variances)
    correlation = covariance / spread / spread[:, None]
    errors = np.array([np.ravel(fit.stderr[key])[place] for key, place in free])
    found = []
    for of in numbers:
        by = np.array([_by(fit, of, key, place) for key, place in free])
        weighed = np.where(by == 0, 0.0, by * errors)
        known = bool(np.all(np.isfinite(weighed)))
        found.append(float(np.sqrt(weighed @ correlation @ weighed)) if known else float("inf"))
    return found


def _by_gains(fit: Fit, measurement: Measurement, inverse: np.ndarray, slopes: np.ndarray) -> np.ndarray:
    """(JᵀJ)⁻¹Jᵀ ZZᵀ J(JᵀJ)⁻¹ τ²/σ², of as many values as the fit had; 0 where scans have no gains of their own."""
    scan = whole_scans(measurement)
    if fit.ln_scan_gains == 0 or scan is None:
        return np.zeros_like(inverse)
    number = np.broadcast_to(scan[:, None], measurement.brdf.shape)[measurement.clear]
    usable = np.isfinite(slopes).all(axis=1)
    pulls = np.stack([np.bincount(number[usable], column[usable]) for column in slopes.T], axis=1)
    moved = pulls @ inverse
    ratio = fit.ln_scan_gains**2 / max(fit.rms_ln**2 - fit.ln_scan_gains**2, 1e-30)
    return ratio * len(fit.residuals) / len(measurement.brdf) * moved.T @ moved


def _slope(fit: Fit, measurement: Measurement, key: str, place: int) -> np.ndarray:
    """d ln f/dp over all values that the fit looked at, one row."""
    ends = []
    value = np.array(fit.values[key], float)
    step = STEP * max(abs(float(np.ravel(value)[place])), 1e-12)
    for sign in (1, -1):
        moved = value.copy()
        moved.reshape(-1)[place] += sign * step
        surface = fit.surface.with_value(key, moved if value.ndim else float(moved))
        ends.append(np.log(np.maximum(reading(surface, measurement.instrument), 1e-300)))
    slope = (ends[0] - ends[1]) / (2 * step)
    return np.where(measurement.clear, slope, np.nan)[measurement.clear]


def _by(fit: Fit, of: Callable[[Mapping], float], key: str, place: int) -> float:
    """d ln of/dp of a parameter, of what a channel has for itself that of one channel; 0 where `of` does not depend on
    it."""
    value = np.array(fit.values[key], float)
    step = STEP * max(abs(float(np.ravel(value)[place])), 1e-12)
    ends = []
    for sign in (1, -1):
        moved = value.copy()
        moved.reshape(-1)[place] += sign * step
        ends.append(of({**fit.values, key: moved if value.ndim else float(moved)}))
    above, below = ends
    return float((np.log(above) - np.log(below)) / (2 * step))
