"""`brdfguide inspect DATA`: what a data file is, what is wrong with it, and what each finding changes."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Exit, Option

from ..errors import InputError
from ..records import dataclass
from ._data import Reading, TurnedOption
from ._many import Many
from ._options import JsonOption, ThemeOption, answer, picture_file, print_json, working
from ._request import refuse, refuse_theme

EXAMPLES = "Examples: brdfguide inspect run.csv --plot run.png | brdfguide inspect gold-paint.binary --json"


@dataclass(frozen=True, eq=False, kw_only=True)
class InspectRequest:
    """Everything that `inspect` is asked."""

    context: Context
    data: Annotated[
        list[Path] | None,
        Argument(
            metavar="[DATA]...",
            help=(
                "A file of measured data: tables of many kinds, MERL, RGL, Cornell, Zemax, FRED, LightTools, ALTA, "
                "ASTM E1392, OpenMATERIAL; photographs of a ball, described in YAML; - for standard input. Several, or "
                "a folder: a row each."
            ),
        ),
    ] = None
    reading: Reading
    turned: TurnedOption = None
    plot: Annotated[
        Path | None,
        Option(
            "--plot", callback=picture_file, help="Draw coverage, values, reciprocity and energy (png, svg or pdf)."
        ),
    ] = None
    theme: ThemeOption = "light"
    many: Many
    sarif: Annotated[bool, Option("--sarif", help="What was found as SARIF 2.1.0, for editors and hosts of code.")] = (
        False
    )
    json: JsonOption = False


def inspect(request: InspectRequest) -> None:
    """Say what a data file is: format, coverage, quantity, conventions, reciprocity, energy, gaps, spikes, noise."""
    from ..data import examine, formats, joined
    from ..report.documents import inspection
    from ..report.documents.sarif import sarif_document
    from ..report.text.inspection import text

    if request.plot is None:
        refuse_theme(request.context)
    if request.json:
        refuse(request.context, "sarif", because="--json is another form of the same answer")
    options, words = request.reading.options(), [str(each) for each in request.data or ()]
    if not words and request.many.files_from is None:
        raise InputError("no DATA: wanted a file of measured data, several, a folder, or --files-from LIST")
    if request.many.is_many(words) and not request.turned:
        refuse(request.context, "sarif", because="one file at a time")
        raise Exit(_inspect_many(request, words))
    request.many.refuse_for_one(request.context)
    if request.turned:
        turns = joined.turn_angles(request.turned)
        measurement = joined.read_turned(list(map(Path, words)), turns, anyway=True, **options)
    else:
        with working(f"reading {Path(words[0]).name}"):
            measurement = formats.read(words[0], **options)
    with working(f"examining {Path(words[0]).name}"):
        found = examine.examine(measurement)
        result = inspection.document(measurement, found, examine.changes(measurement, found))
    if request.plot:
        from ..report.figures import inspection as survey

        with working(f"drawing {request.plot.name}"):
            looked_at, spiky, pairs, level = examine.plotted(measurement)
            survey.plot_survey(looked_at, spiky, pairs, level, request.plot, str(words[0]), request.theme)
    if request.sarif:
        print_json(sarif_document(result))
        return
    answer(result, request.json, text)


def _inspect_many(request: InspectRequest, words: list[str]) -> int:
    """A row for each file; the exit status."""
    from ..batch.other_work import InspectWork
    from ._batch import Batch, answer_many, tasks_of

    context, many = request.context, request.many
    refuse(context, "plot", "theme", because="a picture is of one file")
    work = InspectWork(reading=tuple(request.reading.options().items()))
    tasks = tasks_of(many.labels(context, words), work)
    return answer_many(
        Batch(context=context, many=many, work=work, kind="inspect", json=request.json, quiet=False), tasks
    )
