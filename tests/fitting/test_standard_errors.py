"""Whether the printed intervals hold the truth, and whether a wrong model is known by its traces."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.fitting import fit
from brdfguide.fitting.layout import Layout

from .. import synthetic

GGX, COOK = models.get("lambertian+ggx"), models.get("lambertian+cook-torrance")
SETS = 16


@pytest.mark.parametrize("name", ["lambertian+ward", "lambertian+ggx", "lambertian+lafortune"])
def test_intervals_hold_the_truth_as_often_as_they_say_with_seeds_0_to_15(name):
    """200 sets each are in benchmarks/recovery.py; here 16, and a binomial bound of three standard deviations.

    A lobe that nothing shows (exponent 600 within 45° of the normal) must be called so, and is then not counted.
    """
    model, inside, count, off = models.get(name), 0, 0, []
    for seed in range(SETS):
        random = np.random.default_rng([seed, 21])
        values = synthetic.random_values(Layout(model, 3), random)
        data = synthetic.surface(
            model, synthetic.scan(step=5), values, noise=random.uniform(0.02, 0.05), seed=seed, channels=3
        )
        found = fit.fit(model, synthetic.with_gaps(data, seed))
        assert found.converged
        if any(warning.code in ("undetermined", "starts-disagree") for warning in found.warnings):
            assert name.endswith("lafortune") and found.rms_ln < 0.055
            continue
        for key, stderr in found.stderr.items():
            z = (np.atleast_1d(found.values[key]) - values[key]) / stderr
            inside, count, off = inside + np.count_nonzero(np.abs(z) < 1.96), count + z.size, off + list(z)
    assert count >= 0.7 * SETS * 7
    spread = 3 * np.sqrt(0.95 * 0.05 * count)
    assert abs(inside - 0.95 * count) < spread
    assert abs(np.median(off)) < 4 / np.sqrt(count)


@pytest.mark.parametrize("channels", [1, 3])
@pytest.mark.parametrize("geometry", ["scan", "hemisphere"])
def test_a_wrong_lobe_is_known_by_its_traces_and_the_right_one_is_not_accused_with_seeds_0_to_9(geometry, channels):
    geom = synthetic.scan() if geometry == "scan" else synthetic.hemisphere(600)
    for seed in range(10):
        random = np.random.default_rng([seed, 22])
        values = {
            "lambertian.albedo": random.uniform(0.05, 0.6),
            "ggx.alpha": random.uniform(0.1, 0.5),
            "ggx.n": random.uniform(1.3, 2.0),
        }
        data = synthetic.surface(GGX, geom, values, noise=0.02, seed=seed, channels=channels)
        assert fit.fit(COOK, data).has("discrepancy")
        assert not fit.fit(GGX, data).has("discrepancy")


def test_discrepancy_says_how_far_off_the_model_is():
    data = synthetic.surface(
        GGX, synthetic.scan(), {"lambertian.albedo": 0.2, "ggx.alpha": 0.3, "ggx.n": 1.5}, noise=0.02, seed=1
    )
    found = fit.fit(COOK, data)
    numbers = dict(next(each for each in found.warnings if each.code == "discrepancy").numbers)
    assert numbers["systematic_rms_ln"] == pytest.approx(np.sqrt(found.rms_ln**2 - 0.02**2), rel=0.15)


def test_channels_that_err_together_widen_the_interval_of_what_they_share():
    random = np.random.default_rng(9)
    data = synthetic.surface(
        GGX, synthetic.scan(), {"lambertian.albedo": 0.3, "ggx.alpha": 0.25, "ggx.n": 1.5}, channels=3
    )
    apart = data.brdf * np.exp(0.03 * random.standard_normal(data.brdf.shape))
    together = data.brdf * np.exp(0.03 * random.standard_normal((len(data.brdf), 1)))
    independent = fit.fit(GGX, replace(data, brdf=apart)).stderr["ggx.alpha"]
    assert fit.fit(GGX, replace(data, brdf=together)).stderr["ggx.alpha"] == pytest.approx(
        np.sqrt(3) * independent, rel=0.25
    )


def test_twice_the_noise_gives_twice_the_interval():
    errors = []
    for noise in (0.01, 0.02):
        data = synthetic.surface(
            GGX, synthetic.scan(), {"lambertian.albedo": 0.3, "ggx.alpha": 0.25, "ggx.n": 1.5}, noise=noise, seed=4
        )
        errors.append(fit.fit(GGX, data).stderr["ggx.alpha"])
    assert errors[1] / errors[0] == pytest.approx(2, rel=0.1)


@pytest.mark.parametrize("channels", [1, 3])
def test_a_wrong_model_says_how_far_other_directions_would_have_moved_it_with_seeds_0_to_19(channels):
    """Its residuals are no noise; s²(JᵀJ)⁻¹ alone, with all its widening, is 2.7 times too narrow in alpha here."""
    values = {"lambertian.albedo": 0.2, "ggx.alpha": 0.25, "ggx.n": 1.5}
    fits = [
        fit.fit(
            COOK,
            synthetic.surface(GGX, synthetic.hemisphere(600, seed), values, noise=0.02, seed=seed, channels=channels),
        )
        for seed in range(20)
    ]
    for key in fits[0].stderr:
        scatter = np.std([np.mean(each.values[key]) for each in fits])
        assert scatter < 2 * np.median([np.mean(each.stderr[key]) for each in fits]), key
