"""From which relative change of a parameter on a surface begins to look different: S of 2.5 L* (`physics.seen`).

How well a roughness has to be known depends on what it lies on: 8 % of the width shows on a bare metal, on a white
plastic nobody sees half as much again.
"""

from collections.abc import Iterable
from math import exp, log

import numpy as np

from ..physics import seen
from ..physics.aperture import Instrument
from ..physics.colour import CHANNEL_UM, spans_the_visible
from . import looks
from .surface import Surface

CELLS = 24, 6, 6  # of the sphere: what shows comes out within 4 % of `seen.CELLS` (ours), in two thirds of the time
FIRST = 0.1  # ln of the change that is tried first
MOST = log(10.0)  # ln of the largest change that is tried
CLOSE = 0.04  # of 2.5 L*: near enough
TRIES = 8


def begins_to_show(surface: Surface, keys: Iterable[str]) -> dict[str, float | None]:
    """For each parameter the share by which it has to grow, in all channels alike, until it shows; None where no growth
    within its bounds does. Parameters that are 0, and angles, have none."""
    surface = in_few_channels(surface)
    sphere = looks.sphere_for(True) if looks.turns(surface) else seen.sphere(CELLS)
    instrument, mixture = Instrument(sphere.geom), looks.mixture(surface)

    def lightness(readings: Iterable[np.ndarray]) -> np.ndarray:
        return seen.lightness(sum(readings) @ mixture, sphere.geom.cos_i)

    terms = {term.label: surface.alone(term) for term in surface.model.terms}
    readings = {label: looks.instrument_reading(term, instrument) for label, term in terms.items()}
    before, found = lightness(readings.values()), {}
    for key in keys:
        value, parameter = np.asarray(surface.values[key], float), surface.model.parameters[key]
        label = key.rpartition(".")[0]
        if parameter.unit == "rad" or not np.all(value > 0):
            continue

        def apart(change: float, key=key, value=value, label=label) -> float:
            changed = terms[label].with_value(key, value * exp(change))
            others = (reading for each, reading in readings.items() if each != label)
            after = lightness((looks.instrument_reading(changed, instrument), *others))
            return seen.apart(before, after, sphere.weights)

        found[key] = _root(apart, min(MOST, log(parameter.high / float(value.max()))))
    return found


def in_few_channels(surface: Surface) -> Surface:
    """Red, green and blue of a spectrum by the nearest wavelengths; the middle where it is not visible."""
    if len(surface.channels) <= 3:
        return surface
    um = surface.wavelengths
    if not spans_the_visible(um):
        return surface.middle
    return surface.of_channels([int(np.argmin(np.abs(um - CHANNEL_UM[name]))) for name in "RGB"])


def _root(apart, most: float) -> float | None:
    """exp(x) - 1 where apart(x) is `seen.ALIKE`, 0 < x <= most; S grows about in proportion to x."""
    if most <= 0:
        return None
    low, below, high = 0.0, 0.0, most
    x = min(FIRST, most)
    for _ in range(TRIES):
        s = apart(x)
        if abs(s - seen.ALIKE) < CLOSE * seen.ALIKE:
            break
        if s < seen.ALIKE:
            if x >= most:
                return None
            low, below = x, s
        else:
            high = x
        slope = max((s - below) / (x - low), 1e-9) if x > low else max(s / x, 1e-9)
        x = min(max(x + (seen.ALIKE - s) / slope, low + 0.05 * (high - low)), high)
    return exp(x) - 1
