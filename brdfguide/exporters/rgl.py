"""RGL `.bsdf`, in colour: a table of any model for Mitsuba's `measured` plugin in its RGB variants.

Mitsuba importance-samples it, so a He-Torrance surface renders like any other. An ideal mirror has no place in a
table and is blurred. Spectral variants and pbrt want the target rgl-spectral: one file cannot serve both.
"""

import numpy as np

from ..geometry import Geometry
from ._base import EXACT, Export, Exporter, Statement, Surface, header
from ._blurred import blurred
from ._directions import chosen
from ._tensor import best_table, fields, packed


def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Bytes and their Statement."""
    surface, lost = blurred(surface)
    geom, wanted, over = chosen(surface, geom)
    table, rms = best_table(lambda directions: np.maximum(surface.rgb(directions), 0.0), geom, wanted)
    shape = {"theta_i": len(table.theta_i), "half_vectors": table.spectra.shape[-1] ** 2}
    status = "lossy" if lost else "exact" if rms <= EXACT else "refit"
    notes = ("a table, interpolated by its reader between its nodes",)
    statement = Statement("rgl", status, rms, int(np.isfinite(wanted).any(axis=1).sum()), over, shape, lost, notes, surface.colour.how)
    return Export(packed(fields(table, "\n".join(header(surface, statement)), "rgb")), statement)


EXPORTER = Exporter(__name__, ".bsdf", "RGL tensor, RGB: any model in Mitsuba's measured plugin", export)
