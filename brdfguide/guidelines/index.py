"""The index of refraction, measured before guessed (section 5.1), and what each simplification costs."""

from math import sqrt

import numpy as np

from .. import gloss, optical_constants, optics, simplified, substances
from ..material import Material
from ._base import Advice, rule

LIQUIDS = set("water ice liquid juice milk wine beer oil blood cola coffee tea vodka whiskey snow cream".split())


def known_substance(material: Material) -> substances.Substance | None:
    found = (substances.find(material.composition) or optical_constants.substance(material.composition, material.wavelength or 0.55)) if material.composition else None
    return found if found and (material.kind is None or material.kind == found.kind) else None


@rule("5.1")
def index_observed(material: Material) -> Advice | None:
    """An observed index is used as it is."""
    if material.n is None:
        return None
    where = f" at {material.index_wavelength[0] * 1000:g} nm" if material.index_wavelength else "; no wavelength given"
    return Advice(f"n = {_several(material.n)}" + (f", k = {_several(material.k)}" if material.k and any(material.k) else "") + where, "index, as observed")


@rule("5.1, Eq. 2")
def index_from_f0(material: Material) -> Advice | None:
    """n of a dielectric from the reflectance of a smooth sample near normal incidence."""
    if material.n is not None or material.f0 is None or material.kind != "dielectric":
        return None
    n = tuple(float(value) for value in optics.index_from_f0(material.f0))
    return Advice(f"n = {_several(n)}", f"Eq. 2 with F0 = {_several(material.f0)}", sets={"n": n, "k": (0.0,)})


@rule("5.1, Eq. 2")
def index_from_mirror_ratio(material: Material) -> Advice | None:
    """F0 from a photometer's comparison of two mirror reflections, then Eq. 2."""
    meter = material.photometer or {}
    if material.n is not None or material.f0 is not None or meter.get("of") != "mirror" or material.kind == "metal":
        return None
    f0 = meter["ratio"] * meter["reference"]
    if f0 >= 1 or material.kind != "dielectric":
        return None
    n = float(optics.index_from_f0(f0))
    return Advice(f"F0 = {f0:.4f}, n = {n:.3f}", f"photometer: {meter['ratio']:g} of a reference of {meter['reference']:g}, Eq. 2", sets={"f0": (f0,), "n": (n,), "k": (0.0,)})


@rule("5.1")
def equivalent_metal_index(material: Material) -> Advice | None:
    """A metal's F0 as n = 1 with k: F0 = k²/(4 + k²), which rises to 1 at grazing as a metal's does; not Eq. 2's equivalent n."""
    meter = material.photometer or {}
    measured = material.f0 or ((min(meter["ratio"] * meter["reference"], 0.9999),) if meter.get("of") == "mirror" else None)
    if material.n is not None or measured is None or material.kind != "metal":
        return None
    k = tuple(2 * sqrt(f0 / (1 - f0)) for f0 in measured)
    says = f"n = 1, k = {_several(k)}, which has F0 = {_several(measured)}; Eq. 2's equivalent real n would be {float(optics.index_from_f0(measured[0])):.3g} and falls toward grazing where metals rise"
    return Advice(says, "F0 of a metal", sets={"f0": measured, "n": (1.0,) * len(k), "k": k})


@rule("5.1, Table 1")
def index_of_composition(material: Material) -> Advice | None:
    """n + ik of the named substance, from Table 1 or another published source, per channel where it is coloured."""
    found = known_substance(material)
    if material.n is not None or found is None:
        return None
    says = f"n = {_several(found.n)}" + (f", k = {_several(found.k)}" if any(found.k) else "") + (f" ({found.note})" if found.note else "")
    where = "" if found.wavelength is None else f" at {_several(tuple(1000 * w for w in found.wavelength), '.4g')} nm"
    return Advice(says, f"{found.name}{where}: {found.source}", sets={"n": found.n, "k": found.k, "index_wavelength": found.wavelength})


@rule("5, 5.1")
def index_from_gloss(material: Material) -> Advice | None:
    """n of a dielectric from two or three glossmeter readings, where one lobe gives them all."""
    if material.n is not None or material.kind != "dielectric" or len(material.gloss or {}) < 2 or max(material.gloss.values()) < 20:
        return None
    found = gloss.roughness_from(dict(material.gloss), albedo=_mean(material.albedo))
    if not found.agrees or not 1.32 < found.n < 1.88:
        return None
    return Advice(f"n = {found.n:.2f}", f"glossmeter readings at {', '.join(f'{a}°' for a in material.gloss)} together", sets={"n": (found.n,), "k": (0.0,)})


@rule("5.1")
def liquid_index(material: Material) -> Advice | None:
    """Water, ice and most liquids lie below the usual 1.5."""
    if material.n is not None or material.kind != "dielectric" or not LIQUIDS.intersection((material.composition or "").lower().split()):
        return None
    return Advice("n = 1.34, as for water", f"composition: {material.composition}", sets={"n": (1.34,), "k": (0.0,)}, guess=True)


@rule("5.1")
def usual_dielectric_index(material: Material) -> Advice | None:
    """Most dielectrics lie near n = 1.5."""
    if material.n is not None or material.kind != "dielectric":
        return None
    says = f"n = 1.5, the usual value; over 0 to 85° F is then wrong by {simplified.index_cost(1.34):+.0%} should it be water's 1.34, {simplified.index_cost(1.6):+.0%} should it be 1.6"
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
    n, k = material.n[len(material.n) // 2], material.k[len(material.k) // 2]
    (to_75, constant), (to_85, _) = simplified.constant_cost(n, k, 75), simplified.constant_cost(n, k, 85)
    return Advice(f"a constant F of {constant:.3f} is wrong by at most {to_75:.1%} up to 75°, {to_85:.1%} up to 85°, and F goes to 1 at grazing", "n and k")


@rule("5.1")
def one_index_over_the_spectrum(material: Material) -> Advice | None:
    """The report's one index over the spectrum fails for coloured metals: gold, copper, brass."""
    if material.kind != "metal" or material.n is None:
        return None
    f0 = [float(value) for value in np.atleast_1d(optics.f0(np.array(material.n), np.array(material.k)))]
    if len(f0) > 1 and max(f0) > 1.15 * min(f0):
        return Advice(f"coloured: F0 = {_several(tuple(f0), '.2f')} in red, green, blue; one index for all would lose its colour", "n and k by channel")
    if len(f0) == 1 and material.highlight_colour == "tinted":
        return Advice("one index for all channels, yet the highlight is tinted: give F0 or the index by channel", "highlight's colour against the index", conflict=True)
    return None


@rule("5.1")
def index_at_another_wavelength(material: Material) -> Advice | None:
    """An index belongs to its wavelength."""
    if material.wavelength is None or not material.index_wavelength:
        return None
    nearest = min(material.index_wavelength, key=lambda each: abs(each - material.wavelength))
    if abs(nearest - material.wavelength) <= 0.05 * material.wavelength:
        return None
    return Advice(f"the index is for {1000 * nearest:g} nm, and {1000 * material.wavelength:g} nm is wanted", "wavelengths", domain="flagged")


def _several(values, form: str = ".4g") -> str:
    return ", ".join(f"{value:{form}}" for value in values)


def _mean(values) -> float:
    return sum(values) / len(values) if values else 0.0


RULES = (
    index_observed, index_from_f0, index_from_mirror_ratio, equivalent_metal_index, index_of_composition, index_from_gloss, liquid_index,
    usual_dielectric_index, usual_metal_index, constant_reflectance, one_index_over_the_spectrum, index_at_another_wavelength,
)  # fmt: skip
