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
        if not parameter.log or not LOOSE < error / abs(slope_of_coordinate(parameter, value)) < UNDETERMINED:
            continue
        reach = 2 * error / abs(slope_of_coordinate(parameter, value))
        ends = [_end(layout, misfit, best, key, side * reach) for side in (-1, 1)]
        if all(1 / SKEW < abs(end) / reach < SKEW for end in ends):
            continue
        at = _block(layout, best, key)
        low, high = (parameter.outside(float(from_coordinate(parameter, at + end))) for end in ends)
        text = f"{key} lies between {low:.3g} and {high:.3g} {parameter.outside_unit}".rstrip() + " (95 %): the misfit is not symmetrical about its value"
        found.append(Finding(f"curved:{key}", text, "note", "two standard errors mislead", numbers=(("low", low), ("high", high))))
    return tuple(found)


def _block(layout: Layout, best: levenberg.Minimum, key: str) -> float:
    return float(best.shared[layout.shared.index(key)] if key in layout.shared else best.own[0, layout.own.index(key)])


def _end(layout: Layout, misfit: Misfit, best: levenberg.Minimum, key: str, reach: float) -> float:
    """How far from the best value the profile has risen by what a parabola promises at `reach`; as far as its bound, or FAR, at most."""
    at, low, high = _block(layout, best, key), *(float(each[0]) for each in layout.bounds([key]))
    furthest = float(np.clip(at + FAR * reach, low, high)) - at
    if furthest == 0.0:
        return 0.0
    shared, own = best.normal.covariance()
    variance = shared[layout.shared.index(key), layout.shared.index(key)] if key in layout.shared else own[0, layout.own.index(key), layout.own.index(key)]
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
    if key in layout.shared:
        place = layout.shared.index(key)
        low[place] = high[place] = shared[place] = held
    else:
        place = layout.own.index(key)
        own_low[place] = own_high[place] = own[0, place] = held
    return levenberg.minimise(misfit, shared, own, low=low, high=high, own_low=own_low, own_high=own_high, tolerance=1e-5, most=40).cost
