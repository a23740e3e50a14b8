"""What a ranking holds: candidates in their places, and the one to use."""

from collections.abc import Mapping
from dataclasses import field, replace
from typing import Protocol

from ..finding import Finding
from ..records import dataclass
from .fit import Fit
from .floor import Floor
from .objective import SEEN

REAL = 2.0  # standard errors from which a difference counts
BETTER = 0.97  # of an error, below which another is less in earnest: worth a step of growth, or to be preferred (ours)


@dataclass(frozen=True, eq=False)
class LeftOut:
    """A group of incidence angles or of turns, and the numbers that were searched for without it."""

    theta_i_deg: tuple[float, float]  # the lowest and the highest
    values: Mapping  # by key, numbers or arrays with one for each channel
    turns_deg: tuple[float, ...] = ()  # azimuths of the light; none where the group is of incidences


@dataclass(frozen=True)
class HeldOut:
    """Errors at incidence angles, and turns of the sample, that the fit did not see."""

    rms_ln: float  # over all folds
    highest_rms_ln: float  # the steepest incidence angles, predicted from the others
    highest_theta_i_deg: float
    folds: tuple[LeftOut, ...] = ()


class Cost(Protocol):
    """What a candidate costs to evaluate, the same in every run."""

    @property
    def work(self) -> float: ...  # operations in the time of one addition: orders equals
    @property
    def on_front(self) -> bool: ...  # no other is better in both error and `work`


@dataclass(frozen=True, eq=False, repr=False)
class Row:
    """One candidate in its place."""

    fit: Fit
    rank: int
    tied: bool  # with the best
    rms_ln: float
    rms_ln_by_theta_i: dict[float, float]
    errors: dict[str, float]  # by metric
    behind: float  # rms ln behind the best
    behind_se: float
    ns_per_sample: float
    cost: Cost
    held_out: HeldOut | None = None
    growth: dict | None = None
    mirror_from_deg: float | None = None  # the lowest incidence at which the mirror direction was measured
    warnings: tuple[Finding, ...] = ()
    close: bool = False  # enough to the best that can be trusted, by what `Options.close` says
    from_best: float = 0.0  # S [L*] between it and the best
    alike: bool = False  # people could not say whether it or the one of least S is closer to the data

    def __repr__(self) -> str:
        return f"{self.rank:3}{'=' if self.tied else ' '} {self.fit!r}"

    @property
    def work(self) -> float:
        return self.cost.work

    @property
    def on_front(self) -> bool:
        return self.cost.on_front

    @property
    def seen(self) -> float:
        """S [L*] between it and the data."""
        return self.errors[SEEN]


@dataclass(frozen=True)
class Tried:
    """One candidate that a step tried, on few directions."""

    candidate: str
    adds: str  # what it has that the one before has not
    rms_ln: float
    held_out_rms_ln: float | None = None  # None: it was not followed so far


@dataclass(frozen=True)
class Step:
    """How the best candidate so far was given one thing more, or why not."""

    of: str  # the candidate
    rms_ln: float  # on few directions
    held_out_rms_ln: float | None  # None: what it leaves is noise
    shown: str  # what its residuals show
    tried: tuple[Tried, ...] = ()
    taken: str | None = None  # the candidate; None: growing stopped here
    because: str = ""


@dataclass(frozen=True, eq=False, repr=False)
class Ranking:
    """Candidates, best first, and the one to use."""

    rows: tuple[Row, ...]
    recommended: Row
    because: str
    metric: str
    noise: float  # relative standard deviation of a single value, estimated from neighbours
    winners: dict[str, str]  # by metric
    warnings: tuple[Finding, ...] = ()
    weighing: tuple[Finding, ...] = ()  # what weighs the values
    seen_weights: str = ""  # what the directions stand for where S is taken
    close: str = "look"
    kind: str | None = None  # metal or dielectric, as told or as the data say; None: not known
    grown: tuple[Step, ...] = ()  # none: the candidates were named, or nothing can grow
    floor: Floor | None = None  # how well anything could describe the data; None: that cannot be told
    shows: Mapping[str, float | None] = field(default_factory=dict)  # see `models.visible_change`, of the recommended

    @property
    def no_answer(self) -> str:
        """Why none of them should be trusted; nothing where one may be."""
        return next((each.text for each in self.warnings if each.severity == "outside"), "")

    def warned(self, *findings: Finding) -> "Ranking":
        """The same with these warnings first."""
        return replace(self, warnings=(*findings, *self.warnings))

    def __repr__(self) -> str:
        """A line for each candidate, and which to use."""
        return "\n".join([*map(repr, self.rows), f"recommended: {self.recommended.fit.name}: {self.because}"])
