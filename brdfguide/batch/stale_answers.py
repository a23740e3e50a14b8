"""Answers of a folder that no run will ask for again: of another version, of data that are gone, answered anew
since with other options or data, or damaged.

Nothing that is served is ever stale, since an answer's name says what it follows from; what is left behind only takes
room. An answer is kept while this program would compute it and some name of the list still has its data.
"""

import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from .. import opening
from ..errors import InputError
from .keys import bytes_of, engine
from .store import Store

VERSION, GONE, ANEW, DAMAGED = "another version", "data gone", "answered anew", "damaged"


class StaleAnswer(NamedTuple):
    """An answer, or a note on a failure, and what lies beside it."""

    key: str
    why: str
    names: tuple[str, ...]  # of the list, as they were when it was computed
    files: tuple[Path, ...]
    size: int  # bytes


def stale_answers(store: Store) -> list[StaleAnswer]:
    """In the order of their keys.

    Takes  a store whose names are understood from the folder that one is in: a relative name of another folder is gone.
    """
    names: dict[str, list[str]] = {}
    for label, key in store.names():
        names.setdefault(key, []).append(label)
    known: dict[str, str] = {}
    found = [_of_answer(store, key, names.get(key, []), known) for key in _keys(store, "answers")]
    found += [_of_failure(store, key, names.get(key, [])) for key in _keys(store, "failed")]
    return sorted(each for each in found if each is not None)


def remove(store: Store, stale: list[StaleAnswer]) -> None:
    """Removes them, and the names that had nothing else. Raises InputError where that is not allowed."""
    for each in stale:
        for path in each.files:
            _unlink(path)
    gone = {each.key for each in stale}
    for label, key in list(store.names()):
        if key in gone:
            _unlink(store.name_place(label))


def _keys(store: Store, kind: str) -> Iterator[str]:
    return (path.name.removesuffix(".json") for path in sorted(store.folder.glob(f"{kind}/*/*.json")))


def _of_answer(store: Store, key: str, labels: list[str], known: dict[str, str]) -> StaleAnswer | None:
    document = store.read(key)
    if document is None:
        why = DAMAGED
    elif document["stored"].get("fingerprint") != engine():
        why = VERSION
    elif not labels:  # of every name that it had another answer is the last
        why = ANEW
    elif not any(_has(label, document["stored"], known) for label in labels):
        why = GONE
    else:
        return None
    return _stale(store, key, "answers", why, labels)


def _of_failure(store: Store, key: str, labels: list[str]) -> StaleAnswer | None:
    """A failure keeps no fingerprint: it is stale once its name has another answer, or no file."""
    there = any(_is_stream(label) or opening.exists(_file_of(label)) for label in labels)
    return None if there else _stale(store, key, "failed", GONE, labels)


def _stale(store: Store, key: str, kind: str, why: str, labels: list[str]) -> StaleAnswer:
    files = tuple(sorted(store.place(key, kind).parent.glob(f"{key}.*")))
    return StaleAnswer(key, why, tuple(sorted(labels)), files, sum(os.path.getsize(each) for each in files))


def _has(label: str, stored: dict, known: dict[str, str]) -> bool:
    """Whether the file of a name still has the bytes that an answer was computed from."""
    if _is_stream(label):
        return True  # nobody can look what it would be now
    file = _file_of(label)
    if file not in known:
        known[file] = ""  # as of a name that is none of a file, such as a material's
        with suppress(InputError):
            known[file] = bytes_of(Path(file)).sha256 if opening.is_plain(file) else ""
    data = stored.get("data")
    return isinstance(data, dict) and known[file] == data.get("sha256")


def _is_stream(label: str) -> bool:
    return label.partition(" [")[0] == "-"


def _file_of(label: str) -> str:
    """Of `d/steel.csv [paint=2]` d/steel.csv."""
    return label if opening.exists(label) else label.partition(" [")[0]


def _unlink(path: Path) -> None:
    try:
        path.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(f"{path}: cannot be removed: {error.strerror or error}") from None
