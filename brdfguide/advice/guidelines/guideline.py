"""What a guideline is: a pure function from a Material to one Advice, or to None where it has nothing to say."""

from collections.abc import Callable, Mapping
from dataclasses import field
from typing import Protocol, cast

from ...records import dataclass
from ..material import Material


@dataclass(frozen=True)
class Advice:
    """One finding of one rule.

    `sets` fills blanks and never overrides; the rest changes what is recommended or how surely.
    """

    says: str
    because: str = ""  # the observation or guess it rests on
    sets: Mapping = field(default_factory=dict)
    prefers: tuple[str, ...] = ()  # models, best first
    why: Mapping[str, str] = field(default_factory=dict)  # of one of these: its own reason, in place of `says`
    drops: Mapping[str, str] = field(default_factory=dict)  # model or term -> why not
    domain: str = ""  # flagged, outside
    needs: str = ""  # the kind of model that a surface outside the guide needs
    conflict: bool = False  # observations that contradict each other
    guess: bool = False  # rests on what is usual, not on an observation
    rule: str = ""  # filled in by consult
    section: str = ""


class Rule(Protocol):
    """A guideline as `rule` leaves it; its docstring says it in a line."""

    __name__: str
    section: str  # of the report

    def __call__(self, material: Material) -> Advice | None: ...


def rule(section: str) -> Callable[[Callable[[Material], Advice | None]], Rule]:
    """Marks a guideline with its section in the report."""

    def mark(function: Callable[[Material], Advice | None]) -> Rule:
        marked = cast(Rule, function)
        marked.section = section
        return marked

    return mark
