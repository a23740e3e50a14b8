"""The numbers to type into other programs, in words: lines of at most 80 columns, folded between numbers."""

from .folding import folded, screen_width
from .values import off_words

COLUMNS = 80  # of a terminal as it opens
LEAST_TIED = 60  # columns from which on a number stays on the line of its label
TIED = "\x00"  # in place of a space at which no line is to end


def numbers_text(document: dict) -> str:
    """For people: a paragraph for each program, first what to type."""
    head = f"{document['surface']} ({document['model']}): the numbers to type, and how far off they are"
    lines = [line for each in document["programs"] for line in _lines(each, document["model"])]
    return "\n".join([_folded(head), "", *lines, "", _folded(f"colour: {document['colour']}")])


def card_text(programs: list[dict]) -> str:
    """A row for each program, as a block of a longer answer: how far off, what to type."""
    name_width = max(len(each["program"]) for each in programs)
    shown = [_off(each) for each in programs]
    off_width = max(map(len, shown))
    head = "numbers to type, after how far off they are by each program's own formula (`brdfguide numbers` tells more):"
    margin = " " * (name_width + off_width + 6)
    rows = [
        _folded(_card_words(each), f"  {each['program']:<{name_width}}  {off:>{off_width}}  ", margin)
        for each, off in zip(programs, shown, strict=True)
    ]
    return "\n".join([_folded(head), *rows])


def _off(each: dict) -> str:
    return "-" if each["rms_ln"] is None else off_words(each["off_percent"])


def _card_words(each: dict) -> str:
    if each["rms_ln"] is None:
        return "cannot be typed there"
    words = _listed([f"{label} {each['hex'].get(label) or _value(each, label)}" for label in each["numbers"]])
    off = each["measured_off_percent"]
    return words if off is None else f"{words} {_tied(f'({off_words(off)} off the measurement)')}"


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


def _listed(items: list[str]) -> str:
    return ", ".join(map(_tied, items))


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
