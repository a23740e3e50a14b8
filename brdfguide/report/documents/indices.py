"""Indices of refraction as documents: what follows from them, and what each simplification costs."""

import numpy as np

from ...errors import InputError, choices
from ...physics import fresnel, refractiveindex_info, substances
from ...physics.fresnel_simplifications import constant_cost, equivalent_cost, index_cost
from .findings import remark_on

METAL_F0 = 0.2  # above it Eq. 2 hardly speaks of a dielectric (diamond: 0.172)


def from_f0(f0: float) -> dict:
    """Eq. 2, with where it misleads."""
    n = float(fresnel.index_from_f0(f0))
    warnings = []
    if f0 > METAL_F0:
        text = (
            f"F0 = {f0:g} is above 0.2: a metal, for which n = {n:.3g} is an equivalent real index whose F falls "
            f"toward 80° where a metal's"
            " does not; a constant F is closer, n + ik best"
        )
        warnings.append(remark_on("eq2-on-a-metal", text))
    return _document([_entry("Eq. 2", n, 0.0, None, f"F0 = {f0:g}", metal=f0 > METAL_F0)], warnings)


def from_index(n: float, k: float) -> dict:
    return _document([_entry("given", n, k, None, "as given", metal=k > 0.5)], [])


USUAL_UM = 0.55  # where refractiveindex.info is asked unless told


def named_index(name: str, wavelength: float | None) -> dict:
    """A substance of the shipped table, else every author's value in refractiveindex.info; at a wavelength [µm], or
    where its source was read. Raises InputError for a wavelength at which it is not known."""
    found = substances.find(name)
    if found:
        at = found.wavelength or (None,) * len(found.n)
        where = at if len(at) == len(found.n) else at * len(found.n)
        values = list(zip(found.n, found.k, where, strict=True))
        if wavelength is not None:
            values = [substances.at_wavelength(found, wavelength)]
        rows = [_entry(found.name, n, k, w, found.source, found.kind == "metal") for n, k, w in values]
        return _document(rows, [remark_on("alternative", found.note)] if found.note else [])
    if not refractiveindex_info.installed():
        known = [each.name for each in substances.SUBSTANCES]
        error = choices("substance", name, known)
        raise InputError(f"{error}; `pip install 'brdfguide[optics]'` adds several hundred by formula (Au, SiO2)")
    wavelength = USUAL_UM if wavelength is None else wavelength
    entries, near = refractiveindex_info.find_entries(name, wavelength)
    if not entries:
        hint = (
            f"there are, at some wavelength: {', '.join(near[:12])}"
            if near
            else choices("substance", name, [each.name for each in substances.SUBSTANCES])
        )
        raise InputError(f"no entry '{name}' at {1000 * wavelength:g} nm in refractiveindex.info; {hint}")
    rows = [_entry(f"{e.material}/{e.page}", e.n, e.k, wavelength, e.source, e.k > 0.5) for e in entries]
    f0 = [row["f0"] for row in rows]
    warnings = []
    if len(rows) > 1:
        text = f"{len(rows)} authors differ: F0 from {min(f0):.4f} to {max(f0):.4f}; name one as {rows[0]['name']}"
        warnings.append(remark_on("authors-differ", text))
    return _document(rows, warnings)


def everything() -> dict:
    rows = []
    for each in substances.SUBSTANCES:
        middle = len(each.n) // 2
        at = None if each.wavelength is None else each.wavelength[min(middle, len(each.wavelength) - 1)]
        rows.append(_entry(each.name, each.n[middle], each.k[middle], at, each.source, each.kind == "metal"))
    return _document(rows, [])


def _entry(name: str, n: float, k: float, wavelength: float | None, source: str, metal: bool) -> dict:
    f = fresnel.fresnel(np.cos(np.radians([60.0, 75.0, 80.0, 85.0])), n, k)
    entry = {
        "name": name,
        "n": n,
        "k": k,
        "wavelength_nm": None if wavelength is None else round(1000 * wavelength, 4),
        "f0": float(fresnel.f0(n, k)),
        "source": source,
    }
    entry |= {f"fresnel_{angle}_deg": float(value) for angle, value in zip((60, 75, 80, 85), f, strict=True)}
    if metal:
        (to_75, constant), (to_85, _) = constant_cost(n, k, 75), constant_cost(n, k, 85)
        equivalent, up_to = equivalent_cost(n, k)
        entry["eq2"] = {"n": equivalent, "within_5_percent_to_deg": up_to}
        entry["simplified"] = {"as": "constant", "value": constant, "worst_to_75_deg": to_75, "worst_to_85_deg": to_85}
    elif n > 1:
        entry["simplified"] = {"as": "n = 1.5", "value": 1.5, "worst_to_85_deg": index_cost(n, k)}
    else:
        entry["simplified"] = None
    return entry


def _document(entries: list[dict], warnings: list[dict]) -> dict:
    return {"schema": "brdfguide/index/1", "entries": entries, "warnings": warnings}
