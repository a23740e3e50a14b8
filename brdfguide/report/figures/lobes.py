"""Log BRDF against reflection angle as in the report, at up to three incidences, and what each model leaves over."""

from typing import Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

from ... import printable
from ...data.measurement import Measurement
from ...fitting.reading import reading
from ...physics.aperture import Instrument
from . import style
from .lines import MIRROR_DEG, Line, curve, grid_of, nominal_channel, without_zeros
from .panels import Panel, Panels, panels

MOST_OVER = 1e3  # how far above the data a mirror image may lift the frame
SPARSE = 60  # values of a panel; with fewer the points are larger and lie over the lines
MOST_RESIDUAL = 3.0
MANY_DECADES = 3e5  # of an axis, that has powers of ten alone


def plot_lobes(lines: list[Line], measurement: Measurement, width_mm=180, height_mm=105, note=None, title=None):
    """A figure of these lines and the data."""
    with style.look():
        fig = style.figure(width_mm, height_mm)
        draw_lobes(fig, lines, measurement, title)
        if note:
            style.origin(fig, note)
        return fig


def draw_lobes(fig, lines: list[Line], measurement: Measurement, title: str | None = None) -> None:
    """The same into a figure or a part of one."""
    channel = nominal_channel(measurement)
    drawn = panels(measurement, channel)
    if not drawn.shown:
        _over_half_vector(fig, lines, measurement, channel, title)
        return
    axes = fig.subplots(2, len(drawn.shown), sharex="col", sharey="row", height_ratios=(3.2, 1), squeeze=False)
    left_over, tops = [], []
    for place, panel in enumerate(drawn.shown):
        top, strip = axes[:, place]
        tops.append(_curves(top, lines, panel, channel, measurement.solid_angle))
        left_over.append(_residuals(lines, panel, channel, measurement.solid_angle))
        top.axvline(panel.theta_i, color=style.RULE, lw=0.8, zorder=0)
        top.set_title(f"$\\theta_i$ = {panel.theta_i:g}°")
        strip.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 1.5, 2, 3, 5, 10]))
    _frame(axes[0, 0], np.concatenate([panel.value for panel in drawn.shown]), max(tops))
    axes[0, 0].set_ylabel("BRDF [sr$^{-1}$]")
    _strips(axes[1], lines, drawn, left_over)
    axes[1, len(drawn.shown) // 2].set_xlabel("reflection angle $\\theta_r$ [deg], mirror direction marked")
    _legend(fig, title, lines, measurement, channel, drawn.how)


def _curves(axis, lines: list[Line], panel: Panel, channel: int, solid_angle: float | None) -> float:
    """Points and curves of one incidence; the greatest value of what is drawn."""
    angular_range = min(90.0, np.abs(panel.theta_r).max() + 1)
    least = -angular_range if panel.theta_r.min() < 0 else 0.0
    grid = grid_of(panel.theta_i, max(least, -89.0), min(angular_range, 89.0))
    sparse, greatest = len(panel.value) < SPARSE, 0.0
    for number, line in enumerate(lines):
        values = curve(line, channel, panel.theta_i, grid, solid_angle, panel.azimuth)
        greatest = max(greatest, float(np.max(values)) if line.shows_image else 0.0)
        above = 3.5 if line.recommended else 3 - 0.01 * number
        axis.plot(grid, without_zeros(values), zorder=above, **line.look)
    axis.plot(
        panel.theta_r,
        panel.value,
        "o",
        color=style.INK,
        ms=3.2 if sparse else 2.3,
        mew=0,
        zorder=4 if sparse else 2,
        alpha=0.8,
    )
    axis.set_xlim(least, angular_range)
    return greatest


def _residuals(lines: list[Line], panel: Panel, channel: int, solid_angle: float | None) -> list[np.ndarray]:
    """ln(model/data) of each line, as the instrument reads it."""
    instrument = Instrument(panel.geom, solid_angle)
    return [np.log(without_zeros(reading(each.surface.channel(channel), instrument)[:, 0]) / panel.value)
            for each in lines]  # fmt: skip


def _strips(axes, lines: list[Line], drawn: Panels, left_over: list[list[np.ndarray]]) -> None:
    """What is left; what lies outside the frame as a triangle at its edge."""
    everything = np.abs(np.concatenate([each for panel in left_over for each in panel])) if lines else np.zeros(1)
    everything = everything[np.isfinite(everything)]
    limit = min(MOST_RESIDUAL, max(0.15, 1.15 * np.quantile(everything, 0.98))) if everything.size else 1.0
    for axis, panel, residuals in zip(axes, drawn.shown, left_over, strict=True):
        size = 2.6 if len(panel.value) < SPARSE else 1.6
        for number, (line, residual) in enumerate(zip(lines, residuals, strict=True)):
            above = 3.5 if line.recommended else 3 - 0.01 * number
            look: dict[str, Any] = {"color": line.stroke.colour, "mew": 0, "alpha": 0.85, "zorder": above}
            axis.plot(panel.theta_r, residual, line.stroke.marker, ms=size, **look)
        for line, residual in zip(lines, residuals, strict=True):
            look = {"color": line.stroke.colour, "mew": 0, "zorder": 3}
            for sign, marker in ((1, "^"), (-1, "v")):
                outside = sign * residual > limit
                axis.plot(panel.theta_r[outside], np.full(outside.sum(), sign * 0.93 * limit), marker, ms=2.4, **look)
        axis.axhline(0, color=style.INK, lw=0.6)
        axis.axvline(panel.theta_i, color=style.RULE, lw=0.8, zorder=0)
    axes[0].set_ylim(-limit, limit)
    axes[0].set_ylabel("ln(model/data)")


def _frame(axis, values, image: float) -> None:
    """All data, and a mirror image above them as far as it may lift the frame."""
    low, high = values.min() / 1.8, values.max() * 1.8
    high = min(max(high, 1.5 * image), MOST_OVER * high)
    axis.set_yscale("log")
    axis.set_ylim(low, high)
    if high / low < 200:
        plain_log(axis.yaxis)


def _over_half_vector(fig, lines: list[Line], measurement: Measurement, channel: int, title) -> None:
    """Where no direction is near the plane: values and models over the half vector's angle, as points all of them."""
    usable = np.flatnonzero(measurement.usable[:, channel])
    part = measurement[usable]
    tilt = np.degrees(np.arctan(np.sqrt(part.geom.tan2_h[:, 0])))
    axis = fig.subplots()
    axis.plot(tilt, part.brdf[:, channel], "o", color=style.INK, ms=3, mew=0, alpha=0.8, zorder=2)
    for line in lines:
        values = reading(line.surface.channel(channel), part.instrument)[:, 0]
        axis.plot(tilt, without_zeros(values), line.stroke.marker, color=line.stroke.colour, ms=3, mfc="none", mew=0.7)
    if usable.size:
        _frame(axis, part.brdf[:, channel], 0.0)
    axis.set(xlabel="angle between half vector and normal $\\theta_h$ [deg]", ylabel="BRDF [sr$^{-1}$]")
    _legend(fig, title, lines, measurement, channel, "all directions, none near the plane", points=True)


def _legend(fig, title, lines: list[Line], measurement: Measurement, channel: int, how: str, points=False) -> None:
    name = measurement.channels[channel]
    label = "data" if name == "brdf" else f"data, {printable.label(name, 40)}"
    handles = [Line2D([], [], ls="", marker="o", color=style.INK, ms=3, mew=0, label=f"{label}, {how}")]
    for line in lines:
        error = "" if line.rms_ln is None else f"  (rms ln {line.rms_ln:.3g})"
        look = line.look
        if points:
            look |= {"ls": "", "marker": line.stroke.marker, "mfc": "none", "ms": 4}
        words = f"{line.name}{error}" + (", recommended" if line.recommended else "")
        handles.append(Line2D([], [], label=words, **look))
    if measurement.solid_angle is None and not points and any(line.shows_image for line in lines):
        spike = f"mirror images, in a receiver of {MIRROR_DEG:g}°"
        handles.append(Line2D([], [], ls="", marker="$\\wedge$", color=style.INK, ms=5, mew=0.3, label=spike))
    legend = fig.legend(
        handles=handles,
        loc="outside upper left",
        ncols=2,
        columnspacing=1.5,
        title=title,
        title_fontsize=9,
        alignment="left",
    )
    for text, line in zip(legend.get_texts()[1:], lines, strict=False):
        text.set_weight("bold" if line.recommended else "normal")
    if legend.get_window_extent().width > fig.bbox.width:
        legend.set_ncols(1)


def plain_log(axis) -> None:
    """Plain numbers on a log axis, as few as fit."""
    low, high = axis.get_view_interval()
    within = (1, 2, 5) if high > 8 * low else (1, 1.5, 2, 3, 4, 5, 6, 8)
    many = high > MANY_DECADES * low
    axis.set_major_locator(LogLocator(numticks=9) if many else LogLocator(subs=within, numticks=20))
    axis.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set_minor_formatter(NullFormatter())
