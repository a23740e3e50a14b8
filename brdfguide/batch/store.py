"""A folder of answers, named after what they follow from: nothing in it is ever stale, and any number of runs share it.

    DIR/brdfguide.json               what the folder is
    DIR/answers/ab/abcd….json        an answer; what is drawn and written of it lies beside it, abcd….report.html
    DIR/failed/ab/abcd….json         why there is none
    DIR/names/12/1234….json          a name of the list -> which answer is its own
    DIR/claims/abcd…                 who is at work on it: a courtesy, of which nothing that is right depends

No file is written by two processes, but whole, with the same content.
"""

import hashlib
import json
import os
import socket
import time
from contextlib import suppress
from pathlib import Path
from typing import Any

from .. import opening
from ..errors import InputError
from ..files import folder as make_folder
from ..files import write_whole
from ..report.documents.digest import digest_holds

SCHEMA = "brdfguide/answers/1"
SIGN = "brdfguide.json"
INDEX = "collected.sqlite"  # what `search` keeps of it
MOST_BYTES = 2**28  # of an answer
STALE_S = 600.0  # of a claim on another machine, unless files have a time limit of their own


def store_at(path: Path) -> "Store":
    """The folder, made where it is not there. Raises InputError where it cannot be, or is another one's."""
    make_folder(path)
    sign = path / SIGN
    if sign.exists():
        return known_store(path)
    write_whole(sign, json.dumps({"schema": SCHEMA}) + "\n")
    return Store(path)


def known_store(path: Path) -> "Store":
    """A folder that is there. Raises InputError for one that holds no answers of ours."""
    sign = path / SIGN
    try:
        found = json.loads(opening.content(sign, 2**16, str(sign))) if sign.exists() else None
    except ValueError:
        found = None
    said = found.get("schema") if isinstance(found, dict) else None
    if said != SCHEMA:
        raise InputError(f"{path}: found no folder of answers; wanted one that `brdfguide fit --out` made")
    return Store(path)


class Store:
    """Answers and failures by key, names by their own hash."""

    def __init__(self, folder: Path):
        self.folder = folder

    def place(self, key: str, kind: str = "answers", suffix: str = ".json") -> Path:
        """Where the answer lies."""
        return self.folder / kind / key[:2] / f"{key}{suffix}"

    def read(self, key: str, schema: str | None = None) -> dict | None:
        """The answer, of whatever schema where none is given; None where there is none, or it is damaged."""
        document = _object(self.place(key)) or {}
        stored = document.get("stored")
        fits = isinstance(stored, dict) and stored.get("key") == key and schema in (None, document.get("schema"))
        return document if fits and digest_holds(document) else None

    def keep(self, key: str, document: dict) -> None:
        """Raises InputError where it cannot be written."""
        self._write(self.place(key), document)
        with suppress(OSError):
            self.place(key, "failed").unlink()

    def failure(self, key: str) -> dict | None:
        """Why there is no answer, with the `limits` it had."""
        found = _object(self.place(key, "failed"))
        known = found is not None and isinstance(found.get("error"), str) and isinstance(found.get("state"), str)
        return found if known else None

    def fail(self, key: str, record: dict) -> None:
        """Raises InputError where it cannot be written."""
        self._write(self.place(key, "failed"), {"schema": "brdfguide/failure/1", **record})

    def named(self, label: str) -> dict:
        """What is known of a name: its `key`, and the `products` made for it; nothing where it is new."""
        found = _object(self.name_place(label)) or {}
        return found if isinstance(found.get("key"), str) and isinstance(found.get("products"), dict) else {}

    def name(self, label: str, key: str, products: dict[str, Any]) -> None:
        """Notes whose answer that is; nothing is written where it is known."""
        record = {"name": label, "key": key, "products": products}
        if self.named(label) != record:
            self._write(self.name_place(label), record)

    def names(self):
        """(name, key) of all, in the order of their hashes."""
        for path in sorted(self.folder.glob("names/*/*.json")):
            found = _object(path)
            if found and isinstance(found.get("name"), str) and isinstance(found.get("key"), str):
                yield found["name"], found["key"]

    def claim(self, key: str, stale_s: float = STALE_S) -> bool:
        """Whether it is ours now; another run is at work on it where it is not."""
        place = self.folder / "claims" / key
        with suppress(OSError):
            place.parent.mkdir(exist_ok=True)
        try:
            handle = os.open(place, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666)
        except FileExistsError:
            return _is_stale(place, stale_s) or _object(place) == _me()
        except OSError:  # whatever it is, the answer's own writing says it
            return True
        with suppress(OSError), os.fdopen(handle, "w") as stream:
            json.dump(_me(), stream)
        return True

    def release(self, key: str) -> None:
        """The work is done, or given up."""
        with suppress(OSError):
            (self.folder / "claims" / key).unlink()

    def name_place(self, label: str) -> Path:
        """Where it is noted whose answer a name has."""
        return self.place(hashlib.sha256(os.fsencode(label)).hexdigest(), "names")

    def _write(self, place: Path, document: dict) -> None:
        if not place.parent.is_dir():
            make_folder(place.parent)
        write_whole(place, json.dumps(document, allow_nan=False, separators=(",", ":")) + "\n")


def _object(path: Path) -> dict | None:
    """A JSON object; None where there is none that is whole."""
    if not opening.is_plain(path):
        return None
    try:
        found = json.loads(opening.content(path, MOST_BYTES, str(path)))
    except (InputError, ValueError, RecursionError):
        return None
    return found if isinstance(found, dict) else None


def _me() -> dict:
    return {"host": socket.gethostname(), "pid": os.getpid()}


def _is_stale(place: Path, stale_s: float) -> bool:
    """Whether who made a claim is gone: its process, where it was one of this machine, else by the time."""
    found = _object(place) or {}
    try:
        if found.get("host") == socket.gethostname():
            os.kill(int(found["pid"]), 0)
        return time.time() - place.stat().st_mtime > stale_s
    except PermissionError:
        return False
    except (OSError, KeyError, TypeError, ValueError):
        return True
