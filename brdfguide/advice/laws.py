"""What a law says that each instrument would read: the other half of an inference.

A family is a law with the numbers that it leaves open, on axes that are even in the logarithm. `predicted` takes cells,
arrays of these numbers, and gives the reading as an `Observation` counts it; None where the law has no say.
"""

from collections.abc import Callable, Mapping
from functools import lru_cache
from math import log, pi, radians, sin, sqrt

import numpy as np

from ..numerics.special import erfcx, lambert_w
from ..physics import emergence, gloss
from ..records import dataclass
from .evidence import Evidence, Observation
from .wave_gloss import SIGMA_UM, WAVELENGTH_UM, mirror_share, wave_share

MOST_G = 30.0  # of a sum over waves; beyond, facets
HAZE_DEG = 2.5  # light further than this from the mirror direction is haze (ASTM D1003's angle, for reflection)
Cells = Mapping[str, np.ndarray]


@dataclass(frozen=True)
class SeenBy:
    """What a prediction depends on besides the surface: the light, the eye, and a height that a stylus gave."""

    wavelength: float  # µm
    solid_angle: float  # sr
    ln_sigma: float | None = None  # of µm
    sigma_doubt: float = 0.0

    @classmethod
    def of(cls, evidence: Evidence) -> "SeenBy":
        stylus = next((each for each in evidence.observations if each.quantity == "sigma"), None)
        given = (stylus.value, stylus.doubt) if stylus else ()
        return cls(evidence.wavelength, evidence.solid_angle, *given)


@dataclass(frozen=True)
class Axis:
    """An open number of a law: its range, and what is usual before anything is observed (None: all the same)."""

    name: str
    low: float
    high: float
    usual: float | None = None
    factor: float = 3.0  # one standard deviation of what is usual, as a factor


@dataclass(frozen=True)
class Family:
    """A law, what it leaves open, and what it says of a reading that depends on the surface's shape alone."""

    name: str
    axes: tuple[Axis, ...]
    share: Callable[[int, Cells], np.ndarray]  # of a smooth surface's light that reaches a glossmeter's receptor
    predicted: Callable[[Observation, SeenBy, Cells], np.ndarray | None]


# sigma/tau: 0.1 where nothing is known, most surfaces in 0.01 to 1 (Westin et al. 2004, section 5.2)
USUAL_SLOPE = 0.1
BARE_SIGMA_UM = 0.6  # g = 190 at 550 nm, where only the slope shows


# --- facets ------------------------------------------------------------------------------------------


def _facets(name: str, half: float, outside: Callable[[np.ndarray], np.ndarray]) -> Family:
    """A facet law; its lobe falls to half where the facets' tan is `half` alpha."""

    def share(angle: int, cells: Cells) -> np.ndarray:
        return gloss.quick_share(angle, np.clip(cells["alpha"], gloss.LOW, gloss.HIGH), name)

    def predicted(asked: Observation, sight: SeenBy, cells: Cells) -> np.ndarray | None:
        alpha = cells["alpha"]
        if asked.quantity == "width":
            return np.log(4 * np.arctan(half * alpha))
        if asked.quantity == "haze":
            return outside((np.tan(radians(HAZE_DEG) / 2) / alpha) ** 2)
        if asked.quantity == "sharpness":
            return np.log(share(60, cells))
        if asked.quantity == "emergence" and asked.side == "at least":
            return np.full_like(alpha, 90.0)
        if asked.quantity == "sigma":
            return np.full_like(alpha, asked.value)  # any height will do
        if asked.quantity == "tau":
            return np.full_like(alpha, asked.value) if sight.ln_sigma is None else sight.ln_sigma - np.log(alpha / 2)
        return None

    return Family(name, (Axis("alpha", gloss.LOW, gloss.HIGH, 2 * USUAL_SLOPE),), share, predicted)


BECKMANN = _facets("beckmann", sqrt(log(2)), lambda x: np.exp(-x))
GGX = _facets("ggx", sqrt(sqrt(2) - 1), lambda x: 1 / (1 + x))


# --- He and Torrance ---------------------------------------------------------------------------------


def _wave_predicted(asked: Observation, sight: SeenBy, cells: Cells) -> np.ndarray | None:
    sigma, slope = cells["sigma"], cells["slope"]
    if asked.quantity == "width":
        return np.log(_wave_width(sigma, slope))
    if asked.quantity == "haze":
        return _wave_haze(sigma, slope)
    if asked.quantity == "sharpness":
        return np.log(_wave_share(60, cells))
    if asked.quantity == "emergence":
        return emergence_angles(sigma, slope, sight.wavelength, sight.solid_angle)
    if asked.quantity == "dimming":
        return mirror_share(asked.angle, sigma, slope, asked.wavelength)
    if asked.quantity in ("sigma", "tau"):
        return np.log(sigma if asked.quantity == "sigma" else sigma / slope)
    return None


def _wave_share(angle: int, cells: Cells) -> np.ndarray:
    return wave_share(angle, cells["sigma"], cells["slope"])


def _wave_width(sigma, slope):
    """Full width at half height of the lobe near the normal [rad], from Σ g^m e^-g/(m! m) e^-y/m."""
    g = (4 * pi * sigma / WAVELENGTH_UM) ** 2
    y = np.exp(np.interp(np.log(g), *_half_heights()))
    return 4 * np.arctan(np.sqrt(y) * WAVELENGTH_UM * slope / (2 * pi * sigma))


@lru_cache(maxsize=1)
def _half_heights() -> tuple[np.ndarray, np.ndarray]:
    """ln g and the ln y at which that sum has fallen to half: y = ln 2 for small g, g ln 2 for large."""
    g = np.geomspace(1e-3, 100.0, 60)
    low, high = np.full_like(g, 0.1), 2 * g + 1
    half = _wave_sum(g, np.zeros_like(g), 1) / 2
    for _ in range(40):
        middle = (low + high) / 2
        above = _wave_sum(g, middle, 1) > half
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    far = np.array([1e4, 1e8])
    return np.log(np.append(g, far)), np.log(np.append(low, far * log(2)))


def _wave_sum(g, y, power: int):
    """Σ g^m e^-g/(m! m^power) e^-y/m from m = 1, for g up to some hundred."""
    term, total = np.exp(-g), np.zeros_like(g)
    for m in range(1, int(g.max() + 10 * sqrt(g.max()) + 20)):
        term = term * g / m
        total += term * np.exp(-y / m) / m**power
    return total


def _wave_haze(sigma, slope):
    """Share of the reflected light further than HAZE_DEG from the mirror: Σ g^m e^-g/m! e^-y/m, m >= 1."""
    g = (4 * pi * sigma / WAVELENGTH_UM) ** 2
    y = (pi * sigma / slope / WAVELENGTH_UM * sin(radians(HAZE_DEG))) ** 2
    return np.where(g < MOST_G, _wave_sum(np.minimum(g, MOST_G), y, 0), np.exp(-y / g))


def emergence_angles(sigma, slope, wavelength: float = emergence.WAVELENGTH, solid_angle: float = emergence.OMEGA):
    """The angle [°] from which a mirror image stands out, of many surfaces; 90 where it does at none.

    As `emergence.emergence_angle`, to 0.01°.    Takes  sigma [µm], sigma/tau, which broadcast.
    """
    sigma, slope = np.broadcast_arrays(np.asarray(sigma, float), np.asarray(slope, float))
    ln_tau2 = 2 * np.log(sigma / slope)

    def excess(theta):
        cos, sin_ = np.cos(theta), np.maximum(np.sin(theta), 1e-12)
        nu = np.minimum(cos / (2 * slope * sin_), 26.0)
        spread = 2 * sin_ / cos * erfcx(nu) * np.exp(-nu * nu)
        g = (4 * pi * sigma * cos / wavelength) ** 2 / (1 + lambert_w(spread * spread / (8 * pi)))
        return _ln_ein(g) + ln_tau2 - np.log(wavelength**2 / (pi * cos * solid_angle))

    low, high = np.zeros_like(sigma), np.full_like(sigma, radians(89.9))
    at_normal, at_grazing = excess(low) <= 0, excess(high) > 0
    for _ in range(13):
        middle = (low + high) / 2
        hidden = excess(middle) > 0
        low, high = np.where(hidden, middle, low), np.where(hidden, high, middle)
    below, above = excess(low), excess(high)
    share = np.where(below > above, below / np.where(below > above, below - above, 1.0), 0.5)
    angle = np.degrees(low + np.clip(share, 0.0, 1.0) * (high - low))
    return np.where(at_normal, 0.0, np.where(at_grazing, 90.0, angle))


def _ln_ein(g):
    """ln Ein(g) from a table of what is left of it beside ln g: right to 1e-3."""
    at, left = _ein_table()
    far = g > at[-1]
    return np.log(g) + np.where(far, g - 2 * np.log(np.maximum(g, 1.0)), np.interp(g, at, left))


@lru_cache(maxsize=1)
def _ein_table() -> tuple[np.ndarray, np.ndarray]:
    at = np.concatenate([[0.0], np.geomspace(1e-3, 400.0, 400)])
    return at, np.array([0.0, *(emergence.ln_ein(float(g))[0] - log(g) for g in at[1:])])


WAVES = Family(
    "he-torrance",
    (Axis("sigma", *SIGMA_UM), Axis("slope", 1e-3, 1.0, USUAL_SLOPE)),
    _wave_share,
    _wave_predicted,
)
FAMILIES = (BECKMANN, GGX, WAVES)
