"""Mitsuba 3, XML: a `<bsdf>` that loads by itself and through `<include>`; its id is the surface's name."""

from ..physics.geometry import Geometry
from ..printable import identifier
from ._mitsuba import tree
from .exporter import ColouredSurface, Export, Exporter, comment_lines, xml_comment


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """XML text and its Statement."""
    plugins, statement = tree(surface, geom, "mitsuba")
    body = "\n".join(_element(plugins, "bsdf", f' id="{identifier(surface.name)}" version="3.0.0"', 0))
    return Export(f"{xml_comment(comment_lines(surface, statement))}\n{body}\n", statement)


def _element(plugin: dict, tag: str, attributes: str, depth: int):
    """A plugin as lines of XML."""
    pad = "  " * depth
    yield f'{pad}<{tag} type="{plugin["type"]}"{attributes}>'
    for name, value in plugin.items():
        if name == "type":
            continue
        if isinstance(value, dict) and value["type"] == "rgb":
            yield f'{pad}  <rgb name="{name}" value="{_spaced(value["value"])}"/>'
        elif isinstance(value, dict) and value["type"] == "srgb":
            yield (
                f'{pad}  <texture name="{name}" type="srgb"><rgb name="color" '
                f'value="{_spaced(value["color"])}"/><boolean name="unbounded" value="true"/></texture>'
            )
        elif isinstance(value, dict):
            yield from _element(value, "bsdf", "", depth + 1)
        elif isinstance(value, str):
            yield f'{pad}  <string name="{name}" value="{value}"/>'
        else:
            yield f'{pad}  <float name="{name}" value="{value:.9g}"/>'
    yield f"{pad}</{tag}>"


def _spaced(values) -> str:
    return " ".join(f"{value:.9g}" for value in values)


EXPORTER = Exporter(
    __name__, ".xml", "Mitsuba 3 scene element (diffuse, roughconductor, conductor, blended)", export, grained=True
)
