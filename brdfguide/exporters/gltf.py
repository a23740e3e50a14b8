"""glTF 2.0: one material, metallic-roughness with KHR_materials_ior and KHR_materials_specular.

alpha = roughness²; F is Schlick's. A metal has F0 = base colour and no index; a dielectric has F0 = specular times
((ior - 1)/(ior + 1))² and F90 = specular, and its body gets what F leaves. There is no edge tint and no k.
The law fitted is appendix B of the specification, with separable masking; viewers differ from it in details.
"""

import json

import numpy as np

from ..geometry import Geometry
from . import _laws, _smooth
from ._base import Export, Exporter, Surface, header, number, refuse_mirror, rgb_numbers
from ._choice import choose, has_body, what_is_lost
from ._smooth import choose_smooth, is_smooth


def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """JSON text and its Statement."""
    laws = {"metal": _laws.gltf_metal(), "dielectric": _laws.gltf_dielectric()}
    if has_body(surface):
        laws = {"matt": _laws.gltf_dielectric().with_fixed(specular=0.0, n=1.5, roughness=1.0), "dielectric": laws["dielectric"]}
    if is_smooth(surface):
        choice, lost = choose_smooth(surface, _smooth.gltf(has_body(surface))), ()
    else:
        lost = refuse_mirror(surface, "gltf") + what_is_lost(surface)
        choice = choose(surface, geom, laws)
    statement = choice.statement("gltf", surface, lost=lost)
    values = choice.values
    metal = choice.name == "metal"
    material = {
        "name": surface.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [*rgb_numbers(values.get("albedo", 0.0), 0.0, 1.0, "baseColorFactor"), 1.0],
            "metallicFactor": 1.0 if metal else 0.0,
            "roughnessFactor": number(values.get("roughness", 0.0), 0.0, 1.0, "roughnessFactor"),
        },
        "extras": {"brdfguide": header(surface, statement)},
    }
    document = {"asset": {"version": "2.0", "generator": "brdfguide"}, "materials": [material]}
    if not metal:
        specular = rgb_numbers(values["specular"], 0.0, 1.0, "specularFactor")
        factor = max(specular)
        extensions = {"KHR_materials_ior": {"ior": number(values["n"], 1.0, 100.0, "ior")}, "KHR_materials_specular": {"specularFactor": factor}}
        if np.ptp(specular) > 0:
            extensions["KHR_materials_specular"]["specularColorFactor"] = [value / factor for value in specular]
        material["extensions"] = extensions
        document["extensionsUsed"] = sorted(extensions)
    return Export(json.dumps(document, indent=2, allow_nan=False) + "\n", statement)


EXPORTER = Exporter(__name__, ".gltf", "glTF 2.0 metallic-roughness material with ior and specular extensions", export)
