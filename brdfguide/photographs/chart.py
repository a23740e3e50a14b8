"""Reflectance of a sample beside a ColorChecker in one photograph: all 24 patches tell lamp, camera and glare at once.

    P_c(u, v) = E(u, v) Σ_k rho_k M_kc + g_c,     E = (h²/(h² + (u - u0)² + (v - v0)²))^(3/2)

for a point lamp over the plane at (u0, v0), h away, in chart widths from its middle; M is what camera and lamp make of
linear sRGB, g the glare. The neutrals alone could not tell a falling light from a response curve: their row runs from
white to black in one direction. The sample follows by rho = (P - g) M⁻¹/E at its place.
"""

from functools import cached_property

import numpy as np

from ..numerics.least_squares import minimise
from ..records import dataclass
from . import chart_patches

PRIOR_SLANT = 1.0  # of u0/h and v0/h about 0: most lamps stand within 45 degrees of the chart's normal (ours)
PRIOR_LN_HEIGHT = (1.5, 1.0)  # a lamp 1.2 m above a chart 28 cm wide, or anywhere from 45 cm to 3.5 m (ours)
PRIOR_GLARE = 0.01  # of white
RELATIVE = 0.02  # what a patch may differ from its data set, relative
ABSOLUTE = 0.002  # and of white
BRIGHTEST = 0.97  # of the file's white, from which a channel is left out
LEAST_RHO = 0.005  # a colour outside sRGB, which a camera's JPEG cuts off
LEAST_DOUBT = 0.015  # no chart is known better (ours, after the spread of its copies)


@dataclass(frozen=True, eq=False)
class Chart:
    """Lamp, camera matrix and glare that the patches tell, with the covariance of all fifteen numbers.

    numbers: u0, v0, ln h, M row by row (9), g (3), in units of white.
    """

    numbers: np.ndarray
    covariance: np.ndarray
    chi: float  # rms of the residuals in their expected size
    residuals: np.ndarray  # (24, 3), relative to each patch; NaN where it was left out
    white: float

    @property
    def rms(self) -> float:
        """Of the residuals, relative to each patch."""
        return float(np.sqrt(np.nanmean(self.residuals**2)))

    @cached_property
    def lamp(self) -> tuple[float, float, float]:
        """u0, v0 and h [chart widths]; v downward."""
        return float(self.numbers[0]), float(self.numbers[1]), float(np.exp(self.numbers[2]))

    def reflectance(self, light, place) -> np.ndarray:
        """Linear sRGB (..., 3) of light (..., 3) seen at places (..., 2) of the chart's plane."""
        return _reflectance(self.numbers, np.asarray(light, float) / self.white, np.asarray(place, float))

    def doubt(self, light, place) -> np.ndarray:
        """Relative standard error (3,) of the reflectance of a mean light (3,) at a place (2,)."""
        light, place = np.asarray(light, float) / self.white, np.asarray(place, float)
        value = _reflectance(self.numbers, light, place)
        step = 1e-5
        slopes = np.stack(
            [(_reflectance(self.numbers + step * axis, light, place) - value) / step for axis in np.eye(15)], -1
        )
        variance = np.einsum("cp,pq,cq->c", slopes, self.covariance, slopes)
        own = ABSOLUTE / np.maximum(np.abs(value), 1e-3)  # of the sample itself
        relative = np.sqrt(variance) / np.maximum(np.abs(value), 1e-3) * max(1.0, self.chi)
        return np.maximum(np.hypot(relative, own), LEAST_DOUBT)


def irradiance(numbers, place) -> np.ndarray:
    """E at places (..., 2), 1 right below the lamp."""
    h2 = np.exp(2 * numbers[2])
    return (h2 / (h2 + (place[..., 0] - numbers[0]) ** 2 + (place[..., 1] - numbers[1]) ** 2)) ** 1.5


def _reflectance(numbers, light, place) -> np.ndarray:
    matrix, glare = numbers[3:12].reshape(3, 3), numbers[12:]
    return (light - glare) @ np.linalg.inv(matrix) / irradiance(numbers, place)[..., None]


def fit_chart(light: np.ndarray, bright: np.ndarray, data_set: str) -> Chart:
    """The chart whose patches have this light.

    Takes  light (24, 3) in any unit, `bright` (24, 3) where a channel is too near to the file's white to count.
    Nor does one count in which the patch is outside sRGB.
    """
    rho, place = chart_patches.patches_rgb(data_set), chart_patches.middles()
    bright = bright | (rho < LEAST_RHO)
    white = float(np.max(np.where(bright, 0.0, light)))
    seen = light / white
    weight = np.where(bright, 0.0, 1 / np.hypot(RELATIVE * seen, ABSOLUTE))
    scale = np.linalg.lstsq(rho, np.where(bright, 0.0, seen), rcond=None)[0]
    start = np.r_[0.0, 0.0, PRIOR_LN_HEIGHT[0], scale.ravel(), 0.0, 0.0, 0.0]

    def residuals(shared, per_channel, slopes):
        e, body = irradiance(shared, place)[:, None], rho @ shared[3:12].reshape(3, 3)
        r = np.r_[((e * body + shared[12:] - seen) * weight).ravel(), _priors(shared)][:, None]
        if not slopes:
            return r
        return r, _slopes(shared, place, rho, weight)[None], np.zeros((1, len(r), 0))

    end = minimise(residuals, start, tolerance=1e-10)
    left = end.at_minimum[0][:72, 0]
    count = int(np.count_nonzero(weight))
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = np.where(bright, np.nan, left.reshape(24, 3) / weight / seen)
    chi = float(np.sqrt(np.sum(left**2) / max(count - 12, 1)))
    return Chart(end.shared, end.normal.covariance()[0], chi, relative, white)


def _priors(numbers) -> np.ndarray:
    slant = numbers[:2] * np.exp(-numbers[2]) / PRIOR_SLANT
    return np.r_[slant, (numbers[2] - PRIOR_LN_HEIGHT[0]) / PRIOR_LN_HEIGHT[1], numbers[12:] / PRIOR_GLARE]


def _slopes(numbers, place, rho, weight) -> np.ndarray:
    """Derivatives (78, 15) of patches and priors."""
    e, body = irradiance(numbers, place), rho @ numbers[3:12].reshape(3, 3)
    away = place - numbers[:2]
    h2 = np.exp(2 * numbers[2])
    squared = h2 + np.sum(away**2, axis=1)
    by_lamp = np.stack([3 * e * away[:, 0] / squared, 3 * e * away[:, 1] / squared, 3 * e * (1 - h2 / squared)], -1)
    out = np.zeros((24, 3, 15))
    out[:, :, :3] = by_lamp[:, None, :] * body[:, :, None]
    for channel in range(3):
        for source in range(3):
            out[:, channel, 3 + 3 * source + channel] = e * rho[:, source]
        out[:, channel, 12 + channel] = 1.0
    priors = np.zeros((6, 15))
    priors[0, 0] = priors[1, 1] = np.exp(-numbers[2]) / PRIOR_SLANT
    priors[:2, 2] = -numbers[:2] * priors[0, 0]
    priors[2, 2] = 1 / PRIOR_LN_HEIGHT[1]
    priors[3:, 12:] = np.eye(3) / PRIOR_GLARE
    return np.r_[(out * weight[:, :, None]).reshape(72, 15), priors]
