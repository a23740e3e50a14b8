"""Many files, one row each: every file fitted by itself, in several processes, resumable, none stopping the rest.

An answer is one JSON named after the hash of the data and the settings, written whole or not at all, so that a
second run does only what is missing and several runs may share a folder.
"""

import hashlib
import json
from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import asdict, dataclass
from multiprocessing import get_context
from pathlib import Path

from . import __version__, candidates, examine, formats, verdict
from .compare import compare
from .errors import BrdfguideError
from .fitting import Options
from .outputs import write_whole
from .report import document


@dataclass(frozen=True)
class Job:
    """What is done to each file."""

    options: Options
    kind: str | None = None
    models: tuple[str, ...] | None = None
    reading: tuple[tuple[str, object], ...] = ()  # keyword arguments of formats.read
    anyway: bool = False


@dataclass(frozen=True)
class Row:
    """What became of one file."""

    file: str
    status: int  # the exit status that it would have had by itself
    document: dict | None
    error: str = ""
    from_before: bool = False


def run(files: Iterable[Path], job: Job, folder: Path, jobs: int, progress: Callable[[str], None] = lambda file: None) -> list[Row]:
    """One row for each file, in the order given. Answers already in `folder` are taken from there."""
    files = list(files)
    rows: dict[Path, Row] = {}
    todo = {}
    for file in files:
        place = answer_file(file, job, folder)
        found = _before(place)
        if found is not None:
            rows[file] = Row(str(file), 0, found, from_before=True)
        else:
            todo[file] = place
    if jobs > 1 and len(todo) > 1:
        with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
            waiting = {pool.submit(one, file, job, place): file for file, place in todo.items()}
            for done in as_completed(waiting):
                rows[waiting[done]] = done.result()
                progress(str(waiting[done]))
    else:
        for file, place in todo.items():
            rows[file] = one(file, job, place)
            progress(str(file))
    return [rows[file] for file in files]


def one(file: Path, job: Job, place: Path | None) -> Row:
    """Fits one file and writes its answer; an error of the user's becomes a row."""
    try:
        measurement = examine.prepared(formats.read(file, **dict(job.reading)), anyway=job.anyway)
        judged = verdict.verdict(measurement)
        ranked = compare(measurement, candidates.of_kind(job.kind or judged.known, job.models), job.options)
    except BrdfguideError as error:
        return Row(str(file), error.exit_status, None, str(error))
    result = document.fit_document(ranked, measurement, judged)
    if place is not None:
        write_whole(place, json.dumps(result, allow_nan=False))
    return Row(str(file), 0, result)


def answer_file(file: Path, job: Job, folder: Path | None) -> Path | None:
    """Where the answer to this file under these settings belongs."""
    if folder is None:
        return None
    digest = hashlib.sha256(json.dumps([__version__, asdict(job)], sort_keys=True, default=str).encode())
    if Path(file).is_file():
        digest.update(Path(file).read_bytes())
    return folder / f"{Path(file).name}.{digest.hexdigest()[:16]}.json"


def _before(place: Path | None) -> dict | None:
    """An answer from an earlier run; None where there is none or it is damaged."""
    try:
        return json.loads(place.read_text()) if place is not None and place.is_file() else None
    except ValueError:
        return None
