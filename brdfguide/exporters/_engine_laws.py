"""The shaders of programs for which no file is written, as those programs evaluate them.

    alpha = roughness² in all;   F0 = 0.08 specular where there is a specular
    Unreal      base (1 - metallic)/π + F D V,  F Schlick's from mix(0.08 specular, base, metallic) to min(50 F0, 1)
                V = ½/(cos θr (cos θi (1 - alpha) + alpha) + cos θi (cos θr (1 - alpha) + alpha))
    Mitsuba     `principled`: base (1 - metallic)/π (Disney's body of 2015) + F D G/(4 cos θi cos θr), uncorrelated,
                F of the index where it is no metal, Schlick's from the base colour where it is

Source: Karis 2013, "Real shading in Unreal Engine 4", and Lagarde and de Rousiers 2014 for V; the documentation of
Mitsuba 3's principled plugin and Burley 2015.
"""

from math import pi

import numpy as np

from ..models.facts import Setting
from ..models.model import Model, Parameter
from ..physics import fresnel, grain
from ..physics.geometry import Geometry
from ..physics.microfacet import ggx
from ..physics.shader_optics import schlick

BASE = Parameter("base_color", 0.5, 0.0, 1.0, per_channel=True, starts=(0.05, 0.3, 0.8))
METALLIC = Parameter("metallic", 0.0, 0.0, 1.0, free=False)
ROUGHNESS = Parameter("roughness", 0.5, 0.04, 1.0, log=True, given_low=0.0, starts=(0.1, 0.2, 0.35, 0.55, 0.85))
SPECULAR = Parameter("specular", 0.5, 0.0, 1.0, starts=(0.2, 0.5, 1.0))
INDEX = Parameter("eta", 1.5, 1.0001, 3.0, log=True, origin=1.0, given_low=1.0, starts=(1.2, 1.5, 2.2))
GRAIN = Parameter("anisotropic", 0.0, 0.0, 1.0, free=False, starts=(0.3, 0.7))
AXIS = Parameter("axis", 0.0, 0.0, pi, "rad", free=False)


def unreal(geom: Geometry, *, base_color, metallic, roughness, specular) -> np.ndarray:
    """Unreal's default lit shader [1/sr]."""
    alpha = np.where(np.equal(roughness, 0), 1.0, np.square(roughness))
    f = _unreal_f(geom.cos_d, base_color, metallic, specular)
    i, r = geom.cos_i, geom.cos_r
    visible = 0.5 / (r * (i * (1 - alpha) + alpha) + i * (r * (1 - alpha) + alpha))
    lobe = np.where(np.equal(roughness, 0), 0.0, f * ggx(geom, alpha) * visible)
    return base_color * (1 - metallic) / pi + lobe


def _unreal_f(cos_d, base_color, metallic, specular):
    bare = 0.08 * specular
    f0 = bare + (base_color - bare) * metallic
    return schlick(cos_d, f0, np.minimum(50 * f0, 1.0))


def unreal_mirror(geom: Geometry, *, base_color, metallic, roughness, specular) -> np.ndarray:
    """Its reflectance where the roughness is 0."""
    return np.where(np.equal(roughness, 0), _unreal_f(geom.cos_i, base_color, metallic, specular), 0.0)


def principled(geom: Geometry, *, base_color, metallic, roughness, eta, anisotropic, axis) -> np.ndarray:
    """Mitsuba's principled plugin, opaque [1/sr]; it has no axis of its own, and u lies along it."""
    edge_i, edge_r = (1 - geom.cos_i) ** 5, (1 - geom.cos_r) ** 5
    back = 2 * roughness * geom.cos_d**2
    body = (1 - 0.5 * edge_i) * (1 - 0.5 * edge_r) + back * (edge_i + edge_r + edge_i * edge_r * (back - 1))
    aspect = np.sqrt(1 - 0.9 * anisotropic)
    wide, narrow = (np.maximum(1e-3, np.square(roughness) * each) for each in (1 / aspect, aspect))
    f = _principled_f(geom.cos_d, base_color, metallic, eta)
    return base_color * (1 - metallic) / pi * body + f * grain.grained_shape_uncorrelated(geom, wide, narrow, axis)


def _principled_f(cos_d, base_color, metallic, eta):
    bare = fresnel.fresnel(cos_d, eta)
    return bare + (schlick(cos_d, base_color) - bare) * metallic


METAL = {"metal": Setting({"metallic": 1.0})}
ROLES = ("surface", "subsurface")
UNREAL = Model(
    "unreal", unreal, (BASE, METALLIC, ROUGHNESS, SPECULAR), roles=ROLES, mirror=unreal_mirror, settings=METAL
)
PRINCIPLED = Model(
    "principled", principled, (BASE, METALLIC, ROUGHNESS, INDEX, GRAIN, AXIS), roles=ROLES, settings=METAL
)
