"""Excel workbook `.xlsx`: a sheet read as a table of text is, with its rows as lines.

Of several sheets with a table one is chosen with `--select sheet=NAME`. Needs openpyxl.
"""

import io
from dataclasses import replace

from ...errors import InputError
from ..measurement import Measurement
from . import _groups, _meaning
from ._cells import is_number
from ._stated import sheet_of
from ._tables import as_text, library
from .format import OF_TABLES, TEXT_LIMIT, Format, Options, Source

SHEET = "sheet"  # what --select calls the choice of a sheet
MOST_SWELLING = 200
LOOKED_AT = 60  # rows in which a sheet with a table has one of at least two numbers


def recognises(head: bytes) -> bool:
    return head[:4] == b"PK\x03\x04" and (b"xl/" in head or b"[Content_Types].xml" in head[:200])


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a damaged workbook, for several sheets of which none is chosen, and as tables do."""
    text, rest = _sheet(source, options.select)
    return _meaning.measurement_of(text, sheet_of(text, options), replace(options, select=rest), kind="Excel workbook")


def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
    """The values of a column, in the order in which they come. Raises InputError where they are no groups."""
    text, rest = _sheet(source, options.select)
    table, _ = _groups.selected(text, sheet_of(text, options), rest)
    return _groups.values_of_group(text, table, column)


def _sheet(source: Source, select) -> tuple[Source, tuple]:
    """The chosen sheet, or the only one with a table, as text; and the conditions that are about its rows."""
    wanted = [value for column, value in select if column.lower() == SHEET]
    rest = tuple(pair for pair in select if pair[0].lower() != SHEET)
    openpyxl = library("openpyxl", "excel", source, "an Excel workbook")
    _check_size(source)
    try:
        book = openpyxl.load_workbook(io.BytesIO(bytes(source.data)), read_only=True, data_only=True)
        sheets = {sheet.title: [list(row) for row in sheet.iter_rows(values_only=True)] for sheet in book.worksheets}
    except InputError:
        raise
    except Exception as error:  # of a damaged workbook openpyxl lets through whatever its parts raise
        raise source.error(f"a damaged Excel workbook: {type(error).__name__}: {str(error)[:80]}") from None
    tables = {name: rows for name, rows in sheets.items() if _holds_numbers(rows)}
    if wanted:
        if wanted[-1] not in sheets:
            raise source.error(f"no sheet called '{wanted[-1][:40]}'; there are: {', '.join(sheets)[:120]}")
        return as_text(source, sheets[wanted[-1]]), rest
    if not tables:
        raise source.error(f"none of its sheets ({', '.join(sheets)[:80]}) holds a table of numbers")
    if len(tables) > 1:
        names = ", ".join(tables)[:120]
        raise source.error(
            f"{len(tables)} sheets hold tables ({names}): choose one with --select sheet={next(iter(tables))}"
        )
    return as_text(source, next(iter(tables.values()))), rest


def _check_size(source: Source) -> None:
    """Raises InputError for an archive that is damaged, or unpacks to more than a workbook can honestly hold."""
    import zipfile

    try:
        with zipfile.ZipFile(io.BytesIO(bytes(source.data))) as archive:
            whole = sum(part.file_size for part in archive.infolist())
    except (zipfile.BadZipFile, OSError, ValueError, EOFError, NotImplementedError, RuntimeError) as error:
        raise source.error(f"a damaged Excel workbook: {error}") from None
    if whole > min(TEXT_LIMIT, 2**20 + MOST_SWELLING * len(source.data)):
        raise source.error(f"unpacks to {whole / 1e6:.0f} MB, more than such a workbook can honestly hold")


def _holds_numbers(rows) -> bool:
    def count(row) -> int:
        return sum(isinstance(cell, (int, float)) or isinstance(cell, str) and is_number(cell) for cell in row)

    return any(count(row) > 1 for row in rows[:LOOKED_AT])


FORMAT = Format(
    "spreadsheet",
    (".xlsx",),
    recognises,
    read,
    own_side=False,
    groups=groups,
    options=OF_TABLES,
)
