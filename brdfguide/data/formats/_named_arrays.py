"""Tables in a file of named arrays: the 1-D arrays of a group as its columns, or a 2-D one whose columns it names.

What HDF5 and zarr have in common: groups with arrays in them, and attributes of both. Attributes of a group are read
as a text table's comments are, `units` of an array as the unit in its name; `_FillValue`, `scale_factor` and
`add_offset` as the CF conventions have them.

Source: Eaton and others, NetCDF Climate and Forecast (CF) Metadata Conventions 1.11, sections 2.5.1, 3.1 and 8.1.
"""

import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np

from ...errors import NothingLeft
from ...finding import Finding
from ...records import dataclass
from ..measurement import Measurement
from . import _groups, _meaning
from ._sheet import Sheet
from ._stated import with_stated
from ._tables import damage_told, sheet_of_columns, with_unit
from .format import OF_TABLES, Format, Options, Source

MOST_CELLS = 50_000_000  # read at once
LARGEST_CELLS = 8_000_000  # beyond, a fit reads it in pieces
TOGETHER = 65_536  # rows of a piece
MOST_SWELLING = 1000  # of what the file keeps of a table: what repeating numbers shrink to
DEEPEST = 8  # groups within groups
MOST_ARRAYS = 10_000
MOST_NOTES = 100  # attributes of one group
PACKED = (("scale_factor", 1), ("add_offset", 0))  # attributes, and what they are where there are none
GROUP = "group"  # what --select calls the choice of one of several tables
NAMING = ("columns", "column_names")  # attributes that name the columns of a 2-D array, or the order of a group's
WANTED = (
    "wanted a group of 1-D arrays of one length that are named as the columns of a CSV are, or a 2-D array with an "
    "attribute 'columns' that names its columns"
)


@dataclass(frozen=True, eq=False)
class ArrayTable:
    """One table of a file: its columns' names, and how rows of them are had."""

    kind: str  # of file
    place: str
    names: list[str]
    columns: Callable[[slice], list]  # arrays of numbers, or lists of cells
    shape: tuple[int, int]
    chunk: int  # rows that the file keeps together
    comments: tuple[str, ...]
    arrays: tuple[Any, ...]

    def sheet(self, source: Source, rows: slice) -> Sheet:
        """Some of its rows. Raises InputError where they are damaged, or hold neither numbers nor words."""
        with damage_told(source, self.kind):
            columns = self.columns(rows)
        return with_stated(source, sheet_of_columns(source, self.names, columns, rows.start + 1, self.comments))

    def pieces(self) -> Iterator[slice]:
        """Rows that are read together: whole chunks of the file where they are not too large."""
        step = max(TOGETHER // self.chunk, 1) * self.chunk
        if step * self.shape[1] > LARGEST_CELLS:
            step = TOGETHER
        for start in range(0, self.shape[0], step):
            yield slice(start, min(start + step, self.shape[0]))


def format_of(
    name: str,
    suffixes: tuple[str, ...],
    recognises: Callable[[bytes], bool],
    tables: Callable[[Source], list[ArrayTable]],
) -> Format:
    """The format of a kind of file whose tables a function finds. It raises InputError for a damaged file, for one
    without a table or with several, and as tables of text do."""

    def read(source: Source, options: Options) -> Measurement:
        return read_table(source, tables(source), options)

    def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
        return groups_of(source, tables(source), options, column)

    def parts(source: Source, options: Options) -> Iterator[Measurement]:
        return parts_of(source, tables(source), options)

    def is_large(source: Source) -> bool:
        return any(rows * columns > LARGEST_CELLS for rows, columns in (table.shape for table in tables(source)))

    return Format(
        name,
        suffixes,
        recognises,
        read,
        own_side=False,
        groups=groups,
        options=OF_TABLES,
        parts=parts,
        is_large=is_large,
        in_place=True,
    )


def read_table(source: Source, tables: list[ArrayTable], options: Options) -> Measurement:
    """Raises InputError where there is no table or none chosen of several, and as tables of text do."""
    table, rest = chosen(source, tables, options)
    return _meaning.measurement_of(source, _whole(source, table), rest, kind=table.kind).noting(*_absent(source, table))


def groups_of(source: Source, tables: list[ArrayTable], options: Options, column: str) -> tuple[str, ...]:
    """The values of a column, in the order in which they come. Raises InputError where they are no groups."""
    table, rest = chosen(source, tables, options)
    sheet, _ = _groups.selected(source, _whole(source, table), rest.select)
    return _groups.values_of_group(source, sheet, column)


def parts_of(source: Source, tables: list[ArrayTable], options: Options) -> Iterator[Measurement]:
    """The same as `read_table` gives, in pieces. Raises InputError as it does."""
    table, rest = chosen(source, tables, options)
    notes = _absent(source, table)
    for rows in table.pieces():
        try:
            yield _meaning.measurement_of(source, table.sheet(source, rows), rest, kind=table.kind).noting(*notes)
        except NothingLeft:
            continue


def _absent(source: Source, table: ArrayTable) -> tuple[Finding, ...]:
    """The note on chunks of zarr arrays that are not there, of which some are: written as nothing, or lost."""
    counts = []
    with damage_told(source, table.kind):
        for each in table.arrays:
            there, of = getattr(each, "nchunks_initialized", 0), getattr(each, "nchunks", 0)
            if 0 < there < of:
                counts.append((of - there, of, each.path.rpartition("/")[2], each.fill_value))
    if not counts:
        return ()
    told = ", ".join(f"{absent} of {of} of '{name[:40]}'" for absent, of, name, _ in counts[:5])
    fill = ", ".join(sorted({str(fill) for *_, fill in counts}))[:40]
    text = f"chunks that are not there were read as the fill value {fill}: {told}; they were never written, or are lost"
    return (Finding("absent-chunks", text, "warning", numbers=(("chunks", sum(each[0] for each in counts)),)),)


def _whole(source: Source, table: ArrayTable) -> Sheet:
    rows, columns = table.shape
    if rows * columns > MOST_CELLS:
        raise source.error(f"{rows} rows of {columns} columns are more than is read at once")
    return table.sheet(source, slice(0, rows))


def chosen(source: Source, tables: list[ArrayTable], options: Options) -> tuple[ArrayTable, Options]:
    """The table that is meant, and the options that are about its rows. Raises InputError for several of which none is
    chosen."""
    places = {table.place.strip("/"): table for table in tables}
    wanted = [value.strip("/") for column, value in options.select if column.lower() == GROUP]
    if len(tables) > 1:
        names = ", ".join(table.place for table in tables)[:120]
        if not wanted:
            raise source.error(f"{len(tables)} tables ({names}): choose one with --select {GROUP}={tables[0].place}")
        if wanted[-1] not in places:
            raise source.error(f"no table called '{wanted[-1][:40]}'; there are: {names}")
        rest = tuple(pair for pair in options.select if pair[0].lower() != GROUP)
        return places[wanted[-1]], replace(options, select=rest)
    return tables[0], options


def tables_in(
    source: Source, kind: str, root, members: Callable[[Any], Mapping[str, Any]], stored: Callable[[Any], int]
) -> list[ArrayTable]:
    """Every table of a file, in the order of their places. Raises InputError where there is none, or a damaged one.

    Takes  members (group) -> what is in it by name; stored (array) -> bytes of the file that it takes.
    """
    found: list[ArrayTable] = []
    seen: list[str] = []
    with damage_told(source, kind):
        _look(source, kind, root, "/", members, found, seen)
    if not found:
        there = ", ".join(seen)[:160] or "nothing"
        raise source.error(f"found {there}; {WANTED}")
    for table in found:
        with damage_told(source, kind):
            size = sum(map(stored, table.arrays))
        if np.prod(table.shape, dtype=float) * 8 > 2**20 + MOST_SWELLING * size:
            raise source.error(
                f"{table.place} promises {table.shape[0]} rows of {table.shape[1]} columns in {size} bytes, more "
                f"than such a file can honestly hold"
            )
    return found


def _look(source: Source, kind: str, node, place: str, members, found: list[ArrayTable], seen: list[str]) -> None:
    """Collects the tables of a group and of the groups in it, and what else there is."""
    if hasattr(node, "shape"):
        arrays, groups = {place.rpartition("/")[2]: node}, {}
    else:
        inside = members(node)
        arrays = {name: each for name, each in inside.items() if hasattr(each, "shape")}
        groups = {name: each for name, each in inside.items() if not hasattr(each, "shape")}
    seen += [f"{place.rstrip('/')}/{name} {tuple(each.shape or ())}" for name, each in arrays.items()]
    seen += [f"{place.rstrip('/')}/{name}/" for name in groups]
    if len(seen) > MOST_ARRAYS:
        raise source.error(f"more than {MOST_ARRAYS} arrays and groups in it; {WANTED}")
    arrays = {name: each for name, each in arrays.items() if each.shape}
    columns = {name: each for name, each in arrays.items() if len(each.shape) == 1}
    if len(columns) > 1:
        found.append(_of_columns(source, kind, node, place, columns))
    for name, each in arrays.items():
        if len(each.shape) == 2 and (names := _names_in(each) or ([] if columns else _names_in(node))):
            found.append(_of_rows(source, kind, each, place if each is node else f"{place.rstrip('/')}/{name}", names))
    if place.count("/") > DEEPEST and groups:
        raise source.error(f"groups within groups, more than {DEEPEST} deep; {WANTED}")
    for name, each in groups.items():
        _look(source, kind, each, f"{place.rstrip('/')}/{name}", members, found, seen)


def _of_columns(source: Source, kind: str, group, place: str, columns: dict) -> ArrayTable:
    """The table whose columns are 1-D arrays. Raises InputError where they differ in length."""
    lengths = {name: int(each.shape[0]) for name, each in columns.items()}
    first = next(iter(lengths))
    for name, length in lengths.items():
        if length != lengths[first]:
            raise source.error(
                f"in {place} found {lengths[first]} values of '{first[:40]}' and {length} of '{name[:40]}'; wanted "
                f"columns of one length"
            )
    if not lengths[first]:
        raise source.error(f"in {place} there is no row")
    order = _names_in(group) or list(columns)
    if sorted(order) != sorted(columns):
        missing = sorted(set(order) ^ set(columns))[0]
        raise source.error(
            f"in {place} the attribute that names the columns does not go with its arrays: '{missing[:40]}'"
        )
    arrays = [columns[name] for name in order]
    names = [with_unit(source, name, _unit(each)) for name, each in zip(order, arrays, strict=True)]
    return ArrayTable(
        kind,
        place,
        names,
        lambda rows: [_cells(each, each[rows]) for each in arrays],
        (lengths[first], len(arrays)),
        max(_chunk(each) for each in arrays),
        _comments(group),
        tuple(arrays),
    )


def _of_rows(source: Source, kind: str, array, place: str, names: list[str]) -> ArrayTable:
    """The table that a 2-D array is. Raises InputError where the names are not as many as its columns."""
    rows, columns = map(int, array.shape)
    if len(names) != columns:
        raise source.error(f"{place} has {columns} columns, and its attribute names {len(names)}; wanted as many")
    if not rows:
        raise source.error(f"in {place} there is no row")
    return ArrayTable(
        kind,
        place,
        names,
        lambda picked: [_cells(array, column) for column in np.moveaxis(np.asarray(array[picked]), 1, 0)],
        (rows, columns),
        _chunk(array),
        _comments(array),
        (array,),
    )


def _chunk(array) -> int:
    return min(max(int((getattr(array, "chunks", None) or (1,))[0]), 1), int(array.shape[0]) or 1)


def sorted_names(names) -> list[str]:
    """Names that a file keeps in no order: R, G, B as such, numbers by their size."""

    def place(name: str):
        parts = re.split(r"(\d+)", name)
        return "RGB".find(name) if len(name) == 1 else -1, [int(part) if part.isdigit() else part for part in parts]

    return sorted(names, key=place)


def _names_in(node) -> list[str]:
    """The columns that an attribute names: a list of words, or one text of them with commas between."""
    for key in NAMING:
        if _text(value := node.attrs.get(key)):
            words = list(value) if np.ndim(value) else _text(value).split(",")
            return [_text(word).strip() for word in words]
    return []


def _text(value) -> str:
    """A word or a number as text, nothing as none."""
    if value is None or getattr(value, "shape", ()) is None:
        return ""
    return value.decode("utf-8", "replace") if isinstance(value, bytes) else str(value)


def _unit(array) -> str:
    return _text(array.attrs.get("units", "")).strip()


def _comments(node) -> tuple[str, ...]:
    """Attributes that are one word or number, as `name: value`."""
    found = []
    for name in [each for each in node.attrs if isinstance(each, str)][:MOST_NOTES]:
        value = node.attrs[name]
        if not name.startswith("_") and name not in NAMING and not np.ndim(value) and np.size(value) == 1:
            found += [f"{name}: {line}" for line in _text(value)[:1000].splitlines()]
    return tuple(found)


def _cells(array, values) -> Any:
    """A column's numbers, or its cells where they are words or something else."""
    if np.ndim(values) == 1 and np.asarray(values).dtype.kind in "fiub":
        return _numbers(array, values)
    return [_text(each) if isinstance(each, (bytes, str)) else each for each in np.asarray(values).tolist()]


def _numbers(array, values) -> np.ndarray:
    """As the attributes say: missing where it is the mark for that, and unpacked."""
    values = np.asarray(values)
    numbers = values.astype(float)
    marks = [array.attrs.get(key, []) for key in ("_FillValue", "missing_value")]
    # zarr has its own in place of _FillValue, 0 where none was set
    marks.append(getattr(array, "fill_value", None) or [])
    for mark in np.concatenate([np.ravel(each) for each in marks]):
        numbers[values == mark] = np.nan
    scale, offset = (_real(key, array.attrs.get(key, neutral)) for key, neutral in PACKED)
    return numbers if (scale, offset) == (1, 0) else numbers * scale + offset


def _real(key: str, value) -> float:
    """An attribute that is one number. Raises ValueError."""
    first = np.ravel(value)[:1].tolist()
    with suppress(TypeError, ValueError):
        if np.isfinite(found := float(*first)) and first:
            return found
    raise ValueError(f"found {key} {_text(value)[:40]!r}, wanted a finite number")
