"""OSL: functions of unit vectors and a shader around them, the model's own law with its numbers.

A closure cannot hold an arbitrary law, so the shader gives the BRDF [1/sr] for a light direction that its caller
supplies: for light loops, ramps and textures. It goes through `oslc`.
"""

from ..physics.geometry import Geometry
from ..printable import identifier
from ._dialect import colour_expressions, mirror_colours
from ._exact import exact_statement
from ._shader import functions, triple
from .exporter import ColouredSurface, Export, Exporter, comment_lines


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """OSL text and its Statement."""
    statement = exact_statement("osl", surface, geom, "merl")
    name, finite, mirror = identifier(surface.name), colour_expressions(surface), mirror_colours(surface)
    comment = "\n".join("// " + line for line in comment_lines(surface, statement))
    return Export(f"""{comment}

{functions(surface, finite + mirror)}

color {name}_brdf(vector L, vector V, vector N_)
{{
    float ci = dot(N_, L);
    float cr = dot(N_, V);
    if (ci <= 0.0 || cr <= 0.0) {{ return color(0.0); }}
    vector l = L - ci * N_;
    vector v = V - cr * N_;
    float q = dot(l + v, l + v);
    float p = dot(l, v);
    ci = clamp(ci, 1.0e-6, 1.0);
    cr = clamp(cr, 1.0e-6, 1.0);
    return {triple(finite, "color")};
}}

color {name}_mirror(float cos_i)
{{
    float ci = clamp(cos_i, 1.0e-6, 1.0);
    return {triple(mirror, "color")};
}}

shader {name}(
    vector Light = vector(0, 0, 1) [[ string help = "unit vector toward the light" ]],
    normal Normal = N,
    output color Brdf = 0,
    output color Mirror = 0)
{{
    vector n = normalize(Normal);
    Brdf = {name}_brdf(normalize(Light), -I, n);
    Mirror = {name}_mirror(dot(n, -I));
}}
""", statement)  # fmt: skip


EXPORTER = Exporter(__name__, ".osl", "OSL functions and shader, any model with a formula exactly", export)
