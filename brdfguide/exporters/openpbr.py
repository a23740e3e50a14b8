"""MaterialX: an open_pbr_surface, metal or dielectric, under a coat where a mirror stands beside a finite part.

The law fitted is models/openpbr.py, MaterialX's own nodes; its other published reading is evaluated with the same
numbers. It dims a body at grazing even without a surface above it. A grain turns the tangent by nodes of the file.
"""

import numpy as np

from ..models import term
from ..models.openpbr import widths
from ..physics.geometry import Geometry
from ..printable import identifier
from ._materialx import colour3, float_value, materialx_document, shader, turned_tangent
from ._node_words import node_statement
from ._nodes import Node
from .exporter import ColouredSurface, Export, Exporter

LAW = term("openpbr")
NODE = Node(
    law=LAW,
    roughness="specular_roughness",
    metalness="base_metalness",
    index="specular_ior",
    weight="specular_weight",
    edge="specular_color",
    coat="coat_weight",
    coat_roughness="coat_roughness",
    coat_index="coat_ior",
    matt={"specular_weight": 0.0, "specular_roughness": 1.0},
    under_rough_coat=False,
    grain="specular_roughness_anisotropy",
    widths=widths,
)
COLOURS = ("base_color", "specular_color", "coat_color")
ALWAYS = ("base_metalness", "specular_roughness", "specular_ior")


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """MaterialX text and its Statement."""
    choice, statement = node_statement(NODE, "openpbr", surface, geom)
    inputs = {}
    for p in LAW.parameters:
        value = choice.values[p.name]
        if p.name in COLOURS:
            inputs[p.name] = colour3(value, 0.0, 1.0, p.name)
        elif p.name != "axis" and (value != p.default or p.name in ALWAYS):
            inputs[p.name] = float_value(value, p.least, p.high, p.name)
    nodes, joined, axis = [], {}, float(np.ravel(choice.values["axis"])[0])
    if NODE.grain in inputs and axis:
        joined["geometry_tangent"] = f"{identifier(surface.name)}_across"
        nodes = turned_tangent(joined["geometry_tangent"], axis)
    nodes += shader(surface, "open_pbr_surface", inputs, joined)
    return Export(materialx_document(surface, statement, nodes), statement)


EXPORTER = Exporter(__name__, ".mtlx", "MaterialX open_pbr_surface", export, grained=True, lobe="ggx")
