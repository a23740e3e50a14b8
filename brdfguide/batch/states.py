"""What can become of a surface among many, and the exit status of each."""

from pathlib import Path

from ..records import dataclass

ANSWERED = "answered"
BEFORE = "answered before"
NO_ANSWER = "no trustworthy answer"
BAD_INPUT = "bad input"
TIMED_OUT = "timed out"
OUT_OF_MEMORY = "out of memory"
KILLED = "killed"
NOT_KEPT = "answered, not kept"
NOT_MADE = "answered, not exported"
NOT_DONE = "not done"
STATUS = {
    ANSWERED: 0,
    BEFORE: 0,
    NO_ANSWER: 1,
    TIMED_OUT: 1,
    OUT_OF_MEMORY: 1,
    KILLED: 1,
    BAD_INPUT: 2,
    NOT_KEPT: 2,
}
EVENTS = {NO_ANSWER: "failed", BAD_INPUT: "failed", TIMED_OUT: "timed-out", OUT_OF_MEMORY: "out-of-memory",
          BEFORE: "before", NOT_KEPT: "failed", NOT_MADE: "failed", NOT_DONE: "not-done"}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class FileRow:
    """What became of one task."""

    file: str  # the task's label
    state: str
    status: int  # the exit status that it would have had by itself; of one that was not done the signal's
    brief: tuple[str, ...] | None = None  # what the table says of its answer
    no_answer: str = ""  # why no model should be trusted, beside an answer
    document: dict | None = None  # where it is kept nowhere
    place: Path | None = None  # of the answer that is kept
    key: str = ""
    error: str = ""
    from_before: bool = False
    seconds: float = 0.0
    peak_mb: float = 0.0
    tries: int = 1


def failed_row(file: str, state: str, error: str, **more) -> FileRow:
    """A row without an answer."""
    return FileRow(file=file, state=state, status=STATUS[state], error=error, **more)
