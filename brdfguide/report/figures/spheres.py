"""Previews side by side, with what differs between them amplified, as one picture of exact pixels."""

from collections.abc import Sequence
from textwrap import wrap

import numpy as np

from ...errors import NoAnswer
from ...exporters import coloured
from ...exporters.exporter import ColouredSurface
from ...models.surface import Surface
from ...physics.colour import luminance
from ...physics.geometry import WAVELENGTH_UM
from ...printable import label
from .. import render
from . import style

SMALL = 256  # pixels of a preview on a page
AMPLIFIED = 4.0
MARGIN = 12  # pixels
LINE = 15  # height of a line [pixels]
LETTER = 6.6  # mean width of a letter [pixels]
LESS = np.array([0.0, 0.447, 0.698])  # the palette's blue
MORE = np.array([0.835, 0.369, 0.0])  # the palette's vermilion


def picture_sheet(captions: list[tuple[str, str]], radiances: list[np.ndarray], note: str = ""):
    """A figure with one preview per (name, parameters), and how each but the first differs from the first.

    All are exposed alike. Differences are of display luminance, times `AMPLIFIED`: vermilion where brighter than the
    first, blue where darker, white where the same; beside a pair, below three and more.
    """
    shown = [np.clip(render.tone(each), 0, 1) for each in radiances]
    size, count = shown[0].shape[0], len(shown)
    letters = int(size / LETTER)
    below = count > 2
    columns = 3 if count == 2 else count
    cells = [
        (place, 0, name, small, picture)
        for place, ((name, small), picture) in enumerate(zip(captions, shown, strict=True))
    ]
    for place in range(1, count):
        words = f"display luminance, ×{AMPLIFIED:g}: orange where {captions[place][0]} is brighter, blue where darker"
        cells.append(
            (
                place if below else 2,
                1 if below else 0,
                f"minus {captions[0][0]}",
                words,
                difference_picture(shown[0], shown[place]),
            )
        )
    head = MARGIN + LINE * (1 + max(len(wrap(small, letters)) for *_, small, _ in cells))
    foot = wrap(note, int(letters * columns)) if note else []
    width = columns * size + (columns + 1) * MARGIN
    height = (2 if below else 1) * (size + head) + LINE * len(foot) + MARGIN
    with style.look():
        fig = style.figure(width / style.DOTS_PER_INCH * 25.4, height / style.DOTS_PER_INCH * 25.4)
        fig.set_layout_engine(None)

        def text(x, y, words, **more):
            shown = "\n".join(label(line, style.MOST_OF_A_LINE) for line in words.split("\n"))
            return fig.text(x / width, 1 - y / height, shown, fontsize=4, va="top", linespacing=1.3, **more)

        for column, row, name, small, picture in cells:
            x, y = MARGIN + column * (size + MARGIN), row * (size + head)
            fig.figimage(picture, x, height - y - head - size, origin="upper")
            text(x, y + MARGIN - 6, name, weight="bold")
            text(x, y + MARGIN - 6 + LINE, "\n".join(wrap(small, letters)))
        text(MARGIN, height - MARGIN - LINE * len(foot) + 6, "\n".join(foot))
    return fig


def difference_picture(first, other) -> np.ndarray:
    """Amplified difference of display luminance as a colour, (height, width, 3)."""
    grey = np.clip(AMPLIFIED * (luminance(other) - luminance(first)), -1, 1)[..., None]
    return 1 + np.maximum(grey, 0) * (MORE - 1) + np.maximum(-grey, 0) * (LESS - 1)


def preview_sheet(surfaces: Sequence[ColouredSurface], radiances, light: str):
    """The same with the name and the shape of each surface, and where the sun stands."""
    elevation, azimuth = render.LIGHTS_DEG[light]
    about = f"sun {elevation:g}° high, {azimuth:g}° to the right of the camera; same exposure; {surfaces[0].colour.how}"
    return picture_sheet([_caption(each) for each in surfaces], list(radiances), about)


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
