"""Two angles of emergence against the law that has two lengths."""

from math import sqrt

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError, NoAnswer
from brdfguide.physics.emergence import OMEGA, crossing
from brdfguide.physics.geometry import Geometry
from brdfguide.physics.grained_emergence import both_lengths, most_difference
from brdfguide.report.documents.grained_emergence import grained_document

from ..cli.test_advice import answer, run

PAIRS = [(80, 78, 0.3), (80, 79.4, 0.1), (75, 73.5, 0.3), (60, 59.2, 0.5), (85, 84, 0.2)]


def balance(sigma, slope, ratio, azimuth_deg, theta_deg):
    """Mirror over diffuse light in the pupil, of `he-torrance-aniso` with its axis at azimuth 0."""
    geom = Geometry.from_degrees([theta_deg], [azimuth_deg], [theta_deg], [azimuth_deg + 180])
    model = models.term("he-torrance-aniso")
    values = {"sigma": sigma, "slope": slope, "ratio": ratio, "axis": 0.0, "n": 1.5, "k": 0.0, "scale": 1.0}
    return float(model.mirror(geom, **values)[0] / (model(geom, **values)[0] * geom.cos_r[0] * OMEGA))


@pytest.mark.parametrize("along, across, slope", PAIRS)
def test_the_law_with_two_lengths_is_balanced_at_both_angles(along, across, slope):
    sigma, tau_x, tau_y = both_lengths(along, across, slope=slope)
    assert sigma / tau_x == pytest.approx(slope, rel=1e-12)
    assert balance(sigma, slope, tau_y / tau_x, 0, across) == pytest.approx(1, rel=1e-8)
    assert balance(sigma, slope, tau_y / tau_x, 90, along) == pytest.approx(1, rel=1e-8)


def test_a_known_height_gives_both_lengths_back():
    sigma, tau_x, tau_y = both_lengths(80, 78, slope=0.3)
    assert both_lengths(80, 78, sigma=sigma) == pytest.approx((sigma, tau_x, tau_y), rel=1e-8)


def test_one_angle_is_a_surface_without_a_grain():
    sigma, tau_x, tau_y = both_lengths(75, 75, slope=0.1)
    assert (sigma, tau_x) == pytest.approx(crossing(75, 0.1), rel=1e-12)
    assert tau_x == tau_y


def test_a_difference_that_shadowing_cannot_make_is_refused_with_the_slope_that_can():
    with pytest.raises(NoAnswer, match="at most 0.78 deg; from a slope of 0.2 on"):
        both_lengths(81.9, 80, slope=0.1)
    assert most_difference(80, 0.2) > 1.9 > most_difference(80, 0.1)
    with pytest.raises(NoAnswer, match="no slope up to 1 makes it 10"):
        both_lengths(80, 70, slope=0.1)


def test_angles_the_wrong_way_round_are_named():
    with pytest.raises(NoAnswer, match="were the two exchanged"):
        both_lengths(78, 80, slope=0.3)


def test_the_interval_of_the_ratio_narrows_with_the_reading():
    wide, narrow = (
        grained_document(80, 78, slope=0.3, angle_error=error)["grain"]["ratio_interval"] for error in (0.2, 0.02)
    )
    assert wide[0] < narrow[0] < 3.221 < narrow[1] < wide[1]
    assert grained_document(80, 78, slope=0.3)["grain"]["ratio_interval"] == [1.0, None]


def test_the_command_says_what_the_law_takes():
    found = answer("roughness", "--angle", "80", "--angle-across", "78", "--slope", "0.3")
    grain = found["grain"]
    assert found["criterion"]["tau_um"] == pytest.approx(sqrt(grain["tau_across_um"] * grain["tau_along_um"]))
    assert np.isclose(grain["ratio"], 3.2208, rtol=1e-4)
    assert "he-torrance-aniso.ratio=3.221" in run("roughness", "--angle=80", "--angle-across=78", "--slope=.3").stdout


@pytest.mark.parametrize("angle, across, more", [(80, 0, {}), (90, 80, {}), (80, 78, {"slope": 0.1, "sigma_um": 1.0})])
def test_a_wrong_question_is_refused(angle, across, more):
    with pytest.raises(InputError):
        grained_document(angle, across, **more)
