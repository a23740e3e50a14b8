"""Lobes back toward the light, whose quadrature is by half vectors of the light turned about the normal by half a turn.

About the mirror direction half vectors lie closer and closer; a narrow lobe elsewhere falls between them. Where both
stand, each direction's share goes to the one that it is near, by the fourth power of the other's tilt.
"""

import numpy as np

from ..exporters.exporter import ColouredSurface
from ..physics.geometry import Geometry

PEAKED = 1.05  # a lobe at the light, over the mean of what is 4 degrees to either side
TURN = np.array([-1.0, -1.0, 1.0])  # half a turn about the normal


def shines_back(surface: ColouredSurface) -> bool:
    """Whether a surface has a lobe about the light, or a law for one."""
    if any(term.model.family == "retro-reflection" for term in surface.model.terms):
        return True
    low, middle, high = surface.rgb(Geometry.from_degrees(np.array([[41.0], [45.0], [49.0]]), 180.0, 45.0, 180.0))
    return bool(np.max(middle - PEAKED * 0.5 * (low + high)) > 0)


def share_of_mirror_side(i, r, mirror=1.0, back=1.0) -> np.ndarray:
    """How much of directions i (..., 3), seen from r, is counted about the mirror direction and not about the light;
    `mirror` and `back` are how far either quadrature reaches, 0..1."""
    tilt2 = np.sum((i + r)[..., :2] ** 2, axis=-1)
    turned2 = np.sum((i * TURN + r)[..., :2] ** 2, axis=-1)
    one, other = mirror * turned2**2, back * tilt2**2
    return one / np.maximum(one + other, 1e-30)
