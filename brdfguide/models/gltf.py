"""The material of glTF 2.0, metallic-roughness, with its extensions for index, specular, grain and clear coat.

    f = (1 - c Fc) ((1 - F) C (1 - metallic)/π + F D V) + c Fc Dc Vc,   alpha = roughness²
    F = F0 + (F90 - F0)(1 - cos θd)⁵,   F0 = mix(specular ((ior - 1)/(ior + 1))², C, metallic), F90 = mix(specular, 1,
    metallic)
    core: V of facets whose heights are not correlated; with a grain: alpha_t = alpha + (1 - alpha) strength² along
    `axis`, alpha across it, heights correlated
    coat: c = clearcoat, Fc Schlick's of 0.04 in cos θr

The text is followed: masking changes its form as the grain sets in. Viewers mostly have correlated heights in both.

Source: Khronos 2021, "glTF 2.0 specification", appendix B, and KHR_materials_ior, _specular, _anisotropy, _clearcoat.
"""

from math import pi

import numpy as np

from ..physics import fresnel, grain
from ..physics.geometry import Geometry
from ..physics.shader_optics import schlick
from ._grain import AXIS
from ._shader import METAL_WORD, coat_setting, grain_setting, in_shape_of, slider, starts
from .facts import Setting
from .model import Extreme, Model, Parameter, Pin, at

COAT_F0 = 0.04


def brdf(geom: Geometry, **values) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return in_shape_of(_layered(geom, **values), values)


def _layered(
    geom: Geometry,
    *,
    base_color,
    metallic,
    roughness,
    ior,
    specular,
    anisotropy_strength,
    axis,
    clearcoat,
    clearcoat_roughness,
) -> np.ndarray:
    f = _fresnel(geom.cos_d, base_color, metallic, ior, specular)
    base = (1 - f) * (base_color * (1 - metallic) / pi) + f * _lobe(
        geom, np.square(roughness), anisotropy_strength, axis
    )
    if not np.any(clearcoat):
        return base
    coat = clearcoat * schlick(geom.cos_r, COAT_F0)
    return (1 - coat) * base + coat * _lobe(geom, np.square(clearcoat_roughness), 0.0, axis)


def mirror(
    geom: Geometry, *, base_color, metallic, roughness, ior, specular, clearcoat, clearcoat_roughness, **_
) -> np.ndarray:
    """Reflectance of coat and base where their roughness is 0, dimensionless."""
    coat = clearcoat * schlick(geom.cos_i, COAT_F0)
    base = (1 - coat) * _fresnel(geom.cos_i, base_color, metallic, ior, specular)
    return np.where(np.equal(clearcoat_roughness, 0), coat, 0.0) + np.where(np.equal(roughness, 0), base, 0.0)


def _fresnel(cos_d, base_color, metallic, ior, specular):
    bare = specular * fresnel.f0(ior)
    return schlick(cos_d, bare + (base_color - bare) * metallic, specular + (1 - specular) * metallic)


def _lobe(geom: Geometry, alpha, strength, axis):
    """D V; 0 where alpha is 0 and the lobe is a mirror."""
    safe = np.where(np.equal(alpha, 0), 1.0, alpha)
    lobe = grain.grained_shape_uncorrelated(geom, safe, safe, 0.0)
    if np.any(strength):
        along = safe + (1 - safe) * np.square(strength)
        lobe = np.where(np.greater(strength, 0), grain.grained_shape(geom, along, safe, axis), lobe)
    return np.where(np.equal(alpha, 0), 0.0, lobe)


MODEL = Model(
    __name__,
    brdf,
    roles=("surface", "subsurface"),
    mirror=mirror,
    parameters=(
        slider("base_color", 0.5, per_channel=True, free=True, starts=(0.05, 0.3, 0.8), meaning="linear base colour"),
        slider("metallic", 0.0, meaning="0 or 1"),
        slider(
            "roughness",
            0.5,
            low=0.03,
            given_low=0.0,
            free=True,
            log=True,
            starts=(0.1, 0.2, 0.35, 0.55, 0.85),
            meaning="√alpha; 0: a mirror",
        ),
        Parameter(
            "ior", 1.5, 1.0001, 20.0, log=True, origin=1.0, given_low=1.0, meaning="index", starts=(1.2, 1.5, 2.5)
        ),
        slider("specular", 1.0, meaning="height of F on what is no metal"),
        slider("anisotropy_strength", 0.0, meaning="0: no grain"),
        AXIS,
        slider("clearcoat", 0.0, meaning="weight of a coat of index 1.5"),
        slider("clearcoat_roughness", 0.0, meaning="√alpha of the coat; 0: a mirror"),
    ),
    settings={
        METAL_WORD: Setting({"metallic": 1.0, "ior": 1.5}),
        **coat_setting({"clearcoat": 1.0}, ("clearcoat_roughness",), {"clearcoat_roughness": 0.1}),
        **grain_setting("anisotropy_strength"),
    },
    summary="glTF's metallic-roughness material: three.js, web viewers, Godot; its numbers fitted themselves",
    pins=(
        Pin(
            at(50.74, 37.85, phi_i=116.54, phi_r=296.54),
            {"base_color": 0.486, "roughness": 0.3},
            f=0.27472618659981607,
            source="table of reference values",
            rtol=1e-11,
        ),
        Pin(
            at(45.0, 48.0, phi_i=116.54, phi_r=296.54),
            {
                "base_color": 0.483,
                "metallic": 1.0,
                "roughness": 0.5,
                "anisotropy_strength": 0.8,
                "axis": np.radians(57.587),
            },
            f=0.39984125083557951,
            source="table of reference values",
            rtol=1e-11,
        ),
    ),
    extremes=(
        Extreme(
            "narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"roughness": 0.03, "anisotropy_strength": 1.0}
        ),
        Extreme("coat on its peak", at(30, 30), {"clearcoat": 1.0, "clearcoat_roughness": 0.1}),
    ),
    breaks={
        "reciprocity": "the coat's F is taken at θr alone",
        "rotation": "it has a grain, unless anisotropy_strength is 0",
        "energy": "what the lobe leaves is taken at θd and not at θr: 1.43 at grazing at worst",
        "continuity": "masking changes from uncorrelated to correlated heights as the grain sets in",
    },
    source="glTF 2.0 specification, appendix B",
    family="shader",
    cannot="F is Schlick's, without k and edge colour; light between facets is lost",
    from_facets=starts("roughness", "ior"),
)
