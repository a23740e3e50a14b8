"""What can go wrong, and the exit status that says so."""


class BrdfguideError(Exception):
    """One clear sentence for the user; `exit_status` is what the shell sees."""

    exit_status = 1


class InputError(BrdfguideError):
    """Bad usage or input: says what was found, what was wanted, and where."""

    exit_status = 2


class NoAnswer(BrdfguideError):
    """Understood, but there is no answer that could be trusted."""

    exit_status = 1


def choices(kind: str, found: str, known) -> InputError:
    """The error for a word that is not one of `known`, with the nearest ones first."""
    from difflib import get_close_matches  # only ever needed on the way out

    known = list(known)
    near = get_close_matches(found.lower(), known, n=3, cutoff=0.6)
    hint = f"did you mean {' or '.join(near)}? " if near else ""
    return InputError(f"no {kind} called '{found}'; {hint}there are: {', '.join(known)}")


def no_such_file(path, name: str) -> InputError:
    """The error for a file that is not there, with the nearest names in the same folder."""
    from difflib import get_close_matches
    from pathlib import Path

    try:
        beside = [each.name for each in Path(path).parent.iterdir()]
    except OSError:
        beside = []
    near = get_close_matches(Path(path).name, beside, n=2, cutoff=0.6)
    return InputError(f"{name}: there is no such file" + (f"; did you mean {' or '.join(near)}?" if near else ""))
