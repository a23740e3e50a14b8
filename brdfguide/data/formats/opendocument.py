"""OpenDocument sheet `.ods`, as LibreOffice writes it: read as a table of text is, with its rows as lines.

Of several sheets with a table one is chosen with `--select sheet=NAME`.

Source: OASIS, Open Document Format for Office Applications 1.3, part 3, sections 9.1 and 19.385.
"""

import io
import re
import zlib

from ...errors import InputError
from . import _sheets
from .format import Source

KIND = re.compile(rb"PK\x03\x04.{26}mimetypeapplication/vnd\.oasis\.opendocument\.spreadsheet", re.DOTALL)
CONTENT = "content.xml"
MOST_REPEATED = 1000  # cells or rows that one stands for, and that hold something
PIECE = 2**16


def recognises(head: bytes) -> bool:
    return KIND.match(head) is not None


def _tables(source: Source) -> dict[str, _sheets.Rows]:
    """The rows of every sheet. Raises InputError for a damaged document, and for one that is locked or swells."""
    import zipfile
    from xml.etree import ElementTree

    try:
        with zipfile.ZipFile(io.BytesIO(bytes(source.data))) as archive:
            _sheets.check_swelling(source, archive.getinfo(CONTENT).file_size, 4 * _sheets.PASTED, "sheet")
            with archive.open(CONTENT) as stream:
                return _read(source, ElementTree.XMLPullParser(["start", "end"]), stream)
    except InputError:
        raise
    except (zipfile.BadZipFile, zlib.error, ElementTree.ParseError, OSError, ValueError, EOFError) as error:
        raise source.error(f"a damaged OpenDocument sheet: {error}") from None
    except (KeyError, NotImplementedError, RuntimeError):  # no such part, or one that is locked
        text = f"an OpenDocument sheet without a {CONTENT} that can be read; save it without a password"
        raise source.error(text) from None


def _read(source: Source, parser, stream) -> dict[str, _sheets.Rows]:
    sheets: dict[str, _sheets.Rows] = {}
    rows: _sheets.Rows = []
    cells: list = []
    count = 0
    while piece := stream.read(PIECE):
        if b"<!DOCTYPE" in piece or b"<!ENTITY" in piece:
            raise source.error("XML with a document type of its own is not read")
        parser.feed(piece)
        for event, element in parser.read_events():
            what = (event, element.tag.rpartition("}")[2])
            if what == ("start", "table"):
                rows = sheets.setdefault(_said(element, "name") or str(len(sheets) + 1), [])
            elif what == ("start", "table-row"):
                cells = []
            elif what in (("end", "table-cell"), ("end", "covered-table-cell")):
                value = _value(element)
                cells += [value] * _times(element, "number-columns-repeated", value == "")
            elif what == ("end", "table-row"):
                empty = not any(cell != "" for cell in cells)
                times = _times(element, "number-rows-repeated", empty)
                rows += [[] if empty else cells] * times
                count += 0 if empty else times * len(cells)
                _sheets.check_cells(source, max(count, len(cells)))
                element.clear()
    return sheets


def _said(element, name: str) -> str:
    """An attribute, whatever its namespace."""
    return next((value for key, value in element.attrib.items() if key.rpartition("}")[2] == name), "")


def _times(element, name: str, empty: bool) -> int:
    """How often a cell or a row stands there; one that is empty reaches to the end of the sheet."""
    said = _said(element, name)
    times = int(said) if said.isdecimal() and len(said) < 8 else 1
    return min(times, MOST_REPEATED if not empty else 100)


def _value(element):
    """A number, or the words of a cell."""
    kind, number = _said(element, "value-type"), _said(element, "value")
    if kind in ("float", "percentage", "currency") and number:
        return float(number)
    paragraphs = [each for each in element.iter() if each.tag.rpartition("}")[2] == "p"]
    return " ".join(" ".join("".join(each.itertext()).split()) for each in paragraphs)


FORMAT = _sheets.format_of_sheets(
    "opendocument", (".ods",), recognises, _tables, word="sheet", kind="OpenDocument sheet"
)
