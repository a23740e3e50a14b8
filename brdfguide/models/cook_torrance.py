"""Cook and Torrance: Gaussian facets in V-shaped grooves, with Fresnel.

    f = F D G / (4 cos θi cos θr)
    D = exp(-t/alpha²) ((1 + t)/alpha)²/π,   t = tan²δ, δ from normal to half vector
    G = min(1, 4 cos θi / (v_z (1 + t)), 4 cos θr / (v_z (1 + t))),   v_z = cos θi + cos θr

The 1/4 is that of a distribution D whose projection integrates to 1; as printed in 1982, with 1/π for D's own π, the
lobe is four times too bright. The groove factor has a crease where its minimum changes hands.

Source: Cook and Torrance 1982, "A reflectance model for computer graphics".
"""

import numpy as np

from ..formed import formed
from ..physics import fresnel, microfacet
from ..physics.geometry import Directions, Geometry
from ._microfacet import INDEX, gradient_of, reduced
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def masking(geom: Geometry | Directions) -> np.ndarray:
    """G of the V-grooves; 2 (n·h) cos θ / (i·h) without its cancellations."""
    return np.minimum(1.0, 4 * np.minimum(geom.cos_i, geom.cos_r) / (geom.v_z * geom.sec2_h))


def shape(geom: Geometry, alpha) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr]: the law without Fresnel."""
    return microfacet.beckmann(geom, alpha) * _over_cosines(geom)


@formed
def _over_cosines(to: Directions) -> np.ndarray:
    """G/(4 cos θi cos θr)."""
    return masking(to) / (4 * to.cos_cos)


def brdf(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * shape(geom, alpha)


def gradient(geom: Geometry, names, *, alpha, n, k, scale) -> dict[str, np.ndarray]:
    """d ln f/dalpha = (2/alpha)(t/alpha² - 1)."""
    by_alpha = (2 / alpha) * (geom.tan2_h / alpha**2 - 1)
    return gradient_of(geom, names, shape(geom, alpha), by_alpha, n, k, scale)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "alpha",
            0.2,
            1e-4,
            1.0,
            log=True,
            meaning="facet slope, √2 times the rms slope along a line",
            starts=(0.01, 0.04, 0.1, 0.2, 0.35, 0.6),
        ),
        *INDEX,
    ),
    gradient=gradient,
    without=reduced(shape, microfacet.beckmann),
    summary="Gaussian facets, Fresnel, off-specular peak: rough metals and plastics of one roughness scale",
    pins=(
        Pin(
            at(45, 50),
            {"alpha": 0.12, "n": 1.7, "k": 0.0, "scale": 0.8},
            f=0.70576410454031793,
            source="50 digits",
        ),
        Pin(
            at(80, 20),
            {"alpha": 0.5, "n": 0.958, "k": 6.69, "scale": 1.0},
            f=0.39141589017854746,
            source="50 digits",
        ),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("lobe underflows far from the mirror", at(10, -80), {"alpha": 1e-4}, f=0.0),
        Extreme("light from where it is seen", at(60, -60), {"alpha": 1.0}),
    ),
    source="Cook and Torrance 1982",
    family="facets",
    cannot="shows no mirror image; its shadows set in with a sharp bend",
    candidacy=Candidacy(70, bare=True, substitutes=True),
    formula=Formula(
        "{scale} * cook_torrance(ci, cr, q, {alpha}, {n}, {k})",
        (
            (
                "cook_torrance",
                "ci, cr, q, a, n, k",
                "fresnel(cosd(ci, cr, q), n, k) * gaussian(ci, cr, q, a)"
                " * least(1.0, 4.0 * least(ci, cr) * cos2h(ci, cr, q) / (ci + cr)) / (4.0 * ci * cr)",
            ),
        ),
    ),
)
