"""MaterialX: an open_pbr_surface, metal or dielectric.

specular_roughness² is alpha. A metal's base_color is F0 and its specular_color the reflectance at 82 degrees relative
to Schlick's; a dielectric's body gets what the lobe leaves. OpenPBR adds the light scattered between facets, which no
law of the guide has; and it dims a body at grazing even under an index of 1. The law fitted is the one in MaterialX's own nodes.
"""

from ..geometry import Geometry
from . import _laws, _smooth
from ._base import Export, Exporter, Surface, refuse_mirror
from ._choice import choose, has_body, what_is_lost
from ._materialx import colour3, document, real, shader
from ._smooth import choose_smooth, is_smooth

def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """MaterialX text and its Statement."""
    dielectric = _laws.openpbr_dielectric()
    if is_smooth(surface):
        choice, lost = choose_smooth(surface, _smooth.openpbr(has_body(surface))), ()
    else:
        laws = {"metal": _laws.openpbr_metal(), "dielectric": dielectric}
        laws = {"matt": dielectric.with_fixed(n=1.0), "dielectric": dielectric} if has_body(surface) else laws
        lost = refuse_mirror(surface, "openpbr") + what_is_lost(surface)
        choice = choose(surface, geom, laws)
    statement = choice.statement("openpbr", surface, lost=lost)
    values = choice.values
    inputs = {
        "base_color": colour3(values.get("albedo", 0.0), 0.0, 1.0, "base_color"),
        "base_metalness": real(float(choice.name == "metal"), 0.0, 1.0, "base_metalness"),
        "specular_roughness": real(values.get("roughness", 0.0), 0.0, 1.0, "specular_roughness"),
    }
    if choice.name == "metal":
        inputs["specular_color"] = colour3(values["edge"], 0.0, 1.0, "specular_color")
    else:
        inputs["specular_ior"] = real(values["n"], 1.0, 3.0, "specular_ior")
    return Export(document(surface, statement, shader(surface, "open_pbr_surface", inputs)), statement)


EXPORTER = Exporter(__name__, ".mtlx", "MaterialX open_pbr_surface", export)
