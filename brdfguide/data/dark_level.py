"""The instrument's dark level, from values that light and detector exchange: d/cos theta_i that was left in, or taken
off too much.

    value - exchanged value = d (1/cos theta_i - 1/cos theta_r) + noise

A signal that no light made is divided by the irradiance, which falls as cos theta_i, and so is brighter from grazing
light; the surface itself is the same from both sides (Helmholtz). No model is asked. Values that were multiplied by a
cosine change by that of the two directions, bright ones too: what leaves exchanged values less apart is believed.
"""

import numpy as np

from ..finding import Finding
from ..flags import Effect
from ..formed import formed
from ..records import dataclass
from . import reciprocity
from .measurement import Measurement
from .noise_model import two_parts

LEAST_PAIRS = 20  # whose cosines differ, in a channel that tells its dark level
LEAST_SHARE = 1 / 3  # of its pairs that must have both values
APART = 0.1  # least difference of the inverse cosines of such a pair
SURE = 4.0  # standard errors from which a dark level shows
UNLIKE = 1.15  # median ratio of the dimmer half, below which no dark level is worth taking out (ours)
BETTER = 0.75  # times the scatter of dim pairs, to which it must come down when the dark level is taken out
RECIPROCAL = 1.25  # median ratio of the brightest quarter's pairs, above which something else is wrong
LEAST_IN_BIN = 12  # pairs whose median is a size
TURNS = 3  # of dark level and noise, each found with the other
MEDIAN_STDERR = 1.25  # standard error of a median over that of a mean


@dataclass(frozen=True, eq=False)
class DarkLevel:
    """By channel: d [1/sr] as it stands in the values, its standard error, and the absolute doubt that pairs leave."""

    offset: np.ndarray
    stderr: np.ndarray
    doubt: np.ndarray
    shows: bool
    ratio: float  # by which dim pairs differ, median
    corrected_ratio: float  # the same once d is taken out
    left: float  # median |ln ratio| of the pairs whose cosines differ, once d is taken out
    left_by_cosine: float  # the same once a cosine of either direction is, whichever leaves less


@formed
def dark_level_of(measurement: Measurement) -> DarkLevel | None:
    """None where too few directions are each other's exchange."""
    rows = reciprocity.judged_rows(measurement)
    if rows is None:
        return None
    here, there = (each for each in np.unique(np.sort(np.stack(rows), axis=0), axis=1))
    across = 1 / measurement.geom.cos_i[here, 0] - 1 / measurement.geom.cos_i[there, 0]
    one, other = measurement.readings[here], measurement.readings[there]
    channels = [_of_channel(one[:, place], other[:, place], across) for place in range(one.shape[1])]
    telling = [place for place, each in enumerate(channels) if each is not None]
    if not telling:
        return None
    told = np.array([channels[place] for place in telling])
    # a channel that does not tell lies between those that do: lamp and detector change with the wavelength
    offset, stderr, doubt = (np.interp(np.arange(len(channels)), telling, column) for column in told.T)
    shown = np.abs(told[:, 0]) > SURE * told[:, 1]
    corrected = one - offset / measurement.geom.cos_i[here], other - offset / measurement.geom.cos_i[there]
    bright, before, after = _ratios(one, other, corrected)
    worse = bright < np.log(RECIPROCAL) and before > np.log(UNLIKE)
    left, left_by_cosine = _left(one, other, corrected, measurement.geom.cos_i[here], measurement.geom.cos_i[there])
    shows = shown.mean() >= 0.5 and worse and after < BETTER * before and left < left_by_cosine
    return DarkLevel(
        offset, stderr, doubt, bool(shows), float(np.exp(before)), float(np.exp(after)), left, left_by_cosine
    )


def _of_channel(one, other, across):
    """d shrunk by its error, its standard error and the absolute doubt left; None for too few pairs, or where most have
    no value: those that are left are the brighter ones.
    """
    known, steep = np.isfinite(one + other), np.abs(across) > APART
    known &= steep
    if np.count_nonzero(known) < max(LEAST_PAIRS, LEAST_SHARE * np.count_nonzero(steep)):
        return None
    one, other, across = one[known], other[known], across[known]
    gap, level = one - other, np.maximum(0.5 * (one + other), 0.0)
    offset = 0.0
    for _ in range(TURNS):
        left = (gap - offset * across) / np.sqrt(2)
        relative, absolute = two_parts(level, left, LEAST_IN_BIN, shows=1.0) or (1.0, 0.0)
        sigma = np.sqrt(2) * np.maximum(np.hypot(relative * level, absolute), 1e-30)
        weight = np.abs(across) / sigma
        offset = _weighted_median(gap / across, weight)
    stderr = MEDIAN_STDERR / float(np.sqrt(np.sum(weight**2)))
    doubt = two_parts(level, left, LEAST_IN_BIN)
    return offset / (1 + (stderr / offset) ** 2) if offset else 0.0, stderr, doubt[1] if doubt else 0.0


def _weighted_median(values, weights) -> float:
    order = np.argsort(values)
    cumulative = np.cumsum(weights[order])
    return float(values[order][np.searchsorted(cumulative, 0.5 * cumulative[-1])])


def _ratios(one, other, corrected) -> tuple[float, float, float]:
    """Median |ln ratio| of the brightest quarter of the pairs, of the dimmer half, and of that half `corrected`."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        before, after = np.abs(np.log(one / other)), np.abs(np.log(corrected[0] / corrected[1]))
    known = np.isfinite(before) & np.isfinite(after)
    if not np.any(known):
        return np.inf, 0.0, 0.0
    level = (one + other)[known]
    dim, bright = level <= np.median(level), level >= np.quantile(level, 0.75)
    before, after = before[known], after[known]
    return float(np.median(before[bright])), float(np.median(before[dim])), float(np.median(after[dim]))


def _left(one, other, corrected, cos_one, cos_other) -> tuple[float, float]:
    """Median |ln ratio| of the pairs whose cosines differ, `corrected`, and without a cosine of either direction."""
    with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
        before, after = np.log(one / other), np.log(corrected[0] / corrected[1])
    cosines = np.broadcast_to(np.log(cos_one / cos_other), before.shape)
    known = np.isfinite(before) & np.isfinite(after) & (np.abs(1 / cos_one - 1 / cos_other) > APART)
    if not np.any(known):
        return np.inf, np.inf
    before, after, cosines = before[known], after[known], cosines[known]
    by_cosine = min(float(np.median(np.abs(before + sign * cosines))) for sign in (1, -1))
    return float(np.median(np.abs(after))), by_cosine


def dark_level_finding(measurement: Measurement) -> Finding | None:
    """What was taken off too much or left in, where exchanged pairs show it; undone before a fit."""
    found = dark_level_of(measurement) if measurement.noise is None else None  # else it was taken out
    if found is None or not found.shows:
        return None
    largest = int(np.argmax(np.abs(found.offset)))
    most, span = found.offset[largest], np.abs(found.offset)
    how = "was taken off too much" if most < 0 else "was left in"
    where = f" at {measurement.channels[largest]}" if len(measurement.channels) > 1 else ""
    text = (
        f"dark level: {abs(most):.2g}/sr {how}{where} ({np.median(span):.2g} in the median channel), divided by cos "
        f"theta_i: exchanged dim values differ by a factor {found.ratio:.3g}, and by {found.corrected_ratio:.3g} "
        f"without it"
    )
    numbers = [("ratio", found.ratio), ("corrected_ratio", found.corrected_ratio)]
    for channel, offset, stderr in zip(measurement.channels, found.offset, found.stderr, strict=True):
        numbers += [(f"offset_{channel}_per_sr", float(offset)), (f"stderr_{channel}_per_sr", float(stderr))]
    consequence = "dim values, and every fit in ln, follow the instrument instead of the surface"
    kept = any(each.effect is Effect.KEEPS_VALUES for each in measurement.findings)
    undo = "" if kept else "dark-level"
    return Finding("dark-level", text, "warning", consequence, "--quantity brdf", tuple(numbers), undo=undo)


def without_dark_level(measurement: Measurement) -> np.ndarray:
    """The values without the dark level that `dark_level_finding` names."""
    found = dark_level_of(measurement)
    return measurement.brdf if found is None else measurement.brdf - found.offset / measurement.geom.cos_i
