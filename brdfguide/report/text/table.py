"""Results as text: plain aligned columns that a script can cut and a person can read."""

from ...printable import width
from .folding import TIED, broken, screen_width

GAP = "  "
NARROWEST = 12  # columns of a cell whose words are folded
MOST_OF_A_NAME = 24  # columns that the names of the rows keep while others can give way


def columns(header: tuple[str, ...], lines, right: tuple[int, ...] = ()) -> str:
    """Aligned columns; those numbered in `right` are set flush right.

    In a pipe a row is a line, whatever its width. On a terminal that is too narrow the words in a cell are folded,
    never cut; numbers are not, and where they alone are too wide each row is a paragraph.
    """
    return "\n".join("\n".join(row) for row in row_lines(header, lines, right))


def row_lines(header: tuple[str, ...], lines, right: tuple[int, ...] = ()) -> list[list[str]]:
    """The same with the lines of each row apart, the header's first."""
    cells = [tuple(str(cell) for cell in line) for line in (header, *lines)]
    natural = [max(width(line[place]) for line in cells) for place in range(len(header))]
    screen = screen_width()
    widths = natural if screen is None else _narrowed(natural, right, screen)
    if widths is None:
        return [[""], *(_paragraph(header, row) for row in cells[1:])]
    return [_set(row, widths, right) for row in cells]


def _narrowed(natural: list[int], right: tuple[int, ...], screen: int) -> list[int] | None:
    """Widths that fit the screen, taken from the widest columns of words; None where none do."""
    widths = list(natural)
    while sum(widths) + len(GAP) * (len(widths) - 1) > screen:
        words = [place for place in range(len(widths)) if place not in right and widths[place] > NARROWEST]
        if not words:
            return None
        told = [place for place in words if place or widths[place] > MOST_OF_A_NAME]
        widths[max(told or words, key=lambda place: widths[place])] -= 1
    return widths


def _set(row: tuple[str, ...], widths: list[int], right: tuple[int, ...]) -> list[str]:
    """The lines of a row: each cell folded into its width."""
    folded = [
        [cell.replace(TIED, " ")] if width(cell) <= room else broken(cell, room)
        for cell, room in zip(row, widths, strict=True)
    ]
    lines = []
    for number in range(max(map(len, folded))):
        line = []
        for place, cell in enumerate(folded):
            text = cell[number] if number < len(cell) else ""
            space = " " * (widths[place] - width(text))
            line.append(space + text if place in right else text + space)
        lines.append(GAP.join(line).rstrip())
    return lines


def _paragraph(header: tuple[str, ...], row: tuple[str, ...]) -> list[str]:
    """A row as `name value` lines, under its first cell."""
    return [row[0], *(f"  {name} {cell}" for name, cell in zip(header[1:], row[1:], strict=True) if cell)]
