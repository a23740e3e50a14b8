"""Shifted-gamma facets: slopes between a power law and a Gaussian, with their own Smith masking and Fresnel.

    f = F D/(4 cos θi cos θr (1 + Λi + Λr))
    D = (1 + t)² e^(-t/alpha) X^-p/(π alpha I),   X = alpha + t/alpha,   t = tan²δ, δ from normal to half vector
    I = ∫ e^-y (alpha + y)^-p dy from 0 on
    cos θ Λ = (2 √alpha/(π I)) sin θ e^-ζ² ∫ (y - ζ atan(y/ζ)) y e^-y² (alpha + ζ² + y²)^-p dy,   ζ = cot θ/√alpha

Slopes up to alpha are a core, those from alpha to √alpha a power law of exponent -2p, those beyond fall as a Gaussian;
p = 0 is `beckmann` of width √alpha. It is the D of Bagher, Soler and Holzschuch, whose printed fits (`sgd:published`)
have a shadowing and a Fresnel factor of their own with eight numbers more; here both follow from D and from n and k.
The masking is kept as a Chebyshev series for each alpha and p.

Source: Bagher, Soler and Holzschuch 2012, "Accurate fitting of measured reflectances using a shifted gamma micro-facet
distribution"; Smith 1967 and Heitz 2014 for the masking.
"""

from functools import lru_cache
from math import pi

import numpy as np

from ..numerics import chebyshev
from ..physics import fresnel
from ..physics.geometry import Geometry
from . import _smith
from ._microfacet import INDEX, gradient_by, reduced
from ._shifted_gamma import norm
from .model import Extreme, Model, Parameter, Pin, at

STEP = 0.15  # in ln y, of the trapezoidal rule over a Gaussian
HIDDEN = 6.2  # ζ beyond which e^-ζ² leaves nothing hidden


def distribution(geom: Geometry, alpha, p) -> np.ndarray:
    """D, facets per solid angle [1/sr]; its projection integrates to 1."""
    reduced = geom.tan2_h / alpha
    falls = np.exp(-reduced - p * np.log(alpha + reduced))
    return geom.sec2_h**2 * falls / (pi * alpha * norm(alpha, p)[0])


@lru_cache(maxsize=256)
def _table(alpha: float, p: float):
    """cos θ Λ/(sin θ e^-ζ²) and its derivatives by alpha and by p, as functions of ζ."""
    scale, (whole, by_alpha, by_p) = np.sqrt(alpha), norm(alpha, p)
    y = np.exp(np.arange(np.log(scale) - 10, 2, STEP))
    weight = (2 * scale / pi / whole * STEP) * y * y * np.exp(-y * y)

    def functions(zeta):
        zeta = zeta[:, None]
        squared = zeta * zeta + y * y
        ln_x = np.log(alpha + squared)
        part = weight * _smith.rise_above_slope(y, zeta) * np.exp(-p * ln_x)
        ln_by_alpha = (squared - 1) / alpha - p * (1 - squared / alpha) * np.exp(-ln_x) - by_alpha / whole
        ln_by_p = -ln_x - by_p / whole
        return np.stack([each.sum(axis=1) for each in (part, part * ln_by_alpha, part * ln_by_p)])

    return chebyshev.over_logarithms(functions, scale, HIDDEN)


def _masking(geom: Geometry, alpha, p, count: int = 1):
    """4 cos θi cos θr (1 + Λi + Λr), and its derivatives by alpha and by p if `count` is 3."""
    total = [4 * geom.cos_cos] + [0.0] * (count - 1)
    scale = np.sqrt(alpha)
    for cos, sin, other in ((geom.cos_i, geom.sin_i, geom.cos_r), (geom.cos_r, geom.sin_r, geom.cos_i)):
        zeta = cos / np.maximum(sin * scale, cos / HIDDEN)
        before = 4 * other * sin * np.exp(-zeta * zeta)
        found = chebyshev.by_value(_table, zeta, count, alpha, p)
        total = [whole + before * part for whole, part in zip(total, found, strict=True)]
    return total


def shape(geom: Geometry, alpha, p) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr]: the law without Fresnel."""
    return distribution(geom, alpha, p) / _masking(geom, alpha, p)[0]


def brdf(geom: Geometry, *, alpha, p, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * shape(geom, alpha, p)


def gradient(geom: Geometry, names, *, alpha, p, n, k, scale) -> dict[str, np.ndarray]:
    """d ln D/dalpha = t/alpha² - p (1 - t/alpha²)/X - 1/alpha - d ln I/dalpha, d ln D/dp = -ln X - d ln I/dp; and of
    the masking."""
    masking, by_alpha, by_p = _masking(geom, alpha, p, 3)
    whole, whole_by_alpha, whole_by_p = norm(alpha, p)
    reduced = geom.tan2_h / alpha
    x = alpha + reduced
    ln_by_alpha = (reduced - 1) / alpha - p * (1 - reduced / alpha) / x - whole_by_alpha / whole
    by = {
        "alpha": ln_by_alpha - by_alpha / masking,
        "p": -np.log(x) - whole_by_p / whole - by_p / masking,
    }
    return gradient_by(geom, names, distribution(geom, alpha, p) / masking, by, n, k, scale)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "alpha",
            0.02,
            1e-6,
            2.0,
            log=True,
            meaning="core of the slopes; √alpha is their end, and Beckmann's alpha for p = 0",
            starts=(1e-4, 1e-3, 5e-3, 0.02, 0.08, 0.3),
        ),
        Parameter("p", 0.5, 0.0, 2.0, meaning="power of the slopes between core and end", starts=(0.1, 0.4, 0.8, 1.2)),
        *INDEX,
    ),
    gradient=gradient,
    without=reduced(shape, distribution),
    summary="a power law of slopes with a Gaussian end: between Beckmann and GGX, Fresnel, masking",
    pins=(
        Pin(
            at(45, 50),
            {"alpha": 0.015, "p": 0.46, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=1.13231113236220039,
            source="50 digits",
        ),
        Pin(
            at(75, 60),
            {"alpha": 0.23, "p": 1.2, "n": 0.958, "k": 6.69, "scale": 1.0},
            f=5.75946447197757237,
            source="50 digits",
        ),
        Pin(
            at(85, 88),
            {"alpha": 1e-3, "p": 0.8, "n": 1.5, "k": 0.0, "scale": 1.0},
            f=3768.78496425533936,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest core, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-6, "p": 2.0}),
        Extreme("on the peak of the narrowest core", at(30, 30), {"alpha": 1e-6, "p": 2.0}),
        Extreme("underflows far from the mirror", at(10, -80), {"alpha": 1e-6}, f=0.0),
        Extreme("at the normal, where tan is 0", at(0, 0), {"alpha": 2.0}),
    ),
    source="Bagher, Soler and Holzschuch 2012; Smith 1967; Heitz 2014",
    family="facets",
    cannot="no mirror image; no tail beyond √alpha",
    from_facets=lambda facets: {"alpha": facets.alpha**2, "p": 0.0, "n": facets.n, "k": facets.k},
)
