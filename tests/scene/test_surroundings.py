"""Surroundings in closed form: what falls on a plane, what each shows where, and which way up they stand."""

from math import pi

import numpy as np
import pytest

from brdfguide.numerics import sphere
from brdfguide.physics import colour
from brdfguide.scene.surroundings import KINDS, Surroundings


def direction(azimuth_deg, elevation_deg):
    return sphere.from_angles(np.sin(np.radians(elevation_deg)), np.radians(azimuth_deg))


def all_round(rows=240):
    height = (np.arange(rows) + 0.5) / rows * 2 - 1
    azimuth = (np.arange(2 * rows) + 0.5) * pi / rows
    grid = sphere.from_angles(height[:, None], azimuth[None, :]).reshape(-1, 3)
    return grid, 4 * pi / len(grid)


@pytest.mark.parametrize("kind", KINDS)
def test_irradiance_is_that_of_the_brightest_side_and_no_plane_gets_more(kind):
    grid, share = all_round()
    level = Surroundings(kind, 2.0).radiance(grid) * share
    sides = np.concatenate([all_round(8)[0], [[0.0, 0.0, 1.0]]])
    received = np.maximum(sides @ grid.T, 0.0) @ level
    assert received.max() <= 2.0 * 1.01
    assert received.max() > 2.0 * 0.95  # the sides tried are eleven degrees apart


def test_overcast_sky_is_three_times_as_bright_overhead_as_at_the_horizon():
    sky = Surroundings("overcast")
    high, low = sky.radiance(direction(0, [90.0, 1e-6]))
    assert high == pytest.approx(3 * low, rel=1e-6)
    # irradiance on level ground is 7π/9 of the radiance overhead
    assert high * 7 * pi / 9 == pytest.approx(1, rel=1e-3)
    assert sky.radiance(direction(30, -40)) == pytest.approx(0.2 / pi, rel=1e-3)  # of a ground that reflects a fifth


def test_studio_has_a_horizon_and_soft_boxes():
    studio = Surroundings("studio")
    wall, floor = studio.radiance(direction(0, [0.5, -0.5]))
    assert wall > 2 * floor
    box, beside = studio.radiance(direction(-50, [42.0, 75.0]))
    assert box > 10 * beside
    assert box == pytest.approx(studio.brightest, rel=0.05)


def test_room_has_one_window_with_a_cross_in_its_frame():
    room = Surroundings("room")
    pane, bar, opposite = room.radiance(np.stack([direction(-81, 12), direction(-73.3, 12), direction(90, 12)]))
    assert pane > 10 * opposite
    assert bar < 0.1 * pane


@pytest.mark.parametrize("kind", KINDS)
def test_colours_have_the_luminance_that_scenes_count_with(kind):
    grid = all_round(20)[0]
    of = Surroundings(kind, 1.5)
    assert of.rgb(grid) @ colour.LUMINANCE == pytest.approx(of.radiance(grid))
    assert np.all(of.radiance(grid) > 0)
    assert of.radiance(np.eye(3)).shape == (3,)  # along an axis no wall is missed


def test_a_wall_faces_azimuth_0_and_a_table_faces_up():
    normal = np.array([0.0, 0.0, 1.0])
    wall = Surroundings("room", up_deg=(90.0, 0.0))
    assert wall.of_object @ normal == pytest.approx([1, 0, 0])
    assert wall.of_object @ [1, 0, 0] == pytest.approx([0, 0, 1])
    assert Surroundings("room").of_object @ normal == pytest.approx([0, 0, 1])
    turned = Surroundings("room", turn_deg=90.0)
    assert turned.of_object @ [1, 0, 0] == pytest.approx([0, 1, 0])
    for each in (wall, turned):
        assert np.linalg.det(each.of_object) == pytest.approx(1)
