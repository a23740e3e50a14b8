"""What measured directions stand for on a sphere: three kinds of weights, and S taken with them."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide.data.measurement import Measurement
from brdfguide.data.seen_weights import kind_of, seen_weights
from brdfguide.physics import seen
from brdfguide.physics.geometry import Geometry, in_plane, rows

from ..physics.test_seen import PAIRS, between, blinn, ggx, lambert

# in plane: incidences 15, 45, 65, theta_r -80..80 in steps of 5; another program's
IN_PLANE = (5.183, 2.622, 2.913, 1.336, 1.138, 41.237, 4.231)


def scan(theta_i=(15.0, 45.0, 65.0), step=5.0) -> Geometry:
    theta_i, theta_r = (each.ravel() for each in np.meshgrid(theta_i, np.arange(-80.0, 80.1, step), indexing="ij"))
    return rows(in_plane(theta_i, theta_r))


def measured(geom: Geometry, brdf=None, **more) -> Measurement:
    value = np.ones((len(geom), 1)) if brdf is None else np.array(brdf(geom))
    channels = tuple("RGB"[: value.shape[1]])
    return Measurement(geom.at(np.array([0.61, 0.55, 0.465])[: value.shape[1]]), value, channels, **more)


def over(geom: Geometry, one, other, **more) -> float:
    """S of two surfaces over the directions of a measurement."""
    weights = seen_weights(measured(geom, **more)).of_rows
    return seen.apart(*(seen.lightness(f(geom), geom.cos_i) for f in (one, other)), weights)


@pytest.mark.parametrize("pair, s", list(zip(PAIRS, IN_PLANE, strict=True)))
def test_pairs_in_the_plane_have_the_s_that_another_program_found(pair, s):
    one, other, *_ = PAIRS[pair]
    assert over(scan(), one, other) == pytest.approx(s, abs=6e-4)


def test_a_ring_is_counted_by_hand():
    """Incidence 45, theta_r 60: 15 degrees off the mirror direction; at it a quarter of a step."""
    weights = seen_weights(measured(scan())).of_rows.reshape(3, -1)[1]
    step, angles = np.radians(5.0), np.arange(-80.0, 80.1, 5.0)
    cos = np.cos(np.radians(45.0)) * np.cos(np.radians(angles))
    at = {angle: place for place, angle in enumerate(angles)}
    assert weights[at[60]] == pytest.approx(cos[at[60]] * np.sin(np.radians(15)) * step, rel=1e-9)
    assert weights[at[45]] == pytest.approx(cos[at[45]] * np.sin(step / 4) * step, rel=1e-9)
    assert weights[at[-80]] == pytest.approx(cos[at[-80]] * step, rel=1e-9)


def test_every_second_reading_gives_nearly_the_same():
    one, other = ggx(0.3, 0.04, 0.1), ggx(0.4, 0.04, 0.1)
    assert over(scan(step=4.0), one, other) == pytest.approx(over(scan(step=2.0), one, other), rel=0.1)
    whole = scan(step=1.0)
    uneven = np.random.default_rng(3).uniform(size=len(whole)) < 0.5
    assert over(whole[uneven], one, other) == pytest.approx(over(whole, one, other), rel=0.1)


def test_a_dense_lobe_does_not_outvote_the_rest():
    one, other = ggx(0.2, 0.04, 0.3), ggx(0.2, 0.04, 0.25)
    even = scan(step=2.0)
    about = np.concatenate([theta + np.arange(-8.0, 8.1, 0.1) for theta in (15.0, 45.0, 65.0)])
    light = np.r_[even.theta_i_deg[:, 0], np.repeat([15.0, 45.0, 65.0], 161)]
    dense = rows(in_plane(light, np.r_[even.signed_theta_r_deg[:, 0], about]))
    assert over(dense, one, other) == pytest.approx(over(even, one, other), rel=0.03)


def test_a_repeated_scan_counts_once():
    one, other = ggx(0.2, 0.04, 0.3), lambert(0.3)
    geom, twice = scan(), scan(theta_i=(15.0, 15.0, 45.0, 65.0))
    assert over(twice, one, other) == pytest.approx(over(geom, one, other), rel=1e-9)


def test_an_arm_that_wanders_a_little_is_one_scan():
    random = np.random.default_rng(1)
    geom = scan()
    wandering = rows(
        in_plane(geom.theta_i_deg[:, 0] + random.uniform(-0.1, 0.1, len(geom)), geom.signed_theta_r_deg[:, 0])
    )
    one, other = ggx(0.2, 0.04, 0.3), lambert(0.3)
    assert over(wandering, one, other) == pytest.approx(over(geom, one, other), rel=0.01)


def test_a_moving_lamp_is_a_scan_too():
    theta_r, theta_i = (each.ravel() for each in np.meshgrid([20.0, 50.0], np.arange(0.0, 81.0, 2.5), indexing="ij"))
    geom = rows(in_plane(theta_i, theta_r))
    weights = seen_weights(measured(geom)).of_rows
    off = np.maximum(np.sin(np.radians(np.abs(theta_r - theta_i))), np.sin(np.radians(2.5) / 4))
    np.testing.assert_allclose(weights, (geom.cos_i * geom.cos_r)[:, 0] * off * np.radians(2.5), rtol=1e-9)


# --- scattered directions --------------------------------------------------------------------------------


def dome(random, held, each: int, crowded: float) -> Geometry:
    """Scattered detectors at held incidences; the share `crowded` of them near the mirror direction."""
    theta_i = np.repeat(held, each)
    sin = np.sqrt(random.uniform(0, 1, len(theta_i)))
    theta_r, phi = np.degrees(np.arcsin(sin)), random.uniform(0, 360, len(theta_i))
    near = random.uniform(size=len(theta_i)) < crowded
    theta_r = np.where(near, np.clip(theta_i + random.normal(0, 8, len(theta_i)), 0, 85), theta_r)
    phi = np.where(near, 180 + random.normal(0, 12, len(theta_i)), phi)
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


@pytest.mark.parametrize("crowded", [0.0, 0.4, 0.8])
def test_scattered_directions_stand_for_the_area_about_them(crowded):
    """Whatever the crowding, S is that of the same incidences with even directions."""
    held = np.arange(5.0, 80.0, 10.0)
    one, other = ggx(0.25, 0.04, 0.2), ggx(0.35, 0.05, 0.22)
    even = over(dome(np.random.default_rng(0), held, 2500 // len(held), 0.0), one, other)
    assert over(dome(np.random.default_rng(5), held, 400, crowded), one, other) == pytest.approx(even, rel=0.06)


def test_each_incidence_counts_by_its_cosine():
    geom = dome(np.random.default_rng(2), np.array([10.0, 60.0]), 300, 0.5)
    weights, theta_i = seen_weights(measured(geom)).of_rows, geom.theta_i_deg[:, 0]
    for angle in (10.0, 60.0):
        assert weights[theta_i == angle].sum() == pytest.approx(np.cos(np.radians(angle)), rel=1e-9)


def test_turning_the_sample_changes_nothing():
    geom = dome(np.random.default_rng(2), np.array([10.0, 60.0]), 200, 0.5)
    phi = geom.phi_i_deg + 71.0
    turned = rows(Geometry.from_degrees(geom.theta_i_deg, phi, geom.theta_r_deg, phi + geom.phi_deg))
    one, other = ggx(0.2, 0.04, 0.3), blinn(0.05, 200, 0.2)
    assert over(turned, one, other) == pytest.approx(over(geom, one, other), rel=1e-6)


# --- tables ----------------------------------------------------------------------------------------------


def test_a_table_over_half_and_difference_angles_is_a_quadrature():
    table = seen.sphere((30, 30, 20)).geom
    assert kind_of(measured(table, format="MERL .binary")) == "quadrature"
    for one, other, *_ in PAIRS.values():
        s = over(table, one, other, format="MERL .binary")
        assert s == pytest.approx(between(one, other), rel=0.01)


def test_kinds_follow_from_the_directions():
    assert kind_of(measured(scan())) == "ring"
    assert kind_of(measured(dome(np.random.default_rng(0), np.array([30.0]), 50, 0.2))) == "neighbours"


def test_steep_directions_and_those_without_a_value_count_nothing():
    data = measured(rows(in_plane(np.full(18, 30.0), np.arange(0.0, 90.0, 5.0))))
    data.brdf[3] = np.nan
    weights = seen_weights(data).of_rows
    assert np.flatnonzero(weights == 0).tolist() == [3, 17]
    assert seen_weights(replace(data, brdf=np.full_like(data.brdf, np.nan))).of_rows.sum() == 0
