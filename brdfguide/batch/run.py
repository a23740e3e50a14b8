"""Many surfaces, one row each: every one answered by itself, in several processes or on a farm, none stopping the rest.

An answer is kept under the name of all that it follows from, written whole or not at all, so that a second run does
only what is missing, and several runs may share a folder.
"""

import re
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from .. import __version__, opening, stopping
from ..errors import BrdfguideError, InputError, Stopped, mistake
from ..records import dataclass
from ..report.documents.digest import with_digest
from .events import note_begun
from .keys import DataBytes, beside, bytes_of, engine, key_of
from .process import peak_mb
from .states import (
    ANSWERED,
    BAD_INPUT,
    BEFORE,
    KILLED,
    NO_ANSWER,
    NOT_DONE,
    NOT_KEPT,
    NOT_MADE,
    OUT_OF_MEMORY,
    STATUS,
    TIMED_OUT,
    FileRow,
    failed_row,
)
from .store import STALE_S, Store
from .unchanged import Stamp, stamp_of
from .work import MadeAnswer, Work
from .workers import UNLIMITED, Done, Ended, Limits, OverMemory, OverTime

MISSING_FILE = "sha256:"  # in place of a name, in an answer that belongs to all files of this content


@dataclass(frozen=True, eq=False)
class Task:
    """One surface: a file, or a part of one, and what is done to it."""

    label: str
    file: Path | opening.Held
    work: Work
    store: Store | None = None
    key: str = ""
    data: DataBytes = DataBytes("", 0)
    stamp: Stamp = ()  # of all that was read for the key
    limits: Limits = UNLIMITED
    told: Path | None = None  # a folder, where each process notes in a file what it begins


class Again(NamedTuple):
    """Which failures of an earlier run are tried again: all, or those that now have more time or memory."""

    all: bool = False
    limits: Limits = UNLIMITED


NOT_AGAIN = Again()


Numbered = tuple[int, Any]
Engine = Callable[[Callable[[Any], Any], Iterator[Numbered]], Generator[Numbered]]


def in_this_process(
    do: Callable[[Any], Any],
    tasks: Iterator[Numbered],
    tell: Callable[[int, int], None] = lambda number, tries: None,
) -> Generator[Numbered]:
    """(number, do(task)) of each task, one after the other; `tell` hears of each that is begun, and that it is the
    first try."""
    for number, task in tasks:
        if isinstance(task, Done):
            yield number, task.result
        else:
            tell(number, 1)
            yield number, do(task)


def run_tasks(
    tasks: Sequence[Task | FileRow],
    store: Store | None,
    engine_of: Engine = in_this_process,
    again: Again = NOT_AGAIN,
    tell: Callable[[FileRow], None] = lambda row: None,
) -> Generator[FileRow]:
    """One row for each task, in the order given, whatever happens; a row among them is one already.

    Answers already in `store` are taken from there; `tell` hears of each row as soon as it is one. A signal ends the
    work, and so does an answer that cannot be kept: what was not done says so.
    """
    rows: dict[int, FileRow] = {}
    shown = 0
    status = 0
    try:
        with closing(_results(tasks, store, engine_of, again)) as results:
            for number, row in results:
                tell(row)
                rows[number] = row
                while shown in rows:
                    yield rows.pop(shown)
                    shown += 1
                if row.state == NOT_KEPT:
                    status = row.status
                    break
    except Stopped as end:
        stopping.heard()
        status = int(end.code or 0)
    for number in range(shown, len(tasks)):
        missing = FileRow(file=_label(tasks[number]), state=NOT_DONE, status=status)
        yield rows.pop(number, missing)


def _label(task: Task | FileRow) -> str:
    return task.file if isinstance(task, FileRow) else task.label


def _results(tasks, store: Store | None, engine_of: Engine, again: Again) -> Generator[tuple[int, FileRow]]:
    """Rows as they come."""
    claimed: dict[int, str] = {}
    handed: dict[int, Task] = {}

    def todo() -> Iterator[Numbered]:
        others: list[int] = []
        for number, task in enumerate(tasks):
            placed = task if isinstance(task, FileRow) else _placed(task, store, again)
            if isinstance(placed, FileRow):
                yield number, Done(placed)
            elif store and not store.claim(placed.key, again.limits.seconds or STALE_S):
                others.append(number)  # another run is at it: perhaps it is done when we have done the rest
            else:
                yield _handed(number, placed)
        for number in others:
            placed = _placed(tasks[number], store, again)
            if isinstance(placed, FileRow):
                yield number, Done(placed)
            else:
                yield _handed(number, placed)

    def _handed(number: int, task: Task) -> Numbered:
        handed[number] = task
        if store:
            claimed[number] = task.key
        return number, task

    try:
        for number, result in engine_of(one, todo()):
            done = handed.pop(number, None)
            row = _ended_row(done, result) if done is not None and isinstance(result, Ended) else result
            if store is not None and number in claimed:
                store.release(claimed.pop(number))
            yield number, row
    finally:
        if store is not None:
            for key in claimed.values():
                store.release(key)


def _ended_row(task: Task, ended: Ended) -> FileRow:
    """The row of a task whose process was ended, and the note for the next run."""
    state = {OverTime: TIMED_OUT, OverMemory: OUT_OF_MEMORY}.get(type(ended), KILLED)
    row = failed_row(task.label, state, f"{task.label}: {ended.words}", key=task.key, tries=ended.tries)
    return _noted(task, row)


def one(task: Task) -> FileRow:
    """Answers one task and keeps its answer; whatever goes wrong becomes a row.

    One that is handed out again, since the process that had it was ended, may have its answer already.
    """
    begun = time.monotonic()
    row = _just_answered(task)
    if row is None:
        if task.told is not None:
            note_begun(task.told, task.label)
        row = _answered(task)
    return replace(row, seconds=round(time.monotonic() - begun, 4), peak_mb=peak_mb())


def _just_answered(task: Task) -> FileRow | None:
    """The row of an answer that was not there when the task was handed out."""
    row = None if task.store is None else _before(task, Again(True, task.limits))
    return row and replace(row, state=ANSWERED if row.state == BEFORE else row.state, from_before=False)


def _answered(task: Task) -> FileRow:
    try:
        made = task.work.of(task.file)
    except BrdfguideError as error:
        state = BAD_INPUT if error.exit_status == InputError.exit_status else NO_ANSWER
        return _noted(task, failed_row(task.label, state, str(error), key=task.key))
    except MemoryError:
        words = f"{task.label}: there is not enough memory for it"
        return _noted(task, failed_row(task.label, OUT_OF_MEMORY, words, key=task.key))
    except Exception as error:
        row = failed_row(task.label, BAD_INPUT, f"{task.label}: {mistake(error)}", key=task.key)
        return row if isinstance(error, OSError) else _noted(task, row)  # too many open files, say, pass
    row = _row(task, made.document, ANSWERED, None)
    if task.store is not None:
        if not _is_unchanged(task):
            return failed_row(task.label, BAD_INPUT, f"{task.label}: it was written anew meanwhile; run it again")
        try:
            task.store.keep(task.key, _named_by_content(made.document, task))
        except InputError as error:
            return replace(row, state=NOT_KEPT, status=STATUS[NOT_KEPT], error=str(error))
        row = replace(row, document=None, place=task.store.place(task.key))
    return _with_products(task, made, row)


def _named_by_content(document: dict, task: Task) -> dict:
    """The document as it is kept: the same for every name that this content has, with what it follows from."""
    asked = task.work.asked()
    stored = {
        "key": task.key,
        "version": __version__,
        "fingerprint": engine(),
        "asked": asked,
        "data": task.data._asdict(),
    }
    data = document.get("data")
    named = {"data": {**data, "file": MISSING_FILE + task.data.sha256}} if isinstance(data, dict) else {}
    return with_digest({**document, **named, "stored": stored})


def with_name(document: dict, label: str) -> dict:
    """A document that is kept, as if the file of this label alone had been answered."""
    data = document.get("data")
    named = {"data": {**data, "file": label}} if isinstance(data, dict) else {}
    return with_digest({key: item for key, item in {**document, **named}.items() if key != "stored"})


def _with_products(task: Task, made: MadeAnswer, row: FileRow) -> FileRow:
    """Makes what is drawn and written of the answer, and notes whose it is."""
    known: dict[str, Any] = {}
    for product in task.work.products:
        path = product.place(task.label, row.place)
        try:
            made.write(product, path)
            known[str(path)] = [product.said, None]
        except BrdfguideError as error:
            known[str(path)] = [product.said, [str(error), error.exit_status]]
    row = _with_refusals(row, known)
    return _named(task, row, known)


def _with_refusals(row: FileRow, products: dict) -> FileRow:
    """The row with what could not be made, if anything."""
    refused = [each for _, each in products.values() if each]
    if not refused:
        return row
    words = "\n".join(sentence for sentence, _ in refused)
    return replace(row, state=NOT_MADE, status=max(row.status, *(status for _, status in refused)), error=words)


def _named(task: Task, row: FileRow, products: dict) -> FileRow:
    try:
        if task.store is not None:
            task.store.name(task.label, task.key, products)
    except InputError as error:
        return replace(row, state=NOT_KEPT, status=STATUS[NOT_KEPT], error=str(error))
    return row


def _noted(task: Task, row: FileRow) -> FileRow:
    """The row of a failure, kept beside the answers; not where it may be of other data."""
    if task.store is None or not _is_unchanged(task):
        return row
    limits = list(task.limits)
    record = {"state": row.state, "error": row.error, "file": task.label, "tries": row.tries, "limits": limits}
    try:
        task.store.fail(task.key, record)
    except InputError as error:
        return replace(row, state=NOT_KEPT, status=STATUS[NOT_KEPT], error=f"{row.error}\n{error}")
    return _named(task, row, {})


def _placed(task: Task, store: Store | None, again: Again) -> Task | FileRow:
    """The task with its input and the place of its answer; its row where it is answered already, or cannot be read."""
    try:
        file = _held(task.file, again.limits.seconds)  # no other process has our standard input
        if store is None:
            return replace(task, file=file)
        placed = _named_by_data(replace(task, file=file))
    except TimeoutError:
        return failed_row(task.label, TIMED_OUT, f"{task.label}: not read within {again.limits.seconds:g} seconds")
    except BrdfguideError as error:
        return failed_row(task.label, BAD_INPUT, str(error))
    placed = replace(placed, store=store, limits=again.limits)
    return _before(placed, again) or placed


def _named_by_data(task: Task) -> Task:
    """The task with its answer's name, as the data are now. Raises InputError where they cannot be read."""
    reads = task.work.reads(task.file)
    stamp = stamp_of([task.file, *reads])  # before they are read, so that a change meanwhile is seen
    there = isinstance(task.file, opening.Held) or opening.exists(task.file)
    data = bytes_of(task.file) if there else DataBytes("", 0)
    return replace(task, key=key_of(task.work.asked(), data, beside(reads)), data=data, stamp=stamp)


def _is_unchanged(task: Task) -> bool:
    """Whether the data are still those that the answer is named after; read again only where they may be others."""
    try:
        same = stamp_of([task.file, *task.work.reads(task.file)]) == task.stamp
        return same or _named_by_data(task).key == task.key
    except BrdfguideError:
        return False


def _held(file: Path | opening.Held, seconds: float | None) -> Path | opening.Held:
    """What can be read only once, with what was read. Raises TimeoutError where it does not come to an end in time."""
    if seconds is None or isinstance(file, opening.Held) or opening.is_plain(file):
        return opening.held(file)
    found: list = []

    def read() -> None:
        try:
            found.append(opening.held(file))
        except BrdfguideError as error:
            found.append(error)

    reader = threading.Thread(target=read, daemon=True)
    reader.start()
    reader.join(seconds)
    if not found:
        raise TimeoutError
    if isinstance(found[0], BrdfguideError):
        raise found[0]
    return found[0]


def _before(task: Task, again: Again) -> FileRow | None:
    """The row of an earlier run; None where there is none, it is damaged, or it is worth another try."""
    assert task.store is not None
    document = task.store.read(task.key, task.work.schema)
    if document is None:
        return _failed_before(task, again)
    try:
        row = replace(_row(task, document, BEFORE, task.store.place(task.key)), document=None, from_before=True)
    except (InputError, KeyError, TypeError, ValueError, AttributeError, IndexError):
        return None
    made = task.store.named(task.label)
    known = made.get("products", {}) if made.get("key") == task.key else {}
    for product in task.work.products:
        path = str(product.place(task.label, row.place))
        said, refused = known.get(path) or (None, None)
        if said != product.said or not (refused or opening.exists(path)):
            return None
    wanted = {str(product.place(task.label, row.place)) for product in task.work.products}
    row = _with_refusals(row, {path: each for path, each in known.items() if path in wanted})
    return _named(task, row, known)


def _failed_before(task: Task, again: Again) -> FileRow | None:
    """Of a failure that would come again."""
    assert task.store is not None
    found = task.store.failure(task.key)
    if found is None or again.all or found["state"] not in STATUS or found["state"] == KILLED:
        return None
    if found["state"] in (TIMED_OUT, OUT_OF_MEMORY) and list(again.limits) != found.get("limits"):
        return None
    if found["state"] == OUT_OF_MEMORY and again.limits.memory_mb is None:
        return None  # of that machine, at that moment
    name = re.escape(str(found.get("file")))
    named = re.compile(rf"^{name}(?=\W)", re.MULTILINE)
    error = named.sub(lambda _: task.label, found["error"])
    return _named(task, failed_row(task.label, found["state"], error, key=task.key, from_before=True), {})


def _row(task: Task, document: dict, state: str, place: Path | None) -> FileRow:
    """The row of an answer; where no model should be trusted it says so."""
    why = document.get("no_answer") or ""
    return FileRow(
        file=task.label,
        state=NO_ANSWER if why else state,
        status=STATUS[NO_ANSWER] if why else 0,
        brief=task.work.brief(document),
        no_answer=why,
        document=document if place is None else None,
        place=place,
        key=task.key,
    )
