"""Reflectances that are known in closed form, and lobes that a plain grid would miss."""

from functools import partial

import numpy as np
import pytest

from brdfguide import models
from brdfguide.models.surface import Surface
from brdfguide.numerics import sphere
from brdfguide.physics import fresnel, hemisphere
from brdfguide.physics.geometry import Geometry

ANGLES = (0.0, 30.0, 60.0, 85.0, 89.99)


def dhr(name, angles=ANGLES, **values):
    term = models.term(name)
    return hemisphere.dhr(partial(term, **values), angles)[:, 0]


def test_lambert_sends_back_his_albedo_at_every_angle():
    np.testing.assert_allclose(dhr("lambertian", albedo=0.7), 0.7, rtol=1e-8)


@pytest.mark.parametrize("exponent", [0.1, 20.0, 1e4, 1e6])
def test_normalised_lobes_send_their_share_at_normal_incidence(exponent):
    assert dhr("phong-lewis", [0.0], ks=0.8, exponent=exponent)[0] == pytest.approx(0.8, rel=1e-5)
    assert dhr("blinn", [0.0], ks=0.8, exponent=exponent)[0] == pytest.approx(0.8, rel=1e-5)


@pytest.mark.parametrize("name", ["ggx", "beckmann", "cook-torrance"])
def test_narrowest_facet_lobe_reflects_like_a_mirror(name):
    angles = np.array([0.0, 30.0, 60.0, 80.0])
    mirror = fresnel.fresnel(np.cos(np.radians(angles)), 1.5)
    np.testing.assert_allclose(dhr(name, angles, alpha=1e-4), mirror, rtol=1e-4)


def test_ward_loses_and_duer_gains_what_their_normalisations_say():
    np.testing.assert_allclose(dhr("ward", (45, 85, 89.9), rho_s=1, alpha=0.2), [0.638, 0.182, 0.670], atol=6e-4)
    np.testing.assert_allclose(dhr("ward-duer", (45, 85, 89.9), rho_s=1, alpha=0.2), [0.928, 1.128, 29.4], rtol=1e-3)
    np.testing.assert_allclose(dhr("ward-gmd", (45, 85, 89.9), rho_s=1, alpha=0.2), [0.937, 0.806, 0.979], atol=6e-4)


@pytest.mark.parametrize(
    "name, values",
    [
        ("ggx", {"alpha": 0.02}),
        ("oren-nayar", {}),
        ("lafortune", {"tilt": -0.8, "exponent": 1e4}),
        ("phong", {"exponent": 0.1}),
    ],
)
def test_twice_the_nodes_change_nothing_that_matters(name, values):
    term = models.term(name)
    coarse, fine = (
        hemisphere.dhr(partial(term, **values), (10, 89), step=step) for step in (hemisphere.STEP, hemisphere.STEP / 2)
    )
    np.testing.assert_allclose(coarse, fine, rtol=1e-4)


def test_sums_and_channels_go_through_the_same_code():
    values = {"lambertian.albedo": np.array([0.1, 0.6])}
    surface = Surface(models.get("lambertian+ward-gmd"), values, ("blue", "red"), np.array([0.45, 0.65]))
    both = hemisphere.dhr(surface.brdf, [20.0, 70.0])
    assert both.shape == (2, 2)
    np.testing.assert_allclose(both[:, 1] - both[:, 0], 0.5, rtol=1e-8)


@pytest.mark.parametrize("axis", [0.6])
def test_a_grain_that_lies_askew_sends_what_a_sum_by_force_has(axis):
    brdf = partial(models.term("ggx-aniso"), alpha_x=0.4, alpha_y=0.1, axis=axis, n=1.0, k=1e6, scale=1.0)
    found = hemisphere.dhr_under_turns(brdf, (0.0, 50.0, 75.0), (0.0, 45.0))[..., 0]
    place = np.arange(100_000) + 0.5
    view = sphere.from_angles(np.sqrt(1 - place / len(place)), sphere.GOLDEN_ANGLE * place)
    for turn, wanted in zip((0.0, 45.0), found, strict=True):
        light = sphere.from_angles(np.cos(np.radians([0.0, 50.0, 75.0])), np.radians(turn))
        summed = [np.pi * np.mean(brdf(Geometry.from_vectors(each, view))) for each in light]
        np.testing.assert_allclose(wanted, summed, rtol=3e-3)


def test_a_turn_changes_nothing_for_a_law_without_a_grain():
    brdf = partial(models.term("ggx"), alpha=0.3, n=1.5, k=0.0, scale=1.0)
    np.testing.assert_allclose(
        hemisphere.dhr_under_turns(brdf, (10.0, 70.0), (0.0, 30.0)),
        np.broadcast_to(hemisphere.dhr(brdf, (10.0, 70.0)), (2, 2, 1)),
        rtol=1e-5,
    )
