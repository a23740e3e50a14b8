"""Mitsuba's `principled`, opaque, with its grain and its clear coat.

    f = base (1 - metallic)/π (Disney's body of 2015) + F D G/(4 cos θi cos θr) + coat, alpha = roughness²
    F of the index where it is no metal, Schlick's from the base colour where it is
    grain: max(0.001, alpha/√(1 - 0.9 anisotropic)) along u and max(0.001, alpha √(1 - 0.9 anisotropic)) across it, G of
    uncorrelated heights
    coat = ¼ clearcoat Fc D1 G,   Fc Schlick's from 0.04,   D1 = (a² - 1)/(π ln a² (1 + (a² - 1) cos²δ)), a = mix(0.1,
    0.001, clearcoat_gloss),   G Smith's with alpha = ¼, not divided by the cosines

No rotation: u of the mesh is the tangent. A roughness of 0 is alpha = 0.001, of which 99 % falls within a degree of the
mirror direction: a mirror here. The coat is none: at gloss 1 two thirds of its light still fall outside that degree.
What it sends within is taken as the mirror image of a lamp, the rest is its glow. It takes nothing from the base.

Source: the documentation of Mitsuba 3's principled plugin and its published file; Burley 2012 and 2015.
"""

from math import log, pi, radians

import numpy as np

from ..models.facts import Setting
from ..models.model import Model, Parameter
from ..physics import fresnel, grain
from ..physics.geometry import Geometry
from ..physics.shader_optics import schlick
from ._nodes import Node
from ._unreal import AXIS, BASE, METALLIC, ROUGHNESS

COAT_F0 = 0.04
NARROWEST = 0.001  # alpha
GLOSSIEST, SATIN = 0.001, 0.1  # alpha of the coat with gloss 1 and 0
IMAGE = radians(0.5)  # tilt of facets whose light falls within a degree of the mirror direction
IN_IMAGE = 1 + log(GLOSSIEST**2 + IMAGE**2) / -log(GLOSSIEST**2)  # their share with gloss 1, ∫ D1 cos δ dω: 0.31
INDEX = Parameter("eta", 1.5, 1.0001, 3.0, log=True, origin=1.0, given_low=1.0, starts=(1.2, 1.5, 2.2))
GRAIN = Parameter("anisotropic", 0.0, 0.0, 1.0, free=False, starts=(0.4, 0.8))
COAT = Parameter("clearcoat", 0.0, 0.0, 1.0, free=False)
GLOSS = Parameter("clearcoat_gloss", 1.0, 0.0, 1.0, free=False, starts=(0.2, 0.8))


def _brdf(
    geom: Geometry, *, base_color, metallic, roughness, eta, anisotropic, axis, clearcoat, clearcoat_gloss
) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    edge_i, edge_r = (1 - geom.cos_i) ** 5, (1 - geom.cos_r) ** 5
    back = 2 * roughness * geom.cos_d**2
    body = (1 - 0.5 * edge_i) * (1 - 0.5 * edge_r) + back * (edge_i + edge_r + edge_i * edge_r * (back - 1))
    aspect = np.sqrt(1 - 0.9 * anisotropic)
    across, along = (np.maximum(NARROWEST, np.square(roughness) * each) for each in (1 / aspect, aspect))
    lobe = grain.grained_shape_uncorrelated(geom, across, along, axis)
    shiny = _fresnel(geom.cos_d, base_color, metallic, eta) * np.where(np.equal(roughness, 0), 0.0, lobe)
    base = base_color * (1 - metallic) / pi * body + shiny
    return base + clearcoat * _coat(geom, clearcoat_gloss) if np.any(clearcoat) else base


def _mirror(geom: Geometry, *, base_color, metallic, roughness, eta, clearcoat, clearcoat_gloss, **_):
    """Reflectance within a degree of the mirror direction of a base of roughness 0 and of a coat of gloss 1."""
    base = np.where(np.equal(roughness, 0), _fresnel(geom.cos_i, base_color, metallic, eta), 0.0)
    # ¼ Fc G D1 with 4 cos θ dω of facets about the normal for every dω, and cos θ of the light that arrives
    coat = clearcoat * schlick(geom.cos_i, COAT_F0) * _mask(geom.cos_i) ** 2 * geom.cos_i**2 * IN_IMAGE
    return base + np.where(np.equal(clearcoat_gloss, 1), coat, 0.0)


def _fresnel(cos_d, base_color, metallic, eta):
    bare = fresnel.fresnel(cos_d, eta)
    return bare + (schlick(cos_d, base_color) - bare) * metallic


def _coat(geom: Geometry, gloss):
    """The coat of weight 1 [1/sr]; of gloss 1 without what is its mirror image."""
    a2 = np.square(SATIN + (GLOSSIEST - SATIN) * np.asarray(gloss))
    # 1 + (a² - 1) cos²δ = (a² + tan²δ) cos²δ
    density = (a2 - 1) / (pi * np.log(a2)) * geom.sec2_h / (a2 + geom.tan2_h)
    within = np.logical_and(np.equal(gloss, 1), geom.tan2_h < np.tan(IMAGE) ** 2)
    masking = _mask(geom.cos_i) * _mask(geom.cos_r)
    return np.where(within, 0.0, 0.25 * schlick(geom.cos_d, COAT_F0) * density * masking)


def _mask(cos):
    return 2 * cos / (cos + np.sqrt(0.0625 + (1 - 0.0625) * cos * cos))


LAW = Model(
    "principled",
    _brdf,
    (BASE, METALLIC, ROUGHNESS, INDEX, GRAIN, AXIS, COAT, GLOSS),
    roles=("surface", "subsurface"),
    mirror=_mirror,
    settings={"metal": Setting({"metallic": 1.0})},
    breaks={"rotation": "it has a grain, unless anisotropic is 0"},
)
NODE = Node(
    law=LAW,
    roughness="roughness",
    metalness="metallic",
    index="eta",
    weight="",
    edge="",
    coat="clearcoat",
    coat_roughness="clearcoat_gloss",
    coat_mirror=1.0,
    coat_index="",
    matt={"eta": 1.0},
    under_rough_coat=False,
    grain="anisotropic",
    lacks={
        "body": "its body is Disney's, which falls to a quarter toward grazing where the surface is smooth",
        "lobe": "its coat glows about the mirror image, which fades toward grazing",
        "coat": "its coat glows about the mirror image, fades toward grazing and takes nothing from what lies below",
    },
)
