"""Whether values keep when light and detector change places, and which power of the cosines they carry if not.

A BRDF is reciprocal; values that were multiplied by cos theta_r change by (cos theta_r / cos theta_i)^p, p = 1, and by
cos theta_i, p = -1. A wrong dark level adds d / cos theta_i to all: bright values stay reciprocal, dim ones do not.
"""

from dataclasses import dataclass
from math import pi
from random import Random

import numpy as np

from .measurement import Measurement, row_median

NEAR_DEG = 3.0  # how far apart a direction and the exchanged one may lie
LEVER = 0.15  # least |ln (cos theta_r / cos theta_i)| that says something about the power
MOST, BLOCK = 1200, 64  # directions compared, and at once
STEEP = 0.3  # change of ln f over the distance between exchanged directions beyond which they tell nothing
STEADY = 3.0  # |ln ratio| beyond which a peak was met by its flank
UNTOUCHED = 0.2  # power of the cosines that counts as none


@dataclass(frozen=True)
class Reciprocity:
    pairs: int
    power: float | None  # p; None where no pair has a lever
    power_stderr: float | None
    ratio: float  # median of max(a/b, b/a) as measured
    corrected_ratio: float  # the same after division by cos theta_r
    corrected_i_ratio: float  # and by cos theta_i
    dim: "Dim | None"  # how the dimmer half fares, where the brightest quarter is reciprocal and it is not


@dataclass(frozen=True)
class Dim:
    """Exchanged values of the dimmer half, and of the brightest quarter; the dimmer differ as if `offset` / cos theta_i [1/sr] had been added."""

    below: float  # [1/sr]
    ratio: float
    bright_ratio: float
    power: float
    offset: float


def test(measurement: Measurement, seed: int = 0) -> Reciprocity | None:
    """Compares up to 1200 directions with their exchange; None where fewer than 12 pairs can be formed."""
    rows = _exchanged(measurement, seed)
    compared = None if rows is None else _told(measurement, *rows)
    if compared is None:
        return None
    lever, ratio = compared
    power, stderr = _slope(lever, ratio)
    spread = lambda values: float(np.exp(np.median(np.abs(values))))  # noqa: E731
    return Reciprocity(len(ratio), power, stderr, spread(ratio), spread(ratio - lever), spread(ratio + lever), _dim(measurement, *rows))


def pairs(measurement: Measurement, seed: int = 0):
    """ln (cos theta_r / cos theta_i) and ln (value / exchanged value) of every pair; None for fewer than 12."""
    rows = _exchanged(measurement, seed)
    return None if rows is None else _told(measurement, *rows)


def _told(measurement: Measurement, here, there):
    """`pairs` of these rows."""
    lever, ratio = _compared(measurement, here, there)
    counted = np.any(np.isfinite(ratio), axis=1)
    ratio = row_median(ratio[counted])
    lever = lever[counted]
    steady = np.abs(ratio) < STEADY
    ratio, lever = ratio[steady], lever[steady]
    return (lever, ratio) if len(ratio) >= 12 else None


def _exchanged(measurement: Measurement, seed: int):
    """Row numbers of directions and of those nearest to their exchange; None for fewer than 12."""
    geom = measurement.geom
    rows = np.flatnonzero(measurement.seen)
    if len(rows) < 12 or len(geom) > 200_000:
        return None
    here = rows if len(rows) <= MOST else rows[sorted(Random(seed).sample(range(len(rows)), MOST))]
    places = _places(geom[rows])
    there, apart = _nearest(_places(geom.swapped()[here]), places)
    beside, distance = _nearest(places[there], places, there)
    close = (apart < np.radians(NEAR_DEG)) & (rows[there] != here)
    close &= _change(measurement, rows[there], rows[beside]) * apart < STEEP * distance
    return (here[close], rows[there][close]) if np.count_nonzero(close) >= 12 else None


def _change(measurement: Measurement, here, there) -> np.ndarray:
    """|ln (value / other value)|, (pairs,), of the channel in which it is largest."""
    _, ratio = _compared(measurement, here, there)
    return np.max(np.abs(np.where(np.isfinite(ratio), ratio, 0.0)), axis=1)


def _compared(measurement: Measurement, here, there):
    """ln (cos theta_r / cos theta_i) (pairs,) and ln (value / exchanged value) (pairs, channels), NaN where one is missing."""
    both = measurement.usable[here] & measurement.usable[there]
    ratio = np.full(both.shape, np.nan)
    ratio[both] = np.log(measurement.brdf[here][both] / measurement.brdf[there][both])
    return np.log(measurement.geom.cos_r[here, 0] / measurement.geom.cos_i[here, 0]), ratio


def _dim(measurement: Measurement, here, there) -> Dim | None:
    """None unless it is the dimmer half of the values, over all channels, that fails, and not the brightest quarter."""
    lever, ratio = _compared(measurement, here, there)
    with np.errstate(invalid="ignore"):
        told = np.abs(ratio) < STEADY
    size = np.sqrt(measurement.brdf[here] * measurement.brdf[there], where=told, out=np.zeros_like(ratio))[told]
    if size.size < 40:
        return None
    lever, gap = np.broadcast_to(lever[:, None], told.shape)[told], (measurement.brdf[here] - measurement.brdf[there])[told]
    across = 1 / measurement.geom.cos_i[here] - 1 / measurement.geom.cos_r[here]
    ratio, across = ratio[told], np.broadcast_to(across, told.shape)[told]
    below = float(np.median(size))
    of = lambda half: (*_slope(lever[half], ratio[half]), float(np.exp(np.median(np.abs(ratio[half])))))  # noqa: E731
    (bright_power, _, bright_ratio), (power, stderr, dim_ratio) = of(size >= np.quantile(size, 0.75)), of(size <= below)
    if power is None or bright_power is None or abs(bright_power) > UNTOUCHED or bright_ratio > 1.25:
        return None
    if abs(power) < max(2 * UNTOUCHED, 4 * stderr) or np.log(dim_ratio) < 1.5 * np.log(bright_ratio):
        return None
    steep = (size <= below) & (np.abs(lever) > LEVER)
    return Dim(below, dim_ratio, bright_ratio, power, float(np.median(gap[steep] / across[steep])))


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


def _nearest(points, among, but=None):
    """Index of the nearest of `among` for each of `points`, and the distance; never that of `but`.

    The nearest is looked for at like incidences, and among all where it may lie at another. In blocks, so that memory stays small.
    """
    order = np.argsort(among[:, 0], kind="stable")
    among, but = among[order], None if but is None else np.argsort(order)[but]
    # single precision finds the place, to some 0.02 degrees; the distance is then formed exactly
    rough = np.concatenate([np.sum(among**2, axis=1, keepdims=True), among], axis=1).astype(np.float32).T
    wanted = np.concatenate([np.ones((len(points), 1)), -2 * points], axis=1).astype(np.float32)
    index, distance = np.empty(len(points), int), np.empty(len(points))

    def look(rows, first, last) -> None:
        apart = wanted[rows] @ rough[:, first:last]
        if but is not None:
            own = but[rows] - first
            some = np.flatnonzero((own >= 0) & (own < last - first))
            apart[some, own[some]] = np.inf
        index[rows] = first + np.argmin(apart, axis=1)
        distance[rows] = np.sqrt(np.sum((points[rows] - among[index[rows]]) ** 2, axis=1))
        if but is not None:
            distance[rows[index[rows] == but[rows]]] = np.inf

    by_incidence, reach = np.argsort(points[:, 0], kind="stable"), np.radians(NEAR_DEG)
    for rows in np.array_split(by_incidence, -(-len(points) // BLOCK)):
        low, high = np.arcsin(np.minimum(points[rows[[0, -1]], 0], 1.0)) + (-reach, reach)
        first = np.searchsorted(among[:, 0], np.sin(max(low, 0.0)))
        last = np.searchsorted(among[:, 0], np.sin(high), side="right") if high < pi / 2 else len(among)
        if first < last:
            look(rows, first, last)
        far = rows[distance[rows] > 2 * np.sin(reach / 2)] if first < last else rows
        if len(far) and last - first < len(among):
            look(far, 0, len(among))
    return order[index], distance
