"""Every law that is tried only by name: a fit to noisy data made by itself finds what made them, within its errors."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.fitting import fit
from brdfguide.physics.geometry import in_plane, rows

from .. import synthetic

NOISE = 0.03
# expression -> what made the data, away from defaults and from the starts
MADE = {
    "lambertian+student-t": {"lambertian.albedo": 0.3, "student-t.alpha": 0.17, "student-t.g": 1.8, "student-t.n": 1.6},
    "lambertian+gtr": {"lambertian.albedo": 0.2, "gtr.alpha": 0.12, "gtr.gamma": 1.4, "gtr.n": 1.7},
    "lambertian+sgd": {"lambertian.albedo": 0.2, "sgd.alpha": 0.013, "sgd.p": 0.6, "sgd.n": 1.7},
    "ggx-ms": {"ggx-ms.alpha": 0.63, "ggx-ms.n": 2.6},
    "lambertian+low-smooth": {
        "lambertian.albedo": 0.1,
        "low-smooth.a": 40.0,
        "low-smooth.b": 130.0,
        "low-smooth.c": 1.3,
        "low-smooth.n": 1.45,
    },
    "lambertian+low-facet": {
        "lambertian.albedo": 0.1,
        "low-facet.a": 4.0,
        "low-facet.b": 230.0,
        "low-facet.c": 1.4,
        "low-facet.n": 1.6,
    },
    "stam": {"stam.sigma": 0.09, "stam.slope": 0.07, "stam.f0": 0.6},
    "abg": {"abg.a": 0.02, "abg.b": 0.003, "abg.g": 1.7},
    "harvey-shack": {"harvey-shack.b0": 8.0, "harvey-shack.l": 0.07, "harvey-shack.s": -1.8},
    "abc": {"abc.a": 2e-4, "abc.b": 6.0, "abc.c": 1.9},
    "coated:lambertian": {"lambertian.albedo": 0.63},
    "coated:lambertian+flakes": {"lambertian.albedo": 0.2, "flakes.flake": 0.35, "flakes.tilt": 0.13},
    "coated:flakes:beckmann": {"flakes-beckmann.flake": 0.5, "flakes-beckmann.tilt": 0.3},
    "coated:ggx": {"ggx.alpha": 0.15, "ggx.n": 3.1},
    "ggx+coated:lambertian": {"lambertian.albedo": 0.4, "ggx.alpha": 0.15, "coat.n": 1.63},
    "lambertian+retro": {"lambertian.albedo": 0.3, "retro.rho": 0.13, "retro.alpha": 0.23},
}


@pytest.mark.parametrize("expression", MADE)
def test_what_made_the_data_is_found_within_three_errors_with_seed_31(expression):
    surface, truth = models.get(expression), MADE[expression]
    made = {**surface.defaults(), **truth}
    measurement = synthetic.surface(surface, synthetic.hemisphere(600), made, noise=NOISE, seed=31, channels=3)
    found = fit.fit(surface, measurement)
    assert found.rms_ln == pytest.approx(NOISE, rel=0.1)
    assert truth.keys() == found.stderr.keys()
    for key in truth:
        miss = np.abs(np.asarray(found.values[key]) - truth[key])
        assert np.all(miss <= 3 * np.asarray(found.stderr[key])), (key, found.values[key], found.stderr[key])
        assert np.all(np.asarray(found.stderr[key]) < 0.3 * abs(truth[key])), f"{key} is not determined by these data"


@pytest.mark.parametrize("exponent", [600.0, 3000.0, 8000.0])
def test_a_narrow_mirror_lobe_is_found_with_seed_3(exponent):
    beside = np.array([0.2, 0.5, 0.8, 1.2, 1.6, 2.0, 3.0, 5.0, 10.0, 20.0, 40.0])
    incidence = np.array([[5.0], [30.0], [50.0], [65.0]])
    theta_r = incidence + np.r_[-beside, beside]
    kept = np.abs(theta_r) < 85
    geom = rows(in_plane(np.broadcast_to(incidence, theta_r.shape)[kept], theta_r[kept]))
    model = models.get("lambertian+lafortune")
    truth = {
        "lambertian.albedo": 0.3,
        "lafortune.ks": 50.0,
        "lafortune.tilt": np.pi / 4,
        "lafortune.exponent": exponent,
    }
    found = fit.fit_all([model], synthetic.surface(model, geom, truth, noise=0.02, seed=3))[0]
    assert found.rms_ln < 0.023
    assert found.values["lafortune.tilt"] == pytest.approx(np.pi / 4, abs=1e-4)
    assert found.values["lafortune.exponent"] == pytest.approx(exponent, rel=0.01)
