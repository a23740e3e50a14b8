"""Files that are written whole or not at all, and looked at before anything is computed for them."""

import os
from pathlib import Path

from .errors import InputError, choices

PICTURES = ("png", "svg", "pdf")


def write_whole(path: Path, content: bytes | str, *, force: bool = True) -> None:
    """Write `path` whole or not at all. Raises InputError where it may not or cannot be written."""
    path = writable(path)
    if path.exists() and not force:
        raise InputError(f"{path} exists; --force replaces it")
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        partial.write_bytes(content.encode() if isinstance(content, str) else content)
        partial.replace(path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise InputError(f"cannot write {path}: {error.strerror}") from None


def writable(path) -> Path:
    """The path, if a file can be there. Raises InputError for a folder, and where the folder it should be in is not."""
    path = Path(path)
    if path.is_dir():
        raise InputError(f"cannot write {path}: it is a folder")
    if not path.parent.is_dir():
        raise InputError(f"cannot write {path}: there is no folder {path.parent}")
    return path


def picture_kind(path) -> str:
    """What kind of picture a path asks for. Raises InputError for one that is not drawn."""
    kind = Path(path).suffix.lower().removeprefix(".")
    if kind not in PICTURES:
        raise choices("kind of picture", kind or Path(path).name, PICTURES)
    return kind
