"""What single values of a measurement are worth: a relative doubt, and the dark level's doubt.

    variance of f = (relative f)² + absolute²

Where f is large its logarithm is known to `relative`; where it is small only that it is small. The scale on which both
are equally sure is ln where f is large and linear where it is small: asinh(f / 2c), c = absolute / relative. What a law
misses by counts as doubt here, since the two are compared.
"""

from dataclasses import replace
from functools import cached_property

import numpy as np

from ..records import dataclass

CLEAR = 10.0  # doubts of the dark level above which a value counts: it is known to a tenth (IUPAC's quantification)
MISSED = 0.1  # relative: the least error that is expected, so that every value that counts lies above c
LEAST = 1e-12  # 1/sr, of c
TINY = np.finfo(float).tiny  # 1/sr: no size is less, so that ratios stay finite
FAINTEST = 1e-100  # of the highest level: none below is taken for one, for the same reason
FEW = 0.01  # of the values; if fewer lie where the two scales differ, ln is taken for all
NEAR = 5.0  # times c, beyond which asinh(f/2c) is ln(f/c) to 4 %
LEAST_IN_BIN = 20  # departures whose median is a size
LEAST_BINS, MOST_BINS = 3, 12
SIGMA_PER_MEDIAN = 1.4826  # of a normal distribution: its standard deviation over the median size
SHOWS = 0.7  # times the mean |ln ratio| without an absolute part, to which it comes down where there is one (ours)
LEAST_GAIN = 0.1  # by which it comes down; medians of twenty scatter by as much


@dataclass(frozen=True)
class NoiseModel:
    """`relative` is None where nothing can be compared; the others, [1/sr], are given for each channel."""

    relative: float | None
    absolute: tuple[float, ...]  # doubt of the dark level; 0 where no value shows one
    dark: tuple[float, ...]  # d, if d/cos theta_i stood in the values and was taken out of them; negative: too little
    dark_stderr: tuple[float, ...]  # of d; 0 where none was taken out
    matters: bool = False  # whether more than a few values are so dim that ln is not their scale
    missed: float = 1.0  # relative error that must be expected of a bright value: its own, and the best law's

    @cached_property
    def floor(self) -> np.ndarray:
        """c of asinh(f / 2c), (channels,); next to nothing where there is no doubt of the dark level."""
        return np.maximum(np.array(self.absolute) / self.missed, LEAST)

    @cached_property
    def limit(self) -> np.ndarray:
        """Values below this, (channels,), are not clear of the dark level: they only say that they are small."""
        return CLEAR * np.array(self.absolute)

    def missing(self, error: float) -> "NoiseModel":
        """The same where even the best law misses bright values by this."""
        return replace(self, missed=float(np.clip(max(error, self.relative or 0.0), MISSED, 1.0)))

    def expected(self, brdf, told) -> float:
        """rms of ln by which the values (samples, channels) scatter that are `told`."""
        if not any(self.absolute):
            return self.relative or 0.0
        brdf, absolute = np.broadcast_arrays(brdf, self.absolute)
        dim = np.mean((absolute[told] / brdf[told]) ** 2)
        return float(np.hypot(self.relative or 0.0, np.sqrt(dim)))

    def weighing(self, brdf) -> "NoiseModel":
        """The same, and whether the two scales differ for these values (samples, channels)."""
        known = np.isfinite(brdf)
        with np.errstate(invalid="ignore"):
            dim = known & (brdf < NEAR * self.floor) & (np.array(self.absolute) > 0)
        return replace(self, matters=bool(np.count_nonzero(dim) > FEW * np.count_nonzero(known)))

    @property
    def has_dark_level(self) -> bool:
        return any(self.dark)

    def of_channels(self, picked) -> "NoiseModel":
        """The same for some of the channels, by their numbers."""

        def pick(values):
            return tuple(values[place] for place in picked)

        return replace(self, absolute=pick(self.absolute), dark=pick(self.dark), dark_stderr=pick(self.dark_stderr))


def two_parts(level, departure, least: int = LEAST_IN_BIN, shows: float = SHOWS) -> tuple[float, float] | None:
    """Relative and absolute standard deviation of values from departures at their levels; None for too few.

    Median sizes in bins of equally many levels against √((relative level)² + absolute²), least sum of |ln ratio|: no
    bin where a lobe is steep, or a gap is wide, decides. The absolute part is 0 unless it brings that sum down to
    `shows`.
    """
    known = np.isfinite(level) & np.isfinite(departure)
    known &= level > max(TINY, FAINTEST * np.max(level[known], initial=0.0))
    level, departure = level[known], np.abs(departure[known])
    bins = min(len(level) // least, MOST_BINS)
    if bins < LEAST_BINS:
        return None
    parts = np.array_split(np.argsort(level, kind="stable"), bins)
    levels = np.array([np.median(level[part]) for part in parts])
    least_size = np.maximum(1e-12 * levels, TINY)
    sizes = np.maximum([SIGMA_PER_MEDIAN * np.median(departure[part]) for part in parts], least_size)
    shares = np.array([1.0, 0.7])[:, None]
    relative = (shares * np.quantile(sizes / levels, np.linspace(0, 1, 2 * bins + 1))).ravel()
    absolute = np.r_[0.0, (shares * np.quantile(sizes, np.linspace(0, 1, 4 * bins + 1))).ravel()]
    expected = np.maximum(np.hypot(relative[:, None, None] * levels, absolute[None, :, None]), TINY)
    cost = np.abs(np.log(expected) - np.log(sizes)).mean(axis=-1)
    one, other = np.unravel_index(np.argmin(cost), cost.shape)
    alone = np.min(cost[:, 0])
    hidden = absolute[other] < relative[one] * levels[0]
    if shows < 1 and (hidden or cost[one, other] > shows * alone or alone - cost[one, other] < LEAST_GAIN):
        return float(relative[np.argmin(cost[:, 0])]), 0.0
    return float(relative[one]), float(absolute[other])
