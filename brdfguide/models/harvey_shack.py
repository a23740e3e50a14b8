"""Harvey and Shack's law of polished optics: a smooth shoulder and a power of the distance from the mirror direction.

    f = b0 (1 + (x/l)²)^(s/2),   x = |β - β0| = |i_xy + r_xy|

β are direction sines. b0 is the value in the mirror direction, l where the level bends ("0.01 rad"), s the slope
beyond it, mostly -1.5 to -2.5. It is what a surface of K-correlation spectrum scatters (`abc`), with cosines,
wavelength and reflectance taken into b0. The mirror beam is no part of it. With g = -s, b = l^g, a = b0 l^g the law
`abg` has its peak and its tail, but not its shoulder: at x = l the two give 2^(s/2) and 1/2 of b0, the same only for
s = -2.

Source: Harvey 1976, "Light-scattering characteristics of optical surfaces".
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Derived, Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, b0, l, s) -> np.ndarray:  # noqa: E741
    """BRDF [1/sr], in the shape of `geom`."""
    return b0 * np.exp((0.5 * s) * np.log1p(geom.vxy2 * (1 / (l * l))))


def gradient(geom: Geometry, names, *, b0, l, s) -> dict[str, np.ndarray]:  # noqa: E741
    """d ln f/ds = ½ ln(1 + q), d ln f/dl = -(s/l) q/(1 + q), q = (x/l)²."""
    q = geom.vxy2 * (1 / (l * l))
    half = 0.5 * np.log1p(q)
    shape = np.exp(s * half)
    lobe = b0 * shape
    return {"b0": shape, "s": lobe * half, "l": lobe * (-s / l) * (q / (1 + q))}


def scattered(b0, l, s):  # noqa: E741
    """Light scattered at normal incidence, 2π b0 l² ((1 + 1/l²)^(s/2+1) - 1)/(s + 2); its logarithm at s = -2."""
    half, ln_range = 0.5 * np.asarray(s, float) + 1, np.log1p(1 / np.square(l))
    grown = half * ln_range
    mean = np.where(grown == 0, 1.0, np.expm1(grown) / np.where(grown == 0, 1.0, grown))
    return pi * b0 * np.square(l) * ln_range * mean


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "b0", 1.0, 0.0, 1e12, unit="1/sr", linear=True, per_channel=True, meaning="value in the mirror direction"
        ),
        Parameter(
            "l",
            0.01,
            1e-6,
            10.0,
            log=True,
            meaning="shoulder, as a difference of direction sines",
            starts=(1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3),
        ),
        Parameter(
            "s",
            -2.0,
            -10.0,
            -0.01,
            meaning="slope of ln f against ln x beyond the shoulder",
            starts=(-1.0, -1.5, -2.0, -2.5, -3.5),
        ),
    ),
    gradient=gradient,
    derived=(Derived("tis", scattered, meaning="light scattered in all directions at normal incidence"),),
    summary="stray light of polished optics: smooth shoulder and power law, no Fresnel, no wavelength",
    pins=(
        Pin(
            at(45, 48),
            {"b0": 7.753, "l": 0.02, "s": -1.7},
            f=2.26784183308848113,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(70, -40),
            {"b0": 3.6, "l": 0.1, "s": -2.5},
            f=0.00359578148526077203,
            source="the formula above at 50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest, on the mirror direction", at(45, 45), {"b0": 1.0, "l": 1e-6}, f=1.0),
        Extreme("steepest, 0.01° from grazing", at(89.99, -89.99), {"l": 1e-6, "s": -10.0}),
    ),
    source="Harvey 1976",
    family="polished optics",
    candidacy=Candidacy(131, polished=True),
    cannot="no Fresnel, no wavelength; the mirror beam is no part of it",
    from_facets=lambda facets: {"b0": facets.peak, "l": 2 * facets.alpha, "s": -4.0},
    formula=Formula(
        "harvey_shack(q, {b0}, {l}, {s})",
        (("harvey_shack", "q, b0, l, s", "b0 * exp(0.5 * s * ln1m(-q / (l * l)))"),),
    ),
)
