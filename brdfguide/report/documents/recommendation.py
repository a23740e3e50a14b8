"""What the guidelines make of a description, as a document."""

from math import degrees

from ...advice.guidelines.choice import sample_like
from ...advice.guidelines.joint import reading
from ...advice.inference import Inference
from ...advice.recommend import EFFECTS, Proposal, Recommendation

# filled field of a Material -> name outside, factor
SHOWN = {
    "kind": ("kind", None),
    "composition": ("composition", None),
    "appearance": ("appearance", None),
    "finish": ("finish", None),
    "coat": ("coat", None),
    "subsurface": ("subsurface", None),
    "f0": ("f0", None),
    "n": ("n", None),
    "k": ("k", None),
    "albedo": ("albedo", None),
    "alpha": ("alpha", None),
    "slope": ("slope", None),
    "sigma": ("sigma_um", None),
    "tau": ("tau_um", None),
    "emergence": ("emergence_angle_deg", degrees),
    "highlight_width": ("highlight_width_deg", degrees),
    "flake_highlight_width": ("flake_highlight_width_deg", degrees),
}


def document(found: Recommendation, timing: bool = True, explain: bool = True) -> dict:
    """`brdfguide recommend --json` of one description (CLI contract)."""
    return {
        "schema": "brdfguide/recommend/1",
        "name": found.material.name,
        "material": _material(found),
        "domain": {
            "status": found.status,
            "reasons": [
                {"rule": a.rule, "section": a.section, "status": a.domain, "text": a.says, "needs": a.needs or None}
                for a in found.reasons
            ],
        },
        "verdict": {"kind": found.verdict, "evidence": found.evidence},
        "nearest_sample": dict(zip(("name", "why"), sample_like(found.material), strict=True)),
        "recommended": found.candidates[0].model.name if found.candidates else None,
        "candidates": [
            _candidate(each, timing) | ({} if place else {"shows_from": each.shows})
            for place, each in enumerate(found.candidates)
        ],
        "advice": [
            {
                "rule": a.rule,
                "section": a.section,
                "says": a.says,
                "because": a.because,
                "sets": sorted(a.sets),
                "guess": a.guess,
                "conflict": a.conflict,
                "rests_on": list(found.rests_on.get(a.rule, ())),
            }
            for a in found.advice
        ],
        "silent": [_silent(each) for each in found.silent] if explain else [],
        "conflicts": [{"code": a.rule, "text": f"{a.says} ({a.because})"} for a in found.conflicts],
        "left_out": [{"term": name, "why": why} for name, why in found.left_out.items()],
        "inferred": _inferred(found.inference) if found.inference else None,
        "observations": [
            {"observation": key, "effect": effect, "text": EFFECTS[effect]} for key, effect in found.effects.items()
        ],
        "unused": [{"observation": key, "why": EFFECTS["none"]} for key in found.unused],
    }


OUTSIDE = {"sigma": "sigma_um", "tau": "tau_um"}  # a number's name where people read it


def _inferred(found: Inference) -> dict:
    """What all readings say together: each law's numbers with intervals of 95 %, and how it meets what was read."""
    return {
        "law": found.law.name,
        "meets_all": found.law.meets,
        "laws": [
            {
                "law": each.name,
                "meets_all": each.meets,
                "numbers": {
                    OUTSIDE.get(name, name): {
                        "value": number.value,
                        "low": number.low,
                        "high": number.high,
                        "decided_by": number.decided_by or None,
                    }
                    for name, number in each.numbers.items()
                },
                "missed_by_doubts": dict(each.misses),
                "cannot_make": list(each.unexplained),
            }
            for each in found.laws
        ],
        "readings": [
            {"observation": each.key, "text": reading(each), "set_aside": each.key in found.set_aside}
            for each in found.given.observations
        ],
    }


def _silent(rule) -> dict:
    return {"rule": rule.__name__, "section": rule.section, "about": rule.__doc__.splitlines()[0]}


def _material(found: Recommendation) -> dict:
    """What is now known, and where each value comes from."""
    sections = {a.rule: a for a in found.advice}
    out = {}
    for name, (outside, convert) in SHOWN.items():
        value = getattr(found.material, name)
        if value is None:
            continue
        if convert:
            value = convert(value)
        elif isinstance(value, tuple) and len(value) == 1:
            value = value[0]
        out[outside] = {"value": value, "from": "observed"}
        if rule := found.material.filled_by.get(name):
            advice = sections[rule]
            out[outside] |= {"from": "guess" if advice.guess else "rule", "rule": rule, "section": advice.section}
    return out


def _candidate(each: Proposal, timing: bool) -> dict:
    entry = {
        "model": each.model.name,
        "start": _typed(each),
        "why": each.why,
        "rules": list(each.rules),
        "cannot": list(each.cannot),
        "growth_10_to_75_deg": {
            "at_mirror": each.rise.at_mirror,
            "greatest": each.rise.greatest,
            "mirror_term": each.rise.mirror_term,
        },
        "gloss_gu": {str(angle): round(value, 2) for angle, value in each.gloss.items()} if each.gloss else None,
    }
    return entry | ({"time_per_sample_ns": round(each.ns_per_sample, 1)} if timing else {})


def _typed(each: Proposal) -> dict:
    """Start values as users type them: angles in degrees, four significant digits.

    What belongs to channels is a list, with one value where all are alike.
    """
    parameters = each.model.parameters

    def turn(key, value):
        return float(f"{degrees(value) if parameters[key].unit == 'rad' else value:.4g}")

    typed: dict[str, float | list[float]] = {}
    for key, value in each.start.items():
        if isinstance(value, tuple) or parameters[key].per_channel:
            values = value if isinstance(value, tuple) else (value,)
            typed[key] = [turn(key, v) for v in values]
        else:
            typed[key] = turn(key, value)
    return typed
