"""The guide's renderings as figures: panels of pixels, and below them what the guide says of them as numbers."""

import numpy as np

from .. import render
from ..path_traced.renderings import TITLES, Rendering
from . import style

PANEL_MM = 62.0  # width of a panel
MOST_IN_A_ROW = 2
FINE = 3  # significant digits of a number


def rendered_figure(number: int, made: Rendering, origin: str):
    """Figure 3, 6, 8, 10 or 12; the claims stand below it."""
    columns = min(len(made.panels), MOST_IN_A_ROW)
    rows = -(-len(made.panels) // columns)
    high, wide = made.panels[0][1].shape[:2]
    with style.look():
        fig = style.figure(columns * PANEL_MM + 8, rows * (PANEL_MM * high / wide + 6) + 14 + 3.2 * len(made.claims))
        axes = np.atleast_1d(fig.subplots(rows, columns)).ravel()
        for axis, (name, radiance) in zip(axes, made.panels, strict=True):
            axis.imshow(np.clip(render.tone(radiance), 0, 1), interpolation="nearest")
            axis.set_title(name, fontsize=7.5)
            axis.set_axis_off()
        style.title(fig, TITLES[number])
        claims = [f"{words}: {value:.{FINE}g}" for words, value in made.claims]
        style.origin(fig, "\n".join([*claims, origin]))
    return fig
