"""A mirror read by a detector of finite size."""

import numpy as np
import pytest

from brdfguide import models, optics, predict
from brdfguide.errors import InputError
from brdfguide.geometry import Geometry, in_plane

SURFACE = models.get("lambertian+mirror")
VALUES = {"lambertian.albedo": 0.3, "mirror.n": 1.5, "mirror.sigma": 0.02}


def test_spike_holds_the_energy_of_eq_1_inside_the_cone():
    omega = 1e-3
    radius = np.degrees(2 * np.arcsin(0.5 * np.sqrt(omega / np.pi)))  # of a cap of that solid angle
    inside, outside = in_plane(60, 60 + 0.99 * radius), in_plane(60, 60 + 1.01 * radius)
    rho = optics.davies(optics.fresnel(np.cos(np.pi / 3), 1.5), np.cos(np.pi / 3), 0.02, 0.55)
    assert predict.reading(SURFACE, inside, VALUES, omega) == pytest.approx(0.3 / np.pi + rho / (0.5 * omega), rel=1e-12)
    assert predict.reading(SURFACE, outside, VALUES, omega) == pytest.approx(0.3 / np.pi, rel=1e-12)


def test_surface_without_a_mirror_needs_no_solid_angle():
    surface = models.get("lambertian")
    assert predict.reading(surface, in_plane(10, 10), {"lambertian.albedo": 0.5}) == pytest.approx(0.5 / np.pi)


def test_mirror_without_a_solid_angle_is_refused_in_words():
    with pytest.raises(InputError, match="give the solid angle"):
        predict.reading(SURFACE, in_plane(60, 60), VALUES)
    with pytest.raises(InputError, match="not in 0..2π"):
        predict.reading(SURFACE, in_plane(60, 60), VALUES, -1.0)


def test_nothing_is_read_below_the_horizon():
    geom = Geometry.from_degrees([[95.0], [60.0]], 0.0, [[95.0], [91.0]], 180.0)
    assert np.all(predict.reading(SURFACE, geom, VALUES, 0.1) == 0.0)
