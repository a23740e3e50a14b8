"""Something noticed about a measurement, a fit or a scene."""

from . import flags
from .records import dataclass


@dataclass(frozen=True)
class Finding:
    """A stable code for programs, a sentence for people, the numbers behind it.

    Raises ValueError for a code, a severity or an option that `flags` does not list.
    """

    code: str
    text: str
    severity: str = "note"  # one of flags.SEVERITIES
    consequence: str = ""  # what it changes in the answer
    option: str = ""  # the command-line option that overrides it
    numbers: tuple[tuple[str, float], ...] = ()
    subject: str = ""  # what it is about, such as the parameter "ggx.alpha"
    settles: tuple[str, ...] = ()  # questions about a file that it answers: "side", "rotation", "cosine", "scale"
    leaves_out: bool = False  # whether a fit does without the values that it speaks of
    undo: str = ""  # what makes a BRDF of the values where that is certain: "turn", "copies", or their quantity

    def __post_init__(self):
        flags.require_listed(self.code, self.severity, self.option, self.subject)

    @property
    def effect(self) -> flags.Effect:
        """What the program does for it besides showing it."""
        return flags.FLAGS[self.code].effect

    @property
    def printed(self) -> str:
        """Code and subject as people and programs read them: `at-bound:ggx.alpha`."""
        return f"{self.code}:{self.subject}" if self.subject else self.code
