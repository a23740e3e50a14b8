"""What an instrument would read of a surface: its BRDF, plus the mirror spike spread over the detector."""

from math import pi

import numpy as np

from .errors import InputError
from .geometry import Geometry
from .models import Sum


def reading(surface: Sum, geom: Geometry, values, solid_angle: float | None = None) -> np.ndarray:
    """BRDF [1/sr] as a detector of finite size reports it.

    f = brdf + rho/(cos θi Ω) where the mirror direction falls into the detector's cone Ω

    Takes  the values of `surface` and Ω [sr], which only a surface with a mirror term needs.
    Gives  f (...) in the shape of `geom` and the values; 0 below the horizon.
    Raises InputError for a mirror term without a solid angle, or with one outside 0..2π.
    """
    finite = surface(geom, values)
    if not surface.has_mirror:
        return finite
    return finite + surface.mirror(geom.where_lit(), values) * spike(geom, solid_angle)


def spike(geom: Geometry, solid_angle: float | None) -> np.ndarray:
    """What a mirror of reflectance 1 reads [1/sr]: 1/(cos θi Ω) inside the cone, 0 outside.

    A cone of solid angle Ω is a cap of squared chord Ω/π about the detector's direction.
    """
    if solid_angle is None:
        raise InputError("a mirror reads rho/(cos θi Ω): give the solid angle Ω of the detector [sr]")
    if not 0 < solid_angle <= 2 * pi:
        raise InputError(f"a detector's solid angle of {solid_angle:g} sr is not in 0..2π")
    seen = geom.lit & (geom.mirror_distance2 <= solid_angle / pi)
    return np.where(seen, 1 / (geom.where_lit().cos_i * solid_angle), 0.0)
