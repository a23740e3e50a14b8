"""Scatter against |β - β0|, both logarithmic: the axes that stray-light people read."""

import numpy as np

from . import style

OF_SPECTRA = ("abc", "psd")  # which hold the cosines that the theory has
GRAZING_DEG = 60.0  # beyond it a law without cosines, and a scan that it fits, rise in Rayleigh and Rice's spectrum
BEYOND = f"hollow: θr beyond {GRAZING_DEG:g}°, where what lacks the theory's cosines rises in its spectrum"


def plot_scatter(document: dict, path, theme: str = style.LIGHT) -> None:
    """Draw the curve of a scatter document, with its spectrum below, into `path`."""
    with style.look():
        style.save(scatter_figure(document), path, theme)


def scatter_figure(document: dict):
    """Values and their spectrum, one below the other; hollow what is near grazing. Call inside `style.look()`."""
    curve = {name: np.array(values, float) for name, values in document["curve"].items()}
    grazing = np.abs(curve["theta_r_deg"]) > GRAZING_DEG
    fig = style.figure(120, 150)
    style.title(fig, _title(document))
    above, below = fig.subplots(2, 1)
    _points(above, curve["beta"], curve["brdf_per_sr"], grazing, style.INK)
    above.set_xlabel("|β - β0|")
    above.set_ylabel("BRDF [sr$^{-1}$]")
    _points(below, curve["frequency_per_um"], curve["psd_um4"], grazing, style.COLOURS[0])
    below.set_xlabel("spatial frequency [1/µm]")
    below.set_ylabel("spectrum of the surface [µm$^4$]")
    if grazing.any() and document["from"] not in OF_SPECTRA:
        style.origin(fig, BEYOND)
    return fig


def _points(axis, x, y, hollow, colour) -> None:
    axis.loglog(x[~hollow], y[~hollow], style.MARKERS[0], color=colour, ms=2.2, mew=0)
    axis.loglog(x[hollow], y[hollow], style.MARKERS[0], mfc="none", mec=colour, ms=2.4, mew=0.6)
    axis.grid(True)


def _title(document: dict) -> str:
    what = {"scan": "a scan", "psd": "a measured spectrum"}.get(document["from"], document["from"])
    return f"scatter of {what} at {document['wavelength_nm']:g} nm, light from {document['theta_i_deg']:g}°"
