"""What can go wrong, and the exit status that says so. `printable` is imported where something has gone wrong."""

MOST_CHOICES = 30  # that are all told
LISTED = ("material", "model")  # by a command of their name
MOST_NAMES = 2000  # of a folder, among which one spelt alike is looked for


class BrdfguideError(Exception):
    """One clear sentence for the user, or several, a line each; `exit_status` is what the shell sees.

    What the sentences quote is shown by `printable`: no sign of it acts on a terminal, none of it is longer than a
    person reads.
    """

    exit_status = 1

    def __str__(self) -> str:
        from . import printable

        return printable.sentences(self.args)


class InputError(BrdfguideError):
    """Bad usage or input: says what was found, what was wanted, and where.

    `line` is that of the file which the sentence is about, where it is about one.
    """

    exit_status = 2
    line: int | None = None


class NothingLeft(InputError):
    """A part of a table, or all of it, has no row that counts."""


class NoAnswer(BrdfguideError):
    """Understood, but there is no answer that could be trusted."""

    exit_status = 1


class EngineLost(BrdfguideError):
    """Whoever should have done the work, such as a cluster, cannot be reached."""

    exit_status = 3


class Stopped(SystemExit):
    """A signal asked the program to end; `code` is 128 and its number."""


def mistake(error: Exception) -> str:
    """The sentence for an error that should not be: ours, and where."""
    frame = error.__traceback__
    while frame is not None and frame.tb_next is not None:
        frame = frame.tb_next
    file = frame.tb_frame.f_code.co_filename.replace("\\", "/").rpartition("/")[2] if frame else ""
    where = f" in {file} line {frame.tb_lineno}" if frame else ""
    from . import printable

    what = printable.sentence(f"{type(error).__name__}{where}: {error}")
    return f"this is a mistake of brdfguide and not yours, please report it: {what}; --debug shows all of it"


def nearest_words(word: str, known, most: int, cutoff: float) -> list[str]:
    """Up to `most` of `known` that are spelt much like `word`."""
    from difflib import get_close_matches  # only ever needed on the way out

    from .printable import MOST_OF_A_WORD

    return get_close_matches(word[:MOST_OF_A_WORD], known, n=most, cutoff=cutoff)


def choices(kind: str, found: str, known) -> InputError:
    """The error for a word that is not one of `known`, with the nearest ones first."""
    from .printable import short

    known = list(known)
    near = nearest_words(found.lower(), known, 3, 0.6)
    if near and len(known) > MOST_CHOICES:
        return InputError(f"no {kind} called '{short(found)}'; did you mean {' or '.join(near)}?")
    if len(known) > MOST_CHOICES and kind in LISTED:
        return InputError(
            f"no {kind} called '{short(found)}', nor one like it; `brdfguide {kind}s` lists all {len(known)}"
        )
    hint = f"did you mean {' or '.join(near)}? " if near else ""
    return InputError(f"no {kind} called '{short(found)}'; {hint}there are: {', '.join(known)}")


def would_be_lost(name: str) -> InputError:
    """The error for a file to write that is read as well; `name` with the option that names it."""
    return InputError(f"{name}: it is read as well, and would be lost; write into another file")


def no_such_file(path, name: str) -> InputError:
    """The error for a file that is not there, with the nearest names in the same folder; for a link to nothing what it
    points to."""
    from pathlib import Path

    if Path(path).is_symlink():
        return InputError(f"{name}: it is a link to '{Path(path).readlink()}', and there is no such file")
    try:
        beside = [each.name for _, each in zip(range(MOST_NAMES), Path(path).parent.iterdir(), strict=False)]
    except (OSError, ValueError):
        beside = []
    near = nearest_words(Path(path).name, beside, 2, 0.6)
    return InputError(f"{name}: there is no such file" + (f"; did you mean {' or '.join(near)}?" if near else ""))
