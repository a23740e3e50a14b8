"""GGX facets (Trowbridge and Reitz 1975) with height-correlated Smith masking and Fresnel.

    f = F D / (4 cos θi cos θr (1 + Λi + Λr))
    D = ((1 + t)·alpha/(alpha² + t))²/π,   t = tan²δ, δ from normal to half vector
    Λ = (√(1 + alpha² tan²θ) - 1)/2

Tails longer than any Gaussian facet law: for most rough dielectrics and many metals the best of the cheap laws.
Loses some energy at large alpha, since light that meets two facets is not followed.

Source: Walter et al. 2007, "Microfacet models for refraction through rough surfaces"; Heitz 2014 for the masking.
"""

import numpy as np

from ..physics import fresnel, microfacet
from ..physics.geometry import Geometry
from ._microfacet import GGX, INDEX, gradient_of, reduced
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * microfacet.ggx_shape(geom, alpha)


def gradient(geom: Geometry, names, *, alpha, n, k, scale) -> dict[str, np.ndarray]:
    """df/dalpha from that of ln shape; df/dn, df/dk and df/dscale."""
    return gradient_of(geom, names, *microfacet.ggx_shape_and_slope(geom, alpha), n, k, scale)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "alpha",
            0.2,
            1e-4,
            1.5,
            log=True,
            meaning="facet slope: √2 times the rms slope of a Gaussian lobe of equal peak",
            starts=(0.01, 0.04, 0.1, 0.2, 0.4, 0.8),
        ),
        *INDEX,
    ),
    gradient=gradient,
    without=reduced(microfacet.ggx_shape, microfacet.ggx),
    summary="long tails, Fresnel, masking: the first choice for rough plastics, paints, many metals",
    pins=(
        Pin(
            at(45, 50),
            {"alpha": 0.12, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=0.62289668282776856,
            source="50 digits",
        ),
        Pin(
            at(75, 60),
            {"alpha": 0.5, "n": 0.958, "k": 6.69, "scale": 1.0},
            f=1.1593076298092438,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("on the peak of the narrowest lobe", at(30, 30), {"alpha": 1e-4}),
        Extreme("light from where it is seen", at(60, -60), {"alpha": 1.5}),
    ),
    source="Walter et al. 2007; Trowbridge and Reitz 1975; Heitz 2014",
    family="facets",
    cannot="shows no mirror image; where it is very rough (alpha near 1) up to 10 % of the light is missing",
    candidacy=Candidacy(90, bare=True, substitutes=True),
    formula=Formula(
        "{scale} * ggx(ci, cr, q, {alpha}, {n}, {k})",
        (GGX,),
    ),
)
