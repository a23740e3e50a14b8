"""A ranking as a figure: log BRDF against reflection angle as in the report, what is left over, and error against run time."""

from dataclasses import replace

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

from ..measurement import Measurement
from . import style
from .lines import LEAST_POINTS, MOST_LINES, NOMINAL_UM, Line, chosen, curve, lines_of, nominal_channel, seen, slices  # noqa: F401


def fit(ranking, measurement: Measurement, path) -> None:
    """Draw the ranking into `path`, a .png, .svg or .pdf file."""
    with style.look():
        fig = style.figure(180, 172)
        above, below = fig.subfigures(2, 1, height_ratios=(1.75, 1))
        lines = lines_of(ranking)
        _lobes(above, chosen(lines), measurement)
        _cost(below, lines)
        style.save(fig, path)


def lobes(lines: list[Line], measurement: Measurement, width_mm=180, height_mm=105, note=None, title=None):
    """The upper figure alone."""
    with style.look():
        fig = style.figure(width_mm, height_mm)
        _lobes(fig, lines, measurement, title)
        if note:
            style.origin(fig, note)
        return fig


def promised(lines: list[Line], thetas=(10.0, 45.0, 75.0), width_mm=180, height_mm=80):
    """Models without data at three angles of incidence, at 550 nm."""
    with style.look():
        fig = style.figure(width_mm, height_mm)
        axes = fig.subplots(1, len(thetas), sharey=True)
        for axis, theta in zip(axes, thetas):
            grid = _grid(theta, -85.0, 85.0)
            for number, line in enumerate(lines):
                values = _positive(curve(line, theta, grid, NOMINAL_UM, 0))
                axis.plot(grid, values, color=style.COLOURS[number % 8], ls=style.DASHES[number % 8], label=line.name)
            axis.axvline(theta, color=style.RULE, lw=0.8, zorder=0)
            axis.set(yscale="log", xlim=(-85, 85), title=f"$\\theta_i$ = {theta:g}°", xticks=(-60, -30, 0, 30, 60))
        top = axes[0].get_ylim()[1]
        axes[0].set_ylim(max(axes[0].get_ylim()[0], top * 1e-6), top)
        axes[0].set_ylabel("BRDF [sr$^{-1}$]")
        axes[len(thetas) // 2].set_xlabel("reflection angle $\\theta_r$ [deg], mirror direction marked")
        fig.legend(handles=axes[0].get_legend_handles_labels()[0], loc="outside upper left", ncols=3)
        return fig


def cost(lines: list[Line], width_mm=180, height_mm=72):
    """Error against run time alone."""
    with style.look():
        fig = style.figure(width_mm, height_mm)
        _cost(fig, lines)
        return fig


def timed_lines(ranking, timing: dict) -> list[Line]:
    """Every row of a Ranking with the times of `bench` in place of its own."""
    largest = max(row["n"] for row in timing["rows"])
    at = {row["model"]: row for row in timing["rows"] if row["n"] == largest}
    return [replace(line, ns=at[line.name]["time_per_sample_ns"]["min"], on_front=at[line.name]["on_front"]) for line in lines_of(ranking)]


def write_cost(lines: list[Line], path) -> None:
    """Draw error against run time into `path`, a .png, .svg or .pdf file."""
    with style.look():
        fig = style.figure(180, 110)
        _cost(fig, lines)
        style.save(fig, path)


def _lobes(fig, lines, measurement, title=None):
    channel = nominal_channel(measurement)
    wavelength = float(np.broadcast_to(measurement.geom.wavelength, (len(measurement.channels),))[channel])
    panels, (off_plane, spread) = slices(measurement, channel)
    if not panels:
        fig.text(0.5, 0.5, "too few directions near the plane of incidence to draw", ha="center")
        return
    axes = fig.subplots(2, len(panels), sharex="col", sharey="row", height_ratios=(3.2, 1), squeeze=False)
    everything = np.concatenate([measurement.brdf[picked, channel] for _, picked in panels])
    left_over = []
    for place, (theta_i, picked) in enumerate(panels):
        part = measurement[picked]
        theta_r, value = part.geom.signed_theta_r_deg[:, 0], part.brdf[:, channel]
        top, strip = axes[:, place]
        reach = min(89.0, np.abs(theta_r).max() + 1)
        grid = _grid(theta_i, -reach if theta_r.min() < 0 else 0.0, reach)
        sparse = picked.size < 60  # then points are larger and lie over the lines
        for number, line in enumerate(lines):
            look = dict(color=style.COLOURS[number % 8], zorder=3 - 0.01 * number)
            top.plot(grid, _positive(curve(line, theta_i, grid, wavelength, channel, measurement.solid_angle)), ls=style.DASHES[number % 8], **look)
            model = seen(line, part.geom.at(np.array([wavelength])), channel, measurement.solid_angle)
            residual = np.log(_positive(model) / value)
            left_over.append(residual[np.isfinite(residual)])
            strip.plot(theta_r, residual, style.MARKERS[number % 8], ms=2.6 if sparse else 1.6, mew=0, alpha=0.85, **look)
        top.plot(theta_r, value, "o", color=style.INK, ms=3.2 if sparse else 2.3, mew=0, zorder=4 if sparse else 2, alpha=0.8)
        strip.axhline(0, color=style.INK, lw=0.6)
        for axis in (top, strip):
            axis.axvline(theta_i, color=style.RULE, lw=0.8, zorder=0)
        top.set_title(f"$\\theta_i$ = {theta_i:g}°")
        top.set_xlim(-reach if theta_r.min() < 0 else min(0.0, theta_r.min()), reach)
        strip.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 1.5, 2, 3, 5, 10]))
    low, high = everything.min() / 1.8, everything.max() * 1.8
    axes[0, 0].set_yscale("log")
    axes[0, 0].set_ylim(low, high)
    if high / low < 200:
        _plain_log(axes[0, 0].yaxis)
    axes[0, 0].set_ylabel("BRDF [sr$^{-1}$]")
    axes[1, 0].set_ylabel("ln(model/data)")
    limit = min(3.0, max(0.15, 1.15 * np.quantile(np.abs(np.concatenate(left_over)), 0.98))) if left_over else 1.0
    axes[1, 0].set_ylim(-limit, limit)
    axes[1, len(panels) // 2].set_xlabel("reflection angle $\\theta_r$ [deg], mirror direction marked")
    _legend(fig, title, lines, measurement, channel, wavelength, off_plane, spread)


def _legend(fig, title, lines, measurement, channel, wavelength, off_plane, spread):
    where = "in plane" if off_plane < 1 else f"within {off_plane:g}° of the plane of incidence"
    name = measurement.channels[channel]
    label = "data" if name == "brdf" else f"data, {name}"
    handles = [Line2D([], [], ls="", marker="o", color=style.INK, ms=3, mew=0, label=f"{label}, {where}")]
    for number, line in enumerate(lines):
        handles.append(Line2D([], [], color=style.COLOURS[number % 8], ls=style.DASHES[number % 8], label=f"{line.name}  (rms ln {line.rms_ln:.3g})"))
    fig.legend(handles=handles, loc="outside upper left", ncols=2, columnspacing=2.5, title=title, title_fontsize=9, alignment="left")


def _cost(fig, lines):
    axis = fig.subplots()
    timed = [line for line in lines if line.ns]
    if not timed:
        _errors_only(axis, lines)
        return
    time, error = np.array([line.ns for line in timed]), np.array([line.rms_ln for line in timed])
    front = np.array([line.on_front for line in timed])
    order = np.argsort(time[front])
    stairs = np.append(time[front][order], time.max() * 2), np.append(error[front][order], error[front].min())
    axis.step(*stairs, where="post", color=style.COLOURS[0], lw=1, zorder=1, label="Pareto front: none is better in both")
    axis.plot(time[front], error[front], "o", color=style.COLOURS[0], ms=4.5, zorder=3)
    axis.plot(time[~front], error[~front], "o", mfc=style.PAPER, color=style.INK, ms=4, mew=0.8, zorder=2)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_xlim(time.min() / 2, time.max() * 4)
    axis.set_ylim(error.min() / 1.4, error.max() * 1.5)
    _plain_log(axis.yaxis)
    _plain_log(axis.xaxis)
    axis.set_xlabel("time per sample [ns]")
    axis.set_ylabel("error, rms ln")
    axis.legend(loc="upper right")
    _name_points(fig, axis, timed, time, error, stairs)


def _errors_only(axis, lines):
    """Without times: one row per model."""
    places = np.arange(len(lines))
    axis.plot([line.rms_ln for line in lines], places, "o", color=style.COLOURS[0], ms=4)
    axis.set_yticks(places, [line.name for line in lines])
    axis.invert_yaxis()
    axis.set_xscale("log")
    _plain_log(axis.xaxis)
    axis.grid(axis="y")
    axis.set_xlabel("error, rms ln (times left out)")


def _name_points(fig, axis, lines, time, error, front):
    """A name beside each point, as near as no other name, point or part of the front (x, y) is, inside the frame."""
    fig.figure.draw_without_rendering()
    scale = fig.figure.dpi / 72
    in_points = lambda x, y: axis.transData.transform(np.column_stack((x, y))) / scale  # noqa: E731
    at, frame = in_points(time, error), axis.get_window_extent().extents / scale
    taken = [(x - 3, y - 3, x + 3, y + 3) for x, y in at]
    stairs = in_points(*front)
    for (x0, y0), (x1, y1) in zip(stairs, stairs[1:]):
        taken += [(x0, y0 - 0.5, x1, y0 + 0.5), (x1 - 0.5, min(y0, y1), x1 + 0.5, max(y0, y1))]
    for place in np.argsort(at[:, 1]):
        (x, y), width = at[place], 4.1 * len(lines[place].name)
        offsets = [(dx, dy) for dy in np.arange(-60, 61, 5) for dx in (5, -5 - width, -width / 2, 20, -20 - width) if abs(dy) > 6 or abs(dx) < 6 or dx == -5 - width]
        offsets.sort(key=lambda by: np.hypot(np.clip(0, by[0], by[0] + width), 1.5 * by[1]))
        for dx, dy in offsets:
            box = (x + dx, y + dy - 4, x + dx + width, y + dy + 4)
            inside = frame[0] < box[0] and box[2] < frame[2] and frame[1] < box[1] and box[3] < frame[3]
            if inside and not any(box[0] < b[2] and b[0] < box[2] and box[1] < b[3] and b[1] < box[3] for b in taken):
                break
        taken.append(box)
        leader = dict(arrowstyle="-", lw=0.4, color=style.INK, shrinkA=0, shrinkB=2) if np.hypot(max(dx, -dx - width, 0), dy) > 11 else None
        axis.annotate(lines[place].name, (time[place], error[place]), (dx, dy), textcoords="offset points", va="center",
                      fontsize=7, arrowprops=leader, bbox=dict(fc="none", ec="none", pad=0.5))  # fmt: skip


def _plain_log(axis):
    """Plain numbers on a log axis, as few as fit."""
    low, high = axis.get_view_interval()
    axis.set_major_locator(LogLocator(subs=(1, 2, 5) if high > 8 * low else (1, 1.5, 2, 3, 4, 5, 6, 8), numticks=20))
    axis.set_major_formatter(lambda value, _: f"{value:g}")
    axis.set_minor_formatter(NullFormatter())


def _grid(theta_i, low, high):
    """Every half degree, and closer near the mirror direction where a narrow lobe would fall between."""
    fine = theta_i + np.concatenate((-(np.geomspace(2, 0.01, 25)), [0.0], np.geomspace(0.01, 2, 25)))
    grid = np.unique(np.concatenate((np.linspace(low, high, int(2 * (high - low)) + 1), fine)))
    return grid[(grid >= low) & (grid <= high)]


def _positive(values):
    """Zeros as NaN, so that a log axis leaves them out."""
    return np.where(values > 0, values, np.nan)


def page_figures(ranking, measurement: Measurement) -> list[tuple[bytes, str]]:
    """What a report page shows of a ranking: (SVG, caption) of the lobes and of error against run time."""
    lines = lines_of(ranking)
    return [
        (style.render(lobes(chosen(lines), measurement)), "BRDF against reflection angle, on a log axis as the guide plots it, and what each model leaves over."),
        (style.render(cost(lines)), "Error against run time. A model on the front is beaten by no other in both."),
    ]
