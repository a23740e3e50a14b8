"""What a guideline is: a pure function from a Material to one Advice, or to None where it has nothing to say."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ..material import Material


@dataclass(frozen=True)
class Advice:
    """One finding of one rule. `sets` fills blanks and never overrides; the rest changes what is recommended or how surely."""

    says: str
    because: str = ""  # the observation or guess it rests on
    sets: Mapping = field(default_factory=dict)
    prefers: tuple[str, ...] = ()  # models, best first
    drops: Mapping[str, str] = field(default_factory=dict)  # model or term -> why not
    domain: str = ""  # flagged, outside
    needs: str = ""  # the kind of model that a surface outside the guide needs
    conflict: bool = False  # observations that contradict each other
    guess: bool = False  # rests on what is usual, not on an observation
    rule: str = ""  # filled in by consult
    section: str = ""


Rule = Callable[[Material], Advice | None]


def rule(section: str) -> Callable[[Rule], Rule]:
    """Marks a guideline with its section in the report; its docstring says it in a line."""

    def mark(function: Rule) -> Rule:
        function.section = section
        return function

    return mark
