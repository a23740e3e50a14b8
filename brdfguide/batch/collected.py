"""Many answers as one table: SQLite, which any asset manager reads, or a flat one as CSV, JSON lines or Parquet.

    fit(key, ...)        a row for each answer, by its recommended model
    name(file, key)      which files have it
    parameter, ranking   every candidate's values, and its place
    look(key, vector)    how it looks, for `search --like`: lightness [L*] at the directions of LOOKS, float32
    failure, product     what was not answered, and what lies beside an answer

A key is what an answer follows from, so that a row once there is right for ever: a second run adds what is new and
takes out what is no more.
"""

import json
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import BrdfguideError, InputError
from ..fitting import saved
from ..fitting.appearance import lobe_width_deg
from ..models.looks import lightness_shown, turns
from ..models.surface import Surface
from ..physics import fresnel, gloss, seen
from ..physics.aperture import Instrument
from .store import Store

SCHEMA = "brdfguide/collected/1"
INDEX = "collected.sqlite"  # in a folder of answers
LOOKS = 12, 5, 5  # of `seen.sphere`: orders pairs as the full one does, see tests/batch/test_searching.py
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

    Raises InputError where the file is no such database or cannot be written.
    """
    with opened(path, make=True) as base, base:
        there = {path.stem: path for path in store.folder.glob("answers/*/*.json")}
        known = {key for (key,) in base.execute("SELECT key FROM fit")}
        for key in known - there.keys():
            _forget(base, key)
        new = 0
        for key in sorted(there.keys() - known):
            document = store.read(key, "brdfguide/fit/1")
            if document is not None:
                new += _add(base, key, document)
        _rest(base, store)
        (count,) = base.execute("SELECT count(*) FROM fit").fetchone()
    return count, new


@contextmanager
def opened(path: Path, make: bool = False) -> Iterator[sqlite3.Connection]:
    """A database of answers. Raises InputError for another file, and where it is not there and not to be made."""
    if not make and not path.is_file():
        raise InputError(
            f"{path}: there is no such file; wanted what `brdfguide collect` makes, or a folder of answers"
        )
    try:
        with closing(sqlite3.connect(path)) as base:
            said = base.execute("SELECT name FROM sqlite_master WHERE name = 'brdfguide'").fetchone()
            tables = base.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]
            if said is None and (tables or not make):
                raise InputError(f"{path}: found a database of something else; wanted what `brdfguide collect` makes")
            if said is None:
                _made(base)
            elif base.execute("SELECT schema FROM brdfguide").fetchone() != (SCHEMA,):
                raise InputError(f"{path}: another version of brdfguide made it; collect into another file")
            yield base
    except sqlite3.Error as error:
        raise InputError(f"{path}: {error}; wanted what `brdfguide collect` makes") from None


def _made(base: sqlite3.Connection) -> None:
    with base:
        for table in TABLES:
            base.execute(f"CREATE TABLE {table}")
        for table in ("name", "parameter", "ranking", "product"):
            base.execute(f"CREATE INDEX {table}_key ON {table}(key)")
        base.execute("CREATE TABLE brdfguide(schema TEXT)")
        base.execute("INSERT INTO brdfguide VALUES (?)", (SCHEMA,))


def _forget(base: sqlite3.Connection, key: str) -> None:
    for table in ("fit", "parameter", "ranking", "look", "product"):
        base.execute(f"DELETE FROM {table} WHERE key = ?", (key,))


def _rest(base: sqlite3.Connection, store: Store) -> None:
    """Names, failures and products, which change from run to run."""
    for table in ("name", "failure", "product"):
        base.execute(f"DELETE FROM {table}")
    base.executemany("INSERT INTO name VALUES (?, ?)", ((_utf8(file), key) for file, key in store.names()))
    for path in store.folder.glob("failed/*/*.json"):
        found = store.failure(path.stem)
        if found is not None:
            row = (path.stem, _utf8(str(found.get("file"))), found["state"], _utf8(found["error"]), found.get("tries"))
            base.execute("INSERT OR REPLACE INTO failure VALUES (?, ?, ?, ?, ?)", row)
    for path in store.folder.glob("answers/*/*"):
        key, _, kind = path.name.partition(".")
        if kind != "json" and not key.startswith("."):
            base.execute("INSERT INTO product VALUES (?, ?, ?)", (key, kind, _utf8(str(path))))


def _utf8(text: str) -> str:
    """A name as a database holds it: bytes that are no UTF-8 are shown as such."""
    return text.encode(errors="backslashreplace").decode()


def _add(base: sqlite3.Connection, key: str, document: dict) -> bool:
    """Whether the answer could be read."""
    try:
        row, vector = described_row(document)
    except (BrdfguideError, KeyError, TypeError, ValueError):
        return False
    names = list(COLUMNS)
    marks = ", ".join("?" for _ in range(len(names) + 1))
    base.execute(f"INSERT OR REPLACE INTO fit VALUES ({marks})", (key, *(row[name] for name in names)))
    base.execute("INSERT OR REPLACE INTO look VALUES (?, ?, ?)", (key, vector.shape[1], vector.tobytes()))
    channels = document["data"]["channels"]
    for entry in document["ranking"]:
        errors = entry["rms_ln"], entry["held_out_rms_ln"], entry["seen"], entry["free_parameters"]
        base.execute(
            "INSERT INTO ranking VALUES (?, ?, ?, ?, ?, ?, ?)", (key, entry["candidate"], entry["rank"], *errors)
        )
        base.executemany("INSERT INTO parameter VALUES (?, ?, ?, ?, ?, ?, ?, ?)", _parameters(key, entry, channels))
    return True


def _parameters(key: str, entry: dict, channels: list[str]) -> Iterator[tuple]:
    for name, value in entry["parameters"].items():
        values, errors = _listed(value["value"]), _listed(value["stderr"])
        for place, each in enumerate(values):
            channel = channels[place] if len(values) == len(channels) else ""
            error = errors[place] if place < len(errors) else None
            yield key, entry["candidate"], name, channel, each, error, value["unit"], value["at_bound"]


def _listed(value) -> list:
    return value if isinstance(value, list) else [value]


def described_row(document: dict) -> tuple[dict[str, Any], np.ndarray]:
    """A row of `fit` for an answer, and how it looks: (directions, colours) [L*], float32.

    Raises InputError, KeyError where the document is damaged.
    """
    best = next(each for each in document["ranking"] if each["candidate"] == document["recommended"])
    small = _recommended_alone(document, best)
    surface = saved.surface_in(json.dumps(small).encode(), "answer")
    shown = look_vector(surface)
    albedo = _albedo(best, surface)
    kind, stored, nan = document.get("kind") or {}, document.get("stored") or {}, [None] * 3
    glosses = [_finite(np.mean(gloss.units(surface.brdf, angle, quick=True))) for angle in gloss.ANGLES]
    row = {
        "sha256": (stored.get("data") or {}).get("sha256"),
        "fingerprint": stored.get("fingerprint"),
        "recommended": best["candidate"],
        "tied": sum(bool(each["tied"]) for each in document["ranking"]),
        "kind": kind.get("verdict"),
        "rms_ln": best["rms_ln"],
        "held_out": best["held_out_rms_ln"],
        "behind": best["behind"],
        "seen": best["seen"],
        "flags": ",".join(each["code"] for each in best["flags"]),
        "no_answer": document.get("no_answer"),
        "samples": document["data"]["samples"],
        "f0": _f0(best),
        "albedo": None if albedo is None else float(np.mean(albedo)),
        "alpha_equivalent": _alpha(best, surface),
        "doubt": _doubt(surface, best, shown),
        "turns": int(turns(surface)),
        "surface": json.dumps(small),
    }
    row |= dict(zip(("albedo_r", "albedo_g", "albedo_b"), nan if albedo is None else albedo, strict=True))
    return row | {f"gloss{angle}": units for angle, units in zip(gloss.ANGLES, glosses, strict=True)}, shown


def _recommended_alone(document: dict, best: dict) -> dict:
    """A fit's JSON that `export`, `evaluate` and `preview` take, with one row."""
    data = {name: document["data"][name] for name in ("channels", "wavelength_nm", "solid_angle_sr")}
    known = {name: {"value": value["value"]} for name, value in best["parameters"].items()}
    row = {name: best[name] for name in ("model", "candidate", "freed")} | {"parameters": known}
    return {"schema": "brdfguide/fit/1", "data": data, "ranking": [row], "recommended": best["candidate"]}


def look_vector(surface: Surface) -> np.ndarray:
    """How a surface looks at the directions of LOOKS: (directions, colours) [L*], float32."""
    return lightness_shown(surface, Instrument(seen.sphere(LOOKS).geom)).astype(np.float32)


def _doubt(surface: Surface, best: dict, shown: np.ndarray) -> float | None:
    """How far the surface's look moves with one standard error of each parameter, taken as independent [L*]."""
    weights, squares = seen.sphere(LOOKS).weights, 0.0
    for name, value in best["parameters"].items():
        if value["stderr"] is None or name not in surface.model.parameters:
            continue
        parameter = surface.model.parameters[name]
        errors = np.array([each or 0.0 for each in _listed(value["stderr"])], float)
        low, high = parameter.outside(parameter.least), parameter.outside(parameter.high)
        moved = parameter.inside(np.clip(np.array(_listed(value["value"]), float) + errors, low, high))
        changed = surface.with_value(name, moved if np.size(moved) > 1 else float(np.ravel(moved)[0]))
        squares += seen.apart(look_vector(changed), shown, weights) ** 2
    return _finite(np.sqrt(squares))


def _albedo(best: dict, surface: Surface) -> list[float] | None:
    """The body's, as red, green and blue."""
    found = [value["value"] for name, value in best["parameters"].items() if name.rpartition(".")[2] == "albedo"]
    if not found:
        return None
    each = np.broadcast_to(np.array(_listed(found[0]), float), (len(surface.channels),))
    mixed = each @ seen.colours(surface.channels, surface.wavelengths)
    return [float(value) for value in np.broadcast_to(mixed, (3,))]


def _f0(best: dict) -> float | None:
    """Reflectance of the lobe's surface at normal incidence, the mean over channels."""
    values = {name.rpartition(".")[2].lower(): value["value"] for name, value in best["parameters"].items()}
    if "f0" in values:
        return _finite(np.mean(_listed(values["f0"])))
    if "n" not in values:
        return None
    n, k = (np.array(_listed(values.get(name, 0.0)), float) for name in "nk")
    return _finite(np.mean(fresnel.f0(n, k)))


def _alpha(best: dict, surface: Surface) -> float | None:
    """exp(-tan²θh/α²) has its half at tan θh = α √ln 2, and θr moves by 2 θh on either side."""
    own = [value["value"] for name, value in best["parameters"].items() if name.rpartition(".")[2] == "alpha"]
    if len(own) == 1:
        return _finite(np.mean(own[0]))
    width = lobe_width_deg(surface)
    return None if width is None else float(np.tan(np.radians(width / 4)) / np.sqrt(np.log(2)))


def _finite(value) -> float | None:
    return float(value) if np.isfinite(value) else None


FLAT = ["file", "key", *(name for name in COLUMNS if name != "surface")]


def flat_rows(base: sqlite3.Connection) -> list[tuple]:
    """A row for each file that has an answer, in the order of their names; the columns are FLAT."""
    columns = ", ".join(f"fit.{name}" for name in FLAT[2:])
    return base.execute(f"SELECT file, name.key, {columns} FROM name JOIN fit USING (key) ORDER BY file").fetchall()


def answered_names(base: sqlite3.Connection) -> set[str]:
    """Every file that has an answer."""
    return {file for (file,) in base.execute("SELECT file FROM name JOIN fit USING (key)")}
