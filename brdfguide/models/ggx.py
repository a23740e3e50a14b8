"""GGX facets (Trowbridge and Reitz 1975) with height-correlated Smith masking and Fresnel.

    f = F D / (4 cos θi cos θr (1 + Λi + Λr))
    D = ((1 + t)·alpha/(alpha² + t))²/π,   t = tan²δ, δ from normal to half vector
    Λ = (√(1 + alpha² tan²θ) - 1)/2

Tails longer than any Gaussian facet law: for most rough dielectrics and many metals the best of the cheap laws.
Loses some energy at large alpha, since light that meets two facets is not followed.

Source: Walter et al. 2007, "Microfacet models for refraction through rough surfaces"; Heitz 2014 for the masking.
"""

from math import pi

import numpy as np

from .. import optics
from ..geometry import Geometry, in_plane
from ._base import Extreme, Model, Parameter, Pin
from ._microfacet import INDEX, gradient_of, with_fixed_fresnel


def distribution(geom: Geometry, alpha) -> np.ndarray:
    """D, facets per solid angle [1/sr]; its projection integrates to 1."""
    return (geom.sec2_h * alpha / (alpha * alpha + geom.tan2_h)) ** 2 / pi


def shape(geom: Geometry, alpha) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr]: the law without Fresnel."""
    d = geom.sec2_h / (geom.tan2_h + alpha * alpha)
    d *= d
    d *= alpha * alpha / (2 * pi)
    d /= _masking(geom, alpha)
    return d


def _masking(geom: Geometry, alpha):
    """2 cos θi cos θr (1 + Λi + Λr) = cos θr √(cos²θi + alpha² sin²θi) + cos θi √(cos²θr + alpha² sin²θr)."""
    less = (1 - alpha) * (1 + alpha)  # cos² + alpha² sin² = alpha² + (1 - alpha²) cos²
    i, r = less * geom.cos2_i + alpha * alpha, less * geom.cos2_r + alpha * alpha
    i, r = np.sqrt(i), np.sqrt(r)
    i *= geom.cos_r
    r *= geom.cos_i
    i += r
    return i


def brdf(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * optics.fresnel(geom.cos_d, n, k) * shape(geom, alpha)


def gradient(geom: Geometry, names, *, alpha, n, k, scale) -> dict[str, np.ndarray]:
    """d ln f/dalpha = 2/alpha - 4 alpha/(alpha² + t) - alpha (sin²θi cos θr/√i + sin²θr cos θi/√r)/(cos θr √i + cos θi √r)."""
    a2, less = alpha * alpha, (1 - alpha) * (1 + alpha)
    root_i, root_r = np.sqrt(less * geom.cos2_i + a2), np.sqrt(less * geom.cos2_r + a2)
    masking = geom.cos_r * root_i + geom.cos_i * root_r
    rise = geom.sin_i * geom.sin_i * geom.cos_r / root_i + geom.sin_r * geom.sin_r * geom.cos_i / root_r
    near = 1 / (geom.tan2_h + a2)
    by_alpha = (2 / alpha) * (geom.tan2_h - a2) * near - alpha * rise / masking
    near *= geom.sec2_h
    return gradient_of(geom, names, near * near * (a2 / (2 * pi)) / masking, by_alpha, n, k, scale)


def bare(geom: Geometry, alpha) -> np.ndarray:
    """D/(4 cos θi cos θr) [1/sr]: the shape with no facet hidden by another."""
    return distribution(geom, alpha) / (4 * geom.cos_cos)


def unmasked(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """The law without masking: enough where neither light nor eye is low."""
    return scale * optics.fresnel(geom.cos_d, n, k) * bare(geom, alpha)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("alpha", 0.2, 1e-4, 1.5, log=True, meaning="facet slope: √2 times the rms slope of a Gaussian lobe of equal peak", starts=(0.01, 0.04, 0.1, 0.2, 0.4, 0.8)),
        *INDEX,
    ),
    gradient=gradient,
    without={"fresnel": with_fixed_fresnel(shape), "masking": unmasked, "fresnel+masking": with_fixed_fresnel(bare)},
    summary="long tails, Fresnel, masking: the first choice for rough plastics, paints, many metals",
    pins=(
        Pin(in_plane(45, 50), {"alpha": 0.12, "n": 1.7, "k": 0.0, "scale": 0.8}, f=0.62289668282776856, source="50 digits"),
        Pin(in_plane(75, 60), {"alpha": 0.5, "n": 0.958, "k": 6.69, "scale": 1.0}, f=1.1593076298092438, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", in_plane(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("on the peak of the narrowest lobe", in_plane(30, 30), {"alpha": 1e-4}),
        Extreme("light from where it is seen", in_plane(60, -60), {"alpha": 1.5}),
    ),
    source="Walter et al. 2007; Trowbridge and Reitz 1975; Heitz 2014",
)
