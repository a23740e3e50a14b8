"""Lines no wider than the screen that they are printed on. Loads nothing: `roughness` in a shell loop calls it too."""

import os
import sys

from ...printable import width

PAGE = 100  # columns of prose, on a wider screen and in a pipe
LEAST = 40  # columns that are always used
TIED = "\N{NO-BREAK SPACE}"  # stands between a number and its % while lines are broken
MOST_MARGIN = 30  # columns of an indentation that is kept on the lines that follow


def screen_width(stream=None) -> int | None:
    """Columns of the terminal that a stream, or standard output, is; None in a pipe or a file."""
    stream = stream or sys.stdout
    if not stream.isatty():
        return None
    said = os.environ.get("COLUMNS", "")
    if said.isdigit() and int(said):
        return max(int(said), LEAST)
    try:
        return max(os.get_terminal_size(stream.fileno()).columns or 80, LEAST)
    except (OSError, ValueError):
        return 80


def broken(text: str, room: int) -> list[str]:
    """The text in lines of at most `room` columns, broken at spaces; a longer word after a sign, or else anywhere.

    A number and its % stay together.
    """
    lines, line = [], ""
    for word in text.replace(" %", f"{TIED}%").split(" "):
        joined = f"{line} {word}" if line else word
        if width(joined) <= room:
            line = joined
            continue
        if line:
            lines.append(line)
        *whole, line = _parts(word, room)
        lines += whole
    return [each.rstrip(" ").replace(TIED, " ") for each in (*lines, line)]


def _parts(word: str, room: int) -> list[str]:
    """A word too long for a line: broken after the last +, comma, slash or = that fits, else where the line ends."""
    parts = []
    while width(word) > room:
        end = room
        while width(word[:end]) > room:
            end -= 1
        sign = max(word.rfind(each, 0, end) for each in "+,/;=")
        end = sign + 1 if sign > 0 else max(end, 1)
        parts.append(word[:end])
        word = word[end:]
    return [*parts, word]


def folded(text: str, first: str = "", further: str = "", room: int | None = None) -> str:
    """A paragraph of at most 100 columns, or of the terminal's if it is narrower, with margins."""
    room = room or min(screen_width() or PAGE, PAGE)
    head, *rest = broken(text, room - width(first))
    if rest:  # the margin of the lines that follow may be another
        rest = broken(text[len(head) :].lstrip(" "), room - width(further))
    return "\n".join([first + head, *(further + each for each in rest)])


def wrapped_text(text: str) -> str:
    """An indented paragraph."""
    return folded(text, "  ", "    ")


def page(text: str, room: int | None = None) -> str:
    """Every line that is too wide for the screen folded under its own beginning; in a pipe nothing is folded."""
    room = room or screen_width()
    if room is None:
        return text
    return "\n".join(line if width(line) <= room else _hanging(line, room) for line in text.split("\n"))


def _hanging(line: str, room: int) -> str:
    words = line.lstrip(" ")
    margin = " " * min(len(line) - len(words), MOST_MARGIN)
    return folded(words, margin, f"{margin}    ", room)
