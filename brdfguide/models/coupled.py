"""A diffuse body under a smooth interface: light enters and leaves through Fresnel's gate.

    f = albedo · 21/(20π) (1 - (1 - cos θi)⁵) (1 - (1 - cos θr)⁵)

The factors are what Schlick's interface lets through, F0 taken into the albedo; 21/20 makes a body of albedo 1 send
back all it gets at normal incidence. Darkens toward grazing, where the interface sends the light elsewhere: plastics,
varnish, glazes. Without its coupling it is Lambert's law.

Source: Shirley, Hu, Smits and Lafortune 1997, "A practitioners' assessment of light reflection models", section 3.
"""

from math import pi

import numpy as np

from ..formed import formed
from ..physics.geometry import Directions, Geometry
from .facts import Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, albedo) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return (albedo * (21 / (20 * pi))) * _both(geom)


@formed
def _both(to: Directions) -> np.ndarray:
    """In and out again."""
    return through(to.cos_i) * through(to.cos_r)


def through(cos) -> np.ndarray:
    """1 - (1 - cos)⁵, without the difference: x (5 - 10x + 10x² - 5x³ + x⁴)."""
    return cos * (5 - cos * (10 - cos * (10 - cos * (5 - cos))))


def uncoupled(geom: Geometry, *, albedo) -> np.ndarray:
    """Lambert's law, the same at all angles: enough where neither light nor eye is low."""
    return np.broadcast_to(albedo / pi, np.broadcast_shapes(geom.shape, np.shape(albedo)))


MODEL = Model(
    __name__,
    brdf,
    roles=("subsurface",),
    parameters=(
        Parameter(
            "albedo", 0.5, 0.0, 1.0, linear=True, per_channel=True, meaning="light sent back at normal incidence"
        ),
    ),
    without={"coupling": uncoupled},
    summary="diffuse body that darkens toward grazing under its interface: plastic, varnish",
    pins=(
        Pin(at(60, -20), {"albedo": 0.4}, f=0.129512231626022307, source="the formula above at 50 digits"),
        Pin(at(89.0, 85.0), {"albedo": 0.4}, f=0.00412506578712861625, source="the formula above at 50 digits"),
    ),
    extremes=(Extreme("both 0.0001° from grazing", at(89.9999, 89.9999), {"albedo": 1.0}),),
    source="Shirley et al. 1997",
    family="body",
    cannot="no highlight: that takes a second term",
    formula=Formula(
        "coupled(ci, cr, {albedo})",
        (
            ("through", "x", "x * (5.0 - x * (10.0 - x * (10.0 - x * (5.0 - x))))"),
            ("coupled", "ci, cr, albedo", "albedo * 1.05 / PI * through(ci) * through(cr)"),
        ),
    ),
)
