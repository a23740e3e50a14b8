"""The index where nothing measured it: what is usual (section 5.1); and what each simplification costs."""

import numpy as np

from ...physics import fresnel, fresnel_simplifications, substances
from ..material import Material
from .guideline import Advice, rule

LIQUIDS = substances.vocabulary(
    "water ice liquid juice milk wine beer oil blood cola coffee tea vodka whiskey snow cream"
)


LOW_N, DENSE_N = 1.4, 1.6  # silicone and clay: four fifths of the dielectrics known by name lie between


@rule("5.1")
def liquid_index(material: Material) -> Advice | None:
    """Water, ice and most liquids lie below the usual 1.5."""
    if (
        material.n is not None
        or material.kind != "dielectric"
        or not LIQUIDS.intersection((material.composition or "").lower().split())
    ):
        return None
    return Advice(
        "n = 1.34, as for water", f"composition: {material.composition}", sets={"n": (1.34,), "k": (0.0,)}, guess=True
    )


@rule("5.1")
def usual_dielectric_index(material: Material) -> Advice | None:
    """Most dielectrics lie near n = 1.5."""
    if material.n is not None or material.kind != "dielectric":
        return None
    for_low, for_dense = fresnel_simplifications.index_cost(LOW_N), fresnel_simplifications.index_cost(DENSE_N)
    weaker, stronger = for_low / (1 + for_low), 1 / (1 + for_dense) - 1
    says = (
        f"n = 1.5, the usual value: plastics, paints, glass and stone lie between {LOW_N} and {DENSE_N}, with which "
        f"reflections would be up to {weaker:.0%} weaker or {stronger:.0%} stronger"
    )
    return Advice(says, "a dielectric without index, F0 or a known name", sets={"n": (1.5,), "k": (0.0,)}, guess=True)


@rule("5.1")
def usual_metal_index(material: Material) -> Advice | None:
    """A metal of unknown name: chromium's index, in the middle of the common metals."""
    if material.n is not None or material.kind != "metal":
        return None
    says = "n = 3.18, k = 4.41 (chromium, F0 = 0.66); metals reach from 0.5 to 0.96, so measure F0 or name the metal"
    return Advice(says, "a metal without index, F0 or a known name", sets={"n": (3.18,), "k": (4.41,)}, guess=True)


@rule("5.1")
def constant_reflectance(material: Material) -> Advice | None:
    """For most metals the angular variation of F may be ignored; this is what it costs."""
    if material.kind != "metal" or material.n is None or "usual_metal_index" in material.filled_by.values():
        return None
    absorption = material.k or (0.0,)
    n, k = material.n[len(material.n) // 2], absorption[len(absorption) // 2]
    to_75, constant = fresnel_simplifications.constant_cost(n, k, 75)
    to_85, _ = fresnel_simplifications.constant_cost(n, k, 85)
    says = (
        f"one reflectance of {constant:.3f} for all angles is wrong by at most {to_75:.1%} up to 75° from the normal, "
        f"{to_85:.1%} up to 85°; nearer to grazing every surface comes to reflect all light"
    )
    return Advice(says, "n and k")


@rule("5.1")
def one_index_over_the_spectrum(material: Material) -> Advice | None:
    """The report's one index over the spectrum fails for coloured metals: gold, copper, brass."""
    if material.kind != "metal" or material.n is None:
        return None
    f0 = [float(value) for value in np.atleast_1d(fresnel.f0(np.array(material.n), np.array(material.k)))]
    if len(f0) > 1 and max(f0) > 1.15 * min(f0):
        return Advice(
            f"coloured: F0 = {_several(tuple(f0), '.2f')} in red, green, blue; one index for all would lose its colour",
            "n and k by channel",
        )
    if len(f0) == 1 and material.highlight_colour == "tinted":
        return Advice(
            "one index for all channels, yet the highlight is tinted: give F0 or the index by channel",
            "highlight's colour against the index",
            conflict=True,
        )
    return None


@rule("5.1")
def index_at_another_wavelength(material: Material) -> Advice | None:
    """An index belongs to its wavelength."""
    wanted = material.wavelength
    if wanted is None or not material.index_wavelength:
        return None
    nearest = min(material.index_wavelength, key=lambda each: abs(each - wanted))
    if abs(nearest - wanted) <= 0.05 * wanted:
        return None
    says = f"the index is for {1000 * nearest:g} nm, and {1000 * wanted:g} nm is wanted"
    return Advice(says, "wavelengths", domain="flagged")


def _several(values, form: str = ".4g") -> str:
    return ", ".join(f"{value:{form}}" for value in values)


RULES = (
    liquid_index,
    usual_dielectric_index,
    usual_metal_index,
    constant_reflectance,
    one_index_over_the_spectrum,
    index_at_another_wavelength,
)
