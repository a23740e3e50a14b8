"""Gaussian (Beckmann) facets with height-correlated Smith masking and Fresnel.

    f = F D / (4 cos θi cos θr (1 + Λi + Λr))
    D = exp(-t/alpha²) ((1 + t)/alpha)²/π,   t = tan²δ, δ from normal to half vector
    Λ = (exp(-x²)/(x √π) - erfc x)/2,   x = 1/(alpha tan θ)

The geometrical limit of He and Torrance, with alpha = 2 sigma/tau: right for Gaussian surfaces much rougher than the
wavelength. Loses some energy at large alpha, since light that meets two facets is not followed.

Source: Beckmann and Spizzichino 1963; Smith 1967; Walter et al. 2007; Heitz 2014 for the correlated masking.
"""

from math import pi, sqrt

import numpy as np

from .. import optics
from ..geometry import Geometry, in_plane
from ._base import Extreme, Model, Parameter, Pin
from ._microfacet import INDEX, beckmann, fresnel_terms, with_fixed_fresnel

distribution = beckmann

# highest power first; minimax on 0..6 at 60 digits, see benchmarks/ramp.py
RAMP = (
    (0.0002487919682642739, 0.003910084650235634, 0.028669032095694883, 0.12525097742630545, 0.3497922645315357,
     0.598660455184536, 0.5641895835477563),
    (0.0008818615151230813, 0.013863456803926076, 0.10291292825386456, 0.4651829867298067, 1.3882793066370531,
     2.7832145447635432, 3.64233058787821, 2.833551880082195, 1.0),
)  # fmt: skip


def shape(geom: Geometry, alpha) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr]: the law without Fresnel."""
    return beckmann(geom, alpha) / (4 * _masking(geom, alpha))


def _masking(geom: Geometry, alpha):
    """cos θi cos θr (1 + Λi + Λr), in which nothing is divided by a cosine."""
    hidden_i, hidden_r = _hidden(geom.cos_i, geom.sin_i, alpha), _hidden(geom.cos_r, geom.sin_r, alpha)
    hidden_i *= geom.cos_r
    hidden_r *= geom.cos_i
    hidden_i += hidden_r
    hidden_i += geom.cos_cos
    return hidden_i


def _hidden(cos, sin, alpha):
    """cos θ Λ = ½ alpha sin θ exp(-x²) (1/√π - x erfcx x)."""
    x = _x(cos, sin, alpha)
    hidden = _ramp(x)
    hidden *= np.exp(-(x * x))
    hidden *= (0.5 * alpha) * sin
    return hidden


def _x(cos, sin, alpha):
    """1/(alpha tan θ); beyond 32, where exp(-x²) is 0, it stays 32 so that the normal has a value."""
    return cos / np.maximum(alpha * sin, cos / 32)


def _ramp(x):
    """1/√π - x erfcx(x), all of whose coefficients are positive: a rational fit of ours.

    Right to 3e-18 of x + cos θ Λ for x <= 6; beyond, exp(-x²) leaves nothing of it beside x.
    """
    above = RAMP[0][0] * x + RAMP[0][1]
    for coefficient in RAMP[0][2:]:
        above *= x
        above += coefficient
    below = RAMP[1][0] * x + RAMP[1][1]
    for coefficient in RAMP[1][2:]:
        below *= x
        below += coefficient
    above /= below
    return above


def brdf(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * optics.fresnel(geom.cos_d, n, k) * shape(geom, alpha)


def gradient(geom: Geometry, names, *, alpha, n, k, scale) -> dict[str, np.ndarray]:
    """d ln f/dalpha = (2/alpha)(t/alpha² - 1) - d ln(1 + Λi + Λr)/dalpha, with cos θ dΛ/dalpha = sin θ exp(-x²)/(2√π)."""
    of_shape = shape(geom, alpha)
    out = fresnel_terms(geom, names, of_shape, n, k, scale)
    if "alpha" in names:
        rise_i = geom.sin_i * np.exp(-(_x(geom.cos_i, geom.sin_i, alpha) ** 2))
        rise_r = geom.sin_r * np.exp(-(_x(geom.cos_r, geom.sin_r, alpha) ** 2))
        rise = (rise_i * geom.cos_r + rise_r * geom.cos_i) / (2 * sqrt(pi))
        by_alpha = (2 / alpha) * (geom.tan2_h / alpha**2 - 1) - rise / _masking(geom, alpha)
        out["alpha"] = scale * optics.fresnel(geom.cos_d, n, k) * of_shape * by_alpha
    return out


def bare(geom: Geometry, alpha) -> np.ndarray:
    """D/(4 cos θi cos θr) [1/sr]: the shape with no facet hidden by another."""
    return beckmann(geom, alpha) / (4 * geom.cos_cos)


def unmasked(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """The law without masking: enough where neither light nor eye is low."""
    return scale * optics.fresnel(geom.cos_d, n, k) * bare(geom, alpha)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("alpha", 0.2, 1e-4, 1.5, log=True, meaning="facet slope, √2 times the rms slope along a line", starts=(0.01, 0.04, 0.1, 0.2, 0.4, 0.8)),
        *INDEX,
    ),
    gradient=gradient,
    without={"fresnel": with_fixed_fresnel(shape), "masking": unmasked, "fresnel+masking": with_fixed_fresnel(bare)},
    summary="Gaussian facets, Smith masking, Fresnel: surfaces of one roughness scale, rougher than the wavelength",
    pins=(
        Pin(in_plane(45, 50), {"alpha": 0.4, "n": 1.7, "k": 0.0, "scale": 0.8}, f=0.071639201872482694, source="50 digits"),
        Pin(in_plane(75, 60), {"alpha": 0.5, "n": 0.958, "k": 6.69, "scale": 1.0}, f=1.796900550860498, source="50 digits"),
    ),
    extremes=(
        Extreme("narrowest lobe, 0.01° from grazing", in_plane(89.99, 89.99), {"alpha": 1e-4}),
        Extreme("lobe underflows far from the mirror", in_plane(10, -80), {"alpha": 1e-4}, f=0.0),
        Extreme("at the normal, where tan is 0", in_plane(0, 0), {"alpha": 1.5}),
    ),
    source="Beckmann and Spizzichino 1963; Smith 1967; Walter et al. 2007; Heitz 2014",
)
