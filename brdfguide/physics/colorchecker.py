"""Lambertian albedo by comparison: with the neutral patches of a ColorChecker, or with a known reference.

The report speaks of five neutral patches from 3.2 % to 89 %; the chart has six (both ends of that range are ends of
the chart). All six are here, in two published data sets that differ by up to 3 % of reflectance.
"""

from ..errors import InputError, choices

# Luminance factor Y under D65, white to black, from the spectra in colour-science 0.4 (BSD-3-Clause), which names its
# sources.
PATCHES = ("white", "neutral 8", "neutral 6.5", "neutral 5", "neutral 3.5", "black")
DATA_SETS = {
    "average": (0.9124, 0.5886, 0.3596, 0.1913, 0.0895, 0.0320),  # averages of charts made since November 2014
    "iso17321": (0.8872, 0.5839, 0.3582, 0.2031, 0.0926, 0.0335),  # ISO 17321-1, Ohta's measurements
}
NOT_LINEAR = (
    "brightness is not linear: 18 % looks half as light as white (L* = 49.5), 30 % already L* = 61.7, 75 % L* = 89.4"
)


def patch(name: str, data_set: str = "average") -> float:
    """Reflectance of one neutral patch. Raises InputError for an unknown patch or data set."""
    if data_set not in DATA_SETS:
        raise choices("ColorChecker data set", data_set, DATA_SETS)
    if name not in PATCHES:
        raise choices("neutral patch", name, PATCHES)
    return DATA_SETS[data_set][PATCHES.index(name)]


def between(first: str, second: str, position: float, data_set: str = "average") -> float:
    """Reflectance of a surface that looks `position` of the way from one patch (0) to another (1).

    The eye judges lightness, so the position is taken along L*, not along reflectance.
    """
    if not 0 <= position <= 1:
        raise InputError(f"position = {position:g}: between two patches is from 0, the first, to 1, the second")
    start, end = cie_lightness(patch(first, data_set)), cie_lightness(patch(second, data_set))
    return luminance_factor(start + position * (end - start))


def from_ratio(ratio: float, reference: float) -> float:
    """Reflectance by photometer: signal over that of a reference of known reflectance, same light and angle."""
    albedo = ratio * reference
    if not 0 <= albedo <= 1:
        raise InputError(
            f"{ratio:g} times a reference of {reference:g} is a reflectance of {albedo:g}; a diffuse surface has "
            f"at most 1"
        )
    return albedo


def cie_lightness(y: float) -> float:
    """CIE 1976 L*, 0..100, of a luminance factor 0..1 (CIE 15:2004)."""
    return 116 * y ** (1 / 3) - 16 if y > 216 / 24389 else y * 24389 / 27


def luminance_factor(l_star: float) -> float:
    """The luminance factor that has this lightness: the inverse of `cie_lightness`."""
    return ((l_star + 16) / 116) ** 3 if l_star > 8 else l_star * 27 / 24389
