"""Whether values keep when light and detector change places, and which power of the cosines they carry if not.

A BRDF is reciprocal; values that were multiplied by cos theta_r change by (cos theta_r / cos theta_i)^p, p = 1, and by
cos theta_i, p = -1. A wrong dark level adds d / cos theta_i to all: bright values stay reciprocal, dim ones do not.
"""

from math import pi
from random import Random

import numpy as np

from ..formed import formed
from ..records import dataclass
from . import lobe_ellipse, turning
from .measurement import Measurement, row_median

NEAR_DEG = 3.0  # how far apart a direction and the exchanged one may lie
EXACT_DEG = 0.05  # and within which they are each other's exchange, to the digits that files give
ENOUGH = 12  # pairs that say something
LEAST_LN_COSINE_RATIO = 0.15  # least |ln (cos theta_r / cos theta_i)| that says something about the power
MOST = 1200  # directions compared
BLOCK = 64  # of them at once
SEED = 0  # by which they are drawn
NEARER = 0.5  # times what the exchange moves a direction, within which its partner must lie: else nothing is exchanged
STEEP = 0.3  # change of ln f over the distance between exchanged directions beyond which they tell nothing
STEADY = 3.0  # |ln ratio| beyond which a peak was met by its flank
GRAIN = 0.1  # rms of ln over rotations beyond which the azimuth of the light counts in an exchange
UNTOUCHED = 0.2  # power of the cosines that counts as none


@dataclass(frozen=True)
class Reciprocity:
    pairs: int
    power: float | None  # p; None where the cosines of no pair differ
    power_stderr: float | None
    ratio: float  # median of max(a/b, b/a) as measured
    corrected_ratio: float  # the same after division by cos theta_r
    corrected_i_ratio: float  # and by cos theta_i
    dim: "Dim | None"  # how the dimmer half fares, where the brightest quarter is reciprocal and it is not


@dataclass(frozen=True)
class Dim:
    """Exchanged values of the dimmer half, and of the brightest quarter; the dimmer differ as if `offset` / cos theta_i
    [1/sr] had been added."""

    below: float  # [1/sr]
    ratio: float
    bright_ratio: float
    power: float
    offset: float


def test(measurement: Measurement) -> Reciprocity | None:
    """Compares up to 1200 directions with their exchange; None where fewer than 12 pairs can be formed."""
    rows = exchanged_rows(measurement)
    compared = None if rows is None else _steady(measurement, *judged_rows(measurement))
    if rows is None or compared is None:
        return None
    ln_cosine_ratio, ratio = compared
    power, stderr = _slope(ln_cosine_ratio, ratio)

    def spread(values):
        return float(np.exp(np.median(np.abs(values))))

    return Reciprocity(
        len(ratio),
        power,
        stderr,
        spread(ratio),
        spread(ratio - ln_cosine_ratio),
        spread(ratio + ln_cosine_ratio),
        _dim(measurement, *rows),
    )


def exchanged_pairs(measurement: Measurement):
    """ln (cos theta_r / cos theta_i) and ln (value / exchanged value) of every pair; None for fewer than 12."""
    rows = exchanged_rows(measurement)
    return None if rows is None else _steady(measurement, *judged_rows(measurement))


def _steady(measurement: Measurement, here, there):
    """`exchanged_pairs` of these rows."""
    ln_cosine_ratio, ratio = _compared(measurement, here, there)
    counted = np.any(np.isfinite(ratio), axis=1)
    ratio = row_median(ratio[counted])
    ln_cosine_ratio = ln_cosine_ratio[counted]
    steady = np.abs(ratio) < STEADY
    ratio, ln_cosine_ratio = ratio[steady], ln_cosine_ratio[steady]
    return (ln_cosine_ratio, ratio) if len(ratio) >= ENOUGH else None


@formed
def exchanged_rows(measurement: Measurement):
    """Row numbers of directions and of those nearest to their exchange; None for fewer than 12."""
    geom = measurement.geom
    rows = np.flatnonzero(measurement.has_value)
    if len(rows) < ENOUGH or len(geom) > 200_000:
        return None
    here = rows if len(rows) <= MOST else rows[sorted(Random(SEED).sample(range(len(rows)), MOST))]
    turns = _turns(measurement)
    places = _places(geom[rows], turns)
    exchanged = _places(geom.swapped()[here], turns)
    there, apart = _nearest(exchanged, places)
    moved = np.sqrt(np.sum((exchanged - _places(geom[here], turns)) ** 2, axis=1))
    beside, distance = _nearest(places[there], places, there)
    close = (apart < np.radians(NEAR_DEG)) & (rows[there] != here) & (apart < NEARER * moved)
    close &= (apart < np.radians(EXACT_DEG)) | (
        _change(measurement, rows[there], rows[beside]) * apart < STEEP * distance
    )
    return (here[close], rows[there][close]) if np.count_nonzero(close) >= ENOUGH else None


@formed
def judged_rows(measurement: Measurement):
    """The pairs to judge by: exact exchanges alone, where enough of them could tell a cosine: beside a lobe a few
    degrees weigh as much.
    """
    rows = exchanged_rows(measurement)
    if rows is None:
        return None
    here, there = rows
    turns = _turns(measurement)
    exchanged, places = _places(measurement.geom.swapped()[here], turns), _places(measurement.geom[there], turns)
    apart = np.sqrt(np.sum((exchanged - places) ** 2, axis=1))
    exact = apart < np.radians(EXACT_DEG)
    ln_cosine_ratio, _ = _compared(measurement, here, there)
    enough = np.count_nonzero(exact & (np.abs(ln_cosine_ratio) > LEAST_LN_COSINE_RATIO)) >= ENOUGH
    return (here[exact], there[exact]) if enough else rows


def _change(measurement: Measurement, here, there) -> np.ndarray:
    """|ln (value / other value)|, (pairs,), of the channel in which it is largest."""
    _, ratio = _compared(measurement, here, there)
    return np.max(np.abs(np.where(np.isfinite(ratio), ratio, 0.0)), axis=1)


def _compared(measurement: Measurement, here, there):
    """ln (cos theta_r / cos theta_i) (pairs,), ln (value / exchanged value) (pairs, channels), NaN if one lacks."""
    both = measurement.usable[here] & measurement.usable[there]
    ratio = np.full(both.shape, np.nan)
    ratio[both] = np.log(measurement.brdf[here][both] / measurement.brdf[there][both])
    return np.log(measurement.geom.cos_r[here, 0] / measurement.geom.cos_i[here, 0]), ratio


def _dim(measurement: Measurement, here, there) -> Dim | None:
    """None unless it is the dimmer half of the values, over all channels, that fails, and not the brightest quarter."""
    ln_cosine_ratio, ratio = _compared(measurement, here, there)
    with np.errstate(invalid="ignore"):
        steady = np.abs(ratio) < STEADY
    size = np.sqrt(measurement.brdf[here][steady] * measurement.brdf[there][steady])
    if size.size < 40:
        return None
    ln_cosine_ratio = np.broadcast_to(ln_cosine_ratio[:, None], steady.shape)[steady]
    gap = measurement.brdf[here][steady] - measurement.brdf[there][steady]
    across = 1 / measurement.geom.cos_i[here] - 1 / measurement.geom.cos_r[here]
    ratio, across = ratio[steady], np.broadcast_to(across, steady.shape)[steady]
    below = float(np.median(size))

    def of(half):
        return (*_slope(ln_cosine_ratio[half], ratio[half]), float(np.exp(np.median(np.abs(ratio[half])))))

    (bright_power, _, bright_ratio), (power, stderr, dim_ratio) = of(size >= np.quantile(size, 0.75)), of(size <= below)
    if power is None or bright_power is None or abs(bright_power) > UNTOUCHED or bright_ratio > 1.25:
        return None
    if abs(power) < max(2 * UNTOUCHED, 4 * stderr) or np.log(dim_ratio) < 1.5 * np.log(bright_ratio):
        return None
    steep = (size <= below) & (np.abs(ln_cosine_ratio) > LEAST_LN_COSINE_RATIO)
    return Dim(below, dim_ratio, bright_ratio, power, float(np.median(gap[steep] / across[steep])))


def _slope(ln_cosine_ratio, ratio):
    """Weighted median of ratio/ln_cosine_ratio, and its standard error from the spread."""
    determined = np.abs(ln_cosine_ratio) > LEAST_LN_COSINE_RATIO
    if np.count_nonzero(determined) < 8:
        return None, None
    slope, weight = ratio[determined] / ln_cosine_ratio[determined], np.abs(ln_cosine_ratio[determined])
    order = np.argsort(slope)
    cumulative = np.cumsum(weight[order])
    middle = float(slope[order][np.searchsorted(cumulative, 0.5 * cumulative[-1])])
    deviation = np.abs(slope - middle)
    order = np.argsort(deviation)
    spread = deviation[order][np.searchsorted(np.cumsum(weight[order]), 0.5 * cumulative[-1])]
    return middle, float(1.86 * spread / np.sqrt(np.count_nonzero(determined)))


def _turns(measurement: Measurement) -> bool:
    """Whether the sample has a grain, so that its exchange has the light where the detector stood on the sample."""
    spread = turning.spread_over_turns(measurement)
    return lobe_ellipse.looks_grained(measurement) if spread is None else spread > GRAIN


def _places(geom, turns: bool = False) -> np.ndarray:
    """Five numbers for each pair of directions, with the light in one plane and the sides of that plane alike; two more
    for the light's place on a sample that has a grain."""
    phi = np.radians(geom.phi_deg[:, 0])
    sin_i, sin_r = geom.sin_i[:, 0], geom.sin_r[:, 0]
    numbers = [sin_i, geom.cos_i[:, 0], sin_r * np.cos(phi), sin_r * np.abs(np.sin(phi)), geom.cos_r[:, 0]]
    if turns:
        light = 2 * np.radians(geom.phi_i_deg[:, 0])  # half a turn of a grain is none
        numbers += [sin_i * np.cos(light), sin_i * np.sin(light)]
    return np.stack(numbers, axis=1)


def _nearest(points, among, but=None):
    """Index of the nearest of `among` for each of `points`, and the distance; never that of `but`.

    The nearest is looked for at like incidences, and among all where it may lie at another. In blocks, so that memory
    stays small.
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
            itself = but[rows] - first
            some = np.flatnonzero((itself >= 0) & (itself < last - first))
            apart[some, itself[some]] = np.inf
        index[rows] = first + np.argmin(apart, axis=1)
        distance[rows] = np.sqrt(np.sum((points[rows] - among[index[rows]]) ** 2, axis=1))
        if but is not None:
            distance[rows[index[rows] == but[rows]]] = np.inf

    by_incidence, radius = np.argsort(points[:, 0], kind="stable"), np.radians(NEAR_DEG)
    for rows in np.array_split(by_incidence, -(-len(points) // BLOCK)):
        low, high = np.arcsin(np.minimum(points[rows[[0, -1]], 0], 1.0)) + (-radius, radius)
        first = np.searchsorted(among[:, 0], np.sin(max(low, 0.0)))
        last = np.searchsorted(among[:, 0], np.sin(high), side="right") if high < pi / 2 else len(among)
        if first < last:
            look(rows, first, last)
        far = rows[distance[rows] > 2 * np.sin(radius / 2)] if first < last else rows
        if len(far) and last - first < len(among):
            look(far, 0, len(among))
    return order[index], distance
