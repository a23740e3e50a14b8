"""The report's section 5 as rules, in its order: domain, metal or not, subsurface, index, roughness, choice.

`consult` folds them over a material. Order and "never overwrite" are the report's first guideline: use whatever data
are available, measured before guessed. A rule that does not apply is silent; none evaluates a BRDF.
"""

from dataclasses import replace
from functools import lru_cache

from ... import catalog
from ...records import dataclass
from ..material import Material
from .guideline import Advice, Rule

ORDER = ("domain", "interface", "shader-words", "subsurface", "index", "joint", "usual", "finish", "choice")


@dataclass(frozen=True)
class Consultation:
    """The material with its blanks filled, what each rule said, and which were silent."""

    material: Material
    advice: tuple[Advice, ...]
    silent: tuple[Rule, ...]


@lru_cache(maxsize=1)
def rules() -> tuple[Rule, ...]:
    return tuple(rule for part in ORDER for rule in catalog.load("advice.guidelines", part).RULES)


def consult(material: Material) -> Consultation:
    """Every rule once, in order; each sees what those before it filled in."""
    spoken, silent = [], []
    for each in rules():
        advice = each(material)
        if advice is None:
            silent.append(each)
            continue
        spoken.append(replace(advice, rule=each.__name__, section=each.section))
        material = material.filled(advice.sets, each.__name__)
    return Consultation(material, tuple(spoken), tuple(silent))
