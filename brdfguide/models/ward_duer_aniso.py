"""Ward's lobe with a grain in Dür's form: divided by the cosines themselves.

    f = rho_s exp(-e)/(4π αx αy cos θi cos θr)
    e = (s_x/αx)² + (s_y/αy)²,   s = (v_x, v_y)/v_z,   v = i + r in the frame of `axis`

Keeps its reflectance up to 60°, where Ward's own form has lost half of it, and sends 4.6 times what it gets at 89°
with alpha 0.3 and 0.06. `ward-gmd-aniso` mends that; this one is here because published fits use it. With both widths
alike it is `ward-duer`.

Source: Dür 2006, "An improved normalization for the Ward reflectance model"
"""

import numpy as np

from ..physics.geometry import Geometry
from ._grain import BY_WIDTHS, MEAN_AND_RATIO, TURNS, WIDTHS, slope_density, without_grain
from ._ward import GRAINED_EXTREMES, RHO_S, grained_from_facets, grained_gradient
from .model import Model, Pin, at


def brdf(geom: Geometry, *, rho_s, alpha_x, alpha_y, axis) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    return rho_s * slope_density(geom, alpha_x, alpha_y, axis) * (0.25 / geom.cos_cos)


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
            f=1.37312233610400674,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(75, 60),
            {"rho_s": 0.8, "alpha_x": 0.5, "alpha_y": 0.1, "axis": 1.1},
            f=2.44843247922747776,
            source="the same, toward grazing",
        ),
    ),
    extremes=GRAINED_EXTREMES,
    breaks={**TURNS, "energy": "1/(cos θi cos θr) sends more than 1 beyond 80°: 4.6 at 89° for widths 0.3 and 0.06"},
    summary="Ward-Dür with a grain; gains energy toward grazing: for published fits, else use ward-gmd-aniso",
    source="Dür 2006",
    family="Ward",
    cannot="sends back more light than it gets beyond 80°; the same reflectance at all angles; no mirror image",
    from_facets=grained_from_facets,
    grain=BY_WIDTHS,
)
