"""MaterialX: a standard_surface, metal or dielectric.

specular_roughness² is alpha. A metal's base_color is F0 and its specular_color an edge tint, from which artistic_ior
makes n and k; a dielectric is as in OpenPBR. The law fitted is the one in MaterialX's own nodes.
"""

from ..geometry import Geometry
from . import _laws, _smooth
from ._base import Export, Exporter, Surface, refuse_mirror
from ._choice import choose, has_body, what_is_lost
from ._materialx import colour3, document, real, shader
from ._smooth import choose_smooth, is_smooth


def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """MaterialX text and its Statement."""
    if is_smooth(surface):
        choice, lost = choose_smooth(surface, _smooth.standard(has_body(surface))), ()
    else:
        laws = {"metal": _laws.standard_metal(), "dielectric": _laws.openpbr_dielectric()}
        laws = {"matt": _laws.body_alone(), "dielectric": laws["dielectric"]} if has_body(surface) else laws
        lost = refuse_mirror(surface, "standard-surface") + what_is_lost(surface)
        choice = choose(surface, geom, laws)
    statement = choice.statement("standard-surface", surface, lost=lost)
    values, metal, matt = choice.values, choice.name == "metal", choice.name == "matt"
    inputs = {
        "base": real(1.0, 0.0, 1.0, "base"),
        "base_color": colour3(values.get("albedo", 0.0), 0.0, 1.0, "base_color"),
        "metalness": real(float(metal), 0.0, 1.0, "metalness"),
        "specular": real(float(not matt), 0.0, 1.0, "specular"),
        "specular_color": colour3(values["edge"] if metal else 1.0, 0.0, 1.0, "specular_color"),
        "specular_roughness": real(values.get("roughness", 0.0), 0.0, 1.0, "specular_roughness"),
    }
    if not metal and not matt:
        inputs["specular_IOR"] = real(values["n"], 1.0, 3.0, "specular_IOR")
    return Export(document(surface, statement, shader(surface, "standard_surface", inputs)), statement)


EXPORTER = Exporter(__name__, ".mtlx", "MaterialX standard_surface", export)
