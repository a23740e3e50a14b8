"""What a detector of finite size sees: directions spread over its cone, and the mirror beam that falls into it.

The mean over the cone is taken by the seven-point rule of degree five on a disc (Abramowitz and Stegun 25.4.61):
the centre with weight 1/4 and six points at √(2/3) of the radius with 1/8 each. It resolves a lobe down to
about the width of the cone; what is narrower is a mirror to this instrument.
"""

from dataclasses import replace
from functools import cached_property
from math import cos, pi, sin, sqrt

import numpy as np

from ..errors import InputError
from ..records import dataclass
from .geometry import Directions, Geometry

RING = sqrt(2 / 3)


def solid_angle_of(half_angle_deg: float) -> float:
    """Ω = 4π sin²(a/2) of a cone of half angle a [deg]. Raises InputError outside 0..30."""
    if not 0 < half_angle_deg <= 30:
        raise InputError(f"an aperture of {half_angle_deg:g} degrees: wanted a half angle in 0..30")
    return 4 * pi * sin(np.radians(half_angle_deg) / 2) ** 2


@dataclass(frozen=True, eq=False)
class Instrument:
    """Where light and detector stand, and the solid angle Ω [sr] that the detector takes in; None: a point.

    Raises InputError for an Ω outside 0..2π.
    """

    geom: Geometry
    solid_angle: float | None = None

    def __post_init__(self):
        if self.solid_angle is not None and not 0 < self.solid_angle <= 2 * pi:
            raise InputError(f"a detector's solid angle of {self.solid_angle:g} sr is not in 0..2π")

    @cached_property
    def views(self) -> list[tuple[float, Geometry]]:
        """Weights that add up to 1, and the directions that they belong to; of a point its own."""
        return [(1.0, self.geom)] if self.solid_angle is None else _views(self.geom, self.solid_angle)

    @cached_property
    def beam(self) -> np.ndarray:
        """What a mirror of reflectance 1 reads [1/sr]: 1/(cos θi Ω) inside the cone, 0 outside, and 0 at a point.

        A cone of solid angle Ω is a cap of squared chord Ω/π about the detector's direction.
        """
        if self.solid_angle is None:
            return np.zeros(self.geom.shape)
        inside = self.geom.lit & (self.geom.mirror_distance2 <= self.solid_angle / pi)
        return np.where(inside, 1 / (self.geom.where_lit().cos_i * self.solid_angle), 0.0)


def _views(geom: Geometry, solid_angle: float) -> list[tuple[float, Geometry]]:
    """Formed from the light's azimuth on, which is put back at the end."""
    radius = RING * 2 * np.arcsin(sqrt(solid_angle / (4 * pi)))
    azimuth = np.radians(geom.phi_deg)
    light = np.stack(np.broadcast_arrays(geom.sin_i, 0.0 * geom.sin_i, geom.cos_i), axis=-1)
    towards = np.stack([geom.sin_r * np.cos(azimuth), geom.sin_r * np.sin(azimuth), geom.cos_r], axis=-1)
    down = np.stack([geom.cos_r * np.cos(azimuth), geom.cos_r * np.sin(azimuth), -geom.sin_r], axis=-1)
    across = np.stack([-np.sin(azimuth), np.cos(azimuth), 0.0 * azimuth], axis=-1)
    ring = [(cos(turn), sin(turn)) for turn in (place * pi / 3 for place in range(6))]
    shifted = (towards * np.cos(radius) + (x * down + y * across) * np.sin(radius) for x, y in ring)
    turned = (replace(Directions.from_vectors(light, each), phi_i_deg=geom.phi_i_deg) for each in shifted)
    return [(0.25, geom)] + [(0.125, Geometry(each, geom.wavelength)) for each in turned]
