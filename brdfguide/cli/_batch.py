"""`brdfguide fit` with several files: one row each."""

import sys
from pathlib import Path

from ..errors import InputError
from ._options import note, print_json, progress


def fit_many(files: list[Path], job, folder: Path | None, jobs: int, json: bool, quiet: bool) -> None:
    """Fits every file, prints a row for each, and exits with the worst status among them."""
    from .. import batch
    from ..report.table import columns

    if jobs < 1:
        raise InputError(f"--jobs {jobs}: wanted at least 1")
    if folder is not None:
        folder.mkdir(parents=True, exist_ok=True)
    with progress(len(files), quiet) as tell:
        rows = batch.run(files, job, folder, jobs, tell)
    if json:
        print_json({"schema": "brdfguide/batch/1", "rows": [entry(row) for row in rows]})
    else:
        print(columns(("file", "recommended", "rms ln", "held-out", "status"), [line(row) for row in rows], right=(2, 3)))
    for row in rows:
        if row.error:
            note(f"brdfguide: {row.error}")
    if folder is not None:
        done = sum(row.from_before for row in rows)
        note(f"{len(rows)} files, {done} answered before, answers in {folder}", quiet)
    sys.exit(max(row.status for row in rows))


def entry(row) -> dict:
    return {"file": row.file, "status": row.status, "error": row.error or None, "fit": row.document}


def line(row) -> tuple:
    if row.document is None:
        return row.file, "-", "-", "-", "no trustworthy answer" if row.status == 1 else "bad input"
    best = next(each for each in row.document["ranking"] if each["candidate"] == row.document["recommended"])
    held = best["held_out_rms_ln"]
    return row.file, best["candidate"], f"{best['rms_ln']:.4f}", "-" if held is None else f"{held:.4f}", "answered before" if row.from_before else "answered"
