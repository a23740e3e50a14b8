"""GGX facets about the light: a lobe back to where it came from.

    f = rho D/(4 cos θi cos θr (1 + Λi + Λr)),   D and Λ as in `ggx`, of the light turned about the normal by 180°

rho is the share of the light that is sent back, at most. What corners, beads and rough porous grounds do beside a
body: road signs, projection screens, some paints and powders. How it is sent back is not told: an empirical lobe of
one width. A Lafortune lobe of negative tilt is the other way to follow it.

Source: ours; the lobe is Trowbridge and Reitz's 1975, turned.
"""

import numpy as np

from ..physics import microfacet
from ..physics.geometry import Geometry
from ._flakes import SHAPE
from .facts import TOWARD_LIGHT, Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, rho, alpha) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return rho * microfacet.ggx_shape(geom.light_turned(), alpha)


def gradient(geom: Geometry, names, *, rho, alpha) -> dict[str, np.ndarray]:
    """d ln f/dalpha as GGX's."""
    shape, by_alpha = microfacet.ggx_shape_and_slope(geom.light_turned(), alpha)
    return {"rho": shape, "alpha": rho * shape * by_alpha}


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "rho", 0.05, 0.0, 1.0, linear=True, per_channel=True, meaning="share of the light sent into the lobe"
        ),
        Parameter(
            "alpha",
            0.1,
            1e-3,
            1.5,
            log=True,
            meaning="width of the lobe, as facet slopes",
            starts=(0.02, 0.06, 0.15, 0.4),
        ),
    ),
    gradient=gradient,
    summary="a lobe back toward the light, for a body that shines there: signs, screens, some paints",
    pins=(
        Pin(at(45, -50), {"rho": 0.3, "alpha": 0.12}, f=2.83083766165774663, source="50 digits"),
        Pin(at(70, 20), {"rho": 0.9, "alpha": 0.5}, f=0.105036726759606441, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing, at the light", at(89.99, -89.99), {"alpha": 1e-3}),
        Extreme("in the mirror direction", at(60, 60), {"alpha": 1e-3}),
    ),
    source="Trowbridge and Reitz 1975, turned: ours",
    family="retro-reflection",
    cannot="no highlight on the mirror's side: it stands beside other lobes",
    from_facets=lambda facets: {"rho": facets.f0, "alpha": facets.alpha},
    candidacy=Candidacy(120, grown="beside", adds="a lobe back toward the light"),
    beyond_facets=lambda **_: "a lobe back toward the light has no counterpart",
    formula=Formula(f"{{rho}} * ggx_shape(ci, cr, {TOWARD_LIGHT}, {{alpha}})", (SHAPE,)),
)
