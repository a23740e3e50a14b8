"""Low's law for glossy surfaces with Fresnel's factor at the half vector, as facets would have it.

    f = a F(θd) (1 + b x²)^-c,   x = |i_xy + r_xy|,   θd from light to half vector

The same as `low-smooth` but for the angle of F: the two are equal in the mirror direction and some hundredths of F
apart beside it. Written `low-smooth:half`.

Source: Low, Kronander, Ynnerman and Unger 2012; the half vector's angle is ours.
"""

import numpy as np

from ..physics.geometry import Geometry
from . import _low
from .facts import Formula
from .model import Extreme, Model, Pin, at


def distance(geom: Geometry) -> np.ndarray:
    """x²."""
    return geom.vxy2


def brdf(geom: Geometry, **values) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return _low.brdf(geom.cos_d, distance(geom), 1.0, **values)


def gradient(geom: Geometry, names, **values) -> dict[str, np.ndarray]:
    """By every parameter; see `_low`."""
    return _low.shared_gradient(geom.cos_d, distance(geom), 1.0, names, **values)


MODEL = Model(
    __name__,
    brdf,
    parameters=_low.PARAMETERS,
    gradient=gradient,
    without={"fresnel": _low.with_fixed_fresnel(distance)},
    summary="low-smooth with Fresnel's factor at the half vector",
    pins=(
        Pin(
            at(45, 20),
            {"a": 17.42, "b": 1142.76, "c": 0.6376, "n": 1.7},
            f=0.0491262986956838595,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(75, -20),
            {"a": 2.4, "b": 19373.0, "c": 1.56, "n": 0.958, "k": 6.69},
            f=1.96113464380611812e-7,
            source="the formula above at 50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"b": 1e10, "c": 20.0}),
        Extreme("light from where it is seen", at(60, -60), {"b": 0.01, "c": 0.01}),
    ),
    breaks={"energy": _low.ENERGY},
    source="Low, Kronander, Ynnerman and Unger 2012",
    family="long tails",
    cannot="its height is free, so nothing bounds its energy; no masking, no mirror image",
    from_facets=_low.from_facets,
    formula=Formula(
        "low_smooth_half(ci, cr, q, {a}, {b}, {c}, {n}, {k})",
        (
            (
                "low_smooth_half",
                "ci, cr, q, a, b, c, n, k",
                "a * fresnel(cosd(ci, cr, q), n, k) * exp(-c * ln1m(-b * q))",
            ),
        ),
    ),
)
