"""An arm whose zero is off is found by exchanging light and detector, and taken off; copied scans are left out."""

import numpy as np
import pytest

from brdfguide import fit, models
from brdfguide.data import examine, scans
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import fit as fitting
from brdfguide.models.surface import Surface
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


def repeating(lobe, incidences=(5.0, 30.0, 60.0), half=80.0) -> Measurement:
    """Scans with the same values about the mirror direction, as far as they stay above the horizon."""
    offset = np.arange(-half, half + 0.1, 2.0)
    values = lobe(offset)
    rows_of = [np.abs(each + offset) < 85.0 for each in incidences]
    theta_i = np.concatenate(
        [np.full(np.count_nonzero(kept), each) for each, kept in zip(incidences, rows_of, strict=True)]
    )
    away = np.concatenate([offset[kept] for kept in rows_of])
    brdf = np.concatenate([values[kept] for kept in rows_of])[:, None]
    return Measurement(rows(in_plane(theta_i, theta_i + away)), brdf, ("550 nm",))


def plastic_at_5_degrees(seed: int):
    def lobe(offset):
        values = surfaces.value(rows(in_plane(np.full_like(offset, 5.0), 5.0 + offset)), 0.1, 0.2, 0.04)[:, 0]
        return values * np.exp(0.01 * np.random.default_rng(seed).standard_normal(len(offset)))

    return lobe


def test_scans_that_repeat_another_are_left_out_seed_3():
    copied = repeating(plastic_at_5_degrees(3))
    (found,) = scans.scan_findings(copied)
    assert "digit for digit about the mirror direction: at 30 and 60 that at 5 degrees" in found.text
    whole = examine.prepared(copied)
    assert [*whole.theta_i_groups] == [5.0]
    assert {"copied-scans", "one-incidence"} <= {each.code for each in whole.findings if each.severity == "warning"}


def test_the_law_is_that_of_what_was_measured_seed_3():
    """Without copies, which deny Fresnel's rise: coats and flakes at their bounds were preferred to the truth."""
    answer = fit(repeating(plastic_at_5_degrees(3)))
    best = answer.recommended
    assert best.name == "lambertian+ggx" and best.rms_ln < 0.02
    assert best.values["ggx.alpha"] == pytest.approx(0.2, rel=0.05)


def test_what_repeats_one_scan_leaves_the_others_seed_4():
    copied, true = repeating(plastic_at_5_degrees(4)), measured(seed=4)
    geom = rows(in_plane(*(
        np.concatenate([getattr(each.geom, name)[:, 0] for each in (copied, true)])
        for name in ("theta_i_deg", "signed_theta_r_deg")
    )))  # fmt: skip
    both = Measurement(geom, np.concatenate([copied.brdf, true.brdf]), ("550 nm",))
    answer = fit(examine.prepared(both), "lambertian+ggx").ranking.recommended
    assert sorted(answer.rms_ln_by_theta_i) == [5.0, *INCIDENCES] and answer.held_out and answer.growth


@pytest.mark.parametrize("name", ["lambertian+lafortune", "lambertian+phong-lewis", "lambertian+blinn"])
@pytest.mark.parametrize("digits", [3, 4, 15])
def test_a_law_that_repeats_itself_about_the_mirror_direction_is_no_copy(name, digits):
    model = models.get(name)
    theta_i, theta_r = (each.T.ravel() for each in np.meshgrid([10.0, 30.0, 60.0], np.arange(-80.0, 80.1, 2.0)))
    geom = rows(in_plane(theta_i, theta_r))
    values = Surface(model, model.defaults(), ("550 nm",)).brdf(geom)[:, 0]
    told = np.array([float(f"{each:.{digits}g}") for each in values])[:, None]
    assert not any(each.code == "copied-scans" for each in scans.scan_findings(Measurement(geom, told, ("550 nm",))))
