"""Previews side by side, with what differs between them amplified, as one picture of exact pixels."""

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap

import numpy as np

from ...errors import NoAnswer
from ...exporters import coloured
from ...exporters.exporter import ColouredSurface
from ...models.surface import Surface
from ...physics.colour import luminance
from ...physics.display import Display
from ...physics.geometry import WAVELENGTH_UM
from ...printable import label
from .. import render
from . import style

SMALL = 256  # pixels of a preview on a page
FULL = 20.0  # just noticeable differences that have full colour, as in the explorer
MARGIN = 12  # pixels
LINE = 15  # height of a line [pixels]
LETTER = 6.6  # mean width of a letter [pixels]
MOST_COLUMNS = 6  # of a contact sheet
LESS = np.array([0.0, 0.447, 0.698])  # the palette's blue
MORE = np.array([0.835, 0.369, 0.0])  # the palette's vermilion
DISPLAY = Display(exposure=render.EXPOSURE)


@dataclass(frozen=True, eq=False)
class Cell:
    """One picture of a sheet, where it stands, its name and what is said below it."""

    column: int
    row: int
    name: str
    small: str
    picture: np.ndarray


def picture_sheet(captions: list[tuple[str, str]], radiances: list[np.ndarray], note: str = "", compared: bool = True):
    """A figure with one preview per (name, parameters), and how each but the first differs from the first.

    All are exposed alike. Differences are of luminance in just noticeable steps: vermilion where brighter than the
    first, blue where darker, white where the same; beside a pair, below three and more. Where they are not `compared`,
    pictures alone, in rows.
    """
    shown = [np.clip(render.tone(each), 0, 1) for each in radiances]
    count = len(shown)
    columns = count if compared or count <= MOST_COLUMNS else min(MOST_COLUMNS, int(np.ceil(np.sqrt(1.5 * count))))
    cells = [
        Cell(place % columns, place // columns, name, small, picture)
        for place, ((name, small), picture) in enumerate(zip(captions, shown, strict=True))
    ]
    if compared:
        cells += _differences(captions, radiances)
        columns = 3 if count == 2 else count
    return _sheet(cells, columns, note)


def _differences(captions, radiances) -> list[Cell]:
    below, made = len(radiances) > 2, []
    for place in range(1, len(radiances)):
        steps = noticeable_steps(radiances[0], radiances[place])
        more = 100 * np.mean(np.abs(steps) > 1)
        words = (
            f"just noticeable steps of luminance, full colour at {FULL:g}: orange where {captions[place][0]} is "
            f"brighter, blue where darker; {more:.0f} % of the picture differs by more than one"
        )
        name = f"minus {captions[0][0]}"
        made.append(Cell(place if below else 2, int(below), name, words, difference_picture(steps)))
    return made


def _sheet(cells: list[Cell], columns: int, note: str):
    """A figure of exact pixels."""
    size = cells[0].picture.shape[0]
    letters = int(size / LETTER)
    rows = 1 + max(each.row for each in cells)
    head = MARGIN + LINE * (1 + max(len(wrap(each.small, letters)) for each in cells))
    foot = wrap(note, int(letters * columns)) if note else []
    width = columns * size + (columns + 1) * MARGIN
    height = rows * (size + head) + LINE * len(foot) + MARGIN
    with style.look():
        fig = style.figure(width / style.DOTS_PER_INCH * 25.4, height / style.DOTS_PER_INCH * 25.4)
        fig.set_layout_engine(None)

        def text(x, y, words, **more):
            shown = "\n".join(label(line, style.MOST_OF_A_LINE) for line in words.split("\n"))
            return fig.text(x / width, 1 - y / height, shown, fontsize=4, va="top", linespacing=1.3, **more)

        for each in cells:
            x, y = MARGIN + each.column * (size + MARGIN), each.row * (size + head)
            fig.figimage(each.picture, x, height - y - head - size, origin="upper")
            text(x, y + MARGIN - 6, each.name, weight="bold")
            text(x, y + MARGIN - 6 + LINE, "\n".join(wrap(each.small, letters)))
        text(MARGIN, height - MARGIN - LINE * len(foot) + 6, "\n".join(foot))
    return fig


def noticeable_steps(first, other) -> np.ndarray:
    """How much brighter the other picture is, in just noticeable differences of luminance, (height, width)."""
    return DISPLAY.logarithm(luminance(np.maximum(other, 0))) - DISPLAY.logarithm(luminance(np.maximum(first, 0)))


def difference_picture(steps) -> np.ndarray:
    """Just noticeable differences (height, width) as a colour, (height, width, 3)."""
    grey = np.clip(steps / FULL, -1, 1)[..., None]
    return 1 + np.maximum(grey, 0) * (MORE - 1) + np.maximum(-grey, 0) * (LESS - 1)


def preview_sheet(surfaces: Sequence[ColouredSurface], radiances, about: str, compared: bool = True):
    """The same with the name and the shape of each surface, what lights them, and the tone curve."""
    curve = f"exposure {render.EXPOSURE:g}, linear up to half of white, above it 1 - 1/(4x), sRGB"
    words = "; ".join([about, curve, *dict.fromkeys(each.colour.how for each in surfaces)])
    return picture_sheet([_caption(each) for each in surfaces], list(radiances), words, compared)


def _caption(surface: ColouredSurface) -> tuple[str, str]:
    """Name, and the parameters that shape what is seen."""

    def short(value):
        return f"{np.mean(value):.3g}" + (" on average" if np.ptp(value) > 0 else "")

    words = []
    for key, value in surface.values.items():
        parameter = surface.model.parameters.get(key)
        if parameter is not None and (parameter.free or short(value) != "0"):
            unit = "°" if parameter.unit == "rad" else parameter.unit
            words.append(f"{key} {short(parameter.outside(value))} {unit}".strip())
    return surface.name, ", ".join(words)


def picture_of_looks(surfaces: list[Surface]) -> tuple[bytes, str]:
    """A preview of each surface, side by side, as PNG, and what it shows in words."""
    made = [_shown(each) for each in surfaces]
    picture = picture_sheet([(each.name, "") for each in made], [render.render(each, SMALL) for each in made])
    how = f"The same light on each, a small sun and a sky with a horizon; {made[0].colour.how}."
    return style.figure_file(picture, "png"), how


def _shown(surface: Surface) -> ColouredSurface:
    """In colour where the channels carry one, else in the channel nearest 550 nm as grey."""
    made = coloured(surface, surface.model.name)
    try:
        made.colour  # noqa: B018  raises where the channels carry none
    except NoAnswer:
        nearest = int(np.argmin(np.abs(surface.wavelengths - WAVELENGTH_UM)))
        return coloured(surface.channel(nearest), surface.model.name)
    return made
