"""From reflected light to what a display shows, and how many just noticeable differences lie between two pictures.

    V = min(exposure · L, white),   L relative to a perfect white diffuser that faces the lights
    J = |ln((V + floor) / (V' + floor))| / ln(1 + weber)                 (Weber's law; 1 is just noticeable)

Colours are compared by ΔE_ITP of ITU-R BT.2124, where 1 is just noticeable too.
"""

from functools import cached_property
from math import log

import numpy as np

from ..records import dataclass
from . import colour

# ITU-R BT.2087
RGB_709_TO_2020 = np.array([[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0114], [0.0164, 0.0880, 0.8956]])
RGB_TO_LMS = np.array([[1688, 2146, 262], [683, 2951, 462], [99, 309, 3688]]) / 4096  # ITU-R BT.2100
# with T = Ct/2: BT.2124
LMS_TO_ITP = np.array([[2048, 2048, 0], [3305, -6806.5, 3501.5], [17933, -17390, -543]]) / 4096


@dataclass(frozen=True)
class Display:
    """What stands between the light and the eye."""

    exposure: float = 1.0  # a perfect white diffuser facing the lights shows as this
    white: float = 1.5  # what is brighter is clipped
    floor: float = 0.002  # black of the display with flare, added to everything
    weber: float = 0.02  # just noticeable fraction of luminance
    bits: int = 8
    gamma: float = 2.2
    peak_cd_m2: float = 100.0  # luminance of V = 1

    def shown(self, radiance) -> np.ndarray:
        """V of relative radiance (...): exposed and clipped, never negative."""
        return np.clip(self.exposure * np.asarray(radiance), 0.0, self.white)

    def logarithm(self, radiance) -> np.ndarray:
        """ln(V + floor) in JND: differences of it are J."""
        return np.log(self.shown(radiance) + self.floor) / self.jnd

    @cached_property
    def jnd(self) -> float:
        """One just noticeable difference in ln(V + floor)."""
        return log(1 + self.weber)

    def perceived(self, radiance) -> np.ndarray:
        """Coordinates in which a just noticeable difference is 1: (..., 1) from grey, (..., 3) from RGB."""
        return self.logarithm(radiance) if np.shape(radiance)[-1] == 1 else 720 * self.itp(radiance)

    def difference(self, radiance, other) -> np.ndarray:
        """JND between two pictures (samples, 1) in grey, ΔE_ITP between two in RGB (samples, 3). Gives (samples,)."""
        return distance(self.perceived(radiance), self.perceived(other))

    def codes(self, radiance, other) -> np.ndarray:
        """Difference in code values of a display with `bits` and `gamma`; below half a code nothing can change.

        Gives (samples,).
        """
        scale = (2**self.bits - 1) / self.white ** (1 / self.gamma)
        step = np.abs(self.shown(radiance) ** (1 / self.gamma) - self.shown(other) ** (1 / self.gamma))
        return scale * step.max(axis=-1)

    def itp(self, radiance) -> np.ndarray:
        """I, T, P of linear BT.709 colours (..., 3)."""
        cd_m2 = (self.shown(radiance) + self.floor) * self.peak_cd_m2
        return _perceptual_quantizer(cd_m2 @ RGB_709_TO_2020.T @ RGB_TO_LMS.T) @ LMS_TO_ITP.T


def distance(perceived, other) -> np.ndarray:
    """Just noticeable differences between two pictures as perceived, (samples,)."""
    return np.abs(perceived - other)[..., 0] if perceived.shape[-1] == 1 else np.linalg.norm(perceived - other, axis=-1)


def _perceptual_quantizer(cd_m2):
    """Signal of an absolute luminance (SMPTE ST 2084)."""
    y = (cd_m2 / 10000) ** (2610 / 16384)
    return ((3424 / 4096 + 2413 / 128 * y) / (1 + 2392 / 128 * y)) ** (2523 / 32)


def colour_weights(wavelength_um, channels: int, kind: str, tables: bool = True) -> np.ndarray:
    """(channels, 1) to grey or (channels, 3) to linear BT.709: what each channel adds to the picture.

    Three channels, longest wavelength first, are red, green and blue. Otherwise each wavelength counts by the CIE 1931
    colour matching functions, scaled so that a white surface is white; where none is visible, by its band.
    `tables` as in `colour.of_wavelengths`.
    """
    wavelength = np.broadcast_to(np.asarray(wavelength_um, float), (channels,))
    if channels == 1:
        return np.ones((1, 1 if kind == "grey" else 3))
    if channels == 3 and np.all(np.diff(wavelength) <= 0):
        return colour.LUMINANCE[:, None] if kind == "grey" else np.eye(3)
    if np.ptp(wavelength) == 0:
        return np.full((channels, 1 if kind == "grey" else 3), 1 / channels)
    low, high = colour.SEEN_UM
    if np.any((wavelength > low) & (wavelength < high)):
        rgb = colour.of_wavelengths(wavelength, tables)[0].T
        return colour.luminance(rgb)[:, None] if kind == "grey" else rgb
    band = np.abs(np.gradient(wavelength))[:, None]
    return np.broadcast_to(band / band.sum(), (channels, 1 if kind == "grey" else 3))
