"""MaterialX 1.39 documents: a shader node with inputs, and the surfacematerial that holds it."""

import numpy as np

from ..printable import identifier
from .exporter import ColouredSurface, Statement, comment_lines, number, rgb_numbers, xml_comment


def materialx_document(surface: ColouredSurface, statement: Statement, elements: list[str]) -> str:
    """The whole text; `elements` are lines inside <materialx>."""
    comment = xml_comment(comment_lines(surface, statement))
    return (
        f'<?xml version="1.0"?>\n{comment}\n<materialx version="1.39" colorspace="lin_rec709">\n'
        + "\n".join(elements)
        + "\n</materialx>\n"
    )


def shader(surface: ColouredSurface, node: str, inputs: dict, joined: dict[str, str] | None = None) -> list[str]:
    """Lines of one surface shader and its material; an input is (type, value), or a vector from a node by its name."""
    name = identifier(surface.name)
    lines = [f'  <{node} name="{name}_shader" type="surfaceshader">']
    lines += [f'    <input name="{key}" type="{kind}" value="{value}"/>' for key, (kind, value) in inputs.items()]
    lines += [f'    <input name="{key}" type="vector3" nodename="{made}"/>' for key, made in (joined or {}).items()]
    return [*lines, f"  </{node}>", *material(name)]


def turned_tangent(name: str, axis: float) -> list[str]:
    """Lines of the nodes that turn the tangent about the normal to an azimuth [rad]; the last is called `name`.

    `rotate3d` turns clockwise seen from above: its matrix takes rows (MaterialX 1.39.5, mx_rotate_vector3).
    """
    return [
        f'  <normal name="{name}_normal" type="vector3">',
        '    <input name="space" type="string" value="world"/>',
        "  </normal>",
        f'  <tangent name="{name}_u" type="vector3">',
        '    <input name="space" type="string" value="world"/>',
        "  </tangent>",
        f'  <rotate3d name="{name}" type="vector3">',
        f'    <input name="in" type="vector3" nodename="{name}_u"/>',
        f'    <input name="amount" type="float" value="{-np.degrees(axis):.9g}"/>',
        f'    <input name="axis" type="vector3" nodename="{name}_normal"/>',
        "  </rotate3d>",
    ]


def material(name: str) -> list[str]:
    return [
        f'  <surfacematerial name="{name}" type="material">',
        f'    <input name="surfaceshader" type="surfaceshader" nodename="{name}_shader"/>',
        "  </surfacematerial>",
    ]


def colour3(values, low: float, high: float, what: str) -> tuple[str, str]:
    return "color3", ", ".join(f"{value:.9g}" for value in rgb_numbers(values, low, high, what))


def float_value(value, low: float, high: float, what: str) -> tuple[str, str]:
    return "float", f"{number(np.ravel(value)[0], low, high, what):.9g}"
