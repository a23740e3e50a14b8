"""Files that are written whole or not at all, and looked at before anything is computed for them.

A link is followed and what it points to is replaced, with its mode. What is no plain file (a terminal, a pipe, a
device) is written into and never replaced.
"""

import errno
import os
import stat
import time
from contextlib import suppress
from pathlib import Path

from .errors import InputError, choices

PICTURES = ("png", "svg", "pdf")
WAITED_S = 5.0  # for a pipe's other end
INTO = (stat.S_ISFIFO, stat.S_ISCHR)  # what is written into; a disk or a socket is neither


def write_whole(path, content: bytes | str, *, force: bool = True) -> None:
    """Write `path` whole or not at all; a pipe or a device is written into.

    Raises InputError where it may not or cannot be written.
    """
    path = writable(path)
    data = content.encode(errors="backslashreplace") if isinstance(content, str) else content
    if taken(path) and not force:
        raise InputError(f"{path} exists; --force replaces it")
    try:
        if _is(path, *INTO):
            _write_into(path, data)
        elif (open_one := _open_already(path)) is not None:
            _write_all(open_one, data)
        else:
            _replace(Path(os.path.realpath(path)), data)
    except OSError as error:
        raise InputError(f"cannot write {path}: {error.strerror or error}") from None


def _replace(path: Path, data: bytes) -> None:
    """A new file beside the old one, which takes its place and its mode."""
    partial = path.with_name(f".brdfguide-{os.getpid()}-{time.monotonic_ns()}.partial")
    old = path.stat() if path.exists() else None
    handle = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(data)
        if old is not None:
            _like(partial, old)
        partial.replace(path)
    except BaseException:  # also a signal
        partial.unlink(missing_ok=True)
        raise


def _like(path: Path, old: os.stat_result) -> None:
    """The owner, where we may give it, then the mode, which a change of owner would strip."""
    with suppress(OSError, AttributeError):
        if (old.st_uid, old.st_gid) != (os.geteuid(), os.getegid()):
            os.chown(path, old.st_uid, old.st_gid)
    path.chmod(stat.S_IMODE(old.st_mode))


def _write_into(path: Path, data: bytes) -> None:
    """Into a device or a pipe. Raises InputError for a pipe that nobody reads."""
    flags, until = os.O_WRONLY | getattr(os, "O_NOCTTY", 0), time.monotonic() + WAITED_S
    fifo = _is(path, stat.S_ISFIFO)
    while True:
        try:
            handle = os.open(path, flags | os.O_NONBLOCK if fifo else flags)
            break
        except OSError as error:
            if not fifo or error.errno != errno.ENXIO:
                raise
            if time.monotonic() > until:
                raise InputError(f"{path} is a pipe, and nobody read it for {WAITED_S:g} seconds") from None
            time.sleep(0.02)
    try:
        os.set_blocking(handle, True)
        _write_all(handle, data)
    finally:
        os.close(handle)


def _write_all(handle: int, data: bytes) -> None:
    view = memoryview(data)
    while view:
        view = view[os.write(handle, view) :]


def _open_already(path: Path) -> int | None:
    """1 or 2 where the path is what standard output or error goes to: `-o /dev/stdout > file` must not replace it."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    for handle in (1, 2):
        with suppress(OSError):
            if os.path.samestat(found, os.fstat(handle)):
                return handle
    return None


def _is(path, *kinds) -> bool:
    try:
        mode = os.stat(path).st_mode
    except (OSError, ValueError):
        return False
    return any(kind(mode) for kind in kinds)


def taken(path) -> bool:
    """Whether a plain file is there, which writing would replace."""
    return _is(path, stat.S_ISREG)


def writable(path) -> Path:
    """The path, if a file can be there. Raises InputError for a folder, a disk or a socket, for a name that no file can
    have, and where the folder that it should be in is not there or not to be written into."""
    path = Path(path)
    try:
        mode = path.stat().st_mode
    except ValueError as error:
        raise InputError(f"cannot write {path}: {error}") from None
    except FileNotFoundError:
        mode = 0
    except OSError as error:
        raise InputError(f"cannot write {path}: {error.strerror or error}") from None
    if stat.S_ISDIR(mode):
        raise InputError(f"cannot write {path}: it is a folder")
    if mode and not (stat.S_ISREG(mode) or any(kind(mode) for kind in INTO)):
        raise InputError(f"cannot write {path}: it is neither a file nor a pipe nor a terminal")
    folder = Path(os.path.realpath(path)).parent if path.is_symlink() else path.parent
    if not folder.is_dir():
        raise InputError(f"cannot write {path}: there is no folder {folder}")
    replaced = not mode or stat.S_ISREG(mode)
    if replaced and not os.access(folder, os.W_OK) and _open_already(path) is None:
        raise InputError(f"cannot write {path}: nothing may be written into {folder}")
    return path


def folder(path) -> Path:
    """A folder for files, made where it is not there. Raises InputError where it cannot be."""
    path = Path(path)
    try:
        path.mkdir(parents=True, exist_ok=True)
    except FileExistsError:
        raise InputError(f"{path} is a file; wanted a folder") from None
    except (OSError, ValueError) as error:
        raise InputError(f"cannot make the folder {path}: {getattr(error, 'strerror', None) or error}") from None
    return path


def picture_kind(path) -> str:
    """What kind of picture a path asks for. Raises InputError for one that is not drawn."""
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in PICTURES:
        raise choices("kind of picture", kind or Path(path).name, PICTURES)
    return kind
