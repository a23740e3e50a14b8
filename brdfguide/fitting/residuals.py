"""What a surface leaves of a measurement: ln(model/data) direction by direction, and its rms over very many of them."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from ..data.measurement import Measurement
from ..models.surface import Surface
from .reading import THREADS, reading

BLOCK = 16_384  # directions of which values, angles and logarithms fit the processor's cache together
NO_ERROR = 1e-5  # rms ln that is printed as none: the rounding of exact values, and no misfit, however regular


def ln_residuals(surface: Surface, measurement: Measurement) -> np.ndarray:
    """ln(model/data), (samples, channels), NaN where nothing was measured or it is not clear of the dark level."""
    ln_model = np.maximum(reading(surface, measurement.instrument), measurement.least)
    np.log(ln_model, out=ln_model)
    ln_model -= measurement.ln
    if measurement.clear is not measurement.usable:
        ln_model[~measurement.clear] = np.nan
    return ln_model


def rms(residuals, sample_weights=None) -> float:
    """Root mean square of those that are known, each direction counted by its weight (samples, 1)."""
    squares = residuals * residuals
    if sample_weights is not None:
        squares *= sample_weights
    mean = float(np.add.reduce(squares, axis=None)) / squares.size  # `np.mean`, for small arrays in half its time
    return float(np.sqrt(mean if mean == mean else np.nanmean(squares)))


def _sum_of_squares(residuals, counted) -> float:
    """Of those that are known, each direction counted by its weight (samples, 1)."""
    weighted = residuals if counted is None else residuals * counted
    total = float(np.einsum("sc,sc->", weighted, residuals))
    return total if total == total else float(np.nansum(weighted * residuals))


def rms_over_all(surfaces: Sequence[Surface], measurement: Measurement, sample_weights=None) -> list[float]:
    """`rms` of `ln_residuals` of each surface, block by block, so that nothing of a large table's size is formed and
    what laws form from the directions is formed once for all of them.
    """

    def sums(start: int) -> tuple[list[float], int]:
        rows = slice(start, start + BLOCK)
        part = measurement[rows]
        counted = None if sample_weights is None else sample_weights[rows]
        squares = []
        for surface in surfaces:
            squares.append(_sum_of_squares(ln_residuals(surface, part), counted))
        return squares, int(np.count_nonzero(part.clear))

    with ThreadPoolExecutor(THREADS) as pool:
        found = list(pool.map(sums, range(0, len(measurement.brdf), BLOCK)))
    squares, counts = np.sum([each for each, _ in found], axis=0), sum(count for _, count in found)
    return np.sqrt(squares / counts).tolist()
