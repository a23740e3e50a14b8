"""A contact sheet: many surfaces as small spheres, all exposed alike."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from ...exporters.exporter import ColouredSurface
from ...printable import label, short
from .. import render
from . import style

SMALL = 160  # pixels of a sphere
COLUMNS = 6
MARGIN = 10  # pixels
WORDS = 42  # pixels below each, of three lines
LETTERS = 28  # of a line


def contact_sheet(surfaces: Sequence[ColouredSurface], captions: Sequence[tuple[str, str, str]]):
    """A figure with a sphere for each surface, its name, and two lines about it."""
    pictures = [np.clip(render.tone(render.render(each, SMALL, "side")), 0, 1) for each in surfaces]
    columns = min(COLUMNS, len(pictures))
    lines = -(-len(pictures) // columns)
    width, height = columns * (SMALL + MARGIN) + MARGIN, lines * (SMALL + MARGIN + WORDS) + MARGIN
    with style.look():
        fig = style.figure(width / style.DOTS_PER_INCH * 25.4, height / style.DOTS_PER_INCH * 25.4)
        fig.set_layout_engine(None)
        for place, (picture, (name, *about)) in enumerate(zip(pictures, captions, strict=True)):
            x = MARGIN + (place % columns) * (SMALL + MARGIN)
            top = MARGIN + (place // columns) * (SMALL + MARGIN + WORDS)
            fig.figimage(picture, x, height - top - SMALL, origin="upper")
            below = 1 - (top + SMALL + 4) / height
            fig.text(x / width, below, label(short(Path(name).name, LETTERS)), fontsize=4, va="top", weight="bold")
            lines_about = "\n".join(label(short(each, LETTERS)) for each in about)
            fig.text(x / width, below - 12 / height, lines_about, fontsize=3.5, va="top", linespacing=1.4)
    return fig
