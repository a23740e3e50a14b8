"""What a target's file will show, and S between it and the surface (`physics.seen`): the finite parts, and a mirror as
the image of a lamp.
"""

from collections.abc import Callable

import numpy as np

from ..models.looks import LAMP_SR
from ..physics import seen
from ..physics.aperture import Instrument
from ..physics.geometry import Geometry
from .exporter import ColouredSurface

Shown = Callable[[Geometry], np.ndarray]  # -> (samples, 3) [1/sr], NaN where the file has no value


def whole(surface: ColouredSurface, geom: Geometry) -> np.ndarray:
    """The surface in linear sRGB with the lamp's image."""
    finite = surface.rgb(geom)
    return finite + _image(surface, geom) if surface.model.has_mirror else finite


def beside_mirror(surface: ColouredSurface, finite: Shown, mirror: Shown | None = None) -> Shown:
    """A file's finite part with a mirror's image: of its own reflectance, or of the surface's where it writes that."""
    if mirror is not None:
        return lambda geom: finite(geom) + mirror(geom) * Instrument(geom, LAMP_SR).beam
    if not surface.has_mirror:
        return finite
    return lambda geom: finite(geom) + _image(surface, geom)


def _image(surface: ColouredSurface, geom: Geometry) -> np.ndarray:
    return surface.mirror_rgb(geom) * Instrument(geom, LAMP_SR).beam


def seen_of(surface: ColouredSurface, shown: Shown) -> float:
    """S [L*] between a surface and what a file shows of it."""
    sphere = seen.sphere()
    wanted, found = (seen.lightness(f, sphere.geom.cos_i) for f in (whole(surface, sphere.geom), shown(sphere.geom)))
    return seen.apart(wanted, found, sphere.weights)


def off_the_measurement(shown: Shown | None, to_srgb: np.ndarray, geom: Geometry, measured) -> float | None:
    """rms of ln(what is shown / measurement) in linear sRGB, where both are above 0; None for a mirror alone.

    Takes  measured (samples, channels) [1/sr] at `geom`, of one column; to_srgb (3, channels).
    """
    if shown is None:
        return None
    wanted, found = measured @ to_srgb.T, shown(geom)
    counted = np.isfinite(wanted) & (wanted > 0) & geom.lit & (found > 0)
    return float(np.sqrt(np.mean(np.log(found[counted] / wanted[counted]) ** 2))) if counted.any() else None
