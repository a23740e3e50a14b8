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
from ._microfacet import INDEX, beckmann, gradient_of, with_fixed_fresnel

distribution = beckmann

# 1/√π - x erfcx(x) as a ratio of polynomials, highest power first, fitted by benchmarks/ramp.py: right to 6e-16 of
# x + cos θ Λ for x <= 6; beyond, exp(-x²) leaves nothing of it. All coefficients are positive, so no digit is lost.
ABOVE = (0.0010384444112690034, 0.013204521587764643, 0.07677608418112063, 0.26010966800444885, 0.5109361511037411, 0.5641895835477566)
BELOW = (0.003682914575712285, 0.0467658195638668, 0.27821178625739507, 0.9880931282215705, 2.23804571017105, 3.2077782950513614, 2.678064599496381, 1.0)


def shape(geom: Geometry, alpha) -> np.ndarray:
    """D G/(4 cos θi cos θr) [1/sr]: the law without Fresnel."""
    return beckmann(geom, alpha) / _masking(geom, alpha)


def _masking(geom: Geometry, alpha):
    """4 cos θi cos θr (1 + Λi + Λr), in which nothing is divided by a cosine."""
    hidden, _ = _hidden(geom.tan_i, alpha)
    hidden *= geom.sin_i * geom.cos_r
    other, _ = _hidden(geom.tan_r, alpha)
    other *= geom.sin_r * geom.cos_i
    hidden += other
    hidden *= 2 * alpha
    return hidden + 4 * geom.cos_cos


def _hidden(tan, alpha):
    """Λ/(½ alpha tan θ) = exp(-x²) (1/√π - x erfcx x), and exp(-x²)."""
    x = 1 / np.maximum(tan * alpha, 1 / 32)  # beyond 32, where exp(-x²) is 0, it stays 32 so that the normal has a value
    hidden = _horner(ABOVE, x)
    hidden /= _horner(BELOW, x)
    bell = np.exp(x * -x)
    hidden *= bell
    return hidden, bell


def _horner(coefficients, x):
    total = x * coefficients[0]
    total += coefficients[1]
    for coefficient in coefficients[2:]:
        total *= x
        total += coefficient
    return total


def brdf(geom: Geometry, *, alpha, n, k, scale) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom`."""
    return scale * optics.fresnel(geom.cos_d, n, k) * shape(geom, alpha)


def gradient(geom: Geometry, names, *, alpha, n, k, scale) -> dict[str, np.ndarray]:
    """d ln f/dalpha = (2/alpha)(t/alpha² - 1) - d ln(1 + Λi + Λr)/dalpha, with cos θ dΛ/dalpha = sin θ exp(-x²)/(2√π)."""
    (hidden_i, bell_i), (hidden_r, bell_r) = _hidden(geom.tan_i, alpha), _hidden(geom.tan_r, alpha)
    in_i, in_r = geom.sin_i * geom.cos_r, geom.sin_r * geom.cos_i
    masking = (2 * alpha) * (hidden_i * in_i + hidden_r * in_r) + 4 * geom.cos_cos
    rise = (bell_i * in_i + bell_r * in_r) * (2 / sqrt(pi))
    by_alpha = (2 / alpha) * (geom.tan2_h / alpha**2 - 1) - rise / masking
    return gradient_of(geom, names, beckmann(geom, alpha) / masking, by_alpha, n, k, scale)


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
