"""`roughness` and `--version` without the full parser, for shell loops that call them thousands of times.

It reads only what it is sure of; anything else, and every error, is left to the full parser and said there. Both ways
end in the same function, and a test compares them on random command lines.
"""

import sys

NUMBERS = (
    "--angle",
    "--slope",
    "--sigma-um",
    "--tau-um",
    "--wavelength-nm",
    "--pupil-mm",
    "--distance-mm",
    "--angle-error",
)
SWITCHES = ("--contour", "--never", "--json", "--full", "--quiet", "-q")


def answered(argv: list[str]) -> bool:
    """Whether `argv` was answered here."""
    if argv in (["--version"], ["-V"]):
        from .. import __version__

        return _write(__version__ + "\n", "")
    if argv[:1] != ["roughness"]:
        return False
    question: dict = {}  # of numbers and switches
    words = iter(argv[1:])
    for word in words:
        name, equals, value = word.partition("=")
        if name in NUMBERS:
            try:
                number = float(value if equals else next(words))
            except (ValueError, StopIteration):
                return False
            if number - number != 0 or name[2:].replace("-", "_") in question:  # infinite, none, or told twice
                return False
            question[name[2:].replace("-", "_")] = number
        elif word in SWITCHES:
            question["quiet" if word == "-q" else word[2:]] = True
        else:
            return False
    from ..errors import BrdfguideError
    from ..report.text import emergence

    quiet = question.pop("quiet", False)
    if question.get("full") and question.get("json"):  # refused in one place
        return False
    try:
        text, notes = emergence.answer_text(**question)
    except BrdfguideError:
        return False
    return _write(text, "" if quiet else "".join(f"note: {note}\n" for note in notes))


def _write(out: str, err: str) -> bool:
    sys.stdout.write(out)
    sys.stdout.flush()
    sys.stderr.write(err)
    return True
