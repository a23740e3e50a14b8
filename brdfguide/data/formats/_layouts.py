"""Text tables laid out otherwise: rows in brackets, cells with their names, a name before each row of numbers."""

import re

from ._cells import is_number
from ._written import reads, tidy

Lines = list[tuple[int, str]]  # number and text
LOOKED_AT = 40
LEAST = 3  # lines that say so
BRACKETED = re.compile(r"[\[({]{1,3}([^\[\](){}]{3,})[\])}]{1,3}\s{0,9}[,;]?")
ONLY_BRACKETS = re.compile(r"(?:[A-Za-z_]\w{0,60}\s{0,9}=\s{0,9})?[\[({]{1,3}|[\])}]{1,3}[;,]?")
NAMED = re.compile(r"([A-Za-z][\w.]{0,40})\s{0,3}[=:]\s{0,3}([-+]?[\d.][^\s,;]{0,40})")
MOST_NAMES = 200  # rows that are columns, or columns


def as_rows(content: Lines) -> Lines:
    """The lines of a table as rows under names, whatever lies around them."""
    content = _without_frame(content)
    first = [text.strip() for _, text in content[:LOOKED_AT]]
    if sum(bool(BRACKETED.fullmatch(text)) for text in first) >= LEAST:
        return _without_brackets(content)
    if len(first) >= LEAST and all("=" in text or ":" in text for text in first[:LEAST]):
        return _without_names(content)
    if LEAST <= len(content) <= MOST_NAMES and all(text[:1].isalpha() or text[:1] in "\"'" for text in first):
        return _turned(content)
    return content


def _without_frame(content: Lines) -> Lines:
    """Without the bars at both ends of the lines, where all that have bars have these."""
    if not any("|" in text for _, text in content[:LOOKED_AT]):
        return content
    barred = [text.strip() for _, text in content if "|" in text]
    if not all(len(text) > 2 and text[0] == text[-1] == "|" for text in barred):
        return content
    return [(number, text.strip()[1:-1] if "|" in text else text) for number, text in content]


def _without_brackets(content: Lines) -> Lines:
    """`[10, -75, 0.1],` as `10, -75, 0.1`, without lines of brackets alone."""
    found = []
    for number, text in content:
        match = BRACKETED.fullmatch(text.strip())
        if match or not ONLY_BRACKETS.fullmatch(text.strip()):
            found.append((number, match[1] if match else text))
    return found


def _without_names(content: Lines) -> Lines:
    """`theta_i=10 theta_r=-75 brdf=0.1` as names above rows, where every line has the same names."""
    names = [name for name, _ in NAMED.findall(content[0][1].strip())]
    if not LEAST <= len(names) <= MOST_NAMES:
        return content
    rows: Lines = []
    for number, text in content:
        cells = NAMED.findall(text)
        if [name for name, _ in cells] != names or NAMED.sub("", text).strip(" \t,;"):
            return content
        rows.append((number, "\t".join(cell for _, cell in cells)))
    return [(content[0][0], "\t".join(names)), *rows]


def _turned(content: Lines) -> Lines:
    """Rows of numbers, each behind its name, as columns; their cells keep the number of the first line."""
    mark = next((mark for mark in "\t;," if all(mark in text for _, text in content)), None)
    rows = [[cell.strip(" \"'") for cell in tidy(text.strip()).split(mark)] for _, text in content]
    width = len(rows[0])
    if width < 1 + LEAST or any(len(row) != width for row in rows):
        return content
    if any(
        is_number(row[0]) or not all(is_number(cell) or reads(cell) or not cell for cell in row[1:]) for row in rows
    ):
        return content
    return [(content[0][0], "\t".join(cells)) for cells in zip(*rows, strict=True)]
