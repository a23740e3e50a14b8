"""Blinn's lobe about the half vector, sending the share ks at normal incidence.

    f = ks (n + 2)(n + 4) / (8π (n + 2^(-n/2))) cosⁿδ,   δ from normal to half vector

The factor makes the reflectance at normal incidence exactly ks; renderers often write (n + 8)/(8π), which sends
2 % more at n = 80. The lobe stretches vertically toward grazing, as real ones do, but its peak does not grow.

Source: Blinn 1977, "Models of light reflection for computer synthesized pictures"; the factor is the integral of
cosⁿδ cos θr over the hemisphere at normal incidence.
"""

from math import log, pi

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, ks, exponent) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`; cosⁿδ = exp(-n/2 ln(1 + tan²δ))."""
    factor = (exponent + 2) * (exponent + 4) / (8 * pi * (exponent + np.exp2(-0.5 * exponent)))
    return ks * factor * np.exp((-0.5 * exponent) * geom.ln_sec2_h)


def gradient(geom: Geometry, names, *, ks, exponent) -> dict[str, np.ndarray]:
    """df/dn = f (ln cos δ + 1/(n+2) + 1/(n+4) - (1 - ½ ln 2 · 2^(-n/2))/(n + 2^(-n/2)))."""
    power = np.exp2(-0.5 * exponent)
    of_factor = 1 / (exponent + 2) + 1 / (exponent + 4) - (1 - 0.5 * log(2) * power) / (exponent + power)
    lobe = brdf(geom, ks=1.0, exponent=exponent)
    return {"ks": lobe, "exponent": ks * lobe * (of_factor - 0.5 * geom.ln_sec2_h)}


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        Parameter("ks", 0.1, 0.0, 1.0, linear=True, per_channel=True, meaning="share of the light sent into the lobe"),
        Parameter(
            "exponent",
            80.0,
            0.1,
            4e6,
            log=True,
            meaning="n: about 2/alpha² - 2 of a slope lobe",
            starts=(10.0, 50.0, 200.0, 1000.0, 10000.0),
        ),
    ),
    gradient=gradient,
    summary="cheap, reciprocal, lobe stretches but does not grow toward grazing: coats, plastics away from grazing",
    pins=(
        Pin(at(45, 50), {"ks": 0.3, "exponent": 133.0}, f=1.4624535444807818, source="50 digits"),
        Pin(at(70, 10), {"ks": 0.7, "exponent": 2.5}, f=0.1946978345558404, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"exponent": 4e6}),
        Extreme("lobe underflows", at(10, -70), {"exponent": 4e6}, f=0.0),
    ),
    source="Blinn 1977",
    family="Phong",
    cannot="does not brighten toward grazing; shows no mirror image",
    candidacy=Candidacy(30, substitutes=True),
    from_facets=lambda facets: {"ks": facets.f0, "exponent": facets.half_exponent},
    formula=Formula(
        "blinn(ci, cr, q, {ks}, {exponent})",
        (
            (
                "blinn",
                "ci, cr, q, ks, n",
                "ks * (n + 2.0) * (n + 4.0) / (8.0 * PI * (n + exp(-0.34657359 * n)))"
                " * exp(0.5 * n * ln1m(sin2h(ci, cr, q)))",
            ),
        ),
    ),
)
