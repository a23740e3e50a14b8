"""Stam's lobe: against its formulas at 50 digits, against He and Torrance's without shadows, and at its limits."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.audit import textbook_more as textbook
from brdfguide.physics import fresnel
from brdfguide.physics.geometry import Geometry, rows

STAM, HE = models.term("stam"), models.term("he-torrance")


def scattered(seed, count, highest=89.9):
    rng = np.random.default_rng(seed)
    theta_i = rng.uniform(0, highest, count)
    theta_r = np.abs(theta_i + rng.normal(size=count) * 10 ** rng.uniform(-3, 1, count)) % highest
    return theta_i, rng.uniform(0, 360, count), theta_r, rng.normal(size=count) * 10 ** rng.uniform(-3, 1.5, count)


def test_agrees_with_the_formulas_at_50_digits_with_seed_61():
    rng = np.random.default_rng(61)
    for theta_i, phi_i, theta_r, off in zip(*scattered(61, 60), strict=True):
        values = {
            "sigma": 10 ** rng.uniform(-2.5, 0.7),
            "slope": 10 ** rng.uniform(-2.3, -0.2),
            "ratio": 10 ** rng.uniform(0, 1.5),
            "axis": rng.uniform(0, np.pi),
            "f0": rng.uniform(),
        }
        angles = (theta_i, phi_i, theta_r, phi_i + 180 + off)
        right = float(textbook.exact_value("stam", angles, values))
        if right > 1e-250:
            assert float(STAM(Geometry.from_degrees(*angles), **values)) == pytest.approx(right, rel=2e-10), values


def test_without_a_grain_it_is_he_and_torrance_without_shadows_with_seed_62():
    theta_i, phi_i, theta_r, off = scattered(62, 500)
    geom = rows(Geometry.from_degrees(theta_i, phi_i, theta_r, phi_i + 180 + off))
    for sigma, slope in ((0.02, 0.05), (0.2, 0.1), (3.0, 0.3)):
        ours = STAM(geom, sigma=sigma, slope=slope, f0=float(fresnel.f0(1.7, 2.0)), axis=1.1)
        he = HE.without["fresnel+masking"](geom, sigma=sigma, slope=slope, n=1.7, k=2.0, scale=1.0)
        np.testing.assert_allclose(ours, he, rtol=1e-11, atol=1e-290)


def test_far_above_the_wavelength_it_is_a_facet_lobe():
    theta_i, phi_i, theta_r, off = scattered(63, 300, 75.0)
    geom = rows(Geometry.from_degrees(theta_i, phi_i, theta_r, phi_i + 180 + off))
    values = STAM.defaults() | {"sigma": 30.0, "slope": 0.12, "ratio": 3.0, "axis": 0.4}
    whole, facets = STAM(geom, **values), STAM.without["waves"](geom, **values)
    bright = whole > 1e-6 * whole.max()
    np.testing.assert_allclose(facets[bright], whole[bright], rtol=1e-3)


def test_its_streak_lies_along_the_axis():
    """Slopes are steepest across the grain, so the lobe is broadest there: 40° off the mirror direction in azimuth."""
    geom = Geometry.from_degrees(0.0, 0.0, 20.0, np.array([25.0, 205.0, 115.0]))
    along, back, across = STAM(geom, sigma=1.0, slope=0.1, ratio=4.0, axis=np.radians(25.0))
    assert along == pytest.approx(back, rel=1e-9) and along > 1e3 * across


def test_mirror_is_dimmed_by_the_phase_alone():
    geom = Geometry.from_degrees(60.0, 0.0, 60.0, 180.0, 0.5)
    g = (4 * np.pi * 0.05 / 0.5 * 0.5) ** 2
    assert float(STAM.mirror(geom, sigma=0.05, slope=0.1, ratio=3.0, axis=1.0, f0=0.9)) == pytest.approx(
        0.9 * np.exp(-g), rel=1e-14
    )
