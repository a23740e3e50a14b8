"""The ABg law of stray-light programs: a shoulder and a power of the distance from the mirror direction.

    f = a/(b + x^g),   x = |β - β0| = |i_xy + r_xy|

β are direction sines: x is 0 in the mirror direction and 2 from one grazing direction to the opposite one. A polished
optic scatters so when its spectrum of heights is a power law: on axes that are both logarithmic a level a/b up to
x = b^(1/g), then a straight line of slope -g. Nothing of it is Fresnel's or a cosine's. The mirror beam itself is no
part of it, so leave out what an aperture saw of that. For g >= 2 most of the light comes from the shoulder, which must
have been measured then. g = 0 is Lambert's law.

Source: Gary Peterson, in Stover, "Optical Scattering"; the name and the formula of Zemax, FRED, ASAP and TracePro.
"""

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, a, b, g) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return a / (b + geom.vxy2 ** (0.5 * g))


def gradient(geom: Geometry, names, *, a, b, g) -> dict[str, np.ndarray]:
    """df/db = -f²/a, df/dg = -f²/a x^g ln x."""
    power = geom.vxy2 ** (0.5 * g)
    shape = 1 / (b + power)
    square = -a * shape * shape
    return {"a": shape, "b": square, "g": square * power * geom.ln_vxy}


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "a", 0.01, 0.0, 1e6, unit="1/sr", linear=True, per_channel=True, meaning="level of the power law at x = 1"
        ),
        Parameter(
            "b",
            1e-3,
            1e-12,
            100.0,
            log=True,
            meaning="shoulder: level until x = b^(1/g)",
            starts=(1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.1),
        ),
        Parameter(
            "g",
            2.0,
            0.1,
            6.0,
            given_low=0.0,
            meaning="slope of ln f against ln x beyond the shoulder",
            starts=(1.0, 1.5, 2.0, 3.0),
        ),
    ),
    gradient=gradient,
    summary="stray light of polished optics as Zemax, FRED and ASAP take it: shoulder and power law, no Fresnel",
    pins=(
        Pin(
            at(45, 48),
            {"a": 0.04325, "b": 1e-6, "g": 1.5},
            f=6.32092756568660064,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(70, -40),
            {"a": 0.0021, "b": 0.02, "g": 2.6},
            f=0.000632869514828032316,
            source="the formula above at 50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest shoulder, on the mirror direction", at(45, 45), {"a": 1.0, "b": 1e-12, "g": 3.0}, f=1e12),
        Extreme("no slope is Lambert's law", at(89.99, 89.99), {"a": 0.5, "b": 1.0, "g": 0.0}, f=0.25),
        Extreme("steepest, 0.01° from grazing", at(89.99, -89.99), {"b": 1e-12, "g": 6.0}),
    ),
    source="Peterson, in Stover 1995 and later editions",
    family="polished optics",
    candidacy=Candidacy(130, polished=True),
    cannot="no Fresnel, no wavelength; the mirror beam is no part of it",
    from_facets=lambda facets: {
        "a": tuple(16 * facets.alpha**4 * p for p in facets.peak),
        "b": 16 * facets.alpha**4,
        "g": 4.0,
    },
    formula=Formula(
        "abg(q, {a}, {b}, {g})",
        (("abg", "q, a, b, g", "a / (b + choose(q, exp(0.5 * g * log(most(q, 1.0e-37))), choose(g, 0.0, 1.0)))"),),
    ),
)
