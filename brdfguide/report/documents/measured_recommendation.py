"""What the guidelines and a measurement say together, as a document."""

from ...data.metal_or_dielectric import Verdict
from .digest import KEY
from .findings import finding


def with_measurement(said: dict | None, judged: Verdict, differ, fitted: dict) -> dict:
    """A fit's document with the verdict on the data and, for a description, its `document` and where they disagree."""
    own = {
        "schema": "brdfguide/recommend/1",
        "measured_verdict": {"kind": judged.kind, "evidence": list(judged.evidence), "numbers": dict(judged.numbers)},
        "disagreements": [finding(each) for each in differ],
        "left_out": (said or {}).get("left_out", []) + fitted["left_out"],
    }
    fitted = {key: value for key, value in fitted.items() if key != KEY}  # the digest was that of the fit alone
    return {**(said or {}), **fitted, **own} | ({"recommended_by_guidelines": said["recommended"]} if said else {})
