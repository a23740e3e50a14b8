"""The numbers to type into other programs, in words: lines of at most 80 columns, folded between numbers."""

from math import log
from typing import NamedTuple

from ...printable import off_words
from .folding import folded, screen_width

COLUMNS = 80  # of a terminal as it opens
LEAST_TIED = 60  # columns from which on a number stays on the line of its label
TIED = "\x00"  # in place of a space at which no line is to end
FARTHEST = log(2)  # rms ln from which on the block's numbers would mislead
MOST_LABEL = 10  # letters of a program's own label in the block
TOGETHER = {
    "weight": ("weight",),
    "edge": ("edge",),
    "grain": ("grain", "rotation"),
    "coat": ("coat", "coat_roughness", "coat_gloss", "coat_index"),
}
LEGEND = {
    "grain": "grain: amount/rotation",
    "coat": "coat: weight/roughness/index",
}


def numbers_text(document: dict) -> str:
    """For people: a paragraph for each program, first what to type."""
    of = "" if document["surface"] == document["model"] else f" ({document['model']})"
    head = f"{document['surface']}{of}: the numbers to type, and how far off they are"
    lines = [line for each in document["programs"] for line in _lines(each, document["model"])]
    return "\n".join([_folded(head), "", *lines, "", _folded(f"colour: {document['colour']}")])


def card_text(programs: list[dict]) -> str:
    """A row for each program, as a block of a longer answer: how far off, what to type; one line where it fits."""
    best = min((each["rms_ln"] for each in programs if each["rms_ln"] is not None), default=FARTHEST)
    if best >= FARTHEST:
        return _folded("numbers to type: no shader comes within a factor 2; more: `brdfguide numbers`")
    head = BlockRow("numbers to type", "off", "colour", "metal", "rough", "")
    rows = [head, *(_row(each) for each in programs)]
    widths = [max(len(row[place]) for row in rows) for place in range(len(head) - 1)]
    margin = " " * (sum(widths) + 2 * len(widths) + 4)
    lines = [_folded(_tied_row(row, widths), "", margin) for row in rows]
    return "\n".join([*lines, _folded(_of_what(programs))])


class BlockRow(NamedTuple):
    """A program in the block."""

    program: str
    off: str
    colour: str
    metal: str
    rough: str
    more: str


def _row(each: dict) -> BlockRow:
    name = "  " + ", ".join(each["program"].split(", ")[:2])
    if each["rms_ln"] is None:
        return BlockRow(name, "-", "", "", "", "cannot be typed there")
    off = each["off_percent"] if each["measured_off_percent"] is None else each["measured_off_percent"]
    label = {role: label for label, role in reversed(each["means"].items())}
    shown = {role: each["hex"].get(label) or f"{each['numbers'][label]:.3g}" for role, label in label.items()}
    metal = shown.get("metalness", "")
    more = [f"{_short_name(label[role])} {shown[role]}" for role in ("index", "specularity") if role in shown]
    if metal == "1":
        more = []  # a metal's index is in its colour
    if "coat_gloss" in shown:
        shown["coat_gloss"] = f"gloss {shown['coat_gloss']}"
    for word, roles in TOGETHER.items():
        if roles[0] in shown:
            more.append(f"{word} {'/'.join(shown[role] for role in roles if role in shown)}")
    return BlockRow(name, _factor_words(off), shown["colour"], metal, shown.get("roughness", ""), _listed(more, " "))


def _tied_row(row: BlockRow, widths: list[int]) -> str:
    program, off, colour, metal, rough = (
        f"{cell:<{width}}" if place in (0, 2) else f"{cell:>{width}}"
        for place, (cell, width) in enumerate(zip(row[:-1], widths, strict=True))
    )
    return _tied(f"{program}  {off}  {colour}  {metal}  {rough}") + f"{TIED * 2}{row.more}".rstrip(TIED)


def _factor_words(percent: float) -> str:
    return off_words(percent).replace("a factor ", "x")


def _short_name(label: str) -> str:
    return label.replace("_", " ").rpartition(" ")[2] if len(label) > MOST_LABEL else label


def _of_what(programs: list[dict]) -> str:
    """What the errors are taken against, and what stands together."""
    held = [each for each in programs if each["rms_ln"] is not None]
    of = {each["program"].split(",")[0]: each["model"] for each in held}
    most = max(of.values(), key=list(of.values()).count)
    others = [
        f"{', '.join(program for program in of if of[program] == model)}: {model}"
        for model in dict.fromkeys(of.values())
        if model != most
    ]
    described = f"{most} ({'; '.join(others)})" if others else most
    against = described if held[0]["measured_off_percent"] is None else "the measurement"
    roles = {role for each in held for role in each["means"].values()}
    together = [words for role, words in LEGEND.items() if role in roles]
    return "; ".join([f"off: from {against} by the program's formula", *together, "more: `brdfguide numbers`"])


def _lines(each: dict, model: str) -> list[str]:
    name = f"{each['program']}, {each['shader']}"
    if each["rms_ln"] is None:
        return [_folded(f"{name}: cannot be typed there: {'; '.join(each['cannot'])}")]
    of = "" if each["model"] in (None, model) else f" {each['model']}"
    head = f"{name}: {off_words(each['off_percent'])} off{of}{_measured(each)} (formula: {each['formula']})"
    typed = _listed([f"{label} {_value(each, label)}" for label in each["numbers"]])
    said = [f"cannot: {sentence}" for sentence in each["cannot"]] + each["notes"]
    return [_folded(head), *(_folded(line, "  ") for line in (typed, *said))]


def _folded(text: str, first: str = "", further: str | None = None) -> str:
    room = min(screen_width() or COLUMNS, COLUMNS)
    text = text if room >= LEAST_TIED else text.replace(TIED, " ")
    return folded(text, first, f"{first}    " if further is None else further, room).replace(TIED, " ")


def _listed(items: list[str], between: str = ", ") -> str:
    return between.join(map(_tied, items))


def _tied(words: str) -> str:
    return words.replace(" ", TIED)


def _measured(each: dict) -> str:
    """The error against a measurement, where there is one."""
    off = each["measured_off_percent"]
    return "" if off is None else f", {off_words(off)} off the measurement"


def _value(each: dict, label: str) -> str:
    value = each["numbers"][label]
    if not isinstance(value, list):
        return f"{value:.3g}"
    return f"{each['hex'][label]} (linear {' '.join(f'{part:.3g}' for part in value)})"
