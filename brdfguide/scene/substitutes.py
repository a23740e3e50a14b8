"""Cheaper laws in place of a lobe, and shapes refitted to a picture.

A substitute keeps the body of what is left of the model and replaces its lobes by one simple law of about the same
width; whether the scene can tell is for the picture to say.
"""

from dataclasses import replace
from functools import cached_property
from math import log, sqrt, tan

import numpy as np

from ..models import candidates
from ..models.facts import Facets
from ..models.model import Composite, Term
from ..models.surface import Surface
from ..numerics import least_squares
from ..physics.geometry import in_plane
from ..records import dataclass
from .difference import Picture

SHAPE_PIXELS = 200  # enough for one or two shapes
STEP = 1e-4


def of(whole: Surface, width: float) -> list[Surface]:
    """Surfaces with one simple lobe in place of all lobes, roughly as bright; none where the model has no lobe, or only
    a mirror.

    Takes  width, half width at half height of the lobe about the mirror direction [rad].
    """
    bodies = tuple(term for term in whole.model.terms if term.model.is_body)
    lobes = [term for term in whole.model.terms if term.model.is_lobe]
    if not lobes or len(bodies) + len(lobes) < len(whole.model.terms):
        return []
    alpha = tan(width / 2) / sqrt(log(2))  # half width = 2 atan(alpha √ln 2)
    of_bodies = {term.key(name): value for term in bodies for name, value in whole.values_of(term).items()}
    index = {name: value for term in lobes for name, value in whole.values_of(term).items() if name in ("n", "k")}
    found = []
    for lobe in candidates.substitutes():
        name = lobe.name
        if [term.model.name for term in lobes] == [name]:
            continue
        shape = {key: value for key, value in lobe.started(Facets(alpha)).items() if np.ndim(value) == 0}
        start = shape | index
        model = Composite("+".join([*(term.model.name for term in bodies), name]), (*bodies, Term(name, lobe)))
        shape = {f"{name}.{p.name}": np.clip(start.get(p.name, p.default), p.low, p.high) for p in lobe.parameters}
        found.append(_level(replace(whole, model=model, values=of_bodies | shape), f"{name}.{lobe.amplitude}", whole))
    return found


def _level(surface: Surface, amplitude: str, whole: Surface) -> Surface:
    """The surface with its lobe's amplitude such that both are alike in the mirror direction at 30°."""
    geom = in_plane([[30.0]], [[30.0]])
    body = surface.with_value(amplitude, 0.0).brdf(geom)
    lobe = surface.with_value(amplitude, 1.0).brdf(geom) - body
    wanted = np.ravel(np.maximum(whole.brdf(geom) - body, 0.0) / lobe)
    high = surface.model.parameters[amplitude].high
    return surface.with_value(amplitude, np.minimum(wanted if np.ptp(wanted) > 0 else float(wanted[0]), high))


@dataclass(frozen=True, eq=False)
class _Residuals:
    """JND of a surface against the whole, as a function of its shapes, in logarithms, and of its amplitudes."""

    picture: Picture
    surface: Surface
    shapes: tuple[str, ...]
    amplitudes: tuple[str, ...]

    @cached_property
    def _wanted(self) -> np.ndarray:
        return self.picture.quadrature.scene.display.logarithm(self.picture.reference)

    def surface_at(self, shared, per_channel) -> Surface:
        values = dict(zip(self.shapes, np.exp(shared), strict=True))
        values |= {key: per_channel[:, place] for place, key in enumerate(self.amplitudes)}
        return replace(self.surface, values={**self.surface.values, **values})

    def __call__(self, shared, per_channel, slopes):
        shown = self.picture.quadrature.scene.display.logarithm(
            self.picture.radiance(self.surface_at(shared, per_channel))
        )
        r = (shown - self._wanted) * np.sqrt(self.picture.weights)[:, None]
        return (r, *self._slopes(shared, per_channel, r)) if slopes else r

    def _slopes(self, shared, per_channel, r):
        """Differences along each shape and along each amplitude, (channels, pixels, parameters)."""
        by_shape, by_amplitude = np.empty((*r.T.shape, len(self.shapes))), np.empty((*r.T.shape, len(self.amplitudes)))
        for place in range(len(self.shapes)):
            moved = shared + STEP * (np.arange(len(self.shapes)) == place)
            by_shape[:, :, place] = ((self(moved, per_channel, False) - r) / STEP).T
        for place in range(len(self.amplitudes)):
            step = STEP * np.maximum(per_channel[:, place], 1e-3)
            moved = per_channel + step[:, None] * (np.arange(len(self.amplitudes)) == place)
            by_amplitude[:, :, place] = ((self(shared, moved, False) - r) / step).T
        return by_shape, by_amplitude


def reshaped(picture: Picture, surface: Surface) -> Surface:
    """The surface with shapes and amplitudes nearest to the picture, by the square of JND over some of its pixels."""
    parameters, values = surface.model.parameters, surface.values
    amplitudes = tuple(key for key, p in parameters.items() if p.linear)
    shapes = tuple(
        key
        for key, p in parameters.items()
        if p.free and not p.linear and not p.per_channel and p.low > 0 and np.size(values[key]) == 1
    )
    q = picture.quadrature
    some = np.arange(0, len(q), -(-len(q) // SHAPE_PIXELS))
    residuals = _Residuals(Picture(picture.features, q.some(some)), surface, shapes, amplitudes)
    start = np.array([np.log(np.ravel(values[key])[0]) for key in shapes])
    per_channel = np.empty((picture.channels, len(amplitudes)))
    for place, key in enumerate(amplitudes):
        per_channel[:, place] = values[key]
    best = least_squares.minimise(
        residuals,
        start,
        per_channel,
        low=np.array([np.log(parameters[key].low) for key in shapes]),
        high=np.array([np.log(parameters[key].high) for key in shapes]),
        per_channel_low=0.0,
        per_channel_high=np.array([parameters[key].high for key in amplitudes]),
        most=25,
        tolerance=1e-5,
    )
    found = residuals.surface_at(best.shared, best.per_channel).values
    single = {key: float(np.ravel(value)[0]) if np.size(value) == 1 else value for key, value in found.items()}
    return replace(surface, values=single)
