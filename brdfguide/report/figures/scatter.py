"""Scatter against |β - β0|, both logarithmic: the axes that stray-light people read."""

import numpy as np

from . import style


def plot_scatter(document: dict, path, theme: str = style.LIGHT) -> None:
    """Draw the curve of a scatter document, with its spectrum below, into `path`."""
    curve = document["curve"]
    beta, brdf = np.array(curve["beta"], float), np.array(curve["brdf_per_sr"], float)
    frequency, density = np.array(curve["frequency_per_um"], float), np.array(curve["psd_um4"], float)
    with style.look():
        fig = style.figure(120, 150)
        above, below = fig.subplots(2, 1)
        above.loglog(beta, brdf, style.MARKERS[0], color=style.INK, ms=2.2, mew=0)
        above.set_xlabel("|β - β0|")
        above.set_ylabel("BRDF [sr$^{-1}$]")
        above.grid(True)
        below.loglog(frequency, density, style.MARKERS[0], color=style.COLOURS[0], ms=2.2, mew=0)
        below.set_xlabel("spatial frequency [1/µm]")
        below.set_ylabel("spectrum of the surface [µm$^4$]")
        below.grid(True)
        style.origin(fig, f"from {document['from']}, {document['wavelength_nm']:g} nm, {document['theta_i_deg']:g}°")
        style.save(fig, path, theme)
