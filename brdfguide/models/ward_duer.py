"""Ward's lobe in Dür's form: divided by the cosines themselves, not by the root of their product.

    f = rho_s exp(-tan²δ / alpha²) / (4π alpha² cos θi cos θr),   δ from normal to half vector

Keeps its reflectance near rho_s up to 80°, where Ward's own form loses most of it, and then sends far more than it
receives. `ward-gmd` mends that; this one is here because published fits use it.

Source: Dür 2006, "An improved normalization for the Ward reflectance model".
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from ._ward import RHO_S
from .facts import Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, rho_s, alpha) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    lobe = np.exp(geom.tan2_h / -(alpha * alpha))
    return (rho_s / (4 * pi * (alpha * alpha))) * lobe / geom.cos_cos


def gradient(geom: Geometry, names, *, rho_s, alpha) -> dict[str, np.ndarray]:
    """df/dalpha = f (2/alpha) (tan²δ/alpha² - 1)."""
    lobe = brdf(geom, rho_s=1.0, alpha=alpha)
    return {"rho_s": lobe, "alpha": rho_s * lobe * (2 / alpha) * (geom.tan2_h / alpha**2 - 1)}


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        RHO_S,
        Parameter(
            "alpha",
            0.20,
            1e-4,
            1.5,
            log=True,
            meaning="facet slope, √2 times the rms slope along a line",
            starts=(0.02, 0.05, 0.1, 0.2, 0.35, 0.6),
        ),
    ),
    gradient=gradient,
    summary="as Ward to 80°, with facets' growth; gains energy beyond: for published fits, else use ward-gmd",
    pins=(
        Pin(at(45, 50), {"rho_s": 0.3, "alpha": 0.12}, f=3.1952461273449062, source="50 digits"),
        Pin(at(75, -20), {"rho_s": 0.8, "alpha": 0.7}, f=0.047004676070245384, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("lobe underflows far from the mirror", at(10, -80), {"alpha": 1e-4}, f=0.0),
    ),
    breaks={"energy": "1/(cos θi cos θr) sends more than 1 beyond 80°: 3.4 at 89° for alpha 0.2"},
    source="Dür 2006",
    family="Ward",
    cannot="sends back more light than it gets beyond 80°; the same reflectance at all angles; no mirror image",
    from_facets=lambda facets: {"rho_s": facets.f0, "alpha": facets.alpha},
    formula=Formula(
        "ward_duer(ci, cr, q, {rho_s}, {alpha})",
        (("ward_duer", "ci, cr, q, rho, a", "rho * exp(-tan2h(ci, cr, q) / (a * a)) / (4.0 * PI * a * a * ci * cr)"),),
    ),
)
