"""A few well-chosen directions out of very many: for searching, where the whole would only cost time."""

from dataclasses import replace
from random import Random

import numpy as np

from .measurement import Finding, Measurement, once

THETA_I_BANDS = 16
TILT_BANDS = 24
AZIMUTH_BANDS = 16


def subset(measurement: Measurement, count: int = 4000, seed: int = 0) -> Measurement:
    """`count` directions that stand for all of them: stratified over incidence, tilt of the half vector and azimuth.

    The directions are ordered by stratum, and one is drawn from each of `count` stretches of equal weight, so that every
    stretch is represented and the mean of any quantity over the subset is an unbiased estimate of its weighted mean over
    the whole. The result therefore carries no weights. Strata are bands of equal weight: narrow where the directions
    crowd, as they do near the mirror direction.

    The same seed gives the same directions. A measurement that is no larger is returned as it is.
    """
    size = len(measurement.geom)
    if size <= count:
        return measurement
    picked = measurement[representative_rows(measurement, count, seed)]
    chosen = len(picked.geom)
    text = f"{chosen} of {size} directions used for the search, stratified over incidence, half angle and azimuth (seed {seed}); errors are over all"
    note = Finding("subset", text, numbers=(("directions", chosen), ("of", size), ("seed", seed)))
    return replace(picked, weights=None).noting(note)


def representative_rows(measurement: Measurement, count: int, seed: int = 0, among=None) -> np.ndarray:
    """The row numbers behind `subset`, ascending; all of them where there are no more than `count`. `among` masks the rows to draw from."""
    size = len(measurement.geom) if among is None else np.count_nonzero(among)
    if size <= count:
        return np.arange(size) if among is None else np.flatnonzero(among)
    order = _by_stratum(measurement)
    order = order if among is None else order[among[order]]
    reach = np.cumsum(_weight(measurement)[order])
    draw = Random(seed).random  # numpy's generators take longer to import than this takes to run
    draws = (np.arange(count) + [draw() for _ in range(count)]) * (reach[-1] / count)
    return np.unique(order[np.searchsorted(reach, draws, side="right").clip(max=size - 1)])


def _weight(measurement: Measurement) -> np.ndarray:
    return np.ones(len(measurement.geom)) if measurement.weights is None else measurement.weights[:, 0]


@once
def _by_stratum(measurement: Measurement) -> np.ndarray:
    """Row numbers along a path that winds through the strata, neighbours on it being neighbours in all three angles."""
    geom, weight = measurement.geom, _weight(measurement)
    incidence = _bands(geom.cos_i[:, 0], weight, THETA_I_BANDS)
    tilt = _bands(geom.tan2_h[:, 0], weight, TILT_BANDS)
    azimuth = _bands(np.abs(np.remainder(geom.phi_deg[:, 0], 360.0) - 180.0), weight, AZIMUTH_BANDS)
    tilt = np.where(incidence % 2, TILT_BANDS - 1 - tilt, tilt)
    azimuth = np.where((incidence * TILT_BANDS + tilt) % 2, AZIMUTH_BANDS - 1 - azimuth, azimuth)
    return np.argsort((incidence * TILT_BANDS + tilt) * AZIMUTH_BANDS + azimuth, kind="stable")


def _bands(values, weight, number: int) -> np.ndarray:
    """0..number-1: bands that hold equal weight."""
    order = np.argsort(values, kind="stable")
    reach = np.cumsum(weight[order])
    bands = np.empty(len(values), np.int64)
    bands[order] = np.minimum((reach - 0.5 * weight[order]) * (number / reach[-1]), number - 1)
    return bands
