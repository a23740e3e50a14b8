"""Ashikhmin and Shirley's lobe with a grain about the half vector, with Schlick's Fresnel factor and their own body.

    f = √((nx+1)(ny+1))/(8π) cos^(nx c² + ny s²) δ F/(cos θd max(cos θi, cos θr))
        + 28 r_d/(23π) (1 - r_s)(1 - (1 - ½cos θi)⁵)(1 - (1 - ½cos θr)⁵)
    F = r_s + (1 - r_s)(1 - cos θd)⁵,   c² = v_x²/(v_x² + v_y²), s² = 1 - c², v = i + r,   δ from normal to half vector

v in the frame of `axis`. The streak lies along the axis of the smaller exponent: `exponent_x`, along `axis`, is the
smaller one where `axis` lies across the grain. An exponent n is about as wide as facets of alpha = √(2/(n + 2)). The
light that the surface sends on is missing from the body, so r_s stands in both. Its lobe sends back 0.96, 0.85, 0.66,
0.52 of the light at 0, 60, 80, 89° for n = 100 and F = 1; at cos θi = cos θr it has a crease. Ray tracers and old
scene files know it.

Source: Ashikhmin and Shirley 2000, "An anisotropic Phong BRDF model".
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from ._grain import AXIS, TURNS
from .facts import Grain
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, exponent_x, exponent_y, axis, r_s, r_d) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return lobe(geom, exponent_x, exponent_y, axis, r_s) + body(geom, r_s, r_d)


def lobe(geom: Geometry, exponent_x, exponent_y, axis, r_s):
    """What the surface reflects [1/sr]."""
    return _shape(geom, exponent_x, exponent_y, axis) * (r_s + (1 - r_s) * _edge(geom))


def body(geom: Geometry, r_s, r_d):
    """What comes from below it [1/sr]."""
    return 28 / (23 * pi) * r_d * (1 - r_s) * _dims(geom.cos_i) * _dims(geom.cos_r)


def _dims(cos):
    """1 - (1 - cos/2)⁵, without a difference of numbers near 1: x (5 - 10x + 10x² - 5x³ + x⁴), x = cos/2."""
    x = 0.5 * cos
    return x * (5 + x * (-10 + x * (10 + x * (-5 + x))))


def _edge(geom: Geometry):
    """Schlick's (1 - cos θd)⁵."""
    return (1 - geom.cos_d) ** 5


def _shape(geom: Geometry, exponent_x, exponent_y, axis):
    """The lobe at F = 1."""
    along, _ = _shares(geom, axis)
    power = np.exp(-0.5 * (exponent_y + (exponent_x - exponent_y) * along) * geom.ln_sec2_h)
    height = np.sqrt((exponent_x + 1) * (exponent_y + 1)) / (8 * pi)
    return height * power / (geom.cos_d * np.maximum(geom.cos_i, geom.cos_r))


def _shares(geom: Geometry, axis):
    """c² and c s; both 0 in the mirror direction, where no exponent counts."""
    x, y = geom.offset_from(axis)
    square = x * x + y * y
    size = np.where(square > 0, square, 1.0)
    return x * x / size, x * y / size


def gradient(geom: Geometry, names, *, exponent_x, exponent_y, axis, r_s, r_d) -> dict[str, np.ndarray]:
    """d ln shape/dnx = 1/(2 (nx + 1)) - c² L/2, as by ny; by the axis -(nx - ny) c s L; L = ln(1 + tan²δ)."""
    shape, edge = _shape(geom, exponent_x, exponent_y, axis), _edge(geom)
    along, both = _shares(geom, axis)
    reflected = shape * (r_s + (1 - r_s) * edge)
    below = body(geom, 0.0, 1.0)
    return {
        "exponent_x": reflected * 0.5 * (1 / (exponent_x + 1) - along * geom.ln_sec2_h),
        "exponent_y": reflected * 0.5 * (1 / (exponent_y + 1) - (1 - along) * geom.ln_sec2_h),
        "axis": reflected * (exponent_y - exponent_x) * both * geom.ln_sec2_h,
        "r_s": shape * (1 - edge) - r_d * below,
        "r_d": (1 - r_s) * below,
    }


def _exponent(name: str, meaning: str) -> Parameter:
    return Parameter(name, 50.0, 0.3, 1e6, log=True, given_low=0.0, meaning=meaning, starts=(4.0, 40.0, 400.0, 4000.0))


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        _exponent("exponent_x", "n along `axis`, across the grain; the smaller, the wider"),
        _exponent("exponent_y", "n along the grain"),
        AXIS,
        Parameter(
            "r_s",
            0.05,
            0.0,
            1.0,
            per_channel=True,
            meaning="reflectance of the surface at normal incidence",
            starts=(0.04, 0.4, 0.9),
        ),
        Parameter(
            "r_d",
            0.3,
            0.0,
            1.0,
            per_channel=True,
            meaning="share of the light below it that comes back",
            starts=(0.02, 0.4),
        ),
    ),
    gradient=gradient,
    pins=(
        Pin(
            at(45.0, 50.0, phi_i=20.0, phi_r=195.0),
            {"exponent_x": 20.0, "exponent_y": 300.0, "axis": 0.4, "r_s": 0.3, "r_d": 0.4},
            f=1.40721992138466341,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(75, 60),
            {"exponent_x": 6.0, "exponent_y": 100.0, "axis": 1.1, "r_s": 0.8, "r_d": 0.1},
            f=2.26447415756433043,
            source="the same, toward grazing",
        ),
    ),
    extremes=(
        Extreme("the mirror direction, where no azimuth counts", at(30, 30), {"exponent_x": 1e6, "exponent_y": 1e6}),
        Extreme("no exponent at all, 0.01° from grazing", at(89.99, 89.99), {"exponent_x": 0.0}),
        Extreme("lobe underflows far from the mirror", at(10, -80), {"exponent_x": 1e6, "exponent_y": 1e6}),
    ),
    breaks=TURNS,
    summary="half-vector lobe of two exponents over its own body: old scene files; loses light toward grazing",
    source="Ashikhmin and Shirley 2000",
    family="facets",
    cannot="half of the light is missing at grazing; shows no mirror image",
    from_facets=lambda facets: {
        "exponent_x": facets.half_exponent,
        "exponent_y": facets.half_exponent,
        "r_s": facets.f0,
        **({"r_d": facets.albedo} if facets.albedo is not None else {"r_d": 0.0}),
    },
    grain=Grain(
        "exponent_x",
        "exponent_y",
        widths=lambda first, second: ((2 / (first + 2)) ** 0.5, (2 / (second + 2)) ** 0.5),
        values=lambda wide, narrow: (2 / (wide * wide) - 2, 2 / (narrow * narrow) - 2),
        by_ln_widths=lambda first, second: ((-2 * (first + 2), 0.0), (0.0, -2 * (second + 2))),
    ),
)
