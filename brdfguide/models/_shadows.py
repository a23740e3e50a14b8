"""What shadows do to He and Torrance's lobe, and the lobe without what a scene may not need."""

from functools import lru_cache, partial
from math import pi, sqrt

import numpy as np

from ..formed import formed
from ..numerics.special import erfcx, lambert_w
from ..physics import fresnel as optics
from ..physics.geometry import Directions, Geometry
from ._series_patches import ln_series

BLOCK = 4096


def shadowing(cos, sin, slope, derivatives=False):
    """S/cos θ, finite at grazing, and K = tan θ erfc(ν). Beyond ν = 26 they are 1/cos θ and 0 to every digit.

    With `derivatives` also d ln S/d ln slope and dK/d ln slope.
    """
    steep = np.maximum(2 * slope * sin, cos / 26)
    nu = cos / steep
    gaussian = np.exp(-nu * nu)
    erfc = erfcx(nu)
    erfc *= gaussian
    visible = sqrt(pi) * (2 - erfc)
    by_slope = (
        (-gaussian * (2 * nu / visible + 1 / (nu * visible + gaussian)), gaussian / (sqrt(pi) * slope))
        if derivatives
        else ()
    )
    nu *= visible
    nu += gaussian
    nu *= steep
    visible /= nu
    erfc *= sin / cos
    return visible, erfc, *by_slope


def both_shadowings(geom, slope, derivatives=False):
    """The same of incidence and reflection, in one call: pairs in place of single arrays."""
    cos, sin = _both_ways(geom)
    more = np.ndim(slope) - np.ndim(geom.cos_i)
    if more > 0:
        cos, sin = (each.reshape(2, *(1,) * more, *each.shape[1:]) for each in (cos, sin))
    return shadowing(cos, sin, slope, derivatives)


@formed
def _both_ways(to: Directions) -> tuple[np.ndarray, np.ndarray]:
    """cos θ and sin θ of both directions, (2, ...)."""
    return np.stack((to.cos_i, to.cos_r)), np.stack((to.sin_i, to.sin_r))


def shadows_left(spread, by_slope):
    """`shadow_free`, and d ln g/d ln slope, from K at both angles and dK/d ln slope: g follows the effective
    roughness."""
    w = lambert_w(spread * spread / (8 * pi))
    return 1 / np.sqrt(1 + w), _ln_g_by_ln_slope(spread, by_slope, w)


def ln_g_by_ln_slope(spread, by_slope):
    """d ln g/d ln slope alone."""
    return _ln_g_by_ln_slope(spread, by_slope, lambert_w(spread * spread / (8 * pi)))


def _ln_g_by_ln_slope(spread, by_slope, w):
    return -spread * np.exp(-w) / (4 * pi * (1 + w) ** 2) * by_slope


def shadow_free(spread):
    """Effective over true roughness: what the shadows leave, from K at both angles. K below 1e-8 leaves all of it."""
    spread = np.asanyarray(spread)
    if spread.ndim != 1 or not spread.size:
        return 1 / np.sqrt(1 + lambert_w(spread * spread / (8 * pi)))
    left = np.ones_like(spread)
    some = np.flatnonzero(spread > 1e-8)
    left[some] = 1 / np.sqrt(1 + lambert_w(spread[some] ** 2 / (8 * pi)))
    return left


def kept_fresnel(geom, n, k):
    """F(θd), kept with the directions until the index changes: a search for sigma and slope asks for it again and
    again."""
    if np.ndim(n) or np.ndim(k):
        return optics.fresnel(geom.cos_d, n, k)
    return _fresnel_of_index(geom)(float(n), float(k))


@formed
def _fresnel_of_index(to: Directions):
    """F(θd) as a function of n and k that remembers its last answer."""
    return lru_cache(maxsize=1)(partial(optics.fresnel, to.cos_d))


@formed
def height_factor(to: Directions) -> np.ndarray:
    """(|i + r|²/v_z)², what is left of G with unit vectors."""
    return (to.v2 / to.v_z) ** 2


def in_blocks(parts, geom, *values):
    """`parts(geom, *values)`, for long arrays piece by piece, so that what it forms on the way stays in the cache."""
    if len(geom.shape) != 1 or len(geom) <= BLOCK or any(np.ndim(value) for value in (*values, geom.wavelength)):
        return parts(geom, *values)
    found = [parts(Geometry(piece, geom.wavelength), *values) for piece in pieces(geom)]
    return tuple(map(np.concatenate, zip(*found, strict=True)))


@formed
def pieces(to: Directions) -> tuple[Directions, ...]:
    """Directions of so many rows that what is formed from them stays in the processor's cache."""
    return tuple(to[start : start + BLOCK] for start in range(0, len(to), BLOCK))


def law_without(*out: str):
    """The law without some of

    fresnel    F at normal incidence instead of F(θd)
    masking    no shadows, neither on the light nor on the effective roughness
    series     Σ g^m e^-g/(m! m) e^(-y/m) = e^-x/g (1 + (x² - 4x + 2)/2g), x = y/g: ours, to second order in
               1/g; within 24/g² of the sum for x <= 9, where g >= 18
    waves      the same to first order, e^-x/g, which is Beckmann's lobe with alpha = 2 slope
    """

    def brdf(geom: Geometry, *, sigma, slope, n, k, scale) -> np.ndarray:
        shadow, rough = 1 / (geom.cos_i * geom.cos_r), 1.0
        if "masking" not in out:
            shadow_i, spread_i = shadowing(geom.cos_i, geom.sin_i, slope)
            shadow_r, spread_r = shadowing(geom.cos_r, geom.sin_r, slope)
            shadow, rough = shadow_i * shadow_r, shadow_free(spread_i + spread_r)
        f = optics.f0(n, k) if "fresnel" in out else kept_fresnel(geom, n, k)
        g = (2 * pi * sigma / geom.wavelength * geom.v_z * rough) ** 2
        y = (pi * sigma / slope / geom.wavelength) ** 2 * geom.vxy2
        if "series" in out or "waves" in out:
            x = y / g
            series = np.exp(-x) / g if "waves" in out else np.exp(-x) * (1 + (x * x - 4 * x + 2) / (2 * g)) / g
        else:
            series = np.exp(ln_series(g, y))
        return (pi / 4) * scale * (sigma / slope / geom.wavelength) ** 2 * f * shadow * height_factor(geom) * series

    return brdf
