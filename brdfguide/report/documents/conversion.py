"""One shader's numbers as another's, as a document."""

from ...exporters.conversions import Converted
from ...physics import seen
from ...physics.colour import hex_of
from .plain import off_percent, plain


def conversion_document(source: str, target: str, given: dict, found: Converted) -> dict:
    """`brdfguide convert --from ... --to ... --json`."""
    return plain(
        {
            "schema": "brdfguide/conversion/1",
            "from": source,
            "given": given,
            "to": target,
            "numbers": found.numbers,
            "hex": {name: hex_of(value) for name, value in found.numbers.items() if _is_colour(value)},
            "rms_ln": found.rms_ln,
            "off_percent": off_percent(found.rms_ln),
            "seen": found.seen,
            "seen_words": None if found.seen is None else seen.band_words(found.seen),
            "over": found.over,
            "cannot": list(found.lost),
        }
    )


def _is_colour(value) -> bool:
    return isinstance(value, list) and min(value) >= 0 and max(value) <= 1
