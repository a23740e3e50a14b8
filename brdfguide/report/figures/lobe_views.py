"""A ranking's lobes as shapes: polar curves in the plane of incidence, and one model's lobe in space."""

from typing import Any

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.lines import Line2D

from ...data.measurement import Measurement
from ...fitting.reading import reading
from ...physics.aperture import Instrument
from ...physics.geometry import Geometry, rows
from . import style
from .lines import Line, curve, grid_of, lines_of, nominal_channel, shown_lines, title_of, without_zeros
from .panels import Panel, panels

DECADES = 2.0, 5.0  # least and most of a radius
GRID = 61, 121  # theta_r and phi of a lobe in space
HEIGHT = LinearSegmentedColormap.from_list("height", ["#2b4c7e", "#0072B2", "#56B4E9", "#CFE3F2", "#E69F00"])


def plot_polar(ranking, measurement: Measurement, path, theme: str = style.LIGHT) -> None:
    """Radius log10 of the BRDF over the least that is drawn, direction that of the light that leaves."""
    lines = shown_lines(lines_of(ranking))
    channel = nominal_channel(measurement)
    shown = panels(measurement, channel).shown
    with style.look():
        fig = style.figure(180, 72)
        fig.set_layout_engine(None)
        low, high = _decades([panel.value for panel in shown])
        for place, panel in enumerate(shown):
            axis = fig.add_axes(_cell(place, len(shown), 0.05, -0.12, 1.0), projection="polar")
            _dial(axis, low, high)
            _light(axis, panel.theta_i, high - low)
            for line in lines:
                grid = grid_of(panel.theta_i, -89.0, 89.0)
                seen_by = measurement.solid_angle
                values = curve(line, channel, panel.theta_i, grid, seen_by, panel.azimuth)
                axis.plot(
                    np.radians(grid), _radius(values, low, high), zorder=3 if line.recommended else 2, **line.look
                )
            dots = _radius(panel.value, low, high)
            axis.plot(np.radians(panel.theta_r), dots, "o", color=style.INK, ms=1.8, mew=0, alpha=0.9, zorder=3.5)
            axis.set_title(f"$\\theta_i$ = {panel.theta_i:g}°", loc="left", y=0.78)
        handles = [Line2D([], [], ls="", marker="o", color=style.INK, ms=3, mew=0, label="data")]
        handles += [Line2D([], [], label=line.words, **line.look) for line in lines]
        title = title_of(lines_of(ranking), measurement.name)
        fig.legend(handles=handles, loc="upper left", ncols=3, title=title, title_fontsize=9, alignment="left")
        style.origin(fig, f"rings: decades of the BRDF, the outermost {10.0**high:g}/sr; the arrow is the light")
        style.save(fig, path, theme)


def plot_in_space(ranking, measurement: Measurement, path, theme: str = style.LIGHT) -> None:
    """The recommended model's lobe over the hemisphere at up to three incidences; radius as in the polar figure."""
    lines = lines_of(ranking)
    line = next((each for each in lines if each.recommended), lines[0])
    channel = nominal_channel(measurement)
    shown = panels(measurement, channel).shown
    with style.look():
        fig = style.figure(180, 72)
        fig.set_layout_engine(None)
        made = [_lobe(line, panel, channel, measurement.solid_angle) for panel in shown]
        high = float(np.log10(max(values.max() for _, values in made)))
        low = high - np.clip(high - np.log10(min(values.min() for _, values in made)) + 0.7, *DECADES)
        for place, (panel, (directions, values)) in enumerate(zip(shown, made, strict=True)):
            axis = fig.add_axes(_cell(place, len(shown), 0.0, -0.22, 1.45), projection="3d", computed_zorder=False)
            _surface(axis, directions, _radius(values, low, high) / (high - low))
            _stage(axis, panel.theta_i)
            fig.text((place + 0.06) / len(shown), 0.84, f"$\\theta_i$ = {panel.theta_i:g}°", fontsize=8.5)
        title = title_of(lines, measurement.name) + (f"; {line.name}, recommended" if len(lines) > 1 else "")
        style.title(fig, title)
        words = f"radius: decades of the BRDF above {10.0**low:.2g}/sr, the longest {10.0**high:.2g}/sr"
        style.origin(fig, f"{words}; the arrow is the light, the line the mirror direction")
        style.save(fig, path, theme)


def _decades(values: list[np.ndarray]) -> tuple[float, float]:
    """log10 of the least and the greatest that are drawn, whole decades above."""
    everything = np.concatenate([np.ravel(each) for each in values]) if values else np.ones(1)
    everything = everything[everything > 0]
    high = np.ceil(np.log10(everything.max()) - 1e-9)
    low = np.floor(np.log10(everything.min()) - 0.3)
    return high - np.clip(high - low, *DECADES), high


def _radius(values, low: float, high: float):
    """Decades above the least; nothing is drawn below."""
    return np.clip(np.log10(without_zeros(values)) - low, 0.0, high - low)


def _cell(place: int, count: int, gap: float, bottom: float, height: float) -> tuple[float, float, float, float]:
    """Left, bottom, width and height of one of several axes side by side, in shares of the figure."""
    return (place + gap) / count, bottom, (1 - 2 * gap) / count, height


def _dial(axis, low: float, high: float) -> None:
    axis.set_theta_zero_location("N")
    axis.set_theta_direction(-1)
    axis.set_thetamin(-90)
    axis.set_thetamax(90)
    axis.set_rlim(0, high - low)
    axis.set_xticks(np.radians([-60, -30, 0, 30, 60]))
    axis.set_yticks(np.arange(1, high - low + 0.5))
    axis.set_yticklabels([])
    axis.grid(color=style.RULE, linewidth=0.5)
    axis.tick_params(pad=1, labelsize=6.5)


def _light(axis, theta_i: float, radius: float) -> None:
    look: dict[str, Any] = {"arrowstyle": "-|>", "color": style.INK, "lw": 1.0}
    axis.annotate("", (0, 0), (np.radians(-theta_i), radius), arrowprops=look, zorder=4)
    axis.plot(np.radians([theta_i, theta_i]), [0, radius], color=style.RULE, lw=0.8, zorder=1)


def _lobe(line: Line, panel: Panel, channel: int, solid_angle: float | None):
    """Unit directions (theta, phi, 3), the mirror direction toward +x, and what is read in them."""
    theta, phi = np.meshgrid(np.linspace(0, 88, GRID[0]), np.linspace(0, 360, GRID[1]), indexing="ij")
    geom = rows(Geometry.from_degrees(panel.theta_i, 0.0, theta, phi + 180.0))
    values = reading(line.surface.channel(channel), Instrument(geom, solid_angle))[:, 0].reshape(theta.shape)
    t, p = np.radians(theta), np.radians(phi)
    return np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1), values


def _surface(axis, directions, radius) -> None:
    radius = np.nan_to_num(radius)
    x, y, z = np.moveaxis(directions * radius[..., None], -1, 0)
    axis.plot_surface(x, y, z, facecolors=HEIGHT(radius), rstride=1, cstride=1, linewidth=0, antialiased=False,
                      zorder=2)  # fmt: skip


def _stage(axis, theta_i: float) -> None:
    """The surface as a disc, the light as an arrow, the mirror direction as a line."""
    turn = np.linspace(0, 2 * np.pi, 100)
    axis.plot(np.cos(turn), np.sin(turn), 0, color=style.RULE, lw=0.8, zorder=1)
    axis.plot([-1, 1], [0, 0], [0, 0], color=style.RULE, lw=0.6, zorder=1)
    t = np.radians(theta_i)
    axis.quiver(-np.sin(t), 0, np.cos(t), np.sin(t), 0, -np.cos(t), color=style.INK, lw=1, arrow_length_ratio=0.08,
                zorder=3)  # fmt: skip
    axis.plot([0, np.sin(t)], [0, 0], [0, np.cos(t)], color=style.INK, lw=0.8, ls=style.DASHES[2], zorder=3)
    axis.set(xlim=(-0.8, 0.8), ylim=(-0.8, 0.8), zlim=(0, 1))
    axis.set_box_aspect((1.6, 1.6, 1.0), zoom=1.12)
    axis.view_init(elev=20, azim=-68)
    axis.set_axis_off()
