"""Values near the instrument's dark level: looked at on their own scale, and no error is told over them."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine, formats
from brdfguide.fitting import fit as fitting
from brdfguide.fitting import weights
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.objective import Misfit, metric
from brdfguide.report.documents.fit import fit_document
from brdfguide.report.text.ranking import ranking_text

from ..data.test_dark_level import with_dark_level
from ..data.test_noise_model import dim_run

MODEL = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": 0.005, "ggx.alpha": 0.12, "ggx.n": 1.5}


def off(fit, truth) -> float:
    """The greatest distance from the truth in printed errors."""
    return max(
        float(np.max(np.abs(np.asarray(fit.values[key]) - value) / np.asarray(fit.stderr[key])))
        for key, value in truth.items()
    )


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("absolute", [0.0005, 0.002])
def test_parameters_lie_within_their_errors_where_half_the_values_are_noise(seed, absolute):
    measurement = examine.prepared(dim_run(0.02, absolute, seed))
    assert measurement.noise.matters
    assert off(fitting.fit(MODEL, measurement), TRUTH) < 3.5


@pytest.mark.parametrize("seed", range(3))
def test_plain_ln_follows_the_noise_there(seed):
    run = dim_run(0.02, 0.002, seed, albedo=0.001)
    plain = fitting.fit(MODEL, run)
    known = fitting.fit(MODEL, examine.prepared(run))
    wrong = [abs(fit.values["lambertian.albedo"][0] - 0.001) for fit in (plain, known)]
    assert wrong[1] < 0.5 * wrong[0]


def test_slopes_are_those_of_the_generalised_logarithm():
    measurement = examine.prepared(dim_run(0.02, 0.002, 1))
    layout = Layout(MODEL, 1)
    misfit = Misfit(layout, measurement, metric("ln"), np.ones_like(measurement.brdf))
    shared, own = layout.encode(TRUTH)
    _, by_shared, by_own = misfit(shared, own, True)
    step = 1e-6
    for place in range(len(shared)):
        ends = [misfit(shared + sign * step * (np.arange(len(shared)) == place), own, False) for sign in (1, -1)]
        np.testing.assert_allclose(by_shared[0, :, place], (ends[0] - ends[1])[:, 0] / (2 * step), atol=2e-5)
    for place in range(own.shape[1]):
        ends = [misfit(shared, own + sign * step * (np.arange(own.shape[1]) == place), False) for sign in (1, -1)]
        np.testing.assert_allclose(by_own[0, :, place], (ends[0] - ends[1])[:, 0] / (2 * step), rtol=2e-4, atol=2e-5)


def test_a_model_darker_than_the_dark_level_is_not_blamed_for_it():
    """Below a tenth of the doubt nothing changes by more than a hundredth of what a factor of e costs where bright."""
    measurement = examine.prepared(dim_run(0.02, 0.002, 1))
    layout = Layout(MODEL, 1)
    misfit = Misfit(layout, measurement, metric("ln"), np.ones_like(measurement.brdf))
    dim = ~measurement.clear[:, 0]
    bodies = [misfit(*layout.encode({**TRUTH, "lambertian.albedo": albedo}), False) for albedo in (0.0, 0.0002 * np.pi)]
    assert np.max(np.abs(bodies[0] - bodies[1])[dim]) < 0.1


def test_weights_by_standard_error_are_those_of_the_scale():
    run = dim_run(0.02, 0.002, 1)
    doubted = replace(run, stderr=np.hypot(0.02 * np.abs(run.brdf), 0.002))
    measurement = examine.prepared(doubted)
    found = weights.of_values(measurement, "stderr")
    size = np.hypot(measurement.brdf, 2 * measurement.noise.floor)
    seen = np.sqrt(found) * measurement.stderr / size  # of every residual, if the errors are what they claim
    assert np.std(seen[measurement.weighed]) < 1e-9 * np.mean(seen[measurement.weighed])


@pytest.mark.parametrize("share", [0.3, -0.3])
def test_a_dark_level_that_was_taken_out_leaves_the_surface(share):
    spoilt = with_dark_level("black rubber", share)[0]
    clean = examine.prepared(with_dark_level("black rubber", 0.0)[0])
    one, other, plain = (fitting.fit(MODEL, each) for each in (clean, examine.prepared(spoilt), spoilt))
    assert other.rms_ln - one.rms_ln < 0.2 * (plain.rms_ln - one.rms_ln)
    for key in TRUTH:
        gap = abs(float(np.ravel(one.values[key])[0]) - float(np.ravel(other.values[key])[0]))
        assert gap < 3 * float(np.ravel(other.stderr[key])[0])


def test_errors_are_told_over_what_is_clear_of_the_dark_level(data):
    from brdfguide.fitting.compare import compare

    measurement = examine.prepared(formats.read(data / "cornell" / "garnet_red.brdf", wavelength=[450, 550, 650]))
    ranked = compare(measurement, [models.get(name) for name in ("lambertian+ggx", "lambertian+ward")])
    best = ranked.rows[0].fit
    np.testing.assert_array_equal(np.isfinite(best.residuals), measurement.clear)
    assert best.rms_ln == pytest.approx(np.sqrt(np.mean(best.residuals[measurement.clear] ** 2)))
    document = fit_document(ranked, measurement)
    assert document["noise"]["values_told"] == np.count_nonzero(measurement.clear) < measurement.brdf.size
    assert document["noise"]["relative"] == measurement.noise.relative
    assert document["ranking"][0]["off_percent"] == pytest.approx(100 * np.expm1(best.rms_ln), rel=1e-3)
    text = ranking_text(document)
    assert f"typically {100 * np.expm1(best.rms_ln):.0f} % off" in text
    assert "errors are told over the" in text


def test_the_reports_own_laboratory_is_followed_where_its_values_are_clear(data):
    """rms ln over the values above 0.01/sr, 3 degrees or more from the mirror direction, one lobe: 0.23 without."""
    measurement = formats.read(data / "cornell" / "garnet_red.brdf", wavelength=[450, 550, 650])
    fit = fitting.fit(MODEL, examine.prepared(measurement))
    away = np.degrees(np.sqrt(measurement.geom.mirror_distance2)) >= 3
    bright = measurement.usable & away & (measurement.brdf > 0.01)
    ratio = np.log(fit.surface.brdf(measurement.geom)[bright] / measurement.brdf[bright])
    assert np.sqrt(np.mean(ratio**2)) < 0.18
