"""Error against run time: which models no other beats in both."""

from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from . import style
from .lines import Line, lines_of
from .lobes import plain_log

TIME = "time per sample [ns], our NumPy in batches of this file's size: not a shader's cost"
STEP = 5  # points, between places that are tried for a name
LETTER_PT = 7
GAP_PT = 4.0  # between names on one line, which would read as one word
LEAST_ROW_MM = 3.4
NEAR_PT, FAR_PT = 11.0, 60.0  # how far a name is from its point: beyond, a leader leads there; none leads farther
CLEAR = 6.0  # points about its own, where a leader is not looked at


def plot_cost(lines: list[Line], width_mm=180, height_mm=72, time: str = TIME, title: str = ""):
    """A figure of error against run time."""
    with style.look():
        fig = style.figure(width_mm, cost_height_mm(lines, height_mm))
        if title:
            style.title(fig, title)
        draw_cost(fig, lines, time)
        return fig


def cost_height_mm(lines: list[Line], usual_mm: float) -> float:
    """What is usual; of the errors alone, one row per model, more where names would touch, and less for few rows."""
    if any(line.ns for line in lines):
        return usual_mm
    return min(max(usual_mm, 18 + LEAST_ROW_MM * len(lines)), 18 + 5 * len(lines))


def timed_lines(ranking, timing: dict) -> list[Line]:
    """Every row of a Ranking with the times of `bench` in place of its own."""
    largest = max(row["n"] for row in timing["rows"])
    at = {row["model"]: row for row in timing["rows"] if row["n"] == largest}
    return [
        replace(line, ns=at[line.name]["time_per_sample_ns"]["min"], on_front=at[line.name]["on_front"])
        for line in lines_of(ranking)
    ]


def write_cost(lines: list[Line], path, samples: int, title: str, theme: str = style.LIGHT) -> None:
    """Draw error against run time for so many samples at once into `path`, a .png, .svg or .pdf file."""
    words = f"time per sample [ns], our NumPy at {samples} samples at once: not a shader's cost"
    style.save(plot_cost(lines, 180, 110, words, title), path, theme)


def draw_cost(fig, lines: list[Line], words: str = TIME) -> None:
    """The same into a figure or a part of one; without times the errors alone."""
    axis = fig.subplots()
    timed = [line for line in lines if line.ns]
    if not timed:
        _errors_only(axis, lines)
        return
    time, error = np.array([line.ns for line in timed]), np.array([line.rms_ln for line in timed])
    front = np.array([line.on_front for line in timed])
    order = np.argsort(time[front])
    least = np.minimum.accumulate(error[front][order])  # the front is by operations, which times follow roughly
    stairs = np.append(time[front][order], time.max() * 2), np.append(least, error[front].min())
    axis.step(*stairs, where="post", color=style.RULE, lw=1.4, zorder=1, label="front: none is better in both")
    for line, x, y in zip(timed, time, error, strict=True):
        look: dict[str, Any] = {"mfc": line.stroke.colour if line.on_front else style.PAPER, "mec": line.stroke.colour}
        axis.plot(x, y, "o", ms=4.5, mew=1.2, zorder=3, **look)
        if line.recommended:
            ring: dict[str, Any] = {"mfc": "none", "mec": style.INK, "ls": "", "label": "recommended"}
            axis.plot(x, y, "o", ms=9, mew=1.2, zorder=3, **ring)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlim(time.min() / 2, time.max() * 4)
    room = max(1.5, (error.max() / error.min()) ** 0.06)  # of a share of the axis, where it spans many decades
    axis.set_ylim(error.min() / room, error.max() * room)
    plain_log(axis.yaxis)
    plain_log(axis.xaxis)
    axis.set_xlabel(words)
    axis.set_ylabel("error, rms ln")
    legend = axis.legend(loc="upper right")
    _name_points(fig, axis, timed, np.column_stack((time, error)), np.column_stack(stairs), legend)


def _errors_only(axis, lines: list[Line]) -> None:
    """Without times: one row per model."""
    places = np.arange(len(lines))
    for place, line in zip(places, lines, strict=True):
        axis.plot(line.rms_ln, place, "o", color=line.stroke.colour, ms=4.5)
        if line.recommended:
            axis.plot(line.rms_ln, place, "o", ms=9, mfc="none", mec=style.INK, mew=1.2)
    names = axis.set_yticks(places, [line.name for line in lines])
    for tick, line in zip(names, lines, strict=True):
        tick.label1.set_fontweight("bold" if line.recommended else "normal")
    axis.set_ylim(len(lines) - 0.4, -0.6)
    axis.set_xscale("log")
    plain_log(axis.xaxis)
    axis.grid(axis="y")
    axis.set_xlabel("error, rms ln (times left out); the recommended model ringed")


def _name_points(fig, axis, lines: list[Line], at, stairs, legend) -> None:
    """A name beside each point, as near as no other name, point, leader or part of the front is, inside the frame.

    Where every leader would cross something or be long, a model off the front stays without a name.
    """
    style.freeze_layout(fig.figure)
    scale = fig.figure.dpi / 72
    points, corners = axis.transData.transform(at) / scale, axis.transData.transform(stairs) / scale
    frame = axis.get_window_extent().extents / scale
    taken = [(x - 4, y - 4, x + 4, y + 4) for x, y in points]
    taken.append(tuple(legend.get_window_extent().extents / scale))
    steps: list[tuple] = []  # of the front: a name keeps off, its leader may cross
    for (x0, y0), (x1, y1) in pairwise(corners):
        steps += [(x0, y0 - 0.5, x1, y0 + 0.5), (x1 - 0.5, min(y0, y1), x1 + 0.5, max(y0, y1))]
    for place in np.argsort(points[:, 1]):
        line, (x, y) = lines[place], points[place]
        look: dict[str, Any] = {"textcoords": "offset points", "va": "center", "fontsize": LETTER_PT}
        look |= {"weight": "bold" if line.recommended else "normal"}
        name = axis.annotate(line.name, tuple(at[place]), (0, 0), **look)
        width = name.get_window_extent().width / scale
        name.remove()
        dx, dy, box, leads, clear = _free_place(x, y, width, frame, taken, steps)
        if not (clear or line.on_front or line.recommended):
            continue
        taken.append((box[0] - GAP_PT, box[1], box[2] + GAP_PT, box[3]))
        if leads:
            end = ((np.clip(x, box[0], box[2]) - box[0]) / width, 0.0 if box[1] > y else 1.0)
            look["arrowprops"] = {
                "arrowstyle": "-",
                "lw": 0.4,
                "color": style.INK,
                "relpos": end,
                "shrinkA": 0,
                "shrinkB": 2,
            }
            taken += [(a - 1.0, b - 1.0, a + 1.0, b + 1.0) for a, b in _leader(x, y, box)]
        axis.annotate(line.name, tuple(at[place]), (dx, dy), **look)


def _free_place(x, y, width, frame, taken, steps):
    """(dx, dy, box, whether a leader leads there, whether it is clear and short): the nearest place that is free; where
    every leader to one crosses something, the nearest all the same; the nearest of all if none is free.
    """
    sides = [side for apart in (6, 24, 60, 110, 170) for side in (apart, -apart - width)]
    offsets = [
        (dx, dy)
        for dy in np.arange(-90, 91, STEP)
        for dx in (-width / 2, *sides)
        if abs(dy) > 6 or dx in sides[:2] or abs(dx) > 100
    ]
    offsets.sort(key=lambda by: np.hypot(np.clip(0, by[0], by[0] + width), 1.5 * by[1]))
    crossing = None
    for dx, dy in offsets:
        box = (x + dx, y + dy - 4.5, x + dx + width, y + dy + 4.5)
        inside = frame[0] + 2 < box[0] and box[2] < frame[2] - 2 and frame[1] + 2 < box[1] and box[3] < frame[3] - 2
        away = np.hypot(max(dx, -dx - width, 0), dy)
        leads = away > NEAR_PT
        if not inside or any(_overlap(box, each) for each in (*taken, *steps)):
            continue
        if not leads or not any(a[0] < px < a[2] and a[1] < py < a[3] for px, py in _leader(x, y, box) for a in taken):
            return dx, dy, box, leads, away < FAR_PT
        crossing = crossing or (dx, dy, box, leads, False)
    if crossing:
        return crossing
    dx, dy = offsets[0]
    return dx, dy, (x + dx, y + dy - 4.5, x + dx + width, y + dy + 4.5), False, False


def _leader(x, y, box):
    """Points along the line from a point to the nearest place of its name."""
    across, along = np.clip(x, box[0], box[2]) - x, np.clip(y, box[1], box[3]) - y
    length = np.hypot(across, along)
    shares = np.arange(CLEAR, length - 1.0, 1.0) / max(length, 1e-9)
    return [(x + share * across, y + share * along) for share in shares]


def _overlap(one, other) -> bool:
    return one[0] < other[2] and other[0] < one[2] and one[1] < other[3] and other[1] < one[3]
