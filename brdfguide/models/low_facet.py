"""Low's facet law: Cook and Torrance's with a distribution whose tail is a power of free slope.

    f = a F(θd) G/(π cos θi cos θr) (1 + b (1 - cos δ))^-c,   δ from normal to half vector
    G = min(1, 4 cos θi/(v_z (1 + t)), 4 cos θr/(v_z (1 + t))),   t = tan²δ,   v_z = cos θi + cos θr

The distribution is not normalised: its height is the amplitude a, so n is known from the growth toward grazing alone.
The authors' printed fits mean this formula: they lie on their materials' tables. The groove factor has a crease where
its minimum changes hands.

Source: Low, Kronander, Ynnerman and Unger 2012, "BRDF models for accurate and efficient rendering of glossy surfaces".
"""

from math import pi

import numpy as np

from ..formed import formed
from ..physics.geometry import Directions, Geometry
from . import _low
from .facts import Facets, Formula
from .model import Extreme, Model, Pin, at


@formed
def distance(to: Directions) -> np.ndarray:
    """1 - cos δ, without the difference."""
    secant = np.sqrt(to.sec2_h)
    return to.tan2_h / (secant * (1 + secant))


@formed
def over_cosines(to: Directions) -> np.ndarray:
    """G/(π cos θi cos θr)."""
    grooves = np.minimum(1.0, 4 * np.minimum(to.cos_i, to.cos_r) / (to.v_z * to.sec2_h))
    return grooves / (pi * to.cos_cos)


def unmasked(geom: Geometry, **values) -> np.ndarray:
    """The law without masking: enough where neither light nor eye is low."""
    return _low.brdf(geom.cos_d, distance(geom), 1 / (pi * geom.cos_cos), **values)


def brdf(geom: Geometry, **values) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return _low.brdf(geom.cos_d, distance(geom), over_cosines(geom), **values)


def gradient(geom: Geometry, names, **values) -> dict[str, np.ndarray]:
    """By every parameter; see `_low`."""
    return _low.shared_gradient(geom.cos_d, distance(geom), over_cosines(geom), names, **values)


def from_facets(facets: Facets) -> dict:
    """The lobe of GGX's peak and width: b (1 - cos δ) = t/alpha² near the peak, c = 2."""
    return {"a": 1 / (4 * facets.alpha**2), "b": 2 / facets.alpha**2, "c": 2.0, "n": facets.n[0], "k": facets.k[0]}


MODEL = Model(
    __name__,
    brdf,
    parameters=_low.PARAMETERS,
    gradient=gradient,
    without={
        "fresnel": _low.with_fixed_fresnel(distance, over_cosines),
        "masking": unmasked,
        "fresnel+masking": _low.with_fixed_fresnel(distance, lambda geom: 1 / (pi * geom.cos_cos)),
    },
    summary="facets with a tail of free slope and a free height, Fresnel, grooves: glossy paints and plastics",
    pins=(
        Pin(
            at(45, 50),
            {"a": 3.1, "b": 1142.76, "c": 0.9, "n": 1.7},
            f=0.0923631883681043761,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(80, 20),
            {"a": 0.7, "b": 19373.0, "c": 1.56, "n": 0.958, "k": 6.69},
            f=2.757243911232055e-6,
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
    cannot="its height is free, so nothing bounds its energy; no mirror image",
    from_facets=from_facets,
    formula=Formula(
        "low_facet(ci, cr, q, {a}, {b}, {c}, {n}, {k})",
        (
            (
                "low_facet",
                "ci, cr, q, a, b, c, n, k",
                "a * fresnel(cosd(ci, cr, q), n, k)"
                " * least(1.0, 4.0 * least(ci, cr) * cos2h(ci, cr, q) / (ci + cr)) / (PI * ci * cr)"
                " * exp(-c * ln1m(-b * sin2h(ci, cr, q) / (1.0 + sqrt(cos2h(ci, cr, q)))))",
            ),
        ),
    ),
)
