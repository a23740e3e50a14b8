"""A text table as a header and numbers, whatever separates its cells; errors point at line and column."""

from collections.abc import Callable
from dataclasses import field, replace
from itertools import pairwise

import numpy as np

from ...errors import InputError
from ...finding import Finding
from ...records import dataclass
from ..columns.vocabulary import word_set
from ._cells import MISSING, cells_of, column_of, dotted, is_mark, is_number, parts_thousands
from ._layouts import as_rows
from ._written import Style, is_tidy, reads, tidy, unit_of
from .format import Source

COMMENTS = ("#", "%", "//", "!")
# delimiter and decimal mark, likeliest first; None is any white space
STYLES = (
    ("\t", "."),
    (";", "."),
    (",", "."),
    (None, "."),
    ("|", "."),
    ("\t", ","),
    (";", ","),
    (None, ","),
    ("|", ","),
    (",", ","),  # cells in quotes
)
RULE = "|+-=: \t"  # of what the lines between the names and rows of Markdown and framed tables consist
DIGITS = frozenset("0123456789")
A_NUMBER = DIGITS | set("-+.")  # what one begins with
SUMMARIES = word_set("mean average avg std stdev sd min max minimum maximum median sum total count rms")  # of columns
LONGEST_LINE, LONGEST_HEAD = 2**21, 20_000  # letters, lines
LOOKED_AT = 40  # data lines that decide the style


@dataclass(frozen=True, eq=False)
class Sheet:
    names: list[str]
    values: np.ndarray  # (rows, columns); NaN where a cell is missing or no number
    lines: np.ndarray  # number of the line that each row stands in
    comments: list[str]
    notes: list[str]  # what was skipped
    comment_lines: list[int] = field(default_factory=list)  # number of the line that each comment stands in
    texts: dict[int, list[str]] = field(default_factory=dict)  # of a column with a cell that is no number: its cells
    sections: tuple[str, ...] = ()  # names of the columns that lines between the rows state
    style: Style = Style("\t")
    findings: tuple[Finding, ...] = ()  # what was made of cells that state more than a number

    def rows(self, kept) -> "Sheet":
        """The same for some of the rows: a mask or row numbers."""
        places = np.arange(len(self.values))[kept]
        texts = {column: [cells[place] for place in places] for column, cells in self.texts.items()}
        return replace(self, values=self.values[kept], lines=self.lines[kept], texts=texts)

    def bad_cell(self, column: int) -> tuple[str, int] | None:
        """The first cell of a column that is no number, and its line; one that holds none at all before others."""
        pairs = zip(self.texts.get(column, ()), self.lines, strict=False)
        bad = [(cell, int(line)) for cell, line in pairs if not is_number(cell) and cell.lower() not in MISSING]
        return next((each for each in bad if not reads(each[0], self.style)), bad[0] if bad else None)


def read_sheet(
    source: Source, headerless: tuple[str, ...] | None = None, opens_a_section: Callable[[str], bool] = lambda _: False
) -> Sheet:
    """The table in a text. Raises InputError for the first cell that is no number, and for rows of another length.

    `headerless` gives the column names for a table without a header row; lines among the rows that open a section are
    comments.
    """
    comments, comment_lines, content = [], [], []
    check_lengths(source)
    for number, text in enumerate(source.lines, 1):
        stripped = text.strip()
        if not stripped.isascii() and not stripped[:1].isalpha() and not stripped.startswith(COMMENTS):
            text = tidy(text)
            stripped = text.strip()
        if stripped[:1] in DIGITS:
            content.append((number, text))
        elif comment := _comment(stripped, content, opens_a_section):
            comments.append(comment)
            comment_lines.append(number)
        elif stripped.strip(",;\t |") and stripped.strip(RULE):
            content.append((number, text))
    content = as_rows(content)
    if not content:
        raise source.error(
            "there is no table in it, only comments and blank lines" if comments else "the file is empty"
        )
    first = _first_row(content[:LONGEST_HEAD])
    if first is None:
        raise _without_rows(source, content[0])
    delimiter, decimal = _style(
        [text for _, text in content[first : first + LOOKED_AT]], content[first - 1][1] if first else None
    )
    first_row = content[first][0], tidy(content[first][1])
    below = content[first + 1 : first + LOOKED_AT]
    names, notes, above = _header(source, content[:first], comments, headerless, delimiter, first_row, below)
    values, lines, texts, style = rows_of(source, content[first:], names, Style(delimiter, decimal), notes)
    return Sheet(
        names=names,
        values=values,
        lines=lines,
        comments=comments + [text.strip() for _, text in above],
        notes=notes,
        comment_lines=comment_lines + [number for number, _ in above],
        texts=texts,
        style=style,
    )


def _without_rows(source: Source, line: tuple[int, str]) -> InputError:
    if source.name.lower().endswith((".yaml", ".yml")):
        text = "a description without measured values: `brdfguide recommend` takes it"
        return source.error(f"{text}; one of photographs has the key 'photographs'")
    return source.error(f"no row of numbers found; the first line is '{line[1].strip()[:60]}'", line[0])


def check_lengths(source: Source) -> None:
    """Raises InputError for a line that is no row."""
    if len(source.text) > LONGEST_LINE and (longest := max(map(len, source.lines))) > LONGEST_LINE:
        number = next(number for number, text in enumerate(source.lines, 1) if len(text) == longest)
        raise source.error(f"found a line of {longest} letters; wanted rows of at most {LONGEST_LINE}", number)


def _comment(stripped: str, content, opens_a_section) -> str:
    """What a comment says, and a line that opens a section; nothing of other lines, and of empty comments a blank."""
    if stripped.startswith(COMMENTS):
        return "" if _is_row_of_units(stripped) else stripped.lstrip("#%!/ \t") or " "
    among_rows = bool(content) and content[-1][1].strip()[:1] in A_NUMBER
    bare = stripped.lstrip("; ")
    if (stripped[:1] == ";" or stripped[:1].isalpha() and among_rows) and opens_a_section(bare):
        return bare
    return ""


def _first_row(content) -> int | None:
    """Where the rows begin: at the first line that is mostly numbers, or under a line of as many words.

    The line that is mostly numbers may be the names' own, such as theta_i, theta_r, 400, 550, 700. Cells such as
    `30 deg` make a row only under words.
    """
    plain = _row_of_numbers(content, is_number, False)
    stated = _row_of_numbers(content[:plain], lambda cell: is_number(cell) or reads(cell), True)
    return plain if stated is None else stated


def _row_of_numbers(content, is_one: Callable[[str], bool], under_words: bool) -> int | None:
    before: list[str] = []
    for place, (_, text) in enumerate(content):
        cells = _roughly(text)
        numbers = sum(is_one(cell) for cell in cells)
        of_words = len(before) == len(cells) and not any(is_one(cell) for cell in before)
        if under_words:
            found = 2 * numbers > len(cells) > 1 and of_words and is_one(cells[0])
        else:
            found = len(cells) > 1 and (2 * numbers > len(cells) or numbers > 1 and of_words and len(cells) > 2)
        if found:
            return _below_the_names(content, place)
        before = cells
    return None


def _below_the_names(content, first: int) -> int:
    """One row further where the row found has words over a column of numbers."""
    if first + 1 >= len(content):
        return first
    names, below = (_roughly(text) for _, text in content[first : first + 2])
    words = [place for place, cell in enumerate(names) if _is_name(cell)]
    return first + 1 if len(names) == len(below) and any(is_number(below[place]) for place in words) else first


def _is_name(cell: str) -> bool:
    return cell[:1].isalpha() and len(cell) > 1 and not is_number(cell) and not is_mark(cell)


def _roughly(text: str) -> list[str]:
    """The cells of a line whose style is not known yet, parted by the strongest mark in it, with decimal points."""
    text = tidy(text.strip().replace('"', ""))
    mark = next((mark for mark in "\t;|" if mark in text), None)
    cells = [dotted(cell.strip(), ",") for cell in text.split(mark)]
    if mark or "," not in text:
        return cells
    by_comma = [cell.strip() for cell in text.split(",")]

    def share(cells: list[str]) -> float:
        return sum(is_number(cell) or reads(cell) for cell in cells) / len(cells)

    return max((by_comma, cells), key=share)


def _style(sample: list[str], header: str | None):
    """The style in which every sampled line has as many cells as the header, most of them numbers, parted by something
    better than blanks; else the first in which they have equally many, all numbers.
    """

    rows_as_written = list(map(tidy, sample))

    def is_one(cell: str, style: Style) -> bool:
        return cell == "" or is_number(dotted(cell, style.decimal)) or reads(cell, style)

    def score(style):
        delimiter, decimal = style
        rows = [cells_of(text, delimiter) for text in rows_as_written]
        counts = [len(row) for row in rows]
        common = max(set(counts), key=counts.count)
        if common < 2:
            return (False, False, 0.0, False)
        good = sum(is_one(cell, Style(delimiter, decimal)) for row in rows for cell in row) / sum(counts)
        whole = sum(count == common for count in counts) / len(counts)
        agrees = header is not None and len(cells_of(header, delimiter)) == common
        whole_sheet = agrees and whole == 1 and good > 0.25  # the rest is text
        return (whole_sheet, whole_sheet and delimiter is not None, round(good * whole, 3), agrees)

    return max(STYLES, key=score)


# --- names ------------------------------------------------------------------------------------------------


def _header(source, before, comments, headerless, delimiter, first, below):
    """Column names, what was skipped, and the lines of text above them.

    The names are those of the option, of the line above the numbers, or of the last comment that has as many words.
    """
    number, text = first
    most = len(cells_of(text, delimiter))
    width = len(_trimmed(cells_of(text, delimiter)))
    if headerless is not None:
        if not width <= len(headerless) <= most:
            raise source.error(f"--columns names {len(headerless)} columns; the rows have {width}", number)
        return list(headerless), [text.strip() for _, text in before], before
    skipped = list(before)
    units = [] if len(skipped) < 2 else cells_of(skipped[-1][1], delimiter)
    if units and all(_is_unit(cell) for cell in units):
        skipped.pop()
    else:
        units = []
    if len(skipped) > 1 and _names_stand_above(skipped, delimiter, range(width, most + 1)):
        skipped[-2:] = [skipped[-1], skipped[-2]]  # `theta_i = 10` below the names of the first block
    names = _names_in(skipped[-1][1], delimiter, width) if skipped else _commented(comments, delimiter, width)
    if len(names) == width - 1 > 1 and _counts_rows(text, below, delimiter):
        names = ["", *names]  # as R writes them
    if not names:
        text = f"no header row above the numbers ({width} columns); name the columns with --columns, such as "
        raise source.error(text + "theta_i,theta_r,brdf", number)
    if not width <= len(names) <= most:
        text = f"the header names {len(names)} columns ({', '.join(names)[:80]}); this row has {width}"
        raise source.error(text, number)
    if len(skipped) > 1 and _twice(names):
        names = _under(_names_in(skipped[-2][1], delimiter, width), names)
    if name := _twice(names):
        raise source.error(f"two columns are called '{name[:60]}'", skipped[-1][0] if skipped else None)
    if len(units) >= len(names):
        units = [cell.strip("[]() ") for cell in units]
        names = [
            f"{name} [{unit}]" if unit not in ("", "-") else name for name, unit in zip(names, units, strict=False)
        ]
    return names, [f"line {line}: '{text.strip()[:40]}'" for line, text in skipped[:-1]], skipped[:-1]


def _names_stand_above(before, delimiter: str | None, width: range) -> bool:
    """Whether the last line above the rows states something, and the one above it has as many names as there are
    columns."""
    stated = before[-1][1]
    told = len(_trimmed(cells_of(stated, delimiter))) not in width and ("=" in stated or ":" in stated)
    return told and len(_names_in(before[-2][1], delimiter, width[0])) in width


def _counts_rows(first: str, below, delimiter: str | None) -> bool:
    """Whether the first cells of rows are words, or count from 0 or 1."""
    heads = [cells_of(text, delimiter)[0] for text in (first, *(text for _, text in below))]
    counts = [int(head) for head in heads if head.isdecimal() and len(head) < 10]
    steps = len(counts) == len(heads) and counts[0] < 2 and all(b - a == 1 for a, b in pairwise(counts))
    return steps if counts else not any(map(is_number, heads))


def _names_in(text: str, delimiter: str | None, width: int) -> list[str]:
    """The names in a line; those between white space may hold single blanks, where two part them."""
    names = _trimmed(cells_of(text, delimiter))
    apart = [part.strip() for part in text.split("  ") if part.strip()] if delimiter is None else []
    return apart if len(names) != width == len(apart) else names


def _commented(comments, delimiter: str | None, width: int) -> list[str]:
    """The last comment with as many words as there are columns."""
    for comment in reversed(comments):
        for style in (delimiter, None, ","):
            names = _names_in(comment, style, width) if comment else []
            if len(names) == width and not any(is_number(name) for name in names):
                return names
    return []


def _is_unit(cell: str) -> bool:
    """Whether a cell holds a unit and nothing else, or nothing."""
    return cell.strip().strip('[](){}"') in ("", "-", "1") or unit_of(cell) is not None


def _is_row_of_units(text: str) -> bool:
    """Whether a line that begins as a comment does is a row of units: `%, deg, deg` is no comment of Matlab's."""
    if not text.strip().startswith("%"):
        return False
    mark = next((mark for mark in "\t;,|" if mark in text), None)
    return mark is not None and all(_is_unit(cell) for cell in text.split(mark))


def _is_footer(content, row: list[str]) -> bool:
    """Whether lines hold no digit, such as `End of data` below the rows, or all begin with words where rows do not."""
    if not any(DIGITS & set(text) for _, text in content):
        return True
    return is_number(row[0]) and all(text.strip('" \t').lower()[:1].isalpha() for _, text in content)


def _twice(names: list[str]) -> str:
    """The first name that stands twice."""
    seen: set[str] = set()
    for name in names:
        if name in seen:
            return name
        seen |= {name} - {""}
    return ""


def _under(heads: list[str], names: list[str]) -> list[str]:
    """Names under heads that span several columns: `450 nm` over `BRDF` and `u(BRDF)`."""
    if len(heads) > len(names) or not any(heads):
        return names
    spanning, found = "", []
    for name, head in zip(names, heads + [""] * (len(names) - len(heads)), strict=True):
        spanning = head or spanning
        found.append(f"{name} {spanning}".strip() if names.count(name) > 1 else name)
    return found


def _trimmed(cells: list[str]) -> list[str]:
    """Without the empty cells after a trailing delimiter."""
    count = len(cells)
    while count and not cells[count - 1].strip():
        count -= 1
    return [cell.strip() for cell in cells[:count]]


# --- rows -------------------------------------------------------------------------------------------------


def rows_of(source: Source, content, names, style: Style, notes):
    """Values (rows, columns), the line of each row, the cells of columns in which some are no numbers, and the style.

    `content` are pairs of line number and text. Raises InputError for a row of another length.
    """
    width = len(names)
    lines = np.array([number for number, _ in content])
    texts = [text for _, text in content]
    plain = style.decimal == "." and not any('"' in text for text in texts[:LOOKED_AT])
    if plain:
        try:
            values = np.loadtxt(texts, delimiter=style.delimiter, comments=None, ndmin=2)
            if values.shape[1] == width:
                return values, lines, {}, style
        except ValueError:
            pass  # the slow way finds out where and why
    together = "\n".join(texts)
    if not is_tidy(together):
        content = [(number, tidy(text)) for number, text in content]
    rows: list[list[str]] = []
    kept: list[int] = []
    for place, (number, text) in enumerate(content):
        cells = cells_of(text, style.delimiter)
        if cells[:width] == names:
            notes.append(f"line {number}: the header again")
            continue
        if len(cells) > width and not any(cells[width:]):
            cells = cells[:width]
        if (len(cells) != width or cells[0].lower() in SUMMARIES) and rows and _is_footer(content[place:], rows[0]):
            notes += [f"line {line}: '{words.strip()[:40]}'" for line, words in content[place:]]
            break
        if len(cells) != width:
            raise source.error(f"found {len(cells)} cells, wanted {width} ({', '.join(names)[:80]})", number)
        rows.append(cells)
        kept.append(number)
    if style.decimal == ",":
        style = Style(style.delimiter, ".", True) if parts_thousands(source, rows, kept, "." in together) else style
        rows = [[dotted(cell, style.decimal) for cell in cells] for cells in rows]
    values, strange = np.full((len(rows), width), np.nan), {}
    for place in range(width):
        column = [row[place] for row in rows]
        values[:, place], bad = column_of(column)
        if bad:
            strange[place] = column
    return values, np.array(kept, int), strange, style
