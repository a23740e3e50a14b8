"""USD: a UsdPreviewSurface in the specular workflow, as a Material that a stage can reference.

alpha = roughness². The workflow gives F0 its own colour and F90 = 1, which serves metals (black diffuse) and
dielectrics alike; the metallic one would tie F0 to the base colour or to one index. The specification leaves the law
open: the one fitted is MaterialX's definition of the same shader. A grain becomes the mean over all turns.
"""

from ..physics.geometry import Geometry
from ..printable import identifier
from . import _grained, _smooth, _target_models
from ._choice import choose, has_body, what_is_lost
from ._smooth import choose_smooth, is_smooth
from .exporter import ColouredSurface, Export, Exporter, comment_lines, number, refuse_mirror, rgb_numbers


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Text (.usda) and its Statement."""
    target = _target_models.usd_specular()
    lost: tuple[str, ...] = ()
    if is_smooth(surface):
        choice = choose_smooth(surface, _smooth.usd(has_body(surface)))
    else:
        lost = refuse_mirror(surface, "usd") + what_is_lost(surface) + _grained.what_turning_loses(surface)
        choice = choose(surface, geom, {"specular": target if has_body(surface) else target.with_fixed(albedo=0.0)})
    statement = choice.statement("usd", surface, lost=lost)
    values, name = choice.values, identifier(surface.name)
    comment = "\n".join("# " + line for line in comment_lines(surface, statement))
    diffuse = rgb_numbers(values.get("albedo", 0.0), 0.0, 1.0, "diffuseColor")
    specular = rgb_numbers(values["f0"], 0.0, 1.0, "specularColor")
    roughness = number(values.get("roughness", 0.0), 0.0, 1.0, "roughness")
    return Export(f"""#usda 1.0
(
    defaultPrim = "{name}"
    metersPerUnit = 1
    upAxis = "Z"
)
{comment}

def Material "{name}"
{{
    token outputs:surface.connect = </{name}/surface.outputs:surface>

    def Shader "surface"
    {{
        uniform token info:id = "UsdPreviewSurface"
        int inputs:useSpecularWorkflow = 1
        color3f inputs:diffuseColor = {_tuple(diffuse)}
        color3f inputs:specularColor = {_tuple(specular)}
        float inputs:roughness = {roughness:.9g}
        token outputs:surface
    }}
}}
""", statement)  # fmt: skip


def _tuple(values) -> str:
    return "(" + ", ".join(f"{value:.9g}" for value in values) + ")"


EXPORTER = Exporter(__name__, ".usda", "USD preview surface, specular workflow", export, averages=True)
