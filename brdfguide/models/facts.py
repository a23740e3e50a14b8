"""What a law states about itself besides its values, so that nobody else keeps a list of laws: where it is tried, what
its parameters begin with, how shaders write it.
"""

from collections.abc import Callable, Mapping
from dataclasses import field
from math import pi

from ..records import dataclass

MIRROR_DEG = (0.0, 15.0, 30.0, 45.0, 60.0, 75.0)  # where the growth of a described lobe is given


@dataclass(frozen=True)
class Candidacy:
    """Where the default ranking tries a law. A law without one is tried only where it is named."""

    order: int  # cheapest first; it has no say in a ranking by error
    lobes: int = 1  # a lobe: up to how many of it are added up
    # a lobe: tried without a body on an unknown kind too, as Fresnel's factor is its amplitude; a body: without a lobe
    bare: bool = False
    substitutes: bool = False  # a lobe with an amplitude: tried for a dearer one where a scene may not tell them apart
    under: tuple[str, ...] | None = None  # a body: the lobes that are tried on it; None: every one
    # tried only where the data are a power law of |β - β0|, alone, on a body and beside a mirror beam that was seen
    polished: bool = False
    grained: bool = False  # tried only where the sample was turned, or its lobe is seen not to be round
    # it is not tried from the start, but where the best so far leaves something: "beside" its terms, or "coated" in
    # place of its lobes
    grown: str = ""
    # laws that it contains -> where to begin in place of one; it is tried so where the best so far has one
    contains: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    adds: str = ""  # what it adds where it comes in so, in words


@dataclass(frozen=True)
class Grain:
    """How two parameters beside `axis` say how wide a lobe is across and along a grain, so that a fit can walk from one
    axis to any other through a round lobe."""

    first: str  # parameter
    second: str
    widths: Callable[..., tuple]  # of (first, second): facet slopes along `axis` and across it
    values: Callable[..., tuple]  # of both widths: (first, second)
    by_ln_widths: Callable[..., tuple]  # of (first, second): d first and d second, each by ln of both widths


@dataclass(frozen=True)
class Setting:
    """A way to set a law that is a candidate of its own, such as a shader as a metal."""

    fixed: Mapping[str, float]
    free: tuple[str, ...] = ()  # parameters that are fitted then though the law keeps them fixed by itself
    start: Mapping[str, float] = field(default_factory=dict)


# |i_xy - r_xy|² in a Formula, for lobes about the light. The difference costs float32 its digits there; who has the
# directions at hand puts it in their place.
TOWARD_LIGHT = "most(q - 4.0 * p, 0.0)"


@dataclass(frozen=True)
class Formula:
    """The law once more, as text that GLSL, OSL, C and Radiance's .cal all take: functions of numbers, without loops or
    variables. Written for float32.

    ci, cr  cosines to light and view      q  |i_xy + r_xy|²      p  i_xy · r_xy      {alpha}  the number of a parameter

    It may call what stands in exporters/_formulas.py and `functions` of its own, (name, arguments, expression), whose
    names are taken together with their expressions by every law that has them.
    """

    brdf: str
    functions: tuple[tuple[str, str, str], ...] = ()
    mirror: str = ""  # reflectance of its mirror part, in ci
    # numbers(wavelength=um, **values) -> further {names}
    numbers: Callable[..., Mapping] | None = None


def polynomial(degree: int) -> tuple[str, str, str]:
    """A polynomial in x as a function of a Formula, called with `coefficients`."""
    names = [f"c{i}" for i in range(degree + 1)]
    text = names[-1]
    for name in names[-2::-1]:
        text = f"{name} + x * ({text})"
    return f"polynomial{degree}", ", ".join(["x", *names]), text


def coefficients(degree: int) -> str:
    """{c0}, {c1}... as its arguments; the law's `numbers` give them."""
    return ", ".join(f"{{c{i}}}" for i in range(degree + 1))


@dataclass(frozen=True)
class Facets:
    """A described surface in terms of the facets that would make its lobe: what the start values of every law follow
    from. By channel where it is a tuple."""

    alpha: float  # √2 times the rms slope along a line
    f0: tuple[float, ...] = (0.04,)  # share of the light that the lobe sends back at normal incidence
    growth: tuple[float, ...] = (1.0,) * len(MIRROR_DEG)  # mirror values at MIRROR_DEG over that at the normal
    n: tuple[float, ...] = (1.5,)
    k: tuple[float, ...] = (0.0,)
    sigma: float = 0.0  # rms height [um]
    slope: float = 0.075  # sigma over correlation length
    albedo: tuple[float, ...] | None = (0.18,)  # of the body; None: the surface has none
    spread: float = 0.34  # standard deviation of the tilt of a rough body's facets [rad]

    @property
    def peak(self) -> tuple[float, ...]:
        """Height of the lobe near the normal [1/sr], F0/(4π alpha²)."""
        return tuple(each / (4 * pi * self.alpha**2) for each in self.f0)

    @property
    def half_exponent(self) -> float:
        """n of a lobe about the half vector as wide as the facets', 2/alpha² - 2."""
        return max(2 / self.alpha**2 - 2, 0.4)

    @property
    def mirror_exponent(self) -> float:
        """n of a lobe about the mirror direction, a quarter of the other."""
        return max(self.half_exponent / 4, 0.3)
