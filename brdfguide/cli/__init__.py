"""The command line: one command per file. Parses, calls, shows; errors end here.

Only the command that was asked for is imported, so that each loads what it uses and nothing else.
"""

import os
import signal
import sys

from .. import catalog
from ..errors import BrdfguideError


def build(wanted: list[str]):
    """The Typer app with the commands in `wanted`; each file has a function of its own name."""
    import typer

    from ._help import Command, Group

    app = typer.Typer(
        name="brdfguide",
        cls=Group,
        help="Choose a reflectance model for a surface, and its parameters.",
        no_args_is_help=True,
        rich_markup_mode=None,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )

    @app.callback()
    def common(
        version: bool = typer.Option(False, "--version", "-V", help="Print the version and stop.", is_eager=True, callback=_print_version),
        debug: bool = typer.Option(False, "--debug", help="Show a traceback for every error."),
    ) -> None:
        """Choose a reflectance model for a surface, and its parameters."""

    for name in wanted:
        module = catalog.load("cli", name)
        command = getattr(module, name.replace("-", "_"))
        app.command(name, cls=Command, epilog=getattr(module, "EXAMPLES", None))(command)
    return app


def main(argv: list[str] | None = None) -> None:
    """Run one command and exit: 0 answered, 1 no trustworthy answer, 2 bad usage or input, 130 interrupted."""
    argv = sys.argv[1:] if argv is None else argv
    known = catalog.names("cli")
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # of a linear algebra library: our matrices are small, and its threads spin while they wait
    asked = next((word for word in argv if not word.startswith("-")), None)
    signal.signal(signal.SIGINT, lambda *_: sys.exit(130))  # before Typer turns it into a 1
    app = build([asked] if asked in known and "--show-completion" not in argv else known)
    try:
        app(argv, prog_name="brdfguide")
        status = 0
    except BrdfguideError as error:
        if "--debug" in argv:
            raise
        print(f"brdfguide: {error}", file=sys.stderr)
        status = error.exit_status
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        status = 0
    sys.exit(status)


def _print_version(value: bool) -> None:
    if value:
        from .. import __version__

        print(__version__)
        sys.exit(0)
