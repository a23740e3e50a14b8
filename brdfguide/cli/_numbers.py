"""What to type into other programs, as a block of an answer: in what people read, in JSON where it is asked for."""

from typing import Annotated

from typer import Option

from .. import printable

NumbersOption = Annotated[
    bool | None,
    Option(
        "--numbers/--no-numbers",
        help="What to type into Blender, Arnold, OpenPBR, Unreal, glTF and others; in --json only where asked for.",
        show_default=False,
    ),
]


def shows_numbers(numbers: bool | None, page: bool, json: bool) -> bool:
    """Whether the answer has the block: a page always, a person unless told not to, a program if it asks."""
    return page or (not json if numbers is None else numbers)


def numbers_of(surfaces, request, document: dict, measurement=None) -> str:
    """Adds the block to the document and gives it in words; nothing where it is not wanted, or where nobody asked and
    there are none. `surfaces`: candidates for one, best first; none where there is no answer."""
    page, json = request.pictures.report is not None, request.output.json
    if not surfaces or not shows_numbers(request.numbers, page, json):
        return ""
    from ..face.beyond import numbers_to_type
    from ..report.text.numbers import card_text

    found = numbers_to_type(surfaces, measurement, asked=bool(request.numbers))
    if not found:
        return ""
    document["numbers"] = found
    return "\n\n" + card_text(printable.document(document)["numbers"])
