"""Ward's lobe with a grain, as he published it: a Gaussian of facet slopes with two widths, without Fresnel.

    f = rho_s exp(-e)/(4π αx αy √(cos θi cos θr))
    e = (s_x/αx)² + (s_y/αy)²,   s = (v_x, v_y)/v_z,   v = i + r in the frame of `axis`

Cheap, and what published fits of brushed metals use: alpha_x, alpha_y are 0.16, 0.05 for rolled brass, 0.09, 0.04 for
rolled aluminium, 0.13, 0.088 for lightly brushed aluminium. This is equation 5a; the cheaper 5b of the same paper is
another law, 1.4 times as bright 15° off the mirror direction at alpha 0.1. Its reflectance falls toward grazing, and
rises beyond 1 within a degree of it; `ward-gmd-aniso` is bounded. With both widths alike it is `ward`.

Source: Ward 1992, "Measuring and modeling anisotropic reflection", equation 5a
"""

import numpy as np

from ..physics.geometry import Geometry
from ._grain import BY_WIDTHS, MEAN_AND_RATIO, TURNS, WIDTHS, slope_density, without_grain
from ._ward import GRAINED_EXTREMES, RHO_S, grained_from_facets, grained_gradient
from .model import Model, Pin, at


def brdf(geom: Geometry, *, rho_s, alpha_x, alpha_y, axis) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return rho_s * slope_density(geom, alpha_x, alpha_y, axis) * (0.25 / np.sqrt(geom.cos_cos))


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(RHO_S, *WIDTHS),
    gradient=grained_gradient(brdf),
    without=without_grain(brdf),
    derived=MEAN_AND_RATIO,
    pins=(
        Pin(
            at(45.0, 50.0, phi_i=20.0, phi_r=195.0),
            {"rho_s": 0.3, "alpha_x": 0.3, "alpha_y": 0.06, "axis": 0.4},
            f=0.925732436614924445,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(75, 60),
            {"rho_s": 0.8, "alpha_x": 0.5, "alpha_y": 0.1, "axis": 1.1},
            f=0.880787716607420552,
            source="the same, toward grazing",
        ),
    ),
    extremes=GRAINED_EXTREMES,
    breaks={**TURNS, "energy": "√(cos θi cos θr) sends more than 1 within 0.5° of grazing once the slopes are wide"},
    summary="Ward with a grain: cheap, for published fits of brushed metals; fixed growth toward grazing",
    source="Ward 1992",
    family="Ward",
    cannot="brightens toward grazing in one fixed way, whatever the material; shows no mirror image",
    from_facets=grained_from_facets,
    grain=BY_WIDTHS,
)
