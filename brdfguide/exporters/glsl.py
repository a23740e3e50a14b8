"""GLSL: `vec3 NAME_brdf(L, V, N)` [1/sr] and `vec3 NAME_mirror(cos_i)`, the model's own law with its numbers.

Unit vectors, L toward the light, V toward the eye, N the normal; no cosine is included. Works from GLSL 1.30 and ES
3.0.
"""

from ..physics.geometry import Geometry
from ..printable import identifier
from ._dialect import colour_expressions, mirror_colours
from ._exact import exact_statement
from ._shader import functions, triple
from .exporter import ColouredSurface, Export, Exporter, comment_lines


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """GLSL text and its Statement."""
    statement = exact_statement("glsl", surface, geom, "merl")
    name, finite, mirror = identifier(surface.name), colour_expressions(surface), mirror_colours(surface)
    comment = "\n".join("// " + line for line in comment_lines(surface, statement))
    return Export(f"""{comment}

{functions(surface, finite + mirror)}

vec3 {name}_brdf(vec3 L, vec3 V, vec3 N)
{{
    float ci = dot(N, L), cr = dot(N, V);
    if (ci <= 0.0 || cr <= 0.0) return vec3(0.0);
    vec3 l = L - ci * N, v = V - cr * N;
    float q = dot(l + v, l + v), p = dot(l, v);
    ci = clamp(ci, 1.0e-6, 1.0);
    cr = clamp(cr, 1.0e-6, 1.0);
    return {triple(finite, "vec3")};
}}

vec3 {name}_mirror(float cos_i)
{{
    float ci = clamp(cos_i, 1.0e-6, 1.0);
    return {triple(mirror, "vec3")};
}}
""", statement)  # fmt: skip


EXPORTER = Exporter(__name__, ".glsl", "GLSL functions, any model with a formula exactly", export)
