"""A text table that is read block by block: its head with some of its rows is a table like any other."""

from collections.abc import Callable, Iterator

import numpy as np

from ...errors import InputError, NothingLeft
from ..blocks import STREAM, Blocks
from ..measurement import Measurement
from . import _open
from ._parts import check_alike, decisions
from ._sections import statements
from ._sheet import COMMENTS
from .format import Source, holds_number

PIECE = 2**22  # bytes of rows that are one block
MOST_OF_A_HEAD = 2**16  # bytes: comments and names
NO_ROW = frozenset(bytes([each]) for each in b"#%!/;" + bytes(range(65, 91)) + bytes(range(97, 123)))
Read = Callable[[Source], Measurement]


def blocks(path, read: Read) -> Blocks:
    """The table's rows in blocks of some 4 MB, each read as a table with the same head, and as a sample of all is.

    Raises InputError where no line begins with a number; while it is read also where a block would be read otherwise
    than the rest, since its values alone do not say what they mean.
    """
    name = str(path)
    settled: list[frozenset[str]] = []

    def draw(count: int, seed: int) -> tuple[Measurement, int]:
        head, lines, size = _drawn_lines(path, name, count, seed)
        found = read(Source(name, head + b"".join(lines)))
        settled[:] = [decisions(found)]
        return found, size

    def every() -> Iterator[Measurement]:
        for head, rows, line in _pieces(path, name):
            try:
                found = read(Source(f"{name} from line {line} on", head + rows))
            except NothingLeft:
                continue
            check_alike(name, f"from line {line} on", found, settled)
            yield found

    return Blocks(name, every, draw)


def _pieces(path, name: str) -> Iterator[tuple[bytes, bytes, int]]:
    """The head, and whole rows with the number of the first one's line, from the beginning to the end."""
    with _open.stream(path, name) as stream:
        head, rest = _head(stream, name)
        line = head.count(b"\n") + 1
        while piece := stream.read(PIECE):
            rows, end, new = (rest + piece).rpartition(b"\n")
            rest = new
            if rows:
                _check_sections(name, rows, line)
                yield head, rows + end, line
                line += rows.count(b"\n") + 1
        if rest.strip():
            _check_sections(name, rest, line)
            yield head, rest + b"\n", line


def _check_sections(name: str, rows: bytes, line: int) -> None:
    """Raises InputError where a line between the rows may state what holds for those below."""
    for place, text in enumerate(rows.split(b"\n")):
        if text[:1] in NO_ROW and statements(text.decode("latin-1").lstrip("#%!/; \t")):
            shown = text.decode("latin-1").strip()[:60]
            raise InputError(
                f"{name}, line {line + place}: '{shown}' between the rows of a table that is read block by block; "
                f"wanted a column that says it on each row"
            )


def _head(stream, name: str) -> tuple[bytes, bytes]:
    """Comments and names, and what of the rows was read with them. Raises InputError where no row follows."""
    start, place = stream.read(MOST_OF_A_HEAD), 0
    for text in start.splitlines(keepends=True):
        stripped = text.strip().decode("latin-1")
        first = stripped.replace(";", " ").replace(",", " ").replace("|", " ").split()[:1]
        if not stripped.startswith(COMMENTS) and first and holds_number(first[0]):
            return start[:place], start[place:]
        place += len(text)
    raise InputError(f"{name}: a table that is read block by block has rows that begin with a number; found none")


def _drawn_lines(path, name: str, count: int, seed: int) -> tuple[bytes, list[bytes], int]:
    """The head, `count` of all rows as they stand, and how many there are: those with the least keys, without parsing
    any."""
    draw, kept_head = np.random.default_rng((STREAM, seed)), b""
    lines: list[bytes] = []
    keys = np.empty(0)
    limit, size = 1.0, 0
    for head, rows, _ in _pieces(path, name):
        kept_head = head
        ends = np.flatnonzero(np.frombuffer(rows, np.uint8) == 10) + 1
        starts = np.r_[0, ends[:-1]]
        fresh = draw.random(len(ends))
        size += len(ends)
        kept = np.flatnonzero(fresh < limit)
        lines += [rows[starts[each] : ends[each]] for each in kept]
        keys = np.concatenate([keys, fresh[kept]])
        if len(keys) > 2 * count:
            least = np.sort(np.argsort(keys, kind="stable")[:count])
            lines, keys = [lines[each] for each in least], keys[least]
            limit = float(keys.max())
    least = np.sort(np.argsort(keys, kind="stable")[:count])
    return kept_head, [lines[each] for each in least], size
