"""What gains of whole scans leave open: a sample that is turned is mounted anew, and each scan's gain is its own.

    r = J δ + Z g + noise,   g of variance τ²;   Var δ = (JᵀJ)⁻¹ Jᵀ(σ² + τ² Z Zᵀ) J (JᵀJ)⁻¹

Z has a column for each scan. With t = Zᵀr at the minimum, n = diag ZᵀZ and G = ZᵀZ - ZᵀJ(JᵀJ)⁻¹JᵀZ, what the fit
leaves of the gains,

    E Σ t²/n = σ² tr(n⁻¹G) + τ² tr(n⁻¹G²)

gives τ², σ² being that within scans (variance components by moments, Henderson 1953). Means of a dozen scans show a
gain far below the noise of one value, which neighbours that err together do not.
"""

from collections.abc import Mapping

import numpy as np

from ...numerics.least_squares import Minimum
from ...records import dataclass
from ..layout import Layout
from ..objective import Misfit
from ..reading import reading
from . import standard_errors

FEWEST = 3  # scans beyond what the fit took of them, from which their spread is told


def with_scan_gains(
    layout: Layout, values: Mapping, stderr: dict, best: Minimum, misfit: Misfit, scan: np.ndarray | None
) -> tuple[dict, float]:
    """Standard errors of the free parameters with those by gains, and τ; 0 where scans stand no farther apart than
    their noise lets them, or too few are left beside what was fitted.

    Takes  `scan` (samples,), the number of each row's; None where the sample was not turned.
    """
    if scan is None:
        return stderr, 0.0
    residual, *slopes = best.at_minimum
    column = _by_gain(best, misfit)
    kept = np.any(column != 0, axis=1)
    numbers, number = np.unique(scan[kept], return_inverse=True)
    scans = _Scans(number.reshape(-1), len(numbers), kept)
    size = scans.sums(np.sum(column**2, axis=1))
    mean = scans.sums(np.sum(column * residual, axis=1)) / size
    moved = scans.flat(*best.normal.influence(column, *slopes))
    pull = scans.flat(*_pulls(column, *slopes))
    taken = np.sum(pull * moved, axis=1)  # diagonal of ZᵀJ(JᵀJ)⁻¹JᵀZ
    left = len(size) - float(np.sum(taken / size))
    if left < FEWEST:
        return stderr, 0.0
    left_squared = float(np.sum(size - 2 * taken) + np.sum(((pull / size[:, None]).T @ pull) * (moved.T @ moved)))
    within = np.where(column != 0, residual, np.nan)
    within[kept] -= column[kept] * mean[scans.number, None]
    noise = _noise(within, layout.count + len(size), misfit)
    variance = (float(np.sum(mean**2 * size)) - noise * left) / left_squared
    if variance <= 0:
        return stderr, 0.0
    student, count = standard_errors.student_widening(left), len(layout.shared)
    spread = student**2 * variance * np.sum(moved**2, axis=0)
    per_channel = spread[count:].reshape(layout.channels, len(layout.per_channel))
    by_gains = standard_errors.in_units(layout, values, spread[:count], per_channel)
    return {key: np.hypot(error, by_gains[key]) for key, error in stderr.items()}, float(np.sqrt(variance))


@dataclass(frozen=True, eq=False)
class _Scans:
    """Sums over scans, of the rows that count."""

    number: np.ndarray  # of each of these
    count: int
    kept: np.ndarray  # which of all rows they are

    def sums(self, values: np.ndarray) -> np.ndarray:
        """(scans,) of values (rows,)."""
        return np.bincount(self.number, values[self.kept], self.count)

    def flat(self, shared: np.ndarray, per_channel: np.ndarray) -> np.ndarray:
        """(scans, coordinates): sums of shared (rows, p) and of each channel's own (channels, rows, q)."""
        columns = [*shared.T, *(each for channel in per_channel for each in channel.T)]
        return np.stack([self.sums(each) for each in columns], axis=1)


def _by_gain(best: Minimum, misfit: Misfit) -> np.ndarray:
    """d residual / d ln f, (samples, channels). A gain is taken of the model: of a value near the dark level it would
    follow that value's own noise."""
    surface = misfit.layout.surface(best.shared, best.per_channel, misfit.measurement)
    f = reading(surface, misfit.measurement.instrument).T
    return (misfit.residuals_and_factor(f)[1] * f).T


def _pulls(column, j_shared, j_per_channel) -> tuple[np.ndarray, np.ndarray]:
    """What a column has in common with each coordinate, sample by sample: shared ones (samples, p) and each channel's
    (channels, samples, q)."""
    by_channel = column.T[:, :, None]
    return np.sum(j_shared * by_channel, axis=0), j_per_channel * by_channel


def _noise(within: np.ndarray, fitted: int, misfit: Misfit) -> float:
    """Variance of one value within its scan, as many times as neighbours and channels say the same."""
    correlation, _ = standard_errors.serial_correlation(within, [standard_errors.along_scans(misfit.measurement)])
    variance = float(np.nansum(within**2)) / max(int(np.count_nonzero(np.isfinite(within))) - fitted, 1)
    return variance * standard_errors.serial_widening(correlation) * standard_errors.common_channels(within)
