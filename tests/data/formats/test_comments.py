"""What comments say of the values' scale and wavelength, and whose word counts."""

import numpy as np
import pytest

from brdfguide.data import formats, reciprocity
from brdfguide.data.measurement import Measurement
from brdfguide.physics.geometry import Geometry, rows


def read(tmp_path, *comments: str, **options):
    path = tmp_path / "run.csv"
    body = "".join(f"30,{r},{100 + r}\n" for r in range(-80, 81, 20))
    path.write_text("".join(f"# {text}\n" for text in comments) + "theta_i,theta_r,brdf\n" + body)
    return formats.read(path, **options)


def codes(measurement) -> dict:
    return {finding.code: finding for finding in measurement.findings}


@pytest.mark.parametrize("comment", ["scale: 0.001", "Scale factor = 1e-3"])
def test_a_scale_among_the_comments_is_taken(tmp_path, comment):
    measurement = read(tmp_path, comment)
    np.testing.assert_allclose(measurement.brdf[:, 0], 1e-3 * read(tmp_path).brdf[:, 0])
    assert "scale of 0.001: values multiplied by it" in codes(measurement)["scale-stated"].text


@pytest.mark.parametrize("comment", ["scale: 50 um", "colour scale: 255", "scale: log", "scale: 1"])
def test_what_is_no_scale_of_the_values_is_left_alone(tmp_path, comment):
    np.testing.assert_array_equal(read(tmp_path, comment).brdf, read(tmp_path).brdf)


def test_the_user_word_on_the_scale_comes_before_the_comment(tmp_path):
    measurement = read(tmp_path, "scale: 0.001", scale=0.01)
    np.testing.assert_allclose(measurement.brdf, 0.01 * read(tmp_path).brdf)
    assert "scale-by-option" in codes(measurement) and "scale-stated" not in codes(measurement)


def test_a_comment_that_names_another_wavelength_is_doubted(tmp_path):
    doubt = codes(read(tmp_path, "wavelength_nm: 633", wavelength_nm=550.0))["wavelength-overruled"]
    assert doubt.severity == "warning" and "the comments say 633 nm, --wavelength-nm says 550" in doubt.text
    assert "wavelength-overruled" not in codes(read(tmp_path, "wavelength_nm: 550", wavelength_nm=550.0))


def test_a_grained_sample_is_exchanged_with_the_light_where_the_detector_stood():
    """f(i, r) depends on both azimuths and is reciprocal; without them its exchanges seem to differ."""
    theta, phi = np.array([15.0, 35, 55, 70]), np.arange(0.0, 360, 45)
    grid = np.meshgrid(theta, phi, theta, phi, indexing="ij")
    theta_i, phi_i, theta_r, phi_r = (each.ravel() for each in grid)
    grain = 2 + np.cos(2 * np.radians(phi_i)) * np.sin(np.radians(theta_i))
    grain = grain * (2 + np.cos(2 * np.radians(phi_r)) * np.sin(np.radians(theta_r)))
    geom = rows(Geometry.from_degrees(theta_i, phi_i, theta_r, phi_r))
    found = reciprocity.test(Measurement(geom, 0.1 * grain[:, None], name="grained"))
    assert found.pairs > 100 and found.ratio == pytest.approx(1.0, abs=1e-6)
