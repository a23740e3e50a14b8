"""What values tell of a grain: its ellipse, that a round sample is round, and symmetries that no single grain has."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine, turning
from brdfguide.data.height_against_width import reflectance_needed
from brdfguide.data.lobe_ellipse import lobe_ellipse
from brdfguide.data.measurement import Measurement
from brdfguide.physics.geometry import Geometry, rows

METAL = {"n": 0.958, "k": 6.69}


def scans(law, turns, *, seed=None, noise=0.01, incidences=(10.0, 30.0, 45.0, 60.0), **values):
    """Scans in the plane of incidence at these azimuths of the light; with a seed also noisy."""
    angles = np.unique(np.concatenate([np.arange(-75.0, 81, 5), *(t + np.arange(-12, 13, 1.5) for t in incidences)]))
    turn, theta_i, theta_r = (a.ravel() for a in np.meshgrid(turns, incidences, angles[angles < 81], indexing="ij"))
    geom = rows(Geometry.from_degrees(theta_i, turn, np.abs(theta_r), turn + np.where(theta_r < 0, 0, 180)))
    brdf = models.term(law)(geom, **METAL, **values)
    if seed is not None:
        brdf = brdf * (1 + noise * np.random.default_rng(seed).normal(size=brdf.shape))
    return Measurement(geom, brdf, name=law)


def codes(measurement):
    return {each.code: each for each in examine.examine(measurement)}


@pytest.mark.parametrize("axis", [0.0, 37.0, 90.0, 178.0])
@pytest.mark.parametrize("law", ["ggx-aniso", "beckmann-aniso"])
def test_ratio_and_axis_come_from_the_values_alone(law, axis):
    turns = [0.0, 30, 60, 90, 120, 150]
    measurement = scans(law, turns, seed=81, alpha_x=0.3, alpha_y=0.1, axis=np.radians(axis))
    ellipse = lobe_ellipse(measurement)
    off = np.remainder(np.degrees(ellipse.axis) - axis + 90, 180) - 90
    assert abs(off) < 1.5 and ellipse.ratio == pytest.approx(3.0, rel=0.12)
    found = codes(measurement)
    assert {"anisotropic", "grain"} <= found.keys() and "isotropic" not in found
    assert dict(found["grain"].numbers)["ratio"] == ellipse.ratio


def test_a_round_sample_is_round():
    measurement = scans("ggx", [0.0, 30, 60, 90], seed=82, alpha=0.2)
    found = codes(measurement)
    assert "isotropic" in found and not {"grain", "anisotropic"} & found.keys()
    assert lobe_ellipse(measurement).ratio < 1.05


def test_a_grain_over_a_body_is_not_called_the_same_from_all_sides():
    """Most of the light is the body's, and turning changes values by 11 % (rms)."""
    law = models.get("lambertian+ggx-aniso")
    values = {"lambertian.albedo": 0.25, "ggx-aniso.alpha_x": 0.28, "ggx-aniso.alpha_y": 0.14}
    clean = scans("ggx", [0.0, 45, 90, 135], alpha=0.2)
    brdf = law(clean.geom, law.defaults() | values | {"ggx-aniso.n": 1.5, "ggx-aniso.axis": np.radians(120.0)})
    noisy = brdf * (1 + 0.015 * np.random.default_rng(83).normal(size=brdf.shape))
    found = codes(Measurement(clean.geom, noisy))
    assert "grain" in found and not {"isotropic", "anisotropic"} & found.keys()


def test_the_scans_of_a_grain_are_no_lobe_toward_the_source():
    """Across it values near the source are the lobe's; along it there are none, and the surroundings are dark."""
    widths = {"alpha_x": 0.12 * 3**0.5, "alpha_y": 0.12 / 3**0.5, "axis": np.radians(23.0)}
    turned = scans(
        "beckmann-aniso", [0.0, 30, 60, 90, 120, 150], seed=84, incidences=(10.0, 25.0, 40.0, 55.0), **widths
    )
    found = codes(turned[turned.brdf[:, 0] > 1e-4])
    assert "grain" in found and not {"retro-peak", "retro-reflector"} & found.keys()


def test_a_lobe_back_to_the_light_is_no_grain():
    grid = np.meshgrid([10.0, 30, 50], np.arange(0, 75, 3.0), np.arange(0, 360, 15.0))
    theta_i, theta_r, phi = (each.ravel() for each in grid)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))
    away = np.degrees(np.arccos(np.clip(geom.dot_xy + geom.cos_cos, -1, 1)))
    tape = Measurement(geom, 0.05 + 8 * np.exp(-((away / 6) ** 2)))
    assert lobe_ellipse(tape) is None and "grain" not in codes(tape)


def test_two_turns_tell_both_widths_and_not_the_axis():
    measurement = scans("ggx-aniso", [0.0, 90.0], seed=83, alpha_x=0.08, alpha_y=0.3, axis=0.0)
    ellipse = lobe_ellipse(measurement)
    assert not ellipse.axis_known and np.degrees(ellipse.axis) == pytest.approx(90.0)
    assert ellipse.ratio == pytest.approx(3.75, rel=0.15)
    assert "the axis is taken along the wider of both scans" in codes(measurement)["grain"].text


def test_half_a_turn_that_changes_values_is_told():
    """Facets that lean: the peak lies off the mirror direction, to one side of the sample."""
    measurement = scans("ggx-aniso", [0.0, 45, 90, 135, 180, 225, 270, 315], alpha_x=0.3, alpha_y=0.1)
    lean = 1 + 0.6 * np.cos(np.radians(measurement.geom.phi_i_deg))
    blazed = Measurement(measurement.geom, measurement.brdf * lean)
    assert "grain-one-way" in codes(blazed) and "grain-one-way" not in codes(measurement)


def test_a_weave_comes_back_after_a_quarter_of_a_turn():
    turns = [0.0, 45, 90, 135, 180]
    one = scans("ggx-aniso", turns, alpha_x=0.4, alpha_y=0.05)
    other = scans("ggx-aniso", turns, alpha_x=0.4, alpha_y=0.05, axis=0.5 * np.pi)
    woven = Measurement(one.geom, 0.5 * (one.brdf + other.brdf))
    assert "grain-period" in codes(woven) and "grain-period" not in codes(one)


def test_a_grain_half_way_between_two_turns_is_no_weave():
    """Under 0 and 90 degrees it is the same, and under 45 another: one quarter of a turn does not tell."""
    values = {"alpha_x": 0.35, "alpha_y": 0.07, "axis": np.radians(135.5)}
    assert "grain-period" not in codes(scans("ggx-aniso", [0.0, 45, 90], seed=87, **values))
    assert "grain-period" not in codes(scans("ggx-aniso", [0.0, 45, 90, 135], seed=87, **values))


@pytest.mark.parametrize(("turn", "needed"), [(0.0, 5.0), (90.0, 0.2)])
def test_the_height_of_one_scan_against_its_width(turn, needed):
    """Across the grain a peak is ratio times as high as a mirror's of that width, along it as much lower."""
    measurement = scans("beckmann-aniso", [turn], alpha_x=0.3, alpha_y=0.06)
    assert reflectance_needed(measurement) == pytest.approx(0.92 * needed, rel=0.2)
    assert ("height-against-width" in codes(measurement)) == (needed > 1.5)


def test_no_height_is_doubted_of_a_surface_without_a_grain():
    for alpha in (0.05, 0.3):
        assert reflectance_needed(scans("ggx", [0.0], alpha=alpha)) < 1.3
    assert reflectance_needed(scans("ggx-aniso", [0.0, 90.0], alpha_x=0.3, alpha_y=0.06)) is None  # it was turned


def test_a_turn_is_known_by_the_azimuth_of_the_light_half_a_turn_being_none():
    geom = scans("ggx", [10.0, 190.0, 100.0], alpha=0.2).geom
    turns = turning.turn_of_each(geom)
    np.testing.assert_array_equal(np.unique(turns), [0, 1])
    assert turning.turn_of_each(scans("ggx", [10.0, 190.0], alpha=0.2).geom) is None
    assert [len(each.geom) for each in turning.turned_parts(scans("ggx", [0.0, 90.0], alpha=0.2))] == [
        len(geom) // 3
    ] * 2


def test_one_direction_read_again_and_again_tells_no_height():
    theta = np.repeat([10.0, 20.0, 30.0], 12)
    measurement = Measurement(rows(Geometry.from_degrees(theta, 0.0, theta, 180.0)), np.linspace(1, 9, 36)[:, None])
    assert reflectance_needed(measurement) is None
