"""Colours: at which wavelengths red, green and blue lie, how wavelengths become linear sRGB, how that is shown.

"Where is red" has two answers, because there are two reds.

A channel that a file calls R was seen by some instrument, which the file does not name: `CHANNEL_UM`, the dominant
wavelengths of sRGB's primaries (611, 549 and 464 nm under D65, from the chromaticities of IEC 61966-2-1), lies within
20 nm of where cameras look.

The red coefficient of a colour in linear sRGB is another thing: the primaries' matching functions are partly negative,
which moves where a straight spectrum takes its coefficients outward, to 642, 543 and 441 nm under D65. `SRGB_UM` rounds
that to where the index tables of `substances` were read. The normal reflectance of nine substances there is red and
blue as over the whole spectrum to 0.003 in the median and 0.08 at worst, and at `CHANNEL_UM` to 0.011 and 0.11 (ours).
It is the one for a surface described in linear sRGB.

Sources: IEC 61966-2-1 (sRGB); ITU-R BT.709; CIE 1931 as carried by colour-science; Wyman, Sloan, Shirley 2013, "Simple
analytic approximations to the CIE XYZ color matching functions", JCGT 2(2), multi-lobe fit (Eq. 4).
"""

import numpy as np

from ..errors import NoAnswer
from ..records import dataclass
from .substance_table import READ_AT_UM

# [µm], of a measured channel with this name; X, Y, Z: the peaks of the CIE 1931 colour matching functions
CHANNEL_UM = {"R": 0.610, "G": 0.550, "B": 0.465, "X": 0.600, "Y": 0.555, "Z": 0.446}
SRGB_UM = READ_AT_UM  # [µm], of the coefficients of linear sRGB
SEEN_UM = (0.38, 0.78)  # what the eye sees at all
VISIBLE_UM = (0.45, 0.62)  # what channels must span for a colour: ours
SRGB = {"r": 0, "red": 0, "g": 1, "green": 1, "b": 2, "blue": 2}
TRISTIMULUS = {"x": 0, "y": 1, "z": 2}
XYZ_TO_SRGB = np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]])  # IEC
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])  # of linear sRGB (ITU-R BT.709)
APPROXIMATE = "CIE 1931 2° by the approximation of Wyman, Sloan and Shirley 2013 under equal-energy light"
# Wyman et al. 2013: amplitude, centre [nm], 1/width below and above it [1/nm]
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
    """The Colour of some channels at `wavelength` [µm]. Raises NoAnswer where they carry none.

    Named colours are taken as they are. Wavelengths are weighted by the CIE 1931 2° colour matching functions and a
    white light, and scaled so that a perfect white reflector is (1, 1, 1).
    """
    if (known := of_names(channels)) is not None:
        return known
    um = np.broadcast_to(np.asarray(wavelength, float), (len(channels),))
    if not spans_the_visible(um):
        raise NoAnswer(
            f"channels {', '.join(channels)} carry no colour: they do not span 450..620 nm in three steps; name one "
            f"with --channel"
        )
    matrix, how = of_wavelengths(um)
    return Colour(matrix, f"{len(um)} wavelengths to linear sRGB, {how}", named=False)


def of_names(channels) -> Colour | None:
    """The Colour of one channel, and of three that are called red, green and blue or X, Y and Z; None for others."""
    names = [name.strip().lower() for name in channels]
    if len(names) == 1:
        return Colour(np.ones((3, 1)), f"one channel ({channels[0]}), written as grey")
    if sorted(SRGB.get(name, -1) for name in names) == [0, 1, 2]:
        matrix = np.zeros((3, 3))
        matrix[[SRGB[name] for name in names], range(3)] = 1.0
        return Colour(matrix, "channels red, green and blue, taken as linear sRGB")
    if sorted(TRISTIMULUS.get(name, -1) for name in names) == [0, 1, 2]:
        columns = [TRISTIMULUS[name] for name in names]
        return Colour(_white(XYZ_TO_SRGB[:, columns]), "channels X, Y and Z through the sRGB matrix")
    return None


def spans_the_visible(um) -> bool:
    """Whether wavelengths [µm] are enough, and far enough apart, for a colour."""
    nm = 1e3 * np.asarray(um)
    return len(set(nm.tolist())) >= 3 and nm.min() <= 1e3 * VISIBLE_UM[0] and nm.max() >= 1e3 * VISIBLE_UM[1]


def in_the_visible(um) -> bool:
    """Whether an eye sees light of any of the wavelengths [µm]."""
    um = np.asarray(um, float)
    return bool(np.any((um >= SEEN_UM[0]) & (um <= SEEN_UM[1])))


def of_wavelengths(um, tables: bool = True) -> tuple[np.ndarray, str]:
    """(3, channels) from values at wavelengths [µm], straight lines between them, to linear sRGB; and how.

    Without `tables` by the published approximation everywhere, which loads nothing.
    """
    nm = 1e3 * np.asarray(um, float)
    grid = np.arange(1e3 * SEEN_UM[0], 1e3 * SEEN_UM[1] + 1.0, 1.0)
    xyz, how = _matching(grid) if tables else (approximate_matching_functions(grid), APPROXIMATE)
    order = np.argsort(nm)
    weights = np.zeros((3, len(nm)))
    for place, channel in enumerate(order):
        unit = np.zeros(len(nm))
        unit[place] = 1.0
        weights[:, channel] = xyz @ np.interp(grid, nm[order], unit)
    return _white(XYZ_TO_SRGB @ weights), how


def luminance(rgb) -> np.ndarray:
    """Of linear sRGB (..., 3)."""
    return rgb @ LUMINANCE


def hex_of(rgb) -> str:
    """sRGB hex of a linear colour, 0..1; of one number, grey."""
    within = np.clip(np.broadcast_to(rgb, (3,)), 0.0, 1.0)
    eight = np.round(255 * np.clip(encoded(within), 0.0, 1.0)).astype(int)
    return "#" + "".join(f"{each:02x}" for each in eight)


def encoded(linear) -> np.ndarray:
    """sRGB's display values 0..1 of linear ones, none of them negative (IEC 61966-2-1)."""
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055)


def _white(matrix):
    """Rows scaled so that a flat spectrum of 1 is (1, 1, 1): adaptation of the light's white to sRGB's."""
    return matrix / matrix.sum(axis=1, keepdims=True)


def _matching(nm) -> tuple[np.ndarray, str]:
    """Colour matching functions times the light (3, wavelengths), and what they are: the tables where colour-science is
    installed, else the published approximation."""
    try:
        import colour
    except ImportError:
        how = f"{APPROXIMATE}: up to 0.045 off the CIE tables under D65, which pip install 'brdfguide[colour]' adds"
        return approximate_matching_functions(nm), how
    table = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
    light = colour.SDS_ILLUMINANTS["D65"]
    power = np.interp(nm, light.wavelengths, light.values)
    functions = np.array([np.interp(nm, table.wavelengths, table.values[:, column]) for column in range(3)])
    return functions * power, f"CIE 1931 2° under D65, tables of colour-science {colour.__version__}"


def approximate_matching_functions(nm) -> np.ndarray:
    """CIE 1931 x̄, ȳ, z̄ (3, wavelengths) by the multi-lobe fit of Wyman, Sloan and Shirley 2013."""
    nm = np.asarray(nm, float)
    return np.array([sum(_lobe(nm, *lobe) for lobe in lobes) for lobes in LOBES])


def _lobe(nm, amplitude, centre, below, above):
    t = (nm - centre) * np.where(nm < centre, below, above)
    return amplitude * np.exp(-0.5 * t * t)
