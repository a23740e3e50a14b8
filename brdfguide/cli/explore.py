"""`brdfguide explore [SURFACE...]`: one HTML file to turn a surface's knobs in, with data beside it."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._options import QuietOption, output_file, remark, working

EXAMPLES = (
    "Examples: brdfguide explore fit.json --data scan.csv | "
    'brdfguide explore porcelain "lambertian+ggx ggx.alpha=0.1" -o look.html'
)


def _page(path: Path) -> Path:
    if path.suffix.lower() not in (".html", ".htm"):
        raise InputError(f"{path}: a page is a .html")
    return output_file(path) or path


def explore(
    surface: Annotated[
        list[str] | None,
        Argument(
            metavar="[SURFACE...]",
            help=(
                'Models with their parameters in one word each ("ward ward.alpha=0.1"), fits (FIT.json, '
                "FIT.json#MODEL) or materials; without one, two models, or the best of a fit to --data."
            ),
        ),
    ] = None,
    data: Annotated[
        Path | None, Option("--data", help="A measurement: its points and the error that every change costs.")
    ] = None,
    output: Annotated[Path, Option("--output", "-o", callback=_page, help="The page, .html.")] = Path("explore.html"),
    quiet: QuietOption = False,
) -> None:
    """Write one page with sliders for every number, a picture, lobes, data with the live error, and the contours."""
    from ..face.explorer import explorer_html

    with working(f"fitting {data.name}" if data and not surface else f"making {output.name}", quiet):
        text, names = explorer_html(tuple(surface or ()), data)
    from ..files import write_whole

    write_whole(output, text)
    remark(f"{output}: {' | '.join(names)}; {len(text.encode()) / 1000:.0f} kB, opens in any browser", quiet)
