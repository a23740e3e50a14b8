"""Autodesk's Standard Surface, opaque: a clear coat over a metal, or over a lobe on a sheen on a body, with a grain.

    f = coat Fc Lc + (1 - coat Ec) mix(1, coat_color, coat) mix(specular specular_color F L + (1 - specular E) below,
        F(n, k) L, metalness)
    below = sheen S + (1 - sheen Es) base_color/π
    S = (2 + 1/r) sin^(1/r) δ/(8π (cos θi + cos θr - cos θi cos θr))
    L = D G/(4 cos θi cos θr) (1 + F (1 - E)/E), GGX;   alpha = specular_roughness², over and times √(1 - anisotropy)
    n, k of a metal from base_color and specular specular_color (Gulbrandsen 2014)

E is the albedo of a lobe as MaterialX has it, at θr; r is sheen_roughness, Es a ratio of polynomials. A body is
Lambert's; no transmission, subsurface or thin film.

Source: Georgiev et al. 2019, "Autodesk Standard Surface", as MaterialX 1.39 generates it; the masking with both widths.
"""

from math import pi

import numpy as np

from ..physics import fresnel, shader_optics
from ..physics.geometry import Geometry
from ..physics.shader_optics import albedo_terms, compensation, directional_albedo, lobe_shape
from ._grain import AXIS
from ._shader import METAL_WORD, coat_setting, grain_setting, in_shape_of, slider, starts
from .facts import Setting
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, **values) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return in_shape_of(_layered(geom, _metal, compensation, **values), values)


def single(geom: Geometry, **values) -> np.ndarray:
    """The same without light between facets."""
    return in_shape_of(_layered(geom, _metal, _nothing, **values), values)


def single_with_schlick(geom: Geometry, **values) -> np.ndarray:
    """The same without light between facets, a metal's F by Schlick from base_color: its edge colour is white."""
    return in_shape_of(_layered(geom, _schlick, _nothing, **values), values)


def _nothing(terms, reflectance):
    return 1.0


def _metal(cos_d, base_color, edge):
    return fresnel.fresnel(cos_d, *shader_optics.artistic_index(base_color, edge))


def _schlick(cos_d, base_color, edge):
    return shader_optics.schlick(cos_d, base_color)


def _layered(
    geom: Geometry,
    of_metal,
    more,
    *,
    base_color,
    metalness,
    specular,
    specular_color,
    specular_roughness,
    specular_anisotropy,
    axis,
    specular_ior,
    sheen,
    sheen_roughness,
    coat,
    coat_color,
    coat_roughness,
    coat_ior,
):
    alphas = widths(specular_roughness, specular_anisotropy)
    terms, shape = albedo_terms(geom.cos_r, np.sqrt(np.multiply(*alphas))), lobe_shape(geom, alphas, axis)
    body, metal = 0.0, 0.0  # what has no share is not evaluated
    if np.any(np.not_equal(metalness, 1)):
        f = fresnel.fresnel(geom.cos_d, specular_ior)
        factor = more(terms, f)
        left = 1 - specular * directional_albedo(terms, fresnel.f0(specular_ior)) * factor
        below = base_color / pi
        if np.any(sheen):
            below = (1 - sheen * _sheen_albedo(geom.cos_r, sheen_roughness)) * below
            below = below + sheen * _sheen(geom, sheen_roughness)
        body = specular * specular_color * f * factor * shape + left * below
    if np.any(metalness):
        f = of_metal(geom.cos_d, base_color, specular * specular_color)
        metal = f * more(terms, f) * shape
    base = body + (metal - body) * metalness
    if not np.any(coat):
        return base
    wide = np.square(coat_roughness)
    terms, f = albedo_terms(geom.cos_r, wide), fresnel.fresnel(geom.cos_d, coat_ior)
    factor = more(terms, f)
    left = 1 - coat * directional_albedo(terms, fresnel.f0(coat_ior)) * factor
    on_top = coat * f * factor * lobe_shape(geom, (wide, wide), 0.0)
    return on_top + left * (1 + (coat_color - 1) * coat) * base


def mirror(
    geom: Geometry,
    *,
    base_color,
    metalness,
    specular,
    specular_color,
    specular_roughness,
    specular_ior,
    coat,
    coat_color,
    coat_roughness,
    coat_ior,
    **_,
) -> np.ndarray:
    """Reflectance of coat and base where their roughness is 0, dimensionless."""
    on_top = coat * fresnel.fresnel(geom.cos_i, coat_ior)
    bare = specular * specular_color * fresnel.fresnel(geom.cos_i, specular_ior)
    base = bare + (_metal(geom.cos_i, base_color, specular * specular_color) - bare) * metalness
    base = (1 - on_top) * (1 + (coat_color - 1) * coat) * base
    return np.where(np.equal(coat_roughness, 0), on_top, 0.0) + np.where(np.equal(specular_roughness, 0), base, 0.0)


def widths(roughness, anisotropy):
    """alpha across and along the grain."""
    aspect = np.sqrt(1 - np.minimum(anisotropy, 0.98))
    square = np.square(roughness)
    return np.minimum(1.0, square / aspect), square * aspect


def _sheen(geom: Geometry, roughness):
    """Lobe of fibres that stand up, highest where the half vector lies in the surface (Conty and Kulla 2017) [1/sr]."""
    power = 1 / np.maximum(roughness, 0.005)
    sin2_h = geom.tan2_h / geom.sec2_h
    density = (2 + power) * sin2_h ** (0.5 * power) / (2 * pi)
    return density / (4 * (geom.cos_i + geom.cos_r - geom.cos_cos))


def _sheen_albedo(x, y):
    """MaterialX's ratio of polynomials for the albedo of the sheen."""
    above = 13.673 - 68.78018 * x + 799.08825 * y - 905.00061 * x * y + 60.28956 * x * x + 1086.96473 * y * y
    below = 1.0 + 61.57746 * x + 442.78211 * y + 2597.49308 * x * y + 121.81241 * x * x + 3045.55075 * y * y
    return np.clip(above / below, 0.0, 1.0)


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    mirror=mirror,
    parameters=(
        slider("base_color", 0.5, per_channel=True, free=True, starts=(0.05, 0.3, 0.8), meaning="linear base colour"),
        slider("metalness", 0.0, meaning="0 or 1"),
        slider("specular", 1.0, meaning="weight of the lobe over a body"),
        slider("specular_color", 1.0, per_channel=True, starts=(0.2, 0.8), meaning="a metal's edge colour"),
        slider(
            "specular_roughness",
            0.2,
            low=0.04,
            given_low=0.0,
            free=True,
            log=True,
            starts=(0.1, 0.2, 0.35, 0.55, 0.85),
            meaning="√alpha; 0: a mirror",
        ),
        slider("specular_anisotropy", 0.0, meaning="0: no grain"),
        AXIS,
        Parameter("specular_ior", 1.5, 1.0001, 3.0, log=True, origin=1.0, given_low=1.0, starts=(1.2, 1.5, 2.2)),
        slider("sheen", 0.0, meaning="weight of cloth's rise at grazing"),
        slider("sheen_roughness", 0.3, low=0.05, meaning="width of the sheen"),
        slider("coat", 0.0, meaning="weight of the coat"),
        slider("coat_color", 1.0, per_channel=True, meaning="what the coat lets through"),
        slider("coat_roughness", 0.1, meaning="√alpha of the coat; 0: a mirror"),
        Parameter("coat_ior", 1.5, 1.0001, 3.0, free=False, given_low=1.0, meaning="index of the coat"),
    ),
    settings={
        METAL_WORD: Setting({"metalness": 1.0, "specular_ior": 1.5}),
        **coat_setting({"coat": 1.0}, ("coat_roughness",), {"coat_roughness": 0.1}),
        **grain_setting("specular_anisotropy"),
    },
    without={"multiple": single, "multiple+fresnel": single_with_schlick},
    summary="Standard Surface of Arnold and others, as MaterialX generates it: its numbers fitted themselves",
    pins=(
        Pin(
            at(45, 50),
            {
                "base_color": 0.6,
                "specular": 0.8,
                "specular_color": 0.9,
                "specular_roughness": 0.35,
                "specular_ior": 1.7,
                "sheen": 0.4,
                "sheen_roughness": 0.25,
                "coat": 0.7,
                "coat_color": 0.8,
                "coat_roughness": 0.2,
                "coat_ior": 1.6,
            },
            f=1.6758751615275159776,
            source="50 digits",
        ),
        Pin(
            at(40, 47, phi_i=20, phi_r=195),
            {
                "base_color": 0.8,
                "metalness": 1.0,
                "specular": 0.9,
                "specular_color": 0.7,
                "specular_roughness": 0.45,
                "specular_anisotropy": 0.6,
                "axis": 0.4,
            },
            f=2.2490497261564762755,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"specular_roughness": 0.04}),
        Extreme("sheen, light from where it is seen", at(80, -80), {"sheen": 1.0}),
    ),
    breaks={
        "energy": "what lobe and sheen leave are fits at θr: 1.55 at grazing at worst, with all of both",
        "reciprocity": "what a lobe leaves is taken at θr alone",
        "rotation": "it has a grain, unless specular_anisotropy is 0",
    },
    source="Georgiev et al. 2019; MaterialX 1.39",
    family="shader",
    cannot="no transmission, subsurface or thin film here",
    from_facets=starts("specular_roughness", "specular_ior", 3.0),
)
