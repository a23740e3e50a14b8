"""The command line: one command per file. Parses, calls, shows; errors end here.

Only what was asked for is imported: shell loops call `roughness` thousands of times.
"""

import gc
import sys

# New objects between two searches for rubbish. Nearly all that a command loads stays, and to look through it again and
# again took a twentieth of the time of a fit; arrays are freed without it.
OBJECTS_BETWEEN = 100_000


def main(argv: list[str] | None = None) -> None:
    """Run one command and exit: 0 answered, 1 no trustworthy answer, 2 bad usage or input, 130 interrupted."""
    gc.set_threshold(OBJECTS_BETWEEN)
    try:
        from . import _streams
        from ._fast import answered
    except KeyboardInterrupt:
        sys.exit(130)
    alone = argv is None  # nothing runs after it in this process
    argv = sys.argv[1:] if argv is None else argv
    _streams.prepare_streams()
    status: int | str | None = 0
    try:
        if not answered(argv):
            from ._app import run_command

            status = run_command(argv)
    except KeyboardInterrupt:
        status = 130
    except SystemExit as end:
        status = end.code
        if _streams.given_up():
            status = 0
    except OSError as error:
        status = _streams.failed(error)
    _heard()
    if alone:
        gc.freeze()  # the interpreter looks through all that is left before it ends, though nothing is kept
    sys.exit(_streams.closed(status))


def _heard() -> None:
    """No signal is raised again from here on; where none was listened for, nothing is imported for it."""
    stopping = sys.modules.get(f"{__package__.rpartition('.')[0]}.stopping")
    if stopping is not None:
        stopping.heard()
