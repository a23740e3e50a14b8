"""`brdfguide preview SURFACE`: how it looks, on a sphere and a bent sheet, beside others."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._options import QuietOption, on_terminal, remark

EXAMPLES = (
    'Examples: brdfguide preview "lambertian+ggx ggx.alpha=0.1" -o look.png | '
    "brdfguide preview fit.json --compare fit.json#lambertian+phong --light back -o pair.png"
)


def preview(
    surface: Annotated[
        str,
        Argument(
            metavar="SURFACE",
            help=(
                'A model with its parameters in one word ("ward ward.alpha=0.1"), a fit (FIT.json, FIT.json#MODEL), '
                "a material, or MATERIAL#MODEL."
            ),
        ),
    ],
    compare: Annotated[
        list[str] | None, Option("--compare", "-c", help="Another surface to stand beside it; repeatable.")
    ] = None,
    output: Annotated[Path, Option("--output", "-o", help="The picture, .png, or .exr with linear radiances.")] = Path(
        "preview.png"
    ),
    light: Annotated[str, Option("--light", help="Where the sun stands: front, side or back.")] = "side",
    size: Annotated[int, Option("--size", help="Pixels, for each surface.")] = 512,
    quiet: QuietOption = False,
) -> None:
    """Render a surface on a sphere and a bent sheet under a small sun and a sky with a horizon, in linear light."""
    from functools import partial

    from ..face import functions
    from ..files import writable

    if not 64 <= size <= 2048:
        raise InputError(f"--size {size}: a picture has 64 to 2048 pixels")
    if writable(output).suffix.lower() not in (".png", ".exr"):
        raise InputError(f"{output}: a preview is a .png or .exr")
    shows = partial(_progress, quiet=quiet)
    made = functions.preview(surface, *(compare or ()), size=size, light=light, progress=shows)
    made.save(output)
    remark(f"{output}: {' | '.join(each.name for each in made.surfaces)}", quiet)


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
