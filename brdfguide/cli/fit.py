"""`brdfguide fit DATA`: fits the candidate models to a measurement and ranks them."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Exit, Option

from .. import printable
from ..errors import InputError, NoAnswer
from ..records import dataclass
from ._data import AnywayOption, ApertureOption, Reading, TurnedOption
from ._fitting import Fitting, expressions
from ._many import ONE, PANEL, Many
from ._numbers import NumbersOption, shows_numbers
from ._options import FullOption, Output, command_line, is_pattern, output_file, progress, working
from ._report import ANGLE, Pictures, checked_axis, print_ranking, show_ranking
from ._request import refuse
from ._scene import SceneOption
from ._surface import AsOption, Exporting, export_fitted

EXAMPLES = "Examples: brdfguide fit examples/rough_plastic.csv --plot fit.png | brdfguide fit *.csv --jobs 2 --out fits"

BEYOND = (
    "scene",
    "explain",
    "next_",
    "baselines",
    "as_",
    "numbers",
    "explore",
)  # blocks of the document that no row shows


@dataclass(frozen=True, eq=False, kw_only=True)
class FitRequest:
    """Everything that `fit` is asked, of one file or of many."""

    context: Context
    data: Annotated[
        list[str] | None,
        Argument(
            metavar="[DATA]...",
            help="Measured data, any format that `inspect` reads; - for standard input. Several, a folder: a row each.",
        ),
    ] = None
    fitting: Fitting
    reading: Reading
    turned: TurnedOption = None
    aperture_deg: ApertureOption = None
    anyway: AnywayOption = False
    scene: SceneOption = None
    pictures: Pictures
    x: Annotated[
        str,
        Option(
            "--x",
            callback=checked_axis,
            help="What --plot is drawn over: angle, beta for |beta - beta0|, polar, or 3d for the lobe in space.",
        ),
    ] = ANGLE
    residuals: Annotated[
        Path | None,
        Option("--residuals", callback=output_file, help="Write ln(model/data) of the recommended model as CSV."),
    ] = None
    explain: Annotated[bool, Option("--explain", help="How candidates grew: what each step saw, tried and took.")] = (
        False
    )
    next_: Annotated[bool, Option("--next", help="Name the directions where one more measurement would tell most.")] = (
        False
    )
    baselines: Annotated[
        bool,
        Option("--baselines", help="What general representations take for the same data: harmonics, wavelets, a net."),
    ] = False
    basis_from: Annotated[
        Path | None,
        Option("--basis-from", help="With --baselines also a linear basis of the tables in this folder."),
    ] = None
    group: Annotated[
        str | None,
        Option("--group", help="Each value of this column is a surface of its own: a row each.", rich_help_panel=PANEL),
    ] = None
    products: Annotated[
        str | None,
        Option("--products", help="Beside each answer: report,plot,residuals,export:TARGET.", rich_help_panel=PANEL),
    ] = None
    many: Many
    as_: AsOption = None
    numbers: NumbersOption = None
    exporting: Exporting
    output: Output
    full: FullOption = False

    def job(self):
        """What is done to each file, as `fitting.job.Job`."""
        from ..data.joined import turn_angles
        from ..fitting.job import Job

        return Job(
            reading=tuple(self.reading.options().items()),
            turned=turn_angles(self.turned) if self.turned else (),
            aperture_deg=self.aperture_deg,
            anyway=self.anyway,
            kind=self.fitting.kind,
            models=expressions(self.fitting.models),
            options=self.fitting.options(),
            timing=self.output.timing,
        )

    def beyond(self, *, shown: bool):
        """What is asked beyond the ranking, as `face.beyond.Beyond`; `shown`: of one file, to people."""
        from ..face.beyond import Beyond

        return Beyond(
            scene=self.scene,  # type: ignore[arg-type]  # read by the option's callback
            explain=self.explain,
            next_=self.next_,
            baselines=self.baselines,
            basis_from=self.basis_from,
            shader=self.as_,
            numbers=shows_numbers(self.numbers, self.pictures.report is not None, not shown or self.output.json),
            asked_for_numbers=bool(self.numbers),
        )


def fit(request: FitRequest) -> None:
    """Fit the candidate models to DATA and rank them, best first."""
    context, words = request.context, request.data or []
    if not words and request.many.files_from is None:
        raise InputError("no DATA: wanted a file of measured data, several, a folder, or --files-from LIST")
    request.exporting.check(context)
    request.pictures.check(context)
    if request.pictures.plot is None:
        refuse(context, "x", because="without --plot nothing is drawn")
    if not request.baselines:
        refuse(context, "basis_from", because="it adds rows to --baselines")
    if request.output.json:
        refuse(context, "full", because="--json holds everything")
    if request.fitting.models:
        refuse(context, "explain", because="models that are named do not grow")
    if request.turned and (request.group or request.many.out or request.many.files_from):
        raise InputError("--turned joins scans of one sample; --group, --out and --files-from are for many surfaces")
    if request.group or (request.many.is_many(words) and not request.turned):
        raise Exit(fit_many(request, words))
    request.many.refuse_for_one(context)
    refuse(context, "products", because="they lie beside the answers of --out; of one file --plot and --report draw")
    fit_one(Path(words[0]), _named_for(words[0], request))


def _named_for(word: str, request: FitRequest) -> FitRequest:
    """The request with the surface's own name in the files that it names."""
    named = [request.pictures.plot, request.pictures.report, request.residuals, *(request.exporting.export or ())]
    if not any(is_pattern(each) for each in named if each):
        return request
    from ..batch.products import path_for
    from ..exporters import parse_spec

    pictures, exporting = request.pictures, request.exporting
    specs = [(target, path_for(path, word)) for target, path in map(parse_spec, exporting.export or ())]
    return replace(
        request,
        pictures=replace(pictures, plot=path_for(pictures.plot, word), report=path_for(pictures.report, word)),
        residuals=path_for(request.residuals, word),
        exporting=replace(exporting, export=[f"{target}:{path}" for target, path in specs]),
    )


def fit_many(request: FitRequest, words: list[str]) -> int:
    """Fits every file, or every group of every file; prints a row for each; the exit status."""
    from ..batch.products import EXPORT, PLOT, REPORT, RESIDUALS, listed, patterned
    from ..batch.work import FitWork
    from ..exporters import parse_spec
    from ._batch import Batch, answer_many, refuse_unseen, tasks_of, tasks_of_groups

    context, many, output = request.context, request.many, request.output
    refuse_unseen(context, many, output.json, *BEYOND)
    refuse(context, "full", because="a surface has one row; --json and --out hold everything")
    several = bool(request.group) or many.is_several(words)
    if not several:
        refuse(context, "jobs", because=ONE)
    if many.out is None:
        refuse(context, "products", because="they lie beside the answers of --out")
    products = listed(request.products) if request.products else []
    for kind, path in ((REPORT, request.pictures.report), (RESIDUALS, request.residuals)):
        products += [patterned(kind, path, several)] if path else []
    if request.pictures.plot:
        products.append(patterned(PLOT, request.pictures.plot, several, axis=request.x, theme=request.pictures.theme))
    for spec in request.exporting.export or ():
        target, path = parse_spec(spec)
        most = request.exporting.max_export_error
        products.append(patterned(EXPORT, path, several, target=target, most=most))
    work = FitWork(
        job=request.job(), beyond=request.beyond(shown=False), products=tuple(products), command=command_line()
    )
    labels = many.labels(context, words)
    tasks = tasks_of_groups(labels, request.group, work) if request.group else tasks_of(labels, work)
    what = "groups" if request.group else "files"
    batch = Batch(context=context, many=many, work=work, kind="fit", json=output.json, quiet=output.quiet, what=what)
    return answer_many(batch, tasks)


def fit_one(file: Path, request: FitRequest) -> None:
    """Fits one file and shows all that was asked about it."""
    from ..face.beyond import add_beyond
    from ..face.functions import answered
    from ..files import write_whole
    from ..fitting.job import case
    from ..report.documents.values import residuals
    from ..report.text.values import residuals_csv

    job, output, beyond = request.job(), request.output, request.beyond(shown=True)
    with working(f"reading {file.name}", output.quiet):
        found = case(request.data if request.turned else file, job)
    with progress(3 * len(found.candidates), output.quiet) as tell:
        answer = answered(found, job, tell)
    measurement, ranked, result = answer.measurement, answer.ranking, answer.document
    best = ranked.recommended.fit
    fitted = add_beyond(beyond, answer, file, job, found.kind, lambda steps: progress(steps, output.quiet))
    more = "".join(f"\n\n{text}" for text in beyond_texts(beyond, printable.document(result), output.quiet))
    if request.residuals:
        write_whole(request.residuals, residuals_csv(residuals(best, measurement)))
    show_ranking(request.pictures, result, ranked, measurement, file, request.x, output.quiet)
    failed = export_fitted(request.exporting, best.surface, measurement, file.stem, result, fitted, output.quiet)
    print_ranking(result, ranked, measurement, more, output, request.full)
    if failed:
        raise failed
    if answer.no_answer:
        raise NoAnswer(f"{file}: no trustworthy answer: {answer.no_answer}; --anyway answers all the same")


def beyond_texts(asked, document: dict, quiet: bool) -> Iterator[str]:
    """The blocks of a fit's document that are there because they were asked for, in words."""
    if asked.scene is not None:
        from ..report.text.pruned import text as pruned_text

        yield pruned_text(document["scene"], not quiet)
    if asked.explain:
        from ..report.text.grown import grown_text

        yield grown_text(document["grown"])
    if asked.next_:
        from ..report.text.ranking import next_text

        yield next_text(document["next"])
    if asked.baselines:
        from ..report.text.baselines import baselines_text

        yield baselines_text(document["baselines"])
    if asked.shader is not None:
        from ..report.text.as_shader import as_shader_text

        yield as_shader_text(document["as"])
    if "numbers" in document:
        from ..report.text.numbers import card_text

        yield card_text(document["numbers"])
