"""Whether the report speaks about this surface at all (section 3.1, D1 to D9)."""

from ...physics.substances import kind_of_words
from ..evidence import shows_highlight
from ..material import Material, said_to_be_grained
from .guideline import Advice, rule


@rule("3.1")
def opaque(material: Material) -> Advice | None:
    """Light that enters must leave, or die, within a distance that is small in the picture (D1)."""
    if material.light_bleed_mm is None:
        return None
    if material.pixel_mm is None:
        if material.light_bleed_mm < 0.1:
            return None
        says = f"light spreads {material.light_bleed_mm:g} mm below the surface; in close views that is visible"
        return Advice(
            says, "light bleed given without the pixel's footprint", domain="flagged", needs="a BSSRDF in close views"
        )
    if material.light_bleed_mm <= material.pixel_mm:
        return Advice(
            "opaque at this scale",
            f"light spreads {material.light_bleed_mm:g} mm, less than the {material.pixel_mm:g} mm of a pixel",
        )
    says = (
        f"light spreads {material.light_bleed_mm:g} mm, over {material.light_bleed_mm / material.pixel_mm:.3g} "
        f"pixels: no BRDF can show that"
    )
    return Advice(
        says, "light bleed against the pixel's footprint", domain="outside", needs="subsurface transport (a BSSRDF)"
    )


@rule("3.1")
def transparent_body(material: Material) -> Advice | None:
    """What is seen through a clear body is no part of its BRDF (D1)."""
    if material.appearance != "clear":
        return None
    says = "the BRDF holds what the surface reflects; what is seen through it needs refraction"
    return Advice(
        says, "a clear body", domain="flagged", needs="a refracting interface (BSDF) for what is seen through it"
    )


@rule("3.1")
def height_field(material: Material) -> Advice | None:
    """One well-defined interface: no hair, velvet or foam (D2)."""
    needs = {
        "hair": "a fibre model",
        "fur": "a fibre model",
        "velvet": "its weave and the lie of its pile, close by",
        "cloth": "a woven fabric model",
        "foam": "a volume or a BSSRDF",
        "foliage": "leaf geometry with a two-sided leaf model",
        "granular": "geometry or a volume of grains",
    }
    if material.structure not in needs:
        return None
    status = "flagged" if material.structure in ("granular", "cloth", "velvet") else "outside"
    fibres = material.structure in ("cloth", "velvet")
    rim = "; the glow at its rim by Charlie's sheen over a body, of usual width and strength" if fibres else ""
    return Advice(
        f"{material.structure}: not one surface with bumps, which such laws are made for{rim}",
        f"structure: {material.structure}",
        domain=status,
        needs=needs[material.structure],
        prefers=("lambertian+sheen", "oren-nayar+sheen") if fibres else (),
    )


@rule("3.1")
def random_roughness(material: Material) -> Advice | None:
    """No grating, weave or print (D3)."""
    if material.texture in (None, "random", "brushed"):
        return None
    needs = {
        "grating": "a diffraction model",
        "woven": "a woven fabric model",
        "printed": "a texture of several BRDFs",
        "machined": "an anisotropic or diffraction model",
    }
    status = "outside" if material.texture == "grating" else "flagged"
    return Advice(
        f"a {material.texture} surface is rough in a regular way",
        f"texture: {material.texture}",
        domain=status,
        needs=needs[material.texture],
    )


@rule("3.1")
def isotropic(material: Material) -> Advice | None:
    """The highlight must not change as the sample turns in its plane (D4)."""
    grained = said_to_be_grained(material)
    if material.changes_when_turned is None and not grained:
        return None
    if material.changes_when_turned is False and not grained:
        return Advice("isotropic", "the highlight does not change as the sample turns")
    if material.changes_when_turned is False:
        said = "brushed" if material.texture == "brushed" else "drawn out to a streak"
        return Advice(
            f"said to be {said}, yet unchanged as it turns; one of the two is wrong",
            "texture against rotation",
            domain="flagged",
            conflict=True,
        )
    if material.texture == "brushed" and material.streak not in (None, "across the grain"):
        seen = "no streak" if material.streak == "none" else "a streak along the grain"
        return Advice(
            f"said to be brushed, yet with {seen}: brushing draws a highlight out across its grooves",
            "texture against streak",
            domain="flagged",
            conflict=True,
        )
    evidence = "brushed"
    if material.texture != "brushed":
        turned = material.changes_when_turned or material.turned_90_brighter
        evidence = "the highlight changes as the sample turns" if turned else "the highlight is a streak"
    told = material.highlight_aspect is not None and (material.highlight_width or material.alpha) is not None
    needs = "" if told else "its widths along and across the grain, which nothing here tells"
    says = "anisotropic: the highlight is a streak across the grain"
    return Advice(says, evidence, domain="flagged", needs=needs)


@rule("3.1, 3.2.2")
def moderate_slopes(material: Material) -> Advice | None:
    """Smooth to quite rough, but not sandpaper, unglazed ceramic or flat house paint (D5)."""
    if not material.steep:
        return None
    says = "bumps too steep for such laws: they shadow each other, and light meets several before it leaves"
    return Advice(
        says,
        "steep, like sandpaper or flat house paint",
        domain="flagged",
        needs="Oren-Nayar for the body",
        prefers=() if shows_highlight(material) else ("oren-nayar", "oren-nayar+ggx"),
    )


@rule("3.1, 3.2.3")
def known_subsurface(material: Material) -> Advice | None:
    """Only a Lambertian body, a flake lobe, or none (D6)."""
    needs = {
        "pearlescent": "a thin-film or flake model whose colour turns with angle",
        "fluorescent": "a reradiation matrix; no BRDF shifts wavelengths",
    }
    if material.appearance not in needs:
        return None
    return Advice(
        f"{material.appearance} light from below the surface",
        f"appearance: {material.appearance}",
        domain="flagged",
        needs=needs[material.appearance],
    )


@rule("3.2.1")
def metal_or_dielectric(material: Material) -> Advice | None:
    """Semiconductors are ignored by the report (D7)."""
    named = kind_of_words(material.composition or "")[0]
    if material.kind != "semiconductor" and not (material.kind is None and named == "semiconductor"):
        return None
    says = "semiconductors are left out of the report; its rules for metals and dielectrics are both guesses here"
    return Advice(
        says,
        "kind: semiconductor" if material.kind else f"composition: {material.composition}",
        domain="flagged",
        needs="its own n and k",
    )


@rule("6.1")
def no_retroreflection(material: Material) -> Advice | None:
    """None of the four models returns light to where it came from (D8)."""
    if not material.retroreflective:
        return None
    says = (
        "brightest toward the light: a lobe back to where the light comes from, of the strength of reflective sheeting"
    )
    return Advice(
        says,
        "retroreflective",
        domain="flagged",
        needs="a reading toward the light (RA), from which its height follows",
        prefers=("lambertian+retro", "lambertian+ggx+retro"),
    )


@rule("4, 6.1")
def in_plane_evidence(material: Material) -> Advice | None:
    """The report compared the models in the plane of incidence only (D9)."""
    if not material.off_plane:
        return None
    return Advice(
        "the measurements behind this advice were made with light, eye and normal in one plane only",
        "seen out of the plane",
        domain="flagged",
        needs="measurements over the hemisphere",
    )


RULES = (
    opaque,
    transparent_body,
    height_field,
    random_roughness,
    isotropic,
    moderate_slopes,
    known_subsurface,
    metal_or_dielectric,
    no_retroreflection,
    in_plane_evidence,
)
