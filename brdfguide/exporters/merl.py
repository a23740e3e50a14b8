"""MERL `.binary`: any model as the table that most research code reads, over half and difference angles.

90 x 90 x 180 cells in three colours, each with the model's value at its centre; the index of theta_h grows as its
square root. Readers take the nearest cell, so a value is off by what the model changes within half a cell, which is
what the residual shows. The layout assumes reciprocity: a law without it is averaged over the exchange of light and
view. An ideal mirror has no place in a table and is blurred; the format has none for a comment.

Source: Matusik, Pfister, Brand and McMillan 2003, "A data-driven reflectance model".
"""

import struct
from math import pi

import numpy as np

from ..geometry import Geometry, rows
from ._base import EXACT, Export, Exporter, Statement, Surface
from ._blurred import blurred
from ._directions import chosen, off_peak, rms_ln

THETA_H, THETA_D, PHI_D = 90, 90, 180
SCALE = np.array([1.0, 1.15, 1.66]) / 1500
NOTHING = -1.0  # below the horizon


def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Bytes and their Statement."""
    surface, lost = blurred(surface)
    one_way = any("reciprocity" in term.model.breaks for term in surface.model.terms)
    lost += ("light and view, which this law does not exchange freely, are averaged",) if one_way else ()
    table = _table(surface, one_way)
    geom, wanted, over = chosen(surface, geom)
    rms = rms_ln(np.maximum(table[_cell(geom)], 1e-300), wanted)
    status = "lossy" if lost else "exact" if rms <= EXACT else "refit"
    judged, truth, where = off_peak(surface.rgb)
    off = np.abs(table[_cell(judged)] / truth - 1)
    usual, most = (100 * np.nanquantile(off, (0.95, 1.0))) if np.isfinite(off).any() else (0.0, 0.0)
    notes = (f"a table, read at the nearest cell: within {usual:.1f} % of the model in 95 of 100 directions and {most:.1f} % in all, {where}",
             "the format has no place for a comment")  # fmt: skip
    cells = {"theta_h": THETA_H, "theta_d": THETA_D, "phi_d": PHI_D}
    statement = Statement("merl", status, rms, int(np.isfinite(wanted).any(axis=1).sum()), over, cells, lost, notes, surface.colour.how)
    planes = np.where(np.isfinite(table), table / SCALE, NOTHING).T
    return Export(struct.pack("<3i", THETA_H, THETA_D, PHI_D) + np.ascontiguousarray(planes, "<f8").tobytes(), statement)


def _table(surface: Surface, one_way: bool) -> np.ndarray:
    """(cells, 3) [1/sr], NaN below the horizon."""
    table = np.full((THETA_H, THETA_D * PHI_D, 3), np.nan)
    theta_d = np.radians((np.arange(THETA_D) + 0.5) * 90 / THETA_D)[:, None]
    phi_d = np.radians((np.arange(PHI_D) + 0.5) * 180 / PHI_D)[None, :]
    difference = [np.sin(theta_d) * np.cos(phi_d), np.sin(theta_d) * np.sin(phi_d), np.cos(theta_d) * np.ones_like(phi_d)]
    x, y, z = (part.ravel() for part in difference)
    for place in range(THETA_H):
        half = np.radians((place + 0.5) ** 2 / THETA_H)
        sin_h, cos_h = np.sin(half), np.cos(half)
        i = np.stack((cos_h * x + sin_h * z, y, cos_h * z - sin_h * x), axis=-1)
        r = np.stack((sin_h * z - cos_h * x, -y, cos_h * z + sin_h * x), axis=-1)
        lit = (i[:, 2] > 0) & (r[:, 2] > 0)
        geom = rows(Geometry.from_vectors(i[lit], r[lit]))
        value = surface.rgb(geom)
        if one_way:
            value = 0.5 * (value + surface.rgb(geom.swapped()))
        table[place, lit] = np.maximum(value, 0.0)
    return table.reshape(-1, 3)


def _cell(geom: Geometry) -> np.ndarray:
    """The cell that a reader takes for each direction."""
    phi = np.radians(geom.phi_deg)[:, 0]
    sin_i, cos_i, sin_r, cos_r = (values[:, 0] for values in (geom.sin_i, geom.cos_i, geom.sin_r, geom.cos_r))
    hx, hy, hz = sin_i + sin_r * np.cos(phi), sin_r * np.sin(phi), cos_i + cos_r
    theta_h, phi_h = np.arctan2(np.hypot(hx, hy), hz), np.arctan2(hy, hx)
    # the light, turned until the half vector is the normal
    x, y = sin_i * np.cos(phi_h), -sin_i * np.sin(phi_h)
    dx, dz = np.cos(theta_h) * x - np.sin(theta_h) * cos_i, np.sin(theta_h) * x + np.cos(theta_h) * cos_i
    theta_d, phi_d = np.arctan2(np.hypot(dx, y), dz), np.arctan2(y, dx) % pi
    place_h = np.minimum(np.sqrt(np.degrees(theta_h) * THETA_H).astype(int), THETA_H - 1)
    place_d = np.minimum((np.degrees(theta_d) * THETA_D / 90).astype(int), THETA_D - 1)
    place_phi = np.minimum((phi_d * PHI_D / pi).astype(int), PHI_D - 1)
    return place_phi + PHI_D * (place_d + THETA_D * place_h)


EXPORTER = Exporter(__name__, ".binary", "MERL table of any model", export)
