"""A mirror read by a detector of finite size."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.reading import keep, kept_of, reading, with_slopes
from brdfguide.models.surface import Surface
from brdfguide.physics import fresnel
from brdfguide.physics.aperture import Instrument
from brdfguide.physics.geometry import Geometry, in_plane, rows

VALUES = {"lambertian.albedo": 0.3, "mirror.n": 1.5, "mirror.sigma": 0.02}
SURFACE = Surface(models.get("lambertian+mirror"), VALUES)


def test_spike_holds_the_energy_of_eq_1_inside_the_cone():
    omega = 1e-3
    radius = np.degrees(2 * np.arcsin(0.5 * np.sqrt(omega / np.pi)))  # of a cap of that solid angle
    geom = rows(in_plane(60, np.array([60 + 0.99 * radius, 60 + 1.01 * radius])))
    rho = fresnel.davies(fresnel.fresnel(np.cos(np.pi / 3), 1.5), np.cos(np.pi / 3), 0.02, 0.55)
    inside, outside = reading(SURFACE, Instrument(geom, omega))[:, 0]
    assert inside == pytest.approx(0.3 / np.pi + rho / (0.5 * omega), rel=1e-12)
    assert outside == pytest.approx(0.3 / np.pi, rel=1e-12)


def test_a_point_reads_the_finite_part_alone():
    geom = rows(in_plane(60, np.array([60.0])))
    assert reading(SURFACE, Instrument(geom)) == pytest.approx(0.3 / np.pi, rel=1e-15)


@pytest.mark.parametrize("omega", (-1.0, 0.0, 7.0, float("nan")))
def test_an_impossible_solid_angle_is_refused_in_words(omega):
    with pytest.raises(InputError, match="not in 0..2π"):
        Instrument(in_plane(60, 60), omega)


def test_nothing_is_read_below_the_horizon():
    geom = Geometry.from_degrees([[95.0], [60.0]], 0.0, [[95.0], [91.0]], 180.0)
    assert np.all(reading(SURFACE, Instrument(geom)) == 0.0)


def test_what_is_kept_answers_for_these_values_at_these_directions_alone():
    model = models.get("lambertian+ggx")
    layout, surface = Layout(model, 1), Surface(model, {**model.defaults(), "ggx.alpha": 0.3}, ("550 nm",), 0.55)
    here = Instrument(rows(in_plane(30, np.linspace(-60, 60, 7))))
    f, slopes = with_slopes(layout, surface, here)
    assert kept_of(surface, here) is None
    kept = keep(layout, surface, here)
    assert kept_of(surface, here) is kept and reading(surface, here) is kept.reading
    np.testing.assert_array_equal(kept.reading, f)
    np.testing.assert_array_equal(with_slopes(layout, surface, here)[1]["ggx.alpha"], slopes["ggx.alpha"])
    for other in (surface.with_value("ggx.alpha", 0.4), surface.at(0.6)):
        assert kept_of(other, here) is None
    assert kept_of(surface, Instrument(here.geom, 0.01)) is None
    assert kept_of(surface, Instrument(rows(in_plane(30, np.linspace(-60, 60, 7))))) is None
