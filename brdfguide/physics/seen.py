"""How different two surfaces look: the rms difference in lightness of two spheres, over lamps in all directions.

    S = 116 √( Σ w mean_c (∛(π f cos θi) - ∛(π g cos θi))² / Σ w )          over colours c = R, G, B, or one grey

π f cos θi is what a white diffuser facing the lamp would show as 1, and 116 ∛ is the slope of CIE lightness L* without
its dark end. The picture area of a sphere is cos θr dω_r, and one more cosine says how the lamps stand to the surface.
Directions beyond 80° do not count. No parameter of it was fitted to anything.

Bands and words come from what people said of 458 pictures of five models (Lavoué, Bonneel, Farrugia and Soler 2021,
"Perceptual Quality of BRDF Approximations"; about 30 votes a picture), read by us; docs/seen.md says how well it
agrees with them and where it does not. It is no promise for another light.
"""

from dataclasses import replace
from functools import lru_cache
from math import pi

import numpy as np

from ..records import dataclass
from . import colour
from .directions import Directions
from .display import colour_weights
from .geometry import Geometry

LIGHTNESS = 116.0  # of L* = 116 ∛Y - 16 (CIE 1976)
LIMIT_DEG = 80.0  # beyond this θi or θr nothing counts: tables are extrapolated there, and spheres show little of it
CELLS = 45, 12, 12  # of θh, θd and φd: within 0.6 % of the limit for lobes of alpha >= 0.01
COARSE = 16, 6, 6  # orders as well, and comes within 1.2 % in the median
TURNED = (24, 8, 8)  # cells where a surface changes as it is turned
TURNS = 12  # how often such a one is turned
ALIKE = 2.5  # L*, below which three of four pictures were called the same look and none clearly different
TIE = 1.25  # ratio of two S below which people agreed no better than by chance which of the two is closer
CLEARER = 1.5  # ratio of two S from which on nine of ten people agreed which of the two is closer
NO_MODEL = 8.0  # L*, beyond which seven of ten pictures were called clearly different
BANDS = (  # S below this [L*], what is said, share of pictures called clearly different, and the same look
    (2.5, "looks alike side by side", 0.00, 0.76),
    (3.5, "looks alike side by side", 0.01, 0.54),
    (5.0, "hardly different side by side", 0.12, 0.39),
    (8.0, "visibly different side by side", 0.55, 0.13),
    (12.0, "different", 0.71, 0.10),
    (float("inf"), "different", 0.92, 0.08),
)
ORDERS = (  # ratio of two S below this, what is said of the smaller one, share of people who agree
    (1.25, "alike to the eye", 0.58),
    (1.5, "probably closer", 0.77),
    (2.0, "closer", 0.90),
    (float("inf"), "clearly closer", 0.97),
)


@dataclass(frozen=True, eq=False)
class Sphere:
    """Directions of light and eye that stand for a sphere under lamps all around, and their weights."""

    geom: Geometry
    weights: np.ndarray  # (samples,)


@lru_cache(maxsize=8)
def sphere(cells: tuple[int, int, int] = CELLS, turns: int = 1) -> Sphere:
    """Cells even in √θh, θd and φd, with w = sin θh √θh sin θd cos θd cos θi cos θr.

    Isotropic surfaces are symmetric in φd and ask for half of it. With `turns` the sample is turned by so many even
    steps, and φd goes all round.
    """
    count_h, count_d, count_phi = cells
    a = ((np.arange(count_h) + 0.5) / count_h)[:, None, None, None]
    theta_h, theta_d = 0.5 * pi * a * a, (_middles(count_d, 0.5 * pi))[:, None, None]
    phi_d = _middles(count_phi, pi) if turns == 1 else _middles(2 * count_phi, 2 * pi)
    turn = np.degrees(_middles(turns, 2 * pi)) if turns > 1 else np.zeros(1)
    once = Directions.from_half_difference(theta_h, theta_d, phi_d[:, None])
    weights = np.sin(theta_h) * a * np.sin(theta_d) * np.cos(theta_d) * once.cos_i * once.cos_r
    kept = np.broadcast_to(counts(once), (*once.shape[:-1], turns))
    turned = once.each(lambda values: np.broadcast_to(values, kept.shape)[kept][:, None])
    azimuths = turned.phi_i_deg + np.broadcast_to(turn, kept.shape)[kept][:, None]
    return Sphere(Geometry(replace(turned, phi_i_deg=azimuths)), np.broadcast_to(weights, kept.shape)[kept])


def counts(to: Directions) -> np.ndarray:
    """Where both directions are within 80° of the normal."""
    least = np.cos(np.radians(LIMIT_DEG)) - 1e-9
    return (to.cos_i >= least) & (to.cos_r >= least)


def colours(channels, wavelength_um) -> np.ndarray:
    """(channels, colours): what each channel adds to red, green and blue, or to the one grey.

    By the channels' names where these are colours, else as a display mixes wavelengths, by the approximate matching
    functions, so that the figure is the same whatever is installed: within 0.7 % of the tables' (ours).
    """
    if len(channels) == 1:
        return np.ones((1, 1))
    named = colour.of_names(channels)
    return colour_weights(wavelength_um, len(channels), "rgb", tables=False) if named is None else named.matrix.T


def lightness(brdf, cos_i) -> np.ndarray:
    """116 ∛(π f cos θi) [L*] in the shape of `brdf` [1/sr]; what is negative shows as black."""
    return LIGHTNESS * np.cbrt(np.maximum(brdf, 0.0) * (pi * cos_i))


def apart(one, other, weights) -> float:
    """S [L*] of two lightnesses (samples, colours), grey (samples, 1) being three times the same; rows without a value
    in either do not count; NaN where none is left."""
    squares = local(one, other)
    squares *= squares
    weights = np.where(np.isfinite(squares), weights, 0.0)
    total = float(weights.sum())
    return float(np.sqrt(weights @ np.nan_to_num(squares) / total)) if total > 0 else float("nan")


def local(one, other) -> np.ndarray:
    """The difference in lightness at each direction (samples,) [L*]: rms over the colours."""
    apart = one - other
    return np.sqrt(np.einsum("sc,sc->s", apart, apart) / apart.shape[1])


def words(seen: float) -> str:
    """What people say of two spheres that differ by S."""
    return next((said for below, said, *_ in BANDS if seen < below), "cannot be told")


def band_words(seen: float) -> str:
    """The same with the end of the band: those that are called alike share one."""
    said = words(seen)
    ends = [below for below, other, *_ in BANDS if other == said]
    if not ends:
        return said
    return f"{said} (below {ends[-1]:g})" if np.isfinite(ends[-1]) else f"{said} (above {NO_MODEL:g})"


def says(seen: float) -> str:
    """The same as the rest of a sentence about one of the two."""
    said = words(seen)
    return said if said.startswith(("looks", "cannot")) else f"is {said}"


def order_words(better: float, worse: float) -> str:
    """What the ratio of two S says of the smaller one."""
    ratio = worse / better if better > 0 else float("inf")
    return next((said for below, said, _ in ORDERS if ratio < below), ORDERS[-1][1])


def alike(seen: float, least: float, between: float) -> bool:
    """Whether people could not say which of two is closer: by the ratio of their S, or because the two, `between` which
    lies that S, look alike themselves (by analogy: nobody was shown two approximations side by side)."""
    return close_enough(seen, least) or between < ALIKE


def close_enough(seen: float, best: float) -> bool:
    """Whether people would take this one as well as the best: within 1.25 of its S, or below 2.5."""
    return seen < ALIKE or seen <= TIE * best


def _middles(count: int, length: float) -> np.ndarray:
    """The middles of `count` equal parts."""
    return (np.arange(count) + 0.5) * (length / count)
