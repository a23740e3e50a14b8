"""What Ward's laws share: their amplitude and, of those with a grain, slopes and cases."""

from collections.abc import Callable
from math import pi

import numpy as np

from ..physics.geometry import Geometry
from ._grain import ln_gaussian_slopes, widths_of
from .model import Extreme, Parameter, at

RHO_S = Parameter(
    "rho_s", 0.10, 0.0, 1.0, linear=True, per_channel=True, meaning="share of the light sent into the lobe"
)
GRAINED_EXTREMES = (
    Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha_x": 1e-4, "alpha_y": 1e-4}),
    Extreme("longest streak, across it", at(60, -60), {"alpha_x": 1e-4, "alpha_y": 1.5, "axis": 0.5 * pi}),
)


def grained_gradient(brdf: Callable[..., np.ndarray]) -> Callable:
    """The gradient of a law that has its widths in the Gaussian of slopes alone."""

    def gradient(geom: Geometry, names, *, rho_s, alpha_x, alpha_y, axis) -> dict[str, np.ndarray]:
        lobe = brdf(geom, rho_s=1.0, alpha_x=alpha_x, alpha_y=alpha_y, axis=axis)
        slopes = ln_gaussian_slopes(geom, alpha_x, alpha_y, axis)
        return {"rho_s": lobe, **{name: rho_s * lobe * slope for name, slope in slopes.items()}}

    return gradient


def grained_from_facets(facets) -> dict:
    """Start values of a described surface."""
    return {"rho_s": facets.f0, **widths_of(facets)}
