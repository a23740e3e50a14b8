"""One model, one measurement: what is searched for, what is said, and whether the truth comes back."""

import re
from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.fitting import fit, weights
from brdfguide.fitting.fit import FitOptions
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.objective import METRICS, Misfit, metric
from brdfguide.models import candidates

from .. import synthetic

PLASTIC = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.22, "ggx.n": 1.5}
CANDIDATES = [fit.candidate_label(model) for model in candidates.of_kind()]
BY_NAME = {fit.candidate_label(model): model for model in candidates.of_kind()}


def plastic(**options):
    return synthetic.surface(PLASTIC, synthetic.scan(), TRUTH, **options)


def with_stderr(measurement, relative):
    return replace(measurement, stderr=measurement.brdf * relative)


# --- layout -----------------------------------------------------------------------------------------


def test_shapes_are_shared_and_amplitudes_belong_to_channels():
    layout = Layout(PLASTIC, 3)
    assert layout.shared == ("ggx.alpha",)
    assert set(layout.per_channel) == {"lambertian.albedo", "ggx.n"}
    assert layout.count == 1 + 3 * 2


def test_every_channel_may_have_its_own_shape():
    layout = Layout(PLASTIC, 3, shape_per_channel=True)
    assert layout.shared == () and layout.count == 9


def test_values_survive_the_way_to_coordinates_and_back_with_seed_3():
    for model in BY_NAME.values():
        layout = Layout(model, 3)
        values = synthetic.random_values(layout, np.random.default_rng(3))
        back = layout.decode(*layout.encode(values))
        for key in layout.parameters:
            np.testing.assert_allclose(back[key], values[key], rtol=1e-12)


@pytest.mark.parametrize("scale", METRICS)
@pytest.mark.parametrize("name", ["lambertian+ggx", "lambertian+lafortune:2", "he-torrance (metal)"])
def test_slopes_of_the_residuals_agree_with_differences_with_seed_4(name, scale):
    layout = Layout(BY_NAME[name], 2)
    values = synthetic.random_values(layout, np.random.default_rng(4), inner=0.3)
    data = synthetic.surface(BY_NAME[name], synthetic.scan((20, 60), step=10), values, noise=0.3, seed=4, channels=2)
    misfit = Misfit(layout, data, metric(scale), np.ones_like(data.brdf))
    shared, per_channel = layout.encode(values)
    _, j_shared, j_per_channel = misfit(shared, per_channel, True)
    for place in range(len(shared)):
        step = 1e-6 * np.eye(len(shared))[place]
        slope = (misfit(shared + step, per_channel, False) - misfit(shared - step, per_channel, False)) / 2e-6
        np.testing.assert_allclose(j_shared[:, :, place].T, slope, rtol=2e-5, atol=2e-7 * np.abs(slope).max())
    for place in range(per_channel.shape[1]):
        step = 1e-6 * np.eye(per_channel.shape[1])[place]
        slope = (misfit(shared, per_channel + step, False) - misfit(shared, per_channel - step, False)) / 2e-6
        np.testing.assert_allclose(j_per_channel[:, :, place].T, slope, rtol=2e-5, atol=2e-7 * np.abs(slope).max())


# --- recovery ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", CANDIDATES)
def test_every_candidate_recovers_its_own_parameters_from_the_grid_with_seed_7(name):
    layout = Layout(BY_NAME[name], 3)
    values = synthetic.random_values(layout, np.random.default_rng(7), inner=0.25)
    found = fit.fit(BY_NAME[name], synthetic.surface(BY_NAME[name], synthetic.scan(), values, channels=3))
    assert found.converged and found.rms_ln < 1e-6
    order = [{}, {".1.": ".2.", ".2.": ".1."}] if ".1." in str(found.stderr) else [{}]
    assert any(
        all(np.allclose(found.values[key], values[turn_label(key, turn)], rtol=1e-4, atol=1e-7) for key in found.stderr)
        for turn in order
    )


def turn_label(key: str, turn: dict) -> str:
    return next((key.replace(one, other) for one, other in turn.items() if one in key), key)


@pytest.mark.parametrize("alpha", [0.012, 0.7])
def test_a_start_of_the_user_far_from_the_truth_does_no_harm(alpha):
    found = fit.fit(PLASTIC, plastic(), FitOptions(start={"ggx.alpha": alpha}))
    assert found.values["ggx.alpha"] == pytest.approx(0.22, rel=1e-5)


@pytest.mark.parametrize("start", [{"ggx.alpha": 0.9}, {"lambertian.albedo": 0.9}], ids=str)
def test_a_start_of_the_user_is_followed_and_not_only_weighed_against_the_grids(start):
    assert fit.fit(PLASTIC, plastic(), FitOptions(start=start)).evaluations > fit.fit(PLASTIC, plastic()).evaluations


@pytest.mark.parametrize("alpha", [0.013, 0.018, 0.026])
def test_a_narrow_bare_lobe_between_two_grid_values_is_found(alpha):
    metal = BY_NAME["cook-torrance (metal)"]
    values = {"cook-torrance.alpha": alpha, "cook-torrance.n": 1.0, "cook-torrance.k": 4.0}
    found = fit.fit(metal, synthetic.surface(metal, synthetic.scan(step=2), values, noise=0.03, seed=1))
    assert found.values["cook-torrance.alpha"] == pytest.approx(alpha, rel=0.02)


@pytest.mark.parametrize("scale", METRICS)
def test_every_scale_recovers_the_truth_from_exact_data(scale):
    found = fit.fit(PLASTIC, plastic(channels=3), FitOptions(metric=scale))
    assert found.values["ggx.alpha"] == pytest.approx(0.22, rel=1e-4)
    np.testing.assert_allclose(found.values["ggx.n"], 1.5, rtol=1e-4)


def test_fits_are_the_same_twice():
    data = plastic(noise=0.03, seed=2)
    one, other = fit.fit(PLASTIC, data), fit.fit(PLASTIC, data)
    assert one.values == other.values and one.rms_ln == other.rms_ln


def test_thirty_one_alike_channels_give_the_values_of_one():
    one = plastic(noise=0.03, seed=5)
    many = replace(
        one,
        geom=one.geom.at(np.linspace(0.4, 0.7, 31)),
        brdf=np.repeat(one.brdf, 31, axis=1),
        channels=tuple(map(str, range(31))),
    )
    alone, together = fit.fit(PLASTIC, one), fit.fit(PLASTIC, many)
    assert together.values["ggx.alpha"] == pytest.approx(alone.values["ggx.alpha"], rel=1e-5)
    np.testing.assert_allclose(together.values["ggx.n"], alone.values["ggx.n"] * np.ones(31), rtol=1e-5)
    # the same numbers 31 times are no news: the interval must not shrink
    assert together.stderr["ggx.alpha"] == pytest.approx(alone.stderr["ggx.alpha"], rel=0.1)


def test_channels_of_unlike_width_are_told_apart_when_asked():
    widths = np.array([0.15, 0.25, 0.4])
    data = synthetic.surface(PLASTIC, synthetic.scan(), {**TRUTH, "ggx.alpha": widths}, channels=3)
    found = fit.fit(PLASTIC, data, FitOptions(shape_per_channel=True))
    np.testing.assert_allclose(found.values["ggx.alpha"], widths, rtol=1e-5)
    assert fit.fit(PLASTIC, data).rms_ln > 0.05


def test_two_lobes_that_changed_places_are_no_disagreement():
    model = models.get("lambertian+lafortune:2")
    lobes = {"lambertian.albedo": 0.2, "lafortune.1.ks": 0.5, "lafortune.1.tilt": 0.8, "lafortune.1.exponent": 60.0}
    lobes |= {"lafortune.2.ks": 0.1, "lafortune.2.tilt": 0.9, "lafortune.2.exponent": 6.0}
    found = fit.fit(model, synthetic.surface(model, synthetic.scan(), lobes, noise=0.01, seed=1))
    assert not found.has("starts-disagree")


# --- what the user decides ----------------------------------------------------------------------------


def test_a_fixed_value_stays_and_is_not_counted():
    found = fit.fit(PLASTIC, plastic(noise=0.02), FitOptions(fixed={"n": 1.6}))
    assert np.all(found.values["ggx.n"] == 1.6)
    assert "ggx.n" not in found.stderr and found.free == 2


def test_a_fixed_name_that_no_candidate_has_is_refused():
    with pytest.raises(InputError, match="parameter of any candidate"):
        fit.fit_all([PLASTIC], plastic(), FitOptions(fixed={"roughnes": 0.3}))


def test_outliers_hardly_move_a_robust_fit():
    data = plastic(noise=0.02, seed=8)
    spoiled = replace(data, brdf=data.brdf.copy())
    spoiled.brdf[np.random.default_rng(8).choice(len(data.brdf), 20, replace=False)] *= 8
    plain, robust = fit.fit(PLASTIC, spoiled), fit.fit(PLASTIC, spoiled, FitOptions(robust=True))
    assert abs(robust.values["ggx.alpha"] - 0.22) < 0.01 < abs(plain.values["ggx.alpha"] - 0.22)
    assert robust.values["lambertian.albedo"] == pytest.approx([0.3], rel=0.02)


def test_standard_errors_decide_the_weights():
    data = with_stderr(plastic(noise=0.02, seed=1), 0.02)
    np.testing.assert_allclose(weights.of_values(data), 1.0, rtol=1e-12)
    data.stderr[::2] *= 2
    found = weights.of_values(data)
    np.testing.assert_allclose(found[1::2] / found[::2], 4.0, rtol=1e-12)
    assert np.mean(found) == pytest.approx(1)


def test_weights_by_standard_errors_need_some():
    with pytest.raises(InputError, match="no standard errors"):
        fit.fit(PLASTIC, plastic(), FitOptions(weights="stderr"))


def test_unknown_weighting_and_metric_name_the_choices():
    with pytest.raises(InputError, match="auto, none, stderr, sampling"):
        fit.fit(PLASTIC, plastic(), FitOptions(weights="equal"))
    with pytest.raises(InputError, match="cube-root"):
        fit.fit(PLASTIC, plastic(), FitOptions(metric="log"))


# --- what is missing, and doubts ------------------------------------------------------------------------


def test_censored_values_are_left_out_and_change_nothing_else():
    data = plastic(channels=3)
    data.brdf[::7, 0], data.brdf[::11, 1], data.brdf[5] = 0.0, np.nan, -1e-3
    missing = np.count_nonzero(~(data.brdf > 0))
    found = fit.fit(PLASTIC, data)
    assert data.censored == missing
    assert np.count_nonzero(np.isnan(found.residuals)) == missing
    assert found.values["ggx.alpha"] == pytest.approx(0.22, rel=1e-6)


def test_nothing_positive_is_an_error_that_says_so():
    data = plastic()
    data.brdf[:] = 0.0
    with pytest.raises(InputError, match="no positive value"):
        fit.fit(PLASTIC, data)


def test_a_value_at_its_bound_is_flagged():
    metal = BY_NAME["cook-torrance (metal)"]
    rougher = BY_NAME["ggx (metal)"]
    data = synthetic.surface(rougher, synthetic.scan(), {"ggx.alpha": 1.4, "ggx.n": 1.0, "ggx.k": 4.0}, noise=0.01)
    assert fit.fit(metal, data).has("at-bound", "cook-torrance.alpha")
    assert not fit.fit(rougher, data).has("at-bound", "ggx.alpha")


def test_an_index_that_near_normal_data_cannot_give_is_called_undetermined():
    body = {"lambertian.albedo": 0.9, "ggx.alpha": 0.6, "ggx.n": 1.02}
    data = synthetic.surface(PLASTIC, synthetic.scan((5,), step=10), body, noise=0.05, seed=3)
    found = fit.fit(PLASTIC, data)
    assert found.has("undetermined", "ggx.n") or found.has("undetermined", "ggx.alpha")
    clear = fit.fit(PLASTIC, plastic(noise=0.02))
    assert not any(warning.code == "undetermined" for warning in clear.warnings)


def test_sigma_and_slope_of_a_rough_surface_leave_a_ridge_that_is_named():
    he = BY_NAME["he-torrance (metal)"]
    values = {"he-torrance.sigma": 20.0, "he-torrance.slope": 0.2, "he-torrance.n": 1.0, "he-torrance.k": 4.0}
    rough = fit.fit(he, synthetic.surface(he, synthetic.scan(), values, noise=0.02, seed=1))
    said = " ".join(warning.text for warning in rough.warnings)
    assert "sigma" in said and "determined" in said
    assert not rough.has("undetermined", "he-torrance.slope")
    assert rough.values["he-torrance.slope"] == pytest.approx(0.2, rel=2e-3)


def test_scale_and_index_near_normal_incidence_are_called_a_combination():
    freed = replace(PLASTIC, free=("ggx.scale",))
    data = synthetic.surface(PLASTIC, synthetic.scan((5, 10)), TRUTH, noise=0.02, seed=6)
    found = fit.fit(freed, data[np.abs(data.geom.signed_theta_r_deg[:, 0]) < 41])
    ridge = next(warning.text for warning in found.warnings if warning.code == "ridge")
    assert "ggx.n" in ridge and "ggx.scale" in ridge and "ggx.alpha" not in ridge
    power, value, percent = map(float, re.search(r"F0 of ggx \* ggx.scale\^(\S+) = (\S+), to (\S+) %", ridge).groups())
    assert power == pytest.approx(1, abs=0.1)  # F0 scatters by 5 % over seeds, n between 1.004 and 35
    assert abs(value / 0.04 - 1) < 3 * percent / 100 and 3 < percent < 12
    wide = fit.fit(freed, synthetic.surface(PLASTIC, synthetic.scan(), TRUTH, noise=0.02, seed=6))
    assert not wide.has("ridge")


def test_a_ridge_gives_the_product_that_is_determined():
    """In the middle of Ward's lobe only its height shows, which is rho_s/alpha^2 times what the cosines do."""
    ward, truth = models.get("ward"), {"ward.alpha": 0.8, "ward.rho_s": 0.3}
    data = synthetic.surface(ward, synthetic.scan((10, 30, 50), step=0.2), truth, noise=0.02, seed=2)
    found = fit.fit(ward, data[data.geom.mirror_distance2[:, 0] < np.radians(1.5) ** 2])
    ridge = next(warning.text for warning in found.warnings if warning.code == "ridge")
    power, value, percent = map(
        float, re.search(r"ward.alpha \* ward.rho_s\^(\S+) = (\S+), to (\S+) %", ridge).groups()
    )
    assert power == pytest.approx(-0.5, abs=0.01)
    assert abs(value / (0.8 * 0.3**power) - 1) < 4 * percent / 100 < 0.05


def test_a_parameter_at_its_bound_is_no_ridge():
    found = fit.fit(
        models.get("oren-nayar+ggx"), synthetic.surface(PLASTIC, synthetic.scan(), TRUTH, noise=0.02, seed=4)
    )
    assert found.has("at-bound", "oren-nayar.spread") and not found.has("ridge")


def test_residuals_csv_has_a_row_for_each_value_and_its_own_ratio():
    from brdfguide.report.documents.values import residuals
    from brdfguide.report.text.values import residuals_csv

    data = plastic(noise=0.02, channels=3)
    data.brdf[3, 1] = np.nan
    found = fit.fit(PLASTIC, data)
    lines = residuals_csv(residuals(found, data)).splitlines()
    assert len(lines) == 2 + data.brdf.size - 1
    theta_i, theta_r, phi, _, wavelength, value, model, ratio = (cell for cell in lines[2].split(","))
    assert float(ratio) == pytest.approx(np.log(float(model) / float(value)), abs=1e-6)
    assert (float(theta_i), float(theta_r), float(wavelength)) == (10, 80, 450)
