"""A flat table as CSV, JSON lines or Parquet, by the file's suffix."""

import csv
import json
from io import BytesIO
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import taken, write_whole
from ..printable import cell

NEEDS_PYARROW = "a .parquet needs pyarrow: pip install 'brdfguide[parquet]'"


def write_table(rows: list[tuple], names: list[str], path: Path) -> None:
    """Writes it whole or not at all. Raises InputError where it cannot be written, or its library is not there."""
    write_whole(path, _MAKERS[path.suffix.lower()](rows, names))


def check_replaced(rows: list[tuple], folder: Path, path: Path) -> None:
    """Raises InputError where a file is there that is no table of answers, or one of other answers: neither a key of
    its rows nor all of its names are among those of `rows`, which begin with name and key."""
    if not taken(path) or not path.stat().st_size:
        return
    try:
        old = _READERS[path.suffix.lower()](path.read_bytes())
        pairs = [(each["file"], each["key"]) for each in old]
    except (KeyError, TypeError, ValueError, csv.Error):
        raise InputError(f"{path}: it is there, and no table of answers; collect into another file") from None
    names, keys = {row[0] for row in rows}, {row[1] for row in rows}
    if not any(key in keys for _, key in pairs) and not all(name in names for name, _ in pairs):
        raise InputError(
            f"{path}: it holds the answers of another folder, which those of {folder} would replace; collect into "
            f"another file"
        )


def _csv(rows: list[tuple], names: list[str]) -> str:
    lines = [",".join(_cell(each) for each in row) for row in (tuple(names), *rows)]
    return "\n".join(lines) + "\n"


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, str):
        return cell(value)
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _json_lines(rows: list[tuple], names: list[str]) -> str:
    return "".join(json.dumps(dict(zip(names, row, strict=True)), allow_nan=False) + "\n" for row in rows)


def _parquet(rows: list[tuple], names: list[str]) -> bytes:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise InputError(NEEDS_PYARROW) from None
    columns = {name: [row[place] for row in rows] for place, name in enumerate(names)}
    stream = pyarrow.BufferOutputStream()
    parquet.write_table(pyarrow.table(columns), stream)
    return stream.getvalue().to_pybytes()


def _of_csv(data: bytes) -> list[dict]:
    lines = data.decode().splitlines()
    if not lines or not lines[0].startswith("file,key,"):
        raise ValueError
    return list(csv.DictReader(lines))


def _of_json_lines(data: bytes) -> list[dict]:
    return [json.loads(line) for line in data.splitlines()]


def _of_parquet(data: bytes) -> list[dict]:
    try:
        from pyarrow import parquet
    except ImportError:
        raise InputError(NEEDS_PYARROW) from None
    return parquet.read_table(BytesIO(data), columns=["file", "key"]).to_pylist()


_READERS: dict[str, Any] = {".csv": _of_csv, ".jsonl": _of_json_lines, ".parquet": _of_parquet}
_MAKERS: dict[str, Any] = {".csv": _csv, ".jsonl": _json_lines, ".parquet": _parquet}
