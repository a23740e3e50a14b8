"""The cells of a line of a table, and the numbers in them, however they are written."""

import re

import numpy as np

from .format import Source, holds_number

MISSING = {
    "",
    "nan",
    "na",
    "n/a",
    "none",
    "null",
    "-",
    "--",
    "---",
    "nd",
    "n.d.",
    "*",
    "#n/a",
    "#value!",
    "#div/0!",
    "#num!",
    "#ref!",
    "#name?",
    "n.a.",
    "<na>",
    ".",
    "missing",
    "?",
    "...",
    "1.#qnan",
    "1.#ind",
    "-1.#ind",
    "nan(ind)",
    "-nan(ind)",
}
MINUS = re.compile(r"[\u2212\u2010-\u2015\ufe63\uff0d](?=[\d.,])")  # signs that word processors make of a hyphen
DEGREES = re.compile(r"(?<=\d) ?[°º]")  # behind the numbers of a row
THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}")  # or a decimal comma before three digits


def plain_row(text: str) -> str:
    """A line that begins as a row does, with hyphens for the minus signs of word processors, and no degree signs."""
    return DEGREES.sub("", MINUS.sub("-", text))


def cells_of(text: str, delimiter: str | None) -> list[str]:
    """The cells of a line, without blanks around them and quotes; None stands for any white space."""
    if '"' in text:
        return _quoted(text.strip(), delimiter)
    return text.split() if delimiter is None else [cell.strip() for cell in text.strip("\n").split(delimiter)]


def _quoted(text: str, delimiter: str | None) -> list[str]:
    """Cells of which some stand in quotes and may hold the delimiter; a doubled quote is one."""
    cells, cell, pieces = [], "", text.split('"')
    for place, piece in enumerate(pieces):
        if place % 2:
            cell += piece
        elif place and place + 1 < len(pieces) and not piece:
            cell += '"'
        else:
            first, *rest = _outside(piece, delimiter)
            cell += first
            for each in rest:
                cells.append(cell.strip())
                cell = each
    return [*cells, cell.strip()]


def _outside(piece: str, delimiter: str | None) -> list[str]:
    """What stands between two quoted cells, parted by the delimiter."""
    if delimiter is not None:
        return piece.split(delimiter)
    inner = " ".join(piece.split())
    return f"{' ' * piece[:1].isspace()}{inner}{' ' * (bool(inner) and piece[-1:].isspace())}".split(" ")


def is_number(cell: str) -> bool:
    return holds_number(cell) or (cell.lower() in MISSING and cell != "")


def dotted(cell: str, decimal: str) -> str:
    return cell.replace(",", ".", 1) if decimal == "," and cell.count(",") == 1 and "." not in cell else cell


def check_thousands(source: Source, rows, lines: list[int]) -> None:
    """Raises InputError where every comma may as well part thousands."""
    found = [(cell, line) for cells, line in zip(rows, lines, strict=True) for cell in cells if "," in cell]
    if found and all(THOUSANDS.fullmatch(cell) for cell, _ in found):
        cell, line = found[0]
        raise source.error(
            f"found '{cell}': a decimal comma, or one that parts thousands? Every number with one has three digits "
            f"behind it; write decimal points, and no commas in thousands",
            line,
        )


def column_of(cells: list[str]) -> tuple[list[float], bool]:
    """The cells as numbers, NaN where they hold none, and whether some hold something else."""
    values, bad = [], False
    for cell in cells:
        try:
            values.append(float(cell))
        except ValueError:
            values.append(np.nan)
            bad = bad or cell.lower() not in MISSING
    return values, bad
