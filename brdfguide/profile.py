"""Intervals of loosely determined parameters, from the misfit itself where it is not symmetrical about its least value.

The misfit's profile along a parameter: its least value over all the others with that one held. A standard error takes it for
a parabola; where it is not, two standard errors to either side are not where the misfit has risen by as much.
"""

from collections.abc import Mapping

import numpy as np

from . import levenberg
from .measurement import Finding
from .misfit import Layout, Misfit, from_coordinate, slope_of_coordinate

LOOSE, UNDETERMINED = 0.1, 0.5  # standard error of a logarithm: below, a parabola will do; above, the value is not given at all
SKEW = 1.25  # of an end's distance over two standard errors, or its inverse, from which it is told
STEPS = 4  # profiles along the way to each end
FAR = 8.0  # times two standard errors, beyond which an end is not looked for


def doubts(layout: Layout, misfit: Misfit, best: levenberg.Minimum, values: Mapping, stderr: Mapping) -> tuple[Finding, ...]:
    """`curved:KEY` with both ends of the 95 % interval, for each shape that is loose and whose profile is not a parabola.

    Takes  the minimum `best` of `misfit`, its values and their standard errors.    Gives  nothing for shapes that each of
    several channels has for itself.
    """
    found = []
    for key in (*layout.shared, *(layout.own if layout.channels == 1 else ())):
        parameter = layout.parameters[key]
        value, error = (float(np.ravel(each)[0]) for each in (values[key], stderr[key]))
        sigma = error / abs(slope_of_coordinate(parameter, value))
        if not parameter.log or not LOOSE < sigma < UNDETERMINED:
            continue
        ends = [_end(layout, misfit, best, key, side * 2 * sigma) for side in (-1, 1)]
        if all(1 / SKEW < abs(end) / (2 * sigma) < SKEW for end in ends):
            continue
        at = float(_of(key, layout, best.shared, best.own))
        low, high = (parameter.outside(float(from_coordinate(parameter, at + end))) for end in ends)
        text = f"{key} lies between {low:.3g} and {high:.3g} {parameter.outside_unit}".rstrip() + " (95 %): the misfit is not symmetrical about its value"
        found.append(Finding(f"curved:{key}", text, "note", "two standard errors mislead", numbers=(("low", low), ("high", high))))
    return tuple(found)


def _of(key: str, layout: Layout, shared, own) -> np.ndarray:
    """The place of one parameter in the two blocks, shared (p,) and own (1, q), as an array without axes that can be written to."""
    block, keys = (shared, layout.shared) if key in layout.shared else (own.reshape(-1), layout.own)
    return block[keys.index(key), ...]


def _end(layout: Layout, misfit: Misfit, best: levenberg.Minimum, key: str, reach: float) -> float:
    """How far from the best value the profile has risen by what a parabola promises at `reach`; as far as its bound, or FAR, at most."""
    at, variance = float(_of(key, layout, best.shared, best.own)), float(_of(key, layout, *best.normal.variances(1.0)))
    low, high = (float(each[0]) for each in layout.bounds([key]))
    furthest = float(np.clip(at + FAR * reach, low, high)) - at
    if furthest == 0.0:
        return 0.0
    wanted, size = reach**2 / variance, min(1.0, furthest / reach)
    inside, outside = (0.0, 0.0), None  # sizes and the roots of their rises over what is wanted: straight lines where a parabola would do
    for _ in range(STEPS):
        rise = np.sqrt(max(_profile(layout, misfit, best, key, at + size * reach) - best.cost, 0.0) / wanted)
        inside, outside = ((size, rise), outside) if rise < 1 else (inside, (size, rise))
        if abs(rise - 1) < 0.03 or (rise < 1 and size * reach == furthest):
            break
        if outside is None:
            size = min(size * float(np.clip(1 / max(rise, 0.25), 1.2, 4.0)), furthest / reach)
        else:
            size = inside[0] + (1 - inside[1]) * (outside[0] - inside[0]) / (outside[1] - inside[1])
    return size * reach


def _profile(layout: Layout, misfit: Misfit, best: levenberg.Minimum, key: str, held: float) -> float:
    """The least misfit with one coordinate held."""
    (low, high), (own_low, own_high) = layout.bounds(layout.shared), layout.bounds(layout.own)
    shared, own = best.shared.copy(), best.own.copy()
    for blocks in ((shared, own), (low, own_low), (high, own_high)):
        _of(key, layout, *blocks)[...] = held
    return levenberg.minimise(misfit, shared, own, low=low, high=high, own_low=own_low, own_high=own_high, tolerance=1e-5, most=40).cost
