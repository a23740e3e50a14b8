"""What the parser could not take, in a sentence like every other: what was found, and what was wanted."""

from ..printable import sentence, short

WHOLE = "a whole number"
NUMBERS = {"float": "a number", "float range": "a number", "int": WHOLE, "int range": WHOLE}  # by the parser's names


def usage_sentence(error, command: str) -> str:
    """Takes  an error of the parser, and the command it was about, of which the help says what may stand there."""
    if type(error).__name__ == "NoArgsIsHelpError":
        return error.format_message()
    return f"brdfguide: {sentence(f'{_said(error)}; `{command} -h` says what there is')}"


def _said(error) -> str:
    kind = type(error).__name__
    if kind == "NoSuchOption":
        near = sorted(error.possibilities or ())
        return f"no option called '{short(error.option_name)}'" + (
            f"; did you mean {' or '.join(near)}?" if near else ""
        )
    if kind == "BadOptionUsage":
        return f"{error.option_name}: {_decapitalised(error.message.removeprefix(f'Option {error.option_name!r} '))}"
    if kind == "MissingParameter":
        return f"found nothing for {error.param.human_readable_name}"
    if kind == "BadParameter" and error.param is not None:
        return _of_value(error)
    words, extra, more = error.message.partition("Got unexpected extra argument")
    if extra:
        return f"found more than it takes: {more.rpartition('(')[2].removesuffix(').').removesuffix(')')}"
    return _decapitalised(error.message).replace(". Did you", "; did you")


def _of_value(error) -> str:
    """Of `'80,5' is not a valid float.` and `7 is not in the range 0<=x<=1.` what was wanted, in words."""
    name, said = error.param.opts[0], error.message.rstrip(".")
    found, between, bounds = said.partition(" is not in the range ")
    if between:
        return f"{name} {found}: wanted {_range(bounds)}"
    found, between, kind = said.partition(" is not a valid ")
    if between and kind in NUMBERS:
        return f"{name} {short(found)}: wanted {NUMBERS[kind]}"
    return f"{name}: {_decapitalised(said)}"


def _range(bounds: str) -> str:
    """`0<=x<=1` as `0 to 1`, `x>=1` as `1 or more`."""
    low, between, high = bounds.partition("<=x<=")
    if between:
        return f"{float(low):g} to {float(high):g}"
    low = bounds.removeprefix("x>=")
    return bounds if low == bounds else f"{float(low):g} or more"


def _decapitalised(said: str) -> str:
    return said[:1].lower() + said[1:].rstrip(".")
