"""A plan as a picture: where the detector goes for every incidence, and what is expected after each block."""

import numpy as np
from matplotlib.lines import Line2D

from ..text.plan import plan_head
from . import style

COLUMNS = 4
MOST_PANELS = 12


def plan_figure(document: dict):
    """Panels of incidences, the detector's hemisphere from above, mirror direction to the right; below, the promise
    where it changes from block to block.

    Call inside `style.look()`.
    """
    groups = _by_incidence(document)
    rows = -(-len(groups) // COLUMNS)
    changes = len(document["blocks"]) > 1 or document["blocks"][0]["expected_before"] is not None
    fig = style.figure(180, 40 * rows + 12 + 42 * changes)
    style.title(fig, plan_head(document)[0])
    grid = fig.add_gridspec(rows + changes, COLUMNS, height_ratios=[1.0] * rows + [1.05] * changes)
    for place, (label, points) in enumerate(groups):
        _panel(fig.add_subplot(grid[place // COLUMNS, place % COLUMNS]), label, points)
    marks = _marks(len(document["blocks"]))
    fig.legend(handles=marks, loc="outside lower center", ncols=min(len(marks), 8))
    if changes:
        _promise(fig.add_subplot(grid[rows, :]), document)
    return fig


def _block_look(number: int) -> dict:
    colour = style.COLOURS[(0, 1, 2, 3, 5, 6)[number % 6]]
    return {"marker": style.MARKERS[number % len(style.MARKERS)], "color": colour, "ls": "", "mew": 0}


def _marks(blocks: int) -> list[Line2D]:
    """What the marks of all panels mean."""
    light = Line2D([], [], marker="o", ls="", ms=6, mfc="none", mec=style.COLOURS[4], mew=1.1, label="light")
    mirror = Line2D([], [], marker="+", ls="", ms=7, color=style.INK, mew=0.8, label="mirror direction")
    each = [Line2D([], [], ms=5.5, label=f"block {number + 1}", **_block_look(number)) for number in range(blocks)]
    return [*each, light, mirror]


def _by_incidence(document: dict) -> list[tuple[str, list]]:
    """(label, [(theta_i, theta_r, phi, block)]) of at most twelve bands of incidence."""
    points = [
        (each["theta_i_deg"], each["theta_r_deg"], each["phi_deg"], number)
        for number, block in enumerate(document["blocks"])
        for each in block["directions"]
    ]
    angles = sorted({each[0] for each in points})
    width = 1e-6 if len(angles) <= MOST_PANELS else 10.0
    bands: list[tuple[str, list]] = []
    for low in angles if width < 1 else np.arange(0.0, 90.0, width).tolist():
        inside = [each for each in points if low - 1e-9 <= each[0] < low + width]
        if inside:
            label = f"θi = {low:g}°" if width < 1 else f"θi {low:g} to {low + width:g}°"
            bands.append((label, inside))
    return bands


def _panel(axis, label: str, points: list) -> None:
    """The hemisphere of the detector from above; rings every 30 degrees."""
    turn = np.linspace(0, 2 * np.pi, 200)
    for ring in (30, 60, 90):
        colour = style.INK if ring == 90 else style.RULE
        axis.plot(ring * np.cos(turn), ring * np.sin(turn), color=colour, lw=0.6 if ring == 90 else 0.5)
    axis.plot([-90, 90], [0, 0], color=style.RULE, lw=0.5)
    for theta_i in sorted({each[0] for each in points}):
        axis.plot(-theta_i, 0, "o", ms=6, mfc="none", mec=style.COLOURS[4], mew=1.1)
        axis.plot(theta_i, 0, "+", ms=7, color=style.INK, mew=0.8)
    for block in sorted({each[3] for each in points}):
        chosen = [each for each in points if each[3] == block]
        azimuth = np.radians([180.0 - each[2] for each in chosen])
        radius = np.array([each[1] for each in chosen])
        axis.plot(radius * np.cos(azimuth), radius * np.sin(azimuth), ms=4.2, **_block_look(block))
    axis.set_title(label, loc="center")
    axis.set_aspect("equal")
    axis.set_xlim(-97, 97)
    axis.set_ylim(-97, 97)
    axis.axis("off")


def _promise(axis, document: dict) -> None:
    """What is expected after each block."""
    blocks = document["blocks"]
    counts = np.cumsum([len(each["directions"]) for each in blocks])
    after = [each["expected_after"] for each in blocks]
    known = [blocks[0]["expected_before"]] if blocks[0]["expected_before"] is not None else []
    axis.plot([0] * len(known) + counts.tolist(), known + after, "-", color=style.RULE, lw=1.2, zorder=1)
    for number, (count, value) in enumerate(zip(counts, after, strict=True)):
        axis.plot(count, value, ms=5.5, zorder=2, **_block_look(number))
    axis.set_xlim(0, counts[-1] * 1.05)
    axis.margins(y=0.25)
    axis.set_xlabel("directions measured")
    axis.set_ylabel(NAMES[document["purpose"]])
    axis.grid(True)


NAMES = {
    "error": "expected error\n(1: a fit to all directions)",
    "tell": "difference of the two models\n(noises of one value)",
    "pin": "standard error left\n(1: today's)",
}
