"""A detector of finite size: what it averages, and the mirror beam that falls into it."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.errors import InputError
from brdfguide.fitting import fit
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.reading import reading, with_slopes
from brdfguide.models.surface import Surface
from brdfguide.physics import aperture
from brdfguide.physics.geometry import Geometry, in_plane, rows

HE = models.get("he-torrance")
TRUE = {"he-torrance.sigma": 0.25, "he-torrance.slope": 0.12, "he-torrance.n": np.array([1.5])}


def scan(solid_angle) -> Measurement:
    theta_i, theta_r = np.repeat([10.0, 45.0, 75.0], 86), np.tile(np.arange(-85.0, 86.0, 2.0), 3)
    return Measurement(
        rows(in_plane(theta_i, theta_r, np.array([0.55]))), np.ones((len(theta_i), 1)), solid_angle=solid_angle
    )


def test_solid_angle_of_a_cone():
    assert aperture.solid_angle_of(1.0) == pytest.approx(2 * np.pi * (1 - np.cos(np.radians(1.0))), rel=1e-9)


@pytest.mark.parametrize("half_angle", (0.0, -1.0, 31.0, float("nan")))
def test_an_impossible_cone_is_refused(half_angle):
    with pytest.raises(InputError, match="half angle"):
        aperture.solid_angle_of(half_angle)


def test_the_seven_points_average_a_quadratic_over_the_cone_exactly():
    """The mean of cos² of the angle to a fixed direction, against a fine sum over the cap (seed 1)."""
    half = 2.0
    geom = Geometry.from_degrees([[40.0]], 0.0, [[50.0]], [[170.0]])
    mean = sum(
        weight * (view.mirror_distance2)
        for weight, view in aperture.Instrument(geom, aperture.solid_angle_of(half)).views
    )
    rng = np.random.default_rng(1)
    tilt = np.arccos(1 - rng.random(400_000) * (1 - np.cos(np.radians(half))))
    turn = rng.random(400_000) * 2 * np.pi
    theta, phi = np.radians(50.0), np.radians(170.0)
    axis = np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
    down = np.array([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), -np.sin(theta)])
    across = np.array([-np.sin(phi), np.cos(phi), 0.0])
    r = np.cos(tilt)[:, None] * axis + np.sin(tilt)[:, None] * (
        np.cos(turn)[:, None] * down + np.sin(turn)[:, None] * across
    )
    mirror = np.array([-np.sin(np.radians(40.0)), 0.0, np.cos(np.radians(40.0))])
    assert mean[0, 0] == pytest.approx(np.mean(np.sum((r - mirror) ** 2, axis=1)), rel=2e-3)


def test_a_point_detector_sees_the_law_itself():
    measurement = scan(None)
    assert np.array_equal(reading(Surface(HE, TRUE), measurement.instrument), HE(measurement.geom, TRUE))


def test_slopes_of_what_the_detector_sees_agree_with_differences():
    measurement = scan(aperture.solid_angle_of(1.5))
    layout = Layout(HE, 1)
    shared, per_channel = layout.encode(TRUE)
    _, slopes = with_slopes(layout, layout.surface(shared, per_channel, measurement), measurement.instrument)
    for place, key in enumerate(layout.shared):
        step = np.zeros(len(shared))
        step[place] = 1e-4
        moved = (layout.surface(shared + sign * step, per_channel, measurement) for sign in (1, -1))
        ends = [reading(surface, measurement.instrument) for surface in moved]
        difference = (ends[0] - ends[1]) / 2e-4
        assert slopes[key] == pytest.approx(difference, rel=1e-5, abs=1e-6 * np.abs(difference).max())


def test_a_spike_is_modelled_with_the_aperture_and_spoils_the_fit_without_seed_2():
    measurement = scan(aperture.solid_angle_of(1.5))
    seen = reading(Surface(HE, TRUE), measurement.instrument)
    measurement = replace(measurement, brdf=seen * np.exp(0.01 * np.random.default_rng(2).standard_normal(seen.shape)))
    with_it, without = fit.fit(HE, measurement), fit.fit(HE, replace(measurement, solid_angle=None))
    assert with_it.values["he-torrance.sigma"] == pytest.approx(0.25, rel=2e-3)
    assert with_it.rms_ln < 0.012 < 0.05 < without.rms_ln
    assert without.has("discrepancy") and not with_it.has("discrepancy")


def test_turning_sample_light_and_detector_together_changes_nothing_behind_an_aperture():
    """A law with a grain is asked in every direction of the cone in the sample's own frame."""
    theta_r, phi_r = np.array([35.0, 40.0, 48.0]), np.array([170.0, 180.0, 200.0])
    read = []
    for turn in (0.0, 50.0):
        surface = Surface(models.get("stam"), {"stam.ratio": 4.0, "stam.axis": np.radians(20.0 + turn)})
        geom = rows(Geometry.from_degrees(40.0, turn, theta_r, phi_r + turn))
        read.append(reading(surface, aperture.Instrument(geom, aperture.solid_angle_of(3.0))))
    assert read[1] == pytest.approx(read[0], rel=1e-9)
