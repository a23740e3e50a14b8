"""The numbers to type into other programs, in words."""

from .values import off_words


def numbers_text(document: dict) -> str:
    """For people: a paragraph for each program, first what to type."""
    head = f"{document['surface']} ({document['model']}): the numbers to type, and how far off they are"
    lines = [line for each in document["programs"] for line in _lines(each, document["model"])]
    return "\n".join([head, "", *lines, "", f"colour: {document['colour']}"])


def card_text(programs: list[dict]) -> str:
    """A line for each program, as a block of a longer answer."""
    width = max(len(each["program"]) for each in programs)
    head = "numbers to type, and how far off they are by each program's own formula (`brdfguide numbers` tells more):"
    return "\n".join([head, *(f"  {each['program']:<{width}}  {_short_line(each)}" for each in programs)])


def _short_line(each: dict) -> str:
    if each["rms_ln"] is None:
        return "cannot be typed there"
    words = [f"{label} {each['hex'].get(label) or _value(each, label)}" for label in each["numbers"]]
    return f"{', '.join(words)} ({off_words(each['off_percent'])} off{_measured(each)})"


def _lines(each: dict, model: str) -> list[str]:
    name = f"{each['program']}, {each['shader']}"
    if each["rms_ln"] is None:
        return [f"{name}: cannot be typed there: {'; '.join(each['cannot'])}"]
    words = [f"{label} {_value(each, label)}" for label in each["numbers"]]
    lines = [
        f"{name}: {off_words(each['off_percent'])} off {_of(each, model)}by {each['formula']} formula{_measured(each)}",
        f"  {', '.join(words)}",
    ]
    return lines + [f"  cannot: {sentence}" for sentence in each["cannot"]] + [f"  {note}" for note in each["notes"]]


def _measured(each: dict) -> str:
    """The error against a measurement, where there is one."""
    off = each["measured_off_percent"]
    return "" if off is None else f"; {off_words(off)} off the measurement"


def _of(each: dict, model: str) -> str:
    """Of which candidate, where it is not the recommended one."""
    return "" if each["model"] in (None, model) else f"{each['model']} "


def _value(each: dict, label: str) -> str:
    value = each["numbers"][label]
    if not isinstance(value, list):
        return f"{value:.3g}"
    return f"{each['hex'][label]} (linear {' '.join(f'{part:.3g}' for part in value)})"
