"""A flat table as CSV, JSON lines or Parquet, by the file's suffix."""

import json
from pathlib import Path
from typing import Any

from ..errors import InputError
from ..files import write_whole
from ..printable import cell

NEEDS_PYARROW = "a .parquet needs pyarrow: pip install 'brdfguide[parquet]'"


def write_table(rows: list[tuple], names: list[str], path: Path) -> None:
    """Writes it whole or not at all. Raises InputError where it cannot be written, or its library is not there."""
    write_whole(path, _MAKERS[path.suffix.lower()](rows, names))


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


_MAKERS: dict[str, Any] = {".csv": _csv, ".jsonl": _json_lines, ".parquet": _parquet}
