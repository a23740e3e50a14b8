"""`brdfguide preview SURFACE...`: how it looks among lights on a floor, beside others."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._options import QuietOption, on_terminal, remark

EXAMPLES = (
    'Examples: brdfguide preview "lambertian+ggx ggx.alpha=0.1" -o look.png | '
    "brdfguide preview fit.json --compare fit.json#lambertian+phong --light back -o pair.png | "
    "brdfguide preview ggx --row alpha=0.1..0.9 -o row.png | brdfguide preview fits/answers/*/*.json -o sheet.png"
)
LARGE, SMALL, FEW = 512, 256, 2  # pixels of a surface, where there are few and where there are more
MOST = 60  # surfaces of a sheet


def preview(
    surface: Annotated[
        list[str],
        Argument(
            metavar="SURFACE...",
            help=(
                'Models with their parameters in one word each ("ward ward.alpha=0.1"), fits (FIT.json, '
                "FIT.json#MODEL), materials, or MATERIAL#MODEL; several make a contact sheet."
            ),
        ),
    ],
    compare: Annotated[
        list[str] | None,
        Option("--compare", "-c", help="Another surface beside it, and what differs in noticeable steps; repeatable."),
    ] = None,
    row: Annotated[
        str | None, Option("--row", help="One number step by step, NAME=LOW..HIGH or NAME=LOW..HIGH/STEPS.")
    ] = None,
    output: Annotated[Path, Option("--output", "-o", help="The picture, .png, or .exr with linear radiances.")] = Path(
        "preview.png"
    ),
    env: Annotated[
        str,
        Option("--env", help="What stands around: studio, overcast, room, sky, or an equirectangular FILE.exr."),
    ] = "studio",
    objects: Annotated[
        str | None, Option("--object", help="What it is seen on: pair (the default), sphere, sheet, disc or knob.")
    ] = None,
    light: Annotated[
        str | None, Option("--light", help="Where the main light stands: side (the default), front or back.")
    ] = None,
    size: Annotated[
        int | None, Option("--size", help="Pixels, for each surface: 512, or 256 of more than two.")
    ] = None,
    quiet: QuietOption = False,
) -> None:
    """Render a surface on objects that stand on a floor among lights, in linear light; several side by side."""
    from dataclasses import replace
    from functools import partial

    from ..face import functions
    from ..files import writable

    if size is not None and not 64 <= size <= 2048:
        raise InputError(f"--size {size}: a picture has 64 to 2048 pixels")
    if writable(output).suffix.lower() not in (".png", ".exr"):
        raise InputError(f"{output}: a preview is a .png or .exr")
    shown = _shown(surface, compare or [], row)
    side = size or (LARGE if len(shown) <= FEW else SMALL)
    shows = partial(_progress, quiet=quiet)
    made = functions.preview(*shown, size=side, light=light, around=env, objects=objects, progress=shows)
    made = replace(made, compared=bool(compare))
    made.save(output)
    remark(f"{output}: {' | '.join(each.name for each in made.surfaces)}", quiet)


def _shown(surfaces: list[str], compared: list[str], row: str | None) -> list:
    """Words for surfaces, or the surfaces of a row. Raises InputError for options that do not go together."""
    if len(surfaces) > 1 and (compared or row):
        option = "--compare" if compared else "--row"
        raise InputError(f"{option}: wanted one surface before it, found {len(surfaces)}")
    if compared and row:
        raise InputError("--row: stands alone; without --compare")
    if len(surfaces) + len(compared) > MOST:
        raise InputError(f"{len(surfaces) + len(compared)} surfaces; a sheet holds at most {MOST}")
    if not row:
        return [*surfaces, *compared]
    from ..face.staging import row_of
    from ..face.surfaces import named_surface

    return row_of(named_surface(surfaces[0]), row)


def _progress(name: str, quiet: bool):
    """A line that fills on a terminal, nothing elsewhere."""
    import sys

    if quiet or not on_terminal(sys.stderr):
        return None

    def show(share: float) -> None:
        print(
            f"\r{name} {'█' * int(30 * share):<30} {100 * share:3.0f} %",
            end="\n" if share >= 1 else "",
            file=sys.stderr,
            flush=True,
        )

    return show
