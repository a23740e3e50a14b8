"""Cheaper laws in place of a lobe, and shapes refitted to a picture.

A stand-in keeps the body of what is left of the model and replaces its lobes by one simple law of about the same width;
whether the scene can tell is for the picture to say.
"""

from collections.abc import Mapping
from math import log, sqrt, tan

import numpy as np

from . import levenberg, models
from .geometry import in_plane
from .models._base import Sum, Term
from .picture import Picture

LAWS = ("phong-lewis", "blinn", "ward-gmd", "ward", "cook-torrance", "ggx", "beckmann")  # cheapest first
SHAPE_PIXELS = 200  # enough for one or two shapes
STEP = 1e-4


def of(whole: Sum, values: Mapping, width: float, wavelength) -> list[tuple[Sum, dict]]:
    """Sums with one simple lobe in place of all lobes, as (sum, start values); none where the model has no lobe, or only a mirror.

    Takes  width, half width at half height of the lobe about the mirror direction [rad].
    """
    bodies = tuple(term for term in whole.terms if term.model.roles == ("subsurface",))
    lobes = [term for term in whole.terms if "surface" in term.model.roles]
    if not lobes or len(bodies) + len(lobes) < len(whole.terms):
        return []
    alpha = tan(width / 2) / sqrt(log(2))  # half width = 2 atan(alpha √ln 2)
    own = {f"{term.label}.{key}": value for term in bodies for key, value in _of(whole, values, term).items()}
    index = {name: value for term in lobes for name, value in _of(whole, values, term).items() if name in ("n", "k")}
    found = []
    for name in LAWS:
        if [term.model.name for term in lobes] == [name]:
            continue
        lobe = models.term(name)
        start = {"alpha": alpha, "exponent": max((2 / alpha**2 - 2) / (4 if name.startswith("phong") else 1), 1.0), **index}
        sum_ = Sum("+".join([*(term.model.name for term in bodies), name]), (*bodies, Term(name, lobe)))
        lobe_values = {f"{name}.{p.name}": np.clip(start.get(p.name, p.default), p.low, p.high) for p in lobe.parameters}
        found.append((sum_, _level(sum_, own | lobe_values, f"{name}.{lobe.amplitude}", whole, values, wavelength)))
    return found


def _of(whole: Sum, values: Mapping, term) -> dict:
    return {**term.model.defaults(), **whole.of_term(term, {**whole.start, **whole.fixed, **values})}


def _level(sum_: Sum, own: dict, amplitude: str, whole: Sum, values: Mapping, wavelength) -> dict:
    """The values with the lobe's amplitude such that both are alike in the mirror direction at 30°."""
    geom = in_plane([[30.0]], [[30.0]], wavelength)
    body = sum_(geom, own | {amplitude: 0.0})
    lobe = sum_(geom, own | {amplitude: 1.0}) - body
    wanted = np.ravel(np.maximum(whole(geom, values) - body, 0.0) / lobe)
    high = sum_.parameters[amplitude].high
    return own | {amplitude: np.minimum(wanted, high) if wanted.size > 1 else min(float(wanted[0]), high)}


def reshaped(picture: Picture, sum_: Sum, values: Mapping) -> dict:
    """The values with shapes and amplitudes nearest to the picture, by the least square of JND over some of its pixels."""
    q = picture.quadrature
    some = np.arange(0, len(q), -(-len(q) // SHAPE_PIXELS))
    small = Picture(picture.parts, q.some(some).at(picture.parts.wavelength))
    display, channels = q.scene.display, picture.channels
    root = np.sqrt(small.weights)[:, None]
    wanted = display.logarithm(small.reference)
    shapes = [key for key, p in sum_.parameters.items() if p.free and not p.linear and not p.per_channel and p.low > 0 and np.size(values[key]) == 1]
    amplitudes = [key for key, p in sum_.parameters.items() if p.linear]
    low, high = ([np.log(getattr(sum_.parameters[key], end)) for key in shapes] for end in ("low", "high"))
    top = np.array([sum_.parameters[key].high for key in amplitudes])

    def at(shared, own) -> dict:
        return {**values, **dict(zip(shapes, np.exp(shared))), **{key: own[:, place] for place, key in enumerate(amplitudes)}}

    def residuals(shared, own, slopes):
        radiance = small.radiance(sum_, at(shared, own))
        r = (display.logarithm(radiance) - wanted) * root
        if not slopes:
            return r
        by_shape = [(residuals(shared + STEP * (np.arange(len(shapes)) == place), own, False) - r) / STEP for place in range(len(shapes))]
        steps = [STEP * np.maximum(own[:, place], 1e-3) for place in range(len(amplitudes))]
        by_own = [(residuals(shared, own + step[:, None] * (np.arange(len(amplitudes)) == place), False) - r) / step for place, step in enumerate(steps)]
        stack = lambda each: np.stack(each, axis=2).transpose(1, 0, 2) if each else np.zeros((channels, len(some), 0))  # noqa: E731
        return r, stack(by_shape), stack(by_own)

    start = np.log([float(np.ravel(values[key])[0]) for key in shapes]) if shapes else np.zeros(0)
    own = np.stack([np.broadcast_to(np.asarray(values[key], float), (channels,)) for key in amplitudes], axis=1) if amplitudes else np.zeros((channels, 0))
    best = levenberg.minimise(residuals, start, own, low=np.array(low), high=np.array(high), own_low=0.0, own_high=top, most=25, tolerance=1e-5)
    found = at(best.shared, best.own)
    return {key: float(np.ravel(value)[0]) if np.size(value) == 1 else value for key, value in found.items()}
