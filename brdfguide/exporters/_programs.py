"""Programs whose shaders take typed numbers: the law that each evaluates, and what its fields are called.

Blender's bodies are Standard Surface's in MaterialX and its metals OpenPBR's under a coat that does not darken; its
widths across and along a grain are roughness² over and times √(1 - 0.9 Anisotropic). A rotation is typed as a share of
a turn or in radians where a program has a number for it; Unreal, OpenPBR and Mitsuba turn the tangent of the mesh.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from math import pi

import numpy as np

from .. import catalog
from . import _principled, _substance, _unreal
from ._choice import has_body
from ._nodes import Node
from .exporter import ColouredSurface

AS_TURNS = 1 / (2 * pi)
BLENDERS_MOST = 0.9  # of 1 - (alpha along/alpha across)


@dataclass(frozen=True)
class Program:
    """A program, its shader's law and what its fields are called."""

    name: str
    shader: str
    node: Callable[[ColouredSurface], Node]
    fields: Mapping[str, str]  # parameter of the law -> label
    formula: str
    always: tuple[str, ...]  # labels that are shown though they keep the default
    read_twice: bool = False  # whether programs read the shader's text in two published ways
    coated: str = ""  # the shader that has the coat; "": the same
    rotation: tuple[str, float] | None = None  # label of a grain's direction, of a radian, negative: clockwise
    tangent: str = "the tangent of the mesh"  # what lies along the streak where no rotation is typed
    retyped: Callable[[Mapping], Mapping] = dict  # values of the law -> those of the program


def _node(target: str) -> Node:
    return catalog.load("exporters", target).NODE


@lru_cache(maxsize=2)
def _blenders(body: bool) -> Node:
    node = _node("standard-surface" if body else "openpbr")
    parameters = []
    for p in node.law.parameters:
        if p.name == "coat_darkening":
            p = replace(p, default=0.0)
        parameters.append(replace(p, high=BLENDERS_MOST) if p.name == node.grain else p)
    return replace(node, law=replace(node.law, parameters=tuple(parameters)))


def _as_blender_types(values: Mapping) -> dict:
    """Roughness and Anisotropic of the two widths that the law has by its own numbers."""
    typed = dict(values)
    for name in ("specular_anisotropy", "specular_roughness_anisotropy"):
        if name not in values:
            continue
        share = float(np.ravel(values[name])[0])
        typed[name] = share / BLENDERS_MOST
        if name == "specular_roughness_anisotropy":  # of OpenPBR, whose roughness is no geometric mean
            narrower = 2 * (1 - share) / (1 + (1 - share) ** 2)
            typed["specular_roughness"] = values["specular_roughness"] * narrower**0.25
    return typed


BLENDER_FIELDS = {
    "base_color": "Base Color",
    "base_metalness": "Metallic",
    "metalness": "Metallic",
    "specular_roughness": "Roughness",
    "specular_ior": "IOR",
    "specular_color": "Specular Tint",
    "specular_anisotropy": "Anisotropic",
    "specular_roughness_anisotropy": "Anisotropic",
    "coat_weight": "Coat Weight",
    "coat": "Coat Weight",
    "coat_roughness": "Coat Roughness",
    "coat_ior": "Coat IOR",
}


def _as_named(*names: str, **spelt: str) -> dict[str, str]:
    """Fields that are called as the law's parameters are, and those that are not."""
    return {name: name for name in names} | spelt


PLAIN = {"base_color": "Base Color", "metallic": "Metallic", "roughness": "Roughness"}
PROGRAMS = (
    Program(
        "Blender",
        "Principled BSDF",
        lambda surface: _blenders(has_body(surface)),
        BLENDER_FIELDS,
        "Standard Surface in MaterialX, OpenPBR for metals",
        ("Base Color", "Metallic", "Roughness", "IOR"),
        rotation=("Anisotropic Rotation", AS_TURNS),
        retyped=_as_blender_types,
    ),
    Program(
        "Arnold, Maya, Houdini",
        "standard_surface",
        lambda _: _node("standard-surface"),
        _as_named(
            *("base_color", "metalness", "specular", "specular_color", "specular_roughness", "specular_anisotropy"),
            *("coat", "coat_roughness"),
            specular_ior="specular_IOR",
            coat_ior="coat_IOR",
        ),
        "Standard Surface in MaterialX",
        ("base_color", "metalness", "specular_roughness", "specular_IOR"),
        rotation=("specular_rotation", -AS_TURNS),
    ),
    Program(
        "OpenPBR",
        "open_pbr_surface",
        lambda _: _node("openpbr"),
        _as_named(
            *("base_color", "base_metalness", "specular_weight", "specular_color", "specular_roughness"),
            *("specular_roughness_anisotropy", "specular_ior", "coat_weight", "coat_roughness", "coat_ior"),
        ),
        "OpenPBR in MaterialX",
        ("base_color", "base_metalness", "specular_roughness", "specular_ior"),
        read_twice=True,
        tangent="geometry_tangent",
    ),
    Program(
        "Unreal",
        "Default Lit",
        lambda _: _unreal.NODE,
        PLAIN
        | {
            "specular": "Specular",
            "anisotropy": "Anisotropy",
            "clear_coat": "Clear Coat",
            "clear_coat_roughness": "Clear Coat Roughness",
        },
        "Unreal's shader files",
        ("Base Color", "Metallic", "Roughness", "Specular"),
        coated="Clear Coat",
        tangent="Tangent",
    ),
    Program(
        "Substance",
        "Painter's asm-metal-rough",
        lambda _: _substance.NODE,
        {
            "base_color": "Base color",
            "metallic": "Metallic",
            "roughness": "Roughness",
            "specular_level": "Specular level",
            "specular_edge_color": "Specular edge color",
            "anisotropy_level": "Anisotropy level",
            "coat_opacity": "Coat opacity",
            "coat_roughness": "Coat roughness",
            "coat_ior": "Coat IOR",
        },
        "Painter's shader files",
        ("Base color", "Metallic", "Roughness", "Specular level"),
        rotation=("Anisotropy angle", AS_TURNS),
    ),
    Program(
        "glTF, three.js",
        "metallic-roughness",
        lambda _: _node("gltf"),
        {
            "base_color": "baseColor",
            "metallic": "metallic",
            "roughness": "roughness",
            "ior": "ior",
            "specular": "specular",
            "anisotropy_strength": "anisotropyStrength",
            "clearcoat": "clearcoat",
            "clearcoat_roughness": "clearcoatRoughness",
        },
        "glTF's appendix B",
        ("baseColor", "metallic", "roughness", "ior"),
        rotation=("anisotropyRotation", 1.0),
    ),
    Program(
        "Mitsuba",
        "principled",
        lambda _: _principled.NODE,
        _as_named(
            *("base_color", "metallic", "roughness", "eta", "anisotropic", "clearcoat", "clearcoat_gloss"),
        ),
        "Mitsuba's principled",
        ("base_color", "metallic", "roughness", "eta"),
        tangent="u",
    ),
)


def node_of(law: str) -> Node | None:
    """The shader of a law by its name; None where the law is no shader with a node."""
    if law in ("openpbr", "standard-surface", "gltf"):
        return _node(law)
    return {each.law.name: each for each in (_unreal.NODE, _substance.NODE, _principled.NODE)}.get(law)
