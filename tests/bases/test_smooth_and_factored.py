"""The smooth function and the free factors: what they must obey, and that made data give back what made them."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.bases import factored, smooth
from brdfguide.physics import microfacet
from brdfguide.physics.geometry import Geometry

from .. import synthetic

GGX = models.get("lambertian+ggx")


def made(alpha: float, geom, noise: float = 0.0):
    values = {"lambertian.albedo": 0.2, "ggx.alpha": alpha, "ggx.n": 1.5}
    return synthetic.surface(GGX, geom, values, noise=noise)


def test_the_smooth_function_is_reciprocal():
    geom = synthetic.hemisphere(200)
    np.testing.assert_allclose(smooth.design(geom), smooth.design(geom.swapped()), atol=1e-9)


def test_odd_multiples_of_phi_d_turn_into_their_opposite():
    geom = synthetic.hemisphere(200)
    for multiple in smooth.ODD:
        there, back = smooth.around(geom, multiple), smooth.around(geom.swapped(), multiple)
        np.testing.assert_allclose(there, -back, atol=1e-9)


@pytest.mark.parametrize("alpha, most", [(0.3, 0.006), (0.1, 0.006)])
def test_without_noise_next_to_nothing_is_left(alpha, most):
    data = made(alpha, synthetic.scan((10, 30, 50, 65, 75), 1.7))
    found = smooth.fit_smooth(smooth.design(data.geom, harmonics=(0,)), data.ln)
    assert found.gcv[0] < most


@pytest.mark.parametrize("alpha", [0.3, 0.1])
def test_with_noise_that_is_what_is_left(alpha):
    data = made(alpha, synthetic.scan((10, 30, 50, 65, 75), 1.7), noise=0.015)
    found = smooth.fit_smooth(smooth.design(data.geom, harmonics=(0,)), data.ln)
    assert 0.95 * 0.015 < found.gcv[0] < 1.2 * 0.015


def test_missing_values_stay_missing_and_change_no_other_channel():
    data = synthetic.surface(
        GGX, synthetic.hemisphere(900), {"lambertian.albedo": 0.3, "ggx.alpha": 0.3, "ggx.n": 1.5}, channels=2
    )
    ln = data.ln.copy()
    ln[::7, 0] = np.nan
    columns = smooth.design(data.geom)
    some, whole = smooth.fit_smooth(columns, ln), smooth.fit_smooth(columns, data.ln)
    assert np.isnan(some.fitted[::7, 0]).all()
    np.testing.assert_allclose(some.fitted[:, 1], whole.fitted[:, 1])


def test_free_factors_find_the_distribution_of_ggx():
    """Within 2 % from the peak to a thousandth of it, where d is that of the tilt at one difference angle."""
    alpha, geom = 0.2, synthetic.hemisphere(6000, highest=75)
    data = made(alpha, geom)
    found = factored.fit_factors(factored.Columns(geom), data.ln)
    residuals = np.log(found(geom)) - data.ln
    assert np.sqrt(np.mean(residuals**2)) < 0.004 and found.albedo[0] == pytest.approx(0.2, rel=0.05)
    tan_h = np.tan(np.radians([0.0, 3.0, 6.0, 12.0, 20.0, 30.0, 40.0]))
    half = Geometry.from_degrees(0.0, 0.0, 2 * np.degrees(np.arctan(tan_h)), 180.0)
    wanted = np.log(microfacet.ggx(half, alpha))
    ours = found.ln_of_tilt(tan_h)
    kept = wanted - wanted[0] > np.log(1e-3)
    apart = (ours - ours[0] - wanted + wanted[0])[kept]
    # what d, e and g may exchange out of the plane is small: a line in the angle at most
    assert np.max(np.abs(apart)) < 0.1 and kept.sum() >= 5


def test_factors_evaluate_as_they_were_fitted_and_are_reciprocal():
    geom = synthetic.hemisphere(800)
    data = made(0.3, geom)
    found = factored.fit_factors(factored.Columns(geom), data.ln)
    np.testing.assert_allclose(found(geom), found(geom.swapped()), rtol=1e-9)
