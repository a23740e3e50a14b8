"""Standard output and error, whatever they are: of any encoding, closed, full, or read by somebody who has enough."""

import codecs
import io
import os
import sys


def prepare_streams() -> None:
    """Signs that an encoding lacks are shown in those that it has; a stream that is closed is told from one that is not
    there."""
    codecs.register_error("shown", _shown)
    sys.stdout = _whole(sys.stdout)
    if sys.stdin is None:
        sys.stdin = open(os.open(os.devnull, os.O_RDONLY), closefd=False)  # noqa: SIM115
    if sys.stdout is None:
        # A handle that cannot be written to, so that whoever writes is told.
        sys.stdout = open(os.open(os.devnull, os.O_RDONLY), "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    if sys.stderr is None:
        sys.stderr = open(os.open(os.devnull, os.O_WRONLY), "w", closefd=False)  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="shown")


def _whole(stream):
    """A stream that writes all or says why not: without a buffer (PYTHONUNBUFFERED) what a full disk left out would be
    nobody's error. Of the process's own alone: another belongs to whoever put it there."""
    own = sys.__stdout__
    if own is None or stream is not own or not isinstance(getattr(own, "buffer", None), io.RawIOBase):
        return stream
    buffered = io.BufferedWriter(io.FileIO(own.fileno(), "w", closefd=False))
    return io.TextIOWrapper(buffered, own.encoding, own.errors, line_buffering=own.line_buffering)


def _shown(error: UnicodeError):
    """What an encoding lacks, which few answers of `roughness` in a shell loop come to."""
    from ..printable import shown

    return shown(error)


def say(text: str, end: str = "\n", *, shown: bool = False) -> bool:
    """An answer on standard output, all of it at once; whether anybody reads on: one who has enough, such as `head`, is
    no error. `shown`: colours of ours stand in it, and `printable` has shown the rest. Raises InputError where it
    cannot be written."""
    from ..printable import lines

    try:
        sys.stdout.write((text if shown else lines(text)) + end)
        sys.stdout.flush()
    except OSError as error:
        return _gone(error)
    return True


def write_out(content: str) -> None:
    """A file's text on standard output: the same bytes as in a file. Raises InputError where it cannot be written."""
    if not hasattr(sys.stdout, "buffer"):
        say(content, end="")
        return
    try:
        sys.stdout.buffer.write(content.encode(errors="backslashreplace"))
        sys.stdout.flush()
    except OSError as error:
        _gone(error)


def _gone(error: OSError) -> bool:
    """False where the reader has enough; InputError for anything else."""
    _nowhere(sys.stdout)
    if not isinstance(error, BrokenPipeError):
        from ..errors import InputError

        raise InputError(f"cannot write standard output: {error.strerror}") from None
    return False


def whisper(text: str, end: str = "\n") -> None:
    """Something for the person, on standard error; where that cannot be written there is nobody to tell."""
    from ..printable import lines

    try:
        sys.stderr.write(_on_screen(lines(text)) + end)
        sys.stderr.flush()
    except OSError:
        _nowhere(sys.stderr)


def _on_screen(text: str) -> str:
    """Folded where standard error is a terminal; in a file a sentence is a line."""
    if not sys.stderr.isatty():
        return text
    from ..report.text.folding import page, screen_width

    return page(text, screen_width(sys.stderr))


def failed(error: OSError) -> int:
    """The status for an error of a stream: 0 where its reader has enough."""
    _nowhere(sys.stdout)
    if isinstance(error, BrokenPipeError):
        return 0
    whisper(f"brdfguide: cannot write standard output: {error.strerror}")
    return 2


def given_up() -> bool:
    """Whether the parser, printing its help, met a reader who has enough, and put its own stream in place of ours."""
    return type(sys.stdout).__name__ == "PacifyFlushWrapper"


def closed(status):
    """The status in the end, once everything is written."""
    try:
        sys.stdout.flush()
    except OSError as error:
        return max(failed(error), status or 0)
    return status


def _nowhere(stream) -> None:
    """What is still to be written goes nowhere, also when the interpreter ends."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except (OSError, ValueError):  # a stream without a handle
        return
