"""Gaussian (Beckmann) facets with height-correlated Smith masking and Fresnel.

    f = F D / (4 cos θi cos θr (1 + Λi + Λr))
    D = exp(-t/alpha²) ((1 + t)/alpha)²/π,   t = tan²δ, δ from normal to half vector
    Λ = (exp(-x²)/(x √π) - erfc x)/2,   x = 1/(alpha tan θ)

The geometrical limit of He and Torrance, with alpha = 2 sigma/tau: right for Gaussian surfaces much rougher than the
wavelength. Loses some energy at large alpha, since light that meets two facets is not followed.

Source: Beckmann and Spizzichino 1963; Smith 1967; Walter et al. 2007; Heitz 2014 for the correlated masking.
"""

import numpy as np

from ..physics import fresnel, microfacet
from ..physics.geometry import Geometry
from ._microfacet import INDEX, gradient_of, reduced
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * microfacet.beckmann_shape(geom, alpha)


def gradient(geom: Geometry, names, *, alpha, n, k, scale) -> dict[str, np.ndarray]:
    """df/dalpha from that of ln shape; df/dn, df/dk and df/dscale."""
    return gradient_of(geom, names, *microfacet.beckmann_shape_and_slope(geom, alpha), n, k, scale)


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
            meaning="facet slope, √2 times the rms slope along a line",
            starts=(0.01, 0.04, 0.1, 0.2, 0.4, 0.8),
        ),
        *INDEX,
    ),
    gradient=gradient,
    without=reduced(microfacet.beckmann_shape, microfacet.beckmann),
    summary="Gaussian facets, Smith masking, Fresnel: surfaces of one roughness scale, rougher than the wavelength",
    pins=(
        Pin(
            at(45, 50),
            {"alpha": 0.4, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=0.071639201872482694,
            source="50 digits",
        ),
        Pin(
            at(75, 60),
            {"alpha": 0.5, "n": 0.958, "k": 6.69, "scale": 1.0},
            f=1.796900550860498,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("lobe underflows far from the mirror", at(10, -80), {"alpha": 1e-4}, f=0.0),
        Extreme("at the normal, where tan is 0", at(0, 0), {"alpha": 1.5}),
    ),
    source="Beckmann and Spizzichino 1963; Smith 1967; Walter et al. 2007; Heitz 2014",
    family="facets",
    cannot="shows no mirror image, and no faint glow far around the highlight",
    candidacy=Candidacy(80, bare=True, substitutes=True),
    formula=Formula(
        "{scale} * beckmann(ci, cr, q, {alpha}, {n}, {k})",
        (
            ("lambda_by_x", "x", "0.5 * (exp(-x * x) / (1.7724539 * x) - erfc0(x))"),
            ("lambda", "c, a", "lambda_by_x(c / (a * most(sqrt(sin2(c)), 1.0e-7)))"),
            (
                "beckmann",
                "ci, cr, q, a, n, k",
                "fresnel(cosd(ci, cr, q), n, k) * gaussian(ci, cr, q, a)"
                " / (4.0 * ci * cr * (1.0 + lambda(ci, a) + lambda(cr, a)))",
            ),
        ),
    ),
)
