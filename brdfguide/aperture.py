"""What a detector of finite size sees: directions spread over its cone, and the mirror beam that falls into it.

The mean over the cone is taken by the seven-point rule of degree five on a disc (Abramowitz and Stegun 25.4.61):
the centre with weight 1/4 and six points at √(2/3) of the radius with 1/8 each. It resolves a lobe down to
about the width of the cone; what is narrower is a mirror to this instrument.
"""

from math import cos, pi, sin, sqrt

import numpy as np

from .errors import InputError
from .geometry import Geometry

RING = sqrt(2 / 3)


def solid_angle_of(half_angle_deg: float) -> float:
    """Ω = 4π sin²(a/2) of a cone of half angle a [deg]. Raises InputError outside 0..30."""
    if not 0 < half_angle_deg <= 30:
        raise InputError(f"an aperture of {half_angle_deg:g} degrees: wanted a half angle in 0..30")
    return 4 * pi * sin(np.radians(half_angle_deg) / 2) ** 2


def views(geom: Geometry, solid_angle: float | None) -> list[tuple[float, Geometry]]:
    """Weights that add up to 1, and the directions that they belong to; the directions themselves without a solid angle."""
    if solid_angle is None:
        return [(1.0, geom)]
    radius = RING * 2 * np.arcsin(sqrt(solid_angle / (4 * pi)))
    azimuth = np.radians(geom.phi_deg)
    light = np.stack(np.broadcast_arrays(geom.sin_i, 0.0 * geom.sin_i, geom.cos_i), axis=-1)
    towards = np.stack([geom.sin_r * np.cos(azimuth), geom.sin_r * np.sin(azimuth), geom.cos_r], axis=-1)
    down = np.stack([geom.cos_r * np.cos(azimuth), geom.cos_r * np.sin(azimuth), -geom.sin_r], axis=-1)
    across = np.stack([-np.sin(azimuth), np.cos(azimuth), 0.0 * azimuth], axis=-1)
    ring = [(cos(turn), sin(turn)) for turn in (place * pi / 3 for place in range(6))]
    shifted = [towards * np.cos(radius) + (x * down + y * across) * np.sin(radius) for x, y in ring]
    return [(0.25, geom)] + [(0.125, Geometry.from_vectors(light, each, geom.wavelength)) for each in shifted]
