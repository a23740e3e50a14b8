"""RGL `.bsdf`, in colour: a table of any model for Mitsuba's `measured` plugin in its RGB variants.

Mitsuba importance-samples it, so a He-Torrance surface renders like any other. An ideal mirror has no place in a
table and is blurred; a grain gives an axis of azimuths. Spectral variants and pbrt want the target rgl-spectral: one
file cannot serve both.
"""

import numpy as np

from ..physics.geometry import Geometry
from . import _grained
from ._directions import judged_over
from ._shown import seen_of
from .exporter import ColouredSurface, Export, Exporter, Statement, comment_lines, status_of
from .tables.blurred import blurred
from .tables.tensor import best_table, packed
from .tables.turned_tensor import best_turned_table


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Bytes and their Statement."""
    original, (surface, lost) = surface, blurred(surface)
    geom, wanted, over = judged_over(surface, geom)

    def brdf(directions: Geometry) -> np.ndarray:
        return np.maximum(surface.rgb(directions), 0.0)

    made = (
        best_turned_table(brdf, geom, wanted) if _grained.terms_that_turn(surface) else best_table(brdf, geom, wanted)
    )
    status = status_of(made.rms_ln, lost)
    shown = made.read
    statement = Statement(
        "rgl",
        status,
        made.rms_ln,
        int(np.isfinite(wanted).any(axis=1).sum()),
        over,
        made.size,
        lost,
        (made.note,),
        surface.colour.how,
        seen_of(original, shown),
        shown,
    )
    return Export(packed(made.fields("\n".join(comment_lines(surface, statement)), "rgb")), statement)


EXPORTER = Exporter(__name__, ".bsdf", "RGL tensor, RGB: any model in Mitsuba's measured plugin", export, grained=True)
