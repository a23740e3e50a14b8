"""What is asked of answers by words and numbers, and which rows it holds for."""

import sqlite3
from math import inf
from re import fullmatch

from ..errors import InputError, choices
from ..records import dataclass
from .collected import COLUMNS

NUMBERS = [name for name, kind in COLUMNS.items() if kind != "TEXT"]
TEXTS = ("kind", "recommended", "flags", "file", "no_answer")
SHOWN = ("file", "recommended", "kind", "gloss60", "albedo", "f0", "alpha_equivalent", "rms_ln")
# 60-degree gloss by the levels of the Master Painters Institute: G3 and G4, eggshell and satin like, 10 to 35; G5,
# semi-gloss, 35 to 70; G6, gloss, 70 to 85; G7, high gloss, above. Below 10 ISO 2813 reads at 85 degrees: matt.
WORDS: dict[str, str] = {
    "matt": "gloss60<10",
    "satin": "gloss60=10..35",
    "semi-gloss": "gloss60=35..70",
    "gloss": "gloss60=70..85",
    "high-gloss": "gloss60>85",
    "metal": "kind=metal",
    "dielectric": "kind=dielectric",
    "trusted": "no_answer=",
}
ABOUT = 0.15  # of a number, on either side of one that is given with ~
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


@dataclass(frozen=True)
class Condition:
    """One thing that is asked of a row."""

    column: str
    low: float = -inf
    high: float = inf
    text: str | None = None
    strict: bool = False  # whether the bounds themselves are out


def conditions(query: str) -> list[Condition]:
    """`kind=dielectric, gloss60=10..30, albedo~0.18, satin, file=*steel*` as conditions, all of which must hold.

    Raises InputError for a word that is none, with those that there are.
    """
    found = []
    for word in filter(None, (each.strip() for each in query.split(","))):
        found.append(_condition(WORDS.get(word.lower().replace(" ", "-"), word), word))
    return found


def _condition(text: str, word: str) -> Condition:
    matched = fullmatch(r"(\w+)\s*(=|~|<|>)\s*(.*)", text)
    if not matched:
        raise choices("word or NAME=VALUE", word, [*WORDS, *(f"{name}=" for name in (*TEXTS, *NUMBERS))])
    column, sign, value = matched.groups()
    if sign == "=" and column in TEXTS:
        return Condition(column, text=value)
    if column not in NUMBERS:
        raise choices("number to search by", column, NUMBERS)
    span = fullmatch(rf"({NUMBER})?\.\.({NUMBER})?", value)
    if sign == "=" and span and (span[1] or span[2]):
        low, high = float(span[1] or -inf), float(span[2] or inf)
        if low > high:
            raise InputError(f"{word}: found {low:g} before {high:g}; wanted LOW..HIGH")
        return Condition(column, low, high)
    if not fullmatch(NUMBER, value):
        raise InputError(f"{word}: wanted a number, or LOW..HIGH behind =")
    number = float(value)
    if sign in "<>":
        low, high = (-inf, number) if sign == "<" else (number, inf)
        return Condition(column, low, high, strict=True)
    margin = ABOUT * abs(number) if sign == "~" else 0.0
    return Condition(column, number - margin, number + margin)


def matching(base: sqlite3.Connection, asked: list[Condition], *more: str) -> list[dict]:
    """The rows of which all holds, in the order of their files' names; one for each file, with its key, what is SHOWN
    and `more` columns."""
    where: list[str] = ["1"]
    values: list[str | float] = []
    for each in asked:
        if each.text is not None:
            name, pattern = _like(each.column, each.text)
            where.append(f"{name} GLOB ?")
            values.append(pattern)
        else:
            low, high = (">", "<") if each.strict else (">=", "<=")
            where.append(f"fit.{each.column} {low} ? AND fit.{each.column} {high} ?")
            values += [max(each.low, -1e300), min(each.high, 1e300)]
    names = ["key", *SHOWN, *more]
    columns = ", ".join("name.file" if name == "file" else f"fit.{name}" for name in names)
    lines = f"SELECT {columns} FROM name JOIN fit USING (key) WHERE {' AND '.join(where)} ORDER BY file"
    return [dict(zip(names, row, strict=True)) for row in base.execute(lines, values)]


def _like(column: str, text: str) -> tuple[str, str]:
    """What is compared, and with which pattern: * and ? stand for what they do, [ for itself; of files alone large
    letters are other letters; of flags it is one among several."""
    pattern = text.replace("[", "[[]")
    if column == "file":
        return "name.file", pattern
    name, pattern = f"lower(ifnull(fit.{column}, ''))", pattern.lower()
    if column == "flags" and text:
        return f"',' || {name} || ','", f"*,{pattern},*"
    return name, pattern
