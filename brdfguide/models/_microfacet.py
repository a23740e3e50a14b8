"""What the microfacet laws share: a Fresnel factor, an amplitude that is physical by default, and their gradients.

Each such law is f = scale · F(cos θd; n, k) · shape(alpha), where shape = D G / (4 cos θi cos θr).
"""

import numpy as np

from ..physics import fresnel
from ..physics.geometry import Geometry
from .model import Parameter

INDEX = (
    Parameter(
        "n",
        1.5,
        1.0001,
        100.0,
        log=True,
        origin=1.0,
        given_low=0.01,
        per_channel=True,
        meaning="refractive index; of a metal with k = 0 an equivalent one",
        starts=(1.5, 4.0, 20.0),
    ),
    Parameter("k", 0.0, 0.0, 100.0, per_channel=True, free=False, meaning="absorption index"),
    Parameter(
        "scale",
        1.0,
        0.0,
        1e6,
        linear=True,
        per_channel=True,
        free=False,
        meaning="1 for a calibrated measurement of a bare interface",
    ),
)

# the lobe as shaders have it
GGX = (
    "ggx",
    "ci, cr, q, a, n, k",
    "fresnel(cosd(ci, cr, q), n, k) * a * a / (2.0 * PI * sq(cos2h(ci, cr, q) * a * a + sin2h(ci, cr, q)))"
    " / (cr * sqrt(a * a + (1.0 - a * a) * ci * ci) + ci * sqrt(a * a + (1.0 - a * a) * cr * cr))",
)


def gradient_of(geom: Geometry, names, shape, by_alpha, n, k, scale) -> dict[str, np.ndarray]:
    """df/dscale, df/dalpha, and df/dn and df/dk as far as `names` asks for them, from d ln shape/dalpha."""
    return gradient_by(geom, names, shape, {"alpha": by_alpha}, n, k, scale)


def gradient_by(geom: Geometry, names, shape, by: dict, n, k, scale) -> dict[str, np.ndarray]:
    """The same for a shape of several parameters, from d ln shape by each."""
    f, *by_index = (
        fresnel.fresnel_with_slopes(geom.cos_d, n, k)
        if "n" in names or "k" in names
        else (fresnel.fresnel(geom.cos_d, n, k),)
    )
    lobe = f * shape
    slopes = {name: slope * (scale * shape) for name, slope in zip("nk", by_index, strict=False)}
    return {"scale": lobe, **{name: lobe * (scale * slope) for name, slope in by.items()}, **slopes}


def reduced(shape, density) -> dict:
    """The law without what a scene may not need: Fresnel's change with angle, masking, both.

    Takes  shape and D as functions of directions and of the parameters that shape the facets, by name.
    """

    def bare(geom: Geometry, **widths):
        return density(geom, **widths) / (4 * geom.cos_cos)

    def unmasked(geom: Geometry, *, n, k, scale, **widths):
        return scale * fresnel.fresnel(geom.cos_d, n, k) * bare(geom, **widths)

    return {"fresnel": _at_normal(shape), "masking": unmasked, "fresnel+masking": _at_normal(bare)}


def _at_normal(shape):
    """The law with F at its normal-incidence value."""

    def brdf(geom: Geometry, *, n, k, scale, **widths):
        return scale * fresnel.f0(n, k) * shape(geom, **widths)

    return brdf
