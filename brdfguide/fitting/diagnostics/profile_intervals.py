"""Intervals of loosely determined parameters, from the misfit itself where it is not symmetrical about its least value.

The misfit's profile along a parameter: its least value over all the others with that one held. A standard error takes
it for a parabola; where it is not, two standard errors to either side are not where the misfit has risen by as much.
"""

from collections.abc import Mapping

import numpy as np

from ...finding import Finding
from ...numerics import least_squares
from ..layout import Layout, from_coordinate, slope_of_coordinate
from ..objective import Misfit

LOOSE = 0.1  # standard error of a logarithm, below which a parabola will do
UNDETERMINED = 0.5  # the same, above which the value is not given at all
SKEW = 1.25  # of an end's distance over two standard errors, or its inverse, from which it is told
STEPS = 4  # profiles along the way to each end
FAR = 8.0  # times two standard errors, beyond which an end is not looked for


def curved_doubts(
    layout: Layout, misfit: Misfit, best: least_squares.Minimum, values: Mapping, stderr: Mapping
) -> tuple[Finding, ...]:
    """`curved:KEY` with both ends of the 95 % interval, for each shape that is loose and whose profile is not a
    parabola.

    Takes  the minimum `best` of `misfit`, its values and their standard errors.    Gives  nothing for shapes that each
    of several channels has for itself.
    """
    found = []
    for key in (*layout.shared, *(layout.per_channel if layout.channels == 1 else ())):
        parameter = layout.parameters[key]
        value, error = (float(np.ravel(each)[0]) for each in (values[key], stderr[key]))
        sigma = error / abs(slope_of_coordinate(parameter, value))
        if not parameter.log or not LOOSE < sigma < UNDETERMINED:
            continue
        ends = [_end(layout, misfit, best, key, side * 2 * sigma) for side in (-1, 1)]
        if all(1 / SKEW < abs(end) / (2 * sigma) < SKEW for end in ends):
            continue
        at = float(_of(key, layout, best.shared, best.per_channel))
        low, high = (parameter.outside(float(from_coordinate(parameter, at + end))) for end in ends)
        text = (
            f"{key} lies between {low:.3g} and {high:.3g} {parameter.outside_unit}".rstrip()
            + " (95 %): the misfit is not symmetrical about its value"
        )
        found.append(
            Finding(
                "curved",
                text,
                "note",
                "two standard errors mislead",
                numbers=(("low", low), ("high", high)),
                subject=key,
            )
        )
    return tuple(found)


def _of(key: str, layout: Layout, shared, per_channel) -> np.ndarray:
    """The place of one parameter in shared (p,) or per channel (1, q): an array without axes that can be written to."""
    block, keys = (shared, layout.shared) if key in layout.shared else (per_channel.reshape(-1), layout.per_channel)
    return block[keys.index(key), ...]


def _end(layout: Layout, misfit: Misfit, best: least_squares.Minimum, key: str, offset: float) -> float:
    """How far from the best value the profile has risen by what a parabola promises at `offset`; as far as its bound,
    or FAR, at most."""
    at = float(_of(key, layout, best.shared, best.per_channel))
    variance = float(_of(key, layout, *best.normal.variances(1.0)))
    low, high = (float(each[0]) for each in layout.bounds([key]))
    furthest = float(np.clip(at + FAR * offset, low, high)) - at
    if furthest == 0.0:
        return 0.0
    wanted, size = offset**2 / variance, min(1.0, furthest / offset)
    # sizes and the roots of their rises over what is wanted: straight lines where a parabola would do
    inside, outside = (0.0, 0.0), None
    for _ in range(STEPS):
        rise = np.sqrt(max(_profile(layout, misfit, best, key, at + size * offset) - best.cost, 0.0) / wanted)
        inside, outside = ((size, rise), outside) if rise < 1 else (inside, (size, rise))
        if abs(rise - 1) < 0.03 or (rise < 1 and size * offset == furthest):
            break
        if outside is None:
            size = min(size * float(np.clip(1 / max(rise, 0.25), 1.2, 4.0)), furthest / offset)
        else:
            size = inside[0] + (1 - inside[1]) * (outside[0] - inside[0]) / (outside[1] - inside[1])
    return size * offset


def _profile(layout: Layout, misfit: Misfit, best: least_squares.Minimum, key: str, held: float) -> float:
    """The least misfit with one coordinate held."""
    (low, high), (per_channel_low, per_channel_high) = layout.bounds(layout.shared), layout.bounds(layout.per_channel)
    shared, per_channel = best.shared.copy(), best.per_channel.copy()
    for blocks in ((shared, per_channel), (low, per_channel_low), (high, per_channel_high)):
        _of(key, layout, *blocks)[...] = held
    return least_squares.minimise(
        misfit,
        shared,
        per_channel,
        low=low,
        high=high,
        per_channel_low=per_channel_low,
        per_channel_high=per_channel_high,
        tolerance=1e-5,
        most=40,
    ).cost
