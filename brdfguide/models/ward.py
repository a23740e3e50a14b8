"""Ward's isotropic lobe: a Gaussian of facet slopes, without a Fresnel factor.

    f = rho_s exp(-tan²δ / alpha²) / (4π alpha² √(cos θi cos θr)),   δ from normal to half vector

Cheap and reciprocal. Its growth toward grazing is built in, so it suits rough metals and
falls short on dielectrics near grazing (Westin et al. 2004, sections 4.2 and 5.1).

Source: Ward 1992, "Measuring and modeling anisotropic reflection", isotropic case.
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from ._ward import RHO_S
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, rho_s, alpha) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    lobe = np.exp(-geom.tan2_h / alpha**2) / (4 * pi * alpha**2)
    return rho_s * lobe / np.sqrt(geom.cos_i * geom.cos_r)


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
            1e-3,
            1.5,
            log=True,
            meaning="facet slope, √2 times the rms slope along a line",
            starts=(0.02, 0.05, 0.1, 0.2, 0.35, 0.6),
        ),
    ),
    gradient=gradient,
    summary="cheap, reciprocal, one width; fixed growth toward grazing: rough metals, not dielectrics",
    pins=(
        Pin(
            at(45, 50),
            {"rho_s": 0.3, "alpha": 0.12},
            f=2.1541729424080627,
            source="the formula above at 50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-3}),
        Extreme("lobe underflows far from the mirror", at(10, -80), {"alpha": 1e-3}, f=0.0),
    ),
    breaks={"energy": "√(cos θi cos θr) sends more than 1 within 0.5° of grazing once alpha ≥ 0.2"},
    source="Ward 1992",
    family="Ward",
    cannot="brightens toward grazing in one fixed way, whatever the material; shows no mirror image",
    candidacy=Candidacy(40, substitutes=True),
    from_facets=lambda facets: {"rho_s": facets.f0, "alpha": facets.alpha},
    formula=Formula(
        "ward(ci, cr, q, {rho_s}, {alpha})",
        (("ward", "ci, cr, q, rho, a", "rho * exp(-tan2h(ci, cr, q) / (a * a)) / (4.0 * PI * a * a * sqrt(ci * cr))"),),
    ),
)
