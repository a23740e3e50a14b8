"""The report's Figure 14: which (sigma, tau) show a mirror image from which angle on, with the user's surface on it."""

from pathlib import Path

import numpy as np
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from ...physics import emergence
from . import style

ANGLES = tuple(angle for angle, _ in emergence.TABLE_2)
SIGMAS = (0.05, 10.0)  # µm, the ordinate
SLOPES = ((0.01, 0.055), (0.03, 0.055), (0.1, 0.055), (0.3, 0.42))  # sigma/tau, and the sigma [µm] at which it is named
HALO = [withStroke(linewidth=2.2, foreground=style.PAPER)]


def figure14(result: dict, more: str = ""):
    """The contours at the document's wavelength and solid angle, Eq. 3 where it holds, lines of constant slope."""
    um, omega = result["wavelength_nm"] / 1000, result["solid_angle_sr"]
    scale = um / emergence.WAVELENGTH
    taus = np.array(emergence.tau_steps(um, 40))
    with style.look():
        fig = style.figure(134, 112)
        axes = fig.subplots()
        axes.set(xscale="log", yscale="log", xlim=(taus[0], taus[-1]), ylim=(SIGMAS[0] * scale, SIGMAS[1] * scale))
        axes.set(xlabel="horizontal roughness  τ  [µm]", ylabel="rms roughness  σ  [µm]")
        _region(axes, taus, scale)
        for angle, colour in zip(ANGLES, style.COLOURS, strict=False):
            _contour(
                axes, angle, colour, taus, um, omega, result["eq3"]["sigma_um"] is not None or omega == emergence.OMEGA
            )
        _asked(axes, result, taus, um, omega)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_locator(LogLocator(10, (1.0, 2.0, 5.0)))
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_formatter(NullFormatter())
        digits, exponent = f"{omega:.2e}".split("e")
        axes.set_title(
            f"where a mirror image emerges, λ = {result['wavelength_nm']:g} nm, Ω = {digits} × "
            f"10$^{{{int(exponent)}}}$ sr"
        )
        key = "solid: He-Torrance criterion    dotted: Eq. 3    dashed: constant σ/τ    grey: theory does not hold"
        style.origin(fig, f"{key}\n{more}" if more else key)
        _label_slopes(fig, axes, scale)
        return fig


def plot_contours(result: dict, path: Path, theme: str = style.LIGHT) -> None:
    """Write the figure into `path`, a .png, .svg or .pdf file."""
    style.save(figure14(result), path, theme)


def _region(axes, taus, scale):
    """Where the theory does not hold, and lines of constant sigma/tau."""
    ends = np.array([taus[0], taus[-1]])
    axes.fill_between(ends, ends, 1e3, color=style.RULE, alpha=0.55, lw=0, zorder=0)
    axes.text(0.9 * scale, 5 * scale, "σ/τ > 1", fontsize="medium", ha="center")
    for slope, _ in SLOPES:
        axes.plot(ends, slope * ends, color=style.INK, lw=0.6, dashes=(6, 3), alpha=0.55, zorder=1)


def _label_slopes(fig, axes, scale):
    """A label along each line of constant slope; the direction on the page is known only once the layout is."""
    style.freeze_layout(fig)
    (x0, y0), (x1, y1) = axes.transData.transform([(1, 1), (10, 10)])
    rotation = np.degrees(np.arctan2(y1 - y0, x1 - x0))
    look = {"fontsize": "small", "color": style.INK, "zorder": 2, "path_effects": HALO}
    place = {"rotation": rotation, "rotation_mode": "anchor", "ha": "left", "va": "bottom"}
    for slope, sigma in SLOPES:
        axes.text(sigma * scale / slope, sigma * scale, f" σ/τ = {slope:g}", **place, **look)


def _contour(axes, angle, colour, taus, um, omega, with_formula):
    sigma = np.array([emergence.sigmas_for_tau(angle, tau, um, omega)[0] for tau in taus.tolist()])
    axes.plot(taus, sigma, color=colour, lw=1.5, zorder=3)
    if with_formula:
        scale = um / emergence.WAVELENGTH
        formula = scale * emergence.eq3_constant(angle) / ((taus / scale) ** 0.7 + 6)
        axes.plot(taus, formula, color=colour, lw=1.3, ls=(0, (1, 1.4)), zorder=3)
    at = np.argmin(np.abs(taus - 1.12 * taus[0]))
    below = with_formula and formula[at] > sigma[at]  # on the side where Eq. 3 does not run through the label
    place = {"xytext": (0, -3 if below else 3), "textcoords": "offset points", "va": "top" if below else "bottom"}
    axes.annotate(f"{angle}°", (taus[at], sigma[at]), color=colour, weight="bold", zorder=5, path_effects=HALO, **place)


def _asked(axes, result, taus, um, omega):
    """The user's own contour, and the answers of both on it."""
    angle, point, eq3 = result["angle_deg"], result["criterion"], result["eq3"]
    if angle not in ANGLES and point["sigma_um"]:
        sigma = [emergence.sigmas_for_tau(angle, tau, um, omega)[0] for tau in taus.tolist()]
        axes.plot(taus, sigma, color=style.INK, lw=1.2, zorder=3)
    for part, marker, name in ((eq3, "o", "Eq. 3"), (point, "D", "criterion")):
        if part["sigma_um"]:
            face = style.INK if part is point else style.PAPER
            axes.plot(
                part["tau_um"],
                part["sigma_um"],
                marker,
                ms=6,
                mfc=face,
                mec=style.INK,
                ls="none",
                zorder=6,
                label=f"{angle:.3g}°, {name}: σ {part['sigma_um']:.3g}, τ {part['tau_um']:.3g} µm",
                clip_on=False,
            )
    axes.legend(loc="upper right", frameon=True, framealpha=0.9, edgecolor="none", facecolor=style.PAPER)
