"""`brdfguide materials [NAME]`: described surfaces that come along, one of them, or the keys of a description."""

from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._options import JsonOption, answer

EXAMPLES = "Examples: brdfguide materials porcelain | brdfguide materials --keys"


def materials(
    name: Annotated[str | None, Argument(help="A material; none: all of them.")] = None,
    keys: Annotated[bool, Option("--keys", help="What a description may hold.")] = False,
    json: JsonOption = False,
) -> None:
    """List the described materials, show one with its sources, or list the keys of a description."""
    if keys and name is not None:
        raise InputError(f"--keys lists what any description may hold; {name} is one: ask for one of the two")
    if keys:
        document, text = _keys()
    elif name is None:
        document, text = _all()
    else:
        document, text = _one(name)
    answer(document, json, lambda _: text)


def _keys() -> tuple[dict, str]:
    """What a description may hold, as a document and as text."""
    from ..advice import material
    from ..report.documents import catalogue
    from ..report.text import table

    header = ("key", "takes", "meaning")
    rows = [
        (each.name, catalogue.takes(each), each.meaning)
        for field in material.FIELDS
        for each in (field, *catalogue.inner(field))
    ]
    keys = [dict(zip(header, row, strict=True)) for row in rows]
    return {"schema": "brdfguide/material-keys/1", "keys": keys}, table.columns(header, rows)


def _all() -> tuple[dict, str]:
    """Every described material, a line each."""
    from ..advice import library, material
    from ..report.text.catalogue import materials_text

    rows = []
    for name in library.library_names():
        made = material.read_material(library.path(name))
        of = made.given.get("kind") or made.composition or ""
        rows.append((name, of, made.given.get("appearance", ""), made.finish or "", made.given.get("about", "")))
    entries = [dict(zip(("name", "of", "appearance", "finish", "about"), row, strict=True)) for row in rows]
    return {"schema": "brdfguide/materials/1", "materials": entries}, materials_text(rows)


def _one(name: str) -> tuple[dict, str]:
    """One description as it stands in its file, with its sources."""
    from ..advice import library, material

    path = library.path(name)
    given = dict(material.read_material(path).given)
    document = {"schema": "brdfguide/materials/1", "name": path.stem, "given": given}
    return document, path.read_text(encoding="utf-8").rstrip()
