"""From a surface and a target's laws to numbers that may be written, with what they cost.

Where the model's own parameters mean the same in the target they are written as they are; otherwise the target's law
is fitted. The residual is always measured with the rounded numbers that the file holds.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..geometry import Geometry
from ._base import EXACT, Statement, Surface, number, numbers
from ._directions import chosen, rms_ln
from ._refit import Law, fit

FACETS = {"ggx", "beckmann", "cook-torrance"}
BODIES = {"lambertian", "coupled", "oren-nayar"}
SIMPLER = 1.02  # a law with fewer parts is taken if it is no worse than this


@dataclass(frozen=True)
class Choice:
    """The law taken, its numbers as they will be written, and their cost."""

    name: str
    values: dict
    rms_ln: float
    directions: int
    over: str

    def statement(self, target: str, surface: Surface, *, lost=(), notes=(), mirror: float = 0.0, colour: str = "") -> Statement:
        """The Statement; `mirror` is the residual of an ideal mirror written beside the law."""
        worst = max(self.rms_ln, mirror)
        status = "lossy" if lost else "exact" if worst <= EXACT else "refit"
        return Statement(target, status, worst, self.directions, self.over, dict(self.values), tuple(lost), tuple(notes), colour or surface.colour.how)


def choose(surface: Surface, geom: Geometry | None, laws: Mapping[str, Law], *, spectral: bool = False) -> Choice:
    """The best of `laws`, simplest first, with parameters rounded as they will be written."""
    geom, wanted, over = chosen(surface, geom, spectral)
    return best_of(laws, geom, wanted, own_values(surface, spectral), over)


def best_of(laws: Mapping[str, Law], geom: Geometry, wanted: np.ndarray, known: Mapping | None, over: str) -> Choice:
    """The same for directions and wanted values that are there already."""
    best = None
    for name, law in laws.items():
        values = _as_known(law, known, geom, wanted) if law.parameters else {}
        values = fit(law, wanted, geom).values if values is None else values
        values = _written(law, values, wanted.shape[1])
        rms = rms_ln(law.at(geom, values), wanted)
        if best is None or rms * SIMPLER + 1e-9 < best.rms_ln:
            best = Choice(name, {**law.fixed, **values}, rms, int(np.isfinite(wanted).any(axis=1).sum()), over)
    return best


def _as_known(law: Law, known: Mapping | None, geom, wanted):
    """The model's own values, if the law takes exactly these and then equals the model."""
    if known is None:
        return None
    values = {p.name: known.get(p.name) for p in law.parameters}
    if any(value is None or np.any(value < p.low) or np.any(value > p.high) for p, value in zip(law.parameters, values.values())):
        return None
    return values if rms_ln(law.at(geom, values), wanted) <= EXACT / 10 else None


def _written(law: Law, values: Mapping, colours: int) -> dict:
    """Nine digits, within the bounds, per-channel ones for each colour."""
    written = {}
    for p in law.parameters:
        if p.per_channel:
            written[p.name] = np.array(numbers(np.broadcast_to(np.ravel(values[p.name]), (colours,)), p.low, p.high, p.name))
        else:
            written[p.name] = number(np.ravel(values[p.name])[0], p.low, p.high, p.name)
    return written


def own_values(surface: Surface, spectral: bool = False) -> dict | None:
    """albedo, scale, n, k by colour and alpha, of a Lambertian body and at most one facet lobe; None for other surfaces."""
    lobes = [term for term in surface.model.terms if term.model.name in FACETS]
    bodies = [term for term in surface.model.terms if term.model.name == "lambertian"]
    others = [term for term in surface.model.terms if term.model.name not in FACETS | {"lambertian", "mirror"}]
    if len(lobes) > 1 or len(bodies) > 1 or others:
        return None
    by_colour = (lambda value: np.broadcast_to(np.ravel(value), (len(surface.channels),))) if spectral else surface.linear
    values = {"albedo": by_colour(surface.of(bodies[0].label)["albedo"]) if bodies else by_colour(0.0)}
    if lobes:
        own = surface.of(lobes[0].label)
        values["scale"] = by_colour(own["scale"])
        for name in ("n", "k"):
            values[name] = by_colour(own[name]) if spectral else surface.nonlinear(own[name])
        values["alpha"] = np.ravel(own["alpha"])[0] if np.ptp(own["alpha"]) == 0 else None
        values["amount"] = 1.0 if not bodies and np.all(values["scale"] == 1) else None
    return values


def fresnel_index(surface: Surface, spectral: bool = False) -> tuple[np.ndarray, np.ndarray] | None:
    """n and k by colour of the one term that has them, if these mean something in the target's colours."""
    owners = [term for term in surface.model.terms if {"n", "k"} <= set(term.model.defaults())]
    if not owners:
        return None
    own = surface.of(owners[0].label)
    if spectral:
        return tuple(np.broadcast_to(np.ravel(own[name]), (len(surface.channels),)).astype(float) for name in ("n", "k"))
    n, k = surface.nonlinear(own["n"]), surface.nonlinear(own["k"])
    return None if n is None or k is None else (n, k)


def has_body(surface: Surface) -> bool:
    """Whether a diffuse body may be written: not for a bare interface."""
    return not set(surface.laws) <= FACETS | {"he-torrance", "mirror"}


def has_lobe(surface: Surface) -> bool:
    return not set(surface.laws) <= BODIES | {"mirror"} or "oren-nayar" in surface.laws


def what_is_lost(surface: Surface) -> tuple[str, ...]:
    """Sentences for what a body and one facet lobe cannot hold."""
    lost = []
    lobes = [term for term in surface.model.terms if term.model.name not in BODIES | {"mirror"}]
    if len(lobes) > 1:
        lost.append(f"{len(lobes)} lobes become one")
    for term in lobes:
        own = surface.of(term.label)
        if term.model.name == "he-torrance":
            lost.append("wave effects, the lobe's change of shape with angle and wavelength, become one shape")
        if term.model.name == "lafortune" and np.any(own["tilt"] < 0):
            lost.append("a lobe back toward the light has no counterpart")
        shapes = [p.name for p in term.model.parameters if not p.per_channel and np.ptp(own[p.name]) > 0]
        if shapes:
            lost.append(f"{', '.join(shapes)} differing between channels become one")
    return tuple(lost)
