"""Models where they were not fitted."""

import numpy as np
import pytest

from brdfguide import compare, fitting, models, ranking, validation

from . import synthetic

GGX = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.22, "ggx.n": 1.5}


def plastic(geom=None, **options):
    return synthetic.surface(GGX, synthetic.scan() if geom is None else geom, TRUTH, **options)


def held(name, data):
    found = fitting.fit(models.get(name), data)
    return found, validation.held_out(found, validation.thinned(data))


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
    for angles in ([10, 10, 20, 20, 30], np.linspace(0, 80, 97), np.random.default_rng(3).uniform(0, 85, 500), [5, 6, 7, 8, 9, 80, 81]):
        masks = validation._folds(np.asarray(angles, float))
        assert len(masks) > 1
        np.testing.assert_array_equal(np.sum(masks, axis=0), 1)


def test_growth_of_the_right_model_is_that_of_the_data():
    data = plastic()
    grown = validation.growth(fitting.fit(GGX, data), data)
    assert grown["theta_i_deg"] == [10, 75]
    assert grown["r_mirror"] == pytest.approx(grown["r_mirror_data"], rel=0.1)
    assert grown["r_max"] == pytest.approx(grown["r_max_data"], rel=0.1)


def test_phong_grows_less_than_the_data():
    data = plastic()
    grown = validation.growth(fitting.fit(models.get("lambertian+phong"), data), data)
    assert grown["r_mirror"] < 1 / np.cos(np.radians(75)) * 1.1
    assert grown["r_mirror_data"] > 5


def test_two_lobes_that_are_right_only_where_they_were_fitted_are_said_to_imitate():
    data = plastic(noise=0.01, seed=2)
    found = fitting.fit(models.get("lambertian+lafortune:2"), data)
    far = validation.HeldOut(rms_ln=5 * found.rms_ln, highest_rms_ln=1.0, highest_theta_i_deg=75)
    near = validation.HeldOut(rms_ln=1.1 * found.rms_ln, highest_rms_ln=0.1, highest_theta_i_deg=75)
    assert validation.imitation(found, far).code == "imitates"
    assert validation.imitation(found, near) is None
    single = fitting.fit(GGX, data)
    assert validation.imitation(single, far) is None


def test_three_lobes_fitted_to_two_angles_are_caught_and_not_recommended():
    data = synthetic.surface(GGX, synthetic.scan((10, 70), step=5), TRUTH, noise=0.01, seed=4)
    found = compare.compare(data, [models.get("lambertian+lafortune:3"), GGX])
    assert found.recommended.fit.name == "lambertian+ggx"
    imitator = next(row for row in found.rows if row.fit.model.name.endswith(":3"))
    assert "imitates" in [warning.code for warning in imitator.warnings]


def test_every_row_of_a_comparison_carries_held_out_errors_and_growth():
    data = plastic(noise=0.02, seed=5, channels=3)
    found = compare.compare(data, map(models.get, ("lambertian+ward", "lambertian+ggx")))
    assert isinstance(found, ranking.Ranking)
    for row in found.rows:
        assert np.isfinite(row.held_out.rms_ln) and row.growth["r_mirror"] > 0
