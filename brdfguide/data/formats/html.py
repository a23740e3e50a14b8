"""Table of a web page, `<table>` with its `<tr>` and `<td>`: read as a table of text is, with its rows as lines.

Excel's `.xls` is often such a page. Of several tables with numbers one is chosen with `--select table=2`.
"""

import re
from collections.abc import Iterator

from . import _sheets
from .format import Source

PIECE = re.compile(r"<!--.*?(?:-->|\Z)|<(/?)([A-Za-z][A-Za-z0-9]{0,20})([^<>]{0,2000})>|[^<]+|<", re.DOTALL)
SPAN = re.compile(r"\b(col|row)span\s{0,5}=\s{0,5}[\"']?(\d{1,4})", re.IGNORECASE)
SILENT = ("script", "style")
MEANT = {"sub": "_", "sup": "^", "br": " ", "p": " "}
MOST_SPANNED = 1000  # columns or rows of one cell
OF_A_TABLE = ("table", "tr", "td", "th", "caption")


def recognises(head: bytes) -> bool:
    return re.match(rb"\s*<", head) is not None and re.search(rb"<table[\s>]", head, re.IGNORECASE) is not None


def _tables(source: Source) -> dict[str, _sheets.Rows]:
    """The rows of every table, in the order in which the tables begin."""
    import html

    found: list[_sheets.Rows] = []
    opened: list[_sheets.Rows] = []  # tables within tables
    captions: dict[int, str] = {}
    for tag, attributes, text in _elements(source.text):
        words = " ".join(html.unescape(text).split())
        if tag == "table":
            found.append([])
            opened.append(found[-1])
        elif tag == "/table":
            opened = opened[:-1]
        elif tag == "caption" and found:
            captions[len(found) - 1] = words
        elif tag == "tr" and opened:
            opened[-1].append([])
        elif tag in ("td", "th") and opened:
            opened[-1] += [[]] if not opened[-1] else []
            opened[-1][-1].append((words, _spans(attributes)))
    tables = {str(place): _spread(source, rows) for place, rows in enumerate(found, 1)}
    for place, caption in captions.items():
        tables[str(place + 1)].append([f"# {caption}"])
    return tables


def _elements(text: str) -> Iterator[tuple[str, str, str]]:
    """Each part of a table, its attributes, and the words that follow until the next; the end of a table too."""
    begun, silent = ("", ""), ""
    words: list[str] = []
    for match in PIECE.finditer(text):
        end, tag, piece = match[1], (match[2] or "").lower(), match[0]
        if silent or tag in SILENT:
            silent = "" if end and tag == silent else silent or tag * (not end)
        elif tag in OF_A_TABLE and not (end and tag != "table"):
            yield *begun, "".join(words)
            begun, words = (end + tag, match[3]), []
        elif tag:
            words.append("" if end else MEANT.get(tag, ""))
        elif not piece.startswith("<!--"):
            words.append(piece)
    yield *begun, "".join(words)


def _spans(attributes: str) -> tuple[int, int]:
    """How many columns and rows a cell stands for."""
    said = {what.lower(): min(int(number), MOST_SPANNED) for what, number in SPAN.findall(attributes)}
    return max(said.get("col", 1), 1), max(said.get("row", 1), 1)


def _spread(source: Source, rows: list) -> _sheets.Rows:
    """The rows with a cell that spans several rows in each of them, and nothing in all but the first of its columns."""
    found: _sheets.Rows = []
    left: dict[int, tuple[str, int]] = {}  # column -> a cell from above, and for how many rows more
    count = 0
    for row in rows:
        cells: list[str] = []
        above, left = left, {}
        for words, (wide, high) in [*row, ("", (0, 1))]:
            while len(cells) in above:
                text, more = above[len(cells)]
                left |= {len(cells): (text, more - 1)} if more > 1 else {}
                cells.append(text)
            left |= {len(cells): (words, high - 1)} if high > 1 else {}
            cells += [words, *[""] * (wide - 1)] if wide else []
            _sheets.check_cells(source, count + len(cells))
        found.append(cells)
        count += len(cells)
    return found


FORMAT = _sheets.format_of_sheets(
    "html", (".html", ".htm"), recognises, _tables, word="table", kind="HTML table", limit=_sheets.PASTED
)
