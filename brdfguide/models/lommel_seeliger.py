"""Lommel and Seeliger: a deep layer of dark grains that each scatter once and alike to all sides.

    f = w/(4π (cos θi + cos θr)),   w: the share of light that one grain scatters

Soil, dust, regolith, soot and other dark powders: no limb darkening at full phase, brighter toward grazing. Light
between grains is left out, so that powders above w = 0.5 or so are not followed, and shadows that hide toward the
light.

Source: Seeliger 1888 and Lommel 1889; in today's symbols Hapke 1981, "Bidirectional reflectance spectroscopy 1", with
an even phase function, no opposition effect and H = 1.
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, w) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return w / (4 * pi * geom.v_z)


MODEL = Model(
    __name__,
    brdf,
    roles=("subsurface",),
    parameters=(
        Parameter("w", 0.2, 0.0, 1.0, linear=True, per_channel=True, meaning="single-scattering albedo of a grain"),
    ),
    summary="soil, dust and other dark powders: grains that scatter once, brighter toward grazing from all sides",
    pins=(Pin(at(45, 50), {"w": 0.4}, f=0.023580354754857064, source="0.1/(π (cos 45° + cos 50°))"),),
    extremes=(Extreme("0.01° from grazing", at(89.99, 89.99), {"w": 1.0}, f=227.97266435260158),),
    source="Seeliger 1888; Lommel 1889",
    family="body",
    cannot="no highlight, no light between grains: bright powders are flatter",
    candidacy=Candidacy(15, under=(), bare=True),
    formula=Formula("lommel_seeliger(ci, cr, {w})", (("lommel_seeliger", "ci, cr, w", "w / (4.0 * PI * (ci + cr))"),)),
)
