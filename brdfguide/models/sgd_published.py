"""The shifted-gamma law as Bagher, Soler and Holzschuch printed its fits: for reading them, not for fitting.

    f = (rho_s/π) F D G(θi) G(θr)/(cos θi cos θr)
    D = K e^-X X^-p (1 + t)²/π,   X = alpha + t/alpha,   K = 1/(alpha Γ(1 - p, alpha)),   t = tan²δ
    F = f0 - f1 cos θd + (1 - f0)(1 - cos θd)⁵,   f1 = f0 - f_normal
    G = 1 + lam (1 - exp(c max(0, θ - theta0)^k)), not below 0,   θ in radians

Eleven numbers a channel with the body. K is none: all 150 printed ones are this integral. f_normal, which is F at the
normal, stands for the printed f1, so that F is never negative: the printed f0 - f1 all lie within 0.003..1. F may
exceed 1 beside the normal, and f0 is no reflectance. lam, c, k and theta0 come from a fit of D's shadowing, not from
data. No 1/4 is divided by, which rho_s takes up. What it is good for, slopes between Beckmann's and GGX's, has `sgd`
with shadows and Fresnel of its own. Written `sgd:published`.

Source: Bagher, Soler and Holzschuch 2012, "Accurate fitting of measured reflectances using a shifted gamma micro-facet
distribution"; the cosines below as in the authors' code, which some readers leave out.
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from ._shifted_gamma import norm
from .model import Extreme, Model, Parameter, Pin, at

CLOSED = 60.0  # c (θ - theta0)^k beyond which G is 0 for every lam


def brdf(geom: Geometry, *, rho_s, alpha, p, f0, f_normal, theta0, c, k, lam) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    visible = _visible(geom.theta_i, theta0, c, k, lam) * _visible(geom.theta_r, theta0, c, k, lam)
    return (rho_s / pi) * _fresnel(geom, f0, f_normal) * _distribution(geom, alpha, p) * visible / geom.cos_cos


def _fresnel(geom: Geometry, f0, f_normal):
    """F as a sum of terms that are not negative."""
    off = _versine(geom)
    return f0 * off * (1 - off**4) + f_normal * geom.cos_d + off**5


def _versine(geom: Geometry):
    """1 - cos θd as |i - r|²/(4 (1 + cos θd)), which where light and view meet is no difference of ones."""
    return 0.25 * (geom.with_light_turned.vxy2 + geom.cos_difference**2) / (1 + geom.cos_d)


def _distribution(geom: Geometry, alpha, p):
    reduced = geom.tan2_h / alpha
    falls = np.exp(-reduced - p * np.log(alpha + reduced))
    return geom.sec2_h**2 * falls / (pi * alpha * norm(alpha, p)[0])


def _visible(theta, theta0, c, k, lam):
    """G; its exponent c (θ - theta0)^k through the logarithm, which alone is of ordinary size."""
    beyond = theta - theta0
    ln_exponent = np.log(c) + k * np.log(np.where(beyond > 0, beyond, 1.0))
    exponent = np.where(beyond > 0, np.exp(np.minimum(ln_exponent, np.log(CLOSED))), 0.0)
    return np.maximum(1 - lam * np.expm1(exponent), 0.0)


def gradient(geom: Geometry, names, *, rho_s, alpha, p, f0, f_normal, theta0, c, k, lam) -> dict[str, np.ndarray]:
    """By height, slopes and F, d ln D as in `sgd`; the shadow's four numbers are held and left to differences."""
    open_i, open_r = (_visible(theta, theta0, c, k, lam) for theta in (geom.theta_i, geom.theta_r))
    whole, by_alpha, by_p = norm(alpha, p)
    reduced, off = geom.tan2_h / alpha, _versine(geom)
    x = alpha + reduced
    without_f = _distribution(geom, alpha, p) * open_i * open_r / (pi * geom.cos_cos)
    shape = _fresnel(geom, f0, f_normal) * without_f
    return {
        "rho_s": shape,
        "alpha": rho_s * shape * ((reduced - 1) / alpha - p * (1 - reduced / alpha) / x - by_alpha / whole),
        "p": -rho_s * shape * (np.log(x) + by_p / whole),
        "f0": rho_s * without_f * off * (1 - off**4),
        "f_normal": rho_s * without_f * geom.cos_d,
    }


def _shadow(name: str, default: float, low: float, high: float, log: bool, meaning: str, unit: str = "") -> Parameter:
    return Parameter(name, default, low, high, unit, log=log, per_channel=True, free=False, meaning=meaning)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("rho_s", 0.2, 0.0, 10.0, linear=True, per_channel=True, meaning="height of the lobe"),
        Parameter(
            "alpha",
            0.02,
            1e-6,
            2.0,
            log=True,
            per_channel=True,
            meaning="core of the slopes; √alpha is their end",
            starts=(1e-4, 1e-3, 5e-3, 0.02, 0.08, 0.3),
        ),
        Parameter(
            "p",
            0.5,
            0.0,
            2.5,
            per_channel=True,
            meaning="power of the slopes between core and end",
            starts=(0.1, 0.5, 1.0),
        ),
        Parameter("f0", 0.1, 0.0, 10.0, per_channel=True, meaning="constant of F", starts=(0.1, 0.9)),
        Parameter(
            "f_normal",
            0.05,
            1e-3,
            1.0,
            given_low=0.0,
            per_channel=True,
            meaning="F at the normal",
            starts=(0.05, 0.9),
        ),
        _shadow("theta0", 0.5, -1.6, 1.6, False, "angle from which shadows count", "rad"),
        _shadow("c", 1e-3, 1e-12, 1e120, True, "factor of the shadow's exponent"),
        _shadow("k", 10.0, 2.0, 1000.0, True, "power of the shadow's exponent"),
        _shadow("lam", 2.5, 1e-12, 1e9, True, "depth of the shadow"),
    ),
    gradient=gradient,
    summary="the printed fits of Bagher et al. 2012, with their own shadows and Fresnel: to read, not to fit",
    pins=(
        Pin(
            at(45, 48),
            {
                "rho_s": 0.275,
                "alpha": 0.015,
                "p": 0.46,
                "f0": 0.9,
                "f_normal": 0.8,
                "theta0": 0.2,
                "c": 1e-7,
                "k": 47.0,
            },
            f=7.67582703838601077,
            source="50 digits",
        ),
        Pin(
            at(50, 30),
            {"alpha": 0.23, "p": 1.2, "f0": 0.5, "f_normal": 0.2, "theta0": -0.2, "c": 0.04, "k": 7.2, "lam": 2.2},
            f=0.0710410166159632033,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("shadows closed at grazing", at(89.99, 89.99), {"theta0": -1.6, "c": 1e120, "k": 1000.0}, f=0.0),
        Extreme("narrowest core, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-6, "p": 2.5, "c": 1e-12}),
    ),
    breaks={"energy": "neither its height nor its F is bounded, and its shadows are a fit"},
    source="Bagher, Soler and Holzschuch 2012",
    family="facets",
    cannot="its shadows and its F are fits of their own: no energy bound, no mirror image",
    from_facets=lambda facets: {"alpha": facets.alpha**2, "p": 0.0, "f0": facets.f0, "f_normal": facets.f0},
)
