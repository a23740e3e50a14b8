"""What the microfacet laws share: a Fresnel factor, an amplitude that is physical by default, and their gradients.

Each such law is f = scale · F(cos θd; n, k) · shape(alpha), where shape = D G / (4 cos θi cos θr).
"""

from math import pi

import numpy as np

from .. import optics
from ..geometry import Geometry
from ._base import Parameter

INDEX = (
    Parameter("n", 1.5, 1.0001, 100.0, log=True, origin=1.0, given_low=0.01, per_channel=True, meaning="refractive index; of a metal with k = 0 an equivalent one", starts=(1.5, 4.0, 20.0)),
    Parameter("k", 0.0, 0.0, 100.0, per_channel=True, free=False, meaning="absorption index"),
    Parameter("scale", 1.0, 0.0, 1e6, linear=True, per_channel=True, free=False, meaning="1 for a calibrated measurement of a bare interface"),
)


def gradient_of(geom: Geometry, names, shape, by_alpha, n, k, scale) -> dict[str, np.ndarray]:
    """df/dscale, df/dalpha, and df/dn and df/dk as far as `names` asks for them, from d ln shape/dalpha."""
    f, *by_index = optics.fresnel_with_slopes(geom.cos_d, n, k) if "n" in names or "k" in names else (optics.fresnel(geom.cos_d, n, k),)
    lobe = f * shape
    slopes = {name: slope * (scale * shape) for name, slope in zip("nk", by_index)}
    return {"scale": lobe, "alpha": lobe * (scale * by_alpha), **slopes}


def with_fixed_fresnel(shape):
    """The law with F at its normal-incidence value: what a scene that never looks near grazing needs."""

    def brdf(geom: Geometry, *, alpha, n, k, scale):
        return scale * optics.f0(n, k) * shape(geom, alpha)

    return brdf


def beckmann(geom: Geometry, alpha) -> np.ndarray:
    """D of Gaussian slopes [1/sr], exp(-t/alpha²) ((1 + t)/alpha)²/π with t = tan²δ; its projection integrates to 1."""
    density = geom.sec2_h / alpha
    density *= density
    density *= np.exp(geom.tan2_h * (-1 / (alpha * alpha)))
    density *= 1 / pi
    return density
