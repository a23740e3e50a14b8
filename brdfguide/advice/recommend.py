"""From a described Material to models with start values, and why, by the guidelines.

`for_fit` when it was measured too: guidelines choose and start, the fit decides.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property, partial

import numpy as np

from .. import models as catalogue
from ..models import Composite, cost
from ..models.candidates import KINDS, as_metal, of_kind
from ..models.looks import turns
from ..models.surface import Surface
from ..models.visible_change import begins_to_show
from ..physics import gloss
from ..physics.geometry import in_plane
from ..records import dataclass
from . import guidelines, material, start_values
from .guidelines.guideline import Advice
from .inference import Inference
from .material import Material, said_to_be_grained

# what leaving out an observation changes
EFFECTS = {
    "decides": "without it the answer is another",
    "narrows": "without it the answer is the same, less sure",
    "confirms": "the rest says the same",
    "contradicts": "the rest says otherwise",
    "none": "nothing here depends on it",
}


GLOSS_TURNS_DEG = (0.0, 45.0, 90.0, 135.0)  # azimuths under which a surface with a grain is read


@dataclass(frozen=True, eq=False)
class Proposal:
    """One sum with values ready to type, and what to expect of it."""

    model: Composite
    start: Mapping
    why: str
    rules: tuple[str, ...]
    cannot: tuple[str, ...]
    rise: start_values.Rise
    gloss: Mapping[int, float] | None  # units that it would read; None for a metal, which gloss is not defined for

    @cached_property
    def surface(self) -> Surface:
        return Surface.of_colours(self.model, self.start)

    @cached_property
    def ns_per_sample(self) -> float:
        """Measured when asked for."""
        return ns_per_direction(self.surface)

    @property
    def shows(self) -> dict[str, float | None]:
        """From which relative change on each of its numbers begins to look different, see `models.visible_change`."""
        free = {*self.model.free, *(key for key, each in self.model.parameters.items() if each.free)}
        return begins_to_show(self.surface, [key for key in self.start if key in free])


@dataclass(frozen=True, eq=False)
class Recommendation:
    """A filled material with what was said about it; `candidates` best first, empty outside the domain."""

    described: Material  # before anything was filled
    material: Material
    advice: tuple[Advice, ...]
    silent: tuple
    status: str  # inside, flagged, outside
    verdict: str  # metal, dielectric, cannot tell from this
    evidence: str
    candidates: tuple[Proposal, ...]
    left_out: Mapping[str, str]
    inference: Inference | None  # from what was read of roughness and index; None: nothing was

    def headed_by(self, model: str, why: str) -> "Recommendation":
        """The same with another candidate first, and why."""
        first = next(each for each in self.candidates if each.model.name == model)
        rest = tuple(each for each in self.candidates if each is not first)
        return replace(self, candidates=(replace(first, why=why), *rest))

    @cached_property
    def _left_out_in_turn(self) -> tuple[dict[str, str], dict[str, tuple[str, ...]]]:
        """Found when asked for: it takes an answer for each observation."""
        return _effects(self.described)

    @property
    def effects(self) -> Mapping[str, str]:
        """Key of an observation -> what leaving it out changes, see EFFECTS."""
        return self._left_out_in_turn[0]

    @property
    def rests_on(self) -> Mapping[str, tuple[str, ...]]:
        """Rule -> keys without which it would be silent or say something else."""
        return self._left_out_in_turn[1]

    @property
    def reasons(self) -> tuple[Advice, ...]:
        return tuple(each for each in self.advice if each.domain)

    @property
    def conflicts(self) -> tuple[Advice, ...]:
        return tuple(each for each in self.advice if each.conflict)

    @property
    def unused(self) -> tuple[str, ...]:
        """Observations on which nothing depends."""
        return tuple(key for key, effect in self.effects.items() if effect == "none")

    @property
    def guesses(self) -> tuple[Advice, ...]:
        return tuple(each for each in self.advice if each.guess)


def recommend(described: Material, anyway: bool = False, names=None) -> Recommendation:
    """What the guidelines make of a description.

    Outside the domain there are no candidates unless `anyway`; `names` are tried instead of their choice.
    """
    consultation = guidelines.consult(described)
    filled, advice = consultation.material, consultation.advice
    status = _status(advice)
    chosen, left_out = _choose(advice)
    if names is not None:
        chosen = dict.fromkeys(names, ("as you asked", ()))
    shown = (
        ()
        if status == "outside" and not anyway
        else tuple(_candidate(name, why, by, filled) for name, (why, by) in chosen.items())
    )
    verdict, evidence = _verdict(filled, advice)
    return Recommendation(
        described,
        filled,
        advice,
        consultation.silent,
        status,
        verdict,
        evidence,
        shown,
        left_out,
        filled.inference,
    )


def for_fit(recommendation: Recommendation, kind: str | None) -> tuple[Composite, ...]:
    """The sums to fit to a surface of this kind (None: not known); the guidelines' picks first, with their starts."""
    picks = {}
    for each in recommendation.candidates:
        numbers = {key: value for key, value in each.start.items() if np.ndim(value) == 0}
        model = as_metal(each.model) if kind == "metal" else each.model
        picks[each.model.name] = replace(model, start={**numbers, **{key: model.start[key] for key in model.free}})
    rest = [each for each in of_kind(kind) if each.name not in picks]
    finite = [each for each in picks.values() if any(not term.model.is_mirror for term in each.terms)]
    return tuple(finite) + tuple(rest)


def _status(advice) -> str:
    found = {each.domain for each in advice}
    return next((status for status in ("outside", "flagged") if status in found), "inside")


def _verdict(filled: Material, advice) -> tuple[str, str]:
    """Metal, dielectric or neither, and from what."""
    if filled.kind in KINDS:
        said = next((each.because for each in advice if each.rule == filled.filled_by.get("kind")), "kind, as observed")
        return filled.kind, said
    said = next(
        (
            each.because
            for each in advice
            if each.rule in ("evidence_disagrees", "metal_or_dielectric", "kind_cannot_be_told")
        ),
        "",
    )
    return "cannot tell from this", said


def _choose(advice) -> tuple[dict[str, tuple[str, tuple[str, ...]]], dict[str, str]]:
    """Preferred sums in the rules' order less those that a rule dropped: (name -> (why, rules)), (dropped -> why)."""
    left_out = {name: why for each in advice for name, why in each.drops.items()}
    if "lambertian" in left_out:
        left_out |= {each.name: left_out["lambertian"] for each in catalogue.every() if each.is_body}
    wanted: dict[str, tuple[str, tuple[str, ...]]] = {}
    for each in advice:
        for place, name in enumerate(each.prefers):
            why, by = wanted.get(name, (each.why.get(name) or (_otherwise(name) if place else each.says), ()))
            wanted[name] = why, (*by, each.rule)
    kept = {
        name: said
        for name, said in wanted.items()
        if not any(word.partition(":")[0] in left_out for word in name.split("+"))
    }
    return kept or dict(list(wanted.items())[:1]), left_out


def _otherwise(name: str) -> str:
    """Why one would take a sum that is not the first choice: what its own lobe is good for."""
    terms = catalogue.get(name).terms
    law = next((term.model for term in terms if term.model.is_lobe), terms[-1].model)
    beside = " and ".join(term.label for term in terms if term.model is not law)
    return f"otherwise, with {beside}: {law.summary}" if beside else f"otherwise: {law.summary}"


def _candidate(name: str, why: str, by: tuple[str, ...], filled: Material) -> Proposal:
    model = catalogue.get(name)
    start = start_values.start_values(model, filled)
    models = [term.model for term in model.terms]
    cannot = [
        f"{each.name}: {each.cannot}" for each in models if each.cannot and (not each.is_body or len(models) == 1)
    ]
    surface = Surface.of_colours(model, start)
    units = None if filled.kind == "metal" or start_values.open_metal(model, filled) else predicted_gloss(surface)
    cannot += _cannot_though_seen(model, filled)
    return Proposal(model, start, why, by, tuple(cannot), start_values.grazing_growth(surface), units)


def _cannot_though_seen(model: Composite, filled: Material) -> list[str]:
    """What was seen of the surface and this sum cannot show."""
    seen = {
        "cannot show the mirror image that was seen to emerge": filled.emerges and not model.has_mirror,
        "cannot shine back toward the light": filled.retroreflective
        and not any(term.model.returns_light for term in model.terms),
        "cannot change as the sample turns": said_to_be_grained(filled) and not model.turns,
    }
    return [words for words, holds in seen.items() if holds]


def predicted_gloss(surface: Surface) -> dict[int, float]:
    """Gloss units at 20, 60 and 85 degrees, in the middle channel; of a grain the mean over four turns."""
    middle, out = surface.middle, {}
    around = GLOSS_TURNS_DEG if turns(surface) else (0.0,)
    for angle in gloss.ANGLES:
        out[angle] = float(np.mean([_units_under(middle, angle, turn) for turn in around]))
    return out


def _units_under(surface: Surface, angle: int, azimuth_deg: float) -> float:
    """Gloss units with the light at an azimuth of the sample."""
    mirror = float(surface.mirror(in_plane([[angle]], angle).at_azimuth(azimuth_deg))[0, 0])
    return float(gloss.units(lambda geom: surface.brdf(geom.at_azimuth(azimuth_deg)), angle, mirror, quick=True)[0])


def ns_per_direction(surface: Surface) -> float:
    """Nanoseconds per direction of one channel of a surface, the least of three blocks of 2048, on this machine.

    Over the directions in which its growth is told, again and again: what a law forms when it is first called there is
    formed already.
    """
    middle = surface.middle
    scans = start_values.scans_of_growth()
    geom = scans[np.arange(cost.VALUES) % len(scans)].at(middle.wavelength)
    evaluators = {"it": partial(middle.model, values=middle.values)}
    cost.interleaved(evaluators, lambda: geom, 1)  # what a first call forms does not count
    return min(cost.interleaved(evaluators, lambda: geom, 3)["it"]) / len(geom)


def _effects(described: Material) -> tuple[dict[str, str], dict[str, tuple[str, ...]]]:
    """What leaving out each observation changes: of the answer, and of each rule; found by leaving it out."""
    whole, effects = _answer(described), {}
    rests_on: dict[str, tuple[str, ...]] = {}
    for key in observations(described.given):
        without = _answer(material.from_values(without_key(described.given, key), described.name))
        changed = [rule for rule, said in whole.said.items() if without.said.get(rule) != said]
        for rule in changed:
            rests_on[rule] = (*rests_on.get(rule, ()), key)
        if key in whole.set_aside:
            effects[key] = "contradicts"
        elif without.picks != whole.picks:
            effects[key] = "decides"
        elif without.intervals != whole.intervals:
            effects[key] = "narrows"
        else:
            told = changed or without.said.keys() - whole.said.keys() or without.cannot != whole.cannot
            effects[key] = "confirms" if told else "none"
    return effects, rests_on


def observations(given: Mapping) -> list[str]:
    """Dotted paths of what was observed: readings of one instrument one by one, other groups whole."""
    out = []
    for key, value in given.items():
        if key in ("name", "about", "sources", "measurements", "doubts"):
            continue
        out += [f"{key}.{inner}" for inner in value] if key in ("gloss", "stylus") else [key]
    return out


def without_key(given: Mapping, key: str) -> dict:
    """What was observed, but for one dotted path."""
    outer, _, inner = key.partition(".")
    rest = {name: value for name, value in given.items() if name != outer}
    left = {name: value for name, value in given[outer].items() if name != inner} if inner else {}
    return {**rest, outer: left} if left else rest


@dataclass(frozen=True)
class _Answer:
    """An answer without its costly extras, to be compared with another."""

    picks: tuple  # verdict, domain, sums with start values
    intervals: tuple
    said: Mapping[
        str, tuple
    ]  # rule -> its words: what it says and why, what it needs, which models it is for and against
    cannot: tuple[list[str], ...]  # of each sum, of what was seen
    set_aside: tuple[str, ...]


def _answer(described: Material) -> _Answer:
    consultation = guidelines.consult(described)
    advice, filled = consultation.advice, consultation.material
    chosen, _ = _choose(advice)
    starts = tuple((name, tuple(start_values.start_values(catalogue.get(name), filled).items())) for name in chosen)
    found = filled.inference
    return _Answer(
        (_verdict(filled, advice)[0], _status(advice), starts),
        tuple((each.name, tuple(each.numbers.items())) for each in found.laws) if found else (),
        {each.rule: (each.says, each.because, each.needs, each.why, each.drops) for each in advice},
        tuple(_cannot_though_seen(catalogue.get(name), filled) for name in chosen),
        tuple(found.set_aside) if found else (),
    )
