"""The numbers to type into other programs, as a document."""

from ...exporters.cards import Card
from .plain import off_percent

SCHEMA = "brdfguide/numbers/1"


def numbers_document(name: str, model: str, colour: str, cards: list[Card]) -> dict:
    """`brdfguide numbers --json`."""
    return {
        "schema": SCHEMA,
        "surface": name,
        "model": model,
        "colour": colour,
        "programs": numbers_block(cards),
    }


def numbers_block(cards: list[Card]) -> list[dict]:
    """One entry a program: its numbers, colours also as sRGB hex, and the error by its own formula."""
    return [
        {
            "program": card.program,
            "shader": card.shader,
            "numbers": {
                label: [_short(each) for each in value] if isinstance(value, tuple) else _short(value)
                for label, value in card.numbers.items()
            },
            "hex": dict(card.hexes),
            "means": dict(card.roles),
            "rms_ln": card.rms_ln,
            "off_percent": None if card.rms_ln is None else off_percent(card.rms_ln),
            "measured_rms_ln": card.measured_rms_ln,
            "measured_off_percent": None if card.measured_rms_ln is None else off_percent(card.measured_rms_ln),
            "formula": card.formula,
            "model": card.model or None,
            "cannot": list(card.cannot),
            "notes": list(card.notes),
        }
        for card in cards
    ]


def _short(value: float) -> float:
    return float(f"{value:.6g}")
