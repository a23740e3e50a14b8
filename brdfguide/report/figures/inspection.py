"""The picture of an inspection: where was measured, what, whether it is reciprocal, how much light comes back."""

import numpy as np
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.ticker import FixedLocator, LogLocator, NullFormatter

from ... import printable
from ...data.measurement import Measurement
from ...data.turning import turn_of_each
from . import style
from .grain import HEIGHT_MM, draw_grain, grain_of
from .panels import panels

RAMP = LinearSegmentedColormap.from_list("incidence", ["#56B4E9", "#0072B2", "#5B3A8C", "#CC5500", "#E69F00"])
SHADE = LinearSegmentedColormap.from_list("plane", ["#CFE3F2", "#0072B2"])
LOST = "#C1272D"
MOST_DOTS = 6000
MOST_SCANS = 6
FEW = 40  # incidences: with more the data are no scans


def plot_survey(measurement: Measurement, spiky, pairs, level, path, title: str, theme: str = style.LIGHT) -> None:
    """Five panels into `path`, and three of a grain where the data have one.

    `pairs` as from `reciprocity.exchanged_pairs`, `level` as from `reflectance.measured_reflectance`; either may be
    None.
    """
    with style.look():
        grain = grain_of(measurement)
        whole = style.figure(180, 132 if grain is None else 132 + HEIGHT_MM)
        fig = whole
        if grain is not None:
            fig, under = whole.subfigures(2, 1, squeeze=False, height_ratios=(132.0, HEIGHT_MM))[:, 0]
            draw_grain(under, grain)
        grid = fig.add_gridspec(2, 3, height_ratios=(1, 1.08))

        def norm(theta_i):
            return RAMP(np.clip(np.asarray(theta_i, float) / 90.0, 0, 1))

        _dome(fig.add_subplot(grid[0, 0], projection="polar"), measurement)
        _chart(fig.add_subplot(grid[0, 1]), measurement)
        _energy(fig.add_subplot(grid[0, 2]), level, norm)
        _plane(fig.add_subplot(grid[1, :2]), measurement, spiky, norm)
        _exchange(fig.add_subplot(grid[1, 2]), pairs)
        style.origin(whole, title)
        style.save(whole, path, theme)


def _dome(axes, measurement: Measurement) -> None:
    """Detector directions of all incidences seen from above, the mirror side up; red rings where no value is usable."""
    geom = measurement.geom
    rows = _thinned(len(geom), MOST_DOTS)
    theta_r, phi = geom.theta_r_deg[rows, 0], np.radians(geom.phi_deg[rows, 0])
    axes.set_theta_zero_location("S")
    axes.set_theta_direction(-1)
    missing = ~np.any(measurement.usable[rows], axis=1)
    axes.scatter(
        phi[~missing], theta_r[~missing], color=style.COLOURS[0], s=np.clip(6000 / len(rows), 0.6, 7), linewidths=0
    )
    axes.scatter(phi[missing], theta_r[missing], s=7, facecolors="none", edgecolors=LOST, linewidths=0.5)
    axes.set_ylim(0, 90)
    axes.yaxis.set_major_locator(FixedLocator([30, 60, 90]))
    axes.set_yticklabels([])
    axes.set_xticks(np.radians([0, 90, 180, 270]), ["source side", "90°", "mirror side", "270°"])
    axes.tick_params(pad=-2)
    for label, side in zip(axes.get_xticklabels()[1::2], ("right", "left"), strict=True):
        label.set_horizontalalignment(side)
    axes.grid(color=style.RULE, linewidth=0.5)
    axes.set_title("a  detector, rings every 30°")


def _chart(axes, measurement: Measurement) -> None:
    """Incidence against signed reflection angle; pale where the detector was out of the plane of incidence."""
    geom = measurement.geom
    rows = _thinned(len(geom), MOST_DOTS)
    rows = rows[np.argsort(-geom.off_plane_deg[rows, 0], kind="stable")]
    missing = ~np.any(measurement.usable[rows], axis=1)
    signed, theta_i = geom.signed_theta_r_deg[rows, 0], geom.theta_i_deg[rows, 0]
    shade = SHADE(1 - geom.off_plane_deg[rows, 0] / 90.0)
    axes.plot([0, 90], [0, 90], color=style.INK, lw=0.7)
    axes.plot([0, -90], [0, 90], color=style.INK, lw=0.7, ls=style.DASHES[1])
    size = np.clip(6000 / len(rows), 0.8, 9)
    axes.scatter(signed[~missing], theta_i[~missing], c=shade[~missing], s=size, linewidths=0, zorder=2)
    axes.scatter(signed[missing], theta_i[missing], s=7, facecolors="none", edgecolors=LOST, linewidths=0.5, zorder=3)
    for x, side, name in ((60, "right", "mirror"), (-60, "left", "source")):
        axes.text(
            x,
            87,
            name,
            fontsize=6.5,
            ha=side,
            va="top",
            bbox={"facecolor": "white", "alpha": 0.85, "linewidth": 0, "pad": 0.8},
            zorder=4,
        )
    axes.set(xlim=(-92, 92), ylim=(0, 90), xlabel="reflection θr [°]", ylabel="incidence θi [°]")
    axes.set_xticks(range(-90, 91, 45))
    axes.set_yticks(range(0, 91, 30))
    axes.set_title("b  coverage")


def _plane(axes, measurement: Measurement, spiky, norm) -> None:
    """The values nearest to the plane of incidence against signed theta_r, brightest channel."""
    turns = turn_of_each(measurement.geom)
    of_one = turns is not None and measurement.in_plane
    if of_one:  # scans of several turns are no one curve
        picked = turns == turns[np.argmin(np.remainder(measurement.geom.phi_i_deg[:, 0], 180.0))]
        measurement, spiky = measurement[picked], spiky[picked]
    geom, usable = measurement.geom, measurement.usable
    channel = int(np.argmax(np.sum(np.where(usable, measurement.brdf, 0.0), axis=0)))
    signed, value = geom.signed_theta_r_deg[:, 0], measurement.brdf[:, channel]
    for width in (0.5, 3.0, 8.0, 16.0, 90.0):
        near = (geom.off_plane_deg[:, 0] <= width) & usable[:, channel]
        if np.count_nonzero(near) >= 30 or width == 90.0:
            break
    few = len(measurement.theta_i_groups) < FEW
    sliced = () if few else panels(measurement, channel).shown
    for each in sliced:  # a table holds no scans
        axes.plot(each.theta_r, each.value, "-", lw=1.4, color=norm(each.theta_i), label=f"{each.theta_i:g}°")
        axes.axvline(each.theta_i, ymax=0.03, color=norm(each.theta_i), lw=1.4)
    theta_i = geom.theta_i_deg[:, 0]
    held = np.round(theta_i) if few else np.round(theta_i / 5) * 5
    angles = [angle for angle in np.unique(held[near]) if np.count_nonzero(near & (held == angle)) >= 4]
    for angle in () if sliced else np.array(angles)[_thinned(len(angles), MOST_SCANS)]:
        rows = np.flatnonzero(near & (held == angle))
        rows = rows[np.argsort(signed[rows])]
        rows = rows[_thinned(len(rows), 400)]
        colour = norm(angle)
        if few:
            axes.plot(signed[rows], value[rows], "-", lw=0.6, color=colour, alpha=0.5)
        axes.plot(signed[rows], value[rows], "o", ms=2.0, mew=0, color=colour, label=f"{angle:g}°")
        axes.axvline(angle, ymax=0.03, color=colour, lw=1.4)
        marked = rows[spiky[rows]]
        axes.plot(signed[marked], value[marked], "o", ms=6, mfc="none", mec=LOST, mew=0.8)
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(numticks=8))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_xlim(-92, 92)
    axes.set_xticks(range(-90, 91, 30))
    axes.set_xlabel("reflection angle θr (mirror side positive) [°]")
    axes.set_ylabel(
        f"BRDF {printable.label(measurement.channels[channel], 30)} [1/sr]"
        if len(measurement.channels) > 1
        else "BRDF [1/sr]"
    )
    if axes.get_legend_handles_labels()[1]:
        pad = {"handletextpad": 0.7 if sliced else 0.2, "handlelength": 1.6, "borderaxespad": 0.4}
        axes.legend(title="θi", title_fontsize=7, fontsize=6.5, labelspacing=0.25, **pad)
    else:
        said = "no scan of four values or more" if usable.any() else "no positive value"
        axes.text(0.5, 0.5, said, transform=axes.transAxes, ha="center", fontsize=7.5)
        axes.set_yticks([])
        axes.set_yticks([], minor=True)
    where = "in the plane of incidence" if width < 1 else f"within {width:g}° of the plane"
    if width >= 90:
        where = "all directions"
    if sliced:
        where = "interpolated into the plane of incidence"
    if of_one:
        where += f", light at azimuth {np.median(np.remainder(geom.phi_i_deg, 180.0)):g}°"
    axes.set_title(f"d  {where}" + (", spikes ringed" if np.any(spiky) else ""))


def _exchange(axes, pairs) -> None:
    """ln of value over exchanged value against ln of the cosines: level for a BRDF, diagonal for BRDF times cosine."""
    axes.axhline(0, color=style.COLOURS[2], lw=1.2, label="BRDF")
    axes.set_title("e  reciprocity")
    axes.set_xlabel("ln (cos θr / cos θi)")
    axes.set_ylabel("ln (value / exchanged value)")
    if pairs is None:
        axes.text(0.5, 0.6, "no exchanged pairs\nwere measured", transform=axes.transAxes, ha="center", fontsize=7.5)
        axes.set(xlim=(-1, 1), ylim=(-1, 1), xticks=[], yticks=[])
        return
    ln_cosine_ratio, ratio = pairs
    widest = max(0.3, float(np.abs(ln_cosine_ratio).max()) * 1.05)
    line = np.array([-widest, widest])
    axes.plot(line, line, ls=style.DASHES[1], color=style.COLOURS[1], lw=1.2, label="BRDF × cos θr")
    axes.plot(ln_cosine_ratio, ratio, "o", ms=1.8, mew=0, color=style.COLOURS[0], alpha=0.45)
    axes.set(
        xlim=(-widest, widest), ylim=np.array([-1, 1]) * max(widest, float(np.percentile(np.abs(ratio), 98)) * 1.1)
    )
    axes.legend(loc="upper left", fontsize=6.5, borderaxespad=0.4)


def _energy(axes, level, norm) -> None:
    """Hemispherical reflectance against incidence, with the most that a BRDF may return."""
    axes.axhline(1.0, color=style.COLOURS[1], lw=1.0, ls=style.DASHES[1])
    axes.text(2, 0.985, "all light", fontsize=6.5, color=style.COLOURS[1], va="top")
    axes.set(xlim=(0, 90), xlabel="incidence θi [°]", ylabel="hemispherical reflectance")
    axes.set_xticks(range(0, 91, 30))
    axes.set_title("c  light returned")
    if level is None:
        axes.text(0.5, 0.5, "the coverage does not tell", transform=axes.transAxes, ha="center", fontsize=7.5)
        axes.set_ylim(0, 1.2)
        return
    theta_i, values = np.array(level.theta_i_deg), np.array(level.values)
    axes.plot(theta_i, values, "-", lw=0.8, color=style.RULE)
    axes.scatter(theta_i, values, c=norm(theta_i), s=22, zorder=3, linewidths=0)
    if level.how == "plane":
        axes.errorbar(
            theta_i,
            values,
            yerr=0.06 * max(1.0, values.max()),
            lolims=True,
            fmt="none",
            ecolor=style.INK,
            elinewidth=0.6,
            capsize=1.8,
        )
    axes.set_ylim(0, 1.2 * max(1.0, float(values.max())))
    axes.text(
        0.97,
        0.955,
        f"θr up to {level.to_deg:.0f}°" + (", lower bounds" if level.how == "plane" else ""),
        transform=axes.transAxes,
        ha="right",
        va="top",
        fontsize=6.5,
    )


def _thinned(size: int, most: int) -> np.ndarray:
    """At most `most` places out of `size`, evenly spread, first and last among them."""
    return np.arange(size) if size <= most else np.unique(np.linspace(0, size - 1, most).round().astype(int))
