"""Files of other people, opened so that none can hold us up: a pipe that nobody feeds, a device without an end."""

import os
import stat
import sys
import time
from contextlib import contextmanager
from io import BufferedReader, BytesIO, FileIO, RawIOBase
from pathlib import Path

from .errors import InputError, no_such_file
from .records import dataclass

WAITED_S = 5.0  # for a pipe's other end; a shell opens both at once
PIECE = 2**20
ARRAY_FOLDERS = ("zarr.json", ".zgroup", ".zarray")  # one of them in a folder: all of it is one file of arrays
ARRAY_FOLDER = b"zarr folder\0"  # what such a folder begins with, read as one file
MOST_HELD = 2**28  # bytes of an input that can be read only once, and is held


@dataclass(frozen=True)
class Held:
    """An input that can be read only once, such as standard input, with what was read."""

    name: str
    data: bytes

    def __str__(self) -> str:
        return self.name


def held(path) -> "Path | Held":
    """The same, and what can be read only once with what was read. Raises InputError where it cannot be."""
    if isinstance(path, Held):
        return path
    if str(path) == "-":
        return Held("-", standard_input(MOST_HELD))
    if is_plain(path) or not exists(path):
        return Path(path)
    return Held(str(path), content(path, MOST_HELD, str(path)))


@contextmanager
def open_for_reading(path, name: str):
    """A binary stream of a file as it lies there. Raises InputError where it cannot be opened or read."""
    if isinstance(path, Held):
        yield BytesIO(path.data)
        return
    try:
        mode = os.stat(path).st_mode
        if stat.S_ISDIR(mode) and is_array_folder(path):
            yield _ArrayFolder(Path(path), name)
            return
        if stat.S_ISDIR(mode):
            raise InputError(f"{name} is a directory; wanted a file")
        with _pipe(path, name) if stat.S_ISFIFO(mode) else Path(path).open("rb") as stream:
            yield stream
    except FileNotFoundError:
        raise no_such_file(path, name) from None
    except OSError as error:
        raise InputError(f"{name}: cannot be read: {error.strerror or error}") from None
    except ValueError as error:
        if "null" not in str(error):
            raise
        raise InputError(f"{name}: there can be no such file: its name has a zero byte") from None


def content(path, limit: int, name: str) -> bytes:
    """All of a file. Raises InputError where it cannot be read, and beyond `limit` bytes, of which no more are held."""
    with open_for_reading(path, name) as stream:
        return _all(stream, limit, name)


def standard_input(limit: int) -> bytes:
    """The same of standard input."""
    return _all(sys.stdin.buffer, limit, "standard input")


def _all(stream, limit: int, name: str) -> bytes:
    pieces, size = [], 0
    while piece := stream.read(PIECE):
        pieces.append(piece)
        size += len(piece)
        if size > limit:
            raise InputError(f"{name}: goes on beyond {limit / 1e6:.0f} MB, more than such a file can honestly hold")
    return b"".join(pieces)


def is_plain(path) -> bool:
    """Whether it is a file that comes to an end and can be read again: no pipe, no device, nothing of the kernel's."""
    try:
        mode = os.stat(path).st_mode
    except (OSError, ValueError):
        return False
    plain = stat.S_ISREG(mode) or stat.S_ISDIR(mode) and is_array_folder(path)
    return plain and not os.path.realpath(path).startswith(("/proc/", "/sys/"))


def is_array_folder(path) -> bool:
    """Whether it is a folder that is one file of arrays, as zarr keeps them."""
    return any(os.path.isfile(os.path.join(path, mark)) for mark in ARRAY_FOLDERS)


def is_folder(path) -> bool:
    """Whether it is a folder of files, not one that is a file of arrays."""
    return os.path.isdir(path) and not is_array_folder(path)


def exists(path) -> bool:
    """Whether anything is there; nothing is at a name that no file can have."""
    try:
        os.stat(path)
    except (OSError, ValueError):
        return False
    return True


def _pipe(path, name: str):
    """A named pipe, once somebody writes into it; nobody there is no reason to wait for ever."""
    handle = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    until, first = time.monotonic() + WAITED_S, b""
    try:
        while not first:
            try:
                first = os.read(handle, PIECE)
            except BlockingIOError:
                break  # a writer is there, and has not written yet
            if not first:
                if time.monotonic() > until:
                    raise InputError(f"{name} is a pipe, and nobody wrote into it for {WAITED_S:g} seconds")
                time.sleep(0.02)
        os.set_blocking(handle, True)
    except BaseException:
        os.close(handle)
        raise
    return BufferedReader(_Begun(first, FileIO(handle)))


class _ArrayFolder:
    """read(size) over all files of a folder in the order of their names, each behind its name and size.

    Raises InputError for what is no plain file in it, such as a link or a pipe.
    """

    def __init__(self, folder: Path, name: str):
        self.folder, self.name = folder, name
        self.files = sorted(each.relative_to(folder).as_posix() for each in folder.rglob("*") if not _is_own(each))
        for file in self.files:
            if not stat.S_ISREG(os.lstat(folder / file).st_mode):
                raise InputError(f"{name}: '{file[:80]}' in it is no plain file")
        self.pieces = self._pieces()
        self.left = b""

    def _pieces(self):
        yield ARRAY_FOLDER
        for file in self.files:
            with (self.folder / file).open("rb") as stream:
                yield f"{file}\0{os.fstat(stream.fileno()).st_size}\0".encode("utf-8", "surrogateescape")
                while piece := stream.read(PIECE):
                    yield piece

    def read(self, size: int) -> bytes:
        while not self.left:
            try:
                self.left = next(self.pieces)
            except StopIteration:
                return b""
        piece, self.left = self.left[:size], self.left[size:]
        return piece


def _is_own(path: Path) -> bool:
    """A folder that is one, not a link to one."""
    return path.is_dir() and not path.is_symlink()


class _Begun(RawIOBase):
    """A stream of which the first bytes were taken already."""

    def __init__(self, first: bytes, rest: FileIO):
        self.first, self.rest = first, rest

    def readable(self) -> bool:
        return True

    def readinto(self, into) -> int:
        piece = self.first[: len(into)] or self.rest.read(len(into)) or b""
        self.first = self.first[len(piece) :]
        into[: len(piece)] = piece
        return len(piece)

    def close(self) -> None:
        self.rest.close()
        super().close()
