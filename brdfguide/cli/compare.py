"""`brdfguide compare A B...`: how different two surfaces look side by side, and where."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Option

from ..errors import InputError
from ..records import dataclass
from ._data import AnywayOption, ApertureOption
from ._options import JsonOption, QuietOption, ThemeOption, answer, picture_file, remark
from ._request import refuse, refuse_theme

EXAMPLES = (
    'Examples: brdfguide compare "lambertian+ggx ggx.alpha=0.1" "lambertian+ggx ggx.alpha=0.12" | '
    "brdfguide compare scan.csv fit.json fit.json#lambertian+phong | brdfguide compare porcelain --to gltf"
)
OF_TWO = "two surfaces are drawn; there are more"


@dataclass(frozen=True, eq=False, kw_only=True)
class CompareRequest:
    """Everything that `compare` is asked."""

    context: Context
    surfaces: Annotated[
        list[str],
        Argument(
            metavar="A B...",
            help=(
                'A model with its parameters in one word ("ward ward.alpha=0.1"), a fit (FIT.json, FIT.json#MODEL), '
                "a material, or measured data. More than two: the first against each of the others."
            ),
        ),
    ]
    to: Annotated[
        str | None, Option("--to", help="The one surface against what its file for this target will show.")
    ] = None
    aperture_deg: ApertureOption = None
    anyway: AnywayOption = False
    plot: Annotated[
        Path | None,
        Option("--plot", callback=picture_file, help="Draw both and their difference in lightness (png, svg or pdf)."),
    ] = None
    theme: ThemeOption = "light"
    json: JsonOption = False
    quiet: QuietOption = False


def compare(request: CompareRequest) -> None:
    """How different surfaces look side by side: the difference in lightness L* of spheres under lamps all around."""
    from ..face.sides import compared_side, exported
    from ..fitting.side_by_side import pair
    from ..physics.aperture import solid_angle_of
    from ..report.documents import compare as documents
    from ..report.text import compare as texts

    if request.to is None and len(request.surfaces) < 2:
        raise InputError("one surface has nothing to be compared with; name two, or a target with --to")
    if len(request.surfaces) > 2:
        refuse(request.context, "plot", "theme", because=OF_TWO)
    if request.plot is None:
        refuse_theme(request.context)
    if request.to is None:
        sides = [compared_side(words, request.anyway) for words in request.surfaces]
    else:
        if len(request.surfaces) > 1:
            raise InputError(f"--to {request.to}: one surface at a time, found {len(request.surfaces)}")
        refuse(request.context, "aperture_deg", because="a file is looked at as a point sees it")
        sides = exported(request.surfaces[0], request.to)
    if all(side.through_apertures for side in sides):
        refuse(request.context, "anyway", because="it is about measured data, and there are none")
    if not any(side.through_apertures for side in sides):
        refuse(request.context, "aperture_deg", because="measured values are what a detector read already")
    solid_angle = None if request.aperture_deg is None else solid_angle_of(request.aperture_deg)
    first, *others = sides
    found = [pair(first, each, solid_angle) for each in others]
    if len(found) > 1:
        result = documents.of_many(found)
        answer(result, request.json, texts.many_text)
        return
    result = documents.of_pair(found[0])
    if request.plot:
        draw(sides[0], sides[1], result, request.plot, request.theme)
        remark(f"wrote {request.plot}", request.quiet)
    answer(result, request.json, texts.pair_text)


def draw(one, other, result: dict, path: Path, theme: str) -> None:
    """The picture of two sides. Raises InputError for scattered samples."""
    from ..report.figures import style
    from ..report.figures.pair import pair_figure

    measured = next((side.name for side in (one, other) if side.measured is not None), None)
    if measured:
        raise InputError(f"--plot: {measured} holds measured directions, and a sphere shows all of them; fit it first")
    style.save(pair_figure(one, other, f"S {result['seen']:.1f} L*: {result['seen_words']}"), path, theme)
