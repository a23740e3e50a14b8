"""From a surface's channels to linear sRGB: a matrix, and a sentence that says how it was formed.

Named colours are taken as they are. Wavelengths are weighted by the CIE 1931 2° colour matching functions and a
white light and scaled so that a perfect white reflector is (1, 1, 1); the table of the `colour-science` library where
it is installed, otherwise the published approximation below, of which the sentence then speaks.

Sources: CIE 1931 as carried by colour-science; Wyman, Sloan, Shirley 2013, "Simple analytic approximations to the CIE
XYZ color matching functions", JCGT 2(2), multi-lobe fit (Eq. 4); IEC 61966-2-1 for sRGB primaries.
"""

from dataclasses import dataclass

import numpy as np

from ..errors import NoAnswer

# XYZ of white (1, 1, 1) in sRGB is D65's: rows R, G, B (IEC 61966-2-1)
XYZ_TO_SRGB = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])
SRGB = {"r": 0, "red": 0, "g": 1, "green": 1, "b": 2, "blue": 2}
TRISTIMULUS = {"x": 0, "y": 1, "z": 2}
VISIBLE = (0.45, 0.62)  # what the channels must span [µm] for a colour: ours
# Wyman et al. 2013: amplitude, centre [nm], 1/width below and above it
LOBES = (
    ((0.362, 442.0, 0.0624, 0.0374), (1.056, 599.8, 0.0264, 0.0323), (-0.065, 501.1, 0.0490, 0.0382)),
    ((0.821, 568.8, 0.0213, 0.0247), (0.286, 530.9, 0.0613, 0.0322)),
    ((1.217, 437.0, 0.0845, 0.0278), (0.681, 459.0, 0.0385, 0.0725)),
)


@dataclass(frozen=True, eq=False)
class Colour:
    """rgb = matrix @ channel values; linear, so it serves BRDFs and every parameter a BRDF is linear in."""

    matrix: np.ndarray  # (3, channels)
    how: str
    named: bool = True  # colours or one channel; False: wavelengths

    @property
    def mixes(self) -> bool:
        """Whether a colour is made of several channels, so that only linear parameters can be converted."""
        return self.matrix.shape[1] > 1 and bool(np.any(np.count_nonzero(self.matrix, axis=1) > 1))


def to_srgb(channels, wavelength) -> Colour:
    """The Colour of some channels at `wavelength` [µm]. Raises NoAnswer where they carry none."""
    names = [name.strip().lower() for name in channels]
    if len(names) == 1:
        return Colour(np.ones((3, 1)), f"one channel ({channels[0]}), written as grey")
    if sorted(SRGB.get(name, -1) for name in names) == [0, 1, 2]:
        matrix = np.zeros((3, 3))
        matrix[[SRGB[name] for name in names], range(3)] = 1.0
        return Colour(matrix, "channels red, green and blue, taken as linear sRGB")
    if sorted(TRISTIMULUS.get(name, -1) for name in names) == [0, 1, 2]:
        return Colour(_white(XYZ_TO_SRGB[:, [TRISTIMULUS[name] for name in names]]), "channels X, Y and Z through the sRGB matrix")
    nm = 1e3 * np.broadcast_to(np.asarray(wavelength, float), (len(names),))
    if len(set(nm.tolist())) < 3 or nm.min() > 1e3 * VISIBLE[0] or nm.max() < 1e3 * VISIBLE[1]:
        raise NoAnswer(f"channels {', '.join(channels)} carry no colour: they do not span 450..620 nm in three steps; name one with --channel")
    matching, how = _matching()
    grid = np.arange(380.0, 781.0, 1.0)
    xyz = matching(grid)  # (3, grid), already times the light
    order = np.argsort(nm)
    weights = np.zeros((3, len(nm)))
    for place, channel in enumerate(order):
        unit = np.zeros(len(nm))
        unit[place] = 1.0
        weights[:, channel] = xyz @ np.interp(grid, nm[order], unit)
    return Colour(_white(XYZ_TO_SRGB @ weights), f"{len(nm)} wavelengths to linear sRGB, {how}", named=False)


def _white(matrix):
    """Rows scaled so that a flat spectrum of 1 is (1, 1, 1): adaptation of the light's white to sRGB's."""
    return matrix / matrix.sum(axis=1, keepdims=True)


def _matching():
    """Colour matching functions times the light, as a function of nm, and what they are."""
    try:
        import colour
    except ImportError:
        how = "CIE 1931 2° by the approximation of Wyman, Sloan and Shirley 2013 under equal-energy light: "
        how += "up to 0.045 off the CIE tables under D65, which pip install 'brdfguide[colour]' adds"
        return lambda nm: np.array([sum(_lobe(nm, *lobe) for lobe in lobes) for lobes in LOBES]), how
    table = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    light = colour.SDS_ILLUMINANTS["D65"]

    def matching(nm):
        power = np.interp(nm, light.wavelengths, light.values)
        return np.array([np.interp(nm, table.wavelengths, table.values[:, column]) * power for column in range(3)])

    return matching, f"CIE 1931 2° under D65, tables of colour-science {colour.__version__}"


def _lobe(nm, amplitude, centre, below, above):
    t = (nm - centre) * np.where(nm < centre, below, above)
    return amplitude * np.exp(-0.5 * t * t)
