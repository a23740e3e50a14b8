"""ln f with its derivatives by ln of a surface's parameters, as far as a derivative tells anything."""

import numpy as np

from ..data.measurement import SMALLEST
from ..models.surface import Surface
from ..physics.aperture import Instrument
from .layout import Layout, to_coordinate
from .reading import with_slopes

STEEPEST_LN = 50.0  # ∂ ln f/∂u beyond which a derivative counts no more


def ln_with_slopes(layout: Layout, surface: Surface, instrument: Instrument) -> tuple[np.ndarray, np.ndarray]:
    """ln of what the instrument reads, (samples, channels), and its derivatives, (samples, channels, parameters), by
    the coordinate of those that are walked in logarithms, by ln of the others."""
    f, slopes = with_slopes(layout, surface, instrument)
    f = np.maximum(f, SMALLEST)
    out = np.zeros((*f.shape, len(layout.shared) + len(layout.per_channel)))
    for place, key in enumerate((*layout.shared, *layout.per_channel)):
        size = 1.0 if layout.parameters[key].log else _size(layout, surface, key)
        out[:, :, place] = slopes[key] * size / f
    return np.log(f), np.clip(out, -STEEPEST_LN, STEEPEST_LN)


def _size(layout: Layout, surface: Surface, key: str) -> np.ndarray:
    """Of a parameter whose coordinate is its value: that, in each channel its own, so that its derivative is by ln."""
    return np.maximum(np.abs(to_coordinate(layout.parameters[key], np.asarray(surface.values[key]))), 1e-3)
