"""The mirror reflection of a smooth or slightly rough interface.

    rho = F(θi) exp(-(4π (sigma/λ) cos θi)²),   in the mirror direction alone

A spike, not a lobe: its BRDF is infinite in one direction and 0 elsewhere, so `brdf` is 0 and `mirror` gives the
reflectance. An instrument that collects over a solid angle Ω reads rho/(cos θi Ω) there; `predict` says so.
Roughness dims it most near the normal, so it emerges toward grazing (Westin et al. 2004, section 3.2.2, Eq. 1).

Source: Fresnel; Davies 1954, "The reflection of electromagnetic waves from a rough surface".
"""

import numpy as np

from ..physics import fresnel
from ..physics.geometry import Geometry
from .facts import Formula
from .model import Extreme, Model, Parameter, at


def brdf(geom: Geometry, *, n, k, sigma) -> np.ndarray:
    """The finite part: none."""
    return np.zeros(
        np.broadcast_shapes(geom.shape, np.shape(geom.wavelength), np.shape(n), np.shape(k), np.shape(sigma))
    )


def mirror(geom: Geometry, *, n, k, sigma) -> np.ndarray:
    """Reflectance of the spike at theta_i, dimensionless."""
    return fresnel.davies(fresnel.fresnel(geom.cos_i, n, k), geom.cos_i, sigma, geom.wavelength)


MODEL = Model(
    __name__,
    brdf,
    roles=("mirror",),
    mirror=mirror,
    parameters=(
        Parameter(
            "n",
            1.5,
            1.0001,
            100.0,
            log=True,
            origin=1.0,
            given_low=0.01,
            per_channel=True,
            meaning="refractive index",
            starts=(1.5,),
        ),
        Parameter("k", 0.0, 0.0, 100.0, per_channel=True, free=False, meaning="absorption index"),
        Parameter("sigma", 0.0, 0.0, 1.0, unit="um", meaning="rms height of the roughness", starts=(0.02, 0.1)),
    ),
    summary="the image-forming spike alone: polished metal, glass, a smooth coat over a body term",
    extremes=(Extreme("no roughness, 0.01° from grazing", at(89.99, 89.99), {"sigma": 0.0}, f=0.0),),
    source="Fresnel; Davies 1954; Westin et al. 2004, Eq. 1",
    family="mirror",
    cannot="no blur: a small lamp shows as a point, and what a slightly rough surface scatters is missing",
    formula=Formula(
        "",
        (
            (
                "mirror",
                "ci, n, k, sigma_by_wavelength",
                "fresnel(ci, n, k) * exp(-sq(4.0 * PI * sigma_by_wavelength * ci))",
            ),
        ),
        mirror="mirror(ci, {n}, {k}, {waves})",
        numbers=lambda *, sigma, wavelength, **_: {"waves": sigma / wavelength},
    ),
)
