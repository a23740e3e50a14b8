"""What comes from below the surface: a Lambertian body, a flake lobe, or nothing; and how much (section 5.2)."""

from ...physics import coat
from ...physics import colorchecker as chart
from ..material import Material
from ..start_values import FLAKE_SHARE, WATER_N
from .guideline import Advice, rule

# A body of unknown lightness: the photographic standard for medium grey (Westin et al. 2004, section 5.2).
MEDIUM_GREY = 0.18


def comparisons(material: Material) -> list[tuple[float, str]]:
    """(albedo, by what) from each comparison that was made with a known reflectance."""
    found = []
    meter, card = material.photometer or {}, material.colorchecker or {}
    if meter and meter.get("of", "diffuse") == "diffuse":
        found.append(
            (
                chart.from_ratio(meter["ratio"], meter["reference"]),
                f"photometer: {meter['ratio']:g} of a reference of {meter['reference']:g}",
            )
        )
    data_set = card.get("data_set", "average")
    if "patch" in card:
        found.append((chart.patch(card["patch"], data_set), f"ColorChecker {card['patch']}, data set {data_set}"))
    if "between" in card:
        first, second = card["between"]
        found.append(
            (
                chart.between(first, second, card["position"], data_set),
                (
                    f"ColorChecker {card['position']:g} of the way from {first} to {second} in lightness, data set "
                    f"{data_set}"
                ),
            )
        )
    return found


@rule("3.2.3, 5.2")
def none_in_metal(material: Material) -> Advice | None:
    """A metal absorbs within a fraction of a wavelength: no subsurface term."""
    if material.kind != "metal" or material.subsurface is not None:
        return None
    return Advice(
        "no subsurface term",
        "a metal",
        sets={"subsurface": "none"},
        drops={"lambertian": "a metal has no light from below its surface"},
    )


@rule("3.2.3, 5.2")
def body_seen_on_metal(material: Material) -> Advice | None:
    """A diffuse reflectance measured on a metal is its wide lobe, or a coat's, not a body's."""
    if material.kind != "metal" or not (material.albedo or comparisons(material)):
        return None
    return Advice(
        "the diffuse reflectance of a bare metal is part of its lobe; it is not used as an albedo",
        "diffuse reflectance on a metal",
        domain="flagged" if material.coat == "clear" else "",
    )


@rule("3.2.3, 5.2")
def none_below_black(material: Material) -> Advice | None:
    """A black dielectric absorbs all that enters: no subsurface term."""
    if material.kind == "metal" or material.appearance != "black":
        return None
    if material.albedo and max(material.albedo) > 0.1:
        return Advice(
            f"said to be black, yet a diffuse reflectance of {max(material.albedo):.2f} was measured",
            "appearance against reflectometer",
            conflict=True,
        )
    return Advice(
        "no subsurface term",
        "black",
        sets={"subsurface": "none"},
        drops={"lambertian": "a black body absorbs what enters"},
    )


@rule("3.1, 5.2")
def none_in_clear(material: Material) -> Advice | None:
    """Light that enters a clear body goes through: nothing comes back near where it entered."""
    if material.kind == "metal" or material.appearance != "clear" or material.albedo or comparisons(material):
        return None
    return Advice(
        "no subsurface term",
        "a clear body",
        sets={"subsurface": "none"},
        drops={"lambertian": "light goes through a clear body"},
    )


@rule("4.5, 5.2")
def flakes_make_a_lobe(material: Material) -> Advice | None:
    """Metallic paint: a lobe from flakes below, a mirror from the coat above."""
    if material.appearance != "metallic flake":
        return None
    says = (
        "a lobe for the flakes and a Fresnel mirror for the coat; the lobe hardly grows toward grazing, so laws of a "
        "single interface do not fit it"
    )
    drops = {"lambertian": "flakes send light into a lobe", "he-torrance": "made for one interface (section 4.5)"}
    return Advice(says, "metallic flake", sets={"subsurface": "lobe", "coat": "clear"}, drops=drops)


@rule("3.2.3, 5.2")
def lambertian_body(material: Material) -> Advice | None:
    """Solid colours: a Lambertian body."""
    if material.subsurface is not None or material.kind != "dielectric":
        return None
    because = (
        "a solid colour"
        if material.appearance == "solid colour"
        else "a dielectric that is neither black, clear nor flaked"
    )
    return Advice(
        "a Lambertian body under the surface",
        because,
        sets={"subsurface": "lambertian"},
        guess=material.appearance != "solid colour",
    )


@rule("5, 5.2")
def albedo_observed(material: Material) -> Advice | None:
    """A reflectometer measures the diffuse reflectance almost directly, colour and all."""
    if material.albedo is None or "albedo" in material.filled_by or material.subsurface == "none":
        return None
    return Advice(
        f"albedo {', '.join(f'{value:.3g}' for value in material.albedo)}", "diffuse reflectance, as observed"
    )


@rule("5, 5.2")
def albedo_by_comparison(material: Material) -> Advice | None:
    """Compare with known reflectances: a photometer first, else a ColorChecker's neutral patches by eye."""
    found = comparisons(material)
    if material.albedo is not None or material.subsurface == "none" or not found:
        return None
    value, by = found[0]
    says = f"albedo {value:.3f} (L* = {chart.cie_lightness(value):.1f})" + (
        f"; {chart.NOT_LINEAR}" if by.startswith("ColorChecker") else ""
    )
    return Advice(says, by, sets={"albedo": (value,)})


@rule("5.2")
def comparisons_disagree(material: Material) -> Advice | None:
    """Two ways to the same reflectance that differ by more than the eye would."""
    found = comparisons(material)
    if material.albedo and "albedo" not in material.filled_by:
        found = [(sum(material.albedo) / len(material.albedo), "reflectometer"), *found]
    if (
        len(found) < 2
        or max(chart.cie_lightness(v) for v, _ in found) - min(chart.cie_lightness(v) for v, _ in found) <= 5
    ):
        return None
    return Advice(
        "the diffuse reflectances differ by more than 5 in L*; the first is used, nothing is averaged",
        "; ".join(f"{v:.3f} by {by}" for v, by in found),
        conflict=True,
    )


@rule("5.2")
def albedo_guess(material: Material) -> Advice | None:
    """No comparison was made: medium grey, which is a guess."""
    is_open = material.kind is None and material.subsurface is None and material.appearance != "black"
    if material.albedo is not None or material.subsurface != "lambertian" and not is_open:
        return None
    says = f"albedo {MEDIUM_GREY}, medium grey; compare with a grey scale instead: {chart.NOT_LINEAR}"
    return Advice(says, "no diffuse reflectance, no comparison", sets={"albedo": (MEDIUM_GREY,)}, guess=True)


@rule("5, 5.2")
def grey_by_assumption(material: Material) -> Advice | None:
    """A body or flakes whose colour nobody said."""
    if material.subsurface not in ("lambertian", "lobe") or (material.albedo and len(material.albedo) > 1):
        return None
    share = material.albedo[0] if material.albedo else FLAKE_SHARE
    flakes = "flakes that send back " if material.subsurface == "lobe" and not material.albedo else ""
    says = f"grey, {flakes}{share:.2g} in red, green and blue; a base_color or three reflectances would give its colour"
    return Advice(says, "no colour was given", guess=True)


@rule("3.2.3")
def water_over_it(material: Material) -> Advice | None:
    """A wet body is darker: its light comes back from under the water, which sends some of it down again."""
    if not material.wet or material.kind == "metal" or material.subsurface != "lambertian" or material.albedo is None:
        return None
    dry = max(material.albedo)
    says = (
        f"water over the body: an albedo of {dry:.2g} dry looks like {float(coat.seen_albedo(dry, WATER_N)):.2g} wet "
        f"(Lekner and Dorf 1988); pores that fill scatter less besides, so that cloth and sand are darker still"
    )
    return Advice(says, "wet", domain="flagged", prefers=("coated:lambertian", "lambertian+mirror"))


@rule("3.2.3")
def energy_of_body_and_surface(material: Material) -> Advice | None:
    """The surface takes its part first: a bright body under it must not give back more than enters."""
    if material.subsurface != "lambertian" or material.albedo is None or max(material.albedo) < 0.6:
        return None
    says = (
        f"a body as bright as {max(material.albedo):.2f} and the reflection above it together send back too much light "
        f"when seen at a low angle; there take `coupled` in place of `lambertian`"
    )
    return Advice(
        says, "a bright body; the report calls the coupling often negligible, which holds for views near the normal"
    )


RULES = (
    none_in_metal,
    body_seen_on_metal,
    none_below_black,
    none_in_clear,
    flakes_make_a_lobe,
    lambertian_body,
    albedo_observed,
    albedo_by_comparison,
    comparisons_disagree,
    albedo_guess,
    grey_by_assumption,
    water_over_it,
    energy_of_body_and_surface,
)
