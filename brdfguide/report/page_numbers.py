"""The page's table of numbers to type into other programs, colours with a swatch."""

from html import escape

from ..printable import off_words
from .elements import html_table


def numbers_table(document: dict) -> str:
    """A row for each program; nothing where the document has no numbers."""
    lines = [
        ([_program(each), _fields(each), _off(each), _cannot(each)], False) for each in document.get("numbers", ())
    ]
    words = "<p>Off by each program's own formula with these very numbers. A colour picker takes the hex.</p>"
    return words + html_table(["program", "type", "off", ""], lines) if lines else ""


def _program(each: dict) -> str:
    return f'{escape(each["program"])}<br><span class="soft">{escape(each["shader"])}</span>'


def _fields(each: dict) -> str:
    return "<br>".join(f"{escape(label)} {_value(each, label)}" for label in each["numbers"])


def _value(each: dict, label: str) -> str:
    value = each["numbers"][label]
    if not isinstance(value, list):
        return f"<code>{value:.3g}</code>"
    hexed = escape(each["hex"][label], quote=True)
    swatch = f'<span style="background:{hexed};padding:0 .7em;border:1px solid #8888"></span>'
    return f"{swatch} <code>{hexed}</code> linear {' '.join(f'{part:.3g}' for part in value)}"


def _off(each: dict) -> str:
    if each["rms_ln"] is None:
        return "cannot be typed there"
    of_data = each["measured_off_percent"]
    off = f'<span style="white-space:nowrap">{off_words(each["off_percent"])}</span>'
    return off + ("" if of_data is None else f"<br>{off_words(of_data)} off the measurement")


def _cannot(each: dict) -> str:
    return escape("; ".join((*each["cannot"], *each["notes"])))
