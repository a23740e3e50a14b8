"""GGX and Gaussian facets with a grain: two widths, and the azimuth of the wider slopes' axis.

    t = |s|², s = (v_x, v_y)/v_z,   e = (s_x/αx)² + (s_y/αy)²,   p_w = √(αx² w_x² + αy² w_y²),   R_w = √(p_w² + w_z²)
    GGX        D G/(4 cos θi cos θr) = (1 + t)²/((1 + e)² 2π αx αy (cos θr R_i + cos θi R_r))
    Beckmann   D = (1 + t)² exp(-e)/(π αx αy),   Λ as without a grain at alpha tan θ = p_w/w_z

Source: Trowbridge and Reitz 1975; Beckmann and Spizzichino 1963; Burley 2012 for two widths; Heitz 2014 for masking.
"""

from math import pi, sqrt

import numpy as np

from .geometry import Geometry
from .microfacet import hidden_by_slope


def grained_density(geom: Geometry, alpha_x, alpha_y, axis) -> np.ndarray:
    """D, facets per solid angle [1/sr]; its projection integrates to 1."""
    one_and_e = 1 + _tilt_about(geom, alpha_x, alpha_y, axis)
    return (geom.sec2_h / one_and_e) ** 2 / (pi * alpha_x * alpha_y)


def grained_shape(geom: Geometry, alpha_x, alpha_y, axis) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr] with correlated heights: a lobe without Fresnel."""
    one_and_e = 1 + _tilt_about(geom, alpha_x, alpha_y, axis)
    r_i, r_r = _roots_alone(geom, alpha_x, alpha_y, axis)
    facets = (geom.sec2_h / one_and_e) ** 2 / (2 * pi * alpha_x * alpha_y)
    return facets / (geom.cos_r * r_i + geom.cos_i * r_r)


def grained_shape_uncorrelated(geom: Geometry, alpha_x, alpha_y, axis) -> np.ndarray:
    """The same with heights that are not correlated, D/((cos θi + R_i)(cos θr + R_r))."""
    r_i, r_r = _roots_alone(geom, alpha_x, alpha_y, axis)
    return grained_density(geom, alpha_x, alpha_y, axis) / ((geom.cos_i + r_i) * (geom.cos_r + r_r))


def grained_gaussian(geom: Geometry, alpha_x, alpha_y, axis) -> np.ndarray:
    """D of Gaussian slopes [1/sr]; its projection integrates to 1."""
    e = tilt(geom, geom.offset_from(axis), alpha_x, alpha_y)
    return geom.sec2_h**2 * np.exp(-e) / (pi * alpha_x * alpha_y)


def grained_gaussian_shape(geom: Geometry, alpha_x, alpha_y, axis) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr] of Gaussian slopes with correlated heights."""
    return grained_gaussian(geom, alpha_x, alpha_y, axis) / _gaussian_masking(geom, alpha_x, alpha_y, axis)[0]


def ln_gaussian_masking_slopes(geom: Geometry, alpha_x, alpha_y, axis) -> dict[str, np.ndarray]:
    """d ln (1 + Λi + Λr) by αx, αy and the axis: cos θ dΛ = exp(-(w_z/p_w)²)/(2√π) dp_w, αx dp/dαx = αx² w_x²/p,
    dp/daxis = (αx² - αy²) w_x w_y/p."""
    masking, both = _gaussian_masking(geom, alpha_x, alpha_y, axis)
    by_x, by_y, by_axis = 0.0, 0.0, 0.0
    excess = (alpha_x - alpha_y) * (alpha_x + alpha_y)
    for (p, x, y, gaussian), other in zip(both, (geom.cos_r, geom.cos_i), strict=True):
        before = (2 / sqrt(pi)) * other * gaussian / np.where(p > 0, p, 1.0)
        by_x = by_x + before * alpha_x * x * x
        by_y = by_y + before * alpha_y * y * y
        by_axis = by_axis + before * excess * x * y
    return {"alpha_x": by_x / masking, "alpha_y": by_y / masking, "axis": by_axis / masking}


def _gaussian_masking(geom: Geometry, alpha_x, alpha_y, axis):
    """4 cos θi cos θr (1 + Λi + Λr), and (p, w_x, w_y, exp(-(w_z/p)²)) of light and view."""
    found, masking = [], 4 * geom.cos_cos
    directions = (geom.cos_i, geom.cos_r)
    for (square, x, y), own, other in zip(
        _steepness(geom, alpha_x, alpha_y, axis), directions, directions[::-1], strict=True
    ):
        p = np.sqrt(square)
        hidden, gaussian = hidden_by_slope(p / own)
        masking = masking + 2 * hidden * p * other
        found.append((p, x, y, gaussian))
    return masking, found


def _is_round(alpha_x, alpha_y, axis) -> bool:
    """Whether there is no grain, so that no azimuth is needed; the same to every digit."""
    return np.ndim(axis) == 0 and np.array_equal(alpha_x, alpha_y)


def _tilt_about(geom: Geometry, alpha_x, alpha_y, axis):
    """e about an axis."""
    if _is_round(alpha_x, alpha_y, axis):
        return geom.tan2_h / np.square(alpha_x)
    return tilt(geom, geom.offset_from(axis), alpha_x, alpha_y)


def _roots_alone(geom: Geometry, alpha_x, alpha_y, axis):
    """R of light and view."""
    if _is_round(alpha_x, alpha_y, axis):
        both = ((geom.sin_i, geom.cos_i), (geom.sin_r, geom.cos_r))
        return [np.sqrt(np.square(alpha_x * sin) + cos * cos) for sin, cos in both]
    return [root for root, _, _ in roots(geom, alpha_x, alpha_y, axis)]


def tilt(geom: Geometry, v, alpha_x, alpha_y):
    """e as t over the wider square and what the narrower adds to it, so that no grain leaves no trace of the axis."""
    wide, narrow = np.maximum(alpha_x, alpha_y), np.minimum(alpha_x, alpha_y)
    along_narrow = np.where(np.less(alpha_x, alpha_y), *v) / geom.v_z
    return geom.tan2_h / (wide * wide) + along_narrow**2 * _excess(wide, narrow) / (wide * narrow) ** 2


def _excess(wide, narrow):
    """wide² - narrow²."""
    return (wide - narrow) * (wide + narrow)


def roots(geom: Geometry, alpha_x, alpha_y, axis):
    """R, w_x and w_y of light and view."""
    cosines = (geom.cos_i, geom.cos_r)
    steepness = _steepness(geom, alpha_x, alpha_y, axis)
    return [(np.sqrt(square + cos * cos), x, y) for (square, x, y), cos in zip(steepness, cosines, strict=True)]


def _steepness(geom: Geometry, alpha_x, alpha_y, axis):
    """p², w_x and w_y of light and view; p is alpha sin θ to every digit where both widths are alike."""
    wide, narrow = np.maximum(alpha_x, alpha_y), np.minimum(alpha_x, alpha_y)
    found = []
    for sin, phi in ((geom.sin_i, geom.phi_i_deg), (geom.sin_r, geom.phi_r_deg)):
        turn = np.radians(phi) - axis
        x, y = sin * np.cos(turn), sin * np.sin(turn)
        along_wide = np.where(np.less(alpha_x, alpha_y), y, x)
        found.append(((narrow * sin) ** 2 + _excess(wide, narrow) * along_wide**2, x, y))
    return found
