"""What laws with a grain share: the azimuth across it, widths along and across, Gaussian slopes, and how a fit walks.

x is along `axis`, across the grain, where slopes are steepest: a highlight on a flat sample is a streak along it. Both
widths may be given in either order; the wider one's azimuth is where the streak lies.
"""

from math import pi

import numpy as np

from ..physics import grain
from ..physics.geometry import Geometry
from .facts import Grain
from .model import Derived, Parameter

AXIS = Parameter(
    "axis",
    0.0,
    0.0,
    pi,
    unit="rad",
    free=False,
    period=pi,
    meaning="azimuth across the grain, where the streak lies",
    starts=(0.0, 0.25 * pi, 0.5 * pi, 0.75 * pi),
)
RATIO = Parameter(
    "ratio",
    1.0,
    1.0,
    100.0,
    log=True,
    free=False,
    meaning="length along the grain over that across it; 1: no grain",
    starts=(1.0, 3.0, 10.0),
)
SLOPE_ACROSS = Parameter(
    "slope",
    0.1,
    1e-3,
    1.0,
    log=True,
    meaning="sigma/τx across the grain; half of Beckmann's alpha",
    starts=(0.02, 0.05, 0.1, 0.2),
)
LENGTH_ACROSS = Derived("tau", lambda sigma, slope, **_: sigma / slope, "um", "correlation length across the grain")
TURNS = {"rotation": "it has a grain, unless both widths are alike"}


def _width(name: str, meaning: str) -> Parameter:
    return Parameter(name, 0.2, 1e-4, 1.5, log=True, meaning=meaning, starts=(0.02, 0.06, 0.15, 0.35, 0.8))


WIDTHS = (
    _width("alpha_x", "facet slope along `axis`, across the grain"),
    _width("alpha_y", "facet slope along the grain"),
    AXIS,
)
MEAN_AND_RATIO = (
    Derived(
        "alpha",
        lambda *, alpha_x, alpha_y, **_: np.sqrt(alpha_x * alpha_y),
        meaning="width of the facets without a grain that are as high",
    ),
    Derived("ratio", lambda *, alpha_x, alpha_y, **_: alpha_x / alpha_y, meaning="of the slopes across and along"),
)
BY_WIDTHS = Grain(
    "alpha_x",
    "alpha_y",
    widths=lambda alpha_x, alpha_y: (alpha_x, alpha_y),
    values=lambda wide, narrow: (wide, narrow),
    by_ln_widths=lambda alpha_x, alpha_y: ((alpha_x, 0.0), (0.0, alpha_y)),
)
BY_RATIO = Grain(
    "slope",
    "ratio",
    widths=lambda slope, ratio: (2 * slope, 2 * slope / ratio),
    values=lambda wide, narrow: (0.5 * wide, wide / narrow),
    by_ln_widths=lambda slope, ratio: ((slope, 0.0), (ratio, -ratio)),
)


def widths_of(facets) -> dict:
    """Both widths of a described surface alike; whoever knows of a grain draws them apart."""
    return {"alpha_x": facets.alpha, "alpha_y": facets.alpha}


def without_grain(brdf) -> dict:
    """The law without its grain, facets as high and as wide as both together: alpha = √(alpha_x alpha_y)."""

    def isotropic(geom: Geometry, *, alpha_x, alpha_y, axis, **values):
        alpha = np.sqrt(alpha_x * alpha_y)
        return brdf(geom, alpha_x=alpha, alpha_y=alpha, axis=axis, **values)

    return {"anisotropy": isotropic}


def slope_density(geom: Geometry, alpha_x, alpha_y, axis) -> np.ndarray:
    """exp(-e)/(pi alpha_x alpha_y), e = (s_x/alpha_x)² + (s_y/alpha_y)²: Gaussian slopes, density over slopes."""
    e = grain.tilt(geom, geom.offset_from(axis), alpha_x, alpha_y)
    return np.exp(-e) / (pi * alpha_x * alpha_y)


def ln_gaussian_slopes(geom: Geometry, alpha_x, alpha_y, axis) -> dict[str, np.ndarray]:
    """d ln of `slope_density` by each: (2 (s_x/alpha_x)² - 1)/alpha_x, the same by alpha_y; turning the axis carries x
    to y, ds_x = s_y, ds_y = -s_x."""
    v = geom.offset_from(axis)
    s_x, s_y = v[0] / geom.v_z, v[1] / geom.v_z
    return {
        "alpha_x": (2 * (s_x / alpha_x) ** 2 - 1) / alpha_x,
        "alpha_y": (2 * (s_y / alpha_y) ** 2 - 1) / alpha_y,
        "axis": 2 * s_x * s_y * (alpha_x - alpha_y) * (alpha_x + alpha_y) / (alpha_x * alpha_y) ** 2,
    }
