"""Previews side by side, with what differs between them amplified, as one picture of exact pixels."""

from collections.abc import Sequence
from functools import cache
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from textwrap import wrap

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ...errors import NoAnswer
from ...exporters import coloured
from ...exporters.exporter import ColouredSurface
from ...models.surface import Surface
from ...physics.colour import luminance
from ...physics.display import Display
from ...physics.geometry import WAVELENGTH_UM
from ...printable import short
from ...records import dataclass
from .. import render
from . import palette

SMALL = 256  # pixels of a preview on a page
FULL = 20.0  # just noticeable differences that have full colour, as in the explorer
MARGIN = 12  # pixels
LINE = 15  # height of a line [pixels]
LETTER = 6.6  # mean width of a letter [pixels]
LETTER_HEIGHT = 11  # of the font, 4 points at the 200 dots an inch of figures
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


def picture_sheet(
    captions: list[tuple[str, str]], radiances: list[np.ndarray], note: str = "", compared: bool = True
) -> bytes:
    """A PNG with one preview per (name, parameters), and how each but the first differs from the first.

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


def _differences(captions, radiances, clear: bool = False) -> list[Cell]:
    below, made = len(radiances) > 2, []
    for place in range(1, len(radiances)):
        steps = noticeable_steps(radiances[0], radiances[place])
        more = 100 * np.mean(np.abs(steps) > 1)
        words = (
            f"just noticeable steps of luminance, full colour at {FULL:g}: orange where {captions[place][0]} is "
            f"brighter, blue where darker; {more:.0f} % of the picture differs by more than one"
        )
        name = f"minus {captions[0][0]}"
        picture = clear_difference(steps) if clear else difference_picture(steps)
        made.append(Cell(place if below else 2, int(below), name, words, picture))
    return made


def caption(text: str, letters: int) -> list[str]:
    """Lines that break at blanks, not within the names of models."""
    return wrap(text, letters, break_on_hyphens=False)


def _sheet(cells: list[Cell], columns: int, note: str) -> bytes:
    """A picture of exact pixels, as PNG. Pillow writes its words: matplotlib takes as long to load as all else."""
    size = cells[0].picture.shape[0]
    letters = int(size / LETTER)
    rows = 1 + max(each.row for each in cells)
    head = MARGIN + LINE * (1 + max(len(caption(each.small, letters)) for each in cells))
    foot = caption(note, int(letters * columns)) if note else []
    width = columns * size + (columns + 1) * MARGIN
    height = rows * (size + head) + LINE * len(foot) + MARGIN
    made = Image.new("RGB", (width, height), palette.PAPER)
    draw = ImageDraw.Draw(made)

    def text(x, y, lines, font="DejaVuSans.ttf"):
        for place, line in enumerate(lines):
            draw.text((x, y + LINE * place), short(line, letters * columns), palette.INK, _font(font), anchor="la")

    for each in cells:
        x, y = MARGIN + each.column * (size + MARGIN), each.row * (size + head)
        pixels = (255 * np.clip(each.picture, 0, 1) + 0.5).astype(np.uint8)
        made.paste(Image.fromarray(pixels), (x, y + head))
        text(x, y + MARGIN - 6, [short(each.name, letters)], "DejaVuSans-Bold.ttf")
        text(x, y + MARGIN - 6 + LINE, caption(each.small, letters))
    text(MARGIN, height - MARGIN - LINE * len(foot) + 6, foot)
    out = BytesIO()
    made.save(out, "PNG", optimize=False)
    return out.getvalue()


@cache
def _font(name: str):
    """One of the fonts that matplotlib brings, which is not imported for it."""
    found = find_spec("matplotlib")
    assert found is not None and found.origin is not None
    place = Path(found.origin).parent / "mpl-data" / "fonts" / "ttf" / name
    return ImageFont.truetype(str(place), LETTER_HEIGHT)  # older versions of Pillow take no Path


def noticeable_steps(first, other) -> np.ndarray:
    """How much brighter the other picture is, in just noticeable differences of luminance, (height, width)."""
    return DISPLAY.logarithm(luminance(np.maximum(other, 0))) - DISPLAY.logarithm(luminance(np.maximum(first, 0)))


def difference_picture(steps) -> np.ndarray:
    """Just noticeable differences (height, width) as a colour, (height, width, 3)."""
    grey = np.clip(steps / FULL, -1, 1)[..., None]
    return 1 + np.maximum(grey, 0) * (MORE - 1) + np.maximum(-grey, 0) * (LESS - 1)


def clear_difference(steps) -> np.ndarray:
    """The same with opacity, (height, width, 4): over white it is that picture."""
    share = np.clip(steps / FULL, -1, 1)[..., None]
    return np.concatenate((np.where(share > 0, MORE, LESS), np.abs(share)), axis=-1)


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


def pictures_of_looks(surfaces: list[Surface]) -> tuple[list[tuple[bytes, str, str]], str]:
    """A preview of each surface and how each but the first differs from that, as (PNG, name, words); and their light.

    A difference is clear where there is none, so that it stands on any ground.
    """
    made = [_shown(each) for each in surfaces]
    radiances = [render.render(each, SMALL) for each in made]
    captions = [(each.name, "") for each in made]
    shown = [(_png(render.tone(each)), name, "") for each, (name, _) in zip(radiances, captions, strict=True)]
    shown += [(_png(each.picture), each.name, each.small) for each in _differences(captions, radiances, clear=True)]
    how = f"The same light on each, a small sun and a sky with a horizon; {made[0].colour.how}."
    return shown, how


def _png(picture) -> bytes:
    """Of values from 0 to 1, (height, width, 3 or 4)."""
    out = BytesIO()
    Image.fromarray((255 * np.clip(picture, 0, 1) + 0.5).astype(np.uint8)).save(out, "PNG", optimize=False)
    return out.getvalue()


def _shown(surface: Surface) -> ColouredSurface:
    """In colour where the channels carry one, else in the channel nearest 550 nm as grey."""
    made = coloured(surface, surface.model.name)
    try:
        made.colour  # noqa: B018  raises where the channels carry none
    except NoAnswer:
        nearest = int(np.argmin(np.abs(surface.wavelengths - WAVELENGTH_UM)))
        return coloured(surface.channel(nearest), surface.model.name)
    return made
