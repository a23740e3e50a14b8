"""`brdfguide collect DIR -o all.sqlite`: the answers of a folder as one table."""

from contextlib import ExitStack
from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Exit, Option

from ..errors import InputError
from ..records import dataclass
from ._many import from_missing
from ._options import JsonOption, QuietOption, output_file, print_json, remark, working

EXAMPLES = "Examples: brdfguide collect fits -o all.sqlite | brdfguide collect fits -o all.csv --fail-missing list.txt"
SUFFIXES = (".sqlite", ".db", ".csv", ".jsonl", ".parquet")


@dataclass(frozen=True, eq=False, kw_only=True)
class CollectRequest:
    """Everything that `collect` is asked."""

    context: Context
    folder: Annotated[Path, Argument(metavar="DIR", help="What `fit --out DIR` made.")]
    output: Annotated[
        Path,
        Option("--output", "-o", callback=output_file, help="A .sqlite, .csv, .jsonl or .parquet; brought up to date."),
    ]
    fail_missing: Annotated[
        str | None, Option("--fail-missing", help="Status 1 if a name in this list has no answer; they are named.")
    ] = None
    json: JsonOption = False
    quiet: QuietOption = False


def collect(request: CollectRequest) -> None:
    """Bring the answers of a folder into one table, by file: models, numbers, gloss, albedo, flags."""
    from ..batch import collected, flat_files
    from ..batch.store import known_store

    kind = request.output.suffix.lower()
    if kind not in SUFFIXES:
        raise InputError(f"-o {request.output}: wanted one of {', '.join(SUFFIXES)}")
    store = known_store(request.folder)
    base_path = request.output if kind in (".sqlite", ".db") else None
    with ExitStack() as stack:
        with working(f"collecting {request.folder}", request.quiet):
            base, count, new = stack.enter_context(collected.collected(store, base_path))
        if base_path is None:
            rows = collected.flat_rows(base)
            flat_files.check_replaced(rows, request.folder, request.output)
            flat_files.write_table(rows, collected.FLAT, request.output)
        files = base.execute("SELECT count(*) FROM name JOIN fit USING (key)").fetchone()[0]
        failed = base.execute("SELECT count(*) FROM failure").fetchone()[0]
        missing = [] if request.fail_missing is None else from_missing(request.fail_missing, base)
    result = {"answers": count, "new": new, "files": files, "failed": failed, "missing": missing}
    if request.json:
        print_json({"schema": "brdfguide/collect/1", "output": str(request.output), **result})
    remark(f"{files} files with {count} answers, {new} of them new, {failed} failures: {request.output}", request.quiet)
    for name in missing:
        remark(f"brdfguide: {name}: has no answer")
    if missing:
        raise Exit(1)
