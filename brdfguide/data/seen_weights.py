"""How much of a sphere each measured direction stands for, so that S (`physics.seen`) can be taken over a measurement.

    quadrature    a table over half and difference angles: sin θh √θh sin θd cos θd cos θi cos θr of its own cells
    ring          scans in the plane of incidence: each reading stands for the ring about the mirror direction that it
                  lies on, cos θi cos θr max(sin min(|r - i|, 90°), sin(step/4)) step, r positive on the mirror side
    neighbours    scattered directions: in the disc of direction cosines, which carries cos θr, the squared distance to
                  the 4th nearest of the same incidence, as a share of that incidence, times cos θi

Without them the many readings in a lobe would decide alone.
"""

import numpy as np

from ..formed import formed
from ..numerics import neighbours
from ..physics import seen
from ..records import dataclass
from . import subsample
from .measurement import Measurement, rows_of_each

NEAREST = 4  # neighbour whose distance says how much a scattered direction stands for
MOST = {"neighbours": 4_000, "quadrature": 5_000}  # directions; of more, so many stand for all: within 0.2 % (ours)
APART_DEG = 0.25  # between two incidences
HELD_DEG = 1.0  # how far one wanders that was held
LEAST_SCAN = 3  # readings; with fewer at most incidences, the light was moved and the detector held


@dataclass(frozen=True, eq=False)
class SeenWeights:
    """Weights of directions (samples,), 0 where a direction does not count, and which kind they are."""

    of_rows: np.ndarray
    kind: str  # quadrature, ring, neighbours


@formed
def seen_weights(measurement: Measurement) -> SeenWeights:
    """What the directions of a measurement stand for, by what they are; a direction without any value counts 0."""
    kept = np.flatnonzero(seen.counts(measurement.geom.directions)[:, 0] & np.isfinite(measurement.brdf).any(axis=1))
    of_rows = np.zeros(len(measurement.geom))
    kind = kind_of(measurement)
    if kind != "ring":
        kept = _some(measurement, kept, MOST[kind])
    if len(kept):
        of_rows[kept] = RULES[kind](measurement[kept])
    return SeenWeights(of_rows, kind)


def kind_of(measurement: Measurement) -> str:
    """quadrature, ring or neighbours."""
    if measurement.in_plane:
        return "ring"
    return "quadrature" if measurement.format == "MERL .binary" else "neighbours"


def _some(measurement: Measurement, kept: np.ndarray, most: int) -> np.ndarray:
    """Those of the rows that stand for all."""
    among = np.zeros(len(measurement.geom), bool)
    among[kept] = True
    return subsample.representative_rows(measurement, most, among=among)


def _cells(table: Measurement) -> np.ndarray:
    geom = table.geom
    theta_h, cos_d = np.arctan(np.sqrt(geom.tan2_h)), np.minimum(geom.cos_d, 1.0)
    weights = np.sin(theta_h) * np.sqrt(theta_h) * np.sqrt(1 - cos_d**2) * cos_d * geom.cos_i * geom.cos_r
    return weights[:, 0]


def _ring(scans: Measurement) -> np.ndarray:
    geom = scans.geom
    light, view = geom.theta_i_deg[:, 0], geom.signed_theta_r_deg[:, 0]
    (step, alike), off = steps(scans), np.abs(view - light)
    ring = np.maximum(np.sin(np.radians(np.minimum(off, 90.0))), np.sin(step / 4))
    return geom.cos_i[:, 0] * geom.cos_r[:, 0] * ring * step / alike


def steps(scans: Measurement) -> tuple[np.ndarray, np.ndarray]:
    """Distance [rad] between neighbouring readings of the same scan, and how many readings of one angle share it,
    (samples,) each."""
    geom = scans.geom
    light, view = geom.theta_i_deg[:, 0], geom.signed_theta_r_deg[:, 0]
    held, moved = held_angles(light), view
    if np.median(np.bincount(held)) < LEAST_SCAN and held_angles(view).max() < held.max():
        held, moved = held_angles(view), light
    step, alike = np.ones(len(light)), np.ones(len(light))
    for rows in rows_of_each(360 * held + np.round(np.remainder(geom.phi_i_deg[:, 0], 360.0)) % 360).values():
        angles, places, count = np.unique(moved[rows], return_inverse=True, return_counts=True)
        alike[rows] = count[places]
        if len(angles) > 1:
            step[rows] = np.radians(np.gradient(angles))[places]
    return step, alike


def held_angles(angles) -> np.ndarray:
    """Number of the held angle (samples,) that each belongs to: a quarter of a degree parts two of them; bands of a
    degree where none was held."""
    order = np.argsort(angles, kind="stable")
    ascending, number = angles[order], np.empty(len(angles), int)
    ends = np.flatnonzero(np.diff(ascending) > APART_DEG)
    wandered = ascending[np.r_[ends, -1]] - ascending[np.r_[0, ends + 1]]
    if wandered.max() > HELD_DEG:
        return np.unique(np.round(angles), return_inverse=True)[1]
    number[order] = np.searchsorted(ends, np.arange(len(order)))
    return number


def _neighbours(scattered: Measurement) -> np.ndarray:
    geom = scattered.geom
    phi = np.radians(geom.phi_deg[:, 0])
    x, y = geom.sin_r[:, 0] * np.cos(phi), geom.sin_r[:, 0] * np.sin(phi)
    incidence = held_angles(geom.theta_i_deg[:, 0])
    area = neighbours.squared_distance(x, y, incidence, NEAREST)
    total = np.bincount(incidence, area)[incidence]
    alone = np.bincount(incidence)[incidence]
    return geom.cos_i[:, 0] * np.where(total > 0, area / np.where(total > 0, total, 1.0), 1.0 / alone)


RULES = {"quadrature": _cells, "ring": _ring, "neighbours": _neighbours}
