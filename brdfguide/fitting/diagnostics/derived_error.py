"""Standard error of a number that follows from several fitted ones, which err together.

    Var ln y = gᵀ C g,   g_k = d ln y/dp_k,   C_kl = ρ_kl s_k s_l

The s are the fit's standard errors, with all that widens them; the ρ are those of (JᵀJ)⁻¹, J of ln f by the parameters.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from ...data.measurement import Measurement
from ..fit import Fit
from ..reading import reading

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
    spread = np.sqrt(np.diag(inverse))
    correlation = inverse / spread / spread[:, None]
    errors = np.array([np.ravel(fit.stderr[key])[place] for key, place in free])
    found = []
    for of in numbers:
        by = np.array([_by(fit, of, key, place) for key, place in free])
        weighed = np.where(by == 0, 0.0, by * errors)
        known = bool(np.all(np.isfinite(weighed)))
        found.append(float(np.sqrt(weighed @ correlation @ weighed)) if known else float("inf"))
    return found


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
