"""GGX facets that keep the energy: `ggx`, and a diffuse term of the light that meets more than one facet.

    f = F D/(4 cos θi cos θr (1 + Λi + Λr)) + M (1 - E(θi))(1 - E(θr))/(π (1 - Ē))
    M = F̄² Ē/(1 - F̄ (1 - Ē)),   F̄ = 2 ∫ F c dc,   Ē = 2 ∫ E c dc

E is the albedo of the lobe for F = 1; D and Λ as in `ggx`. The light that a second facet gets has lost F̄ once more, so
rough metals are more saturated than their F0. With F = 1 all light comes back at every angle, where `ggx` loses 69 % at
the normal for alpha 1. Reciprocal. Below alpha 0.01 there is nothing to add: take `ggx`.

Source: Kulla and Conty 2017, "Revisiting physically based shading at Imageworks"; M with its second F̄ by Hill 2018.
"""

from math import pi

import numpy as np

from ..numerics import chebyshev
from ..physics import facet_albedo, fresnel, microfacet
from ..physics.geometry import Geometry
from ._microfacet import GGX, INDEX
from .facts import Formula, coefficients, polynomial
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    once = fresnel.fresnel(geom.cos_d, n, k) * microfacet.ggx_shape(geom, alpha)
    return scale * (once + _colour(fresnel.mean_fresnel(n, k), facet_albedo.mean_lost(alpha)) * _between(geom, alpha))


def _between(geom: Geometry, alpha):
    """(1 - Ei)(1 - Er)/(π (1 - Ē)): what is sent after a second facet, were none of it absorbed."""
    both = facet_albedo.lost(geom.cos_i, alpha) * facet_albedo.lost(geom.cos_r, alpha)
    return both / (pi * facet_albedo.mean_lost(alpha))


def _colour(mean, lost):
    """M, by the mean reflectance and 1 - Ē."""
    return mean * mean * (1 - lost) / (1 - mean * lost)


def gradient(geom: Geometry, names, *, alpha, n, k, scale) -> dict[str, np.ndarray]:
    """dM = M (2/F̄ + (1 - Ē)/(1 - F̄ (1 - Ē))) dF̄ + F̄² (F̄ - 1)/(1 - F̄ (1 - Ē))² d(1 - Ē), and the products' rule."""
    shape, by_alpha = microfacet.ggx_shape_and_slope(geom, alpha)
    loss, loss_by_alpha = facet_albedo.mean_lost_and_slope(alpha)
    (loss_i, by_i), (loss_r, by_r) = (facet_albedo.lost_and_slope(cos, alpha) for cos in (geom.cos_i, geom.cos_r))
    f, *by_index = (
        fresnel.fresnel_with_slopes(geom.cos_d, n, k)
        if "n" in names or "k" in names
        else (fresnel.fresnel(geom.cos_d, n, k),)
    )
    mean, *mean_by_index = fresnel.mean_fresnel_with_slopes(n, k)
    colour, rest = _colour(mean, loss), 1 - mean * loss
    between = loss_i * loss_r / (pi * loss)
    between_by_alpha = (by_i * loss_r + loss_i * by_r) / (pi * loss) - between * (loss_by_alpha / loss)
    colour_by_alpha = mean * mean * (mean - 1) / (rest * rest) * loss_by_alpha
    colour_by_mean = mean * (1 - loss) * (2 - mean * loss) / (rest * rest)
    slopes = {
        name: scale * (by * shape + colour_by_mean * mean_by * between)
        for name, by, mean_by in zip("nk", by_index, mean_by_index, strict=False)
    }
    return {
        "scale": f * shape + colour * between,
        "alpha": scale * (f * shape * by_alpha + colour_by_alpha * between + colour * between_by_alpha),
        **slopes,
    }


def single(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """`ggx`: enough where the surface is smooth, and for dielectrics."""
    return scale * fresnel.fresnel(geom.cos_d, n, k) * microfacet.ggx_shape(geom, alpha)


def with_fixed_fresnel(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """F at its normal-incidence value, also between facets."""
    f0 = fresnel.f0(n, k)
    between = _colour(f0, facet_albedo.mean_lost(alpha)) * _between(geom, alpha)
    return scale * (f0 * microfacet.ggx_shape(geom, alpha) + between)


def single_with_fixed_fresnel(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """`ggx` with F at its normal-incidence value."""
    return scale * fresnel.f0(n, k) * microfacet.ggx_shape(geom, alpha)


DEGREE = facet_albedo.ORDERS[1] - 1


def _numbers(*, alpha, n, k, **_) -> dict[str, float]:
    """What a shader needs besides: 1/asinh(1/alpha), (1 - E)/y as a polynomial in 2y - 1, and M/(π (1 - Ē))."""
    series = chebyshev.powers(lambda x: facet_albedo.lost_by_share(x, alpha), DEGREE)
    lost = facet_albedo.mean_lost(alpha)
    again = _colour(fresnel.mean_fresnel(n, k), lost) / (pi * lost)
    return {"again": again, "per_asinh": 1 / np.arcsinh(1 / alpha)} | {f"c{i}": each for i, each in enumerate(series)}


def _lost_of(cos: str) -> str:
    """1 - E as a shader calls it."""
    share = f"facets_share({cos} / {{alpha}}, {{per_asinh}})"
    return f"{share} * polynomial{DEGREE}(2.0 * {share} - 1.0, {coefficients(DEGREE)})"


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "alpha",
            0.4,
            facet_albedo.NARROWEST,
            facet_albedo.WIDEST,
            log=True,
            meaning="facet slope: √2 times the rms slope of a Gaussian lobe of equal peak",
            starts=(0.05, 0.1, 0.2, 0.4, 0.8, 1.2),
        ),
        *INDEX,
    ),
    gradient=gradient,
    without={
        "fresnel": with_fixed_fresnel,
        "multiple": single,
        "fresnel+multiple": single_with_fixed_fresnel,
    },
    summary="ggx with the light that several facets reflect: blasted and rough metals, whose lobe keeps all energy",
    pins=(
        Pin(
            at(45, 50),
            {"alpha": 0.62, "n": 0.2, "k": 3.3, "scale": 0.8},
            f=0.368475295675579489,
            source="its integrals by Gauss's rule to ten digits; the series of E holds 1e-5",
            rtol=3e-5,
        ),
        Pin(
            at(75, -60),
            {"alpha": 1.1, "n": 0.958, "k": 6.69, "scale": 1.0},
            f=0.296394235522629912,
            source="its integrals by Gauss's rule to ten digits; the series of E holds 1e-5",
            rtol=3e-5,
        ),
    ),
    extremes=(
        Extreme("widest, 0.01° from grazing", at(89.99, 89.99), {"alpha": 1.5, "k": 100.0}),
        Extreme("narrowest, far from the mirror", at(10, -80), {"alpha": 0.01, "n": 1.0001}),
    ),
    source="Kulla and Conty 2017; Hill 2018",
    family="facets",
    cannot="shows no mirror image; light that meets several facets is taken to leave alike in all directions",
    beyond_facets=lambda *, alpha, **_: (
        "light between facets has no counterpart" if np.any(np.greater(alpha, 0.2)) else ""
    ),
    formula=Formula(
        f"{{scale}} * (ggx(ci, cr, q, {{alpha}}, {{n}}, {{k}}) + {{again}} * {_lost_of('ci')} * {_lost_of('cr')})",
        (
            GGX,
            polynomial(DEGREE),
            ("facets_share", "x, per_asinh", "sqrt(per_asinh * ln1m(-x - x * x / (1.0 + sqrt(x * x + 1.0))))"),
        ),
        numbers=_numbers,
    ),
)
