"""RGL `.bsdf`, by wavelength: a table of any model for Mitsuba's spectral variants and pbrt's `measured` material.

Wavelengths are written as they are. One channel is written at both ends of the visible range, so that it is grey.
Red, green and blue stand at their nominal wavelengths, between which a reader interpolates: their hue is approximate.
"""

import numpy as np

from ..geometry import Geometry
from ._base import EXACT, Export, Exporter, Refused, Statement, Surface, header
from ._blurred import blurred
from ._directions import chosen
from ._tensor import best_table, fields, packed

VISIBLE_NM = np.array([360.0, 830.0])


def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Bytes and their Statement."""
    surface, lost = blurred(surface)
    geom, wanted, over = chosen(surface, geom, spectral=True)
    nm = 1e3 * np.broadcast_to(np.asarray(surface.wavelength, float), (len(surface.channels),))
    if len(set(nm.tolist())) < len(nm):
        raise Refused("rgl-spectral", f"channels {', '.join(surface.channels)} have no wavelengths of their own", "rgl")
    if surface.colour.named and len(nm) > 1:
        lost += (f"{', '.join(surface.channels)} stand at {', '.join(f'{each:g}' for each in nm)} nm, so that hues are approximate",)
    order = np.argsort(nm)
    made = best_table(surface.spectral, geom, wanted)
    spectra, nm = made.spectra[:, order], nm[order]
    if len(nm) == 1:
        spectra, nm = np.repeat(spectra, 2, axis=1), VISIBLE_NM
    shape = {"theta_i": len(made.grid.theta_i), "half_vectors": made.grid.size**2, "wavelengths": len(nm)}
    status = "lossy" if lost else "exact" if made.rms_ln <= EXACT else "refit"
    statement = Statement("rgl-spectral", status, made.rms_ln, int(np.isfinite(wanted).any(axis=1).sum()), over, shape, lost, (made.note,), "wavelengths as they are")
    return Export(packed(fields(made.grid, spectra, "\n".join(header(surface, statement)), "spectra", nm)), statement)


EXPORTER = Exporter(__name__, ".bsdf", "RGL tensor by wavelength: any model in pbrt's and spectral Mitsuba's measured", export)
