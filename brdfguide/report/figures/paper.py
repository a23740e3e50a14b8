"""The guide's figures, drawn by this program: curves from its own laws, samples from the files it is given.

Only the text of the report is at hand: ranges and colours of its figures are ours. Every figure says where it comes
from.
"""

from dataclasses import replace
from math import pi, radians

import numpy as np

from ... import models
from ...data.measurement import Measurement
from ...fitting import fit
from ...fitting.reading import reading
from ...models.surface import Surface
from ...physics import fresnel as optics
from ...physics import substances
from ...physics.aperture import Instrument
from ...physics.geometry import in_plane, rows
from ..documents import emergence
from . import emergence as emergence_plot
from . import style
from .lines import Line
from .lobes import plot_lobes

OURS = "computed by brdfguide"
DIELECTRICS = ("water", "acrylic", "window glass", "diamond")
METALS = ("nickel", "chromium", "aluminium", "silver")  # Figure 1 shows four metals
# where a curve's name stands in Figure 1, in points above it
ABOVE_BELOW = {
    "silver": ("silver", 5),
    "aluminium": ("aluminium", -5),
    "chromium": ("chromium", 5),
    "nickel": ("nickel", -6),
    "diamond": ("diamond", 5),
    "window glass": ("window glass, acrylic, water", 6),
}
# figure -> (sample in examples/, the index that He-Torrance is given, half angle of the receiver [deg])
SAMPLES = {
    4: ("rough_aluminium.csv", (0.958, 6.69), 1.5),
    5: ("rough_plastic.csv", (1.5, 0.0), 1.5),
    7: ("white_paper.csv", (1.5, 0.0), 1.5),
    9: ("smooth_steel.csv", (2.87, 3.36), 0.4),
    11: ("metallic_paint.csv", (1.5, 0.0), 1.5),
}
TITLES = {
    1: "Fresnel reflectance of smooth metals and dielectrics",
    2: "Effective roughness",
    4: "Rough aluminium",
    5: "Rough plastic",
    7: "White paper",
    9: "Nearly smooth steel",
    11: "Metallic paint, mirror image of the coat excluded",
    13: "Reflectance at normal incidence",
    14: "Where the mirror image emerges",
}
FOUR = ("lambertian+phong", "lambertian+ward", "lambertian+lafortune", "lambertian+he-torrance")
PEAK_DEG = 3.0  # about the mirror direction, left out of the fit where a mirror peak is to be predicted


def plot_fresnel():
    """Figure 1: metals stay above one half, dielectrics below one fifth over most of the range."""
    theta = np.concatenate((np.linspace(0, 85, 171), np.linspace(85, 90, 51)[1:]))
    fig = style.figure(120, 88)
    axis = fig.subplots()
    known = {each.name: each for each in substances.SUBSTANCES}
    for place, name in enumerate(METALS + DIELECTRICS):
        each, metal = known[name], name in METALS
        curve = optics.fresnel(np.cos(np.radians(theta)), each.n[0], each.k[0])
        axis.plot(theta, curve, color=style.COLOURS[0 if metal else 1], ls=style.DASHES[place % 4])
        if name in ABOVE_BELOW:
            axis.annotate(
                ABOVE_BELOW[name][0],
                (2, curve[0]),
                (0, ABOVE_BELOW[name][1]),
                textcoords="offset points",
                fontsize=7,
                va="center",
                color=style.COLOURS[0 if metal else 1],
            )
    axis.set(
        xlim=(0, 90),
        ylim=(0, 1.03),
        xlabel="angle of incidence $\\theta_i$ [deg]",
        ylabel="Fresnel reflectance, unpolarised",
        xticks=range(0, 91, 15),
    )
    axis.text(45, 0.52, "metals", color=style.COLOURS[0], ha="center")
    axis.text(45, 0.27, "dielectrics", color=style.COLOURS[1], ha="center")
    style.origin(fig, f"after Figure 1 of the guide; {OURS} from the indices of its Table 1")
    return fig


def effective_roughness():
    """Figure 2: what sigma cos θ does to the roughness that light meets and to the mirror part (Eq. 1)."""
    theta = np.linspace(0, 90, 361)
    fig = style.figure(150, 74)
    left, right = fig.subplots(1, 2)
    left.plot(theta, np.cos(np.radians(theta)), color=style.COLOURS[0])
    left.set(ylim=(0, 1.03), ylabel="effective over true roughness, cos $\\theta_i$")
    for place, ratio in enumerate((0.02, 0.05, 0.1, 0.2, 0.5)):
        right.plot(
            theta,
            optics.davies(1.0, np.cos(np.radians(theta)), ratio, 1.0),
            color=style.COLOURS[place],
            ls=style.DASHES[place],
            label=f"{ratio:g}",
        )
    right.set(ylim=(0, 1.03), ylabel="share left to the mirror direction, $\\rho/F$")
    right.legend(title="$\\sigma/\\lambda$", loc="upper left", bbox_to_anchor=(1.0, 1.02), handlelength=3)
    for axis in (left, right):
        axis.set(xlim=(0, 90), xticks=range(0, 91, 15), xlabel="angle of incidence $\\theta_i$ [deg]")
    style.origin(fig, f"after Figure 2 of the guide; {OURS} from its Eq. 1")
    return fig


def four_models(measurement: Measurement, number: int, origin: str):
    """Figures 4, 5, 7, 11: a sample at three angles of incidence with the report's four models fitted to it.

    He-Torrance's mirror part counts as the receiver reads it; at the metal, where a peak is to be seen, nothing close
    to it is fitted. The paint's coat was left out of the data, so no mirror part counts; it gets a free scale, since
    its flakes reflect more than any dielectric.
    """
    _, (n, k), half = SAMPLES[number]
    theta_i, theta_r = measurement.geom.theta_i_deg[:, 0], measurement.geom.signed_theta_r_deg[:, 0]
    words = f"He-Torrance is given n = {n:g}" + (f" + {k:g}i" if k else "")
    if number == 11:
        measurement = replace(measurement, solid_angle=None)
        words += ", its scale is free; its mirror part is left out, as it is of the data"
    else:
        measurement = replace(measurement, solid_angle=measurement.solid_angle or pi * radians(half) ** 2)
        words += f" and reads its mirror part in a receiver of half angle {half:g}°"
    part = measurement
    if number == 4:
        part = measurement[~((theta_i > 70) & (np.abs(theta_r - theta_i) <= PEAK_DEG))]
        words += f"; within {PEAK_DEG:g}° of that peak nothing was fitted"
    lines = []
    for name in FOUR:
        model, he = models.get(name), "he-torrance" in name
        if he and number == 11:
            model = replace(model, free=("he-torrance.scale",))
        held = {"he-torrance.n": n, "he-torrance.k": k} if he else {}
        found = fit.fit(model, part, fit.FitOptions(fixed=held, weights="none"))
        lines.append(Line(name, found.surface, found.rms_ln, image=number != 11))
    return plot_lobes(lines, measurement, height_mm=116, note=f"{origin}\n{words}", title=TITLES[number])


def steel(measurement: Measurement, origin: str):
    """Figure 9: He-Torrance at the report's roughness, not fitted; data and model over their peak at the least."""
    _, (n, k), half = SAMPLES[9]
    omega = measurement.solid_angle or pi * radians(half) ** 2
    model = models.get("he-torrance")
    values = {
        "he-torrance.sigma": 0.08,
        "he-torrance.slope": 0.08 / 1.52,
        "he-torrance.n": n,
        "he-torrance.k": k,
    }
    um = float(np.ravel(measurement.geom.wavelength)[0])
    surface = Surface(model, values, wavelength=um)
    fig = style.figure(150, 100)
    axis = fig.subplots()
    scale = None
    for place, (theta, picked) in enumerate(measurement.theta_i_groups.items()):
        part = measurement[picked]
        grid = np.unique(np.concatenate((np.linspace(-85, 85, 341), theta + np.linspace(-2, 2, 161))))
        line = reading(surface, Instrument(rows(in_plane(theta, grid)), omega))[:, 0]
        if scale is None:
            scale = line.max(), np.nanmax(part.brdf[:, 0])
        axis.plot(
            part.geom.signed_theta_r_deg[:, 0],
            part.brdf[:, 0] / scale[1],
            "o",
            ms=1.6,
            mew=0,
            color=style.COLOURS[place % 8],
            alpha=0.7,
        )
        axis.plot(grid, line / scale[0], color=style.COLOURS[place % 8], lw=1, label=f"{theta:g}°")
    axis.set(
        yscale="log",
        xlim=(-85, 85),
        ylim=(1e-6, 30),
        xticks=range(-75, 76, 15),
        xlabel="reflection angle $\\theta_r$ [deg]",
        ylabel="BRDF over its peak at the least incidence",
    )
    axis.legend(title="$\\theta_i$", loc="upper left", ncols=1)
    given = "lines: He-Torrance at the report's σ = 0.08 µm and τ = 1.52 µm with the index of iron, not fitted"
    style.origin(fig, f"{origin}\n{given}, {um * 1e3:g} nm, receiver of half angle {half:g}°")
    return fig


def normal_reflectance():
    """Figure 13: even diamond lies far below the metals."""
    found = sorted((each for each in substances.SUBSTANCES if each.table1), key=lambda each: each.table1 or 0.0)
    values = [float(optics.f0(each.n[0], each.k[0])) for each in found]
    fig = style.figure(120, 84)
    axis = fig.subplots()
    places = range(len(found))
    axis.barh(places, values, height=0.62, color=[style.COLOURS[0 if each.kind == "metal" else 1] for each in found])
    for place, value in zip(places, values, strict=True):
        axis.text(value + 0.01, place, f"{value:.4f}", va="center", fontsize=7)
    axis.set_yticks(places, [each.name for each in found])
    axis.tick_params(axis="y", length=0)
    axis.set(xlim=(0, 1.12), xlabel="reflectance at normal incidence")
    axis.text(0.98, 1.2, "dielectrics", color=style.COLOURS[1], ha="right")
    axis.text(0.98, 2.2, "metals", color=style.COLOURS[0], ha="right")
    style.origin(fig, f"after Figure 13 of the guide; {OURS} from the indices of its Table 1")
    return fig


def _emergence(origin: str):
    """Figure 14, with the report's worked example where the criterion puts it: on the contour of 75 degrees."""

    more = f"{origin}; the point: the guide's worked example, which its text puts on the contour of 80°"
    return emergence_plot.figure14(emergence.document(angle=75.0, slope=0.1), more)


def plot_figure(number: int, measurement: Measurement | None = None, origin: str = ""):
    """One figure; those of samples need their measurement, and where it comes from."""
    origin = f"after Figure {number} of the guide; {origin or OURS}"
    with style.look():
        if number == 14:
            return _emergence(origin)
        if measurement is None:
            fig = {1: plot_fresnel, 2: effective_roughness, 13: normal_reflectance}[number]()
        elif number == 9:
            fig = steel(measurement, origin)
        else:
            return four_models(measurement, number, origin)
        style.title(fig, TITLES[number])
        return fig
