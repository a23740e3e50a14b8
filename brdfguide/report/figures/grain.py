"""A grain as a figure: scans under turns of the sample, the peak over slopes with its ellipse, widths all around."""

from collections.abc import Sequence

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import MaxNLocator

from ...data.lobe_ellipse import STEEPEST_DEG, Ellipse, lobe_ellipse, looks_grained, widths_of_turns
from ...data.measurement import Measurement
from ...data.rotation import is_grained
from ...data.turning import turn_of_each
from ...fitting.reading import reading
from ...models.surface import Surface
from ...physics.aperture import Instrument
from ...physics.geometry import Geometry, rows
from ...records import dataclass
from . import style
from .lines import Line, grid_of, nominal_channel, without_zeros
from .lobes import plain_log

HEIGHT_MM = 74.0
HEAT = LinearSegmentedColormap.from_list("ln", ["#EAF1F7", "#9FC6E3", "#3D8BBF", "#0B4F86", "#08203A"])
BELOW = 4.0  # ln below the peak that is still told apart
WIDE = 2.6  # of the wider width, how far the picture of slopes reaches
MOST_SCANS = 3
IN_PLANE_DEG = 1.0
USUAL_DEG = 30.0  # incidence that is drawn: steep enough to be scanned on both sides, not yet masked
ROOM = 0.4  # of the logarithmic range, left below the scans for their legend


@dataclass(frozen=True)
class DrawnGrain:
    """What is drawn of the grain of a measurement."""

    measurement: Measurement
    channel: int
    ellipse: Ellipse
    theta_i: float  # [deg] the incidence that is drawn


def grain_of(measurement: Measurement) -> DrawnGrain | None:
    """None where the data show none: neither a turned sample whose lobe is no circle, nor a lobe that is seen to be
    longer one way."""
    ellipse = lobe_ellipse(measurement)
    turned = turn_of_each(measurement.geom) is not None
    if ellipse is None or not (is_grained(ellipse) if turned else looks_grained(measurement)):
        return None
    channel = nominal_channel(measurement)
    usable = measurement.usable[:, channel]
    groups = {theta: rows_ for theta, rows_ in measurement.theta_i_groups.items() if theta <= STEEPEST_DEG}
    most = max(np.count_nonzero(usable[each]) for each in groups.values())
    full = [theta for theta, each in groups.items() if np.count_nonzero(usable[each]) >= 0.7 * most]
    return DrawnGrain(measurement, channel, ellipse, min(full, key=lambda theta: abs(theta - USUAL_DEG)))


def draw_grain(fig, grain: DrawnGrain, lines: Sequence[Line] = ()) -> None:
    """Three panels into a figure or a part of one, with the first of the lines whose law has a grain, if any."""
    line = next((each for each in lines if grain_widths(each.surface) is not None), None)
    whole = fig.add_gridspec(1, 3, width_ratios=(1.15, 1, 1))
    _scans(fig.add_subplot(whole[0]), grain, line)
    _slopes(fig.add_subplot(whole[1]), grain, line)
    _widths(fig.add_subplot(whole[2], projection="polar"), grain, line)


def plot_grain(grain: DrawnGrain, lines: Sequence[Line] = ()):
    """The same as a figure."""
    with style.look():
        fig = style.figure(180, HEIGHT_MM)
        draw_grain(fig, grain, lines)
        return fig


def grain_widths(surface: Surface) -> tuple[float, float, float] | None:
    """Widths of facets along `axis` and across it, and the axis [rad], of the first of its terms with a grain."""
    for term in surface.model.terms:
        law, values = term.model.grain, surface.channel(0).values_of(term)
        if law is not None and "axis" in values:
            first, second = (float(np.ravel(values[name])[0]) for name in (law.first, law.second))
            along, across = law.widths(first, second)
            return float(along), float(across), float(np.ravel(values["axis"])[0])
    return None


def _scans(axes, grain: DrawnGrain, line: Line | None) -> None:
    """Values near the plane of incidence under up to three turns: along the axis, between, across it."""
    geom, channel = grain.measurement.geom, grain.channel
    usable = grain.measurement.usable[:, channel]
    near = usable & (geom.off_plane_deg[:, 0] <= IN_PLANE_DEG) & (abs(geom.theta_i_deg[:, 0] - grain.theta_i) < 0.5)
    azimuth = np.remainder(np.round(geom.phi_i_deg[:, 0], 1), 180.0)
    known = np.unique(azimuth[near])
    axis = np.degrees(grain.ellipse.axis)
    few = len(known) <= MOST_SCANS
    picked = known if few else sorted({_nearest(known, axis + step) for step in (0.0, 45.0, 90.0)})
    for number, turn in enumerate(picked):
        here = np.flatnonzero(near & (azimuth == turn))
        here = here[np.argsort(geom.signed_theta_r_deg[here, 0])]
        theta_r, colour = geom.signed_theta_r_deg[here, 0], style.COLOURS[number]
        from_axis = abs((turn - axis + 90.0) % 180.0 - 90.0)
        axes.plot(
            theta_r,
            grain.measurement.brdf[here, channel],
            style.MARKERS[number % len(style.MARKERS)],
            ms=3.0,
            mew=0,
            color=colour,
            alpha=0.9 if line is None else 0.65,
            label=f"{turn:g}°: {from_axis:.0f}° off the axis",
        )
        if line is not None:
            grid = grid_of(grain.theta_i, theta_r.min(), theta_r.max())
            side = np.where(grid < 0, 0.0, 180.0)
            seen = rows(Geometry.from_degrees(grain.theta_i, turn, np.abs(grid), turn + side, geom.wavelength))
            value = reading(line.surface, Instrument(seen, grain.measurement.solid_angle))
            value = np.broadcast_to(value, (len(grid), len(grain.measurement.channels)))[:, channel]
            axes.plot(grid, without_zeros(value), "-", color=colour, lw=1.1)
    axes.set_yscale("log")
    axes.set_xlabel("reflection angle θr [°]")
    axes.set_ylabel("BRDF [1/sr]")
    if len(picked):
        low, high = axes.get_ylim()
        axes.set_ylim(low * (low / high) ** ROOM, high)
        plain_log(axes.yaxis)
        axes.legend(title="light at azimuth", title_fontsize=6.5, fontsize=6.5, loc="lower left", handletextpad=0.2)
    axes.set_title(f"turned, θi {grain.theta_i:g}°" + ("" if line is None else "; lines: model"))


def _nearest(known, wanted: float) -> float:
    """Of azimuths within half a turn."""
    return float(known[np.argmin(np.abs((known - wanted + 90.0) % 180.0 - 90.0))])


def _slopes(axes, grain: DrawnGrain, line: Line | None) -> None:
    """ln of the values over facet slopes, both ends of a facet alike, with the ellipses."""
    geom = grain.measurement.geom
    here = np.flatnonzero(
        grain.measurement.usable[:, grain.channel] & (abs(geom.theta_i_deg[:, 0] - grain.theta_i) < 0.5)
    )
    x, y = (each[here, 0] / geom.v_z[here, 0] for each in geom.v_xy)
    ln = np.log(grain.measurement.brdf[here, grain.channel] * geom.cos_cos[here, 0]) - 2 * geom.ln_sec2_h[here, 0]
    reach = WIDE * grain.ellipse.alpha_x
    inside = np.hypot(x, y) <= 1.42 * reach
    x, y, below = x[inside], y[inside], np.maximum(ln[inside] - ln.max(), -BELOW)
    x, y, below = np.append(x, -x), np.append(y, -y), np.tile(below, 2)
    order = np.argsort(below, kind="stable")
    x, y, below = x[order], y[order], below[order]
    size = np.clip(3000 / len(x), 3, 26)
    drawn = axes.scatter(x, y, c=below, s=size, cmap=HEAT, vmin=-BELOW, vmax=0, linewidths=0, rasterized=True)
    bar = axes.figure.colorbar(drawn, ax=axes, shrink=0.82, pad=0.02, aspect=22)
    bar.set_label("ln below the peak", fontsize=7)
    bar.ax.tick_params(labelsize=6.5, which="both", direction="out", left=False)
    found = grain.ellipse
    _draw_ellipse(axes, found.alpha_x, found.alpha_y, found.axis, color=style.INK, lw=1.2, ls="--", label="data")
    own = None if line is None else grain_widths(line.surface)
    if line is not None and own is not None:
        _draw_ellipse(axes, *own, color=style.COLOURS[1], lw=1.5, label=line.name)
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xlabel="slope along azimuth 0")
    axes.set_ylabel("slope along azimuth 90")
    axes.legend(fontsize=6.5, loc="upper right", handlelength=1.8, borderaxespad=0.3)
    axes.set_title(f"facets, θi {grain.theta_i:g}°")


def _draw_ellipse(axes, wide, narrow, axis, **look) -> None:
    turn = np.linspace(0, 2 * np.pi, 181)
    along, across = wide * np.cos(turn), narrow * np.sin(turn)
    x, y = along * np.cos(axis) - across * np.sin(axis), along * np.sin(axis) + across * np.cos(axis)
    axes.plot(x, y, **look)


def _widths(axes, grain: DrawnGrain, line: Line | None) -> None:
    """Effective width against the azimuth of the plane of incidence, of each turn by itself and of the ellipses."""
    around = np.linspace(0, 2 * np.pi, 361)
    found = grain.ellipse
    shape = effective_width(found.alpha_x, found.alpha_y, found.axis, around)
    axes.plot(around, shape, color=style.INK, lw=1.2, ls="--")
    own = None if line is None else grain_widths(line.surface)
    if own is not None:
        axes.plot(around, effective_width(*own, around), color=style.COLOURS[1], lw=1.5)
    measured = widths_of_turns(grain.measurement)
    if measured:
        azimuth, width = np.array(list(measured.items())).T
        axes.plot(np.append(azimuth, azimuth + np.pi), np.tile(width, 2), "o", ms=3.6, mew=0, color=style.COLOURS[0])
    axes.plot([found.axis, found.axis + np.pi], [1.08 * shape.max()] * 2, ls=(0, (1, 2)), lw=0.9, color=style.INK)
    axes.set_ylim(0, 1.12 * max([shape.max(), *measured.values()]))
    axes.set_xticks(np.radians(np.arange(0, 360, 45)))
    axes.tick_params(pad=-1, labelsize=6.5)
    axes.set_rlabel_position(float(np.degrees(found.axis) + 67.5))
    axes.yaxis.set_major_locator(MaxNLocator(3, prune="lower"))
    axes.grid(color=style.RULE, linewidth=0.5)
    axes.set_title(f"width; dotted: axis, {np.degrees(found.axis) % 180:.3g}°", loc="center", pad=8)


def effective_width(wide, narrow, axis, azimuth):
    """Width of a scan in the plane of an azimuth [rad], 1/√(cos²/wide² + sin²/narrow²)."""
    turn = azimuth - axis
    return 1 / np.sqrt((np.cos(turn) / wide) ** 2 + (np.sin(turn) / narrow) ** 2)
