"""Programs whose shaders take typed numbers: the law that each evaluates, and what its fields are called.

A rotation is typed as a share of a turn or in radians where a program has a number for it; Unreal, OpenPBR and Mitsuba
turn the tangent of the mesh.
"""

from collections.abc import Callable, Mapping
from math import pi

import numpy as np

from ..physics.colour import hex_of
from ..records import dataclass
from . import _blender, _principled, _substance, _unreal
from ._choice import Choice
from ._nodes import Node, node_called
from .exporter import ColouredSurface

AS_TURNS = 1 / (2 * pi)


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


def _as_named(*names: str, **spelt: str) -> dict[str, str]:
    """Fields that are called as the law's parameters are, and those that are not."""
    return {name: name for name in names} | spelt


PLAIN = {"base_color": "Base Color", "metallic": "Metallic", "roughness": "Roughness"}
PROGRAMS = (
    Program(
        "Blender",
        "Principled BSDF",
        _blender.node_for,
        _blender.FIELDS,
        "Standard Surface in MaterialX, OpenPBR for metals",
        ("Base Color", "Metallic", "Roughness", "IOR"),
        rotation=("Anisotropic Rotation", AS_TURNS),
        retyped=_blender.in_blenders_sense,
    ),
    Program(
        "Arnold, Maya, Houdini",
        "standard_surface",
        lambda _: node_called("standard-surface"),
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
        lambda _: node_called("openpbr"),
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
        lambda _: node_called("gltf"),
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
        return node_called(law)
    return {each.law.name: each for each in (_unreal.NODE, _substance.NODE, _principled.NODE)}.get(law)


def typed_numbers(
    program: Program, node: Node, choice: Choice
) -> tuple[dict[str, float | tuple[float, ...]], dict[str, str]]:
    """Label -> number or colour, and label -> hex of colours; what keeps the shader's default is left out."""
    numbers: dict[str, float | tuple[float, ...]] = {}
    hexes = {}
    values = program.retyped(choice.values)
    # a coat's own defaults differ from program to program
    coat = (node.coat, node.coat_roughness, node.coat_index) if np.any(choice.values[node.coat]) else ()
    for name, label in program.fields.items():
        if name not in values:
            continue
        value, parameter = np.ravel(values[name]), node.law.parameter(name)
        if label not in program.always and name not in coat and np.all(value == parameter.default):
            continue
        if parameter.per_channel:
            rgb = np.broadcast_to(value, (3,))
            numbers[label] = tuple(float(each) for each in rgb)
            hexes[label] = hex_of(rgb)
        else:
            numbers[label] = float(value[0])
    if program.rotation and np.any(choice.values[node.grain]):
        label, of_a_radian = program.rotation
        turned = float(np.remainder(np.sign(of_a_radian) * np.ravel(choice.values["axis"])[0], np.pi))
        numbers[label] = turned * abs(of_a_radian)
    return numbers, hexes


def as_words(program: Program, node: Node, choice: Choice) -> dict[str, float | tuple[float, ...]]:
    """The numbers of a shader under the program's labels as they are typed in a command: base_color, ior_level."""
    numbers, _ = typed_numbers(program, node, choice)
    return {label.lower().replace(" ", "_"): value for label, value in numbers.items()}
