"""Options that several commands share, and how they write: results to stdout, the rest to stderr."""

import os
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

from typer import Option

from ..outputs import picture_kind, writable

JsonOption = Annotated[bool, Option("--json", help="One JSON object on stdout.")]
QuietOption = Annotated[bool, Option("--quiet", "-q", help="No notes on stderr.")]
ForceOption = Annotated[bool, Option("--force", help="Replace an existing output file.")]
NoTimingOption = Annotated[bool, Option("--no-timing", help="Leave out times, so that two runs give the same bytes.")]


def command_line() -> str:
    """The command as typed, for the comment of what it wrote; the same command gives the same bytes."""
    import shlex

    return shlex.join(["brdfguide", *sys.argv[1:]])


def print_json(document: dict) -> None:
    """One JSON object; NaN and infinity are null, since JSON has neither."""
    import json

    from ..report.plain import plain

    print(json.dumps(plain(document), indent=2, allow_nan=False))


def note(text: str, quiet: bool = False) -> None:
    """A sentence for the person, on stderr."""
    if not quiet:
        print(text, file=sys.stderr)


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
    """A callback: refuses a file that could not be written before anything is computed for it."""
    return path if path is None or str(path) == "-" else writable(path)


def picture_file(path: Path | None) -> Path | None:
    """The same for a picture."""
    if path is not None:
        picture_kind(path)
    return output_file(path)


@contextmanager
def progress(steps: int, quiet: bool = False):
    """A function that names each step as it begins; draws a bar on a terminal's stderr and nothing elsewhere."""
    if quiet or not on_terminal(sys.stderr):
        yield lambda what: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    look = (BarColumn(bar_width=24), TextColumn("{task.description}"), TimeElapsedColumn())
    with Progress(*look, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=steps)
        done = -1

        def tell(what: str) -> None:
            nonlocal done
            done += 1
            bar.update(task, description=what, completed=done)

        yield tell
