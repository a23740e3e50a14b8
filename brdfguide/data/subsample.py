"""A few well-chosen directions out of very many: for searching, where the whole would only cost time."""

from functools import lru_cache
from random import Random

import numpy as np

from ..finding import Finding
from ..formed import formed
from ..physics.geometry import Directions
from .measurement import Measurement
from .turning import turn_of_each

THETA_I_BANDS = 16
TILT_BANDS = 24
AZIMUTH_BANDS = 16
FEW = 50_000  # values, beyond which their edges are found sooner than their order


def subset(measurement: Measurement, count: int = 4000, seed: int = 0) -> Measurement:
    """`count` directions that stand for all of them: stratified over incidence, tilt of the half vector and azimuth.

    The directions are ordered by stratum, and one is taken from each of `count` blocks of equal length, so that
    every block is represented and the mean of any quantity over the subset is an unbiased estimate of its mean over
    the whole. Strata are bands of equally many: narrow where the directions crowd, as they do near the mirror
    direction.

    The same seed gives the same directions. A measurement that is no larger is returned as it is.
    """
    size = len(measurement.geom)
    if size <= count:
        return measurement
    picked = measurement[representative_rows(measurement, count, seed)]
    chosen = len(picked.geom)
    text = (
        f"{chosen} of {size} directions used for the search, stratified over incidence, half angle and azimuth (seed "
        f"{seed}); errors are over all"
    )
    note = Finding("subset", text, numbers=(("directions", chosen), ("of", size), ("seed", seed)))
    return picked.noting(note)


def representative_rows(measurement: Measurement, count: int, seed: int = 0, among=None) -> np.ndarray:
    """The row numbers behind `subset`, ascending; all of them where there are no more than `count`.

    `among` masks the rows to take from.
    """
    size = len(measurement.geom) if among is None else np.count_nonzero(among)
    if size <= count:
        return np.arange(size) if among is None else np.flatnonzero(among)
    order = _by_stratum(measurement.geom)
    order = order if among is None else order[among[order]]
    sampled = (np.arange(count) + _uniform(count, seed)) * (size / count)
    return np.unique(order[sampled.astype(int).clip(max=size - 1)])


@lru_cache(maxsize=8)
def _uniform(count: int, seed: int) -> np.ndarray:
    """Numbers of 0..1; NumPy's generators take longer to import than these take to draw."""
    draw = Random(seed).random
    return np.array([draw() for _ in range(count)])


@formed
def _by_stratum(geom: Directions) -> np.ndarray:
    """Row numbers along a path that winds through the strata, neighbours on it being neighbours in all three angles."""
    incidence = _bands(geom.cos_i[:, 0], THETA_I_BANDS)
    tilt = _bands(geom.tan2_h[:, 0], TILT_BANDS)
    azimuth = _bands(np.abs(np.remainder(geom.phi_deg[:, 0], 360.0) - 180.0), AZIMUTH_BANDS)
    tilt = np.where(incidence % 2, TILT_BANDS - 1 - tilt, tilt)
    azimuth = np.where((incidence * TILT_BANDS + tilt) % 2, AZIMUTH_BANDS - 1 - azimuth, azimuth)
    stratum, turns = (incidence * TILT_BANDS + tilt) * AZIMUTH_BANDS + azimuth, turn_of_each(geom)
    # short numbers sort in a tenth of the time
    return np.argsort(stratum.astype(np.uint16), kind="stable") if turns is None else np.lexsort((turns, stratum))


def _bands(values, number: int) -> np.ndarray:
    """0..number-1: bands that hold equally many; of equal values the first come first."""
    size = len(values)
    if size <= FEW:
        bands = np.empty(size, np.int64)
        bands[np.argsort(values, kind="stable")] = np.arange(size) * number // max(size, 1)
        return bands
    ascending = np.sort(values)
    first = -(-np.arange(1, number) * size // number)  # of each band but the lowest: its least rank
    edges = ascending[first]
    bands = np.searchsorted(edges, values, side="right")
    below = np.searchsorted(ascending, edges)
    for edge, least in dict(zip(edges.tolist(), below.tolist(), strict=True)).items():
        equal = np.flatnonzero(values == edge)
        bands[equal] = (least + np.arange(len(equal))) * number // size
    return bands
