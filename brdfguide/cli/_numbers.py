"""What to type into other programs, as a block of an answer: in what people read, in JSON where it is asked for."""

from typing import Annotated

from typer import Option

from ._described import numbers_in_words

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
    """`numbers_in_words`; nothing where the block is not wanted."""
    page, json = request.pictures.report is not None, request.output.json
    if not shows_numbers(request.numbers, page, json):
        return ""
    return numbers_in_words(surfaces, document, measurement, asked=bool(request.numbers))
