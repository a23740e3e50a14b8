"""A text table as a header and numbers, whatever separates its cells; errors point at line and column."""

import csv
import re
from dataclasses import dataclass

import numpy as np

from ._base import Source

COMMENTS = ("#", "%", "//", "!")
MISSING = {"", "nan", "na", "n/a", "none", "null", "-", "--", "---", "nd", "n.d.", "*", "#n/a", "#value!", "#div/0!", "#num!"}
# delimiter and decimal mark, likeliest first; None is any white space
STYLES = (("\t", "."), (";", "."), (",", "."), (None, "."), ("|", "."), ("\t", ","), (";", ","), (None, ","), ("|", ","))
LOOKED_AT = 40  # data lines that decide the style
UNIT_WORDS = re.compile(r"[\[(]?\s*(deg|degrees?|°|rad|radians?|nm|um|µm|1/sr|sr\^?-1|/sr|-|)\s*[\])]?", re.IGNORECASE)


@dataclass(frozen=True)
class Sheet:
    names: list[str]
    values: np.ndarray  # (rows, columns); NaN where a cell is missing
    lines: np.ndarray  # number of the line that each row stands in
    comments: list[str]
    notes: list[str]  # what was skipped


def sheet(source: Source, headerless: tuple[str, ...] | None = None) -> Sheet:
    """The table in a text. Raises InputError for the first cell that is no number, and for rows of another length.

    `headerless` gives the column names for a table without a header row.
    """
    comments, content = [], []
    for number, text in enumerate(source.lines, 1):
        stripped = text.strip()
        if stripped.startswith(COMMENTS):
            comments.append(stripped.lstrip("#%!/ \t"))
        elif stripped and not stripped.strip(",;\t |") == "":
            content.append((number, text))
    if not content:
        raise source.error("there is no table in it, only comments and blank lines" if comments else "the file is empty")
    first = next((place for place, (_, text) in enumerate(content) if _looks_like_data(text)), None)
    first = _below_the_names(content, first)
    if first is None:
        raise source.error(f"no row of numbers found; the first line is '{content[0][1].strip()[:60]}'", content[0][0])
    delimiter, decimal = _style([text for _, text in content[first : first + LOOKED_AT]], content[first - 1][1] if first else None)
    names, notes = _header(source, content[:first], comments, headerless, delimiter, decimal, content[first])
    values, lines = rows_of(source, content[first:], names, delimiter, decimal, notes)
    return Sheet(names, values, lines, comments + [text.strip() for _, text in content[:first]], notes)


def _below_the_names(content, first: int | None) -> int | None:
    """One row further where the row found has words over a column of numbers: names such as theta_i, theta_r, 400, 550, 700."""
    if first is None or first + 1 >= len(content):
        return first
    cells = [re.split(r"[,;\t |]+", text.strip().replace('"', "")) for _, text in content[first : first + 2]]
    words = [place for place, cell in enumerate(cells[0]) if re.match(r"[^\W\d]{2}", cell) and not _is_number(cell)]
    return first + 1 if len(cells[0]) == len(cells[1]) and any(_is_number(cells[1][place]) for place in words) else first


def cells_of(text: str, delimiter: str | None) -> list[str]:
    if delimiter is None:
        return next(csv.reader([re.sub(r"\s+", " ", text.strip())], delimiter=" "))
    return [cell.strip() for cell in next(csv.reader([text.strip("\n")], delimiter=delimiter, skipinitialspace=True))]


def _looks_like_data(text: str) -> bool:
    """Whether most cells are numbers, under some style."""
    cells = [cell for cell in re.split(r"[,;\t |]+", text.strip().replace('"', "")) if cell]
    return bool(cells) and sum(_is_number(cell) for cell in cells) * 2 > len(cells)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
        return True
    except ValueError:
        return cell.lower() in MISSING and cell != ""


def _style(sample: list[str], header: str | None):
    """The first style in which every sampled line has equally many cells, all numbers, as many as the header."""

    def score(style):
        delimiter, decimal = style
        rows = [cells_of(text, delimiter) for text in sample]
        counts = [len(row) for row in rows]
        common = max(set(counts), key=counts.count)
        if common < 2:
            return (0, 0, 0)
        good = sum(_is_number(_dotted(cell, decimal)) or cell == "" for row in rows for cell in row) / sum(counts)
        whole = sum(count == common for count in counts) / len(counts)
        agrees = header is not None and len(cells_of(header, delimiter)) == common
        return (round(good * whole, 3), agrees, 0)

    return max(STYLES, key=score)


def _dotted(cell: str, decimal: str) -> str:
    return cell.replace(",", ".", 1) if decimal == "," and cell.count(",") == 1 and "." not in cell else cell


def _header(source, before, comments, headerless, delimiter, decimal, first):
    """Column names: from the option, the line above the numbers, or the last comment that has as many words."""
    number, text = first
    width = len(_trimmed(cells_of(text, delimiter)))
    if headerless is not None:
        if len(headerless) != width:
            raise source.error(f"--columns names {len(headerless)} columns; the rows have {width}", number)
        return list(headerless), [text.strip() for _, text in before]
    skipped = [(line, text) for line, text in before]
    if skipped and all(UNIT_WORDS.fullmatch(cell) for cell in cells_of(skipped[-1][1], delimiter)) and len(skipped) > 1:
        _, units = skipped.pop()
        names = _trimmed(cells_of(skipped[-1][1], delimiter))
        units = [cell.strip("[]() ") for cell in cells_of(units, delimiter)]
        if len(units) >= len(names):
            names = [f"{name} [{unit}]" if unit not in ("", "-") else name for name, unit in zip(names, units)]
    elif skipped:
        names = _trimmed(cells_of(skipped[-1][1], delimiter))
    else:
        for comment in reversed(comments):
            for style in (delimiter, None, ","):
                names = _trimmed(cells_of(comment, style)) if comment else []
                if len(names) == width and not any(_is_number(name) for name in names):
                    return names, []
        names = []
    if not names:
        raise source.error(f"no header row above the numbers ({width} columns); name the columns with --columns, such as theta_i,theta_r,brdf", number)
    if len(names) != width:
        raise source.error(f"the header names {len(names)} columns ({', '.join(names)[:80]}); this row has {width}", number)
    for place, name in enumerate(names):
        if name and name.lower() in [other.lower() for other in names[:place]] and name not in [other for other in names if other != name]:
            if names.count(name) > 1:
                raise source.error(f"two columns are called '{name}'", skipped[-1][0] if skipped else None)
    return names, [f"line {line}: '{text.strip()[:40]}'" for line, text in skipped[:-1]]


def _trimmed(cells: list[str]) -> list[str]:
    """Without the empty cells after a trailing delimiter."""
    while cells and not cells[-1].strip():
        cells = cells[:-1]
    return [cell.strip() for cell in cells]


def rows_of(source: Source, content, names, delimiter, decimal, notes):
    """Values (rows, columns) and the line of each row; `content` are pairs of line number and text."""
    width = len(names)
    lines = np.array([number for number, _ in content])
    texts = [text for _, text in content]
    plain = decimal == "." and not any('"' in text for text in texts[:LOOKED_AT])
    if plain:
        try:
            values = np.loadtxt(texts, delimiter=delimiter, comments=None, ndmin=2)
            if values.shape[1] == width:
                return values, lines
        except ValueError:
            pass  # the slow way finds out where and why
    rows, kept = [], []
    for number, text in content:
        cells = cells_of(text, delimiter)
        if [cell.strip() for cell in cells[:width]] == names:
            notes.append(f"line {number}: the header again")
            continue
        if len(cells) > width and not any(cell.strip() for cell in cells[width:]):
            cells = cells[:width]
        if len(cells) != width:
            raise source.error(f"found {len(cells)} cells, wanted {width} ({', '.join(names)[:80]})", number)
        rows.append([_number(source, cell, number, name, decimal) for cell, name in zip(cells, names)])
        kept.append(number)
    return np.array(rows, float).reshape(-1, width), np.array(kept)


def _number(source, cell: str, line: int, name: str, decimal: str) -> float:
    cell = cell.strip()
    if cell.lower() in MISSING:
        return np.nan
    try:
        return float(_dotted(cell, decimal))
    except ValueError:
        raise source.error(f"column '{name}': found '{cell[:40]}', wanted a number", line) from None
