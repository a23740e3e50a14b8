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
    made = best_table(lambda directions: np.maximum(surface.rgb(directions), 0.0), geom, wanted)
    shape = {"theta_i": len(made.grid.theta_i), "half_vectors": made.grid.size**2}
    status = "lossy" if lost else "exact" if made.rms_ln <= EXACT else "refit"
    statement = Statement("rgl", status, made.rms_ln, int(np.isfinite(wanted).any(axis=1).sum()), over, shape, lost, (made.note,), surface.colour.how)
    return Export(packed(fields(made.grid, made.spectra, "\n".join(header(surface, statement)), "rgb")), statement)


EXPORTER = Exporter(__name__, ".bsdf", "RGL tensor, RGB: any model in Mitsuba's measured plugin", export)
