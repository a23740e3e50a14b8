"""Which models to try on a surface, from where to start, and why.

Three ways to the same street: `candidates` for a fit that knows nothing or only the kind; `recommend` from a described
Material, by the guidelines; `for_fit` when both are there: guidelines choose and start, the fit decides.
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from . import gloss, guidelines, material, starting
from . import models as catalogue
from .errors import choices
from .geometry import Geometry, rows
from .guidelines._base import Advice
from .material import Material
from .models import Sum

KINDS = ("metal", "dielectric")
BODIES = ("lambertian", "oren-nayar", "coupled")

# One lobe law each, cheapest first; the order has no say in a ranking by error.
LOBES = ("phong", "phong-lewis", "blinn", "ward", "ward-gmd", "lafortune", "lafortune:2", "cook-torrance", "beckmann", "ggx", "he-torrance")
# Laws whose amplitude is Fresnel's: on a metal n and k make it, on a dielectric n alone.
FRESNEL = ("cook-torrance", "beckmann", "ggx", "he-torrance")
METAL_K = 4.0  # F0 = 0.8 with n = 1, between chromium's 0.66 and silver's 0.96 (Westin et al. 2004, Table 1)


def candidates(kind: str | None = None, names=None) -> tuple[Sum, ...]:
    """The sums worth fitting to a surface of this kind ("metal", "dielectric"; None: not known), or those in `names`.

    A metal has no subsurface term (Westin et al. 2004, section 3.2.3); a surface of unknown kind gets both sorts.
    Raises InputError for an unknown kind or name.
    """
    if kind not in (None, *KINDS):
        raise choices("kind of surface", kind, KINDS)
    if names is not None:
        sums = tuple(catalogue.get(name) for name in names)
        return tuple(as_metal(each) for each in sums) if kind == "metal" else sums
    on_body = [f"lambertian+{lobe}" for lobe in LOBES] + ["oren-nayar+ggx"]
    bare = list(LOBES if kind == "metal" else FRESNEL)
    dielectrics = () if kind == "metal" else tuple(catalogue.get(name) for name in on_body)
    metals = () if kind == "dielectric" else tuple(as_metal(catalogue.get(name)) for name in bare)
    return dielectrics + metals


def as_metal(sum_: Sum) -> Sum:
    """The same sum with Fresnel's factor of a metal: n held at 1, k free in each channel.

    F0 = k²/(4 + k²) then is the amplitude, between 0 and 1, and F rises to 1 at grazing as it must.
    """
    held, freed = {}, []
    for term in sum_.terms:
        if {"n", "k"} <= set(term.model.defaults()):
            held[f"{term.label}.n"] = 1.0
            freed.append(f"{term.label}.k")
    return replace(sum_, fixed={**sum_.fixed, **held}, free=sum_.free + tuple(freed), start={**sum_.start, **{key: METAL_K for key in freed}})


# --- from a description ------------------------------------------------------------------------------


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


def for_fit(recommendation: Recommendation, kind: str | None = None) -> tuple[Sum, ...]:
    """The sums to fit: all that its kind allows, or `kind` as the instrument tells; its own picks first, started where the guidelines say."""
    kind = kind or (recommendation.material.kind if recommendation.material.kind in KINDS else None)
    picks = {}
    for each in recommendation.candidates:
        numbers = {key: value for key, value in each.start.items() if np.ndim(value) == 0}
        sum_ = as_metal(each.model) if kind == "metal" else each.model
        picks[each.model.name] = replace(sum_, start={**numbers, **{key: sum_.start[key] for key in sum_.free}})
    rest = [each for each in candidates(kind) if each.name not in picks]
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
