"""What to type into other programs, as a block of an answer: where --numbers asks for it, and on every page."""

from typing import Annotated

from typer import Option

from .. import printable

NumbersOption = Annotated[
    bool, Option("--numbers", help="Also what to type into Blender, Arnold, OpenPBR, Unreal, glTF, Mitsuba, Radiance.")
]


def numbers_of(surfaces, request, document: dict, measurement=None) -> str:
    """Adds the block to the document and gives it in words; nothing where neither --numbers nor a page asks for it.
    `surfaces`: candidates for one, best first; none where there is no answer."""
    if not surfaces or not (request.numbers or request.pictures.report):
        return ""
    from ..face.beyond import numbers_to_type
    from ..report.text.numbers import card_text

    document["numbers"] = numbers_to_type(surfaces, measurement)
    return "\n\n" + card_text(printable.document(document)["numbers"])
