"""Whether values change as the sample is turned, from directions that differ in nothing else."""

import numpy as np

from ..formed import formed
from ..physics.geometry import Directions
from .measurement import Measurement

TILTED_DEG = 1.0  # at normal incidence the light has no azimuth
FEWEST = 10  # values that are repeated under other rotations
MOST_TURNS = 64  # azimuths of the light, beyond which the sample was not held


@formed
def turn_of_each(to: Directions) -> np.ndarray | None:
    """(samples,) the number of the azimuth that the light has in the sample's frame, to a degree, half a turn being
    none; None where it has one only, or so many that the sample was not held."""
    if not len(to) or np.all(to.phi_i_deg == to.phi_i_deg[0, 0]):
        return None
    known = turns_deg(to)
    if not 2 <= len(known) <= MOST_TURNS:
        return None
    return np.searchsorted(known, _azimuth_deg(to)).clip(max=len(known) - 1)


def turns_deg(to: Directions) -> np.ndarray:
    """The azimuths of the light by which turns are told, ascending, to a degree, from 0 to 179."""
    return np.unique(_azimuth_deg(to)[to.theta_i_deg[:, 0] > TILTED_DEG])


def _azimuth_deg(to: Directions) -> np.ndarray:
    return np.remainder(np.round(to.phi_i_deg[:, 0]), 180.0)


def turned_parts(measurement: Measurement) -> list[Measurement]:
    """The measurement under each turn of the sample by itself; the whole where it was not turned."""
    turns = turn_of_each(measurement.geom)
    if turns is None:
        return [measurement]
    return [measurement[turns == each] for each in np.unique(turns)]


@formed
def spread_over_turns(measurement: Measurement) -> float | None:
    """rms of ln (value / mean) over rotations of the sample; None for one rotation, and where too few repeat."""
    geom = measurement.geom
    if len(np.unique(np.round(geom.phi_i_deg[geom.theta_i_deg > TILTED_DEG], 0))) < 2:
        return None
    phi = np.abs(np.remainder(geom.phi_deg[:, 0] + 180.0, 360.0) - 180.0)
    keys = np.round(np.stack([geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0], phi], axis=1), 1)
    _, group = np.unique(keys, axis=0, return_inverse=True)
    usable = np.all(measurement.usable, axis=1)
    level = np.mean(np.log(np.where(measurement.usable, measurement.brdf, 1.0)), axis=1)
    return _spread_within(group.reshape(-1)[usable], level[usable])


def _spread_within(group, level) -> float | None:
    """rms departure from the mean of those that differ in rotation only; None where less than ten do."""
    if not len(group):
        return None
    counts = np.bincount(group)
    mean = np.bincount(group, level) / np.maximum(counts, 1)
    repeated = counts[group] > 1
    if np.count_nonzero(repeated) < FEWEST:
        return None
    freedom = np.count_nonzero(repeated) - np.count_nonzero(counts > 1)
    return float(np.sqrt(np.sum((level - mean[group])[repeated] ** 2) / freedom))
