"""Roughness and index from everything that was read, together (sections 3.2.2, 5.2; Figure 14).

Each law gets its own numbers from all readings with their doubts (`..inference`); the law that meets them fills the
blanks. What no law can make of the others is set aside and named, never averaged.
"""

from math import degrees, exp
from typing import cast

from ..evidence import Evidence, Observation, evidence_of
from ..inference import Estimate, Inference, LawEstimate, infer
from ..material import Material, said_to_be_grained
from .guideline import Advice, rule

LAWS = {"beckmann": "Gaussian facets", "ggx": "GGX", "he-torrance": "He-Torrance"}
# lobes whose width nothing here can be asked for: left out where only a law of waves gives the readings
PLAIN = ("ward", "phong", "phong-lewis", "blinn")


@rule("5, 5.2, Figure 14")
def roughness_of_all_readings(material: Material) -> Advice | None:
    """One inference from gloss, highlight, haze, mirror image, stylus and look, each with its own doubt."""
    evidence = evidence_of(material)
    if evidence is None:
        return None
    found = infer(evidence)
    law, numbers = found.law, found.law.numbers
    if material.subsurface == "lobe":
        return _coat_of_flakes(found)
    sets: dict = {"inference": found, "alpha": numbers["alpha"].value, "slope": numbers["slope"].value}
    if law.name == "he-torrance":
        sets |= {"sigma": numbers["sigma"].value, "tau": numbers["tau"].value}
    if "n" in numbers and material.kind in ("dielectric", None):  # readings of a metal have no index of their own
        sets |= {"n": (numbers["n"].value,), "k": (0.0,)} if _bears(numbers["n"]) else {}
    names = ("sigma", "tau", "slope") if law.name == "he-torrance" else ("alpha",)
    units = {"sigma": " µm", "tau": " µm"}
    shown = [f"{name} {words(numbers[name], units.get(name, ''))}" for name in names]
    if "n" in sets:
        shown.append(f"n {words(numbers['n'])}")
    says = f"{', '.join(shown)}, by {LAWS[law.name]}{_deciders(law)}"
    return Advice(says, _readings(found.evidence), sets=sets)


def _coat_of_flakes(found: Inference) -> Advice | None:
    """What readings on flakes under a coat tell: the coat's index, where they bear on it; no width of the flakes."""
    n = found.law.numbers.get("n")
    if n is None or not _bears(n):
        return None
    return Advice(
        f"n {words(n)} of the coat, whose mirror image is nearly all that was read",
        _readings(found.evidence),
        sets={"inference": found, "n": (n.value,), "k": (0.0,)},
    )


def _bears(n: Estimate) -> bool:
    """Whether the readings say something of the index."""
    return bool(n.decided_by) or abs(n.value - 1.5) > 0.005


def words(number: Estimate, unit: str = "") -> str:
    """A number with its interval, as a person reads it."""
    if number.low is None and number.high is None:
        return f"{number.value:.3g}{unit} (the readings set no end to it)"
    if number.high is None:
        return f"{number.value:.3g}{unit} (above {number.low:.2g})"
    if number.low is None:
        return f"{number.value:.3g}{unit} (below {number.high:.2g})"
    return f"{number.value:.3g}{unit} ({number.low:.3g} to {number.high:.3g})"


def _deciders(law: LawEstimate) -> str:
    """Which reading tells what."""
    told: dict[str, list[str]] = {}
    for name in ("sigma", "slope", "n") if "sigma" in law.numbers else ("alpha", "n"):
        if name in law.numbers and law.numbers[name].decided_by:
            told.setdefault(law.numbers[name].decided_by, []).append(name)
    said = [f"{' and '.join(names)} mostly by {key}" for key, names in told.items()]
    return f"; {', '.join(said)}" if said else ""


def _readings(evidence: Evidence) -> str:
    """Every reading with its doubt."""
    return ", ".join(reading(each) for each in evidence.observations)


def reading(asked: Observation) -> str:
    """One observation in its own unit, with its doubt."""
    if asked.quantity == "gloss":
        return f"{asked.value:g} ± {asked.doubt:.2g} units at {asked.angle:g}°"
    if asked.quantity == "emergence":
        never = asked.side == "at least"
        return f"mirror image {'not up to' if never else 'from'} {asked.value:.3g} ± {asked.doubt:.2g}°"
    if asked.quantity == "dimming":
        return f"mirror image at {asked.angle:g}° x{asked.value:.3g} ± {asked.doubt:.2g}"
    if asked.key == "roughness":
        return f"typed roughness, a highlight {degrees(exp(asked.value)):.3g}° wide ± {asked.doubt:.0%}"
    if asked.quantity == "width":
        return f"highlight {degrees(exp(asked.value)):.3g}° wide ± {asked.doubt:.0%}"
    if asked.quantity == "haze":
        return f"haze {asked.value:g} ± {asked.doubt:.2g}"
    if asked.quantity == "sharpness":
        return "the finish"
    by = asked.key.partition(".")[0]
    return f"{by} {asked.quantity} {exp(asked.value):.3g} µm ± {asked.doubt:.0%}"


def _of(material: Material) -> Inference | None:
    return cast(Inference | None, material.inference)


@rule("5")
def reading_set_aside(material: Material) -> Advice | None:
    """The reading that no law can make of the others, by how many doubts it differs."""
    found = _of(material)
    if found is None or not found.set_aside:
        return None
    says = []
    for key, (others, doubts) in found.set_aside.items():
        asked = next(each for each in found.given.observations if each.key == key)
        if abs(doubts) < float("inf"):
            expected = _expected(asked, others)
            says.append(f"{reading(asked)}: the others make {expected} probable, {abs(doubts):.2g} doubts away")
        else:
            says.append(f"{reading(asked)}: the law that gives the others cannot make it")
    return Advice(f"{'; '.join(says)}. It is set aside", f"the others: {_readings(found.evidence)}", conflict=True)


def _expected(asked: Observation, value: float) -> str:
    if asked.quantity == "width":
        return f"{degrees(exp(value)):.3g}°"
    if asked.quantity == "sharpness":
        return f"a surface that keeps {exp(value):.1%} of its light sharp"
    if asked.quantity in ("sigma", "tau"):
        return f"{exp(value):.3g} µm"
    return f"{value:.3g}" + ("°" if asked.quantity == "emergence" else "")


@rule("5")
def no_law_gives_all_readings(material: Material) -> Advice | None:
    """No law here gives all the readings: which comes nearest, and by how much it misses what."""
    found = _of(material)
    if found is None or found.law.meets:
        return None
    law, by_key = found.law, {each.key: each for each in found.evidence.observations}
    missed = [
        f"{reading(by_key[key])} by {abs(z):.2g} of its doubts"
        for key, z in sorted(law.misses.items(), key=lambda each: -abs(each[1]))
        if key in by_key and abs(z) > 1
    ]
    missed += [f"{reading(by_key[key])}, which it cannot make" for key in law.unexplained]
    if abs(law.misses.get("index", 0.0)) > 2:
        missed.append("all but with an index that no such surface has")
    says = (
        f"no law here gives all readings; the nearest, {LAWS[law.name]}, misses {'; '.join(missed) or 'each a little'}"
    )
    return Advice(says, _readings(found.evidence), conflict=True)


@rule("3.2.2, 5.2")
def law_that_gives_the_readings(material: Material) -> Advice | None:
    """Where some laws give all the readings and others cannot: the plainest of those that do."""
    found = _of(material)
    if found is None or material.subsurface == "lobe" or not found.law.meets:
        return None
    better = found.law.squares + 1.0
    failing = [each for each in found.laws if not each.unexplained and (not each.meets or each.squares > better)]
    if not failing:
        return None
    below = "oren-nayar+" if material.steep else "lambertian+"
    open_kind = material.kind not in ("metal", "dielectric") and material.subsurface is None
    body = below if material.subsurface == "lambertian" or open_kind and material.appearance != "black" else ""
    drops = {each.name: _shortfall(each, found.evidence) for each in failing}
    alone = len(failing) == len(found.laws) - 1
    which = "the only one" if alone else "the plainest"
    says = f"{LAWS[found.law.name]}, {which} of the laws here that gives all readings to within a doubt"
    prefers: tuple[str, ...] = () if said_to_be_grained(material) else (body + found.law.name,)  # a grain goes first
    why: dict[str, str] = {}
    if prefers and found.law.name == "beckmann" and "ggx" in drops:
        why = {f"{body}ggx": f"what renderers have in its place: GGX with numbers of its own, which {drops.pop('ggx')}"}
    drops |= dict.fromkeys(PLAIN, "has no numbers that would give these readings")
    return Advice(says, _readings(found.evidence), prefers=(*prefers, *why), why=why, drops=drops)


def _shortfall(law: LawEstimate, evidence: Evidence) -> str:
    """What a law would read in place of what was read."""
    by_key = {each.key: each for each in evidence.observations}
    key = max((each for each in law.misses if each in by_key), key=lambda each: abs(law.misses[each]))
    if abs(law.misses.get("index", 0.0)) > abs(law.misses[key]):
        return f"gives the readings only with n = {law.numbers['n'].value:.2f}, which no such surface has"
    return f"would read {_expected(by_key[key], law.predicted[key])}: {reading(by_key[key])} was read"


@rule("5")
def gloss_of_metal(material: Material) -> Advice | None:
    """Gloss units are defined against black glass; on metals they are the same ratio, far above 100."""
    if not material.gloss or material.kind != "metal":
        return None
    return Advice(
        "gloss of a metal is outside ISO 2813 and ASTM D523; it is read as the same ratio of light to black glass'",
        "glossmeter on a metal",
    )


RULES = (
    roughness_of_all_readings,
    reading_set_aside,
    no_law_gives_all_readings,
    law_that_gives_the_readings,
    gloss_of_metal,
)
