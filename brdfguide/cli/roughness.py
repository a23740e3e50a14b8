"""`brdfguide roughness`: sigma and tau from the angle at which a mirror image emerges."""

import contextlib
import sys
from dataclasses import asdict, fields
from pathlib import Path
from typing import Annotated

from typer import Context, Option

from ..errors import InputError
from ..physics.emergence import DISTANCE_MM, PUPIL_MM, WAVELENGTH
from ..records import dataclass
from ..report.documents.emergence import document
from ..report.text import emergence
from ._options import FullOption, JsonOption, QuietOption, ThemeOption, answer, picture_file, remark
from ._request import is_typed, refuse, refuse_theme
from ._streams import say

MOST_LETTERS = 4096  # of a line of --batch
EXAMPLES = (
    "Examples: brdfguide roughness --angle 80 --slope 0.1 | brdfguide roughness --angle 75 --tau-um 5 --plot "
    "figure14.png"
)


@dataclass(frozen=True, eq=False, kw_only=True)
class Question:
    """What was seen, or is known, of the surface and of the eye."""

    angle: Annotated[float | None, Option("--angle", metavar="DEG", help="Angle of emergence, from the normal.")] = None
    angle_error: Annotated[
        float | None, Option("--angle-error", metavar="DEG", help="How well the angle was read; 2 unless given.")
    ] = None
    angle_across: Annotated[
        float | None,
        Option(
            "--angle-across",
            metavar="DEG",
            help="Of a grain: where it emerges across the grooves; --angle is along them, --slope across.",
        ),
    ] = None
    slope: Annotated[float | None, Option("--slope", help="sigma/tau; 0.1 if nothing is known.")] = None
    sigma_um: Annotated[float | None, Option("--sigma-um", help="Known rms height; asks for tau.")] = None
    tau_um: Annotated[
        float | None, Option("--tau-um", help="Known correlation length; asks for sigma. Both: for the angle.")
    ] = None
    wavelength_nm: Annotated[float, Option("--wavelength-nm", help="Where it was seen.")] = 1000 * WAVELENGTH
    pupil_mm: Annotated[float, Option("--pupil-mm", help="Diameter of the pupil that saw it.")] = PUPIL_MM
    distance_mm: Annotated[float, Option("--distance-mm", help="From surface to pupil.")] = DISTANCE_MM
    never: Annotated[bool, Option("--never", help="No emergence was seen, up to --angle (85): a lower bound.")] = False
    contour: Annotated[bool, Option("--contour", help="The whole contour as well.")] = False


@dataclass(frozen=True, eq=False, kw_only=True)
class RoughnessRequest:
    """Everything that `roughness` is asked."""

    context: Context
    question: Question
    batch: Annotated[
        str | None,
        Option("--batch", metavar="FILE", help="One request a line, `80` or `angle=80 slope=0.2`; - reads stdin."),
    ] = None
    mirror: Annotated[
        Path | None,
        Option(
            "--mirror",
            metavar="TABLE",
            help="A CSV of theta_deg and the mirror image's strength over that in black glass: R,G,B or attenuation.",
        ),
    ] = None
    highlight_half_width: Annotated[
        float | None,
        Option(
            "--highlight-half-width",
            metavar="DEG",
            help="How far the lamp moves until the highlight is half as bright: alpha of GGX and Beckmann.",
        ),
    ] = None
    plot: Annotated[
        Path | None,
        Option(
            "--plot",
            metavar="FILE",
            callback=picture_file,
            help="The report's Figure 14 with the answer on it, as .png, .svg or .pdf.",
        ),
    ] = None
    theme: ThemeOption = "light"
    json: JsonOption = False
    quiet: QuietOption = False
    full: FullOption = False


def roughness(request: RoughnessRequest) -> None:
    """Roughness from the angle of specular emergence: Eq. 3 and the He-Torrance criterion side by side."""
    question = asdict(request.question)
    if request.json:
        refuse(request.context, "full", because="--json holds everything")
    if request.plot is None:
        refuse_theme(request.context)
    if request.highlight_half_width is not None:
        _of_highlight(request, request.highlight_half_width)
        return
    if request.mirror is not None:
        _of_mirror_image(request, request.mirror)
        return
    if request.question.angle_across is not None:
        _of_grain(request)
        return
    del question["angle_across"]
    if request.batch is not None:
        refuse(request.context, "plot", "full", because="one answer at a time, without --batch")
        if not request.json:
            refuse(
                request.context,
                "contour",
                "never",
                because="--batch gives a row a line, which cannot say it; add --json",
            )
        sys.exit(_answer_all(request.batch, request.json, question))
    text, notes = emergence.answer_text(json=request.json, full=request.full, **question)
    if request.plot is not None:
        from ..report.figures import emergence as emergence_plot

        emergence_plot.plot_contours(document(**question), request.plot, request.theme)
        notes = [*notes, f"wrote {request.plot}"]
    say(text, end="")
    for each in notes:
        remark(f"note: {each}", request.quiet)


def _of_highlight(request: RoughnessRequest, lamp_deg: float) -> None:
    from ..report.documents.highlight import highlight_document
    from ..report.text.highlight import highlight_text

    others = [each.name for each in fields(Question)]
    refuse(
        request.context,
        *others,
        "mirror",
        "batch",
        "plot",
        "full",
        because="--highlight-half-width alone gives the alphas",
    )
    found = highlight_document(lamp_deg)
    answer(found, request.json, highlight_text)
    for each in found["warnings"] if not request.json else ():
        remark(f"note: {each['text']}", request.quiet)


def _of_grain(request: RoughnessRequest) -> None:
    """Both correlation lengths from two angles."""
    from ..report.documents.grained_emergence import grained_document
    from ..report.text.grained_emergence import grained_text

    asked = asdict(request.question)
    others = ("tau_um", "never", "contour", "batch", "plot", "full")
    refuse(request.context, *others, because="--angle-across gives both lengths and nothing else")
    if asked["angle"] is None:
        raise InputError("--angle-across needs --angle, where the image emerges along the grain")
    for name in ("tau_um", "never", "contour"):
        del asked[name]
    answer(grained_document(**asked), request.json, grained_text)


def _of_mirror_image(request: RoughnessRequest, table: Path) -> None:
    """Both numbers from a table; ends with status 1 where no surface of this kind gives it."""
    from ..report.documents.mirror_image import mirror_document
    from ..report.text.mirror_image import mirror_text

    asked = request.question
    others = (
        "angle",
        "angle_across",
        "angle_error",
        "slope",
        "sigma_um",
        "tau_um",
        "never",
        "contour",
        "batch",
        "plot",
        "full",
    )
    refuse(request.context, *others, because="--mirror has a table in place of the question")
    given = is_typed(request.context, "wavelength_nm")
    wavelength = asked.wavelength_nm / 1000 if given else None
    found = mirror_document(table, wavelength, asked.pupil_mm, asked.distance_mm)
    answer(found, request.json, mirror_text)
    if not found["meets_all"]:
        remark("brdfguide: no rough surface of one Gaussian height dims its mirror image so; a coat, or a wrong level?")
        sys.exit(1)


def _answer_all(source: str, json: bool, common: dict) -> int:
    """Answers line by line as they come; the largest exit status of them."""
    from io import TextIOWrapper

    from ..opening import open_for_reading

    worst = 0
    with contextlib.ExitStack() as stack:
        lines = sys.stdin
        if source != "-":
            raw = stack.enter_context(open_for_reading(source, source))
            lines = stack.enter_context(TextIOWrapper(raw, encoding="utf-8", errors="backslashreplace"))
        for text, status in emergence.batch(_lines(lines), json, **common):
            worst = max(worst, status)
            if not say(text, end=""):
                break
    return worst


def _lines(stream):
    """Lines as they come; what is beyond the length of a request is read and left out, however long it is."""
    while text := stream.readline(MOST_LETTERS):
        rest = text
        while rest and not rest.endswith("\n"):
            rest = stream.readline(MOST_LETTERS)
        yield text
