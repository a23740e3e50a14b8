"""Whether light is sent back to where it came from: a lobe about the source, which no model of the guide has."""

from collections.abc import Iterator

import numpy as np

from ..records import dataclass
from . import conventions
from .measurement import Measurement, row_median
from .turning import turned_parts

STEEP_DEG = 12.0  # incidences nearer to the normal do not separate source and mirror direction


@dataclass(frozen=True)
class Retro:
    """Medians over the incidences under each turn: how far the lobe about the source stands above its surroundings, on
    the side of the mirror direction and on the other, and relative to the mirror side."""

    lobe: float
    over_mirror: float
    incidences: int


def lobe(measurement: Measurement) -> Retro | None:
    """Each turn of the sample by itself, lest a grain be taken for a lobe. None where nothing was measured within 6
    degrees of the source at incidences beyond 12 degrees."""
    lobes, over = [], []
    for part in turned_parts(measurement):
        for above, over_mirror in _by_incidence(part):
            lobes.append(above)
            over += [] if over_mirror is None else [over_mirror]
    if not lobes:
        return None
    return Retro(float(np.median(lobes)), float(np.median(over)) if over else np.inf, len(lobes))


def _by_incidence(measurement: Measurement) -> Iterator[tuple[float, float | None]]:
    """How far the lobe about the source stands above its surroundings, and relative to the mirror side if that was
    measured, at each incidence."""
    geom = measurement.geom
    level = row_median(np.where(measurement.usable, measurement.brdf, np.nan))
    source = conventions.retro_distance_deg(geom)[:, 0]
    mirror = np.degrees(2 * np.arcsin(np.minimum(0.5 * np.sqrt(geom.mirror_distance2[:, 0]), 1.0)))
    counted = measurement.has_value & ((mirror > np.minimum(geom.theta_i_deg[:, 0], 12.0)) | (mirror < source))
    at_source, about = counted & (source < 6.0), counted & (source > 10.0) & (source < 25.0) & (mirror > 12.0)
    before = counted & (mirror < source) & (source > 15.0)
    for angle, rows in measurement.incidences.items():
        near = rows[at_source[rows]]
        if angle < STEEP_DEG or not len(near):
            continue
        around, ahead = rows[about[rows]], rows[before[rows]]
        if not len(around):
            continue
        highest, nearer = level[near].max(), mirror[around] < 2 * angle
        sides = [side for side in (around[nearer], around[~nearer]) if len(side)]
        # beyond the source a lobe falls again; where nothing was measured there, all surfaces grow toward grazing
        seen = level if len(sides) > 1 else level * geom.cos_r[:, 0]
        above = seen[near].max() / max(np.median(seen[side]) for side in sides)
        yield above, highest / level[ahead].max() if len(ahead) else None
