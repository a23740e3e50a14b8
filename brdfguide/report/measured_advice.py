"""A description and its measurement, or a measurement alone: a fit's document with verdict and disagreements."""

from ..recommend import Recommendation
from ..verdict import Verdict
from . import advice
from .document import finding


def document(told: Recommendation | None, judged: Verdict, differ, fitted: dict, timing: bool = True) -> dict:
    """A fit's document with the verdict on the data and, where there is a description, what it said and where it disagrees."""
    said = advice.document(told, timing) if told else {}
    own = {
        "schema": "brdfguide/recommend/1",
        "measured_verdict": {"kind": judged.kind, "evidence": list(judged.evidence), "numbers": dict(judged.numbers)},
        "disagreements": [finding(each) for each in differ],
        "left_out": said.get("left_out", []) + fitted["left_out"],
    }
    return {**said, **fitted, **own} | ({"recommended_by_guidelines": said["recommended"]} if told else {})


def text(each: dict) -> str:
    """The verdict on the data, and what it denies of the description."""
    judged = each["measured_verdict"]
    lines = [f"from the measurement: {judged['kind']}" + (f" ({'; '.join(judged['evidence'])})" if judged["evidence"] else "")]
    return "\n".join(lines + [f"  eye against instrument: {d['text']}; {d.get('consequence', '')}" for d in each["disagreements"]])
