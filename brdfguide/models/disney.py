"""Disney's principled shader as published in 2012: a body, a sheen, a lobe of grained facets and a clear coat.

    f = (C/π mix(Fd, S, subsurface) + sheen s(d) mix(1, tint, sheen_tint))(1 - metallic) + F D V + coat
    Fd = (1 + (F90 - 1) s(θi))(1 + (F90 - 1) s(θr)), F90 = ½ + 2 d² roughness,   s(c) = (1 - c)⁵,   d = cos θd
    S = 5/4 (Fs (1/(cos θi + cos θr) - ½) + ½),   Fs as Fd with F90 = d² roughness
    F = mix(F0, 1, s(d)),   F0 = mix(0.08 specular mix(1, tint, specular_tint), C, metallic)
    alpha = roughness²/√(1 - 0.9 anisotropic) across and times its square along the grain, D and V as GGX, uncorrelated
    coat = ¼ clearcoat mix(0.04, 1, s(d)) D1 G,   D1 = (a² - 1)/(π ln a² (1 + (a² - 1) cos²δ)),   a = 0.1..0.001

C is the linear base colour; tint is C over its luminance, 1 for grey, a number of its own here since one channel does
not know the others. The published file masks with the lobe's own widths, the course's text with (½ + roughness/2)²;
this is the file. The variants of 2015 and of other programs of this name are other laws. Sends more than it gets.

Source: Burley 2012, "Physically based shading at Disney", and the BRDF Explorer's file of it.
"""

from math import pi

import numpy as np

from ..physics import grain
from ..physics.geometry import Geometry
from ..physics.shader_optics import schlick
from ._grain import AXIS
from ._shader import METAL_WORD, coat_setting, grain_setting, slider, starts
from .facts import Setting
from .model import Extreme, Model, Pin, at

NARROWEST = 0.001  # alpha that the file clamps to


def brdf(
    geom: Geometry,
    *,
    base_color,
    metallic,
    subsurface,
    specular,
    roughness,
    specular_tint,
    anisotropic,
    axis,
    sheen,
    sheen_tint,
    clearcoat,
    clearcoat_gloss,
    tint,
) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    below = base_color / pi * _mix(_diffuse(geom, roughness), _flat(geom, roughness), subsurface)
    below = below + _edge(geom.cos_d) * sheen * _mix(1.0, tint, sheen_tint)
    f0 = _mix(0.08 * specular * _mix(1.0, tint, specular_tint), base_color, metallic)
    alpha_x, alpha_y = widths(roughness, anisotropic)
    lobe = schlick(geom.cos_d, f0) * grain.grained_shape_uncorrelated(geom, alpha_x, alpha_y, axis)
    return (1 - metallic) * below + lobe + _coat(geom, clearcoat, clearcoat_gloss)


def widths(roughness, anisotropic):
    """alpha across and along the grain."""
    aspect = np.sqrt(1 - 0.9 * anisotropic)
    square = np.square(roughness)
    return np.maximum(NARROWEST, square / aspect), np.maximum(NARROWEST, square * aspect)


def _mix(a, b, share):
    return a + (b - a) * share


def _edge(cos):
    return (1 - cos) ** 5


def _diffuse(geom: Geometry, roughness):
    """Fd: grazing light is sent back more by rough bodies and less by smooth ones."""
    rise = 2 * geom.cos_d**2 * roughness - 0.5
    return (1 + rise * _edge(geom.cos_i)) * (1 + rise * _edge(geom.cos_r))


def _flat(geom: Geometry, roughness):
    """S: the shape of light that went far below the surface (Hanrahan and Krueger)."""
    rise = geom.cos_d**2 * roughness - 1
    both = (1 + rise * _edge(geom.cos_i)) * (1 + rise * _edge(geom.cos_r))
    return 1.25 * (both * (1 / (geom.cos_i + geom.cos_r) - 0.5) + 0.5)


def _coat(geom: Geometry, clearcoat, gloss):
    """GTR of exponent 1 with the masking of alpha 0.25."""
    a2 = np.square(_mix(0.1, 0.001, gloss))
    # 1 + (a² - 1) cos²δ = (a² + tan²δ) cos²δ
    density = (a2 - 1) / (pi * np.log(a2)) * geom.sec2_h / (a2 + geom.tan2_h)
    masking = _mask(geom.cos_i) * _mask(geom.cos_r)
    return 0.25 * clearcoat * schlick(geom.cos_d, 0.04) * density * masking


def _mask(cos):
    return 1 / (cos + np.sqrt(0.0625 + (1 - 0.0625) * cos * cos))


ROW = "the formula above, table of reference values"

MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    parameters=(
        slider("base_color", 0.5, per_channel=True, free=True, starts=(0.05, 0.3, 0.8), meaning="linear base colour"),
        slider("metallic", 0.0, meaning="0 or 1"),
        slider("subsurface", 0.0, meaning="share of the flat body"),
        slider("specular", 0.5, free=True, starts=(0.25, 0.75), meaning="F0/0.08 of what is no metal"),
        slider("roughness", 0.5, low=0.03, free=True, log=True, starts=(0.1, 0.2, 0.35, 0.55, 0.85), meaning="√alpha"),
        slider("specular_tint", 0.0, meaning="of the lobe toward the base colour"),
        slider("anisotropic", 0.0, meaning="0: no grain"),
        AXIS,
        slider("sheen", 0.0, meaning="cloth's rise at grazing"),
        slider("sheen_tint", 0.5, meaning="of the sheen toward the base colour"),
        slider("clearcoat", 0.0, meaning="a second lobe, a quarter of it at 1"),
        slider("clearcoat_gloss", 1.0, meaning="0: satin, 1: gloss"),
        slider("tint", 1.0, high=10.0, per_channel=True, meaning="base colour over its luminance .3 R + .6 G + .1 B"),
    ),
    settings={
        METAL_WORD: Setting({"metallic": 1.0, "specular": 0.5}),
        **coat_setting({}, ("clearcoat", "clearcoat_gloss"), {"clearcoat": 0.5, "clearcoat_gloss": 0.7}),
        **grain_setting("anisotropic"),
    },
    summary="Disney's principled shader of 2012: its sliders fitted themselves",
    pins=(
        Pin(
            at(45.0, 48.0, phi_i=108.97, phi_r=288.97),
            {"base_color": 0.189, "metallic": 1.0, "roughness": 0.35, "anisotropic": 0.8, "axis": np.radians(10.725)},
            f=1.5913617624239287,
            source=ROW,
        ),
    ),
    extremes=(
        Extreme("longest streak, 0.01° from grazing", at(89.99, 89.99), {"roughness": 0.03, "anisotropic": 1.0}),
        Extreme("smoothest coat, on its peak", at(30, 30), {"clearcoat": 1.0, "clearcoat_gloss": 1.0}),
    ),
    breaks={
        "energy": "body and lobe are added: 1.16 at 89° for roughness 0.5 and white, up to 1.57 for 1",
        "rotation": "it has a grain, unless anisotropic is 0",
    },
    source="Burley 2012",
    family="shader",
    cannot="its energy is not bounded; F is Schlick's, without k",
    from_facets=starts("roughness"),
)
