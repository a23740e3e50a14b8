"""Programs whose shaders take typed numbers: the law that each evaluates, and what its fields are called.

Blender's bodies are Standard Surface's in MaterialX and its metals OpenPBR's under a coat that does not darken;
Substance's metallic roughness means what Unreal's default lit means, and calls specular specular level.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from .. import catalog
from ..models.model import Model
from . import _engine_laws
from ._choice import has_body
from ._nodes import Node
from .exporter import ColouredSurface


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
    grain: Callable[[Mapping], Mapping[str, float]] | None = None  # values of the law -> what is typed of a grain
    turned_by: str = ""  # what lies along the streak there, where the shader does not turn it itself


def _node(target: str) -> Node:
    return catalog.load("exporters", target).NODE


def _blender(surface: ColouredSurface) -> Node:
    return _node("standard-surface") if has_body(surface) else _blenders_metal()


@lru_cache(maxsize=1)
def _blenders_metal() -> Node:
    node = _node("openpbr")
    parameters = tuple(replace(p, default=0.0) if p.name == "coat_darkening" else p for p in node.law.parameters)
    return replace(node, law=replace(node.law, parameters=parameters))


def _axis(values: Mapping) -> float:
    """Azimuth [rad] of the streak, within half a turn."""
    return float(np.remainder(np.ravel(values["axis"])[0], np.pi))


def _blenders_grain(values: Mapping) -> dict[str, float]:
    """Principled's widths are roughness²/aspect and roughness² aspect, aspect = √(1 - 0.9 anisotropic), its rotation
    counter-clockwise (Blender 4.5, svm/closure.h); ratios end at 10."""
    roughness = float(np.ravel(values["specular_roughness"])[0])
    if "specular_roughness_anisotropy" in values:  # OpenPBR's r⁴ is the mean of both squares
        ratio = 1 - float(values["specular_roughness_anisotropy"])
        roughness *= (2 * ratio / (1 + ratio * ratio)) ** 0.25
    else:
        ratio = 1 - float(values["specular_anisotropy"])
    typed = min((1 - ratio) / 0.9, 1.0)
    return {"Roughness": roughness, "Anisotropic": typed, "Anisotropic Rotation": _axis(values) / (2 * np.pi)}


def _standard_grain(values: Mapping) -> dict[str, float]:
    """As MaterialX turns: clockwise."""
    turn = float(np.remainder(-_axis(values), np.pi) / (2 * np.pi))
    return {"specular_anisotropy": float(values["specular_anisotropy"]), "specular_rotation": turn}


def _openpbrs_grain(values: Mapping) -> dict[str, float]:
    return {"specular_roughness_anisotropy": float(values["specular_roughness_anisotropy"])}


def _gltfs_grain(values: Mapping) -> dict[str, float]:
    """The rotation in radians, counter-clockwise."""
    return {"anisotropyStrength": float(values["anisotropy_strength"]), "anisotropyRotation": _axis(values)}


def _mitsubas_grain(values: Mapping) -> dict[str, float]:
    return {"anisotropic": float(values["anisotropic"])}


BLENDER_FIELDS = {
    "base_color": "Base Color",
    "base_metalness": "Metallic",
    "metalness": "Metallic",
    "specular_roughness": "Roughness",
    "specular_ior": "IOR",
    "specular_color": "Specular Tint",
    "coat_weight": "Coat Weight",
    "coat": "Coat Weight",
    "coat_roughness": "Coat Roughness",
    "coat_ior": "Coat IOR",
}


@lru_cache(maxsize=4)
def _plain(law: Model, index: str, grain: str = "") -> Node:
    """A shader of base colour, metallic, roughness and one number for the lobe's height, without a coat."""
    matt = {"specular": 0.0} if index == "specular" else {"eta": 1.0}
    return Node(
        law=law,
        roughness="roughness",
        metalness="metallic",
        index=index,
        weight="",
        edge="",
        coat="",
        coat_roughness="",
        coat_index="",
        matt=matt,
        grain=grain,
    )


PLAIN = {"base_color": "Base Color", "metallic": "Metallic", "roughness": "Roughness"}
OF_STANDARD = {
    "base_color": "base_color",
    "metalness": "metalness",
    "specular": "specular",
    "specular_color": "specular_color",
    "specular_roughness": "specular_roughness",
    "specular_ior": "specular_IOR",
    "coat": "coat",
    "coat_roughness": "coat_roughness",
    "coat_ior": "coat_IOR",
}
PROGRAMS = (
    Program(
        "Blender",
        "Principled BSDF",
        _blender,
        BLENDER_FIELDS,
        "Standard Surface's in MaterialX, OpenPBR's for metals",
        ("Base Color", "Metallic", "Roughness", "IOR"),
        grain=_blenders_grain,
    ),
    Program(
        "Arnold, Maya, Houdini",
        "standard_surface",
        lambda _: _node("standard-surface"),
        OF_STANDARD,
        "Standard Surface's in MaterialX",
        ("base_color", "metalness", "specular_roughness", "specular_IOR"),
        grain=_standard_grain,
    ),
    Program(
        "OpenPBR",
        "open_pbr_surface",
        lambda _: _node("openpbr"),
        {
            name: name
            for name in (
                "base_color",
                "base_metalness",
                "specular_weight",
                "specular_color",
                "specular_roughness",
                "specular_ior",
                "coat_weight",
                "coat_roughness",
                "coat_ior",
            )
        },
        "OpenPBR's in MaterialX",
        ("base_color", "base_metalness", "specular_roughness", "specular_ior"),
        read_twice=True,
        grain=_openpbrs_grain,
        turned_by="geometry_tangent",
    ),
    Program(
        "Unreal",
        "Default Lit",
        lambda _: _plain(_engine_laws.UNREAL, "specular"),
        PLAIN | {"specular": "Specular"},
        "Unreal's",
        ("Base Color", "Metallic", "Roughness", "Specular"),
    ),
    Program(
        "Substance",
        "metallic roughness",
        lambda _: _plain(_engine_laws.UNREAL, "specular"),
        PLAIN | {"specular": "Specular level"},
        "Unreal's, whose numbers mean the same",
        ("Base Color", "Metallic", "Roughness", "Specular level"),
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
            "clearcoat": "clearcoat",
            "clearcoat_roughness": "clearcoatRoughness",
        },
        "glTF's appendix B",
        ("baseColor", "metallic", "roughness", "ior"),
        grain=_gltfs_grain,
    ),
    Program(
        "Mitsuba",
        "principled",
        lambda _: _plain(_engine_laws.PRINCIPLED, "eta", "anisotropic"),
        {"base_color": "base_color", "metallic": "metallic", "roughness": "roughness", "eta": "eta"},
        "Mitsuba's principled",
        ("base_color", "metallic", "roughness", "eta"),
        grain=_mitsubas_grain,
        turned_by="u",
    ),
)


def node_of(law: str) -> Node | None:
    """The shader of a law by its name; None where the law is no shader with a node."""
    if law in ("openpbr", "standard-surface", "gltf"):
        return _node(law)
    plain = {
        "unreal": (_engine_laws.UNREAL, "specular"),
        "principled": (_engine_laws.PRINCIPLED, "eta", "anisotropic"),
    }
    return _plain(*plain[law]) if law in plain else None
