"""Sheets whose cells come from a library, as numbers under names, for the reader of tables of text."""

import re
from contextlib import contextmanager
from importlib import import_module

import numpy as np

from ...errors import BrdfguideError, InputError
from ..columns.facts import facts
from ._sheet import Sheet
from .format import Source

# what zarr, numcodecs, HDF5 and Arrow say of a codec that they lack
NOT_INSTALLED = re.compile(
    r"unknown codec|codec not available|filter \S{1,80} .{0,160}is not registered|codec .{0,160} not built",
    re.IGNORECASE,
)


def library(name: str, extra: str, source: Source, what: str):
    """An optional package. Raises InputError that says how to have it, and what serves instead."""
    try:
        return import_module(name)
    except ImportError:
        text = f"reading {what} needs the package {name}: pip install 'brdfguide[{extra}]', or save it as CSV"
        raise InputError(f"{source.name}: {text}") from None


@contextmanager
def damage_told(source: Source, what: str):
    """A library's own errors about a file as a sentence."""
    try:
        yield
    except (BrdfguideError, MemoryError, Warning):
        raise
    except Exception as error:  # zlib.error, LZMAError, EOFError: each codec has its own
        text = " ".join(str(error).split())[:100]
        if NOT_INSTALLED.search(text):
            raise source.error(
                f"packed with a codec that is not installed: {text}; install it, or pack it with gzip"
            ) from None
        raise source.error(f"a damaged {what}: {text}") from None


def with_unit(source: Source, name: str, unit: str) -> str:
    """A column's name and the unit that an attribute of it gives. Raises InputError where the name says another."""
    if unit in ("", "1"):
        return name
    named, given = facts(name)[0].unit, facts(unit)[0].unit
    if named and given and named != given:
        raise source.error(
            f"the column '{name[:40]}' is in {named} by its name and in {given} by its attribute 'units' "
            f"('{unit[:40]}'); correct one of them"
        )
    return f"{name} ({unit})"


def sheet_of_columns(source: Source, names: list[str], columns, first: int, comments: tuple[str, ...] = ()) -> Sheet:
    """Columns as those of a table whose first row has this number: arrays of numbers, or lists of cells with None where
    there is none.

    Raises InputError for cells that hold further cells.
    """
    values, texts = np.full((len(columns[0]), len(columns)), np.nan), {}
    for place, cells in enumerate(columns):
        if isinstance(cells, np.ndarray) and cells.dtype.kind in "fiub":
            values[:, place] = cells
            continue
        if any(isinstance(cell, (dict, list, tuple, bytes)) for cell in cells):
            raise source.error(f"the column '{names[place][:40]}' holds no plain numbers or words")
        values[:, place] = [float(cell) if isinstance(cell, (int, float)) else np.nan for cell in cells]
        if any(cell is not None and not isinstance(cell, (int, float)) for cell in cells):
            texts[place] = ["" if cell is None else str(cell) for cell in cells]
            values[:, place] = [_number(cell) for cell in texts[place]]
    lines = np.arange(first, first + len(values))
    return Sheet(names, values, lines, list(comments), [], texts=texts)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")


def as_text(source: Source, rows) -> Source:
    """The rows as lines parted by tabs, so that the reader of tables counts and words as everywhere."""
    lines = ["\t".join(_cell(cell) for cell in row) for row in rows]
    return Source(source.name, "\n".join(lines).encode(), source.findings)


def _cell(value) -> str:
    if value is None:
        return ""
    if isinstance(value, float):
        return repr(value)
    return " ".join(str(value).replace('"', "'").split())
