"""RGL `.bsdf`, by wavelength: a table of any model for Mitsuba's spectral variants and pbrt's `measured` material.

Wavelengths are written as they are. One channel is written at both ends of the visible range, so that it is grey.
Red, green and blue stand at their nominal wavelengths, between which a reader interpolates: their hue is approximate.
"""

import numpy as np

from ..physics.geometry import Geometry
from . import _grained
from ._directions import judged_over
from ._shown import seen_of
from .exporter import ColouredSurface, Export, Exporter, Refused, Statement, comment_lines, status_of
from .tables.blurred import blurred
from .tables.tensor import best_table, packed
from .tables.turned_tensor import best_turned_table

VISIBLE_NM = np.array([360.0, 830.0])


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Bytes and their Statement."""
    original, (surface, lost) = surface, blurred(surface)
    geom, wanted, over = judged_over(surface, geom, spectral=True)
    nm = 1e3 * surface.wavelengths
    if len(set(nm.tolist())) < len(nm):
        raise Refused("rgl-spectral", f"channels {', '.join(surface.channels)} have no wavelengths of their own", "rgl")
    if surface.colour.named and len(nm) > 1:
        lost += (
            (
                f"{', '.join(surface.channels)} stand at {', '.join(f'{each:g}' for each in nm)} nm, so that hues "
                f"are approximate"
            ),
        )
    order = np.argsort(nm)
    turning = _grained.terms_that_turn(surface)
    made = best_turned_table(surface.spectral, geom, wanted) if turning else best_table(surface.spectral, geom, wanted)
    written, nm = made.of_channels(order), nm[order]
    if len(nm) == 1:
        written, nm = made.of_channels([0, 0]), VISIBLE_NM
    shape = {**made.size, "wavelengths": len(nm)}
    status = status_of(made.rms_ln, lost)

    def shown(geom: Geometry) -> np.ndarray:
        return made.read(geom) @ surface.colour.matrix.T

    statement = Statement(
        "rgl-spectral",
        status,
        made.rms_ln,
        int(np.isfinite(wanted).any(axis=1).sum()),
        over,
        shape,
        lost,
        (made.note,),
        "wavelengths as they are",
        seen_of(original, shown),
        shown,
    )
    return Export(packed(written.fields("\n".join(comment_lines(surface, statement)), "spectra", nm)), statement)


EXPORTER = Exporter(
    __name__,
    ".bsdf",
    "RGL tensor by wavelength: any model in pbrt's and spectral Mitsuba's measured",
    export,
    grained=True,
)
