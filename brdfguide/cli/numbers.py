"""`brdfguide numbers SURFACE`: what to type into Blender, Arnold, Unreal and others for a surface."""

from typing import Annotated

from typer import Argument

from ._options import JsonOption, answer

EXAMPLES = 'Examples: brdfguide numbers porcelain | brdfguide numbers "gltf base_color=0.8,0.1,0.1 roughness=0.4"'


def numbers(
    surface: Annotated[
        str,
        Argument(
            metavar="SURFACE",
            help=(
                'A model or shader with its parameters in one word ("ward ward.alpha=0.1"), a fit (FIT.json, '
                "FIT.json#MODEL), or a material."
            ),
        ),
    ],
    json: JsonOption = False,
) -> None:
    """Print the numbers to type into other programs' shaders, and how far off each is by that program's own formula."""
    from ..exporters import coloured
    from ..exporters.cards import cards
    from ..face.surfaces import every_described, is_material, named_surface
    from ..report.documents.numbers import numbers_document
    from ..report.text.numbers import numbers_text

    if is_material(surface):
        found = [coloured(each, surface) for each in every_described(surface)]
    else:
        found = [named_surface(surface)]
    document = numbers_document(found[0].name, found[0].model.name, found[0].colour.how, cards(found))
    answer(document, json, numbers_text)
