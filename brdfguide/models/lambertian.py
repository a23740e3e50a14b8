"""Lambert's ideal diffuser: the same in all directions.

    f = albedo / π

What scatters below the surface of solid paints, plastics and paper, to first order (Westin et al. 2004,
sections 3.2.3 and 5.2). Metals and black dielectrics have none.

Source: Lambert 1760, "Photometria".
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, albedo) -> np.ndarray:
    """Constant [1/sr], in the shape of `geom`."""
    return np.ones_like(geom.cos_i) * (albedo / pi)


MODEL = Model(
    __name__,
    brdf,
    roles=("subsurface",),
    parameters=(
        Parameter("albedo", 0.5, 0.0, 1.0, linear=True, per_channel=True, meaning="share of the light scattered back"),
    ),
    summary="constant in all directions: solid colours below a surface; no highlight, no rise toward grazing",
    pins=(Pin(at(45, 50), {"albedo": 0.75}, f=0.238732414637843, source="0.75/π"),),
    extremes=(Extreme("0.01° from grazing", at(89.99, 89.99), {"albedo": 1.0}, f=0.3183098861837907),),
    source="Lambert 1760",
    family="body",
    cannot="no highlight: it looks equally bright from everywhere",
    candidacy=Candidacy(10, bare=True),
    formula=Formula("lambertian({albedo})", (("lambertian", "albedo", "albedo / PI"),)),
)
