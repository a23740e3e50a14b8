"""Total scatter, Rayleigh and Rice's BRDF and back, its polarisation factor, and where the wave law agrees."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.physics import profile_numbers, rough_scatter, smooth_scatter
from brdfguide.physics.fresnel import fresnel
from brdfguide.physics.geometry import Geometry, in_plane
from brdfguide.physics.height_spectrum import GaussianSpectrum, KCorrelation

GREEN = 0.55
HE, STAM, ABC = (models.term(name) for name in ("he-torrance", "stam", "abc"))


def lobe(theta_i: float, tau: float, wavelength: float = GREEN) -> Geometry:
    """Directions across a narrow lobe, down to a hundredth of its peak."""
    x = np.linspace(-1, 1, 41) * np.sqrt(np.log(100)) / np.pi * wavelength / tau
    return in_plane(theta_i, np.degrees(np.arcsin(np.sin(np.radians(theta_i)) + x)), wavelength)


def test_scatter_and_height_are_each_others_inverse():
    for sigma in (1e-6, 1e-3, 0.05):
        share = smooth_scatter.total_scatter(sigma, 0.633, 0.8)
        assert smooth_scatter.height_from_scatter(share, 0.633, 0.8) == pytest.approx(sigma, rel=1e-12)
    assert smooth_scatter.total_scatter(0.02, GREEN) == pytest.approx(0.18845177354622460, rel=1e-14)  # 50 digits
    with pytest.raises(InputError, match="wanted one from 0 to below 1"):
        smooth_scatter.height_from_scatter(1.0, GREEN)


@pytest.mark.parametrize("theta_i", [0.0, 35.0, 75.0])
def test_spectrum_to_brdf_to_spectrum(theta_i):
    spectrum = KCorrelation(1e-5, 12.0, 2.4)
    geom = Geometry.from_degrees(theta_i, 0.0, np.linspace(1, 85, 60)[:, None], np.linspace(20, 180, 9), GREEN)
    density = spectrum.of_surface(smooth_scatter.frequency(geom))
    for q in (0.7, smooth_scatter.polarisation_factor(geom, 1.44, 7.1)):
        brdf = smooth_scatter.rayleigh_rice(geom, density, q)
        np.testing.assert_allclose(smooth_scatter.density_from(geom, brdf, q), density, rtol=1e-12)


def test_the_law_abc_is_rayleigh_and_rices():
    geom = in_plane(40.0, np.linspace(-80, 80, 33), GREEN)
    ours = smooth_scatter.rayleigh_rice(
        geom, KCorrelation(1e-4, 9.0, 1.7).of_surface(smooth_scatter.frequency(geom)), 0.6
    )
    np.testing.assert_allclose(ours, ABC(geom, a=1e-4, b=9.0, c=1.7, f0=0.6), rtol=1e-12)


@pytest.mark.parametrize("theta_i", [0.0, 30.0, 60.0])
@pytest.mark.parametrize("waves, within", [(0.001, 0.004), (0.003, 0.005), (0.006, 0.01), (0.01, 0.024)])
def test_rayleigh_rice_and_he_torrance_agree_where_both_hold(waves, within, theta_i):
    """Over the lobe down to a hundredth of its peak, to 1 % for sigma below 0.006 of the wavelength. At a hundredth
    the phase is 1.6 %, and the first order leaves out as much; the correlation in the exponent does not."""
    sigma, tau, n, k = waves * GREEN, 40 * GREEN, 1.5, 0.0
    geom, spectrum = lobe(theta_i, tau), GaussianSpectrum(sigma, tau)
    q = fresnel(geom.cos_d, n, k)
    theirs = HE(geom, sigma=sigma, slope=sigma / tau, n=n, k=k, scale=1.0)
    first = smooth_scatter.rayleigh_rice(geom, spectrum.of_surface(smooth_scatter.frequency(geom)), q)
    assert np.abs(first / theirs - 1).max() < within
    assert np.abs(rough_scatter.scattered(geom, spectrum, q) / theirs - 1).max() < 0.004


@pytest.mark.parametrize("theta_i", [5.0, 50.0])
@pytest.mark.parametrize("n, k", [(1.5, 0.0), (0.96, 6.69)])
def test_polarisation_factor_is_fresnels_in_the_mirror_direction(theta_i, n, k):
    geom = in_plane(theta_i, theta_i)
    assert float(smooth_scatter.polarisation_factor(geom, n, k)) == pytest.approx(
        float(fresnel(geom.cos_i, n, k)), rel=1e-12
    )


def test_polarisation_factor_is_reciprocal():
    geom = Geometry.from_degrees(20.0, 0.0, 64.0, 77.0)
    one, other = (smooth_scatter.polarisation_factor(each, 1.9, 3.3) for each in (geom, geom.swapped()))
    assert float(one) == pytest.approx(float(other), rel=1e-12)


@pytest.mark.parametrize("sigma", [0.001, 0.02, 0.2, 0.6])
def test_the_correlation_in_the_exponent_is_the_wave_laws_sum_of_orders(sigma):
    """`stam` has the same sum; near the mirror direction its cosines are Rayleigh and Rice's."""
    tau = 60.0
    geom = lobe(10.0, tau)
    ours = rough_scatter.scattered(geom, GaussianSpectrum(sigma, tau))
    np.testing.assert_allclose(ours, STAM(geom, sigma=sigma, slope=sigma / tau, f0=1.0), rtol=5e-3)


def test_the_correlation_in_the_exponent_begins_as_rayleigh_rice():
    spectrum, geom = KCorrelation(1e-9, 20.0, 2.2), in_plane(10.0, np.linspace(-60, 70, 27), GREEN)
    first = smooth_scatter.rayleigh_rice(geom, spectrum.of_surface(smooth_scatter.frequency(geom)))
    np.testing.assert_allclose(rough_scatter.scattered(geom, spectrum), first, rtol=1e-5)


def test_numbers_of_a_workshop():
    assert profile_numbers.rq_from_ra(0.8) == pytest.approx(1.0027, abs=1e-4)
    spectrum = GaussianSpectrum(0.5, 20.0)
    from brdfguide.physics.height_spectrum import profile_slope

    rdq = profile_slope(spectrum, 1e-7, 1.0)
    assert profile_numbers.tau_from_slope(0.5, rdq) == pytest.approx(20.0, rel=1e-6)
    rsm = 2 * np.pi * 0.5 / rdq
    assert profile_numbers.rdq_from_spacing(0.5, rsm) == pytest.approx(rdq, rel=1e-12)
    assert profile_numbers.tau_from_spacing(rsm) == pytest.approx(20.0, rel=1e-6)
    assert profile_numbers.alpha_from_slope(rdq) == pytest.approx(2 * 0.5 / 20.0, rel=1e-6)


def test_mean_absolute_height_and_spacing_of_a_made_profile_seed_7():
    """Ra and RSm counted on a random profile of Gaussian correlation, 21 cm long."""
    tau, step, count = 10.0, 0.2, 2**20
    nu = np.fft.rfftfreq(count, step)
    random = np.random.default_rng(7)
    amplitude = np.sqrt(GaussianSpectrum(0.3, tau).of_profile(nu) / (count * step) / 2)
    waves = amplitude * (random.standard_normal(len(nu)) + 1j * random.standard_normal(len(nu)))
    height = np.fft.irfft(waves, count) * count / 2 * 2**0.5
    rq = height.std()
    assert profile_numbers.rq_from_ra(np.abs(height).mean()) == pytest.approx(rq, rel=0.02)
    up = np.count_nonzero((height[:-1] < 0) & (height[1:] >= 0))
    assert profile_numbers.tau_from_spacing(count * step / up) == pytest.approx(tau, rel=0.03)


@pytest.mark.parametrize(
    "light, directions, spectrum, f",
    [
        ((0.633, 1.37, 7.62), (35.0, 62.0, 140.0), (1e-4, 20.0, 2.2), 2.8513474370835523e-05),
        ((0.532, 4.15, 0.05), (70.0, 10.0, 0.0), (3e-5, 60.0, 1.7), 8.180716052427563e-07),
        ((10.6, 1.515, 0.0), (20.0, 25.0, 180.0), (0.02, 300.0, 1.4), 6.072582656175578e-05),
    ],
)
def test_values_of_nists_scatmech(light, directions, spectrum, f):
    """Microroughness_BRDF_Model with ABC_PSD_Function (A = K a b, C = c + 1), unpolarised; pySCATMECH 0.1.10."""
    (wavelength, n, k), (theta_i, theta_r, phi) = light, directions
    geom = Geometry.from_degrees(theta_i, 0.0, theta_r, phi, wavelength)
    density = KCorrelation(*spectrum).of_surface(smooth_scatter.frequency(geom))
    ours = smooth_scatter.rayleigh_rice(geom, density, smooth_scatter.polarisation_factor(geom, n, k))
    assert float(ours) == pytest.approx(f, rel=1e-12)
