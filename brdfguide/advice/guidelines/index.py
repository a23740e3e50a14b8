"""The index of refraction, as measured or as the named substance has it (section 5.1)."""

from math import sqrt

from ...physics import fresnel, refractiveindex_info, substances
from ..material import Material
from .guideline import Advice, rule


def known_substance(material: Material) -> substances.Substance | None:
    found = (
        (
            substances.find(material.composition)
            or refractiveindex_info.substance(material.composition, material.wavelength or 0.55)
        )
        if material.composition
        else None
    )
    return found if found and (material.kind is None or material.kind == found.kind) else None


@rule("5.1")
def index_observed(material: Material) -> Advice | None:
    """An observed index is used as it is."""
    if material.n is None:
        return None
    where = f" at {material.index_wavelength[0] * 1000:g} nm" if material.index_wavelength else "; no wavelength given"
    return Advice(
        f"n = {_several(material.n)}"
        + (f", k = {_several(material.k)}" if material.k and any(material.k) else "")
        + where,
        "index, as observed",
    )


@rule("5.1, Eq. 2")
def index_from_f0(material: Material) -> Advice | None:
    """n of a dielectric from the reflectance of a smooth sample near normal incidence."""
    if material.n is not None or material.f0 is None or material.kind != "dielectric":
        return None
    n = tuple(float(value) for value in fresnel.index_from_f0(material.f0))
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
    n = float(fresnel.index_from_f0(f0))
    return Advice(
        f"F0 = {f0:.4f}, n = {n:.3f}",
        f"photometer: {meter['ratio']:g} of a reference of {meter['reference']:g}, Eq. 2",
        sets={"f0": (f0,), "n": (n,), "k": (0.0,)},
    )


@rule("5.1")
def equivalent_metal_index(material: Material) -> Advice | None:
    """A metal's F0 as n = 1 with k: F0 = k²/(4 + k²), which rises to 1 at grazing as a metal's does; not Eq.

    2's equivalent n.
    """
    meter = material.photometer or {}
    measured = material.f0 or (
        (min(meter["ratio"] * meter["reference"], 0.9999),) if meter.get("of") == "mirror" else None
    )
    if material.n is not None or measured is None or material.kind != "metal":
        return None
    k = tuple(2 * sqrt(f0 / (1 - f0)) for f0 in measured)
    says = (
        f"n = 1, k = {_several(k)}, which has F0 = {_several(measured)}; Eq. 2's equivalent real n would be "
        f"{float(fresnel.index_from_f0(measured[0])):.3g} and falls toward grazing where metals rise"
    )
    return Advice(says, "F0 of a metal", sets={"f0": measured, "n": (1.0,) * len(k), "k": k})


@rule("5.1, Table 1")
def index_of_composition(material: Material) -> Advice | None:
    """n + ik of the named substance, from Table 1 or another published source, per channel where it is coloured."""
    found = known_substance(material)
    if material.n is not None or found is None:
        return None
    says = (
        f"n = {_several(found.n)}"
        + (f", k = {_several(found.k)}" if any(found.k) else "")
        + (f" ({found.note})" if found.note else "")
    )
    where = "" if found.wavelength is None else f" at {_several(tuple(1000 * w for w in found.wavelength), '.4g')} nm"
    return Advice(
        says,
        f"{found.name}{where}: {found.source}",
        sets={"n": found.n, "k": found.k, "index_wavelength": found.wavelength},
    )


@rule("5.1")
def index_of_alloy(material: Material) -> Advice | None:
    """An alloy that no table has by name, by the metal it is named for."""
    if material.n is not None or material.kind != "metal" or not material.composition:
        return None
    found = substances.find(substances.kind_of_words(material.composition)[1])
    if found is None or found.kind != "metal":
        return None
    says = (
        f"n = {_several(found.n)}, k = {_several(found.k)}: {found.name} stands in for '{material.composition}', which "
        f"no table here has; what else is in it may change F0 as much as from copper to brass, by 5 % in red, 27 % in "
        f"green and 19 % in blue"
    )
    where = "" if found.wavelength is None else f" at {_several(tuple(1000 * w for w in found.wavelength), '.4g')} nm"
    sets = {"n": found.n, "k": found.k, "index_wavelength": found.wavelength}
    return Advice(says, f"{found.name}{where}: {found.source}", sets=sets, guess=True)


def _several(values, form: str = ".4g") -> str:
    return ", ".join(f"{value:{form}}" for value in values)


RULES = (
    index_observed,
    index_from_f0,
    index_from_mirror_ratio,
    equivalent_metal_index,
    index_of_composition,
    index_of_alloy,
)
