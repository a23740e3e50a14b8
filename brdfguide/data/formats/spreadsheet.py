"""Excel workbook `.xlsx`: a sheet read as a table of text is, with its rows as lines.

Of several sheets with a table one is chosen with `--select sheet=NAME`. Needs openpyxl.
"""

import io

from ...errors import InputError
from . import _sheets
from ._tables import library
from .format import TEXT_LIMIT, Source


def recognises(head: bytes) -> bool:
    return head[:4] == b"PK\x03\x04" and (b"xl/" in head or b"[Content_Types].xml" in head[:200])


def _tables(source: Source) -> dict[str, _sheets.Rows]:
    """The rows of every sheet. Raises InputError for a damaged workbook."""
    openpyxl = library("openpyxl", "excel", source, "an Excel workbook")
    _check_size(source)
    try:
        book = openpyxl.load_workbook(io.BytesIO(bytes(source.data)), read_only=True, data_only=True)
        return {sheet.title: [list(row) for row in sheet.iter_rows(values_only=True)] for sheet in book.worksheets}
    except InputError:
        raise
    except Exception as error:  # of a damaged workbook openpyxl lets through whatever its parts raise
        raise source.error(f"a damaged Excel workbook: {type(error).__name__}: {str(error)[:80]}") from None


def _check_size(source: Source) -> None:
    """Raises InputError for an archive that is damaged, or unpacks to more than a workbook can honestly hold."""
    import zipfile

    try:
        with zipfile.ZipFile(io.BytesIO(bytes(source.data))) as archive:
            whole = sum(part.file_size for part in archive.infolist())
    except (zipfile.BadZipFile, OSError, ValueError, EOFError, NotImplementedError, RuntimeError) as error:
        raise source.error(f"a damaged Excel workbook: {error}") from None
    _sheets.check_swelling(source, whole, TEXT_LIMIT, "workbook")


FORMAT = _sheets.format_of_sheets("spreadsheet", (".xlsx",), recognises, _tables, word="sheet", kind="Excel workbook")
