"""A recommendation as one dict for programs, and as text for people."""

from math import degrees

from ..guidelines.choice import sample_like
from ..recommend import Candidate, Recommendation
from . import table

# filled field of a Material -> name outside, factor
SHOWN = {
    "kind": ("kind", None), "composition": ("composition", None), "appearance": ("appearance", None), "finish": ("finish", None),
    "coat": ("coat", None), "subsurface": ("subsurface", None), "f0": ("f0", None), "n": ("n", None), "k": ("k", None),
    "albedo": ("albedo", None), "alpha": ("alpha", None), "slope": ("slope", None), "sigma": ("sigma_um", None), "tau": ("tau_um", None),
    "emergence": ("emergence_angle_deg", degrees), "highlight_width": ("highlight_width_deg", degrees),
}  # fmt: skip


def document(found: Recommendation, timing: bool = True, explain: bool = True) -> dict:
    """`brdfguide recommend --json` of one description (CLI contract)."""
    return {
        "schema": "brdfguide/recommend/1",
        "name": found.material.name,
        "material": _material(found),
        "domain": {"status": found.status, "reasons": [{"rule": a.rule, "section": a.section, "status": a.domain, "text": a.says, "needs": a.needs or None} for a in found.reasons]},
        "verdict": {"kind": found.verdict, "evidence": found.evidence},
        "nearest_sample": dict(zip(("name", "why"), sample_like(found.material))),
        "recommended": found.candidates[0].model.name if found.candidates else None,
        "candidates": [_candidate(each, timing) for each in found.candidates],
        "advice": [
            {"rule": a.rule, "section": a.section, "says": a.says, "because": a.because, "sets": sorted(a.sets), "guess": a.guess, "conflict": a.conflict}
            for a in found.advice
        ],
        "silent": [{"rule": each.__name__, "section": each.section} for each in found.silent] if explain else [],
        "conflicts": [{"code": a.rule, "text": f"{a.says} ({a.because})"} for a in found.conflicts],
        "left_out": [{"term": name, "why": why} for name, why in found.left_out.items()],
        "unused": [{"observation": key, "why": why} for key, why in found.unused],
    }  # fmt: skip


def _material(found: Recommendation) -> dict:
    """What is now known, and where each value comes from."""
    sections = {a.rule: a for a in found.advice}
    out = {}
    for name, (outside, convert) in SHOWN.items():
        value = getattr(found.material, name)
        if value is None:
            continue
        rule = found.material.filled_by.get(name)
        origin = "observed" if rule is None else "guess" if sections[rule].guess else "rule"
        value = convert(value) if convert else value[0] if isinstance(value, tuple) and len(value) == 1 else value
        out[outside] = {"value": value, "from": origin} | ({"rule": rule, "section": sections[rule].section} if rule else {})
    return out


def _candidate(each: Candidate, timing: bool) -> dict:
    entry = {
        "model": each.model.name,
        "start": typed(each),
        "why": each.why,
        "rules": list(each.rules),
        "cannot": list(each.cannot),
        "growth_10_to_75_deg": {"at_mirror": each.rise.at_mirror, "greatest": each.rise.greatest, "mirror_term": each.rise.mirror_term},
        "gloss_gu": {str(angle): round(value, 2) for angle, value in each.gloss.items()} if each.gloss else None,
    }
    return entry | ({"time_per_sample_ns": round(each.ns_per_sample, 1)} if timing else {})


def typed(each: Candidate) -> dict:
    """Start values as users type them: angles in degrees, four significant digits."""
    units = {key: p.unit for key, p in each.model.parameters.items()}
    turn = lambda key, value: float(f"{degrees(value) if units[key] == 'rad' else value:.4g}")  # noqa: E731
    return {key: [turn(key, v) for v in value] if isinstance(value, tuple) else turn(key, value) for key, value in each.start.items()}




def text(found: Recommendation, explain: bool = False, timing: bool = True) -> str:
    """For people: the pick with its numbers, why, what was guessed, what is doubtful, what it cannot do."""
    lines = [f"{found.material.name or 'material'}: {found.verdict} ({found.evidence}); {found.status} the guide's domain".replace("flagged the", "flagged within the")]
    for each in found.reasons:
        lines.append(f"  {each.domain}: {each.says}" + (f"; needs {each.needs}" if each.needs else "") + f"  [{each.section}]")
    if found.candidates:
        pick = found.candidates[0]
        lines += ["", f"recommended: {pick.model.name}", f"  {_values(pick)}", f"  because {pick.why}"]
        lines += [f"  cannot: {each}" for each in pick.cannot]
        header = ("candidate", "growth 10 to 75 deg", "gloss 20/60/85", *(("ns",) if timing else ()), "start values")
        rows = [(c.model.name, _growth(c), _gloss(c), *((f"{c.ns_per_sample:.0f}",) if timing else ()), _values(c)) for c in found.candidates]
        lines += ["", table.columns(header, rows, right=(3,) if timing else ())]
    else:
        lines += ["", "no model is recommended: " + (found.reasons[0].says if found.reasons else "nothing fits")]
    answered = bool(found.candidates) or explain
    for title, rules in (
        ("observed or inferred", [a for a in found.advice if answered and not (a.guess or a.conflict or a.domain)]),
        ("guessed", found.guesses if answered else ()),
        ("contradictory", found.conflicts),
    ):
        if rules:
            lines += ["", f"{title}:"] + [f"  {a.says}  <- {a.because}  [{a.section}]" for a in rules]
    if found.left_out and answered:
        lines += ["", "left out: " + _grouped(found.left_out.items())]
    if found.unused:
        lines += ["", "unused: " + _grouped(found.unused)]
    if explain:
        lines += ["", "silent rules:"] + [f"  {rule.__name__}: {rule.__doc__.splitlines()[0]}  [{rule.section}]" for rule in found.silent]
    return "\n".join(lines)


def _grouped(pairs) -> str:
    """`a, b (why); c (why)`."""
    by_reason = {}
    for name, why in pairs:
        by_reason.setdefault(why, []).append(name)
    return "; ".join(f"{', '.join(names)} ({why})" for why, names in by_reason.items())


def _values(each: Candidate) -> str:
    """name=value, ready to type."""
    word = lambda value: ",".join(f"{v:g}" for v in value) if isinstance(value, list) else f"{value:g}"  # noqa: E731
    return " ".join(f"{key}={word(value)}" for key, value in typed(each).items())


def _growth(each: Candidate) -> str:
    parts = [f"x{each.rise.at_mirror:.3g}"] if each.rise.at_mirror else []
    return " ".join(parts + ([f"mirror x{each.rise.mirror_term:.3g}"] if each.rise.mirror_term else [])) or "-"


def _gloss(each: Candidate) -> str:
    return "/".join(f"{value:.0f}" for value in each.gloss.values()) if each.gloss else "-"
