"""Rayleigh and Rice's scatter of a K-correlation (ABC) surface: an optical polish, its wavelength included.

    f = (16π²/λ⁴) cos θi cos θr f0 S(x/λ),   x = |β - β0| = |i_xy + r_xy|
    S(ν) = K a b/(1 + (b ν)²)^((c+1)/2),   K = Γ((c+1)/2)/(2√π Γ(c/2))

S is the two-dimensional spectrum [µm⁴] of a surface without direction whose profile has the spectrum
a/(1 + (b ν)²)^(c/2) [µm³], ν the spatial frequency [1/µm]: a level a, a bend at ν = 1/b, a fall with slope -c. Its
whole rms height follows, sigma² = 2πK a/(b (c - 1)). The first order of the roughness: right where the phase (4π sigma
cos θi/λ)² stays below 0.1; beyond, `stam` and `he-torrance` hold. One surface has one a, b and c at every wavelength.
f0 stands for Rayleigh and Rice's polarisation factor, as in a mirror of constant reflectance. The mirror beam is no
part of it.

Source: Rice 1951; Church, Takacs and Leonard 1989, "The prediction of BRDFs from surface profile measurements".
"""

from math import pi

import numpy as np

from ..numerics.special import digamma
from ..physics.geometry import Geometry, in_plane
from ..physics.height_spectrum import to_surface
from .facts import Candidacy, Formula
from .model import Derived, Extreme, Model, Parameter, Pin, at

TOWARD_MIRROR = in_plane(0.0, 0.0)  # where all but height is 1


def brdf(geom: Geometry, *, a, b, c, f0) -> np.ndarray:
    """BRDF [1/sr], in the shape of `geom` and its wavelength."""
    bent = np.log1p(geom.vxy2 * (b / geom.wavelength) ** 2)
    return (a * f0 * b * to_surface(c)) * _phase(geom) * np.exp(-0.5 * (c + 1) * bent)


def gradient(geom: Geometry, names, *, a, b, c, f0) -> dict[str, np.ndarray]:
    """d ln f/db = (1 - (c + 1) q/(1 + q))/b, d ln f/dc = ½ (ψ((c+1)/2) - ψ(c/2) - ln(1 + q)), q = (b x/λ)²."""
    q = geom.vxy2 * (b / geom.wavelength) ** 2
    bent = np.log1p(q)
    shape = (b * to_surface(c)) * _phase(geom) * np.exp(-0.5 * (c + 1) * bent)
    lobe = (a * f0) * shape
    return {
        "a": f0 * shape,
        "f0": a * shape,
        "b": lobe * (1 - (c + 1) * (q / (1 + q))) / b,
        "c": lobe * (0.5 * (digamma(0.5 * (c + 1)) - digamma(0.5 * c) - bent)),
    }


def _phase(geom: Geometry):
    """16π² cos θi cos θr/λ⁴."""
    return geom.cos_cos * (4 * pi / np.square(geom.wavelength)) ** 2


def height(a, b, c, f0=1.0):
    """Rms height sigma [µm] over all spatial frequencies; without a bound for c <= 1."""
    excess = np.asarray(c, float) - 1
    square = 2 * pi * to_surface(c) * a / (b * np.where(excess > 0, excess, 1.0))
    return np.where(excess > 0, np.sqrt(square), np.inf)


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter(
            "a", 1e-5, 0.0, 1e6, unit="um3", linear=True, meaning="spectrum of a profile at low spatial frequencies"
        ),
        Parameter(
            "b",
            10.0,
            1e-3,
            1e6,
            unit="um",
            log=True,
            meaning="bend of the spectrum: 2π times the correlation length",
            starts=(0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0),
        ),
        Parameter(
            "c",
            2.0,
            0.05,
            10.0,
            log=True,
            meaning="slope of a profile's spectrum beyond the bend",
            starts=(0.6, 1.2, 1.6, 2.0, 2.5, 3.5),
        ),
        Parameter(
            "f0",
            1.0,
            0.0,
            1.0,
            per_channel=True,
            free=False,
            meaning="reflectance of the smooth surface",
        ),
    ),
    gradient=gradient,
    derived=(
        Derived("sigma", height, "um", "rms height over all spatial frequencies"),
        Derived("length", lambda a, b, c, f0: b / (2 * pi), "um", "correlation length"),
    ),
    summary="polished surfaces from their spectrum of heights, all wavelengths at once; only where they are smooth",
    pins=(
        Pin(
            at(45, 48, 0.6328),
            {"a": 0.01, "b": 100.0, "c": 2.3, "f0": 0.4},
            f=0.154992209615315388,
            source="the formula above at 50 digits",
        ),
        Pin(
            at(70, -40, 10.6),
            {"a": 0.3, "b": 20.0, "c": 1.2, "f0": 0.9},
            f=0.000255714409454805566,
            source="the formula above at 50 digits",
        ),
    ),
    extremes=(
        Extreme("both 0.01° from grazing", at(89.99, 89.99), {"b": 1e6, "c": 10.0}),
        Extreme("longest correlation, far from the mirror", at(60, -60), {"b": 1e6, "c": 10.0}),
    ),
    breaks={"energy": "the first order of the roughness grows with it without a bound: right only where it is small"},
    source="Rice 1951; Church, Takacs and Leonard 1989",
    family="polished optics",
    candidacy=Candidacy(132, polished=True),
    cannot="right only where it is smooth; the mirror beam is no part of it",
    formula=Formula(
        "abc(ci, cr, q, {height}, {narrow}, {c})",
        (
            (
                "abc",
                "ci, cr, q, height, narrow, c",
                "height * ci * cr * exp(-0.5 * (c + 1.0) * ln1m(-narrow * narrow * q))",
            ),
        ),
        numbers=lambda *, wavelength, **values: {
            "height": brdf(TOWARD_MIRROR.at(wavelength), **values),
            "narrow": values["b"] / wavelength,
        },
    ),
)
