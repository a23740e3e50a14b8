"""MERL `.binary`: any model as the table that most research code reads, over half and difference angles.

90 x 90 x 180 cells in three colours, each with the model's value at its centre; the index of theta_h grows as its
square root. Readers take the nearest cell, so a value is off by what the model changes within half a cell, which is
what the residual shows. The layout assumes reciprocity: a law without it is averaged over the exchange of light and
view. An ideal mirror has no place in a table and is blurred; the format has none for a comment.

Source: Matusik, Pfister, Brand and McMillan 2003, "A data-driven reflectance model".
"""

import numpy as np

from ..data.formats import merl as container
from ..physics.geometry import Geometry
from ._directions import judged_over, off_peak, rms_ln
from ._shown import seen_of
from .exporter import ColouredSurface, Export, Exporter, Statement, status_of
from .tables.blurred import blurred


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Bytes and their Statement."""
    original, (surface, lost) = surface, blurred(surface)
    one_way = any("reciprocity" in term.model.breaks for term in surface.model.terms)
    lost += ("light and view, which this law does not exchange freely, are averaged",) if one_way else ()
    table = container.table(_of(surface, one_way))
    geom, wanted, over = judged_over(surface, geom)
    held = table[container.cell_of(geom, container.PHI_D)]
    empty = np.isnan(held).any(axis=1)
    wanted = np.where(empty[:, None], np.nan, wanted)
    rms = rms_ln(np.maximum(held, 1e-300), wanted)
    status = status_of(rms, lost)
    judged, truth, where = off_peak(surface.rgb)
    off = np.abs(table[container.cell_of(judged, container.PHI_D)] / truth - 1)
    usual, most = (100 * np.nanquantile(off, (0.95, 1.0))) if np.isfinite(off).any() else (0.0, 0.0)
    close = f"within {usual:.1f} % of the model in 95 of 100 directions and {most:.1f} % in all, {where}"
    notes = [f"a table, read at the nearest cell: {close}", "the format has no place for a comment"]
    if empty.any():
        notes.append(
            f"{empty.sum()} directions lie in cells whose centre is below the horizon: the table is black there"
        )
    cells = {"theta_h": container.THETA_H, "theta_d": container.THETA_D, "phi_d": container.PHI_D}
    counted = int(np.isfinite(wanted).any(axis=1).sum())
    how = surface.colour.how

    def shown(geom: Geometry) -> np.ndarray:
        return table[container.cell_of(geom, container.PHI_D)]

    look = seen_of(original, shown)
    statement = Statement("merl", status, rms, counted, over, cells, lost, tuple(notes), how, look, shown)
    return Export(container.packed(table), statement)


def _of(surface: ColouredSurface, one_way: bool):
    """The surface as a function of directions, light and view exchanged in half of its value where it is `one_way`; 0
    where a colour lies outside the gamut."""

    def brdf(geom: Geometry) -> np.ndarray:
        value = surface.rgb(geom)
        return np.maximum(0.5 * (value + surface.rgb(geom.swapped())) if one_way else value, 0.0)

    return brdf


EXPORTER = Exporter(__name__, ".binary", "MERL table of any model", export, named=False)
