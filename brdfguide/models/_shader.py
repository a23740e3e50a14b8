"""What the shaders of production tools share: sliders from 0 to 1, and the settings in which they are fitted."""

from collections.abc import Mapping

import numpy as np

from .facts import Facets, Setting
from .model import Parameter

METAL_WORD, COAT_WORD, GRAIN_WORD = "metal", "coat", "grain"


def slider(name: str, default: float, *, low: float = 0.0, high: float = 1.0, free: bool = False, **more) -> Parameter:
    """A shader's slider; held unless it is freed."""
    return Parameter(name, default, low, high, free=free, **more)


def in_shape_of(f: np.ndarray, values: Mapping) -> np.ndarray:
    """A BRDF in the broadcast shape of all the values, also of those of layers that were not there to evaluate."""
    shape = np.broadcast_shapes(f.shape, *(np.shape(value) for value in values.values()))
    return f if f.shape == shape else np.broadcast_to(f, shape).copy()


def coat_setting(fixed: Mapping[str, float], free: tuple[str, ...], start: Mapping[str, float]) -> dict[str, Setting]:
    """A clear coat over it."""
    return {COAT_WORD: Setting(fixed, free, start)}


def grain_setting(name: str, start: float = 0.5) -> dict[str, Setting]:
    """A grain with its azimuth."""
    return {GRAIN_WORD: Setting({}, (name, "axis"), {name: start})}


def starts(roughness: str, index: str | None = None, most: float = np.inf):
    """What a shader starts from of facets: colour, the slider whose square is alpha, and the index of a body."""

    def from_facets(facets: Facets) -> dict:
        found: dict = {"base_color": facets.albedo or facets.f0, roughness: min(facets.alpha, 1.0) ** 0.5}
        if index:
            found[index] = min(facets.n[0], most) if facets.albedo else 1.5
        return found

    return from_facets
