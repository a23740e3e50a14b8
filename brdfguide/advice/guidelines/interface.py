"""Metal, dielectric, or "cannot tell from this", with the evidence (section 3.2.1). Never half a metal.

A verdict needs evidence that agrees. Observed `kind` stands; contradicting evidence is reported beside it.
"""

from ...physics.fresnel import f0 as normal_reflectance
from ...physics.substances import kind_of_words
from ..material import Material
from .guideline import Advice, rule

# Diamond's 0.172 is the report's "practical boundary for dielectrics"; rutile reaches 0.24. Of the metals that we know
# of, only titanium and tungsten fall below 0.5, to 0.45; germanium and silicon lie between.
DARKEST_METAL = 0.45  # F0
BRIGHTEST_DIELECTRIC = 0.25  # F0
MOST_GLOSS = {20: 354.0, 60: 223.0, 85: 114.0}  # units of polished diamond, n = 2.42


def evidence(material: Material) -> list[tuple[str, str]]:
    """(metal or dielectric, why) from each observation that tells; an observed kind is not among them."""
    found = []
    kind, word = kind_of_words(material.composition or "")
    if kind in ("metal", "dielectric"):
        found.append((kind, f"composition: '{word}' is a {kind}"))
    if material.metallic is not None:
        found.append(("metal" if material.metallic else "dielectric", f"metallic: {material.metallic:g}"))
    body = {
        "metal": "metal",
        "solid colour": "dielectric",
        "black": "dielectric",  # the darkest metal is a medium grey
        "metallic flake": "dielectric",
        "clear": "dielectric",
        "pearlescent": "dielectric",
        "fluorescent": "dielectric",
    }
    if material.appearance in body:
        found.append((body[material.appearance], f"appearance: {material.appearance}"))
    if material.n is not None and "n" not in material.filled_by:
        n, k = material.n, material.k or (0.0,)
        channels = max(len(n), len(k))  # one value stands for all
        pairs = zip(n * (channels // len(n)), k * (channels // len(k)), strict=True)
        reflectances = [(float(normal_reflectance(n, k)), k) for n, k in pairs]
        if min(r for r, _ in reflectances) >= DARKEST_METAL and max(k for _, k in reflectances) > 0.5:
            found.append(("metal", f"index: n + ik reflects {min(r for r, _ in reflectances):.2f} or more"))
        elif max(r for r, _ in reflectances) <= BRIGHTEST_DIELECTRIC and max(k for _, k in reflectances) < 0.1:
            found.append(("dielectric", f"index: n without k reflects {max(r for r, _ in reflectances):.3f}"))
    if material.f0 is not None:
        if min(material.f0) >= DARKEST_METAL or (max(material.f0) >= 0.6 and min(material.f0) > BRIGHTEST_DIELECTRIC):
            found.append(("metal", f"F0 = {max(material.f0):.2f}: no dielectric reflects that much"))
        elif max(material.f0) <= 0.18:
            found.append(("dielectric", f"F0 = {max(material.f0):.3f}: no metal reflects so little"))
    glossy = [
        f"{reading:g} at {angle}°" for angle, reading in (material.gloss or {}).items() if reading > MOST_GLOSS[angle]
    ]
    if glossy:
        found.append(("metal", f"gloss of {', '.join(glossy)}: no dielectric reads so much"))
    if material.highlight_colour == "tinted":
        found.append(("metal", "the highlight has the surface's colour, not the lamp's"))
    return found


@rule("3.2.1")
def evidence_disagrees(material: Material) -> Advice | None:
    """Observations that speak for a metal and others that speak for a dielectric."""
    found = evidence(material)
    kinds = {kind for kind, _ in found} | ({material.kind} & {"metal", "dielectric"})
    if len(kinds) < 2:
        return None
    reasons = [why for _, why in found] + ([f"kind: {material.kind}, as observed"] if material.kind else [])
    return Advice(
        "some observations speak for a metal, others for a dielectric; one of them is wrong",
        "; ".join(reasons),
        conflict=True,
        domain="flagged",
    )


@rule("3.2.1")
def kind_from_evidence(material: Material) -> Advice | None:
    """Metal or dielectric by name, look, index, F0 or the highlight's colour, where all that tells agrees."""
    found = evidence(material)
    if material.kind is not None or len({kind for kind, _ in found}) != 1:
        return None
    return Advice(found[0][0], "; ".join(why for _, why in found), sets={"kind": found[0][0]})


@rule("3.2.1")
def kind_cannot_be_told(material: Material) -> Advice | None:
    """Without evidence both kinds stay open; there is no such thing as half a metal."""
    if material.kind is not None:
        return None
    says = (
        "metal or dielectric: cannot tell from this; both are kept. F0, the name of the substance or the highlight's "
        "colour would tell"
    )
    return Advice(says, "no observation tells, or they disagree")


@rule("5.1")
def bright_dielectric(material: Material) -> Advice | None:
    """A dielectric with an F0 above 0.2 is hardly one: diamond has 0.172."""
    if material.kind != "dielectric" or material.f0 is None or max(material.f0) <= 0.2:
        return None
    says = f"F0 = {max(material.f0):.2f} is above 0.2, and diamond has 0.172: metal, or not a smooth sample?"
    return Advice(says, "kind against F0", conflict=True, domain="flagged")


@rule("3.2.1")
def coloured_dielectric_highlight(material: Material) -> Advice | None:
    """On a dielectric the highlight keeps the lamp's colour."""
    if (
        material.kind != "dielectric"
        or material.f0 is None
        or len(material.f0) == 1
        or max(material.f0) < 1.5 * min(material.f0)
    ):
        return None
    return Advice(
        "F0 differs by channel more than a dielectric's can",
        f"F0 from {min(material.f0):.3f} to {max(material.f0):.3f}",
        conflict=True,
        domain="flagged",
    )


RULES = (evidence_disagrees, kind_from_evidence, kind_cannot_be_told, bright_dielectric, coloured_dielectric_highlight)
