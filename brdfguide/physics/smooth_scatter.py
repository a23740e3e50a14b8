"""What a smooth surface scatters: total scatter and rms height, and Rayleigh and Rice's BRDF of a spectrum and back.

    TIS = 1 - exp(-(4π sigma cos θi/λ)²)                of what is reflected
    f = (16π²/λ⁴) cos θi cos θr Q S2(ν),   ν = |β - β0|/λ = |i_xy + r_xy|/λ

The first holds for any height whose waves are much longer than the light's; the second to first order of the
roughness, where the phase (4π sigma cos θi/λ)² stays below 0.1. Q is the reflectance where that hardly depends on angle
and polarisation, else `polarisation_factor`.

Source: Bennett and Porteus 1961; Rice 1951; Church, Jenkinson and Zavada 1977; Stover, "Optical Scattering".
"""

from math import asin, degrees, log1p, pi, radians, sin, sqrt

import numpy as np

from ..errors import InputError
from .geometry import Geometry

SMOOTH = 0.1  # of the phase, below which the first order holds to about 5 %
HAZE_DEG = 2.5  # from the mirror direction on, light counts as haze (ASTM D1003, said of transmission)


def phase(sigma, wavelength, cos_i=1.0):
    """(4π sigma cos θi/λ)², dimensionless; lengths [µm]."""
    return np.square(4 * pi * np.asarray(sigma) * cos_i / wavelength)


def first_order_holds(sigma: float, wavelength: float, cos_i: float = 1.0) -> bool:
    """Whether the first order of the roughness holds."""
    return bool(phase(sigma, wavelength, cos_i) < SMOOTH)


def total_scatter(sigma: float, wavelength: float, cos_i: float = 1.0) -> float:
    """Share of the reflected light that leaves the mirror beam (TIS); lengths [µm]."""
    return float(-np.expm1(-phase(sigma, wavelength, cos_i)))


def height_from_scatter(tis: float, wavelength: float, cos_i: float = 1.0) -> float:
    """Rms height [µm] that scatters this share. Raises InputError unless 0 <= tis < 1."""
    if not 0 <= tis < 1:
        raise InputError(f"a scattered share of {tis:g}: wanted one from 0 to below 1 (4 % is 0.04)")
    return wavelength * sqrt(-log1p(-tis)) / (4 * pi * cos_i)


def frequency(geom: Geometry) -> np.ndarray:
    """Spatial frequency |β - β0|/λ [1/µm] that scatters from one direction into the other."""
    return np.sqrt(geom.vxy2) / geom.wavelength


def frequency_at(angle_deg: float, wavelength: float) -> float:
    """The same [1/µm] at an angle from the mirror direction of normal incidence."""
    return sin(radians(angle_deg)) / wavelength


def angle_of(spatial_frequency: float, wavelength: float) -> float | None:
    """Angle [deg] at which a spatial frequency [1/µm] scatters at normal incidence; None: it scatters nowhere."""
    x = spatial_frequency * wavelength
    return degrees(asin(x)) if x <= 1 else None


def haze_band(wavelength: float) -> tuple[float, float]:
    """Spatial frequencies [1/µm] whose scatter counts as haze at normal incidence: from 2.5° to the horizon."""
    return frequency_at(HAZE_DEG, wavelength), 1 / wavelength


def rayleigh_rice(geom: Geometry, density, q=1.0) -> np.ndarray:
    """BRDF [1/sr] of a surface whose S2 [µm⁴] at `frequency(geom)` is `density`."""
    return _geometric(geom) * q * density


def density_from(geom: Geometry, brdf, q=1.0) -> np.ndarray:
    """S2 [µm⁴] at `frequency(geom)` that scatters this BRDF [1/sr]: `rayleigh_rice` solved for it."""
    return brdf / (_geometric(geom) * q)


def polarisation_factor(geom: Geometry, n: float, k: float = 0.0) -> np.ndarray:
    """Rayleigh and Rice's Q for unpolarised light on N = n + ik, the mean over both polarisations of what is sent into
    both; Fresnel's reflectance in the mirror direction.

        qss = (ε-1) cos φ/(ai ar)                           qsp = (ε-1) wr sin φ/(ai br)
        qps = (ε-1) wi sin φ/(bi ar)                        qpp = (ε-1) (wi wr cos φ - ε sin θi sin θr)/(bi br)

    ε = N², w = √(ε - sin²θ), a = cos θ + w, b = ε cos θ + w; φ is 0 in the plane of incidence on the mirror side.
    """
    epsilon = complex(n, k) ** 2
    cos_phi, sin_phi = _turn(geom)
    w_i, w_r = (np.sqrt(epsilon - np.square(s)) for s in (geom.sin_i, geom.sin_r))
    a_i, a_r = geom.cos_i + w_i, geom.cos_r + w_r
    b_i, b_r = epsilon * geom.cos_i + w_i, epsilon * geom.cos_r + w_r
    parts = (
        cos_phi / (a_i * a_r),
        w_r * sin_phi / (a_i * b_r),
        w_i * sin_phi / (b_i * a_r),
        (w_i * w_r * cos_phi - epsilon * geom.sin_i * geom.sin_r) / (b_i * b_r),
    )
    return 0.5 * abs(epsilon - 1) ** 2 * sum(np.square(np.abs(each)) for each in parts)


def _turn(geom: Geometry) -> tuple[np.ndarray, np.ndarray]:
    """cos φ and sin φ of the azimuth from the mirror side; at the normal, where there is none, φ = 0."""
    product = np.asarray(geom.sin_i * geom.sin_r)
    cos_phi = np.divide(-geom.dot_xy, product, out=np.ones_like(product), where=product > 0)
    cos_phi = np.clip(cos_phi, -1, 1)
    return cos_phi, np.sqrt(1 - cos_phi**2)


def _geometric(geom: Geometry):
    """16π² cos θi cos θr/λ⁴ [1/(sr µm⁴)]."""
    return geom.cos_cos * np.square(4 * pi / np.square(geom.wavelength))
