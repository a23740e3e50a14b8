"""Models where they were not fitted."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.noise_model import NoiseModel
from brdfguide.fitting import compare, cross_validation, fit, ranked

from .. import synthetic

GGX = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.22, "ggx.n": 1.5}


def plastic(geom=None, **options):
    return synthetic.surface(GGX, synthetic.scan() if geom is None else geom, TRUTH, **options)


def held(name, data):
    found = fit.fit(models.get(name), data)
    return found, cross_validation.held_out([found], cross_validation.thinned(data))[0]


def test_the_right_model_is_as_good_where_it_was_not_fitted():
    found, outside = held("lambertian+ggx", plastic(noise=0.02, seed=1))
    assert outside.rms_ln == pytest.approx(found.rms_ln, rel=0.15)
    assert outside.highest_theta_i_deg == 75 and outside.highest_rms_ln < 0.03


def test_a_model_without_the_rise_is_found_out_at_the_highest_angle():
    found, outside = held("lambertian+phong", plastic(noise=0.02, seed=1))
    assert outside.highest_rms_ln > 1.5 * found.rms_ln


def test_a_single_incidence_angle_leaves_nothing_to_hold_out():
    assert held("lambertian+ggx", plastic(synthetic.scan((30,)), noise=0.02))[1] is None


def test_every_direction_is_held_out_exactly_once_with_seed_3():
    for angles in (
        [10, 10, 20, 20, 30],
        np.linspace(0, 80, 97),
        np.random.default_rng(3).uniform(0, 85, 500),
        [5, 6, 7, 8, 9, 80, 81],
    ):
        masks = cross_validation._folds(np.asarray(angles, float))
        assert len(masks) > 1
        np.testing.assert_array_equal(np.sum(masks, axis=0), 1)


def test_growth_of_the_right_model_is_that_of_the_data():
    data = plastic()
    grown = cross_validation.growth(fit.fit(GGX, data), data)
    assert grown["theta_i_deg"] == [10, 75]
    assert grown["r_mirror"] == pytest.approx(grown["r_mirror_data"], rel=0.1)
    assert grown["r_max"] == pytest.approx(grown["r_max_data"], rel=0.1)


def test_phong_grows_less_than_the_data():
    data = plastic()
    grown = cross_validation.growth(fit.fit(models.get("lambertian+phong"), data), data)
    assert grown["r_mirror"] < 1 / np.cos(np.radians(75)) * 1.1
    assert grown["r_mirror_data"] > 5


def test_two_lobes_that_are_right_only_where_they_were_fitted_are_said_to_imitate():
    data = plastic(noise=0.01, seed=2)
    found = fit.fit(models.get("lambertian+lafortune:2"), data)
    far = cross_validation.HeldOut(rms_ln=5 * found.rms_ln, highest_rms_ln=1.0, highest_theta_i_deg=75)
    near = cross_validation.HeldOut(rms_ln=1.1 * found.rms_ln, highest_rms_ln=0.1, highest_theta_i_deg=75)
    assert cross_validation.imitation(found, far).code == "imitates"
    assert cross_validation.imitation(found, near) is None
    single = fit.fit(GGX, data)
    assert cross_validation.imitation(single, far) is None


def test_three_lobes_fitted_to_two_angles_are_caught_and_not_recommended():
    data = synthetic.surface(GGX, synthetic.scan((10, 70), step=5), TRUTH, noise=0.01, seed=4)
    found = compare.compare(data, [models.get("lambertian+lafortune:3"), GGX])
    assert found.recommended.fit.name == "lambertian+ggx"
    imitator = next(row for row in found.rows if row.fit.model.name.endswith(":3"))
    assert "imitates" in [warning.code for warning in imitator.warnings]


def test_every_row_of_a_comparison_carries_held_out_errors_and_growth():
    data = plastic(noise=0.02, seed=5, channels=3)
    found = compare.compare(data, map(models.get, ("lambertian+ward", "lambertian+ggx")))
    assert isinstance(found, ranked.Ranking)
    for row in found.rows:
        assert np.isfinite(row.held_out.rms_ln) and row.growth["r_mirror"] > 0


def black_gloss(lobes_at):
    """A black, glossy surface whose lobe was measured at these incidences alone, above a dark level known to 1e-4."""
    dark = {**TRUTH, "lambertian.albedo": 1e-5, "ggx.alpha": 0.1}
    data = synthetic.surface(GGX, synthetic.scan((10, 30, 50, 75)), dark, noise=0.02, seed=1)
    bright = data.brdf[:, 0] > 0.001
    kept = data[bright == np.isin(np.round(data.geom.theta_i_deg[:, 0]), lobes_at)]
    return replace(kept, noise=NoiseModel(0.02, (1e-4,), (0.0,), (0.0,), matters=True, missed=0.1))


@pytest.mark.filterwarnings("error")
def test_a_group_below_the_dark_level_is_not_held_out_and_the_highest_is_the_one_below_it():
    outside = held("lambertian+ggx", black_gloss((10, 30, 50)))[1]
    assert outside.highest_theta_i_deg == 50
    assert 0 < outside.rms_ln < 0.2 and 0 < outside.highest_rms_ln < 0.2


@pytest.mark.filterwarnings("error")
def test_one_group_above_the_dark_level_leaves_nothing_to_hold_out():
    assert held("lambertian+ggx", black_gloss((30,)))[1] is None
