"""Directions to the last digit: at grazing, at the normal, at the mirror azimuth, from angles and from vectors."""

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp

from brdfguide import models
from brdfguide.audit.textbook import ExactDirections
from brdfguide.formed import formed
from brdfguide.physics.geometry import Geometry, in_plane, rows

FIELDS = ("cos_i", "sin_i", "cos_r", "sin_r", "vxy2", "dot_xy", "cos_difference")


def exact(theta_i, phi_i, theta_r, phi_r):
    """The fields of a Geometry at 120 digits."""
    with mp.workdps(120):
        p = ExactDirections(theta_i, phi_i, theta_r, phi_r)
        x, y = p.i[0] + p.r[0], p.i[1] + p.r[1]
        return (
            p.cos_i, mp.sin(p.theta_i), p.cos_r, mp.sin(p.theta_r), x * x + y * y,
            p.i[0] * p.r[0] + p.i[1] * p.r[1], p.cos_i - p.cos_r,
        )  # fmt: skip


@settings(max_examples=150, deadline=None, derandomize=True)
@given(
    st.one_of(st.floats(0, 90), st.floats(-15, 0).map(lambda e: 90 - 10**e)),
    st.floats(-400, 400),
    st.floats(-1, 1),
    st.floats(-1, 1),
    st.floats(-12, 1),
)
def test_components_keep_twelve_digits_wherever_the_directions_are(theta_i, phi_i, a, b, small):
    theta_r = min(90.0, abs(theta_i + a * 10**small))
    phi_r = phi_i + 180 + b * 10**small
    geom = Geometry.from_degrees(theta_i, phi_i, theta_r, phi_r)
    for name, right in zip(FIELDS, exact(theta_i, phi_i, theta_r, phi_r), strict=True):
        # the tangential product passes through 0 at right azimuths, and is as right as the angles there
        slack = 1e-16 if name == "dot_xy" else 1e-100
        assert float(getattr(geom, name)) == pytest.approx(float(right), rel=1e-12, abs=slack), name


def test_vectors_and_angles_give_the_same_geometry():
    rng = np.random.default_rng(3)
    theta_i, phi_i = rng.uniform(0, 90, 50), rng.uniform(-180, 180, 50)
    theta_r, phi_r = rng.uniform(0, 90, 50), rng.uniform(-180, 180, 50)

    def unit(t, p):
        return np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], -1)

    from_angles = Geometry.from_degrees(theta_i, phi_i, theta_r, phi_r)
    from_vectors = Geometry.from_vectors(unit(*np.radians([theta_i, phi_i])), unit(*np.radians([theta_r, phi_r])))
    for name in FIELDS + ("tan2_h", "cos_d", "mirror_distance2", "theta_i_deg", "theta_r_deg"):
        np.testing.assert_allclose(getattr(from_vectors, name), getattr(from_angles, name), rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(np.cos(np.radians(from_vectors.phi_deg)), np.cos(np.radians(phi_r - phi_i)), atol=1e-12)


def test_exact_mirror_has_no_tilt_and_no_distance():
    for phi_i in (0.0, 30.83138, 359.9):
        geom = Geometry.from_degrees(60, phi_i, 60, phi_i - 180)
        assert geom.vxy2 == pytest.approx(0, abs=1e-28) and geom.mirror_distance2 == pytest.approx(0, abs=1e-28)
    assert in_plane(60, 60).tan2_h == 0.0


def test_retro_reflection_is_straight_on():
    geom = Geometry.from_degrees(70, 20, 70, 20)
    assert geom.cos_d == pytest.approx(1.0, abs=1e-15)
    assert geom.tan2_h == pytest.approx(np.tan(np.radians(70)) ** 2, rel=1e-14)


def test_exchanging_the_directions_twice_changes_nothing():
    geom = Geometry.from_degrees([[10.0], [80.0]], [[0.0], [50.0]], [[30.0], [89.0]], [[170.0], [10.0]])
    back = geom.swapped().swapped()
    for name in FIELDS:
        assert np.array_equal(getattr(back, name), getattr(geom, name))
    assert np.array_equal(geom.swapped().vxy2, geom.vxy2)


def test_in_plane_angles_are_signed_as_the_report_signs_them():
    geom = in_plane(30, np.array([-50.0, -0.001, 0.0, 0.001, 50.0]))
    np.testing.assert_allclose(geom.signed_theta_r_deg, [-50, -0.001, 0, 0.001, 50], atol=1e-9)
    assert np.all(geom.off_plane_deg == 0)
    np.testing.assert_allclose(in_plane(0, np.array([-20.0, 20.0])).signed_theta_r_deg, [-20, 20])


def test_blocks_and_masks_are_parts_of_the_whole():
    geom = rows(in_plane(np.linspace(0, 80, 100), 30.0))
    assert geom.shape == (100, 1) and len(geom) == 100
    parts = list(geom.blocks(33))
    assert [len(part) for _, part in parts] == [33, 33, 33, 1]
    assert np.array_equal(np.concatenate([part.tan2_h for _, part in parts]), geom.tan2_h)
    assert np.array_equal(geom[geom.cos_i[:, 0] > 0.5].cos_i, geom.cos_i[geom.cos_i > 0.5][:, None])


def test_horizon_is_dark_and_harmless():
    geom = Geometry.from_degrees([[90.0], [91.0], [10.0]], 0.0, [[10.0], [10.0], [10.0]], 180.0)
    assert geom.lit.tolist() == [[False], [False], [True]] and not geom.all_lit
    assert np.all(geom.where_lit().cos_i > 0)


def test_factor_of_directions_is_formed_once():
    geom, calls = in_plane(30, 40), []
    factor = formed(lambda directions: calls.append(1) or directions.cos_i)
    assert factor(geom) is factor(geom) and len(calls) == 1
    assert factor(geom.at(0.7)) is factor(geom) and len(calls) == 1  # it has been shown no wavelength
    assert factor(geom.swapped()) is not factor(geom) and factor(geom.afresh()) is not None and len(calls) == 3


def test_geometry_is_pickled_without_what_was_formed_from_it():
    geom = in_plane(30, np.linspace(0, 80, 1000))
    size = len(pickle.dumps(geom))
    formed(lambda directions: directions.tan2_h)(geom)
    assert len(pickle.dumps(geom)) == size and np.array_equal(pickle.loads(pickle.dumps(geom)).tan2_h, geom.tan2_h)


def test_azimuths_of_vectors_are_formed_when_they_are_asked_for():
    random = np.random.default_rng(11)
    i, r = (random.standard_normal((50, 3)) for _ in range(2))
    i, r = (each / np.linalg.norm(each, axis=1, keepdims=True) for each in (i, r))
    i[0], i[1] = (0.0, 0.0, 1.0), (0.6, 0.0, -0.8)  # at the normal; below the horizon
    geom = Geometry.from_vectors(i, r)
    phi_i = np.degrees(np.arctan2(i[:, 1], i[:, 0]))
    phi = np.degrees(np.arctan2(i[:, 0] * r[:, 1] - i[:, 1] * r[:, 0], i[:, 0] * r[:, 0] + i[:, 1] * r[:, 1]))
    phi_i[0], phi[0] = 0.0, np.degrees(np.arctan2(r[0, 1], r[0, 0]))
    few = geom[3:9]
    for law in ("ggx", "he-torrance", "lambertian"):
        values = models.get(law)(geom, {})
        assert np.all(values[~geom.lit] == 0)
        np.testing.assert_array_equal(models.get(law)(few, {}), values[3:9])
    for each in (geom, geom.where_lit(), few):
        assert not {"phi_deg", "phi_i_deg"} & set(vars(each.directions))
    np.testing.assert_array_equal(few.phi_deg, phi[3:9])
    np.testing.assert_array_equal(geom.phi_i_deg, phi_i)
    np.testing.assert_array_equal(geom.phi_deg, phi)
    np.testing.assert_array_equal(geom.where_lit().phi_deg, np.where(geom.lit, phi, 180.0))
    for again in (pickle.loads(pickle.dumps(geom)), geom.swapped().swapped(), geom.light_turned().light_turned()):
        np.testing.assert_allclose(again.v_xy, geom.v_xy, atol=1e-12)


def test_directions_that_are_rows_stay_what_they_are():
    geom = rows(Geometry.from_degrees(45.0, 0.0, [10.0, 20.0], 180.0))
    assert rows(geom) is geom and rows(Geometry.from_degrees(45.0, 0.0, 10.0, 180.0)).shape == (1, 1)
