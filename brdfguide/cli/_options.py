"""Options that several commands share, and how they write: results to stdout, the rest to stderr."""

import os
import sys
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path
from threading import Event, Thread
from time import monotonic
from typing import Annotated

from typer import Option

from .. import printable
from ..errors import choices
from ..files import picture_kind, writable
from ..records import dataclass
from ._described import json_text
from ._streams import say, whisper

PATIENCE_S = 1.0  # of somebody before a terminal
PATTERNS = ("{stem}", "{parent}")
JsonOption = Annotated[bool, Option("--json", help="One JSON object on stdout.")]
QuietOption = Annotated[bool, Option("--quiet", "-q", help="No notes on stderr.")]
FullOption = Annotated[bool, Option("--full", help="Every number, scale and note, not the answer alone.")]
ForceOption = Annotated[bool, Option("--force", help="Replace an existing output file.")]


def _theme(word: str) -> str:
    if word not in THEMES:
        raise choices("theme", word, THEMES)
    return word


THEMES = ("light", "dark")
ThemeOption = Annotated[str, Option("--theme", callback=_theme, help="Of --plot: light or dark.")]
FigureThemeOption = Annotated[str, Option("--theme", callback=_theme, help="Of the figures: light or dark.")]


@dataclass(frozen=True, eq=False, kw_only=True)
class Output:
    """How an answer is told."""

    json: JsonOption = False
    quiet: QuietOption = False
    no_timing: Annotated[bool, Option("--no-timing", help="Leave out times, so that two runs give the same bytes.")] = (
        False
    )

    @property
    def timing(self) -> bool:
        return not self.no_timing


def command_line() -> str:
    """The command as typed, for the comment of what it wrote; the same command gives the same bytes."""
    import shlex

    return shlex.join(["brdfguide", *sys.argv[1:]])


def print_json(document: dict) -> None:
    """One JSON object on stdout."""
    say(json_text(document))


def answer(document: dict, json: bool, words: Callable[[dict], str]) -> None:
    """A document on stdout as JSON, or in words made of it, in which every text of it is shown and none acts."""
    print_json(document) if json else tell(words(printable.document(document)))


def tell(text: str, end: str = "\n") -> None:
    """Words for a person on stdout: no line is wider than a terminal; in a pipe lines stay whole."""
    from ..report.text.folding import page

    say(page(text), end)


def remark(text: str, quiet: bool = False) -> None:
    """A sentence for the person, on stderr; what it names is shown by `printable`."""
    if not quiet:
        whisper(printable.sentence(text))


def on_terminal(stream=None) -> bool:
    """Whether colour and boxes are welcome: a UTF-8 terminal, NO_COLOR unset, TERM not dumb."""
    stream = stream or sys.stdout
    return (
        stream.isatty()
        and "NO_COLOR" not in os.environ
        and os.environ.get("TERM") != "dumb"
        and (stream.encoding or "").lower().replace("-", "") == "utf8"
    )


def output_file(path: Path | None) -> Path | None:
    """A callback: refuses a file that could not be written before anything is computed for it.

    A pattern such as {stem}.png is no file yet.
    """
    return path if path is None or str(path) == "-" or is_pattern(path) else writable(path)


def is_pattern(path: Path | str) -> bool:
    """Whether a part of it stands for the surface's own name."""
    return any(part in str(path) for part in PATTERNS)


def picture_file(path: Path | None) -> Path | None:
    """The same for a picture."""
    if path is not None:
        picture_kind(path)
    return output_file(path)


@contextmanager
def working(what: str, quiet: bool = False):
    """What takes longer than a second, and for how long by now, as a line on a terminal's stderr that goes when it is
    done; nothing elsewhere."""
    if quiet or not on_terminal(sys.stderr):
        yield
        return
    done, began, words = Event(), monotonic(), printable.short(what)

    def show() -> None:
        while not done.wait(PATIENCE_S):
            print(f"\r\x1b[K{words}, {monotonic() - began:.0f} s", end="", file=sys.stderr, flush=True)

    shown = Thread(target=show, daemon=True)
    shown.start()
    try:
        yield
    finally:
        done.set()
        shown.join()
        print("\r\x1b[K", end="", file=sys.stderr, flush=True)


@contextmanager
def progress(steps: int, quiet: bool = False, eta: bool = False):
    """A function that names each step as it begins; draws a bar on a terminal's stderr and nothing elsewhere.

    With `eta` each step is named as it ends, and the bar says how long the rest will take.
    """
    if quiet or not on_terminal(sys.stderr):
        yield lambda what: None
        return
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    look: tuple = (BarColumn(bar_width=24), TextColumn("{task.description}", markup=False), TimeElapsedColumn())
    if eta:
        look = (look[0], MofNCompleteColumn(), TimeElapsedColumn(), TextColumn("left"), TimeRemainingColumn(), look[1])
    with Progress(*look, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=steps)
        done = 0 if eta else -1

        def tell(what: str) -> None:
            nonlocal done
            done += 1
            bar.update(task, description=printable.short(what), completed=done)

        yield tell
