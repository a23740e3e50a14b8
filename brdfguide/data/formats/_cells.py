"""The cells of a line of a table, and the numbers in them, however they are written."""

import re

import numpy as np

from ..columns.vocabulary import word_set
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
# words that instruments and people write for missing; in the names above the rows they mean other things
MARKS = word_set(
    "over overrange over-range ovr ovf ovl ovld ol overflow overload sat sat. saturated saturation under underrange "
    "underflow bad fail failed error err invalid nodata no_data masked x xx xxx blank empty void oor n.m. n/m lod <lod "
    "<loq <dl bdl lost"
) | {"over range", "no data", "out of range", "not measured", "below lod", "off scale"}
THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}")  # or a decimal comma before three digits


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


def is_missing(cell: str) -> bool:
    """Whether a cell below the names stands for none."""
    return cell.lower() in MISSING or is_mark(cell)


def is_mark(cell: str) -> bool:
    """Whether it is a word for missing, or the hashes of a spreadsheet's narrow column."""
    return cell.lower() in MARKS or len(cell) > 1 and not cell.strip("#")


def dotted(cell: str, decimal: str) -> str:
    return cell.replace(",", ".", 1) if decimal == "," and cell.count(",") == 1 and "." not in cell else cell


def parts_thousands(source: Source, rows, lines: list[int], pointed: bool) -> bool:
    """Whether commas of a table that seems to have decimal ones part thousands; `pointed`: whether it has points.

    Raises InputError where every comma may as well do so, and where a column has decimal commas beside points that may.
    """
    found = [(cell, line) for cells, line in zip(rows, lines, strict=True) for cell in cells if "," in cell]
    if found and all(THOUSANDS.fullmatch(cell) for cell, _ in found):
        decimals = [cell for cells in rows for cell in cells if "." in cell and holds_number(cell)]
        if any(not THOUSANDS.fullmatch(cell.replace(".", ",")) for cell in decimals):
            return True
        cell, line = found[0]
        raise source.error(
            f"found '{cell}': a decimal comma, or one that parts thousands? Every number with one has three digits "
            f"behind it; write decimal points, and no commas in thousands",
            line,
        )
    for column in zip(*rows, strict=True) if found and pointed else ():
        comma = next((cell for cell in column if "," in cell and "." not in cell), None)
        places = [place for place, cell in enumerate(column) if "." in cell]
        if comma and places and all(THOUSANDS.fullmatch(column[place].replace(".", ",")) for place in places):
            cell, line = column[places[0]], lines[places[0]]
            raise source.error(f"found '{cell}' in a column with '{comma}': wanted one decimal mark", line)
    return False


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
