"""Lobes back toward the light, whose quadrature is by half vectors of the light turned about the normal by half a turn.

About the mirror direction half vectors lie closer and closer; a narrow lobe elsewhere falls between them. Where both
stand, each direction's share goes to the one that it is near, by the fourth power of the other's tilt.
"""

import numpy as np

from ..exporters.exporter import ColouredSurface

TURN = np.array([-1.0, -1.0, 1.0])  # half a turn about the normal


def shines_back(surface: ColouredSurface) -> bool:
    """Whether a law of a surface is one of retro-reflection, or has a generalised lobe that is tilted to the light."""
    return any(
        term.model.family == "retro-reflection" or np.any(np.asarray(surface.values_of(term).get("tilt", 0.0)) < 0)
        for term in surface.model.terms
    )


def share_of_mirror_side(i, r, mirror=1.0, back=1.0) -> np.ndarray:
    """How much of directions i (..., 3), seen from r, is counted about the mirror direction and not about the light;
    `mirror` and `back` are how far either quadrature reaches, 0..1."""
    tilt2 = np.sum((i + r)[..., :2] ** 2, axis=-1)
    turned2 = np.sum((i * TURN + r)[..., :2] ** 2, axis=-1)
    one, other = mirror * turned2**2, back * tilt2**2
    return one / np.maximum(one + other, 1e-30)
