"""Facets: counted once, seen at most once, hidden as Smith's integral says."""

import numpy as np
import pytest
from mpmath import erfc, exp, mp, mpf, pi, sqrt, tan

from brdfguide.physics import grain, microfacet
from brdfguide.physics.geometry import Geometry, in_plane

DENSITIES = {"ggx": microfacet.ggx, "beckmann": microfacet.beckmann}
SHAPES = {"ggx": microfacet.ggx_shape, "beckmann": microfacet.beckmann_shape}
SLOPES = {"ggx": microfacet.ggx_shape_and_slope, "beckmann": microfacet.beckmann_shape_and_slope}
every_kind = pytest.mark.parametrize("kind", DENSITIES)
SOME = Geometry.from_degrees(
    np.array([10.0, 45.0, 60.0, 80.0, 89.9, 0.0]), 0.0, np.array([20.0, 50.0, 5.0, 85.0, 89.0, 30.0]), 150.0
)


def right_hidden(kind, theta, alpha):
    """Λ at 40 digits."""
    with mp.workdps(40):
        if theta == 0:
            return mpf(0)
        steep = mpf(alpha) * tan(mpf(float(theta)) * pi / 180)
        if kind == "ggx":
            return (sqrt(1 + steep**2) - 1) / 2
        return (exp(-1 / steep**2) * steep / sqrt(pi) - erfc(1 / steep)) / 2


@every_kind
@pytest.mark.parametrize("alpha", [0.01, 0.2, 1.5])
def test_projected_facets_cover_the_surface_once(kind, alpha):
    slope = alpha * np.geomspace(1e-4, 1e4, 20_001)  # tan δ
    theta = np.degrees(np.arctan(slope))
    lit = theta < 89.9999
    density = DENSITIES[kind](in_plane(theta[lit], -theta[lit]), alpha)
    sin_cos_by_slope = slope[lit] / (1 + slope[lit] ** 2) ** 2  # sin δ cos δ dδ
    assert np.trapezoid(2 * np.pi * density * sin_cos_by_slope, slope[lit]) == pytest.approx(1, abs=2e-4)


@every_kind
@pytest.mark.parametrize("alpha", [0.003, 0.2, 1.5])
def test_shape_is_density_times_smiths_masking_at_forty_digits(kind, alpha):
    hidden_i, hidden_r = (
        [right_hidden(kind, t, alpha) for t in theta] for theta in (SOME.theta_i_deg, SOME.theta_r_deg)
    )
    masking = np.array([float(1 / (1 + i + r)) for i, r in zip(hidden_i, hidden_r, strict=True)])
    wanted = DENSITIES[kind](SOME, alpha) * masking / (4 * SOME.cos_i * SOME.cos_r)
    np.testing.assert_allclose(SHAPES[kind](SOME, alpha), wanted, rtol=2e-12)  # the angles are rounded
    if kind == "ggx":
        apart = np.array([float(1 / ((1 + i) * (1 + r))) for i, r in zip(hidden_i, hidden_r, strict=True)])
        wanted = microfacet.ggx(SOME, alpha) * apart / (4 * SOME.cos_i * SOME.cos_r)
        np.testing.assert_allclose(microfacet.ggx_shape_uncorrelated(SOME, alpha), wanted, rtol=2e-12)


@every_kind
def test_slope_of_the_shape_is_that_of_its_differences(kind):
    geom = SOME[:4]  # beyond, a Gaussian has nothing left to take a logarithm of
    shape, by_alpha = SLOPES[kind](geom, 0.8)
    np.testing.assert_allclose(shape, SHAPES[kind](geom, 0.8), rtol=1e-15)
    ahead, behind = (np.log(SHAPES[kind](geom, 0.8 + step)) for step in (1e-5, -1e-5))
    np.testing.assert_allclose(by_alpha, (ahead - behind) / 2e-5, rtol=1e-8)


@every_kind
def test_facets_at_random_heights_hide_more_than_correlated_ones_and_none_at_the_normal(kind):
    bare = DENSITIES[kind](SOME, 0.5) / (4 * SOME.cos_cos)
    assert np.all(SHAPES[kind](SOME, 0.5) <= bare)
    assert np.all(microfacet.ggx_shape_uncorrelated(SOME, 0.5) <= microfacet.ggx_shape(SOME, 0.5) * (1 + 1e-15))
    normal = in_plane(0.0, 0.0)
    assert SHAPES[kind](normal, 0.5) == pytest.approx(DENSITIES[kind](normal, 0.5) / 4, rel=1e-15)


@pytest.mark.parametrize(
    "shape", [grain.grained_density, grain.grained_shape, grain.grained_shape_uncorrelated], ids=lambda f: f.__name__
)
def test_facets_without_a_grain_need_no_azimuths_and_are_the_same_to_every_digit(shape):
    round_, about_axes = shape(SOME, 0.3, 0.3, 0.7), shape(SOME, 0.3, 0.3, np.array([[0.7], [0.7]]))
    assert np.array_equal(np.broadcast_to(round_, about_axes.shape), about_axes)
