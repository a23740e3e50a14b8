"""A height that the data do not determine is reported as a bound, and one that they do as a number."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import fit as fitting
from brdfguide.physics.geometry import in_plane, rows
from brdfguide.report.text import ranked_table as text

SUM = models.get("lambertian+he-torrance")
SIGMA, SLOPE = "he-torrance.sigma", "he-torrance.slope"


def scan(sigma, slope, seed):
    """A scan in the plane of incidence with 3 % noise, made from the law itself."""
    theta_i, theta_r = np.meshgrid([0.0, 20.0, 40.0, 60.0, 75.0], np.arange(-80.0, 81.0, 4.0))
    geom = rows(in_plane(theta_i.ravel(), theta_r.ravel())).at(np.array([0.55]))
    f = SUM(geom, {"lambertian.albedo": 0.1, SIGMA: sigma, SLOPE: slope, "he-torrance.n": 1.5})
    return Measurement(geom, f * np.exp(0.03 * np.random.default_rng(seed).normal(size=f.shape)))


def bound(fit):
    return next((dict(w.numbers)["sigma_um_above"] for w in fit.warnings if w.printed == f"rough-regime:{SIGMA}"), None)


@pytest.mark.parametrize("sigma", [2.0, 20.0])
def test_only_a_lower_bound_is_given_where_any_larger_height_fits_seed_4(sigma):
    fit = fitting.fit(SUM, scan(sigma, 0.15, 4))
    assert fit.converged and 0.5 < bound(fit) < 2.0
    assert fit.values[SLOPE] == pytest.approx(0.15, rel=0.03)  # what is determined is found
    assert not fit.has("undetermined", SIGMA) and not fit.has("at-bound", SIGMA)


def test_the_bound_is_where_the_best_fit_starts_to_suffer_seed_4():
    """With sigma held at half the bound and everything else fitted anew the error grows; at twice the bound it does
    not.
    """
    data = scan(20.0, 0.15, 4)
    free = fitting.fit(SUM, data)

    def held(sigma):
        return fitting.fit(SUM, data, fitting.FitOptions(fixed={SIGMA: sigma})).rms_ln

    assert held(bound(free) / 2) > 1.02 * free.rms_ln
    assert held(bound(free) * 2) < 1.002 * free.rms_ln


def test_a_height_near_the_wavelength_is_found_as_a_number_seed_5():
    fit = fitting.fit(SUM, scan(0.3, 0.15, 5))
    assert bound(fit) is None
    assert abs(fit.values[SIGMA] - 0.3) < 4 * fit.stderr[SIGMA] < 0.06


def test_the_table_shows_the_bound_instead_of_a_false_number():
    entry = {"value": 50.0, "stderr": 4e4, "unit": "um", "at_bound": "high", "above": 1.03}
    assert text.value_text("sigma", entry) == "sigma >1 um"
