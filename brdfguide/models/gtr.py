"""Generalised Trowbridge-Reitz facets: GGX's distribution with a free exponent, its own Smith masking, and Fresnel.

    f = F D/(4 cos θi cos θr (1 + Λi + Λr))
    D = c ((1 + t)/(alpha² + t))^gamma,   t = tan²δ, δ from normal to half vector
    c = (gamma - 1)(alpha² - 1)/(π (1 - alpha^(2 - 2 gamma)));   (alpha² - 1)/(π ln alpha²) for gamma = 1
    cos θ Λ = 2 c sin²θ ∫ (y - μ atan(y/μ)) y (1 + y²)^(gamma - 2) (β + y²)^-gamma dy from 0 on
    μ = cos θ,   β = alpha² + (1 - alpha²) μ²

gamma = 2 is `ggx`; 1 is the hazy tail of production shaders' clear coats; 10 is nearly Gaussian at the peak. Far out
every one of them falls as GGX does, with the fourth power of the slope: for longer tails see `student-t`. Shaders
mostly mask it as if gamma were 2, which does not belong to its slopes; here the integral of its own slopes is kept as
a Chebyshev series for each alpha and gamma.

Source: Burley 2012, "Physically-based shading at Disney", appendix B; Smith 1967 and Heitz 2014 for the masking.
"""

from functools import lru_cache
from math import pi

import numpy as np

from ..numerics import chebyshev
from ..physics import fresnel
from ..physics.geometry import Geometry
from . import _smith
from ._microfacet import INDEX, gradient_by, reduced
from .model import Extreme, Model, Parameter, Pin, at

STEP = 0.2  # in ln y, of the trapezoidal rule: of a pole of tenth order at ±i it leaves 1e-15


def distribution(geom: Geometry, alpha, gamma) -> np.ndarray:
    """D, facets per solid angle [1/sr]; its projection integrates to 1."""
    return norm(alpha, gamma) * np.exp(gamma * (geom.ln_sec2_h - np.log(geom.tan2_h + alpha * alpha)))


def norm(alpha, gamma):
    """c, without the 0/0 at alpha = 1 and at gamma = 1: x/(e^x - 1) of both logarithms."""
    ln_a2 = 2 * np.log(alpha)
    return _bernoulli((1 - gamma) * ln_a2) / (pi * _bernoulli(ln_a2))


def _bernoulli(x):
    """x/(e^x - 1), 1 at x = 0."""
    x = np.asarray(x, float)
    return np.where(x == 0, 1.0, x / np.where(x == 0, 1.0, np.expm1(x)))


def _ln_bernoulli_slope(x):
    """d ln(x/(e^x - 1))/dx = 1/x - 1/(1 - e^-x), -½ at x = 0."""
    x = np.asarray(x, float)
    near = np.abs(x) < 0.1
    safe, x2 = np.where(near, 1.0, x), x * x
    close = -0.5 - x * (1 / 12 - x2 * (1 / 720 - x2 * (1 / 30240 - x2 / 1209600)))
    return np.where(near, close, 1 / safe + 1 / np.expm1(-safe))


def _norm_slopes(alpha, gamma):
    """d ln c by alpha and by gamma."""
    ln_a2 = 2 * np.log(alpha)
    by_power = _ln_bernoulli_slope((1 - gamma) * ln_a2)
    return (2 / alpha) * ((1 - gamma) * by_power - _ln_bernoulli_slope(ln_a2)), -ln_a2 * by_power


@lru_cache(maxsize=256)
def _table(alpha: float, gamma: float):
    """cos θ Λ/sin²θ and its derivatives by alpha and by gamma, as functions of cos θ."""
    c, (c_by_alpha, c_by_gamma) = norm(alpha, gamma), _norm_slopes(alpha, gamma)
    y = np.exp(np.arange(np.log(alpha) - 12, 37, STEP))
    y2 = y * y

    def functions(mu):
        mu = mu[:, None]
        ln_below = np.log(alpha * alpha + (1 - alpha) * (1 + alpha) * mu * mu + y2)
        part = (
            (2 * c * STEP) * y2 * _smith.rise_above_slope(y, mu) * np.exp((gamma - 2) * np.log1p(y2) - gamma * ln_below)
        )
        by_gamma = part * (np.log1p(y2) - ln_below)
        by_alpha = part * np.exp(-ln_below) * (-2 * gamma * alpha * (1 - mu * mu))
        hidden, by_alpha, by_gamma = (each.sum(axis=1) for each in (part, by_alpha, by_gamma))
        return np.stack([hidden, by_alpha + c_by_alpha * hidden, by_gamma + c_by_gamma * hidden])

    return chebyshev.over_logarithms(functions, alpha, 1.0)


def _masking(geom: Geometry, alpha, gamma, count: int = 1):
    """4 cos θi cos θr (1 + Λi + Λr), and its derivatives by alpha and by gamma if `count` is 3."""
    of_i = chebyshev.by_value(_table, geom.cos_i, count, alpha, gamma)
    of_r = chebyshev.by_value(_table, geom.cos_r, count, alpha, gamma)
    in_i, in_r = 4 * geom.sin_i * geom.sin_i * geom.cos_r, 4 * geom.sin_r * geom.sin_r * geom.cos_i
    masking, *by = (in_i * i + in_r * r for i, r in zip(of_i, of_r, strict=True))
    return masking + 4 * geom.cos_cos, *by


def shape(geom: Geometry, alpha, gamma) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr]: the law without Fresnel."""
    return distribution(geom, alpha, gamma) / _masking(geom, alpha, gamma)[0]


def brdf(geom: Geometry, *, alpha, gamma, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * shape(geom, alpha, gamma)


def gradient(geom: Geometry, names, *, alpha, gamma, n, k, scale) -> dict[str, np.ndarray]:
    """d ln D/dalpha = d ln c/dalpha - 2 gamma alpha/(alpha² + t), d ln D/dgamma = d ln c/dgamma + ln((1 + t)/(alpha² +
    t)); and of the masking."""
    masking, by_alpha, by_gamma = _masking(geom, alpha, gamma, 3)
    c_by_alpha, c_by_gamma = _norm_slopes(alpha, gamma)
    below = geom.tan2_h + alpha * alpha
    by = {
        "alpha": c_by_alpha - 2 * gamma * alpha / below - by_alpha / masking,
        "gamma": c_by_gamma + geom.ln_sec2_h - np.log(below) - by_gamma / masking,
    }
    return gradient_by(geom, names, distribution(geom, alpha, gamma) / masking, by, n, k, scale)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "alpha",
            0.2,
            1e-4,
            1.0,
            log=True,
            meaning="facet slope, GGX's for gamma = 2",
            starts=(0.01, 0.04, 0.1, 0.2, 0.4, 0.8),
        ),
        Parameter(
            "gamma",
            2.0,
            0.2,
            10.0,
            log=True,
            meaning="exponent: 2 is GGX, 1 and less hazier, above 2 less so",
            starts=(0.6, 1.0, 1.5, 2.0, 4.0),
        ),
        *INDEX,
    ),
    gradient=gradient,
    without=reduced(shape, distribution),
    summary="GGX with a free exponent, as production shaders have it; Fresnel, masking of its own slopes",
    pins=(
        Pin(
            at(45, 50),
            {"alpha": 0.12, "gamma": 1.3, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=0.264349523164206612,
            source="50 digits",
        ),
        Pin(
            at(75, 60),
            {"alpha": 0.5, "gamma": 5.0, "n": 0.958, "k": 6.69, "scale": 1.0},
            f=4.65148950751633301,
            source="50 digits",
        ),
        Pin(
            at(85, 88),
            {"alpha": 0.02, "gamma": 1.0, "n": 1.5, "k": 0.0, "scale": 1.0},
            f=412.464116019033831,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("steepest power of the narrowest lobe", at(30, 30), {"alpha": 1e-4, "gamma": 10.0}),
        Extreme("alpha 1, where its constant is 0/0", at(60, -60), {"alpha": 1.0, "gamma": 1.0}),
    ),
    source="Burley 2012; Smith 1967; Heitz 2014",
    family="facets",
    cannot="shows no mirror image; very rough, up to 10 % of the light is missing",
)
