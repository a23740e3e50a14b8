"""Many answers as one table: SQLite, which any asset manager reads, or a flat one as CSV, JSON lines or Parquet.

    fit(key, ...)        a row for each answer, by its recommended model
    name(file, key)      which files have it
    parameter, ranking   every candidate's values, and its place
    look(key, vector)    how it looks, for `search --like`: lightness [L*] at the directions of LOOKS, float32
    failure, product     what was not answered, and what lies beside an answer

A key is what an answer follows from, so that a row once there is right for ever: a second run adds what is new and
takes out what is no more.
"""

import os
import sqlite3
import time
from collections.abc import Iterator
from contextlib import ExitStack, closing, contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory

from ..errors import BrdfguideError, InputError
from .store import INDEX, SIGN, Store

SCHEMA = "brdfguide/collected/1"
JUST_NOW_NS = 2 * 10**9
WAITED_S = 300.0  # for another process that collects into the same file
COLUMNS = {
    "sha256": "TEXT",  # of the data
    "fingerprint": "TEXT",  # of the program
    "recommended": "TEXT",
    "tied": "INTEGER",  # models that cannot be told from the best
    "kind": "TEXT",  # metal, dielectric
    "rms_ln": "REAL",
    "held_out": "REAL",
    "behind": "REAL",
    "seen": "REAL",  # L* off the measurement
    "flags": "TEXT",
    "no_answer": "TEXT",
    "samples": "INTEGER",
    "f0": "REAL",
    "albedo": "REAL",
    "albedo_r": "REAL",
    "albedo_g": "REAL",
    "albedo_b": "REAL",
    "gloss20": "REAL",
    "gloss60": "REAL",
    "gloss85": "REAL",
    "alpha_equivalent": "REAL",  # the lobe's own; else about that of the Beckmann lobe that is as wide at 30 degrees
    "doubt": "REAL",  # L*, of one standard error of every parameter
    "turns": "INTEGER",  # whether it changes as it is turned in its plane
    "surface": "TEXT",  # a fit's JSON with the recommended row alone
}
TABLES = (
    f"fit(key TEXT PRIMARY KEY, {', '.join(f'{name} {kind}' for name, kind in COLUMNS.items())})",
    "name(file TEXT PRIMARY KEY, key TEXT)",
    "parameter(key TEXT, candidate TEXT, name TEXT, channel TEXT, value REAL, stderr REAL, unit TEXT, at_bound TEXT)",
    "ranking(key TEXT, candidate TEXT, rank INTEGER, rms_ln REAL, held_out REAL, seen REAL, free INTEGER)",
    "look(key TEXT PRIMARY KEY, colours INTEGER, vector BLOB)",
    "failure(key TEXT PRIMARY KEY, file TEXT, state TEXT, error TEXT, tries INTEGER)",
    "product(key TEXT, kind TEXT, path TEXT)",
)


def collect_into(store: Store, path: Path) -> tuple[int, int]:
    """Brings a database up to the folder: how many answers it holds, and how many of them are new.

    What lies in folders that nobody wrote in since is not looked at. Raises InputError where the file is no such
    database, holds the answers of another folder that is there, or cannot be written.
    """
    with opened(path, make=True) as base, base:
        base.execute("CREATE TABLE IF NOT EXISTS stamp(folder TEXT PRIMARY KEY, ns INTEGER)")
        known = dict(base.execute("SELECT folder, ns FROM stamp"))
        _check_folder(known, store, path)
        stamps: dict[str, int | None] = {}
        new = 0
        for kind, bring in (("answers", _bring_answers), ("names", _bring_names), ("failed", _bring_failures)):
            found = _stamps(store.folder / kind)
            before = {folder: ns for folder, ns in known.items() if Path(folder).parent.name == kind}
            if found != before or None in found.values():
                new += bring(base, store)
            stamps |= found
        if stamps != known:
            base.execute("DELETE FROM stamp")
            base.executemany("INSERT INTO stamp VALUES (?, ?)", stamps.items())
        (count,) = base.execute("SELECT count(*) FROM fit").fetchone()
    return count, new


def _check_folder(known: dict[str, int], store: Store, path: Path) -> None:
    """Raises InputError where a database outside of the folder was made of another one, whose answers would go."""
    here = Path(os.path.abspath(store.folder))
    roots = {Path(folder).parent.parent for folder in known} - {here}
    others = sorted(str(root) for root in roots if (root / SIGN).exists() and not os.path.samefile(root, here))
    if others and here not in Path(os.path.abspath(path)).parents:
        raise InputError(
            f"{path}: it holds the answers of {others[0]}, which those of {store.folder} would replace; collect into "
            f"another file"
        )


def _stamps(folder: Path) -> dict[str, int | None]:
    """When something was last written in each folder inside a folder; None where that was a moment ago.

    A clock has steps, and more may be written within one.
    """
    with suppress(OSError), os.scandir(folder) as inside:
        each = {stored_name(os.path.abspath(entry.path)): entry.stat().st_mtime_ns for entry in inside}
        return {path: ns if time.time_ns() - ns > JUST_NOW_NS else None for path, ns in each.items()}
    return {}


def _bring_answers(base: sqlite3.Connection, store: Store) -> int:
    """Answers that are new, and products; how many."""
    there = {path.stem: path for path in store.folder.glob("answers/*/*.json")}
    known = {key for (key,) in base.execute("SELECT key FROM fit")}
    for key in known - there.keys():
        _forget(base, key)
    new = 0
    for key in sorted(there.keys() - known):
        document = store.read(key, "brdfguide/fit/1")
        if document is not None:
            new += _add(base, key, document)
    base.execute("DELETE FROM product")
    for path in store.folder.glob("answers/*/*"):
        key, _, kind = path.name.partition(".")
        if kind != "json" and not key.startswith("."):
            base.execute("INSERT INTO product VALUES (?, ?, ?)", (key, kind, stored_name(str(path))))
    return new


@contextmanager
def opened(path: Path, make: bool = False) -> Iterator[sqlite3.Connection]:
    """A database of answers. Raises InputError for another file, and where it is not there and not to be made."""
    if not make and not path.is_file():
        raise InputError(
            f"{path}: there is no such file; wanted what `brdfguide collect` makes, or a folder of answers"
        )
    try:
        with closing(sqlite3.connect(path, WAITED_S)) as base:
            if make:
                base.execute("BEGIN IMMEDIATE")  # or two would each add what they both found new
            said = base.execute("SELECT name FROM sqlite_master WHERE name = 'brdfguide'").fetchone()
            tables = base.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
            if said is None and (tables or not make):
                raise InputError(f"{path}: found a database of something else; wanted what `brdfguide collect` makes")
            if said is None:
                _made(base)
            elif base.execute("SELECT schema FROM brdfguide").fetchone() != (SCHEMA,):
                raise Unreadable(f"{path}: another version of brdfguide made it; collect into another file")
            yield base
    except sqlite3.Error as error:
        kind = InputError if isinstance(error, sqlite3.OperationalError) else Unreadable  # such as locked, full
        raise kind(f"{path}: {error}; wanted what `brdfguide collect` makes") from None


class Unreadable(InputError):
    """A database that is damaged, or of another version."""


@contextmanager
def collected(store: Store, path: Path | None = None) -> Iterator[tuple[sqlite3.Connection, int, int]]:
    """A database brought up to the folder, how many answers it holds, and how many of them are new.

    Without a path it lies in the folder, if that can be written, and is made anew where it is damaged. Raises
    InputError where the file is no such database or cannot be written.
    """
    with ExitStack() as stack:
        if path is not None:
            counts = collect_into(store, path)
        else:
            is_open = os.access(store.folder, os.W_OK)
            path = (store.folder if is_open else Path(stack.enter_context(TemporaryDirectory()))) / INDEX
            try:
                counts = collect_into(store, path)
            except Unreadable:
                path.unlink()
                counts = collect_into(store, path)
        yield stack.enter_context(opened(path)), *counts


def _made(base: sqlite3.Connection) -> None:
    for table in TABLES:
        base.execute(f"CREATE TABLE {table}")
    for table in ("name", "parameter", "ranking", "product"):
        base.execute(f"CREATE INDEX {table}_key ON {table}(key)")
    base.execute("CREATE TABLE brdfguide(schema TEXT)")
    base.execute("INSERT INTO brdfguide VALUES (?)", (SCHEMA,))


def _forget(base: sqlite3.Connection, key: str) -> None:
    for table in ("fit", "parameter", "ranking", "look", "product"):
        base.execute(f"DELETE FROM {table} WHERE key = ?", (key,))


def _bring_names(base: sqlite3.Connection, store: Store) -> int:
    base.execute("DELETE FROM name")
    base.executemany("INSERT INTO name VALUES (?, ?)", ((stored_name(file), key) for file, key in store.names()))
    return 0


def _bring_failures(base: sqlite3.Connection, store: Store) -> int:
    base.execute("DELETE FROM failure")
    for path in store.folder.glob("failed/*/*.json"):
        found = store.failure(path.stem)
        if found is not None:
            row = (
                path.stem,
                stored_name(str(found.get("file"))),
                found["state"],
                stored_name(found["error"]),
                found.get("tries"),
            )
            base.execute("INSERT OR REPLACE INTO failure VALUES (?, ?, ?, ?, ?)", row)
    return 0


def stored_name(text: str) -> str:
    """A name as a database holds it: bytes that are no UTF-8 are shown as such."""
    return text.encode(errors="backslashreplace").decode()


def _add(base: sqlite3.Connection, key: str, document: dict) -> bool:
    """Whether the answer could be read."""
    from .described_rows import described_row  # models and figures, which a search by words needs nothing of

    places: list[tuple] = []
    parameters: list[tuple] = []
    try:
        row, vector = described_row(document)
        channels = document["data"]["channels"]
        for entry in document["ranking"]:
            errors = entry["rms_ln"], entry["held_out_rms_ln"], entry["seen"], entry["free_parameters"]
            places.append((key, entry["candidate"], entry["rank"], *errors))
            parameters += _parameters(key, entry, channels)
    except (BrdfguideError, KeyError, TypeError, ValueError):
        return False
    names = list(COLUMNS)
    marks = ", ".join("?" for _ in range(len(names) + 1))
    base.execute(f"INSERT OR REPLACE INTO fit VALUES ({marks})", (key, *(row[name] for name in names)))
    base.execute("INSERT OR REPLACE INTO look VALUES (?, ?, ?)", (key, vector.shape[1], vector.tobytes()))
    base.executemany("INSERT INTO ranking VALUES (?, ?, ?, ?, ?, ?, ?)", places)
    base.executemany("INSERT INTO parameter VALUES (?, ?, ?, ?, ?, ?, ?, ?)", parameters)
    return True


def _parameters(key: str, entry: dict, channels: list[str]) -> Iterator[tuple]:
    for name, value in entry["parameters"].items():
        values, errors = each_of(value["value"]), each_of(value["stderr"])
        for place, each in enumerate(values):
            channel = channels[place] if len(values) == len(channels) else ""
            error = errors[place] if place < len(errors) else None
            yield key, entry["candidate"], name, channel, each, error, value["unit"], value["at_bound"]


def each_of(value) -> list:
    """A number, or one for each channel, as a list."""
    return value if isinstance(value, list) else [value]


FLAT = ["file", "key", *(name for name in COLUMNS if name != "surface")]


def flat_rows(base: sqlite3.Connection) -> list[tuple]:
    """A row for each file that has an answer, in the order of their names; the columns are FLAT."""
    columns = ", ".join(f"fit.{name}" for name in FLAT[2:])
    return base.execute(f"SELECT file, name.key, {columns} FROM name JOIN fit USING (key) ORDER BY file").fetchall()


def answered_names(base: sqlite3.Connection) -> set[str]:
    """Every file that has an answer."""
    return {file for (file,) in base.execute("SELECT file FROM name JOIN fit USING (key)")}
