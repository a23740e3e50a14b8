"""Many surfaces: a row each, in the order given, as each is answered."""

import json
import sys
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from typer import Context

from .. import printable
from ..errors import BrdfguideError, InputError
from ..records import dataclass
from ._many import Many
from ._options import progress, remark
from ._request import refuse
from ._streams import say, whisper

if TYPE_CHECKING:
    from ..batch.run import Engine, Task
    from ..batch.states import FileRow
    from ..batch.work import Work

STOPPED = 128  # statuses from here on are of signals


@dataclass(frozen=True, eq=False, kw_only=True)
class Batch:
    """Everything about a batch."""

    context: Context
    many: Many
    work: "Work"
    kind: str  # of the documents: fit, recommend, inspect
    json: bool
    quiet: bool
    what: str = "files"


@dataclass
class _Told:
    """What is said at the end, of all rows."""

    lines: list[tuple[str, ...]] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)
    statuses: set[int] = field(default_factory=set)
    rows: int = 0
    before: int = 0
    missing: int = 0
    answered: int = 0


def answer_many(batch: Batch, tasks: "list[Task | FileRow]") -> int:
    """Answers every task; prints a row for each; the exit status."""
    from ..batch.events import Events
    from ..batch.products import check_apart
    from ..batch.run import Again, run_tasks
    from ..batch.store import store_at
    from ..batch.workers import Limits

    many = batch.many
    many.check(batch.context, len(tasks))
    if many.events == "-" and batch.json:
        raise InputError("--events - and --json: one of them can have standard output")
    check_apart(batch.work.products, [each.label for each in tasks if hasattr(each, "label")])
    store = None if many.out is None else store_at(many.out)
    told_in = many.out / "events" if many.out is not None and many.scheduler and many.events else None
    tasks = [_kept_in(store, told_in, each) for each in tasks]
    limits = Limits(many.timeout, many.memory)
    where = None if many.events in (None, "-") else Path(str(many.events))
    told = _Told()
    with (
        closing(Events(where, sys.stdout if many.events == "-" else None, len(tasks))) as events,
        progress(len(tasks), batch.quiet, eta=True) as tell,
    ):

        def ended(row: "FileRow") -> None:
            events.ended(row)
            tell(row.file)

        engine = _engine(many, limits, tasks, events)
        rows = run_tasks(tasks, store, engine, Again(many.failed_again, limits), ended)
        with _lines_or_json(batch, many.events == "-", told) as show:
            for row in rows:
                _count(told, row)
                show(row)
    for sentence in told.errors:
        whisper(f"brdfguide: {sentence}")
    _summary(told, batch)
    status = max(told.statuses, default=0)
    return 0 if many.keep_going and told.answered and status < STOPPED else status


def _kept_in(store, told_in, task):
    from dataclasses import replace

    return replace(task, store=store, told=told_in) if store is not None and hasattr(task, "label") else task


def _engine(many: Many, limits, tasks, events) -> "Engine":
    """Who does the work."""
    from functools import partial

    def started(number: int, tries: int) -> None:
        task = tasks[number]
        events.started(getattr(task, "label", ""), tries)

    if many.scheduler:
        from ..batch.scheduler import by_scheduler

        return partial(by_scheduler, address=many.scheduler, of=len(tasks), tell=started)
    if (many.jobs > 1 and len(tasks) > 1) or many.timeout or many.memory:
        from ..batch.workers import done

        return partial(done, jobs=many.jobs, limits=limits, retries=many.retries, tell=started)
    from ..batch.run import in_this_process

    return partial(in_this_process, tell=started)


def _count(told: _Told, row: "FileRow") -> None:
    told.rows += 1
    told.before += row.from_before and row.brief is not None
    told.missing += row.status >= STOPPED or row.state == "not done"
    told.answered += row.brief is not None
    told.statuses.add(row.status)
    if row.error:
        told.errors.append(row.error)
    elif row.no_answer:
        told.errors.append(f"{row.file}: no trustworthy answer: {printable.line(row.no_answer)}")


@contextmanager
def _lines_or_json(batch: Batch, nothing: bool, told: _Told) -> Iterator[Any]:
    """A function that shows a row: at once in JSON, at the end in columns, since these are aligned."""
    if nothing:
        yield lambda row: None
    elif batch.json:
        yield _json_rows(batch)
        say("\n  ]\n}" if told.rows else "]\n}")
    else:
        blank = ("-",) * len(batch.work.header)
        yield lambda row: told.lines.append((row.file, *(row.brief or blank), row.state))
        from ..report.text.table import columns

        header = ("file", *batch.work.header, "status")
        lines = [tuple(map(printable.line, line)) for line in told.lines]
        say(columns(header, lines, right=tuple(place + 1 for place in batch.work.right)))


def _json_rows(batch: Batch):
    """The rows of one JSON object, each as it comes: no more than one document is held."""
    say(json.dumps({"schema": "brdfguide/batch/1"}, indent=2).removesuffix("\n}") + ',\n  "rows": [', end="")
    first = True

    def show(row: "FileRow") -> None:
        nonlocal first
        from ..report.documents.plain import plain

        text = json.dumps(plain(entry(row, batch.kind)), indent=2, allow_nan=False).replace("\n", "\n    ")
        say(("" if first else ",") + "\n    " + text, end="")
        first = False

    return show


def entry(row: "FileRow", kind: str) -> dict:
    """A row for programs."""
    return {
        "file": row.file,
        "status": row.status,
        "state": row.state,
        "error": row.error or None,
        "answered_before": row.from_before and row.brief is not None,
        "key": row.key or None,
        kind: _document(row),
    }


def _document(row: "FileRow") -> dict | None:
    """The answer, from where it is kept."""
    if row.place is None:
        return row.document
    from ..batch.run import with_name
    from ..batch.store import MOST_BYTES
    from ..opening import content

    return with_name(json.loads(content(row.place, MOST_BYTES, str(row.place))), row.file)


def _summary(told: _Told, batch: Batch) -> None:
    """How many were answered and where, and how to go on where it was stopped."""
    kept = f", answers in {batch.many.out}" if batch.many.out is not None else ""
    if told.missing:
        resume = "run the same command again and it goes on from there"
        resume = resume if kept else "with --out FOLDER answers are kept, and a second run goes on from there"
        remark(f"stopped: {told.rows - told.missing} of {told.rows} {batch.what} done{kept}; {resume}")
    elif kept or batch.many.shard:
        what = batch.what if told.rows != 1 else batch.what.removesuffix("s")
        remark(f"{told.rows} {what}, {told.before} answered before{kept}", batch.quiet)


def refuse_unseen(context: Context, many: Many, json_asked: bool, *names: str) -> None:
    """Raises InputError for options whose blocks neither a row nor a file would show."""
    if many.out is None and not json_asked:
        refuse(context, *names, because="a row has no place for it; --json or --out keeps the whole answer")


def tasks_of(labels: list[str], work: Any) -> list:
    """A Task for each file."""
    from ..batch.run import Task

    return [Task(label, Path(label), work) for label in labels]


def tasks_of_groups(labels: list[str], column: str, work: Any) -> list:
    """A Task for each value that a table's column has in a file; a row for a file that cannot be read."""
    from ..batch.run import Task
    from ..batch.states import BAD_INPUT, failed_row
    from ..batch.work import for_group
    from ..data import formats
    from ..opening import held

    about = {key: value for key, value in work.job.reading if key in ("columns", "select")}
    tasks: list = []
    for label in labels:
        try:
            source = held(Path(label))
            values = formats.groups(source, column, **about)
        except BrdfguideError as error:
            if len(labels) == 1:  # the only one: an option without effect, say
                raise
            tasks.append(failed_row(label, BAD_INPUT, str(error)))
            continue
        tasks += [Task(f"{label} [{column}={value}]", source, for_group(work, column, value)) for value in values]
    return tasks
