"""The full parser: options, help, completion. Only the command that was asked for is imported."""

import os
import sys

from .. import catalog, printable, stopping
from ..errors import BrdfguideError, mistake
from ._complete import ASKED, codes_begun, offer, wanted
from ._streams import failed, say, whisper

# Of a linear algebra library: our matrices are small, and its threads spin while they wait.
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def build(wanted: list[str]):
    """The Typer app with the commands in `wanted`; each file has a function of its own name."""
    import typer

    from ._help import Command, Group
    from ._request import spread

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
        version: bool = typer.Option(
            False, "--version", "-V", help="Print the version and stop.", is_eager=True, callback=_print_version
        ),
        explain: str = typer.Option(
            None,
            "--explain",
            metavar="CODE",
            help="What a flag or a rule means, such as discrepancy, and stop.",
            is_eager=True,
            callback=_print_explanation,
            autocompletion=codes_begun,
        ),
        debug: bool = typer.Option(False, "--debug", help="Show a traceback for every error."),
    ) -> None:
        """Choose a reflectance model for a surface, and its parameters."""

    for name in wanted:
        module = catalog.load("cli", name)
        command = getattr(module, name.replace("-", "_"))
        parsed = spread(command)
        if ASKED in os.environ:
            offer(name, parsed)
        app.command(name, cls=Command, epilog=getattr(module, "EXAMPLES", None))(parsed)
    return app


def run_command(argv: list[str]) -> int:
    """Run one command: the exit status."""
    for name in THREADS:
        os.environ.setdefault(name, "1")
    stopping.listen()
    known = catalog.names("cli")
    asked = next((word for word in argv if not word.startswith("-")), None)
    if ASKED in os.environ:
        asked = None
        known = wanted(known)
    try:
        if argv[:1] == ["recommend"] and ASKED not in os.environ:
            from ._described import answered_description

            status = answered_description(argv[1:])
            if status is not None:
                return status
        app = build([asked] if asked in known and "--show-completion" not in argv else known)
        return app(argv, prog_name="brdfguide", standalone_mode=False) or 0
    except Exception as error:
        if "--debug" in argv:
            raise
        return _told(error, f"brdfguide {asked}" if asked in known else "brdfguide")


def _told(error: Exception, command: str) -> int:
    """Says what went wrong with a command; the exit status."""
    if isinstance(error, BrdfguideError):
        whisper(f"brdfguide: {error}")
        return error.exit_status
    if hasattr(error, "format_message"):  # the parser's
        from ._usage import usage_sentence

        whisper(usage_sentence(error, command))
        return 2
    if isinstance(error, MemoryError):
        whisper("brdfguide: there is not enough memory for this")
        return 2
    if isinstance(error, OSError):
        try:
            sys.stdout.flush()
        except OSError as unwritten:  # help, which the parser writes
            return failed(unwritten)
        what = f"{error.filename}: " if error.filename else ""
        whisper(f"brdfguide: {printable.sentence(f'{what}{error.strerror or error}')}")
        return 2
    whisper(f"brdfguide: {mistake(error)}")
    return 2


def _print_explanation(code: str | None) -> None:
    if code is not None:
        from ..report.documents.explained import explained
        from ..report.text.explained import explained_text

        say(explained_text(printable.document(explained(code))))
        sys.exit(0)


def _print_version(value: bool) -> None:
    if value:
        from .. import __version__

        say(__version__)
        sys.exit(0)
