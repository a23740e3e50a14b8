"""What happens, as it happens, for programs: a line of JSON each."""

import json
import os
import socket
import time
from contextlib import suppress
from pathlib import Path
from typing import IO

from ..errors import InputError
from .states import ANSWERED, EVENTS, FileRow


class Events:
    """Lines at the end of a file, which no other process writes, or on a stream."""

    def __init__(self, where: Path | None, stream: IO[str] | None, of: int):
        """Raises InputError where the file cannot be written."""
        self.where, self.of, self.begun = where, of, time.monotonic()
        self.stream = stream if where is None else _appending(where)
        self.done = self.fresh = 0

    def started(self, file: str, tries: int) -> None:
        """A file is begun, for the first time or again."""
        self._line({"file": file, "state": "started", "try": tries})

    def ended(self, row: FileRow) -> None:
        """What became of it."""
        self.done += 1
        self.fresh += not row.from_before
        state = "answered" if row.state == ANSWERED else EVENTS.get(row.state, row.state)
        line = {"file": row.file, "key": row.key or None, "state": state, "s": row.seconds, "mb": row.peak_mb}
        self._line({**line, "try": row.tries, "done": self.done, "of": self.of, "eta_s": self.eta_s})

    @property
    def eta_s(self) -> float | None:
        """How long the rest takes, if none of it was answered before; None before the first is done."""
        spent = time.monotonic() - self.begun
        return round((self.of - self.done) * spent / self.fresh, 1) if self.fresh else None

    def _line(self, entry: dict) -> None:
        if self.stream is None:
            return
        try:
            self.stream.write(json.dumps({"t": round(time.time(), 3), **entry}) + "\n")
            self.stream.flush()
        except OSError as error:
            stream, self.stream = self.stream, None
            stream.close()
            raise InputError(f"cannot write {self.where or 'standard output'}: {error.strerror}") from None

    def close(self) -> None:
        if self.where is not None and self.stream is not None:
            self.stream.close()


def _appending(where: Path) -> IO[str]:
    try:
        return where.open("a", encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot write {where}: {error.strerror or error}") from None


def note_begun(folder: Path, label: str) -> None:
    """That this process begins with a file, in a file of its own in that folder; it is no matter where it cannot be."""
    line = {"t": round(time.time(), 3), "file": label, "state": "started"}
    with suppress(OSError):
        folder.mkdir(exist_ok=True)
        with (folder / f"{socket.gethostname()}-{os.getpid()}.jsonl").open("a", encoding="utf-8") as stream:
            stream.write(json.dumps(line) + "\n")
