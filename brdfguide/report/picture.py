"""Previews side by side, with what differs between them amplified, as one picture of exact pixels."""

from textwrap import wrap

import numpy as np

from .. import preview
from . import style

AMPLIFIED = 4.0
MARGIN, LINE, LETTER = 12, 15, 6.6  # pixels; LETTER: mean width of one
LESS, MORE = np.array([0.0, 0.447, 0.698]), np.array([0.835, 0.369, 0.0])  # the palette's blue and vermilion


def sheet(captions: list[tuple[str, str]], radiances: list[np.ndarray], note: str = ""):
    """A figure with one preview per (name, parameters), and how each but the first differs from the first.

    All are exposed alike. Differences are of display luminance, times `AMPLIFIED`: vermilion where brighter than the first,
    blue where darker, white where the same; beside a pair, below three and more.
    """
    shown = [np.clip(preview.tone(each), 0, 1) for each in radiances]
    size, count = shown[0].shape[0], len(shown)
    letters = int(size / LETTER)
    below = count > 2
    columns = 3 if count == 2 else count
    cells = [(place, 0, name, small, picture) for place, ((name, small), picture) in enumerate(zip(captions, shown))]
    for place in range(1, count):
        words = f"display luminance, ×{AMPLIFIED:g}: orange where {captions[place][0]} is brighter, blue where darker"
        cells.append((place if below else 2, 1 if below else 0, f"minus {captions[0][0]}", words, difference(shown[0], shown[place])))
    head = MARGIN + LINE * (1 + max(len(wrap(small, letters)) for *_, small, _ in cells))
    foot = wrap(note, int(letters * columns)) if note else []
    width = columns * size + (columns + 1) * MARGIN
    height = (2 if below else 1) * (size + head) + LINE * len(foot) + MARGIN
    with style.look():
        fig = style.figure(width / style.DOTS_PER_INCH * 25.4, height / style.DOTS_PER_INCH * 25.4)
        fig.set_layout_engine(None)
        text = lambda x, y, words, **more: fig.text(x / width, 1 - y / height, words, fontsize=4, va="top", linespacing=1.3, **more)  # noqa: E731
        for column, row, name, small, picture in cells:
            x, y = MARGIN + column * (size + MARGIN), row * (size + head)
            fig.figimage(picture, x, height - y - head - size, origin="upper")
            text(x, y + MARGIN - 6, name, weight="bold")
            text(x, y + MARGIN - 6 + LINE, "\n".join(wrap(small, letters)))
        text(MARGIN, height - MARGIN - LINE * len(foot) + 6, "\n".join(foot))
    return fig


def difference(first, other) -> np.ndarray:
    """Amplified difference of display luminance as a colour, (height, width, 3)."""
    grey = np.clip(AMPLIFIED * (preview.luminance(other) - preview.luminance(first)), -1, 1)[..., None]
    return 1 + np.maximum(grey, 0) * (MORE - 1) + np.maximum(-grey, 0) * (LESS - 1)
