"""A measurement made ready for many fits: which directions and channels each stage of a fit looks at, chosen once."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..data import subsample
from ..data.measurement import Measurement
from ..errors import InputError, NoAnswer
from ..formed import formed
from ..records import dataclass
from . import starting_grid, weights
from .diagnostics import standard_errors
from .layout import Layout
from .objective import Metric, Misfit

SEARCH_SAMPLES = 400  # directions on which the starts are followed
SEARCH_CHANNELS = 4
NEAR_SAMPLES = 2000  # directions on which all channels come close
SETTLE_VALUES = 75_000  # all of so many values settle the answer
SETTLE_SAMPLES = 8_000  # of a larger table so many directions do; its error is over all
COMPARED_SAMPLES = 40_000  # of a larger table, on which residuals are kept and models compared


@dataclass(frozen=True, eq=False)
class Subset:
    """Some of the directions, all channels."""

    rows: np.ndarray | slice  # of those on which the best models settle
    measurement: Measurement
    weights: np.ndarray  # (samples, channels)

    def misfit(self, layout: Layout, scale: Metric) -> Misfit:
        return Misfit(layout, self.measurement, scale, self.weights)

    def expecting(self, error: float) -> "Subset":
        """The same where even the best law misses by this."""
        return replace(self, measurement=expecting(self.measurement, error))

    def some(self, rows) -> "Subset":
        """Those of its rows; itself where that is all."""
        return self if len(rows) == len(self.weights) else Subset(rows, self.measurement[rows], self.weights[rows])


@dataclass(frozen=True, eq=False)
class Prepared:
    """A measurement made ready for many fits: what each stage looks at, chosen once."""

    whole: Measurement
    used: np.ndarray  # rows of `whole` on which the best models settle
    compared: Measurement  # on which residuals are kept: all of up to COMPARED_SAMPLES directions
    settle: Subset  # these
    fewer: Subset  # for models that are far behind
    near: Subset  # enough to come close
    search: Subset  # few directions, few channels
    orders: list  # of the rows of `settle`
    blocks: list  # of neighbours in each order
    scans: np.ndarray | None  # the number of each of these rows' scan, where the sample was turned between them
    sample_weights: np.ndarray | None  # of the directions of `whole`

    @property
    def compared_weights(self) -> np.ndarray | None:
        """Those of the directions of `compared`."""
        return weights_where_compared(self.whole, self.sample_weights)

    @property
    def missed(self) -> float | None:
        """Relative error that is expected of bright values; None where that decides nothing."""
        noise = self.whole.noise
        return noise.missed if noise is not None and noise.matters else None

    def expecting(self, error: float) -> "Prepared":
        """The same where even the best law misses by this: the darker a value, the sooner it is too dim to tell."""
        if self.missed is None:
            return self
        whole, settle = expecting(self.whole, error), self.settle.expecting(error)
        return replace(
            self,
            whole=whole,
            compared=whole if self.compared is self.whole else expecting(self.compared, error),
            settle=settle,
            fewer=self.fewer.expecting(error),
            near=self.near.expecting(error),
            search=settle if self.search is self.settle else self.search.expecting(error),
        )


def prepare(measurement: Measurement, weighting: str = "auto") -> Prepared:
    """Chooses the directions to search on and to settle on; `weighting` as in `weights.of_values`.

    Raises InputError where there is nothing to fit, NoAnswer where no value is clear of the dark level.
    """
    if not measurement.usable.any():
        raise InputError(f"{measurement.name or 'the data'}: no positive value above the horizon to fit")
    if not measurement.clear.any():
        raise NoAnswer(f"{measurement.name or 'the data'}: no value is clear of the instrument's dark level")
    size = int(np.count_nonzero(measurement.has_value))
    if size * measurement.brdf.shape[1] > SETTLE_VALUES:
        size = SETTLE_SAMPLES
    rows = subsample.representative_rows(measurement, size, among=measurement.has_value)
    settle = Subset(slice(None), measurement, weights.of_values(measurement, weighting))
    if len(rows) < len(measurement.brdf):
        settle = Subset(slice(None), measurement[rows], settle.weights[rows])
    fewer, near = (
        settle.some(subsample.representative_rows(settle.measurement, count))
        for count in (SETTLE_SAMPLES, NEAR_SAMPLES)
    )
    thin = starting_grid.spread_rows(settle.measurement, SEARCH_SAMPLES)
    channels = few_channels(measurement.brdf.shape[1])
    search = settle.some(thin)
    if len(channels) < measurement.brdf.shape[1]:
        search = Subset(thin, search.measurement.of_channels(channels), search.weights[:, channels])
    orders = standard_errors.orderings(settle.measurement)
    blocks = [standard_errors.blocks_of(settle.measurement, orders[0]), *map(standard_errors.even_blocks, orders[1:])]
    scans = standard_errors.whole_scans(settle.measurement)
    if scans is not None:
        blocks.append(scans)
    return Prepared(
        measurement,
        rows,
        compared(measurement),
        settle,
        fewer,
        near,
        search,
        orders,
        blocks,
        scans,
        weights.sample_weights(measurement, weighting),
    )


@formed
def compared(measurement: Measurement) -> Measurement:
    """The directions on which models are compared: itself where it is no larger."""
    rows = compared_rows(measurement)
    return measurement if len(rows) == len(measurement.brdf) else measurement[rows]


def weights_where_compared(measurement: Measurement, sample_weights: np.ndarray | None) -> np.ndarray | None:
    """Of the weights of its directions those of the ones on which models are compared."""
    return None if sample_weights is None else sample_weights[compared_rows(measurement)]


def compared_rows(measurement: Measurement) -> np.ndarray:
    """Their rows, ascending."""
    return subsample.representative_rows(measurement, COMPARED_SAMPLES)


def expecting(measurement: Measurement, error: float) -> Measurement:
    """The same where even the best law misses by this."""
    noise = measurement.noise
    return measurement if noise is None else replace(measurement, noise=noise.missing(error))


@lru_cache(maxsize=64)
def few_channels(count: int) -> np.ndarray:
    """Numbers of at most four channels, spread over the spectrum; not to be changed."""
    channels = np.unique(np.linspace(0, count - 1, min(count, SEARCH_CHANNELS)).round().astype(int))
    channels.flags.writeable = False
    return channels
