"""glTF 2.0: one material, metallic-roughness with the extensions that its numbers ask for.

The law fitted is models/gltf.py, appendix B of the specification, with separable masking; viewers differ from it in
details. There is no edge tint and no k. A mirror beside a finite part becomes KHR_materials_clearcoat.
"""

import json

from ..physics.geometry import Geometry
from ..printable import MOST_OF_A_COMMENT, short
from ._gltf import NODE
from ._node_words import node_statement
from .exporter import ColouredSurface, Export, Exporter, comment_lines, number, rgb_numbers


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """JSON text and its Statement."""
    choice, statement = node_statement(NODE, "gltf", surface, geom)
    values = choice.values
    metal = bool(values["metallic"])
    material = {
        "name": short(surface.name, MOST_OF_A_COMMENT),
        "pbrMetallicRoughness": {
            "baseColorFactor": [*rgb_numbers(values["base_color"], 0.0, 1.0, "baseColorFactor"), 1.0],
            "metallicFactor": number(values["metallic"], 0.0, 1.0, "metallicFactor"),
            "roughnessFactor": number(values["roughness"], 0.0, 1.0, "roughnessFactor"),
        },
        "extras": {"brdfguide": comment_lines(surface, statement)},
    }
    document = {"asset": {"version": "2.0", "generator": "brdfguide"}, "materials": [material]}
    extensions = _extensions(values, metal)
    if extensions:
        material["extensions"] = extensions
        document["extensionsUsed"] = sorted(extensions)
    return Export(json.dumps(document, indent=2, allow_nan=False) + "\n", statement)


def _extensions(values, metal: bool) -> dict:
    """Those of the extensions that say something."""
    found: dict = {}
    if not metal:
        found["KHR_materials_ior"] = {"ior": number(values["ior"], 1.0, 100.0, "ior")}
        found["KHR_materials_specular"] = {"specularFactor": number(values["specular"], 0.0, 1.0, "specularFactor")}
    if values["anisotropy_strength"]:
        found["KHR_materials_anisotropy"] = {
            "anisotropyStrength": number(values["anisotropy_strength"], 0.0, 1.0, "anisotropyStrength"),
            "anisotropyRotation": number(values["axis"], 0.0, 3.2, "anisotropyRotation"),
        }
    if values["clearcoat"]:
        found["KHR_materials_clearcoat"] = {
            "clearcoatFactor": number(values["clearcoat"], 0.0, 1.0, "clearcoatFactor"),
            "clearcoatRoughnessFactor": number(values["clearcoat_roughness"], 0.0, 1.0, "clearcoatRoughnessFactor"),
        }
    return found


EXPORTER = Exporter(
    __name__, ".gltf", "glTF 2.0 metallic-roughness material with its extensions", export, grained=True, lobe="ggx"
)
