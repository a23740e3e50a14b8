"""GGX facets that keep the energy: the white furnace, the table of albedos, and what several facets do to colour."""

from functools import partial
from math import log

import numpy as np
import pytest

from brdfguide import models
from brdfguide.physics import facet_albedo, fresnel, hemisphere
from brdfguide.physics.geometry import in_plane

GGX, MS = models.term("ggx"), models.term("ggx-ms")
ANGLES = (0.0, 20.0, 40.0, 55.0, 65.0, 75.0, 82.0, 87.0, 89.9)
WHITE = {"n": 1.5, "k": 1e9, "scale": 1.0}


@pytest.mark.parametrize("alpha", [0.01, 0.05, 0.2, 0.5, 1.0, 1.5])
def test_white_facets_send_all_light_back_at_every_angle(alpha):
    np.testing.assert_allclose(hemisphere.dhr(partial(MS, alpha=alpha, **WHITE), ANGLES), 1.0, atol=2e-5)


def test_the_series_of_what_is_lost_is_the_integral_with_seed_81():
    rng = np.random.default_rng(81)
    for alpha in np.exp(rng.uniform(np.log(0.01), np.log(1.5), 8)):
        mu = rng.uniform(0, 1, 3) ** 2
        kept = hemisphere.dhr(partial(GGX, alpha=alpha, **WHITE), np.degrees(np.arccos(mu)))[:, 0]
        np.testing.assert_allclose(facet_albedo.lost(mu, alpha), 1 - kept, atol=1.5e-5)


def test_at_the_normal_a_surface_of_alpha_1_loses_ln_2():
    assert float(facet_albedo.lost(1.0, 1.0)) == pytest.approx(log(2), abs=1e-5)


@pytest.mark.parametrize(("n", "mean"), [(1.33, 0.065931), (1.5, 0.091778), (1.7, 0.120320)])
def test_mean_reflectance_of_an_interface(n, mean):
    assert float(fresnel.mean_fresnel(n)) == pytest.approx(mean, abs=5e-7)


def test_several_facets_saturate_a_metal():
    """What they add, over what a white surface would add, is F̄² and less: dark channels lose more than bright ones."""
    geom, k = in_plane(30, [[-50.0]]), np.array([2.0, 3.0, 6.0])
    added = MS(geom, alpha=0.8, n=1.0, k=k) - GGX(geom, alpha=0.8, n=1.0, k=k)
    white = MS(geom, alpha=0.8, **WHITE) - GGX(geom, alpha=0.8, **WHITE)
    share, mean = (added / white)[0], fresnel.mean_fresnel(1.0, k)
    assert np.all(share < mean) and np.all(np.diff(share / mean) > 0)


def test_where_facets_are_smooth_it_is_ggx():
    geom = in_plane(40, np.array([[-30.0], [10.0], [40.0], [70.0]]))
    np.testing.assert_allclose(MS(geom, alpha=0.01), GGX(geom, alpha=0.01), rtol=1e-6, atol=5e-7)
    np.testing.assert_array_equal(
        MS.without["multiple"](geom, **MS.defaults()), GGX(geom, alpha=MS.defaults()["alpha"])
    )
