"""Whether files hold what an answer is named after: one may be written anew while it waits for its turn."""

import os
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from .. import opening

Stamp = tuple[tuple[int, ...] | None, ...]


def stamp_of(files: Iterable[Path | opening.Held]) -> Stamp:
    """What the system says of each file: it is another one where its bytes are, on one machine; None of one that is not
    there or whose bytes are held."""
    return tuple(_of(each) for each in files)


def _of(file: Path | opening.Held) -> tuple[int, ...] | None:
    if not isinstance(file, opening.Held):
        with suppress(OSError, ValueError):
            inside = sorted(file.rglob("*")) if opening.is_array_folder(file) else []
            found = [os.stat(each) for each in (file, *inside)]
            return tuple(n for one in found for n in (one.st_dev, one.st_ino, one.st_size, one.st_mtime_ns))
    return None
