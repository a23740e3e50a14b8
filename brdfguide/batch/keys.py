"""What an answer follows from, as one number: the bytes that were read, what was asked, and what computes it."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

from .. import catalog, opening
from ..errors import InputError

# What an answer cannot follow from: how it is asked for, kept, drawn and told.
WITHOUT_NUMBERS = ("batch", "cli", "audit", "report/figures", "report/text", "report/page")
ALL_BUT = ("batch", "cli", "audit")
NUMERIC = (".py", ".csv", ".npy")
EXTRAS = (
    "colour",
    "cv2",
    "rawpy",
    "OpenEXR",
    "openpyxl",
    "pyarrow",
    "h5py",
    "zarr",
)  # with one of them other files can be read
DIGITS = 20  # of the number, where a person sees it


class DataBytes(NamedTuple):
    """What was read of one file."""

    sha256: str
    size: int


def engine() -> str:
    """The fingerprint of what computes answers: the package's own numeric sources, and which extras are there.

    Not the version: between two versions many a commit moves a number.
    """
    return _fingerprint(WITHOUT_NUMBERS)


def drawing_engine() -> str:
    """The same of what draws and writes products of an answer."""
    return _fingerprint(ALL_BUT)


@cache
def _fingerprint(without: tuple[str, ...]) -> str:
    digest = hashlib.sha256()
    for path in sorted(catalog.HERE.rglob("*")):
        inside = path.relative_to(catalog.HERE).as_posix()
        if path.suffix in NUMERIC and not inside.startswith(without):
            digest.update(f"{inside}\0{path.stat().st_size}\0".encode())
            digest.update(path.read_bytes())
    digest.update(",".join(name for name in EXTRAS if find_spec(name)).encode())
    return digest.hexdigest()


def bytes_of(file: Path | opening.Held) -> DataBytes:
    """Raises InputError where it cannot be read."""
    digest, size = hashlib.sha256(), 0
    with opening.open_for_reading(file, str(file)) as stream:
        while piece := stream.read(opening.PIECE):
            digest.update(piece)
            size += len(piece)
    return DataBytes(digest.hexdigest(), size)


def beside(files: Iterable[Path]) -> list[list]:
    """Names and bytes of further files, whose names an answer may follow from too; None for one that is not there."""
    found: list[list] = []
    for each in files:
        try:
            found.append([each.name, bytes_of(each).sha256])
        except InputError:
            found.append([each.name, None])
    return found


def canonical(value: Any) -> Any:
    """A value as JSON holds it, so that equal values, and no others, have one text."""
    if is_dataclass(value) and not isinstance(value, type):
        return {each.name: canonical(getattr(value, each.name)) for each in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): canonical(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [canonical(item) for item in value]
    if hasattr(value, "tolist"):
        return canonical(value.tolist())
    if value is None or isinstance(value, (str, int, float, bool)):
        return value
    return str(value)


def key_of(asked: dict, data: DataBytes, others: list[list]) -> str:
    """The answer's name: 64 hexadecimal digits."""
    parts = [engine(), asked, data.sha256, others]
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()
