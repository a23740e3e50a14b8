"""MaterialX 1.39 documents: a shader node with inputs, and the surfacematerial that holds it."""

from xml.sax.saxutils import quoteattr

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


def shader(surface: ColouredSurface, node: str, inputs: dict) -> list[str]:
    """Lines of one surface shader and its material; an input is (type, value)."""
    name = identifier(surface.name)
    lines = [f'  <{node} name="{name}_shader" type="surfaceshader">']
    lines += [f'    <input name="{key}" type="{kind}" value="{value}"/>' for key, (kind, value) in inputs.items()]
    return [*lines, f"  </{node}>", *material(name)]


def material(name: str) -> list[str]:
    quoted = quoteattr(name)
    return [
        f'  <surfacematerial name={quoted} type="material">',
        f'    <input name="surfaceshader" type="surfaceshader" nodename="{name}_shader"/>',
        "  </surfacematerial>",
    ]


def colour3(values, low: float, high: float, what: str) -> tuple[str, str]:
    return "color3", ", ".join(f"{value:.9g}" for value in rgb_numbers(values, low, high, what))


def float_value(value, low: float, high: float, what: str) -> tuple[str, str]:
    return "float", f"{number(np.ravel(value)[0], low, high, what):.9g}"
