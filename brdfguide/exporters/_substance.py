"""Substance Painter's shader of Adobe's Standard Material, metallic and roughness, with its grain and its coat.

    f = base (1 - metallic)/π + F D V + coat Fc D V,   alpha = roughness²
    F = F82 from mix(0.08 specular_level, base, metallic) with the edge colour, of a metal; Schlick's of a dielectric
    V = ¼/((cos θi (1 - k) + k)(cos θr (1 - k) + k)),   k = alpha/2
    grain: min(1, alpha + anisotropy_level⁴) along the tangent, alpha across it, V of GGX with uncorrelated heights
    coat: Fc Schlick's from ((coat_ior - 1)/(coat_ior + 1))²; where it lies, the base's F0 is that of its index, 1.5,
    against the coat's; a clear coat takes nothing else from the base

The coat's specular level is held at 0.5, its colour at white. Unreal has the same base with another V, other widths and
a coat that dims what lies below.

Source: Adobe, "Substance 3D Painter shader API", asm-metal-rough and the libraries pbr, pbr-aniso, coat and sampler.
"""

from math import pi

import numpy as np

from ..models.facts import Setting
from ..models.model import Model, Parameter
from ..physics import fresnel, grain
from ..physics.geometry import Geometry
from ..physics.microfacet import ggx
from ..physics.shader_optics import f82, schlick
from ._nodes import Node
from ._unreal import AXIS, BASE, METALLIC, ROUGHNESS

IOR = 1.5  # of the base: a setting of the shader, not of a texture
LEVEL = Parameter("specular_level", 0.5, 0.0, 1.0, starts=(0.2, 0.5, 1.0))
EDGE = Parameter("specular_edge_color", 1.0, 0.0, 1.0, per_channel=True, free=False, starts=(0.5, 1.0))
GRAIN = Parameter("anisotropy_level", 0.0, 0.0, 1.0, free=False, starts=(0.4, 0.8))
COAT = Parameter("coat_opacity", 0.0, 0.0, 1.0, free=False)
COAT_ROUGHNESS = Parameter("coat_roughness", 0.0, 0.0, 1.0, free=False)
COAT_IOR = Parameter("coat_ior", 1.6, 1.0001, 3.0, log=True, origin=1.0, given_low=1.0, free=False, starts=(1.4, 1.7))


def _brdf(
    geom: Geometry,
    *,
    base_color,
    metallic,
    roughness,
    specular_level,
    specular_edge_color,
    anisotropy_level,
    axis,
    coat_opacity,
    coat_roughness,
    coat_ior,
) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    f0 = _f0(base_color, metallic, specular_level, coat_opacity, coat_ior)
    f = _fresnel(geom.cos_d, f0, specular_edge_color, metallic)
    base = base_color * (1 - metallic) / pi + f * _lobe(geom, np.square(roughness), anisotropy_level, axis)
    if not np.any(coat_opacity):
        return base
    coat = coat_opacity * schlick(geom.cos_d, fresnel.f0(coat_ior))
    return base + coat * _lobe(geom, np.square(coat_roughness), 0.0, axis)


def _mirror(
    geom: Geometry,
    *,
    base_color,
    metallic,
    roughness,
    specular_level,
    specular_edge_color,
    coat_opacity,
    coat_roughness,
    coat_ior,
    **_,
):
    """Reflectance of coat and base where their roughness is 0, dimensionless."""
    f0 = _f0(base_color, metallic, specular_level, coat_opacity, coat_ior)
    base = _fresnel(geom.cos_i, f0, specular_edge_color, metallic)
    coat = coat_opacity * schlick(geom.cos_i, fresnel.f0(coat_ior))
    return np.where(np.equal(roughness, 0), base, 0.0) + np.where(np.equal(coat_roughness, 0), coat, 0.0)


def _f0(base_color, metallic, specular_level, coat_opacity, coat_ior):
    bare, under = fresnel.f0(IOR), ((IOR - coat_ior) / (IOR + coat_ior)) ** 2
    dielectric = 2 * specular_level * (bare + (under - bare) * coat_opacity)
    return dielectric + (base_color - dielectric) * metallic


def _fresnel(cos_d, f0, edge, metallic):
    return np.clip(f82(cos_d, f0, 1 + (edge - 1) * metallic), 0.0, 1.0)


def _lobe(geom: Geometry, alpha, level, axis):
    """D V; 0 where alpha is 0 and the lobe is a mirror."""
    flat = np.equal(alpha, 0)
    safe = np.where(flat, 1.0, alpha)
    k = safe / 2
    masking = (geom.cos_i * (1 - k) + k) * (geom.cos_r * (1 - k) + k)
    plain = np.where(flat, 0.0, ggx(geom, safe) / (4 * masking))
    if not np.any(level):
        return plain
    along = np.minimum(1.0, safe + np.asarray(level) ** 4)
    return np.where(np.greater(level, 0), grain.grained_shape_uncorrelated(geom, along, safe, axis), plain)


LAW = Model(
    "substance",
    _brdf,
    (BASE, METALLIC, ROUGHNESS, LEVEL, EDGE, GRAIN, AXIS, COAT, COAT_ROUGHNESS, COAT_IOR),
    roles=("surface", "subsurface"),
    mirror=_mirror,
    settings={"metal": Setting({"metallic": 1.0})},
    breaks={"rotation": "it has a grain, unless anisotropy_level is 0"},
)
NODE = Node(
    law=LAW,
    roughness="roughness",
    metalness="metallic",
    index="specular_level",
    weight="",
    edge="specular_edge_color",
    coat="coat_opacity",
    coat_roughness="coat_roughness",
    coat_index="coat_ior",
    matt={"specular_level": 0.0},
    by_schlick=True,
    grain="anisotropy_level",
    lacks={"coat": "its coat takes nothing from what lies below"},
)
