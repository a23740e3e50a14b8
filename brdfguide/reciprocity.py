"""Whether values keep when light and detector change places, and which power of the cosines they carry if not.

A BRDF is reciprocal; values that were multiplied by cos theta_r change by (cos theta_r / cos theta_i)^p, p = 1.
"""

from dataclasses import dataclass

import numpy as np

from .measurement import Measurement

NEAR_DEG = 3.0  # how far apart a direction and the exchanged one may lie
LEVER = 0.15  # least |ln (cos theta_r / cos theta_i)| that says something about the power
MOST = 1200  # directions compared


@dataclass(frozen=True)
class Reciprocity:
    pairs: int
    power: float | None  # p; None where no pair has a lever
    power_stderr: float | None
    ratio: float  # median of max(a/b, b/a) as measured
    corrected_ratio: float  # the same after division by cos theta_r


def test(measurement: Measurement, seed: int = 0) -> Reciprocity | None:
    """Compares up to 1200 directions with their exchange; None where fewer than 12 pairs can be formed."""
    compared = pairs(measurement, seed)
    if compared is None:
        return None
    lever, ratio = compared
    power, stderr = _slope(lever, ratio)
    spread = lambda values: float(np.exp(np.median(np.abs(values))))  # noqa: E731
    return Reciprocity(len(ratio), power, stderr, spread(ratio), spread(ratio - lever))


def pairs(measurement: Measurement, seed: int = 0):
    """ln (cos theta_r / cos theta_i) and ln (value / exchanged value) of every pair; None for fewer than 12."""
    geom = measurement.geom
    rows = np.flatnonzero(np.any(measurement.usable, axis=1))
    if len(rows) < 12 or len(geom) > 200_000:
        return None
    here = rows if len(rows) <= MOST else np.sort(np.random.default_rng(seed).choice(rows, MOST, replace=False))
    there, apart = _nearest(_places(geom.swapped()[here]), _places(geom[rows]))
    there = rows[there]
    close = (apart < np.radians(NEAR_DEG)) & (there != here)
    if np.count_nonzero(close) < 12:
        return None
    here, there = here[close], there[close]
    both = measurement.usable[here] & measurement.usable[there]
    ratio = np.full(both.shape, np.nan)
    ratio[both] = np.log(measurement.brdf[here][both] / measurement.brdf[there][both])
    counted = np.any(both, axis=1)
    ratio = np.nanmedian(ratio[counted], axis=1) if ratio.shape[1] > 1 else ratio[counted][:, 0]
    lever = np.log(geom.cos_r[here, 0] / geom.cos_i[here, 0])[counted]
    steady = np.abs(ratio) < 3.0  # beyond, a peak was met by its flank
    ratio, lever = ratio[steady], lever[steady]
    return (lever, ratio) if len(ratio) >= 12 else None


def _slope(lever, ratio):
    """Weighted median of ratio/lever, and its standard error from the spread."""
    told = np.abs(lever) > LEVER
    if np.count_nonzero(told) < 8:
        return None, None
    slope, weight = ratio[told] / lever[told], np.abs(lever[told])
    order = np.argsort(slope)
    reach = np.cumsum(weight[order])
    middle = float(slope[order][np.searchsorted(reach, 0.5 * reach[-1])])
    deviation = np.abs(slope - middle)
    order = np.argsort(deviation)
    spread = deviation[order][np.searchsorted(np.cumsum(weight[order]), 0.5 * reach[-1])]
    return middle, float(1.86 * spread / np.sqrt(np.count_nonzero(told)))


def _places(geom) -> np.ndarray:
    """Five numbers for each pair of directions, with the light in one plane and the sides of that plane alike."""
    phi = np.radians(geom.phi_deg[:, 0])
    sin_i, sin_r = geom.sin_i[:, 0], geom.sin_r[:, 0]
    return np.stack([sin_i, geom.cos_i[:, 0], sin_r * np.cos(phi), sin_r * np.abs(np.sin(phi)), geom.cos_r[:, 0]], axis=1)


def _nearest(points, among):
    """Index of the nearest of `among` for each of `points`, and the distance; in blocks, so that memory stays small."""
    index = np.empty(len(points), int)
    # single precision finds the place, to some 0.02 degrees; the distance is then formed exactly
    rough, square = among.astype(np.float32), np.sum(among**2, axis=1, dtype=np.float32)
    for start in range(0, len(points), 512):
        block = points[start : start + 512].astype(np.float32)
        index[start : start + 512] = np.argmin(square - 2 * block @ rough.T, axis=1)
    distance = np.sqrt(np.sum((points - among[index]) ** 2, axis=1))
    return index, distance
