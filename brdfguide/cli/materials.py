"""`brdfguide materials [NAME]`: described surfaces that come with the program, one of them, or the keys of a description."""

from typing import Annotated

from typer import Argument, Option

from ._options import JsonOption, print_json

EXAMPLES = "Examples: brdfguide materials porcelain | brdfguide materials --keys"


def materials(
    name: Annotated[str | None, Argument(help="A material; none: all of them.")] = None,
    keys: Annotated[bool, Option("--keys", help="What a description may hold.")] = False,
    json: JsonOption = False,
) -> None:
    """List the described materials, show one with its sources, or list the keys of a description."""
    from .. import material, shelf
    from ..report import table

    if keys:
        fields = [(each.name, table.takes(each), each.meaning) for field in material.FIELDS for each in (field, *table.inner(field))]
        document = {"schema": "brdfguide/material-keys/1", "keys": [{"key": k, "takes": t, "meaning": m} for k, t, m in fields]}
        text = table.columns(("key", "takes", "meaning"), fields)
    elif name is None:
        found = [(each, material.read_material(shelf.path(each))) for each in shelf.names()]
        rows = [(each, made.given.get("kind") or made.composition or "", made.given.get("appearance", ""), made.finish or "", made.given.get("about", "")) for each, made in found]
        header = ("material", "kind or substance", "appearance", "finish", "about")
        document = {"schema": "brdfguide/materials/1", "materials": [dict(zip(("name", "of", "appearance", "finish", "about"), row)) for row in rows]}
        text = table.columns(header, rows)
    else:
        path = shelf.path(name)
        made = material.read_material(path)
        document = {"schema": "brdfguide/materials/1", "name": path.stem, "given": dict(made.given)}
        text = path.read_text(encoding="utf-8").rstrip()
    print_json(document) if json else print(text)
