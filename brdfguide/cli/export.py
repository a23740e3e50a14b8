"""`brdfguide export INPUT --to TARGET -o FILE`: a fitted or named surface as a file that a renderer loads."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Exit, Option

from ..errors import InputError
from ..records import dataclass
from ._many import Many
from ._options import ForceOption, JsonOption, QuietOption, command_line, output_file, print_json, remark
from ._request import refuse
from ._streams import say, write_out
from ._surface import MaxErrorOption, surfaces_of

EXAMPLES = (
    "Examples: brdfguide export fit.json --to mitsuba -o paint.xml --max-export-error 0.1 | brdfguide export "
    "porcelain --to rgl -o porcelain.bsdf"
)

OF_A_FILE = ("words", "output", "model", "channel", "data", "name", "max_export_error", "force")


@dataclass(frozen=True, eq=False, kw_only=True)
class ExportRequest:
    """Everything that `export` is asked."""

    context: Context
    words: Annotated[
        list[str] | None,
        Argument(
            metavar="[INPUT] [NAME=VALUE]...",
            help="A fit's JSON, a material, or parameters for --model; R,G,B after = for colours.",
        ),
    ] = None
    to: Annotated[str | None, Option("--to", help="Target; without one: the list of targets.")] = None
    output: Annotated[
        Path | None, Option("--output", "-o", callback=output_file, help="File to write; - is standard output.")
    ] = None
    model: Annotated[str | None, Option("--model", help="A model by name; with an input: which of its candidates.")] = (
        None
    )
    channel: Annotated[str | None, Option("--channel", help="One channel alone, as grey.")] = None
    data: Annotated[Path | None, Option("--data", help="Judge and refit over this file's directions.")] = None
    name: Annotated[str | None, Option("--name", help="Name inside the file; left out: the file's.")] = None
    max_export_error: MaxErrorOption = None
    force: ForceOption = False
    many: Many
    json: JsonOption = False
    quiet: QuietOption = False


def export(request: ExportRequest) -> None:
    """Write a model for a renderer, and say what that costs: exact, refit or lossy, with its rms ln error."""
    from .. import exporters

    if request.to is None:
        refuse(request.context, *OF_A_FILE, because="which --to? without one the targets are listed")
        list_targets(request.json)
        return
    target, output = exporters.get(request.to), request.output
    inputs = [word for word in request.words or () if "=" not in word]
    if request.many.files_from or (inputs and request.many.is_many(inputs)):
        raise Exit(_export_many(request, inputs))
    request.many.refuse_for_one(request.context)
    if output is None:
        raise InputError(f"-o FILE is missing, such as -o {request.name or 'surface'}{target.suffix}")
    if not target.named:
        refuse(request.context, "name", because=f"a file for {target.name} holds no name")
    stem = "surface" if str(output) == "-" else output.stem
    words = request.words or []
    surfaces = surfaces_of(words, request.model, request.channel, request.name or stem, command_line())
    geom = None
    if request.data is not None:
        from ..data import formats

        geom = formats.read(request.data).geom
    surface, made = exporters.held_best(request.to, surfaces, geom, most=request.max_export_error, stem=stem)
    files = put(made, output, request)
    if request.json:
        print_json(exporters.statement_document(made.statement, surface, [str(path) for path in files]))
    # which tables made the colour, and the doubt where there are none
    colour = () if surface.colour.named else (f"colour: {made.statement.colour}",)
    for line in (made.statement.sentence(), *made.statement.notes, *colour):
        remark(line, request.quiet)


def _export_many(request: ExportRequest, inputs: list[str]) -> int:
    """A file for each surface, and a row; the exit status."""
    from ..batch.other_work import ExportWork
    from ..batch.products import EXPORT, patterned
    from ._batch import Batch, answer_many

    context, many = request.context, request.many
    if named := [word for word in request.words or () if "=" in word]:
        raise InputError(
            f"{named[0]}: parameters are of --model alone; {inputs[0] if inputs else 'a list'} has its own"
        )
    refuse(context, "channel", "data", "name", because="of one surface at a time")
    refuse(context, "out", "failed_again", because="the files themselves are the answers; -o names them")
    if request.output is None:
        raise InputError("-o FILE is missing: a pattern such as -o scene/{stem}.xml")
    target = str(request.to)
    work = ExportWork(
        target=target,
        products=(patterned(EXPORT, request.output, True, "-o", target=target),),
        model=request.model,
        most=request.max_export_error,
        force=request.force,
        command=command_line(),
    )
    tasks = _tasks(request, inputs, work)
    batch = Batch(
        context=context, many=many, work=work, kind="export", json=request.json, quiet=request.quiet, what="surfaces"
    )
    return answer_many(batch, tasks)


def _tasks(request: ExportRequest, inputs: list[str], work) -> list:
    """A task for each surface; of a folder of answers one for each file that was answered, by its name."""
    import os

    from ..batch.run import Task
    from ..batch.store import SIGN, known_store
    from ._batch import tasks_of

    tasks, others = [], []
    for word in inputs:
        if os.path.isfile(os.path.join(word, SIGN)):
            store = known_store(Path(word))
            tasks += [Task(name, store.place(key), work) for name, key in store.names() if store.place(key).exists()]
        else:
            others.append(word)
    if others or request.many.files_from:
        return tasks + tasks_of(request.many.labels(request.context, others), work)
    return request.many.of_shard(tasks)


def list_targets(json: bool) -> None:
    """Prints every target with what it is."""
    from .. import exporters
    from ..report.text import table

    header = ("target", "suffix", "what")
    rows = [(each.name, each.suffix, each.what) for each in map(exporters.get, exporters.names())]
    if json:
        print_json({"schema": "brdfguide/targets/1", "targets": [dict(zip(header, row, strict=True)) for row in rows]})
    else:
        say(table.columns(header, rows))


def put(made, output: Path, request: ExportRequest) -> list[Path]:
    """Writes an Export to its file and those beside it, or to standard output; the files written."""
    from .. import exporters
    from ..files import taken, write_whole

    if str(output) == "-":
        refuse(request.context, "force", because="standard output holds no file to replace")
        why = "--json is printed there" if request.json else "it is not one text"
        if made.beside or isinstance(made.content, bytes) or request.json:
            raise InputError(f"{request.to} cannot go to standard output: {why}; name a file with -o")
        write_out(made.content)
        return []
    files = exporters.files_of(made, output)
    for path in files:
        if taken(path) and not request.force:
            raise InputError(f"{path} exists; --force replaces it")
    for path, content in files.items():
        write_whole(path, content)
    return list(reversed(files))
