"""What shadows do to He and Torrance's lobe, and the lobe without what a scene may not need."""

from math import pi, sqrt

import numpy as np

from .. import optics
from ..geometry import Geometry
from ..special import erfcx, lambert_w
from ._series_cells import ln_series


def shadowing(cos, sin, slope):
    """S/cos θ, finite at grazing, and K = tan θ erfc(ν). Beyond ν = 26 they are 1/cos θ and 0 to every digit."""
    steep = np.maximum(2 * slope * sin, cos / 26)
    nu = cos / steep
    bell = np.exp(-nu * nu)
    erfc = bell * erfcx(nu)
    visible = sqrt(pi) * (2 - erfc)
    return visible / (steep * (nu * visible + bell)), sin / cos * erfc


def shadow_free(spread):
    """Effective over true roughness: what the shadows leave, from K at both angles."""
    return 1 / np.sqrt(1 + lambert_w(spread * spread / (8 * pi)))


def reduced(*out: str):
    """The law without some of

    fresnel    F at normal incidence instead of F(θd)
    masking    no shadows, neither on the light nor on the effective roughness
    series     Σ g^m e^-g/(m! m) e^(-y/m) = e^-x/g (1 + (x² - 4x + 2)/2g), x = y/g: ours, to second order in 1/g
    waves      the same to first order, e^-x/g, which is Beckmann's lobe with alpha = 2 slope
    """

    def brdf(geom: Geometry, *, sigma, slope, n, k, scale) -> np.ndarray:
        shadow, rough = 1 / (geom.cos_i * geom.cos_r), 1.0
        if "masking" not in out:
            shadow_i, spread_i = shadowing(geom.cos_i, geom.sin_i, slope)
            shadow_r, spread_r = shadowing(geom.cos_r, geom.sin_r, slope)
            shadow, rough = shadow_i * shadow_r, shadow_free(spread_i + spread_r)
        f = optics.f0(n, k) if "fresnel" in out else optics.fresnel(geom.cos_d, n, k)
        g = (2 * pi * sigma / geom.wavelength * geom.v_z * rough) ** 2
        y = (pi * sigma / slope / geom.wavelength) ** 2 * geom.vxy2
        if "series" in out or "waves" in out:
            x = y / g
            series = np.exp(-x) / g if "waves" in out else np.exp(-x) * (1 + (x * x - 4 * x + 2) / (2 * g)) / g
        else:
            series = np.exp(ln_series(g, y))
        return (pi / 4) * scale * (sigma / slope / geom.wavelength) ** 2 * f * shadow * (geom.v2 / geom.v_z) ** 2 * series

    return brdf
