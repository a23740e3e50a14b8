"""He and Torrance's wave-optical lobe of a rough surface, with the mirror reflection that the roughness leaves.

    f = F(θd) (S_i/cos θi) (S_r/cos θr) (|i + r|²/v_z)² D/π,   v_z = cos θi + cos θr
    D = (π² tau²/4λ²) Σ_m g^m e^-g/(m! m) exp(-x/4m),   x = (2π tau/λ)² |i_xy + r_xy|²
    g = (2π σ v_z/λ)²,   σ² = sigma²/(1 + W(K²/8π)),   K = Σ tan θ erfc(ν),   ν = tau cot θ/(2 sigma)
    S = h/(h + e^-ν²/(2√π ν)),   h = erfc(-ν)/2,   mirror reflectance = F(θi) e^-g S²

Diffraction, shadowing, effective roughness at grazing: a rough lobe out of which a mirror grows toward grazing.
Single scattering: it loses energy on steep slopes, and beyond 80°. Far above the wavelength (g > 20) only
sigma/tau matters. sigma/tau = slope; the rms slope along a line is √2 slope, Beckmann's alpha is 2 slope.

Source: He, Torrance, Sillion and Greenberg 1991; unpolarised, isotropic, exponential of the first term of Λ restored
(the authors' errata), S by Smith's identity, G with unit vectors and x with wave vectors (decided by their limits).
"""

from math import pi

import numpy as np

from ..physics import fresnel as optics
from ..physics.geometry import Geometry
from ._series_patches import ln_series
from ._shadows import (
    both_shadowings,
    height_factor,
    in_blocks,
    kept_fresnel,
    law_without,
    shadow_free,
    shadowing,
    shadows_left,
)
from .facts import Candidacy, Formula
from .model import Derived, Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, sigma, slope, n, k, scale) -> np.ndarray:
    """Lobe [1/sr], without the mirror part, in the shape of `geom` and its wavelength."""
    factor, g, y = in_blocks(_parts, geom, sigma, slope, n, k, scale)
    factor *= np.exp(ln_series(g, y))  # the factor has the shape of all: index, amplitude and wavelength
    return factor


def ln_brdf(geom: Geometry, *, sigma, slope, n, k, scale) -> np.ndarray:
    """ln of the lobe, also where the lobe itself underflows."""
    factor, g, y = in_blocks(_parts, geom, sigma, slope, n, k, scale)
    return np.log(factor) + ln_series(g, y)


def mirror(geom: Geometry, *, sigma, slope, n, k, scale) -> np.ndarray:
    """Reflectance left to the mirror direction at θi, dimensionless."""
    shadow, spread = shadowing(geom.cos_i, geom.sin_i, slope)
    g = (4 * pi * sigma / geom.wavelength) ** 2 * (geom.cos_i * shadow_free(2 * spread)) ** 2
    return scale * optics.fresnel(geom.cos_i, n, k) * np.exp(-g) * (shadow * geom.cos_i) ** 2


def gradient(geom: Geometry, names, *, sigma, slope, n, k, scale) -> dict[str, np.ndarray]:
    """df/dscale, df/dsigma and df/dslope, and df/dn and df/dk as far as `names` asks for them."""
    bare, g, y, through_s, through_g = in_blocks(_parts, geom, sigma, slope, None, None, 1.0, True)
    ln_s, by_ln_g, by_y = ln_series(g, y, derivatives=True)
    bare = bare * np.exp(ln_s)
    f, *by_index = (
        optics.fresnel_with_slopes(geom.cos_d, n, k) if "n" in names or "k" in names else (kept_fresnel(geom, n, k),)
    )
    lobe = bare * f
    by_tau = 2 + 2 * y * by_y  # d ln f/d ln tau
    return {
        "scale": lobe,
        "sigma": lobe * (by_tau + 2 * by_ln_g) * (scale / sigma),
        "slope": lobe * (through_s + by_ln_g * through_g - by_tau) * (scale / slope),
        **{name: by * bare * scale for name, by in zip("nk", by_index, strict=False)},
    }


def _parts(geom, sigma, slope, n, k, scale, derivatives=False):
    """What multiplies the sum, and its arguments g and y = x/4; without n, without Fresnel's factor.

    With `derivatives` also those of ln S_i S_r and of ln g by ln slope.
    """
    shadows, spreads, *by_slope = both_shadowings(geom, slope, derivatives)
    spread = spreads[0] + spreads[1]
    tau = sigma / slope
    left, *through_g = shadows_left(spread, by_slope[1][0] + by_slope[1][1]) if derivatives else (shadow_free(spread),)
    g = (2 * pi * sigma / geom.wavelength) ** 2 * (geom.v_z * left) ** 2
    y = (pi * tau / geom.wavelength) ** 2 * geom.vxy2
    shadow = shadows[0] * shadows[1]
    shadow *= height_factor(geom)
    f = 1.0 if n is None else kept_fresnel(geom, n, k)
    factor = (pi / 4) * scale * (tau / geom.wavelength) ** 2 * f * shadow
    return (factor, g, y, by_slope[0][0] + by_slope[0][1], *through_g) if derivatives else (factor, g, y)


CHEAPER = tuple(
    (*some, *waves)
    for some in ((), ("fresnel",), ("masking",), ("fresnel", "masking"))
    for waves in ((), ("series",), ("waves",))
)[1:]

MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("sigma", 0.3, 1e-3, 50.0, "um", log=True, meaning="rms height", starts=(0.05, 0.2, 0.8)),
        Parameter(
            "slope",
            0.1,
            1e-3,
            1.0,
            log=True,
            meaning="sigma/tau; half of Beckmann's alpha",
            starts=(0.02, 0.05, 0.1, 0.2),
        ),
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
            meaning="1: absolute, by Fresnel's equations",
        ),
    ),
    gradient=gradient,
    mirror=mirror,
    without={"+".join(out): law_without(*out) for out in CHEAPER},
    derived=(Derived("tau", lambda sigma, slope, **_: sigma / slope, "um", "correlation length"),),
    pins=(
        Pin(
            at(45, 50),
            {"sigma": 0.28, "slope": 0.16, "n": 1.7},
            f=0.147046332277233921,
            source="the formulas above at 50 digits",
        ),
        Pin(at(60, 62, 0.45), {"sigma": 0.05, "slope": 0.05}, f=0.472430857758406432, source="the same, smooth"),
        Pin(at(30, 30), {"sigma": 5.0, "slope": 0.2}, f=0.0275383602920046262, source="the same, g = 9788"),
    ),
    extremes=(
        Extreme("0.01° from grazing", at(89.99, 89.99), {"sigma": 1.0}, f=2.83460397240751784e-9),
        Extreme("both at the normal", at(0, 0), {}, f=0.0813483828042643974),
        Extreme("steepest and roughest", at(89.99, -89.99), {"sigma": 50.0, "slope": 1.0}),
        Extreme("far off the narrowest lobe", at(10, -80), {"sigma": 0.001, "slope": 0.001}),
    ),
    summary="wave optics, shadowing and an emerging mirror; slightly rough to rough metals and dielectrics, any gloss",
    source="He, Torrance, Sillion and Greenberg 1991",
    family="wave optics",
    cannot="one surface without a coat, bumps of the common (Gaussian) kind, the same from all sides; slow to evaluate",
    aliases=("he",),
    candidacy=Candidacy(100, bare=True),
    beyond_facets=lambda **_: "wave effects, the lobe's change of shape with angle and wavelength, become one shape",
    formula=Formula(
        "{scale} * he_torrance(ci, cr, q, {sigma_waves}, {tau_waves}, {slope}, {n}, {k})",
        (
            ("steep", "c, slope", "most(2.0 * slope * sqrt(sin2(c)), c / 26.0)"),
            ("visible2", "c, s, e, b", "(2.0 - e) * 1.7724539 / (s * (c / s * (2.0 - e) * 1.7724539 + b))"),
            ("visible1", "c, s", "visible2(c, s, erfc0(c / s), exp(-sq(c / s)))"),
            ("visible", "c, slope", "visible1(c, steep(c, slope))"),
            ("spread", "c, slope", "sqrt(sin2(c)) / c * erfc0(c / steep(c, slope))"),
            ("shadow_free", "k", "1.0 / sqrt(1.0 + lambert_w(k * k / (8.0 * PI)))"),
            (
                "he_torrance",
                "ci, cr, q, sigma, tau, slope, n, k",
                "0.25 * PI * tau * tau * fresnel(cosd(ci, cr, q), n, k) * visible(ci, slope) * visible(cr, slope)"
                " * sq(v2(ci, cr, q) / (ci + cr))"
                " * series(sq(2.0 * PI * sigma * (ci + cr) * shadow_free(spread(ci, slope) + spread(cr, slope))),"
                " sq(PI * tau) * q)",
            ),
            (
                "he_mirror",
                "ci, sigma, slope, n, k",
                "fresnel(ci, n, k) * sq(visible(ci, slope) * ci)"
                " * exp(-least(sq(4.0 * PI * sigma * ci * shadow_free(2.0 * spread(ci, slope))), 85.0))",
            ),
        ),
        mirror="{scale} * he_mirror(ci, {sigma_waves}, {slope}, {n}, {k})",
        numbers=lambda *, sigma, slope, wavelength, **_: {
            "sigma_waves": sigma / wavelength,
            "tau_waves": sigma / slope / wavelength,
        },
    ),
)
