"""`brdfguide albedo`: Lambertian albedo from a comparison with known reflectances."""

from pathlib import Path
from typing import Annotated

from typer import Context, Option

from ..errors import InputError
from ..records import dataclass
from ._options import JsonOption, QuietOption, answer, remark
from ._request import refuse

EXAMPLES = (
    "Examples: brdfguide albedo --between white 'neutral 8' --position 0.3 | brdfguide albedo --photo desk.jpg "
    "--sample 448,180,70,120"
)
PHOTO = "Photograph"
MOST_PHOTOS = 2


@dataclass(frozen=True, eq=False, kw_only=True)
class AlbedoRequest:
    """Everything that `albedo` is asked."""

    context: Context
    patch: Annotated[str | None, Option("--patch", help="The ColorChecker neutral that looks as light.")] = None
    between: Annotated[tuple[str, str] | None, Option("--between", help="Two neutrals it lies between.")] = None
    position: Annotated[float, Option("--position", help="0 at the first of the two, 1 at the second.")] = 0.5
    ratio: Annotated[float | None, Option("--ratio", help="Photometer: surface over reference.")] = None
    reference: Annotated[float | None, Option("--reference", help="Reflectance of that reference.")] = None
    data_set: Annotated[str, Option("--data-set", help="Whose chart: average or iso17321.")] = "average"
    photo: Annotated[
        list[Path] | None,
        Option(
            "--photo",
            help="A picture of the surface beside a ColorChecker; twice, with the lamp moved, to tell gloss.",
            rich_help_panel=PHOTO,
        ),
    ] = None
    chart: Annotated[
        tuple[str, str, str, str] | None,
        Option(
            "--chart",
            metavar="X,Y X,Y X,Y X,Y",
            help="The chart's four corners [px], from the dark skin's on along its row; else it is looked for.",
            rich_help_panel=PHOTO,
        ),
    ] = None
    sample: Annotated[
        str | None,
        Option("--sample", metavar="X,Y,W,H", help="Where the surface is in it [px].", rich_help_panel=PHOTO),
    ] = None
    json: JsonOption = False
    quiet: QuietOption = False


def albedo(request: AlbedoRequest) -> None:
    """Albedo by comparison with a ColorChecker or a photometer's reference; nothing asked: the chart's neutrals."""
    _check(request)
    if request.photo:
        _of_photos(request)
        return
    from ..physics import colorchecker as chart
    from ..report.documents import neutrals
    from ..report.text.neutrals import chart_text, text

    chart.patch("white", request.data_set)
    if request.ratio is not None and request.reference is not None:
        document = neutrals.of_ratio(request.ratio, request.reference)
    elif request.between is not None:
        document = neutrals.of_two(*request.between, request.position, request.data_set)
    elif request.patch is not None:
        document = neutrals.of_neutral(request.patch, request.data_set)
    else:
        document = neutrals.chart_document(request.data_set)
        answer(document, request.json, chart_text)
        return
    answer(document, request.json, text)
    for each in document["warnings"] if not request.json else ():
        remark(f"note: {each['text']}", request.quiet)


def _check(request: AlbedoRequest) -> None:
    """Raises InputError for comparisons that exclude each other, and for options without effect."""
    given = {
        "--patch": request.patch,
        "--between": request.between,
        "--ratio": request.ratio,
        "--photo": request.photo or None,
    }
    asked = [name for name, value in given.items() if value is not None]
    if len(asked) > 1:
        raise InputError(f"{' and '.join(asked)} are different comparisons; give one")
    if (request.ratio is None) != (request.reference is None):
        raise InputError("--ratio and --reference go together")
    if request.between is None:
        refuse(request.context, "position", because="it lies between the two neutrals of --between, which is not given")
    if request.ratio is not None:
        refuse(request.context, "data_set", because="--ratio compares with a reference, not with a chart")
    if not request.photo:
        refuse(request.context, "chart", "sample", because="they are places in a picture; --photo names it")


def _of_photos(request: AlbedoRequest) -> None:
    from ..physics.colorchecker import DATA_SETS, patch

    patch("white", request.data_set)
    photos = request.photo or []
    if len(photos) > MOST_PHOTOS:
        raise InputError(f"{len(photos)} times --photo: one picture, or two with the lamp moved between them")
    if request.sample is None:
        raise InputError("--photo needs --sample x,y,width,height: where the surface is in the picture, in pixels")
    area = [int(each) for each in _numbers("--sample", request.sample, 4)]
    corners = None if request.chart is None else [_numbers("--chart", each, 2) for each in request.chart]
    from ..photographs.chart_answer import chart_answer
    from ..report.documents.photo_albedo import document
    from ..report.text.photo_albedo import text

    others = [name for name in DATA_SETS if name != request.data_set]
    found = document(chart_answer(photos, corners, area, [request.data_set, *others]))
    answer(found, request.json, text)
    for each in found["warnings"] if not request.json else ():
        remark(f"note: {each['text']}; {each['consequence']}", request.quiet)


def _numbers(option: str, text: str, count: int) -> list[float]:
    try:
        numbers = [float(each) for each in text.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != count or not all(abs(each) < 1e6 for each in numbers):
        form = "x,y,width,height" if count == 4 else "x,y"
        raise InputError(
            f"{option} {text}: wanted {form} in pixels, such as {'448,180,70,120' if count == 4 else '43,102'}"
        )
    return numbers
