"""Unreal's default lit shader, with its grain, and its clear coat shader over the same base.

    f = base (1 - metallic)/π + F D V,   alpha = roughness²,   F Schlick's from mix(0.08 specular, base, metallic) to
    min(50 F0, 1)
    V = ½/(cos θr (cos θi (1 - alpha) + alpha) + cos θi (cos θr (1 - alpha) + alpha))
    grain: alpha (1 + anisotropy) along the tangent, alpha (1 - anisotropy) across it, V of correlated heights
    coat c: + c Fc D V with F0 = 0.04; the base, with c = 1, by (1 - Fc)² T cos θi'/cos θi, in which cosines become
    cos θ' = ⅔ cos θ - b cos δ, d' = ⅔ d - b, b = (0.63 - 0.22 d) d - 0.745: refraction at the half vector, d = cos θd
    T = (base/π)^((1/cos θi' + 1/cos θr')/2 - 1) of a metal, 1 of a dielectric

Unreal's grain under a coat is left out: no surface here asks for both. A roughness of 0 is a mirror here; Unreal holds
it at 0.02, a width of a hundredth of a degree.

Source: Karis 2013, "Real shading in Unreal Engine 4", Lagarde and de Rousiers 2014 for V, Kulla and Conty 2017 for the
widths, and the engine's published shader files for the clear coat.
"""

from math import pi

import numpy as np

from ..models import term
from ..models.facts import Setting
from ..models.model import Model, Parameter
from ..physics import grain
from ..physics.geometry import Geometry
from ..physics.microfacet import ggx
from ..physics.shader_optics import schlick
from ._nodes import Node

AXIS = term("gltf").parameter("axis")
COAT_F0 = 0.04
NARROWEST = 0.001  # alpha
BASE = Parameter("base_color", 0.5, 0.0, 1.0, per_channel=True, starts=(0.05, 0.3, 0.8))
METALLIC = Parameter("metallic", 0.0, 0.0, 1.0, free=False)
ROUGHNESS = Parameter("roughness", 0.5, 0.04, 1.0, log=True, given_low=0.0, starts=(0.1, 0.2, 0.35, 0.55, 0.85))
SPECULAR = Parameter("specular", 0.5, 0.0, 1.0, starts=(0.2, 0.5, 1.0))
GRAIN = Parameter("anisotropy", 0.0, 0.0, 0.99, free=False, starts=(0.3, 0.7))
COAT = Parameter("clear_coat", 0.0, 0.0, 1.0, free=False)
COAT_ROUGHNESS = Parameter("clear_coat_roughness", 0.0, 0.0, 1.0, free=False)


def _brdf(
    geom: Geometry, *, base_color, metallic, roughness, specular, anisotropy, axis, clear_coat, clear_coat_roughness
) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    alpha = np.square(roughness)
    body = base_color * (1 - metallic) / pi
    bare = body + _fresnel(geom.cos_d, base_color, metallic, specular) * _lobe(geom, alpha, anisotropy, axis)
    if not np.any(clear_coat):
        return bare
    blend = (0.63 - 0.22 * geom.cos_d) * geom.cos_d - 0.745
    i, r = (np.clip(cos / 1.5 - blend / np.sqrt(geom.sec2_h), 0.001, 1.0) for cos in (geom.cos_i, geom.cos_r))
    f = _fresnel(np.clip(geom.cos_d / 1.5 - blend, 0.0, 1.0), base_color, metallic, specular)
    lobe = f * _density(geom, alpha) * _visible(i, r, alpha)
    through = (1 - schlick(geom.cos_d, COAT_F0)) ** 2 * i / geom.cos_i * _absorbed(i, r, base_color, metallic)
    base = (body + lobe) * (1 + clear_coat * (through - 1))
    coat_alpha = np.square(clear_coat_roughness)
    coat = schlick(geom.cos_d, COAT_F0) * _density(geom, coat_alpha) * _visible(geom.cos_i, geom.cos_r, coat_alpha)
    return np.where(np.greater(clear_coat, 0), base + clear_coat * coat, bare)


def _mirror(geom: Geometry, *, base_color, metallic, roughness, specular, clear_coat, clear_coat_roughness, **_):
    """Reflectance of coat and base where their roughness is 0, dimensionless."""
    coat = schlick(geom.cos_i, COAT_F0)
    base = _fresnel(geom.cos_i, base_color, metallic, specular) * (1 + clear_coat * ((1 - coat) ** 2 - 1))
    return np.where(np.equal(roughness, 0), base, 0.0) + np.where(
        np.equal(clear_coat_roughness, 0), clear_coat * coat, 0.0
    )


def _fresnel(cos_d, base_color, metallic, specular):
    bare = 0.08 * specular
    f0 = bare + (base_color - bare) * metallic
    return schlick(cos_d, f0, np.minimum(50 * f0, 1.0))


def _lobe(geom: Geometry, alpha, anisotropy, axis):
    """D V; 0 where alpha is 0 and the lobe is a mirror."""
    plain = _density(geom, alpha) * _visible(geom.cos_i, geom.cos_r, alpha)
    if not np.any(anisotropy):
        return plain
    along, across = (np.maximum(alpha * (1 + sign * anisotropy), NARROWEST) for sign in (1, -1))
    return np.where(np.greater(anisotropy, 0), grain.grained_shape(geom, along, across, axis), plain)


def _density(geom: Geometry, alpha):
    flat = np.equal(alpha, 0)
    return np.where(flat, 0.0, ggx(geom, np.where(flat, 1.0, alpha)))


def _visible(i, r, alpha):
    return 0.5 / (r * (i * (1 - alpha) + alpha) + i * (r * (1 - alpha) + alpha))


def _absorbed(i, r, base_color, metallic):
    """What a metal's coat lets through on the way that is longer than there and back at the normal."""
    longer = np.maximum(1 / i + 1 / r - 2, 0.0) / 2
    return 1 + metallic * (np.maximum(base_color / pi, 1e-4) ** longer - 1)


LAW = Model(
    "unreal",
    _brdf,
    (BASE, METALLIC, ROUGHNESS, SPECULAR, GRAIN, AXIS, COAT, COAT_ROUGHNESS),
    roles=("surface", "subsurface"),
    mirror=_mirror,
    settings={"metal": Setting({"metallic": 1.0})},
    breaks={"rotation": "it has a grain, unless anisotropy is 0"},
)
NODE = Node(
    law=LAW,
    roughness="roughness",
    metalness="metallic",
    index="specular",
    weight="",
    edge="",
    coat="clear_coat",
    coat_roughness="clear_coat_roughness",
    coat_index="",
    matt={"specular": 0.0},
    by_schlick=True,
    grain="anisotropy",
    lacks={
        "lobe": "its coat darkens a metal the longer the way through it is, as if it were tinted",
        "coat": "its coat refracts light at the half vector, and darkens a metal below as if it were tinted",
    },
)
