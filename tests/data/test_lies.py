"""Files that lie: each lie is noticed on every surface where it can be, and undone where it is certain."""

import numpy as np
import pytest

from brdfguide.data import examine, formats
from brdfguide.data.measurement import Measurement

from .. import synthetic
from ..surfaces import SURFACES, dome_run, in_plane_run, table, value

BRIGHT = ["white paint", "plaster", "satin plastic", "bead-blasted steel", "egg-shell white", "rough gold"]
GLOSSY = ["white paint", "rough gold", "satin plastic", "bead-blasted steel", "egg-shell white", "black rubber"]


def read(tmp_path, text, **options):
    path = tmp_path / "run.csv"
    path.write_text(text)
    return formats.read(path, **options)


def believed(tmp_path, text, **options):
    return examine.corrected(read(tmp_path, text, **options))


def codes(measurement):
    return {finding.code for finding in (*measurement.findings, *examine.examine(measurement))}


def same(measurement, values, rtol=1e-6):
    """Whether the values came back, in the file's order."""
    np.testing.assert_allclose(measurement.brdf[:, 0], values, rtol=rtol)


@pytest.mark.parametrize("name", SURFACES)
def test_honest_dome_run_is_left_alone(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=1)
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, f))
    same(measurement, f)
    assert not codes(measurement) & {
        "cosine-weighted",
        "reflectance-factor",
        "mirror-side-turned",
        "floor",
        "retro-reflector",
        "not-reciprocal",
        "too-bright",
        "cosine-i-weighted",
        "dim-values-off",
        "dark-level",
    }


@pytest.mark.parametrize("name", SURFACES)
def test_honest_in_plane_run_is_left_alone(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=2)
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, f))
    same(measurement, f)
    np.testing.assert_allclose(measurement.geom.signed_theta_r_deg[:, 0], theta_r, atol=1e-6)
    assert not codes(measurement) & {
        "cosine-weighted",
        "reflectance-factor",
        "mirror-side-turned",
        "floor",
        "retro-reflector",
        "not-reciprocal",
        "too-bright",
        "cosine-i-weighted",
        "dim-values-off",
        "dark-level",
    }


@pytest.mark.parametrize("name", BRIGHT)
def test_factor_pi_is_noticed_and_undone(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=3)
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, np.pi * f))
    assert "reflectance-factor" in codes(measurement)
    same(measurement, f)


def test_factor_pi_on_a_black_surface_is_undone_when_the_column_says_so(tmp_path):
    theta_i, theta_r, phi, f = dome_run("black rubber", seed=3)
    measurement = believed(
        tmp_path, table(("theta_i", "theta_r", "phi_r", "reflectance factor"), theta_i, theta_r, phi, np.pi * f)
    )
    assert "quantity-stated" in codes(measurement)
    same(measurement, f)


@pytest.mark.parametrize("name", SURFACES)
def test_cosine_weight_is_noticed_and_undone(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=4)
    measurement = believed(
        tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, f * np.cos(np.radians(theta_r)))
    )
    assert "cosine-weighted" in codes(measurement)
    same(measurement, f)


@pytest.mark.parametrize("name", SURFACES)
def test_cosine_weight_in_the_plane_is_noticed_and_undone(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=5)
    measurement = believed(
        tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, f * np.cos(np.radians(theta_r)))
    )
    same(measurement, f)


@pytest.mark.parametrize("name", BRIGHT)
def test_values_not_divided_by_the_irradiance_are_noticed_and_undone(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=17)
    measurement = believed(
        tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, f * np.cos(np.radians(theta_i)))
    )
    assert "cosine-i-weighted" in codes(measurement)
    same(measurement, f)


def test_a_cosine_that_the_reflectance_does_not_tell_is_named_and_not_taken_for_a_dark_level(tmp_path):
    theta_i, theta_r, phi, f = dome_run("black rubber", seed=17)
    weighted = f * np.cos(np.radians(theta_i))
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, weighted))
    same(measurement, weighted)
    found = {each.code: each for each in examine.examine(measurement)}
    assert "as BRDF times cos theta_i would" in found["not-reciprocal"].text
    assert found["not-reciprocal"].option == "--quantity brdf-cos-i" and "dark-level" not in codes(measurement)


def test_what_was_taken_off_too_much_in_the_plane_is_not_divided_by_a_cosine():
    geom = synthetic.scan()
    clean = value(geom, *SURFACES["plaster"])[:, 0] * np.exp(0.01 * np.random.default_rng(3).standard_normal(len(geom)))
    values = clean[:, None] - 0.3 * np.quantile(clean, 0.25) / geom.cos_i
    measurement = Measurement(geom, np.where(values > 0, values, np.nan), ("value",))
    assert codes(measurement) & {"dark-level", "dim-values-off", "not-reciprocal"}
    assert not codes(measurement) & {"cosine-weighted", "cosine-i-weighted"}


@pytest.mark.parametrize("name", SURFACES)
@pytest.mark.parametrize("share", [0.3, -0.3])
def test_a_wrong_dark_level_is_noticed_and_not_taken_for_a_cosine(tmp_path, name, share):
    theta_i, theta_r, phi, f = dome_run(name, seed=18)
    offset = share * np.quantile(f, 0.25) / np.cos(np.radians(theta_i))
    measurement = believed(
        tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, np.maximum(f + offset, 0.0))
    )
    assert codes(measurement) & {"dark-level", "dim-values-off", "not-reciprocal"}
    assert not codes(measurement) & {"cosine-weighted", "cosine-i-weighted"}


@pytest.mark.parametrize("name", BRIGHT)
def test_cosine_and_pi_together_are_undone(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=6)
    measurement = believed(
        tmp_path,
        table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, np.pi * f * np.cos(np.radians(theta_r))),
    )
    same(measurement, f)


@pytest.mark.parametrize("name", GLOSSY)
def test_flipped_sign_is_noticed_and_undone(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=7)
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, -theta_r, f))
    assert "mirror-side-turned" in codes(measurement)
    np.testing.assert_allclose(measurement.geom.signed_theta_r_deg[:, 0], theta_r, atol=1e-6)


@pytest.mark.parametrize("name", GLOSSY)
def test_azimuth_counted_from_the_mirror_is_noticed_and_undone(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=8)
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi - 180, f))
    assert "mirror-side-turned" in codes(measurement)


@pytest.mark.parametrize("name", SURFACES)
def test_zenith_called_phi_is_noticed_and_undone(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=9)
    zero = 0 * theta_i
    text = table(("phi_i", "theta_i", "phi_o", "theta_o", "brdf"), theta_i, zero + 180, theta_r, zero, f)
    measurement = believed(tmp_path, text)
    assert "phi-is-zenith" in codes(measurement)
    np.testing.assert_allclose(measurement.geom.signed_theta_r_deg[:, 0], theta_r, atol=1e-6)


@pytest.mark.parametrize("name", SURFACES)
def test_incidence_and_reflection_exchanged_changes_nothing(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=10)
    right = believed(tmp_path, table(("theta_i", "theta_r", "dphi", "brdf"), theta_i, theta_r, phi, f))
    wrong = believed(tmp_path, table(("theta_i", "theta_r", "dphi", "brdf"), theta_r, theta_i, phi, f))
    np.testing.assert_allclose(wrong.geom.tan2_h, right.geom.tan2_h, rtol=1e-9, atol=1e-12)
    same(wrong, f)


@pytest.mark.parametrize("name", SURFACES)
def test_zeros_about_the_source_are_blocked_not_black(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=11)
    blocked = np.abs(theta_r + theta_i) <= 12
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, np.where(blocked, 0.0, f)))
    assert "blocked-retro-zone" in codes(measurement)
    np.testing.assert_array_equal(np.isnan(measurement.brdf[:, 0]), blocked)


@pytest.mark.parametrize("sign", [1, -1])
def test_flat_white_reflectance_factors_with_a_blocked_source_are_understood(tmp_path, sign):
    theta_i, theta_r = (
        a.ravel() for a in np.meshgrid([15.0, 30.0, 45.0, 60.0], np.arange(-80.0, 81.0, 5.0), indexing="ij")
    )
    white = np.where(
        np.abs(theta_r + theta_i) <= 15,
        0.0,
        0.95 * np.exp(0.005 * np.random.default_rng(3).standard_normal(len(theta_r))),
    )
    text = table(("Incident_angle", "Measure_angle", " 390nm ", " 400nm "), theta_i, sign * theta_r, white, white)
    measurement = believed(tmp_path, text)
    assert {"blocked-retro-zone", "reflectance-factor"} <= codes(measurement)
    np.testing.assert_allclose(measurement.geom.signed_theta_r_deg[:, 0], theta_r, atol=1e-6)
    np.testing.assert_allclose(np.nanmean(measurement.brdf), 0.95 / np.pi, rtol=0.01)


@pytest.mark.parametrize("name", SURFACES)
def test_zeros_at_grazing_are_missing(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=12)
    lost = np.abs(theta_r) > 72
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, np.where(lost, 0.0, f)))
    assert "zeros-missing" in codes(measurement)
    np.testing.assert_array_equal(np.isnan(measurement.brdf[:, 0]), lost)


@pytest.mark.parametrize("name", SURFACES)
def test_floor_at_grazing_is_missing(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=13)
    lost = np.abs(theta_r) > 72
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, np.where(lost, 1e-4, f)))
    assert "floor" in codes(measurement)
    np.testing.assert_array_equal(np.isnan(measurement.brdf[:, 0]), lost)


@pytest.mark.parametrize("name", ["rough gold", "bead-blasted steel", "black rubber", "satin plastic", "white paint"])
def test_values_cut_off_at_a_floor_are_missing(tmp_path, name):
    theta_i, theta_r, f = in_plane_run(name, seed=14)
    floor = np.quantile(f, 0.1)
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, np.maximum(f, floor)))
    assert "floor" in codes(measurement)
    np.testing.assert_array_equal(np.isnan(measurement.brdf[:, 0]), f <= floor)


@pytest.mark.parametrize("name", SURFACES)
def test_radians_are_recognised(tmp_path, name):
    theta_i, theta_r, phi, f = dome_run(name, seed=15)
    measurement = believed(
        tmp_path, table(("theta_i", "theta_r", "phi_r", "brdf"), *np.radians([theta_i, theta_r, phi]), f)
    )
    assert "radians-inferred" in codes(measurement)
    np.testing.assert_allclose(measurement.geom.theta_i_deg[:, 0], theta_i, atol=1e-4)


def test_what_the_user_says_is_not_overruled(tmp_path):
    theta_i, theta_r, phi, f = dome_run("plaster", seed=16)
    text = table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, f * np.cos(np.radians(theta_r)))
    measurement = believed(tmp_path, text, quantity="brdf")
    same(measurement, f * np.cos(np.radians(theta_r)))
    theta_i, theta_r, f = in_plane_run("rough gold", seed=16)
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, f), mirror_side="negative")
    np.testing.assert_allclose(measurement.geom.signed_theta_r_deg[:, 0], -theta_r, atol=1e-6)


@pytest.mark.parametrize("seed", range(3))
def test_lies_about_real_white_samples_are_undone(data, tmp_path, seed):
    clean = formats.read(data / "nist" / "PTFE.data.csv")
    channel = seed
    geom, f = clean.geom, clean.brdf[:, channel]
    columns = (geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0], geom.phi_deg[:, 0])
    header = ("theta_i", "theta_r", "phi_r", "brdf")
    same(believed(tmp_path, table(header, *columns, f)), f)
    same(believed(tmp_path, table(header, *columns, np.pi * f)), f)
    same(believed(tmp_path, table(header, *columns, geom.cos_r[:, 0] * f)), f)


def test_the_users_word_on_the_mirror_side_wins_over_the_values_in_every_format(tmp_path):
    """A FRED file whose values lie on the other side: turned, unless the user says that it is as the format has it."""
    theta_i, theta_r, phi, f = dome_run("satin plastic", seed=8)
    blocks = ["type bsdf_data", "format angles=deg bsdf=value scale=1"]
    for incidence in np.unique(theta_i):
        blocks.append(f"{incidence:g} 0")
        here = theta_i == incidence
        blocks += [f"{r:g} {p:g} {v:.6g}" for r, p, v in zip(theta_r[here], phi[here], f[here], strict=True)]
    text = "\n".join(blocks) + "\n"
    assert "mirror-side-turned" in codes(believed(tmp_path, text))
    for word in ("positive", "phi=180"):
        measurement = believed(tmp_path, text, mirror_side=word)
        assert "mirror-side-by-option" in codes(measurement) and "mirror-side-turned" not in codes(measurement)


@pytest.mark.parametrize("mark", [-999.0, -99999.0, 1e30, 9.96921e36])
def test_marks_for_missing_are_neither_noise_nor_values(tmp_path, mark):
    theta_i, theta_r, f = in_plane_run(next(iter(SURFACES)), seed=12)
    lost = np.arange(len(f)) % 7 == 0
    measurement = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, np.where(lost, mark, f)))
    assert "marks-missing" in codes(measurement)
    np.testing.assert_array_equal(np.isnan(measurement.brdf[:, 0]), lost)
    turned = believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, -theta_r, np.where(lost, mark, f)))
    assert "mirror-side-turned" in codes(turned)  # marks on both sides are no light
    noise = -0.1 * f.max() * np.random.default_rng(1).uniform(0.5, 1, len(f))  # where hardly any light comes back
    few = np.where(lost, noise, f)
    assert "marks-missing" not in codes(
        believed(tmp_path, table(("theta_i", "theta_r", "brdf"), theta_i, theta_r, few))
    )
