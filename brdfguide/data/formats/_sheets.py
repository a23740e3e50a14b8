"""Files of several tables of cells, such as workbooks: the only one with numbers, or the one that is chosen, read as a
table of text is, with its rows as lines."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from ..measurement import Measurement
from . import _groups, _meaning
from ._cells import is_number
from ._stated import sheet_of
from ._tables import as_text
from ._written import reads, tidy
from .format import OF_TABLES, TEXT_LIMIT, Format, Options, Source

PASTED = 2**24  # bytes of pages and papers that are believed: what is made of them takes fifty times as much
MOST_CELLS = 1_000_000
MOST_SWELLING = 200  # times what is packed, beyond the first MB
LOOKED_AT = 60  # rows in which a table has one of at least two numbers
Rows = list[list]
Tables = Callable[[Source], Mapping[str, Rows]]  # rows of cells by the table's name


def check_swelling(source: Source, size: int, most: int, kind: str) -> None:
    """Raises InputError for a file that unpacks to more bytes than `most`, or than its kind can honestly hold."""
    if size > min(most, 2**20 + MOST_SWELLING * len(source.data)):
        raise source.error(f"unpacks to {size / 1e6:.0f} MB, more than such a {kind} can honestly hold")


def format_of_sheets(
    name: str,
    suffixes: tuple[str, ...],
    recognises: Callable[[bytes], bool],
    tables: Tables,
    *,
    word: str,
    kind: str,
    limit: int = TEXT_LIMIT,
) -> Format:
    """The format of a kind of file whose tables a function gives by name. It raises InputError for a damaged file, for
    one without a table or with several of which none is chosen by `--select word=NAME`, and as tables of text do."""

    def read(source: Source, options: Options) -> Measurement:
        text, rest = _chosen(source, tables(source), options.select, word)
        return _meaning.measurement_of(text, sheet_of(text, options), replace(options, select=rest), kind=kind)

    def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
        text, rest = _chosen(source, tables(source), options.select, word)
        table, _ = _groups.selected(text, sheet_of(text, options), rest)
        return _groups.values_of_group(text, table, column)

    return Format(name, suffixes, recognises, read, limit, own_side=False, groups=groups, options=OF_TABLES)


def check_cells(source: Source, count: int) -> None:
    """Raises InputError for more cells than such a file can honestly hold, such as those that one cell stands for."""
    if count > MOST_CELLS:
        raise source.error(f"its tables have more than {MOST_CELLS} cells, more than such a file can honestly hold")


def _chosen(source: Source, every: Mapping[str, Rows], select, word: str) -> tuple[Source, tuple]:
    """The chosen table, or the only one with numbers, as text; and the conditions that are about its rows."""
    wanted = [value for column, value in select if column.lower() == word]
    rest = tuple(pair for pair in select if pair[0].lower() != word)
    tables = {name: rows for name, rows in every.items() if _holds_numbers(rows)}
    if wanted:
        if wanted[-1] not in every:
            raise source.error(f"no {word} called '{wanted[-1][:40]}'; there are: {', '.join(every)[:120]}")
        return as_text(source, every[wanted[-1]]), rest
    if not tables:
        raise source.error(f"none of its {word}s ({', '.join(every)[:80]}) holds a table of numbers")
    if len(tables) > 1:
        names = ", ".join(tables)[:120]
        raise source.error(
            f"{len(tables)} {word}s hold tables ({names}): choose one with --select {word}={next(iter(tables))}"
        )
    return as_text(source, next(iter(tables.values()))), rest


def _holds_numbers(rows: Rows) -> bool:
    def count(row: Iterable) -> int:
        return sum(isinstance(cell, (int, float)) or isinstance(cell, str) and _is_one(cell) for cell in row)

    return any(count(row) > 1 for row in [row for row in rows if row][:LOOKED_AT])


def _is_one(cell: str) -> bool:
    return is_number(cell) or reads(tidy(cell))
