"""Sections of a table: lines between its rows, such as `# theta_i: 30 deg`, that hold for the rows below them."""

import re
from dataclasses import replace

import numpy as np

from ..columns.facts import spelt_out
from ..columns.grammar import understood
from ..columns.vocabulary import word_set
from ._sheet import Sheet
from .format import holds_number

MOST_THINGS = 50  # that lines between the rows are asked for
LONGEST = 200  # letters of a line that are looked at
BETWEEN = re.compile(r"[;,](?!\d)")  # not a decimal comma
NUMBER = re.compile(r"([-+]?(?:\d+(?:[.,]\d+)?|[.,]\d+)(?:[eE][-+]?\d+)?) ?([^\d]{0,20})")
OF_A_SECTION = word_set("sample specimen material polarisation polarization polariser polarizer band filter")


def statements(text: str) -> dict[str, str]:
    """`theta_i = 30 deg; phi: 0` as name -> what it is; `incidence angle 30` too, where the words name an angle or a
    wavelength."""
    found = {}
    for part in BETWEEN.split(text[:LONGEST]):
        mark = min((place for place in (part.find(":"), part.find("=")) if place > 0), default=-1)
        if mark < 0:
            digit = next((place for place, letter in enumerate(part) if letter.isdigit()), 0)
            mark = digit - (part[digit - 1 : digit] in ("-", "+"))
            name, value = part[:mark], part[mark:]
            name = name if _is_of_directions(name) else ""
        else:
            name, value = part[:mark], part[mark + 1 :]
        name, value = " ".join(name.split()), " ".join(value.split())
        if name[:1].isalpha() and value:
            found[name] = value
    return found


def opens_a_section(text: str) -> bool:
    """Whether a line that is no comment says nothing but what holds below it."""
    found = statements(text)
    parts = [part for part in BETWEEN.split(text[:LONGEST]) if part.strip()]
    return bool(found) and len(found) == len(parts) and all(map(_is_told, found, found.values()))


def with_sections(table: Sheet) -> Sheet:
    """The table with a column for each thing that lines between its rows state, unless a column says it already; such
    lines are comments no longer."""
    said: dict[str, list[tuple[int, str]]] = {}
    for line, text in sorted(zip(table.comment_lines, table.comments, strict=False)):
        for name, value in statements(text).items():
            if _is_told(name, value):
                said.setdefault(name, []).append((line, value))
    taken = {understood(name).role for name in table.names} | {name.strip().lower() for name in table.names}
    several = [(name, each) for name, each in said.items() if len({value for _, value in each}) > 1]
    for name, each in several[:MOST_THINGS]:
        column, role = _column(table.lines, each), understood(name).role
        if column is None or name.lower() in taken or role is not None and role in taken:
            continue
        table = _with(table, name, column)
        taken |= {name.lower(), role}
    return table


def _is_of_directions(name: str) -> bool:
    return understood(name).role not in (None, "value", "stderr")


def _is_told(name: str, value: str) -> bool:
    """Whether a line of this kind can hold for rows: a number, or a word for a sample, a band or a polarisation."""
    if understood(name).role in ("value", "stderr"):
        return False
    number = NUMBER.fullmatch(value)
    words = {token.text for token in spelt_out(name)}
    return number is not None and (holds_number(number[1].replace(",", "."))) or bool(words & OF_A_SECTION)


def _column(lines: np.ndarray, said: list[tuple[int, str]]) -> list[str] | None:
    """What the last line above each row says of it, nothing above the first; None where all rows have the same."""
    place = np.searchsorted([line for line, _ in said], lines) - 1
    if len(np.unique(place)) < 2:
        return None
    cells = ["" if each < 0 else said[each][1] for each in place.tolist()]
    return cells if len(set(cells) - {""}) > 1 else None


def _with(table: Sheet, name: str, cells: list[str]) -> Sheet:
    """With one more column, of numbers with their common unit in its name where all are such."""
    numbers = [NUMBER.fullmatch(cell) for cell in cells]
    units = {number[2].strip(" .") for number in numbers if number}
    plain = all(number or not cell for number, cell in zip(numbers, cells, strict=True)) and len(units) == 1
    texts = dict(table.texts)
    if plain:
        unit = next(iter(units))
        column = [float(number[1].replace(",", ".")) if number else np.nan for number in numbers]
        title = f"{name} ({unit})" if unit and not understood(name).unit else name
    else:
        column, title = [np.nan] * len(cells), name
        texts[len(table.names)] = cells
    kept = [(_without(text, name), line) for text, line in zip(table.comments, table.comment_lines, strict=False)]
    kept = [(text, line) for text, line in kept if text]
    return replace(
        table,
        names=[*table.names, title],
        values=np.column_stack([table.values, column]),
        comments=[text for text, _ in kept],
        comment_lines=[line for _, line in kept],
        texts=texts,
        sections=(*table.sections, title),
    )


def _without(text: str, name: str) -> str:
    """A comment without what it states of one thing."""
    parts = BETWEEN.split(text)
    kept = [part for part in parts if name not in statements(part)]
    return text if len(kept) == len(parts) else ", ".join(part.strip() for part in kept)
