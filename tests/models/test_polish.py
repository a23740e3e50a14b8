"""Laws of polished optics against each other: total scatter, rms height, and where two of them are one."""

from functools import partial

import numpy as np
import pytest

from brdfguide import models
from brdfguide.models import abc, harvey_shack
from brdfguide.physics import hemisphere
from brdfguide.physics.geometry import Geometry, in_plane

ABG, HARVEY, ABC = (models.term(name) for name in ("abg", "harvey-shack", "abc"))
OFF = in_plane(np.full(40, 20.0), 20 + np.geomspace(1e-4, 60, 40))


@pytest.mark.parametrize("theta", [0.0, 40.0, 70.0])
def test_what_a_smooth_surface_scatters_is_its_squared_phase(theta):
    """TIS = (4π sigma cos θ/λ)² where the whole spectrum scatters close to the mirror direction."""
    values = {"a": 1e-3, "b": 3e3, "c": 2.6, "f0": 1.0}
    sigma = float(abc.height(**values))
    scattered = hemisphere.dhr(partial(ABC, **values), (theta,))[0, 0]
    assert scattered == pytest.approx((4 * np.pi * sigma * np.cos(np.radians(theta)) / 0.55) ** 2, rel=2e-3)


def test_one_surface_scatters_with_the_fourth_power_of_the_wavelength_at_equal_spatial_frequency():
    values = {"a": 1e-4, "b": 5.0, "c": 2.2, "f0": 0.7}
    short = Geometry.from_degrees(0.0, 0.0, np.degrees(np.arcsin(0.1)), 180.0, 0.5)
    long = Geometry.from_degrees(0.0, 0.0, np.degrees(np.arcsin(0.2)), 180.0, 1.0)
    ratio = ABC(short, **values) / ABC(long, **values)
    assert ratio == pytest.approx(16 * np.cos(np.arcsin(0.1)) / np.cos(np.arcsin(0.2)), rel=1e-12)


@pytest.mark.parametrize("s", [-1.3, -2.0, -2.7])
def test_total_scatter_of_harvey_and_shack_at_the_normal(s):
    """Its closed form is over the plane of direction sines, where cos θ dω is the area."""
    values = {"b0": 3.0, "l": 0.03, "s": s}
    scattered = hemisphere.dhr(partial(HARVEY, **values), (0.0,))[0, 0]
    assert float(harvey_shack.scattered(**values)) == pytest.approx(scattered, rel=1e-6)


def test_abg_of_slope_2_is_harvey_and_shacks_and_others_only_at_peak_and_tail():
    for g in (2.0, 1.5):
        ours = ABG(OFF, a=5.0 * 0.01**g, b=0.01**g, g=g)
        other = HARVEY(OFF, b0=5.0, l=0.01, s=-g)
        apart = np.abs(ours / other - 1)
        assert apart[0] < 1e-2 and apart[-1] < 1e-2
        assert (apart.max() < 1e-12) == (g == 2.0)
    shoulder = in_plane(0.0, np.degrees(np.arcsin(0.01)))
    assert float(ABG(shoulder, a=0.01**1.5, b=0.01**1.5, g=1.5)) == pytest.approx(0.5, rel=1e-9)
    assert float(HARVEY(shoulder, b0=1.0, l=0.01, s=-1.5)) == pytest.approx(2**-0.75, rel=1e-9)


def test_a_k_correlation_surface_is_harvey_and_shacks_but_for_its_cosines():
    values = {"a": 1e-4, "b": 20.0, "c": 1.8, "f0": 0.5}
    peak = float(ABC(in_plane(0.0, 0.0), **values))
    harvey = HARVEY(OFF, b0=peak, l=0.55 / 20.0, s=-2.8)
    np.testing.assert_allclose(ABC(OFF, **values), harvey * OFF.cos_i * OFF.cos_r, rtol=1e-12)
