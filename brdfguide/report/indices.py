"""Indices of refraction as documents: what follows from them, and what each simplification costs."""

import numpy as np

from .. import optical_constants, optics, substances
from ..errors import InputError, choices
from ..simplified import constant_cost, equivalent_cost, index_cost

METAL_F0 = 0.2  # above it Eq. 2 hardly speaks of a dielectric (diamond: 0.172)


def from_f0(f0: float) -> dict:
    """Eq. 2, with where it misleads."""
    n = float(optics.index_from_f0(f0))
    warnings = []
    if f0 > METAL_F0:
        text = (
            f"F0 = {f0:g} is above 0.2: a metal, for which n = {n:.3g} is an equivalent real index whose F falls toward 80° where a metal's"
            " does not; a constant F is closer, n + ik best"
        )
        warnings.append({"code": "eq2-on-a-metal", "text": text})
    return _document([_entry("Eq. 2", n, 0.0, None, f"F0 = {f0:g}", metal=f0 > METAL_F0)], warnings)


def from_index(n: float, k: float) -> dict:
    return _document([_entry("given", n, k, None, "as given", metal=k > 0.5)], [])


def named(name: str, wavelength: float) -> dict:
    """A substance of the shipped table, else every author's value in refractiveindex.info."""
    found = substances.find(name)
    if found:
        at = found.wavelength or (None,) * len(found.n)
        where = at if len(at) == len(found.n) else at * len(found.n)
        rows = [_entry(found.name, n, k, w, found.source, found.kind == "metal") for n, k, w in zip(found.n, found.k, where)]
        return _document(rows, [{"code": "alternative", "text": found.note}] if found.note else [])
    if not optical_constants.installed():
        known = [each.name for each in substances.SUBSTANCES]
        error = choices("substance", name, known)
        raise InputError(f"{error}; `pip install 'brdfguide[optics]'` adds several hundred by formula (Au, SiO2)")
    entries, near = optical_constants.find(name, wavelength)
    if not entries:
        hint = f"there are, at some wavelength: {', '.join(near[:12])}" if near else choices("substance", name, [each.name for each in substances.SUBSTANCES])
        raise InputError(f"no entry '{name}' at {1000 * wavelength:g} nm in refractiveindex.info; {hint}")
    rows = [_entry(f"{e.material}/{e.page}", e.n, e.k, wavelength, e.source, e.k > 0.5) for e in entries]
    f0 = [row["f0"] for row in rows]
    warnings = []
    if len(rows) > 1:
        warnings.append({"code": "authors-differ", "text": f"{len(rows)} authors differ: F0 from {min(f0):.4f} to {max(f0):.4f}; name one as {rows[0]['name']}"})
    return _document(rows, warnings)


def everything() -> dict:
    rows = []
    for each in substances.SUBSTANCES:
        middle = len(each.n) // 2
        at = None if each.wavelength is None else each.wavelength[min(middle, len(each.wavelength) - 1)]
        rows.append(_entry(each.name, each.n[middle], each.k[middle], at, each.source, each.kind == "metal"))
    return _document(rows, [])


def _entry(name: str, n: float, k: float, wavelength: float | None, source: str, metal: bool) -> dict:
    f = optics.fresnel(np.cos(np.radians([60.0, 75.0, 80.0, 85.0])), n, k)
    entry = {"name": name, "n": n, "k": k, "wavelength_nm": None if wavelength is None else round(1000 * wavelength, 4), "f0": float(optics.f0(n, k)), "source": source}
    entry |= {f"fresnel_{angle}_deg": float(value) for angle, value in zip((60, 75, 80, 85), f)}
    if metal:
        (to_75, constant), (to_85, _) = constant_cost(n, k, 75), constant_cost(n, k, 85)
        equivalent, up_to = equivalent_cost(n, k)
        entry["eq2"] = {"n": equivalent, "within_5_percent_to_deg": up_to}
        entry["simplified"] = {"as": "constant", "value": constant, "worst_to_75_deg": to_75, "worst_to_85_deg": to_85}
    elif n > 1:
        entry["simplified"] = {"as": "n = 1.5", "value": 1.5, "worst_to_85_deg": index_cost(n)}
    else:
        entry["simplified"] = None
    return entry


def _document(entries: list[dict], warnings: list[dict]) -> dict:
    return {"schema": "brdfguide/index/1", "entries": entries, "warnings": warnings}


def lines(document: dict):
    """(header, rows) for people."""
    header = ("substance", "n", "k", "nm", "F0", "F 60", "F 75", "F 80", "F 85", "simplified", "source")
    return header, [_line(each) for each in document["entries"]]


def _line(each: dict) -> tuple[str, ...]:
    simple = each["simplified"]
    if simple is None:
        cost = "-"
    elif simple["as"] == "constant":
        cost = f"constant {simple['value']:.3f}: {simple['worst_to_75_deg']:.1%} to 75 deg, {simple['worst_to_85_deg']:.1%} to 85; Eq. 2's n = {each['eq2']['n']:.3g} errs by 5% from {each['eq2']['within_5_percent_to_deg']:g} deg"
    else:
        cost = f"n = 1.5: {simple['worst_to_85_deg']:+.0%} to 85 deg"
    wavelength = "-" if each["wavelength_nm"] is None else f"{each['wavelength_nm']:.7g}"
    angles = (f"{each[f'fresnel_{angle}_deg']:.4f}" for angle in (60, 75, 80, 85))
    return each["name"], f"{each['n']:.5g}", f"{each['k']:.4g}", wavelength, f"{each['f0']:.4f}", *angles, cost, each["source"]
