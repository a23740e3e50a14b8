"""From a described Material to models with start values, and why, by the guidelines.

`for_fit` when it was measured too: guidelines choose and start, the fit decides.
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from . import gloss, guidelines, material, starting
from . import models as catalogue
from .candidates import BODIES, KINDS, as_metal, of_kind
from .geometry import Geometry, rows
from .guidelines._base import Advice
from .material import Material
from .models import Sum

@dataclass(frozen=True, eq=False)
class Candidate:
    """One sum with values ready to type, and what to expect of it."""

    model: Sum
    start: Mapping
    why: str
    rules: tuple[str, ...]
    cannot: tuple[str, ...]
    rise: starting.Rise
    gloss: Mapping[int, float] | None  # units that it would read; None for a metal, which gloss is not defined for
    ns_per_sample: float


@dataclass(frozen=True, eq=False)
class Recommendation:
    """A filled material with what was said about it; `candidates` best first, empty outside the domain."""

    material: Material
    advice: tuple[Advice, ...]
    silent: tuple
    status: str  # inside, flagged, outside
    verdict: str  # metal, dielectric, cannot tell from this
    evidence: str
    candidates: tuple[Candidate, ...]
    left_out: Mapping[str, str]
    unused: tuple[tuple[str, str], ...]  # (key of an observation, why it counts for nothing)

    @property
    def reasons(self) -> tuple[Advice, ...]:
        return tuple(each for each in self.advice if each.domain)

    @property
    def conflicts(self) -> tuple[Advice, ...]:
        return tuple(each for each in self.advice if each.conflict)

    @property
    def guesses(self) -> tuple[Advice, ...]:
        return tuple(each for each in self.advice if each.guess)


def recommend(described: Material, anyway: bool = False, names=None) -> Recommendation:
    """What the guidelines make of a description. Outside the domain there are no candidates unless `anyway`; `names` are tried instead of their choice."""
    consultation = guidelines.consult(described)
    filled, advice = consultation.material, consultation.advice
    status = _status(advice)
    chosen, left_out = _choose(advice)
    if names is not None:
        chosen = {name: ("as you asked", ()) for name in names}
    shown = () if status == "outside" and not anyway else tuple(_candidate(name, why, by, filled) for name, (why, by) in chosen.items())
    verdict, evidence = _verdict(filled, advice)
    return Recommendation(filled, advice, consultation.silent, status, verdict, evidence, shown, left_out, _unused(described))


def for_fit(recommendation: Recommendation, kind: str | None) -> tuple[Sum, ...]:
    """The sums to fit to a surface of this kind (None: not known); the guidelines' picks first, started where they say."""
    picks = {}
    for each in recommendation.candidates:
        numbers = {key: value for key, value in each.start.items() if np.ndim(value) == 0}
        sum_ = as_metal(each.model) if kind == "metal" else each.model
        picks[each.model.name] = replace(sum_, start={**numbers, **{key: sum_.start[key] for key in sum_.free}})
    rest = [each for each in of_kind(kind) if each.name not in picks]
    finite = [each for each in picks.values() if {term.model.name for term in each.terms} != {"mirror"}]
    return tuple(finite) + tuple(rest)


def _status(advice) -> str:
    found = {each.domain for each in advice}
    return "outside" if "outside" in found else "flagged" if "flagged" in found else "inside"


def _verdict(filled: Material, advice) -> tuple[str, str]:
    """Metal, dielectric or neither, and from what."""
    if filled.kind in KINDS:
        said = next((each.because for each in advice if each.rule == filled.filled_by.get("kind")), "kind, as observed")
        return filled.kind, said
    said = next((each.because for each in advice if each.rule in ("evidence_disagrees", "metal_or_dielectric", "kind_cannot_be_told")), "")
    return "cannot tell from this", said


def _choose(advice) -> tuple[dict[str, tuple[str, tuple[str, ...]]], dict[str, str]]:
    """Preferred sums in the rules' order without those that a rule dropped: (name -> (why, rules)), (dropped -> why)."""
    left_out = {name: why for each in advice for name, why in each.drops.items()}
    if "lambertian" in left_out:
        left_out |= {name: left_out["lambertian"] for name in BODIES}
    wanted: dict[str, tuple[str, tuple[str, ...]]] = {}
    for each in advice:
        for name in each.prefers:
            why, by = wanted.get(name, (each.says, ()))
            wanted[name] = why, (*by, each.rule)
    kept = {name: said for name, said in wanted.items() if not any(word.partition(":")[0] in left_out for word in name.split("+"))}
    return kept or dict(list(wanted.items())[:1]), left_out


def _candidate(name: str, why: str, by: tuple[str, ...], filled: Material) -> Candidate:
    model = catalogue.get(name)
    start = starting.start_values(model, filled)
    laws = [term.model.name for term in model.terms]
    cannot = [f"{law}: {starting.CANNOT[law]}" for law in laws if law in starting.CANNOT and (law != "lambertian" or len(laws) == 1)]
    if filled.emerges and not model.has_mirror:
        cannot.append("cannot show the mirror image that was seen to emerge")
    if filled.changes_when_turned or filled.texture == "brushed":
        cannot.append("cannot change as the sample turns")
    units = None if filled.kind == "metal" or starting.open_metal(model, filled) else predicted_gloss(model, start)
    return Candidate(model, start, why, by, tuple(cannot), starting.rise(model, start), units, cost(name))


def predicted_gloss(model: Sum, values: Mapping) -> dict[int, float]:
    """Gloss units at 20, 60 and 85 degrees of a sum, in the middle channel."""
    single = {key: value[len(value) // 2] if isinstance(value, tuple) else value for key, value in values.items()}
    out = {}
    for angle in gloss.ANGLES:
        mirror = float(np.squeeze(model.mirror(Geometry.from_degrees(angle, 0.0, angle, 180.0), single))) if model.has_mirror else 0.0
        out[angle] = float(gloss.units(lambda geom: model(geom, single), angle, mirror, quick=True)[0])
    return out


@lru_cache(maxsize=64)
def cost(name: str) -> float:
    """Nanoseconds per direction of a sum at its defaults, the best of three blocks of 2048, on this machine."""
    model = catalogue.get(name)
    theta = np.linspace(1.0, 85.0, 16)
    geom = rows(Geometry.from_degrees(theta[:, None], 0.0, theta, np.linspace(90.0, 270.0, 8)[:, None, None]))
    values = model.defaults()
    model(geom, values)
    best = float("inf")
    for _ in range(3):
        began = time.perf_counter()
        model(geom, values)
        best = min(best, time.perf_counter() - began)
    return best / len(geom) * 1e9


def _unused(described: Material) -> tuple[tuple[str, str], ...]:
    """Observations whose removal leaves verdict, domain and start values as they are; found by removing each."""
    whole, found = _answer(described), []
    for key in observations(described.given):
        without = _answer(material.from_values(_without(described.given, key), described.name))
        if without[:3] == whole[:3]:
            only = "it changes only what is said" if without[3] != whole[3] else "the answer is the same without it"
            found.append((key, only))
    return tuple(found)


def observations(given: Mapping) -> list[str]:
    """Dotted paths of what was observed: readings of one instrument one by one, other groups whole."""
    out = []
    for key, value in given.items():
        if key in ("name", "about", "sources", "measurements"):
            continue
        out += [f"{key}.{inner}" for inner in value] if key in ("gloss", "stylus") else [key]
    return out


def _without(given: Mapping, key: str) -> dict:
    outer, _, inner = key.partition(".")
    rest = {name: value for name, value in given.items() if name != outer}
    left = {name: value for name, value in given[outer].items() if name != inner} if inner else {}
    return {**rest, outer: left} if left else rest


def _answer(described: Material):
    """(verdict, domain, sums with start values, what is said) of a description, without the costly extras."""
    consultation = guidelines.consult(described)
    chosen, _ = _choose(consultation.advice)
    starts = [(name, tuple(starting.start_values(catalogue.get(name), consultation.material).items())) for name in chosen]
    said = [(each.rule, each.says) for each in consultation.advice]
    return _verdict(consultation.material, consultation.advice)[0], _status(consultation.advice), starts, said
