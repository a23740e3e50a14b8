"""Radiance: a BRTDfunc material and its .cal file, which holds the model's own law with its numbers.

Radiance evaluates it for light sources; what a lobe reflects of other surfaces is not followed. A Lambertian body is
handed over as Radiance's own, which is, and so is an ideal mirror, with its reflectance at every angle.
"""

from dataclasses import replace

import numpy as np

from ..physics.geometry import Geometry
from ..printable import identifier, word
from ._dialect import colour_expressions, mirror_colours, needed, prefixed
from ._exact import exact_statement
from .exporter import ColouredSurface, Export, Exporter, comment_lines, rgb_numbers

NOTE = "function materials act on light sources; reflections of other surfaces in the lobe are not followed"
GEOMETRY = """{ light direction lx ly lz, normal, ray: cosines, |i_xy + r_xy| squared and i_xy . r_xy }
bg_side = if(Rdot, 1, -1);
bg_cr = bg_side * Rdot;
bg_ci(lx,ly,lz) = bg_side * (lx*NxP + ly*NyP + lz*NzP);
bg_part(l,d,n,c) : bg_sq(l - d - n*c);
bg_q(lx,ly,lz,c) = bg_part(lx,Dx,NxP,c) + bg_part(ly,Dy,NyP,c) + bg_part(lz,Dz,NzP,c);
bg_p(lx,ly,lz) = -(lx*Dx + ly*Dy + lz*Dz) - bg_ci(lx,ly,lz)*bg_cr;
"""
# orders eight at a time, since Radiance warns beyond 100 nested calls; those past the count add what is left
TOTAL = """bg_four(i,{a}) : bg_order(i,{a}) + bg_order(i + 1,{a}) + bg_order(i + 2,{a}) + bg_order(i + 3,{a});
bg_orders(i,count,{a}) : if(count - i - 0.5, bg_four(i,{a}) + bg_four(i + 4,{a}) + bg_orders(i + 8,count,{a}), 0);
bg_nodes(t,{a}) : if(8.5 - t, bg_trapezoid(t,{a}) + bg_nodes(t + 0.6,{a}), 0);
bg_total({a}) : if(7 - w, bg_orders(0,ceil(top + 12*w + 14 - bg_first_order(top,w)),{a}), bg_nodes(-8.4,{a}));"""


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """The .rad text, the .cal beside it, and the Statement."""
    statement = exact_statement("radiance-cal", surface, geom, "radiance", notes=(NOTE,))
    lines, name, file = comment_lines(surface, statement), identifier(surface.name), f"{word(stem)}.cal"
    body, rest = _without_body(surface)
    finite, mirror = _three(colour_expressions(rest)), _three(mirror_colours(rest))
    cal = [
        "{",
        *("  " + line.replace("{", "(").replace("}", ")") for line in lines),
        "}",
        "",
        "bg_choose(c,a,b) : if(c, a, b);",
    ]
    for formula, arguments, text in needed(rest, [*finite, *mirror, "sq(ci)"]):
        arguments = arguments.replace(" ", "")
        cal += [TOTAL.format(a=arguments) if formula == "total" else f"bg_{formula}({arguments}) : {prefixed(text)};"]
    cal += ["", GEOMETRY]
    for colour, text, shine in zip(COLOURS, finite, mirror, strict=True):
        cal += [
            f"bg_{colour}(ci,cr,q,p) : {prefixed(text)};",
            f"{name}_{colour}(lx,ly,lz) = bg_lit_{colour}(bg_ci(lx,ly,lz),lx,ly,lz);",
            (
                f"bg_lit_{colour}(ci,lx,ly,lz) = if(ci, bg_{colour}(ci,bg_cr,bg_q(lx,ly,lz,ci + "
                f"bg_cr),bg_p(lx,ly,lz)), 0);"
            ),
            f"bg_shine_{colour}(ci) : {prefixed(shine)};",
            f"{name}_mirror_{colour} = bg_shine_{colour}(bg_cr);",
        ]
    functions = [f"{name}_mirror_{c}" for c in COLOURS] + ["0", "0", "0"] + [f"{name}_{c}" for c in COLOURS]
    rad = [f"# {line}" for line in lines]
    rad += [
        "",
        f"void BRTDfunc {name}",
        f"10 {' '.join(functions)} {file}",
        "0",
        "9 " + " ".join(f"{value:.9g}" for value in body) + " 0 0 0 0 0 0",
    ]
    return Export("\n".join(rad) + "\n", statement, {file: "\n".join(cal) + "\n"})


COLOURS = ("red", "green", "blue")


def _without_body(surface: ColouredSurface) -> tuple[list[float], ColouredSurface]:
    """The Lambertian body's colour and the surface without it."""
    bodies = [term for term in surface.model.terms if term.model.name == "lambertian"]
    if len(bodies) != 1 or np.any(surface.linear(surface.values_of(bodies[0])["albedo"]) > 1):
        return [0.0, 0.0, 0.0], surface  # a colour brighter than white stays in the function
    colour = rgb_numbers(surface.linear(surface.values_of(bodies[0])["albedo"]), 0.0, 1.0, "diffuse")
    label = bodies[0].label
    rest = replace(surface.model, terms=tuple(term for term in surface.model.terms if term.label != label))
    values = {key: value for key, value in surface.values.items() if not key.startswith(label + ".")}
    return colour, replace(surface, model=rest, values=values)


def _three(expressions: list[str]) -> list[str]:
    return expressions * (3 if len(expressions) == 1 else 1)


EXPORTER = Exporter(
    __name__, ".rad", "Radiance function material and .cal, any model with a formula exactly for light sources", export
)
