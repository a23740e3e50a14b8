"""An arm whose zero is off is found by exchanging light and detector, and taken off; copied scans are named."""

import numpy as np
import pytest

from brdfguide import fit, models
from brdfguide.data import examine, scans
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import fit as fitting
from brdfguide.physics.geometry import in_plane, rows

from .. import surfaces

INCIDENCES = np.array([8.0, 25.0, 45.0, 62.0])
LOBE = (0.25, 0.14, 0.04)  # albedo, width, reflectance at normal incidence


def measured(zero: float = 0.0, step: float = 3.0, noise: float = 0.01, seed: int = 0, lobe=LOBE) -> Measurement:
    """Scans whose reported angles are too large by `zero` [deg]."""
    theta_i, theta_r = (each.ravel() for each in np.meshgrid(INCIDENCES, np.arange(-75.0, 75.1, step), indexing="ij"))
    values = surfaces.value(rows(in_plane(theta_i, theta_r - zero)), *lobe)
    values *= np.exp(noise * np.random.default_rng(seed).standard_normal(values.shape))
    return Measurement(rows(in_plane(theta_i, theta_r)), values, ("550 nm",))


@pytest.mark.parametrize("zero", [2.0, -1.5, 3.0])
def test_the_zero_of_an_arm_is_found_without_a_model_seed_0(zero):
    (found,) = scans.scan_findings(measured(zero))
    assert dict(found.numbers)["zero_deg"] == pytest.approx(zero, abs=0.25)
    assert "also near the normal" in found.text and "the goniometer's zero" in found.text


def test_a_fit_is_without_the_zero_seed_1():
    found = fit(examine.prepared(measured(2.0, seed=1)), "lambertian+ggx").recommended
    as_reported = fitting.fit(models.get("lambertian+ggx"), measured(2.0, seed=1))
    assert found.values["ggx.alpha"] == pytest.approx(0.14, rel=0.02) and found.rms_ln < 0.05 < as_reported.rms_ln


@pytest.mark.parametrize("lobe", [LOBE, (0.0, 0.4, 0.8), (0.03, 0.35, 0.04), (0.6, 0.08, 0.04)])
def test_a_surface_whose_peaks_lie_off_by_themselves_is_not_accused_seed_2(lobe):
    assert scans.scan_findings(measured(0.0, seed=2, lobe=lobe)) == ()


def test_scans_that_repeat_another_are_one_measurement_seed_3():
    offset = np.arange(-24.0, 24.1, 2.0)
    theta_i = np.repeat([5.0, 30.0, 60.0], len(offset))
    one = 0.05 + np.exp(-((offset / 9) ** 2)) * np.exp(0.01 * np.random.default_rng(3).standard_normal(len(offset)))
    copied = Measurement(rows(in_plane(theta_i, theta_i + np.tile(offset, 3))), np.tile(one, 3)[:, None], ("550 nm",))
    (found,) = scans.scan_findings(copied)
    assert "digit for digit about the mirror direction: at 30 and 60 that at 5 degrees" in found.text
    answer = fit(examine.prepared(copied), ["lambertian+ggx", "lambertian+phong"])
    assert all(row.held_out is None and row.growth is None for row in answer.rows)
