"""Options that several commands share, and how they write: results to stdout, the rest to stderr."""

import os
import sys
from pathlib import Path
from typing import Annotated

from typer import Option

from ..errors import InputError

JsonOption = Annotated[bool, Option("--json", help="One JSON object on stdout.")]
QuietOption = Annotated[bool, Option("--quiet", "-q", help="No notes on stderr.")]
ForceOption = Annotated[bool, Option("--force", help="Replace an existing output file.")]
NoTimingOption = Annotated[bool, Option("--no-timing", help="Leave out times, so that two runs give the same bytes.")]


def print_json(document: dict) -> None:
    """One JSON object; NaN and infinity are null, since JSON has neither."""
    import json

    print(json.dumps(plain(document), indent=2, allow_nan=False))


def plain(value):
    """`value` with arrays as lists, and null for what is not finite."""
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, float) and not (abs(value) < float("inf")):
        return None
    return value


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


def write_whole(path: Path, content: bytes | str, *, force: bool = True) -> None:
    """Write `path` whole or not at all. Raises InputError where it may not or cannot be written."""
    path = Path(path)
    if path.exists() and not force:
        raise InputError(f"{path} exists; --force replaces it")
    data = content.encode() if isinstance(content, str) else content
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        partial.write_bytes(data)
        partial.replace(path)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise InputError(f"cannot write {path}: {error.strerror}") from None
