"""Scatter of a spectrum beyond the first order of the roughness: its correlation in the exponent, as Kirchhoff has it.

    f = (16π²/λ⁴) cos θi cos θr Q S(ν; κ),   κ = 2π (cos θi + cos θr)/λ
    S(ν; κ) = κ⁻² ∫ (e^(-κ²(sigma² - C(r))) - e^(-κ² sigma²)) J0(2πνr) 2πr dr,   C(r) = ∫ S2 J0(2πνr) 2πν dν

For a small κ sigma it is S2, and f is Rayleigh and Rice's; for a Gaussian correlation it is the sum over orders of
`he-torrance` and `stam`, with Rayleigh and Rice's cosines in place of Kirchhoff's. What it lacks: shadows, and light
that is scattered twice.

Source: Beckmann 1963; Krywonos, Harvey and Choi 2011, "Linear systems formulation of scattering theory for rough
surfaces with arbitrary incident and scattering angles". Hankel transforms by Hamilton 2000 (SciPy's `fht`).
"""

from math import pi

import numpy as np
from scipy import fft

from .geometry import Geometry
from .height_spectrum import Spectrum, surface_height
from .smooth_scatter import frequency, rayleigh_rice

POINTS = 8192
DECADES = 5.0  # beyond both ends of a spectrum: of what the transform takes for one period
LOWEST = 0.1  # times a spectrum's lower end: below, what is added is level
FEW = 1e-2  # of an exponent, below which e^x - 1 - x is its series


def scattered(geom: Geometry, spectrum: Spectrum, q=1.0) -> np.ndarray:
    """BRDF [1/sr] in the shape of `geom`, the mirror beam left out."""
    kappa = 2 * pi * geom.v_z / geom.wavelength
    return rayleigh_rice(geom, effective_density(spectrum, frequency(geom), kappa), q)


def effective_density(spectrum: Spectrum, nu, kappa) -> np.ndarray:
    """S [µm⁴] for every spatial frequency [1/µm] with its κ [1/µm]; both broadcast.

    e^(-κ² sigma²) (S2 + what the higher orders add): the first order is exact, and what is transformed falls off as C².
    """
    nu, kappa = np.broadcast_arrays(np.asarray(nu, float), np.asarray(kappa, float))
    low, high = np.log10(spectrum.ends)
    grid = np.logspace(low - DECADES, high + DECADES, POINTS)
    correlation = _hankel(spectrum.of_surface(grid), grid)
    height2, ln_grid = surface_height(spectrum) ** 2, np.log(grid)
    first, more = spectrum.of_surface(nu).ravel(), np.empty(nu.size)
    ln_nu = np.log(np.clip(nu, LOWEST * spectrum.ends[0], grid[-1])).ravel()
    squares, places = np.unique(np.round(kappa.ravel() ** 2, 9), return_inverse=True)
    for place, square in enumerate(squares):
        exponent = square * np.minimum(correlation, height2)
        added = _hankel(_beyond_first(exponent, square * height2) / square, 1 / grid[::-1])
        here = places == place
        more[here] = np.interp(ln_nu[here], ln_grid, added)
        first[here] *= np.exp(-square * height2)
    return np.maximum(first + more, 0.0).reshape(nu.shape)


def _beyond_first(x: np.ndarray, g: float) -> np.ndarray:
    """(e^x - 1 - x) e^-g for x <= g."""
    few = np.clip(x, -FEW, FEW)
    series = few * few * (0.5 + few * (1 / 6 + few * (1 / 24 + few / 120)))
    return np.where(np.abs(x) < FEW, np.exp(-g) * series, np.exp(x - g) - np.exp(-g) * (1 + x))


def _hankel(values: np.ndarray, at: np.ndarray) -> np.ndarray:
    """2π ∫ values J0(2π x y) x dx at y = 1/x, in ascending order."""
    offset = float(np.log(2 * pi))
    transformed = fft.fht(values * at, float(np.log(at[1] / at[0])), 0.0, offset=offset)
    return transformed * at[::-1]
