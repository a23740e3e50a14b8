"""What a description promises: its candidates at their start values, without data."""

from collections.abc import Sequence

import numpy as np

from ... import printable
from ...advice.recommend import Proposal
from ...models.surface import Surface
from . import spheres, style
from .lines import MIRROR_DEG, MOST_LINES, Line, curve, grid_of, has_spike, without_zeros

MOST_LOOKS = 3  # previews on a page
DECADES = 6  # most of an axis


def promised(candidates: Sequence[Proposal], thetas=(10.0, 45.0, 75.0), width_mm=180, height_mm=84, name: str = ""):
    """Candidates of a description at their start values, at three angles of incidence and 550 nm, the first marked.

    A mirror image is what a receiver of half angle 1 degree reads of it.
    """
    lines = []
    for place, each in enumerate(candidates[:MOST_LINES]):
        grey = {key: float(np.mean(value)) for key, value in each.start.items()}
        lines.append(Line(each.model.name, Surface(each.model, grey), None, recommended=place == 0))
    with style.look():
        fig = style.figure(width_mm, height_mm)
        axes = fig.subplots(1, len(thetas), sharey=True)
        values = []
        for axis, theta in zip(axes, thetas, strict=True):
            grid = grid_of(theta, -85.0, 85.0)
            for line in lines:
                values.append(without_zeros(curve(line, 0, theta, grid)))
                axis.plot(grid, values[-1], label=line.words, zorder=3 if line.recommended else 2, **line.look)
            axis.axvline(theta, color=style.RULE, lw=0.8, zorder=0)
            axis.set(yscale="log", xlim=(-85, 85), title=f"$\\theta_i$ = {theta:g}°", xticks=(-60, -30, 0, 30, 60))
        everything = np.concatenate(values)
        top = np.nanmax(everything) * 2
        axes[0].set_ylim(max(np.nanmin(everything) / 2, top * 10**-DECADES), top)
        axes[0].set_ylabel("BRDF [sr$^{-1}$]")
        axes[len(thetas) // 2].set_xlabel("reflection angle $\\theta_r$ [deg], mirror direction marked")
        title = f"{printable.label(name, 60)}: {_what(lines)}" if name else _what(lines)
        handles = axes[0].get_legend_handles_labels()[0]
        fig.legend(handles=handles, loc="outside upper left", ncols=2, title=title, title_fontsize=9, alignment="left")
        if any(has_spike(line, 0, theta) for line in lines for theta in thetas):
            style.origin(fig, f"spikes: mirror images as a receiver of half angle {MIRROR_DEG:g}° reads them")
        return fig


def _what(lines: list[Line]) -> str:
    return "models at their start values" if len(lines) > 1 else "the model at its start values"


def promise_figures(candidates: Sequence[Proposal], name: str = "") -> list[style.PageFigure]:
    """What a page shows of a description: what its candidates promise, and how they look; nothing if there are none."""
    if not candidates:
        return []
    caption = "What the candidates promise in the plane of incidence at their start values."
    looks = spheres.pictures_of_looks([each.surface for each in candidates[:MOST_LOOKS]])
    return [(style.figure_file(promised(candidates, name=name)), caption), looks]
