"""Facets of Trowbridge and Reitz's (GGX) and of Gaussian (Beckmann) slopes: how many face each way, and how many of
them are seen.

    GGX        D = ((1 + t) alpha/(alpha² + t))²/π        Λ = (√(1 + alpha² tan²θ) - 1)/2
    Beckmann   D = exp(-t/alpha²) ((1 + t)/alpha)²/π      Λ = (exp(-x²)/(x √π) - erfc x)/2,  x = 1/(alpha tan θ)
    shape      D G/(4 cos θi cos θr): a lobe without Fresnel,   t = tan²δ, δ from normal to half vector

G is Smith's masking: 1/(1 + Λi + Λr) where heights are correlated, 1/((1 + Λi)(1 + Λr)) where they are not.

Source: Trowbridge and Reitz 1975; Beckmann and Spizzichino 1963; Smith 1967; Walter et al. 2007; Heitz 2014.
"""

from math import pi, sqrt

import numpy as np

from ..formed import formed
from .geometry import Directions, Geometry

# 1/√π - x erfcx(x) as a ratio of polynomials, highest power first, fitted by benchmarks/ramp.py: right to 6e-16 of
# x + cos θ Λ for x <= 6; beyond, exp(-x²) leaves nothing of it. All coefficients are positive, so no digit is lost.
ABOVE = (
    0.0010384444112690034,
    0.013204521587764643,
    0.07677608418112063,
    0.26010966800444885,
    0.5109361511037411,
    0.5641895835477566,
)
BELOW = (
    0.003682914575712285,
    0.0467658195638668,
    0.27821178625739507,
    0.9880931282215705,
    2.23804571017105,
    3.2077782950513614,
    2.678064599496381,
    1.0,
)


def ggx(geom: Geometry, alpha) -> np.ndarray:
    """D of GGX, facets per solid angle [1/sr]; its projection integrates to 1."""
    density = geom.sec2_h / (geom.tan2_h + alpha * alpha)
    density *= density
    density *= alpha * alpha / pi
    return density


def ggx_shape(geom: Geometry, alpha) -> np.ndarray:
    """Shape of GGX facets with correlated heights [1/sr]."""
    shape = ggx(geom, alpha)
    i, r = _roots(geom, alpha)
    i *= geom.cos_r
    r *= geom.cos_i
    i += r
    i *= 2
    shape /= i
    return shape


def ggx_shape_and_slope(geom: Geometry, alpha) -> tuple[np.ndarray, np.ndarray]:
    """The same, and d ln shape/dalpha = (2/alpha) (t - alpha²)/(t + alpha²) - alpha (sin²θi cos θr/i + sin²θr cos θi/r)
    / (cos θr i + cos θi r),   i, r = cos θ (1 + 2Λ)."""
    i, r = _roots(geom, alpha)
    masking = geom.cos_r * i + geom.cos_i * r
    rise = geom.sin_i * geom.sin_i * geom.cos_r / i + geom.sin_r * geom.sin_r * geom.cos_i / r
    near = 1 / (geom.tan2_h + alpha * alpha)
    by_alpha = (2 / alpha) * (geom.tan2_h - alpha * alpha) * near - alpha * rise / masking
    near *= geom.sec2_h
    return near * near * (alpha * alpha / (2 * pi)) / masking, by_alpha


def ggx_shape_uncorrelated(geom: Geometry, alpha) -> np.ndarray:
    """Shape of GGX facets whose heights are not correlated [1/sr], as many renderers mask them."""
    i, r = _roots(geom, alpha)
    return ggx(geom, alpha) / ((geom.cos_i + i) * (geom.cos_r + r))


def _roots(geom: Geometry, alpha):
    """cos θ (1 + 2Λ) = √(cos²θ + alpha² sin²θ) of light and view, in which nothing is divided by a cosine."""
    less = (1 - alpha) * (1 + alpha)  # cos² + alpha² sin² = alpha² + (1 - alpha²) cos²
    i, r = less * geom.cos2_i + alpha * alpha, less * geom.cos2_r + alpha * alpha
    return np.sqrt(i), np.sqrt(r)


def beckmann(geom: Geometry, alpha) -> np.ndarray:
    """D of Gaussian slopes [1/sr]; its projection integrates to 1."""
    density = geom.sec2_h / alpha
    density *= density
    density *= np.exp(geom.tan2_h * (-1 / (alpha * alpha)))
    density *= 1 / pi
    return density


def beckmann_shape(geom: Geometry, alpha) -> np.ndarray:
    """Shape of Gaussian facets with correlated heights [1/sr]."""
    (hidden, other), _, (in_i, in_r) = _hidden_both(geom, alpha)
    hidden *= in_i
    other *= in_r
    hidden += other
    hidden *= 2 * alpha
    return beckmann(geom, alpha) / (hidden + 4 * geom.cos_cos)


def beckmann_shape_and_slope(geom: Geometry, alpha) -> tuple[np.ndarray, np.ndarray]:
    """The same, and d ln shape/dalpha = (2/alpha)(t/alpha² - 1) - d ln(1 + Λi + Λr)/dalpha, with cos θ dΛ/dalpha = sin
    θ exp(-x²)/(2√π)."""
    (hidden_i, hidden_r), (gaussian_i, gaussian_r), (in_i, in_r) = _hidden_both(geom, alpha)
    masking = (2 * alpha) * (hidden_i * in_i + hidden_r * in_r) + 4 * geom.cos_cos
    rise = (gaussian_i * in_i + gaussian_r * in_r) * (2 / sqrt(pi))
    by_alpha = (2 / alpha) * (geom.tan2_h / alpha**2 - 1) - rise / masking
    return beckmann(geom, alpha) / masking, by_alpha


def _hidden_both(geom: Geometry, alpha):
    """Λ/(½ alpha tan θ) = exp(-x²) (1/√π - x erfcx x), exp(-x²), and sin θ times the other's cosine: of light and view
    in one call each."""
    tan, across = _tangents(geom)
    more = np.ndim(alpha) - np.ndim(geom.cos_i)
    if more > 0:
        tan = tan.reshape(2, *(1,) * more, *tan.shape[1:])
    return *hidden_by_slope(tan * alpha), across


@formed
def _tangents(to: Directions) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """tan θ of light and view, (2, ...), and the sine of each times the other's cosine."""
    return np.stack((to.tan_i, to.tan_r)), (to.sin_i * to.cos_r, to.sin_r * to.cos_i)


def hidden_by_slope(slope):
    """The same by alpha tan θ = 1/x, which a grain makes differ with azimuth."""
    # beyond 32, where exp(-x²) is 0, it stays 32 so that the normal has a value
    x = 1 / np.maximum(slope, 1 / 32)
    hidden = _horner(ABOVE, x)
    hidden /= _horner(BELOW, x)
    gaussian = np.exp(x * -x)
    hidden *= gaussian
    return hidden, gaussian


def _horner(coefficients, x):
    total = x * coefficients[0]
    total += coefficients[1]
    for coefficient in coefficients[2:]:
        total *= x
        total += coefficient
    return total
