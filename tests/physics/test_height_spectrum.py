"""Spectra of heights: what a profile and a surface say of each other; heights in bands against SciPy and mpmath."""

import mpmath
import numpy as np
import pytest
from scipy import integrate

from brdfguide.errors import InputError
from brdfguide.physics.height_spectrum import (
    GaussianSpectrum,
    KCorrelation,
    TabulatedSpectrum,
    profile_height,
    profile_slope,
    surface_height,
)

POLISH = KCorrelation(1e-4, 20.0, 2.2)
SPECTRA = [POLISH, KCorrelation(0.02, 3.0, 1.3), GaussianSpectrum(0.01, 7.0)]


@pytest.mark.parametrize("spectrum", SPECTRA, ids=str)
@pytest.mark.parametrize("nu", [0.003, 0.08])
def test_a_profile_is_abels_transform_of_the_surface(spectrum, nu):
    """S1(ν) = 2 ∫ S2(√(ν² + μ²)) dμ over all μ, one-sided."""
    crossed, _ = integrate.quad(lambda mu: spectrum.of_surface(np.hypot(nu, mu)), 0, np.inf, epsabs=0, limit=400)
    assert float(spectrum.of_profile(nu)) == pytest.approx(4 * crossed, rel=1e-7)


@pytest.mark.parametrize("spectrum", SPECTRA, ids=str)
def test_profile_and_surface_have_the_same_height_over_all_waves(spectrum):
    assert surface_height(spectrum, 1e-9, 1e9) == pytest.approx(spectrum.height, rel=1e-3)
    assert profile_height(spectrum, 1e-9, 1e9) == pytest.approx(spectrum.height, rel=1e-3)


def test_height_in_a_band_is_the_integral_to_fifty_digits():
    mpmath.mp.dps = 50
    a, b, c = 1e-4, 20, mpmath.mpf("2.2")
    exact = mpmath.sqrt(mpmath.quad(lambda nu: a / (1 + (b * nu) ** 2) ** (c / 2), [0.002, 0.05, 0.4]))
    assert profile_height(POLISH, 0.002, 0.4) == pytest.approx(float(exact), rel=1e-9)
    exact = mpmath.sqrt(
        mpmath.quad(lambda nu: (2 * mpmath.pi * nu) ** 2 * a / (1 + (b * nu) ** 2) ** (c / 2), [0.002, 0.05, 0.4])
    )
    assert profile_slope(POLISH, 0.002, 0.4) == pytest.approx(float(exact), rel=1e-9)


@pytest.mark.parametrize("profile", [True, False])
def test_a_table_gives_the_other_spectrum_and_back(profile):
    """Power laws between the points of a dense table leave 5e-4; the ends are as far as that from the bend."""
    nu, at = np.geomspace(1e-4, 100, 3000), np.array([0.01, 0.05, 0.3, 3.0])
    given = POLISH.of_profile(nu) if profile else POLISH.of_surface(nu)
    table = TabulatedSpectrum(nu, given, profile)
    np.testing.assert_allclose(table.of_profile(at), POLISH.of_profile(at), rtol=5e-4)
    np.testing.assert_allclose(table.of_surface(at), POLISH.of_surface(at), rtol=5e-4)


def test_a_power_law_is_transformed_exactly():
    """K of slope c turns A ν^-c into K A ν^-(c+1)."""
    nu = np.geomspace(1e-3, 10, 5)
    table = TabulatedSpectrum(nu, 3e-6 * nu**-1.6, True)
    constant = float(mpmath.gamma(1.3) / (2 * mpmath.sqrt(mpmath.pi) * mpmath.gamma(0.8)))
    np.testing.assert_allclose(table.of_surface(nu[1:-1]), constant * 3e-6 * nu[1:-1] ** -2.6, rtol=1e-6)


def test_slope_1_has_no_total_height():
    assert KCorrelation(1e-4, 20.0, 1.0).height == np.inf


@pytest.mark.parametrize(
    "frequency, density, says",
    [([1.0], [1.0], "two or more"), ([1.0, 1.0], [1.0, 1.0], "ascend"), ([1.0, 2.0], [1.0, 0.0], "not positive")],
)
def test_bad_tables_are_refused(frequency, density, says):
    with pytest.raises(InputError, match=says):
        TabulatedSpectrum(np.array(frequency), np.array(density), True)


def test_an_empty_band_is_refused():
    with pytest.raises(InputError, match="is empty"):
        surface_height(POLISH, 2.0, 1.0)
