"""`brdfguide recommend INPUT...`: a model with parameters for a described surface, a measured one, or both."""

from typing import Annotated

from typer import Argument, Context, Exit, Option

from .. import printable
from ..errors import BrdfguideError, InputError
from ..records import dataclass
from ._described import sort_inputs, status_of_descriptions
from ._fitting import ModelsOption, expressions
from ._inputs import with_measurements
from ._many import Many
from ._numbers import NumbersOption, numbers_of
from ._options import FullOption, Output, print_json, tell
from ._report import Pictures, show_answer
from ._request import refuse
from ._scene import SceneOption, of_answer
from ._surface import AsOption, Exporting, export_all

EXAMPLES = "Examples: brdfguide recommend porcelain | brdfguide recommend my_surface.yaml scan.csv --explain"


@dataclass(frozen=True, eq=False, kw_only=True)
class RecommendRequest:
    """Everything that `recommend` is asked, of descriptions and of measurements."""

    context: Context
    inputs: Annotated[
        list[str] | None,
        Argument(
            metavar="[INPUT]...",
            help=(
                "A description (YAML, - for standard input, or a name of `brdfguide materials`), a measurement, or "
                "both."
            ),
        ),
    ] = None
    models: ModelsOption = None
    scene: SceneOption = None
    pictures: Pictures
    explain: Annotated[bool, Option("--explain", help="Every rule, also those that were silent.")] = False
    anyway: Annotated[bool, Option("--anyway", help="Answer also outside the guide's domain.")] = False
    as_: AsOption = None
    numbers: NumbersOption = None
    exporting: Exporting
    many: Many
    output: Output
    full: FullOption = False


def recommend(request: RecommendRequest) -> None:
    """Recommend reflectance models with start values, and say why, how surely and what they cannot do."""
    from ..advice import recommend as advisor
    from ..opening import is_folder

    context, typed = request.context, request.inputs or []
    if not typed and request.many.files_from is None:
        raise InputError("no INPUT: wanted a description, a measurement, a folder, or --files-from LIST")
    folders = any(map(is_folder, typed))
    if request.many.is_typed(context) or folders or (len(typed) == 1 and request.many.is_many(typed)):
        raise Exit(_recommend_many(request, typed))
    request.exporting.check(context)
    request.pictures.check(request.context)
    described, measured = sort_inputs(typed)
    if request.output.json:
        refuse(request.context, "full", because="--json holds everything")
    if not described:
        refuse(request.context, "explain", because="the rules speak about a description, and there is none")
    for words, wanted in (
        ("--plot and --report show", request.pictures.wanted),
        ("--export writes", request.exporting.export),
    ):
        if wanted and max(len(described), len(measured)) > 1:
            raise InputError(f"{words} one answer; give one description, one measurement or one of each")
    answers = [advisor.recommend(each, request.anyway, expressions(request.models)) for each in described]
    if measured:
        with_measurements(answers, measured, request)
    else:
        of_descriptions(answers, request)


def _recommend_many(request: RecommendRequest, words: list[str]) -> int:
    """A row for each description; the exit status."""
    from ..batch.other_work import AdviceWork
    from ._batch import Batch, answer_many, refuse_unseen, tasks_of

    context, many, output = request.context, request.many, request.output
    because = "of one description at a time; several with an option about many are a row each"
    refuse(context, "scene", "plot", "report", "theme", "as_", "numbers", "full", because=because)
    refuse(context, "export", "max_export_error", because="`export` with many descriptions writes a file for each")
    refuse_unseen(context, many, output.json, "explain")
    models = expressions(request.models)
    work = AdviceWork(models=models, anyway=request.anyway, explain=request.explain, timing=output.timing)
    tasks = tasks_of(many.labels(context, words, lambda path: path.suffix in (".yaml", ".yml")), work)
    batch = Batch(
        context=context, many=many, work=work, kind="recommend", json=output.json, quiet=output.quiet, what="surfaces"
    )
    return answer_many(batch, tasks)


def of_descriptions(answers, request: RecommendRequest) -> None:
    """Shows what the guidelines say of each description; ends with status 1 where one lies outside their domain."""
    from ..report.documents import recommendation
    from ..report.text.as_shader import described_as_text
    from ..report.text.recommendation import text

    output = request.output
    held: list[dict] = []
    if request.as_:
        answers, held = _for_target(answers, request.as_)
    documents = [recommendation.document(each, output.timing, request.explain) for each in answers]
    texts = [text(printable.document(each), request.explain, request.full) for each in documents]
    if request.scene:
        for place, (answer, document) in enumerate(zip(answers, documents, strict=True)):
            texts[place] += of_answer(request.scene, answer, document, output)
    if request.as_:
        for place, block in enumerate(held):
            if block:
                documents[place]["as"] = block
                texts[place] += "\n\n" + described_as_text(printable.document(block))
    for place, answer in enumerate(answers):
        surfaces = [each.surface for each in answer.candidates]
        texts[place] += numbers_of(surfaces, request, documents[place])
    show_answer(request.pictures, documents[0], answers[0], request.inputs or [], output.quiet)
    written, failed = _exported(answers[0], request)
    documents[0] |= {"exports": written} if request.exporting.export else {}
    if output.json:
        print_json(
            documents[0] if len(documents) == 1 else {"schema": "brdfguide/recommend/1", "recommendations": documents}
        )
    else:
        tell("\n\n".join(texts))
    if failed:
        raise failed
    if status_of_descriptions(answers):
        raise Exit(1)


def _for_target(answers, name: str) -> tuple[list, list[dict]]:
    """The answers, each headed by the candidate that the shader holds, and the shader's numbers with their error."""
    from ..exporters import coloured, held_best, statement_document
    from ..face.surfaces import every_candidate
    from ..printable import off_words_of
    from ..report.documents.plain import plain

    headed: list = []
    blocks: list[dict] = []
    for answer in answers:
        if not answer.candidates:
            headed.append(answer)
            blocks.append({})
            continue
        shown = [coloured(each, answer.material.name or "surface") for each in every_candidate(answer)]
        taken, made = held_best(name, shown)
        first, off = answer.candidates[0].model.name, off_words_of(made.statement.rms_ln)
        if taken.model.name != first:
            why = f"{name} holds it, {off} off; without --as {first} comes first"
            answer = answer.headed_by(taken.model.name, why)
        headed.append(answer)
        blocks.append(plain(statement_document(made.statement, taken, [])))
    return headed, blocks


def _exported(answer, request: RecommendRequest) -> tuple[list[dict], BrdfguideError | None]:
    """What `--export` asks for, of the one description; the error that stopped it, if any."""
    if not request.exporting.export or not answer.candidates:
        return [], None
    from ..face.surfaces import every_candidate

    surface, name = every_candidate(answer), answer.material.name or "surface"
    return export_all(request.exporting, surface, None, name, request.output.quiet)
