"""Blinn's lobe about the half vector, sending the share ks at normal incidence.

    f = ks (n + 2)(n + 4) / (8π (n + 2^(-n/2))) cosⁿδ,   δ from normal to half vector

The factor makes the reflectance at normal incidence exactly ks; renderers often write (n + 8)/(8π), which sends
2 % more at n = 80. The lobe stretches vertically toward grazing, as real ones do, but its peak does not grow.

Source: Blinn 1977, "Models of light reflection for computer synthesized pictures"; the factor is the integral of
cosⁿδ cos θr over the hemisphere at normal incidence.
"""

from math import log, pi

import numpy as np

from ..geometry import Geometry, in_plane
from ._base import Extreme, Model, Parameter, Pin


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
        Parameter("exponent", 80.0, 0.1, 4e6, log=True, meaning="n: about 2/alpha² - 2 of a slope lobe", starts=(10.0, 50.0, 200.0, 1000.0, 10000.0)),
    ),
    gradient=gradient,
    summary="cheap, reciprocal, lobe stretches but does not grow toward grazing: coats, plastics away from grazing",
    pins=(
        Pin(in_plane(45, 50), {"ks": 0.3, "exponent": 133.0}, f=1.4624535444807818, source="50 digits"),
        Pin(in_plane(70, 10), {"ks": 0.7, "exponent": 2.5}, f=0.1946978345558404, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", in_plane(89.99, 89.99), {"exponent": 4e6}),
        Extreme("lobe underflows", in_plane(10, -70), {"exponent": 4e6}, f=0.0),
    ),
    source="Blinn 1977",
)
