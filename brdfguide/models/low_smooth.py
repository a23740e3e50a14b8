"""Low's law for glossy surfaces with long tails, after the scattering of smooth surfaces: ABC.

    f = a F(θl) (1 + b x²)^-c,   x = |i_xy + r_xy|,   cos θl = √(1 - |i_xy - r_xy|²/4)

The tail is a power of the distance from the mirror direction whose slope, -2c, is free: what facet laws lack. No cosine
below and no shadow, so f stays finite at grazing. θl is the paper's angle for Fresnel's factor, in the mirror direction
the angle of incidence; beside it F differs from that at the half vector (`low-smooth:half`) by about a hundredth. Where
the data do not reach beyond the shoulder, b and c can be traded for each other.

Source: Low, Kronander, Ynnerman and Unger 2012, "BRDF models for accurate and efficient rendering of glossy surfaces".
"""

import numpy as np

from ..physics.geometry import Geometry
from . import _low
from .facts import Formula
from .model import Extreme, Model, Pin, at


def cosine(geom: Geometry) -> np.ndarray:
    """cos θl as ½ √(|i + r|² + (cos θi - cos θr)²): the paper's root without its cancellation."""
    return 0.5 * np.sqrt(geom.v2 + geom.cos_difference**2)


def distance(geom: Geometry) -> np.ndarray:
    """x²."""
    return geom.vxy2


def brdf(geom: Geometry, **values) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return _low.brdf(cosine(geom), distance(geom), 1.0, **values)


def gradient(geom: Geometry, names, **values) -> dict[str, np.ndarray]:
    """By every parameter; see `_low`."""
    return _low.shared_gradient(cosine(geom), distance(geom), 1.0, names, **values)


MODEL = Model(
    __name__,
    brdf,
    parameters=_low.PARAMETERS,
    gradient=gradient,
    without={"fresnel": _low.with_fixed_fresnel(distance)},
    summary="long tails of a free slope, Fresnel, no masking: glossy surfaces whose haze no facet law follows",
    pins=(
        Pin(
            at(45, 48),
            {"a": 17.42, "b": 1142.76, "c": 0.6376, "n": 1.7},
            f=0.789335633745116865,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(75, -20),
            {"a": 2.4, "b": 19373.0, "c": 1.56, "n": 0.958, "k": 6.69},
            f=1.96194459061764177e-7,
            source="the formula above at 50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"b": 1e10, "c": 20.0}),
        Extreme("narrowest lobe, far from the mirror: underflows", at(60, -60), {"b": 1e10, "c": 20.0}),
        Extreme("light from where it is seen", at(60, -60), {"b": 0.01, "c": 0.01}),
    ),
    breaks={"energy": _low.ENERGY},
    source="Low, Kronander, Ynnerman and Unger 2012",
    family="long tails",
    cannot="its height is free, so nothing bounds its energy; no masking, no mirror image",
    from_facets=_low.from_facets,
    formula=Formula(
        "low_smooth(ci, cr, q, {a}, {b}, {c}, {n}, {k})",
        (
            (
                "low_smooth",
                "ci, cr, q, a, b, c, n, k",
                "a * fresnel(0.5 * sqrt(v2(ci, cr, q) + sq(ci - cr)), n, k) * exp(-c * ln1m(-b * q))",
            ),
        ),
    ),
)
