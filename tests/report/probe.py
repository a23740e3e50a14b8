"""What is wrong with a figure, found without an eye: empty panels, texts over each other, points outside."""

from itertools import combinations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.text import Text

from brdfguide.report.figures import style

SLACK = 1.5  # pixels


def faults(fig: Figure) -> list[str]:
    """A sentence for each fault; none for a figure that may be shown. Looked at as it is saved, inside `look()`."""
    with style.look():
        fig.draw_without_rendering()
        return [*_empty_panels(fig), *_texts(fig), *_points_outside(fig)]


def _empty_panels(fig: Figure):
    for axis in fig.axes:
        lines = [line for line in axis.get_lines() if np.isfinite(np.asarray(line.get_ydata(), float)).any()]
        if not (lines or axis.collections or axis.patches or axis.images or axis.texts):
            yield f"a panel is empty: {axis.get_title('left') or axis.get_xlabel()}"


def _texts(fig: Figure):
    shown = [
        text for text in fig.findobj(Text) if text.get_text().strip() and text.get_visible() and _is_drawn(fig, text)
    ]
    boxes = [Text.get_window_extent(text) for text in shown]  # an annotation's own counts its leader
    page = fig.bbox
    for text, box in zip(shown, boxes, strict=True):
        if box.x0 < page.x0 - SLACK or box.x1 > page.x1 + SLACK or box.y0 < page.y0 - SLACK or box.y1 > page.y1 + SLACK:
            yield f"text leaves the page: {text.get_text()!r}"
    for (one, a), (other, b) in combinations(zip(shown, boxes, strict=True), 2):
        across = min(a.x1, b.x1) - max(a.x0, b.x0)
        along = min(a.y1, b.y1) - max(a.y0, b.y0)
        if across > SLACK and along > SLACK and one.get_rotation() == other.get_rotation():
            yield f"texts over each other: {one.get_text()!r} and {other.get_text()!r}"


def _is_drawn(fig: Figure, text: Text) -> bool:
    """Ticks beyond the limits, and of panels without axes, are kept by matplotlib and not drawn."""
    for axis in fig.axes:
        for which in (axis.xaxis, axis.yaxis):
            ticks = which.get_major_ticks() + which.get_minor_ticks()
            if any(text in (tick.label1, tick.label2) for tick in ticks):
                low, high = sorted(which.get_view_interval())
                return axis.axison and any(
                    low <= tick.get_loc() <= high and (text is tick.label1 or tick.label2.get_visible())
                    for tick in ticks
                    if text in (tick.label1, tick.label2)
                )
    return True


def _points_outside(fig: Figure):
    """Data are dots in ink; all of them are seen."""
    for axis in fig.axes:
        for line in axis.get_lines():
            if line.get_marker() != "o" or line.get_color() != "#1f2328" or axis.name != "rectilinear":
                continue
            x, y = np.asarray(line.get_xdata(), float), np.asarray(line.get_ydata(), float)
            (x0, x1), (y0, y1) = sorted(axis.get_xlim()), sorted(axis.get_ylim())
            there = np.isfinite(x) & np.isfinite(y)
            outside = there & ~((x >= x0) & (x <= x1) & (y >= y0) & (y <= y1))
            if outside.any():
                yield f"{outside.sum()} points lie outside {axis.get_title('left') or axis.get_xlabel()}"
