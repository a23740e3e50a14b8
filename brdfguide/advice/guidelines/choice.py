"""Finish and kind to models, in order (section 5.2). Names of sums only; start values are `starting`'s.

The most complex model is never preferred for being complex: the report's metallic paint is served best by Phong's.
"""

from math import degrees, pi
from typing import cast

from ...physics import gloss
from ..evidence import shows_highlight
from ..inference import Inference
from ..material import Material, said_to_be_grained
from ..start_values import GRAIN
from .guideline import Advice, rule

SURE = 3.0  # repeatabilities of a glossmeter by which a coat must miss a mirror's reading (ours)
BRIGHT = 0.5  # albedo from which on light that a coat sends down again counts: a fifth of it at n 1.5 (ours)

SAMPLES = {
    "rough aluminium": "section 4.1: aluminium on anti-glare glass",
    "rough plastic": "section 4.2: an off-white computer case",
    "white paper": "section 4.3: an office sheet",
    "nearly smooth steel": "section 4.4: hand-lapped stainless steel",
    "metallic paint": "section 4.5: automotive paint with flakes under a clear coat",
}


def body(material: Material) -> str:
    """The subsurface term as a prefix of a sum."""
    return "" if material.subsurface == "none" else "lambertian+"


def waves_show(material: Material) -> bool:
    """Whether sigma is known and near enough to the wavelength for wave optics to differ from facets (g below 20)."""
    if material.sigma is None or material.emerges is False:
        return False
    return bool(material.emerges) or (4 * pi * material.sigma / (material.wavelength or 0.55)) ** 2 < 20


@rule("4.5, 5.2")
def flake_paint(material: Material) -> Advice | None:
    """Flakes under a coat: tilted platelets seen through it; and the report's own choice, a general lobe."""
    if material.subsurface != "lobe":
        return None
    smooth = material.finish in (None, "mirror", "high gloss")
    coat = "mirror" if smooth else "ggx"
    under = "coated:flakes" if smooth else "ggx+coated:flakes"
    what = "a Fresnel mirror for the coat" if smooth else f"a rough interface for the {material.finish} coat"
    says = (
        f"flakes under a clear coat, through which their lobe looks n times wider than they lie and does not grow "
        f"toward grazing; {what}"
    )
    report = f"the report's own choice: Phong's lobe for the flakes, and {what}; Lafortune's matches, Ward's is third"
    return Advice(
        says,
        "metallic flake",
        prefers=(under, *(f"{lobe}+{coat}" for lobe in ("phong", "lafortune", "phong-lewis", "ward"))),
        why={f"phong+{coat}": report},
    )


@rule("5.2")
def mirror_finish(material: Material) -> Advice | None:
    """A mirror finish: Fresnel's equations, or a constant on a metal."""
    if material.finish != "mirror" or material.subsurface == "lobe" or material.kind is None:
        return None
    rough = (f"{body(material)}he-torrance",) if waves_show(material) else ()
    what = "Fresnel's mirror, or a constant on this metal" if material.kind == "metal" else "Fresnel's mirror"
    says = what + (" over the Lambertian body" if material.subsurface == "lambertian" else "")
    return Advice(says, "a mirror finish", prefers=(f"{body(material)}mirror", *rough))


@rule("4.4, 5.2")
def nearly_smooth_metal(material: Material) -> Advice | None:
    """Neither a plain mirror nor a mirror with Phong for lights will do for nearly smooth metal."""
    if (
        material.kind != "metal"
        or material.finish not in ("mirror", "high gloss")
        or material.sigma is None
        or material.sigma < 0.01
    ):
        return None
    return Advice(
        (
            "a plain mirror loses the sun's highlight and the blur that sharpens at grazing; a mirror with Phong for "
            "lights still loses the blur"
        ),
        "a slightly rough metal",
    )


@rule("5.2")
def high_gloss(material: Material) -> Advice | None:
    """High gloss: He-Torrance, for the wave effects; Stam's is much the same on metals."""
    if material.finish != "high gloss" or material.subsurface == "lobe" or material.kind not in ("metal", "dielectric"):
        return None
    metal = material.kind == "metal"
    other = "; Stam's is as good on metals" if metal else ""
    names = (f"{body(material)}he-torrance", f"{body(material)}ggx", f"{body(material)}beckmann", *["stam"] * metal)
    says = f"He-Torrance's law, which has the blurred highlight and the sharp mirror image together{other}"
    return Advice(says, "a high gloss", prefers=names)


@rule("4.1, 5.2")
def low_gloss_metal(material: Material) -> Advice | None:
    """Metals below high gloss: Ward, or He-Torrance where a mirror image emerges."""
    if material.kind != "metal" or material.finish in ("mirror", "high gloss"):
        return None
    names = ("ward", "he-torrance", "ggx", "beckmann")
    if material.emerges or waves_show(material):
        says = (
            "He-Torrance's law, since a mirror image shows at low angles"
            if material.emerges
            else "He-Torrance's law, since the roughness is near the wavelength of light"
        )
        return Advice(
            f"{says}; Ward's law is enough for the highlight alone",
            "a metal below high gloss",
            prefers=("he-torrance", "ward", "ggx"),
        )
    return Advice(
        "Ward's law; laws of small facets brighten more toward grazing, where this metal is to do so",
        "a metal below high gloss, no mirror image known",
        prefers=(*names, *["ggx-ms"] * (material.finish == "matt")),
    )


@rule("4.2, 4.3, 5.2")
def low_gloss_dielectric(material: Material) -> Advice | None:
    """Dielectrics below high gloss: a lobe with Fresnel's factor, He-Torrance where sigma is known."""
    if material.kind != "dielectric" or material.subsurface == "lobe" or material.finish in ("mirror", "high gloss"):
        return None
    drops = dict.fromkeys(
        ("ward", "phong", "phong-lewis", "blinn"),
        "its highlight brightens too little toward grazing for what is no metal",
    )
    if material.gloss:
        drops["lafortune"] = (
            "one lobe of it that brightens as the index says stays as wide, and would read two or three times the "
            "gloss at 60 degrees"
        )
    if waves_show(material):
        says = (
            "He-Torrance's law, since a mirror image shows at low angles"
            if material.emerges
            else "He-Torrance's law, since the roughness is near the wavelength of light"
        )
        lobes = ("he-torrance", "ggx", "lafortune")
    elif material.filled_by.get("sigma") == "roughness_of_all_readings":
        says = "He-Torrance's law, with the numbers that the readings gave"
        lobes = ("he-torrance", "ggx", "lafortune")
    elif material.finish == "matt" and material.subsurface == "lambertian":
        says = (
            "GGX, which brightens toward grazing as the index says; on the report's paper Lafortune's law fitted best, "
            "but its numbers take a measurement"
        )
        lobes = ("ggx", "lafortune", "he-torrance")
    else:
        known = (
            "with roughness so far above the wavelength of light He-Torrance's law is the same"
            if material.sigma
            else "He-Torrance's law would need the height of the roughness (sigma), which nothing observed tells"
        )
        says = f"GGX, a highlight of small facets that brightens toward grazing as the index says; {known}"
        lobes = ("ggx", "he-torrance", "lafortune")
    names = [f"{body(material)}{lobe}" for lobe in lobes]
    return Advice(says, "a dielectric below high gloss", prefers=tuple(names), drops=drops)


def _less_than_a_mirror(material: Material) -> str:
    """The gloss reading that lies most below that of a smooth surface of this index; "" where none does."""
    if not material.gloss or material.n is None or "alpha" not in material.filled_by:
        return ""
    n, white = material.n[len(material.n) // 2], sum(material.albedo or (0.0,)) / len(material.albedo or (0.0,))
    readings = dict(material.gloss)
    smooth = {angle: gloss.mirror_units(angle, n) + white * gloss.DIFFUSE[angle] for angle in readings}
    angle = min(readings, key=lambda each: readings[each] / smooth[each])
    if smooth[angle] - readings[angle] <= SURE * gloss.tolerance(smooth[angle]):
        return ""
    return f"its gloss of {readings[angle]:g} at {angle}° is less than the {smooth[angle]:.0f} of a smooth one"


def _met_by(material: Material) -> str:
    """The law that gives the readings, of those that inference tries."""
    return cast(Inference, material.inference).law.name if material.inference else "ggx"


@rule("4.5")
def coated(material: Material) -> Advice | None:
    """A clear coat over a solid body or a metal: the coat's mirror added."""
    if material.coat != "clear" or material.subsurface == "lobe" or material.kind is None:
        return None
    if material.kind == "metal":
        return Advice(
            "the metal's highlight, seen through the coat, and the coat's own mirror image",
            "a clear coat on a metal",
            prefers=("coated:ggx", "ward+mirror", "ggx+mirror"),
        )
    bright = material.subsurface == "lambertian" and max(material.albedo or (0.0,)) >= BRIGHT
    darkened = ("coated:lambertian",) if material.subsurface == "lambertian" else ()
    plain = (f"{body(material)}mirror", f"{body(material)}he-torrance")
    dull = _less_than_a_mirror(material)
    if dull:
        says = f"the coat is no mirror: {dull}; its blurred highlight over the body"
        return Advice(
            says, "a clear coat that is slightly rough", prefers=(f"{body(material)}{_met_by(material)}", *plain)
        )
    return Advice(
        "the coat's mirror image over the body; the coat sends part of the body's light down again, which counts where "
        "the body is bright"
        if bright
        else "the coat's mirror image over the body",
        "a clear coat over a bright body" if bright else "a clear coat",
        prefers=(*darkened, *plain) if bright else (*plain, *darkened),
    )


@rule("5.2")
def kind_open(material: Material) -> Advice | None:
    """Neither metal nor dielectric is known: one candidate of each."""
    if material.kind in ("metal", "dielectric"):
        return None
    names: tuple[str, ...]
    if material.finish == "mirror":
        names = ("mirror",) if material.n is not None else ("lambertian+mirror", "mirror")
        return Advice("Fresnel's mirror, whichever kind it is", "a mirror finish, kind not known", prefers=names)
    dark = material.appearance == "black"
    names = ("ggx", "he-torrance") if dark else ("lambertian+ggx", "ggx", "lambertian+he-torrance")
    return Advice("a candidate for each kind, since neither is known; do not mix them", "kind not known", prefers=names)


@rule("3.1, 3.2.2")
def steep_with_highlight(material: Material) -> Advice | None:
    """Steep bumps, and a highlight all the same: Oren-Nayar's body under the lobe that gives it."""
    if not material.steep or material.subsurface != "lambertian" or not shows_highlight(material):
        return None
    says = "Oren-Nayar's body for the steep bumps, and a lobe above it for the highlight that was seen"
    return Advice(says, "steep, with a highlight", prefers=(f"oren-nayar+{_met_by(material)}", "oren-nayar"))


@rule("3.1")
def grained(material: Material) -> Advice | None:
    """A grain: GGX with two widths, in the ratio that was seen or that is usual."""
    if not said_to_be_grained(material):
        return None
    prefers, aspect = (f"{body(material)}ggx-aniso",), material.highlight_aspect
    turn = (
        "turn `axis` until it lies across the grain"
        if material.grain_deg is None
        else f"`axis` lies across the grain, at {(material.grain_deg + 90) % 180:.3g} degrees"
    )
    round_brushing = "; where the brushing goes round, the axis is a texture of tangents"
    if aspect is None:
        usual = f"{GRAIN:g} times as wide across it as along it, which is usual for brushed metal (1.5 to 10)"
        return Advice(f"GGX with a grain, {usual}; {turn}{round_brushing}", "a surface that changes as it turns",
                      prefers=prefers, guess=True)  # fmt: skip
    says = f"GGX with a grain, {aspect:g} times as wide across it as along it; {turn}{round_brushing}"
    return Advice(says, f"its streak is {aspect:g} times as long as wide, near normal", prefers=prefers)


@rule("3.1")
def seen_through_rough_glass(material: Material) -> Advice | None:
    """What to type for the light that goes through a clear body whose surface is rough."""
    if material.appearance != "clear" or not material.alpha or material.alpha < 0.02 or material.kind == "metal":
        return None
    n = material.n[len(material.n) // 2] if material.n else 1.5
    says = (
        f"for what is seen through it, type transmission 1, index {n:.3g}, roughness {material.alpha**0.5:.2f} "
        f"(the square root of alpha {material.alpha:.2g}) and a white base colour in the renderer, which would else "
        f"tint it; the models here only reflect, and have black there"
    )
    return Advice(says, "a clear body with a rough surface", domain="flagged")


@rule("5.2")
def nearest_sample(material: Material) -> Advice | None:
    """Compare with the report's five surfaces."""
    sample, why = sample_like(material)
    if sample is None:
        return None
    what = SAMPLES[sample].partition(": ")[2]
    return Advice(f"of the five surfaces that the report measured it is most like the {sample} ({what})", why)


def sample_like(material: Material) -> tuple[str | None, str]:
    """(one of SAMPLES, why)."""
    if material.subsurface == "lobe":
        return "metallic paint", "flakes under a clear coat"
    if material.kind == "metal":
        if material.finish in ("mirror", "high gloss") or (
            material.emergence is not None and degrees(material.emergence) < 30
        ):
            return "nearly smooth steel", "a metal that shows a mirror image near the normal"
        return "rough aluminium", "a metal with a lobe"
    if material.kind == "dielectric" and material.subsurface == "lambertian":
        if material.finish == "matt":
            return "white paper", "a matt Lambertian body whose lobe shows only toward grazing"
        if material.finish in ("mirror", "high gloss"):
            return (
                "rough plastic",
                (
                    "a Lambertian body, though this one is glossier than any of the five: its surface is more like "
                    "the paint's coat"
                ),
            )
        return "rough plastic", "a Lambertian body under a visible lobe"
    if material.kind == "dielectric":
        return "rough plastic", "a dielectric interface, though none of the five lacks a body"
    return None, ""


@rule("3.2.1, 4.2")
def nearest_is_far(material: Material) -> Advice | None:
    """None of the five is bare glass, black, or a glossy solid colour."""
    if (
        material.kind != "dielectric"
        or (material.subsurface == "lambertian" and material.finish not in ("mirror", "high gloss"))
        or material.subsurface == "lobe"
    ):
        return None
    return Advice(
        "none of the five surfaces that the report measured is like this one: the advice rests on physics alone",
        "a dielectric without a body, or a glossy one",
    )


RULES = (
    steep_with_highlight,
    grained,
    flake_paint,
    coated,
    mirror_finish,
    nearly_smooth_metal,
    high_gloss,
    low_gloss_metal,
    low_gloss_dielectric,
    kind_open,
    seen_through_rough_glass,
    nearest_sample,
    nearest_is_far,
)
