"""MaterialX: a standard_surface, metal or dielectric, under a coat where the surface has a mirror beside a finite part.

The law fitted is models/standard_surface.py, MaterialX's own nodes; what a user types in is what it holds.
`specular_rotation` turns the tangent clockwise: the node hands it to `rotate3d`, which does.
"""

import numpy as np

from ..models import term
from ..models.standard_surface import widths
from ..physics.geometry import Geometry
from ._materialx import colour3, float_value, materialx_document, shader
from ._node_words import node_statement
from ._nodes import Node
from .exporter import ColouredSurface, Export, Exporter

LAW = term("standard-surface")
NODE = Node(
    law=LAW,
    roughness="specular_roughness",
    metalness="metalness",
    index="specular_ior",
    weight="specular",
    edge="specular_color",
    coat="coat",
    coat_roughness="coat_roughness",
    coat_index="coat_ior",
    matt={"specular": 0.0},
    grain="specular_anisotropy",
    widths=widths,
)
COLOURS = ("base_color", "specular_color", "coat_color")
SPELT = {"specular_ior": "specular_IOR", "coat_ior": "coat_IOR"}


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """MaterialX text and its Statement."""
    choice, statement = node_statement(NODE, "standard-surface", surface, geom)
    values = choice.values
    inputs = {"base": float_value(1.0, 0.0, 1.0, "base")}
    for p in LAW.parameters:
        value, default = values[p.name], p.default
        if p.name == "axis":
            inputs["specular_rotation"] = float_value(_clockwise(value), 0.0, 1.0, "specular_rotation")
        elif p.name in COLOURS:
            inputs[p.name] = colour3(value, 0.0, 1.0, p.name)
        elif p.name == "base_color" or np.any(value != default) or p.name in ("metalness", "specular", NODE.roughness):
            inputs[SPELT.get(p.name, p.name)] = float_value(value, p.least, p.high, p.name)
    return Export(materialx_document(surface, statement, shader(surface, "standard_surface", inputs)), statement)


def _clockwise(axis) -> float:
    """The part of a turn, clockwise and within half of one, that brings the tangent to an azimuth [rad]."""
    return float(np.remainder(-np.ravel(axis)[0], np.pi) / (2 * np.pi))


EXPORTER = Exporter(__name__, ".mtlx", "MaterialX standard_surface", export, grained=True, lobe="ggx")
