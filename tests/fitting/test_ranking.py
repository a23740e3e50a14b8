"""Fits against each other: errors that deserve trust, differences that are real, ties."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.fitting import fit, ranking
from brdfguide.fitting.diagnostics import standard_errors
from brdfguide.fitting.fit import Fit
from brdfguide.fitting.residuals import ln_residuals
from brdfguide.models.surface import Surface

from .. import synthetic

GGX = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.22, "ggx.n": 1.5}


@dataclass(frozen=True)
class Cost:
    """Of a row that is made by hand."""

    work: float
    on_front: bool = True


def plastic(geom=None, **options):
    return synthetic.surface(GGX, synthetic.scan() if geom is None else geom, TRUTH, **options)


def as_fit(residuals, name="lambertian", free=1, values=None) -> Fit:
    model = models.get(name)
    return Fit(
        Surface(model, {**model.defaults(), **(values or {})}),
        {},
        residuals,
        float(np.sqrt(np.nanmean(residuals**2))),
        free,
        1,
        0.0,
        True,
    )


# --- scales of error ----------------------------------------------------------------------------------


def test_a_model_equal_to_the_data_has_no_error_on_any_scale():
    data = plastic()
    assert ranking.all_errors(np.zeros_like(data.brdf), data) == dict.fromkeys(
        ("ln", "cube-root", "relative", "cosine"), 0.0
    )


@pytest.mark.parametrize("gain", [1e-3, 7.0])
def test_units_change_no_error_on_any_scale(gain):
    data = plastic(noise=0.1, seed=1)
    residuals = 0.2 * np.random.default_rng(2).standard_normal(data.brdf.shape)
    before = ranking.all_errors(residuals, data)
    after = ranking.all_errors(residuals, replace(data, brdf=gain * data.brdf))
    for scale in before:
        assert after[scale] == pytest.approx(before[scale], rel=1e-12)


@pytest.mark.parametrize("gain", [0.25, 2.0])
def test_a_gain_of_the_instrument_moves_amplitudes_and_neither_shape_nor_error(gain):
    model = models.get("lambertian+ward")
    data = plastic(noise=0.02, seed=3)
    one, other = fit.fit(model, data), fit.fit(model, replace(data, brdf=gain * data.brdf))
    assert other.values["ward.alpha"] == pytest.approx(one.values["ward.alpha"], rel=1e-4)
    assert other.rms_ln == pytest.approx(one.rms_ln, rel=1e-6)
    np.testing.assert_allclose(other.values["ward.rho_s"], gain * one.values["ward.rho_s"], rtol=1e-4)


def test_measuring_the_same_surface_on_another_grid_changes_error_and_order_little():
    names = ("lambertian+ward", "lambertian+cook-torrance", "lambertian+ggx")
    orders, errors = [], []
    for step in (2.0, 3.0, 5.0):
        data = plastic(synthetic.scan(step=step), noise=0.01, seed=4)
        rows = ranking.rank(fit.fit_all(map(models.get, names), data), data).rows
        orders.append([row.fit.name for row in rows])
        errors.append([row.rms_ln for row in rows])
    assert orders[0] == orders[1] == orders[2]
    np.testing.assert_allclose(errors[0], errors[2], rtol=0.15)


@pytest.mark.parametrize("scale", ["ln", "cube-root", "relative", "cosine"])
def test_error_grows_as_the_lobe_of_the_model_widens(scale):
    data = plastic()
    errors = []
    for alpha in (0.22, 0.24, 0.27, 0.31, 0.36, 0.45):
        residuals = ln_residuals(synthetic.fitted(GGX, {**GGX.defaults(), **TRUTH, "ggx.alpha": alpha}, data), data)
        errors.append(ranking.all_errors(residuals, data)[scale])
    assert errors[0] < 1e-12 and all(one < other for one, other in pairwise(errors))


def test_error_by_incidence_adds_up_to_the_whole():
    data = plastic(noise=0.05, seed=2, channels=3)
    data.brdf[4] = np.nan
    residuals = ln_residuals(synthetic.fitted(GGX, {**GGX.defaults(), **TRUTH}, data), data)
    parts = ranking.by_theta_i(residuals, *ranking.incidence_bins(data))
    assert list(parts) == [10, 25, 40, 55, 65, 75]
    counts = [np.count_nonzero(np.isfinite(residuals[rows])) for rows in data.theta_i_groups.values()]
    total = sum(count * error**2 for count, error in zip(counts, parts.values(), strict=True))
    assert total == pytest.approx(np.nansum(residuals**2))


# --- which difference is real --------------------------------------------------------------------------


@pytest.mark.parametrize("geometry", ["scan", "hemisphere"])
def test_of_two_models_equally_wrong_the_difference_is_as_uncertain_as_it_says_with_seeds_0_to_399(geometry):
    """Two laws at equal distance on either side of the truth: behind/behind_se must scatter with unit width about 0."""
    geom = synthetic.scan() if geometry == "scan" else synthetic.hemisphere(600)
    data = plastic(geom)
    blocks = standard_errors.blocks_of(data, standard_errors.along_scans(data))
    truth = {**GGX.defaults(), **TRUTH}
    bend = ln_residuals(synthetic.fitted(GGX, {**truth, "ggx.alpha": 0.225}, data), data)
    scores = []
    for seed in range(400):
        noise = 0.03 * np.random.default_rng([seed, 31]).standard_normal(data.brdf.shape)
        behind, error = ranking.rms_difference(noise + 0.5 * bend, noise - 0.5 * bend, blocks)
        scores.append(behind / error)
    scores = np.array(scores)
    assert abs(scores.mean()) < 3 / np.sqrt(400)
    assert 0.85 < scores.std() < 1.2
    assert 0.92 <= np.mean(np.abs(scores) < 1.96) <= 0.98


def test_neighbours_that_err_together_do_not_make_a_difference_real_with_seeds_0_to_199():
    data = plastic(synthetic.scan(step=1.0))
    blocks = standard_errors.blocks_of(data, standard_errors.along_scans(data))
    bend = ln_residuals(synthetic.fitted(GGX, {**GGX.defaults(), **TRUTH, "ggx.alpha": 0.225}, data), data)
    scores = []
    for seed in range(200):
        # errors that are alike over some five neighbours, as of an instrument that drifts
        noise = np.random.default_rng([seed, 32]).standard_normal(len(data.brdf) + 4)
        noise = 0.03 * np.convolve(noise, np.ones(5), "valid")[:, None] / np.sqrt(5)
        behind, error = ranking.rms_difference(noise + 0.5 * bend, noise - 0.5 * bend, blocks)
        scores.append(behind / error)
    assert 0.8 < np.std(scores) < 1.35


def test_the_same_model_twice_ties_and_the_simpler_is_recommended():
    data = plastic(noise=0.02, seed=6)
    rows = ranking.rank(fit.fit_all([models.get("oren-nayar+ggx"), GGX], data), data)
    assert [row.tied for row in rows.rows] == [True, True] and [row.rank for row in rows.rows] == [1, 1]
    assert rows.recommended.fit.name == "lambertian+ggx"
    assert "told" in rows.because


def test_a_clear_difference_is_no_tie():
    data = plastic(noise=0.02, seed=7)
    rows = ranking.rank(fit.fit_all([models.get("lambertian+phong"), GGX], data), data).rows
    assert rows[0].fit.name == "lambertian+ggx" and not rows[1].tied
    assert rows[1].behind > 10 * rows[1].behind_se


def test_noise_is_estimated_whatever_the_model_leaves_over():
    data = plastic(synthetic.scan(step=2.0), noise=0.03, seed=8)
    for name in ("lambertian+ggx", "lambertian+cook-torrance"):
        found = fit.fit(models.get(name), data)
        assert ranking.noise_of(found.residuals[standard_errors.along_scans(data)]) == pytest.approx(0.03, rel=0.2)


def test_an_error_far_above_the_noise_is_said():
    data = plastic(synthetic.scan(step=2.0), noise=0.01, seed=9)
    rows = ranking.rank([fit.fit(models.get("lambertian+phong"), data)], data)
    assert [each.code for each in rows.warnings] == ["above-noise"]
    assert not ranking.rank([fit.fit(GGX, data)], data).warnings
    exact = plastic(synthetic.scan(step=2.0), noise=0.0, seed=9)
    (said,) = ranking.rank([fit.fit(models.get("lambertian+phong"), exact)], exact).warnings
    assert "far above the noise of a single value, less than 0.0001" in said.text


def test_a_winner_that_depends_on_the_scale_is_said():
    data = plastic()
    flank, peak = np.zeros_like(data.brdf), np.zeros_like(data.brdf)
    bright = data.brdf > np.quantile(data.brdf, 0.9)
    flank[~bright], peak[bright] = 0.2, 0.4  # one is off in the flanks, the other at the peak
    found = ranking.rank([as_fit(flank), as_fit(peak, "phong")], data)
    assert found.winners["ln"] == "phong" and found.winners["cosine"] == "lambertian"
    assert "metric-decides" in [each.code for each in found.warnings]


@pytest.mark.parametrize("seed", [0, 5])
def test_no_scale_decides_between_laws_that_leave_noise_alone(seed):
    """The truth and laws of which it is a case: which of them errs least on a scale is chance."""
    data = plastic(noise=0.05, seed=seed)
    others = map(models.get, ("oren-nayar+ggx", "lambertian+student-t"))
    found = ranking.rank(fit.fit_all([*others, GGX], data), data)
    assert len(set(found.winners.values())) > 1
    assert "metric-decides" not in [each.code for each in found.warnings]


def test_exact_values_have_the_simplest_law_that_gives_them_and_no_doubt():
    """Rounding alone is left, of which the one law has less than the other, alike over neighbours as any law's is."""
    for geom in (None, synthetic.hemisphere(400)):
        data = plastic(geom)
        found = ranking.rank(
            fit.fit_all(map(models.get, ("lambertian+student-t", "oren-nayar+ggx", "lambertian+ggx")), data), data
        )
        assert found.recommended is found.rows[0] and found.recommended.fit.model == GGX
        assert not found.warnings and not found.recommended.warnings
        assert {row.tied for row in found.rows} == {True} and set(found.winners.values()) == {"lambertian+ggx"}


def test_what_errs_hardly_more_on_another_scale_stands_on_it_too():
    data = plastic()
    flank, peak = np.zeros_like(data.brdf), np.zeros_like(data.brdf)
    bright = data.brdf > np.quantile(data.brdf, 0.9)
    flank[~bright], peak[bright] = 0.2, 0.2
    other = np.where(bright, 0.98, 1.01) * (flank + peak)  # less at the peak by a fiftieth
    found = ranking.rank([as_fit(flank + peak), as_fit(other, "phong")], data)
    assert len(set(found.winners.values())) == 2
    assert [each.code for each in found.warnings] == ["above-noise"]


def test_a_model_that_did_not_converge_is_not_recommended():
    data = plastic(noise=0.02, seed=1)
    good = fit.fit(GGX, data)
    bad = replace(fit.fit(models.get("oren-nayar+ggx"), data), rms_ln=0.5 * good.rms_ln, residuals=0.5 * good.residuals)
    bad = replace(bad, converged=False, warnings=(fit.Finding("not-converged", "still moving", "warning"),))
    found = ranking.rank([bad, good], data)
    assert found.rows[0].fit is bad and found.recommended.fit is good
    assert "cannot be trusted" in found.because


def test_the_front_holds_what_nothing_beats_in_error_and_time():
    data = plastic(noise=0.02, seed=2)
    rows = ranking.rank(
        fit.fit_all(
            map(models.get, ("lambertian", "lambertian+ward", "lambertian+ggx", "lambertian+he-torrance")), data
        ),
        data,
    ).rows
    for row in rows:
        beaten = any(other.rms_ln < row.rms_ln and other.ns_per_sample < row.ns_per_sample for other in rows)
        assert row.on_front != beaten


def test_an_unknown_scale_names_the_choices():
    with pytest.raises(InputError, match="ln, cube-root, relative, cosine"):
        fit.fit(GGX, plastic(), fit.FitOptions(metric="l2"))
