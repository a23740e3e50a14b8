"""What programs mean by roughness: each word for a width as alpha, the width of GGX's facets, and back.

    squared      alpha = roughness²: OpenPBR, Standard Surface, glTF, Disney, Blender, Unreal, Mitsuba's principled
    alpha        as it is: Mitsuba's rough plugins, this program
    rooted       alpha = √roughness: pbrt-v4 unless remaproughness is false
    glossiness   alpha = (1 - glossiness)²
    blinn        exponent e of cos^e of the half vector: alpha = √(2/(e + 2))
    phong        exponent e of cos^e of the mirror direction, four times wider in e than blinn: alpha = √(2/(4 e + 2))
    ward         Ward's alpha, and Radiance's roughness: GGX as wide at half its height, √ln 2/√(√2 - 1) times wider

An exponent's alpha is that of the Gaussian of the same curvature at its peak. A peak and a width is all that two such
lobes can share: flanks differ.

Source: Burley 2012; the pbrt-v4 documentation; Walter et al. 2007; Ward 1992.
"""

from collections.abc import Callable
from math import inf, log, sqrt

from ..records import dataclass

AS_WIDE = sqrt(log(2)) / sqrt(sqrt(2) - 1)  # GGX's alpha over Ward's, for lobes that are as wide at half their height


@dataclass(frozen=True)
class Sense:
    """What a program's number for a width means."""

    alpha: Callable[[float], float]
    most: float  # the greatest number that can be typed


def _of_exponent(exponent: float) -> float:
    return sqrt(2 / (exponent + 2))


SQUARED = Sense(lambda r: r * r, 1.0)
ALPHA = Sense(lambda r: r, 1.0)
ROOTED = Sense(sqrt, 1.0)
GLOSSY = Sense(lambda g: (1 - g) ** 2, 1.0)
BLINN = Sense(_of_exponent, inf)
PHONG = Sense(lambda e: _of_exponent(4 * e), inf)
WARD = Sense(lambda r: AS_WIDE * r, 1.0)
SENSES = {
    **dict.fromkeys(("openpbr", "standard-surface", "gltf", "disney", "blender", "arnold", "unreal"), SQUARED),
    **dict.fromkeys(("substance", "three.js", "usd", "principled"), SQUARED),
    **dict.fromkeys(("alpha", "mitsuba"), ALPHA),
    "pbrt": ROOTED,
    "glossiness": GLOSSY,
    "blinn": BLINN,
    "phong": PHONG,
    **dict.fromkeys(("ward", "radiance"), WARD),
}
USUAL = "openpbr"  # what a roughness means where nothing is said: most shaders square it


def alpha_of(number: float, sense: str = USUAL) -> float:
    """alpha of what a program calls roughness, glossiness or exponent; at most 1."""
    return min(SENSES[sense].alpha(number), 1.0)
