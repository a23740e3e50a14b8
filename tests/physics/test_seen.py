"""S, the rms difference in lightness of two spheres: numbers, properties, words."""

from math import pi

import numpy as np
import pytest

from brdfguide.physics import microfacet, seen
from brdfguide.physics.geometry import Geometry, in_plane, rows

SPHERE = seen.sphere()
FINE = seen.sphere((180, 48, 48))


# --- surfaces of the specification: rho/pi + lobe, (samples, colours) -------------------------------------


def lambert(*rho):
    return lambda geom: np.broadcast_to(np.array(rho) / pi, (len(geom), len(rho)))


def blinn(ks, n, rho=0.0):
    return lambda geom: rho / pi + ks * (n + 8) / (8 * pi) * geom.sec2_h ** (-n / 2)


def schlick(geom, f0):
    return f0 + (1 - f0) * (1 - geom.cos_d) ** 5


def ggx(alpha, f0, rho=0.0):
    return lambda geom: rho / pi + schlick(geom, f0) * microfacet.ggx_shape_uncorrelated(geom, alpha)


def beckmann(alpha, f0):
    """Gaussian facets in v-grooves."""

    def brdf(geom):
        cos_h = 1 / np.sqrt(geom.sec2_h)
        groove = np.minimum(1, 2 * cos_h * np.minimum(geom.cos_i, geom.cos_r) / geom.cos_d)
        return schlick(geom, f0) * microfacet.beckmann(geom, alpha) * groove / (4 * geom.cos_i * geom.cos_r)

    return brdf


def between(one, other, sphere=SPHERE) -> float:
    cos_i = sphere.geom.cos_i
    return seen.apart(*(seen.lightness(f(sphere.geom), cos_i) for f in (one, other)), sphere.weights)


# one, other, S of 45 x 12 x 12 cells, of 180 x 48 x 48: another program's, to its digits
PAIRS = {
    "lambert": (lambert(0.5), lambert(0.6), 5.050, 5.049),
    "colours": (lambert(0.4, 0.4, 0.4), lambert(0.45, 0.40, 0.35), 2.555, 2.555),
    "width of a coat": (blinn(0.05, 200, 0.2), blinn(0.05, 400, 0.2), 2.595, 2.597),
    "height of a coat": (blinn(0.05, 200, 0.02), blinn(0.06, 200, 0.02), 1.201, 1.202),
    "width on a light body": (ggx(0.10, 0.04, 0.3), ggx(0.12, 0.04, 0.3), 1.050, 1.053),
    "tails of a metal": (ggx(0.10, 0.9), beckmann(0.10, 0.9), 41.487, 41.507),
    "narrow lobes": (ggx(0.02, 0.04, 0.05), ggx(0.03, 0.04, 0.05), 2.754, 2.758),
}


@pytest.mark.parametrize("pair", PAIRS)
def test_pairs_have_the_s_that_another_program_found(pair):
    one, other, s, fine = PAIRS[pair]
    assert between(one, other) == pytest.approx(s, abs=6e-4)
    assert between(one, other, FINE) == pytest.approx(fine, abs=6e-4)


def test_lambert_by_hand():
    """116 (∛0.6 - ∛0.5) √<cos^(2/3) θi>."""
    mean = np.average(SPHERE.geom.cos_i[:, 0] ** (2 / 3), weights=SPHERE.weights)
    assert mean**0.5 == pytest.approx(0.8753, abs=1e-3)
    assert between(lambert(0.5), lambert(0.6)) == pytest.approx(116 * (np.cbrt(0.6) - np.cbrt(0.5)) * mean**0.5)


def test_the_number_of_directions_is_that_of_the_cells_within_80_degrees():
    assert len(SPHERE.weights) == 4062
    assert SPHERE.geom.theta_i_deg.max() <= 80 and SPHERE.geom.theta_r_deg.max() <= 80


# --- properties ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("pair", PAIRS)
def test_equal_surfaces_do_not_differ_and_order_does_not_matter(pair):
    one, other, *_ = PAIRS[pair]
    assert between(one, one) == 0.0
    assert between(one, other) == between(other, one)


@pytest.mark.parametrize("gain", [0.01, 3.0])
@pytest.mark.parametrize("pair", PAIRS)
def test_a_gain_of_both_comes_in_by_its_cube_root(pair, gain):
    one, other, *_ = PAIRS[pair]
    scaled = between(lambda geom: gain * one(geom), lambda geom: gain * other(geom))
    assert scaled == pytest.approx(np.cbrt(gain) * between(one, other), rel=1e-9)


@pytest.mark.parametrize("alpha", [0.01, 0.03, 0.1, 0.4])
def test_twice_the_cells_change_little(alpha):
    one, other = ggx(alpha, 0.04, 0.1), ggx(1.3 * alpha, 0.04, 0.1)
    doubled = between(one, other, seen.sphere((90, 24, 24)))
    assert between(one, other) == pytest.approx(doubled, rel=0.02)


def test_the_coarse_sphere_is_off_by_a_percent_or_two():
    coarse = seen.sphere(seen.COARSE)
    ratios = [between(one, other, coarse) / s for one, other, s, _ in PAIRS.values()]
    assert np.median(np.abs(np.array(ratios) - 1)) < 0.012


def test_widening_a_lobe_raises_s_from_the_start_step_by_step():
    start = ggx(0.05, 0.04, 0.2)
    found = [between(start, ggx(0.05 * 1.15**step, 0.04, 0.2)) for step in range(16)]
    assert found[0] == 0 and np.all(np.diff(found) > 0)


@pytest.mark.parametrize("gain", [0.1, 5.0])
def test_the_order_of_candidates_does_not_depend_on_the_unit(gain):
    data = ggx(0.1, 0.04, 0.2)
    others = [ggx(0.13, 0.04, 0.2), blinn(0.05, 150, 0.2), lambert(0.24), ggx(0.1, 0.05, 0.19), ggx(0.07, 0.04, 0.2)]
    plain = np.argsort([between(data, each) for each in others])
    scaled = np.argsort([
        between(lambda geom: gain * data(geom), lambda geom, each=each: gain * each(geom)) for each in others
    ])  # fmt: skip
    assert plain.tolist() == scaled.tolist()


def test_turning_a_surface_without_grain_changes_nothing():
    turned = Geometry.from_vectors(*(vectors(SPHERE.geom, 37.0)))
    one, other = ggx(0.1, 0.04, 0.3), blinn(0.05, 200, 0.2)
    lightness = [seen.lightness(f(turned), turned.cos_i) for f in (one, other)]
    assert seen.apart(*lightness, SPHERE.weights) == pytest.approx(between(one, other), rel=1e-9)


def vectors(geom, turn_deg):
    """Unit vectors toward light and eye, turned about the normal."""
    phi_i = np.radians(geom.phi_i_deg + turn_deg)
    phi_r = phi_i + np.radians(geom.phi_deg)
    for sin, cos, phi in ((geom.sin_i, geom.cos_i, phi_i), (geom.sin_r, geom.cos_r, phi_r)):
        yield np.stack([sin * np.cos(phi), sin * np.sin(phi), cos], axis=-1)[:, 0][:, None]


def test_a_turned_sphere_has_every_azimuth_alike():
    sphere = seen.sphere((12, 6, 6), turns=8)
    phi = np.remainder(sphere.geom.phi_i_deg[:, 0], 360)
    shares = np.histogram(phi, bins=8, range=(0, 360), weights=sphere.weights)[0]
    np.testing.assert_allclose(shares, shares.mean(), rtol=1e-9)
    one, other = ggx(0.1, 0.04, 0.3), blinn(0.05, 200, 0.2)
    assert between(one, other, sphere) == pytest.approx(between(one, other, seen.sphere((12, 6, 6))), rel=1e-9)


def test_what_is_negative_shows_as_black():
    assert between(lambert(-0.2), lambert(0.0)) == 0.0
    assert between(lambert(-0.2), lambert(0.5)) == between(lambert(0.0), lambert(0.5)) > 0


def test_directions_without_a_value_do_not_count():
    one, other = lambert(0.5)(SPHERE.geom).copy(), lambert(0.6)(SPHERE.geom)
    far = SPHERE.geom.theta_i_deg[:, 0] > 40
    one[far] = np.nan
    lightness = [seen.lightness(f, SPHERE.geom.cos_i) for f in (one, other)]
    without = seen.apart(*(each[~far] for each in lightness), SPHERE.weights[~far])
    assert seen.apart(*lightness, SPHERE.weights) == pytest.approx(without, rel=1e-13)  # summed in another order
    assert np.isnan(seen.apart(np.nan * lightness[0], lightness[1], SPHERE.weights))


# --- colours ---------------------------------------------------------------------------------------------


def test_grey_beside_colour_is_three_times_the_same():
    assert between(lambert(0.4), lambert(0.45, 0.40, 0.35)) == pytest.approx(2.555, rel=1e-3)


@pytest.mark.parametrize("channels", [("R", "G", "B"), ("B", "G", "R")])
def test_named_colours_are_taken_as_they_are(channels):
    weights = seen.colours(channels, np.array([0.61, 0.55, 0.465]))
    np.testing.assert_array_equal(np.arange(3) @ weights, [channels.index(each) for each in "RGB"])


def test_a_spectrum_becomes_white_where_it_is_flat_and_needs_no_tables():
    um = np.linspace(0.4, 0.7, 31)
    weights = seen.colours([f"{1e3 * each:.0f}nm" for each in um], um)
    assert weights.shape == (31, 3)
    np.testing.assert_allclose(weights.sum(axis=0), 1.0, rtol=1e-12)
    infrared = seen.colours(("2000nm", "3000nm"), np.array([2.0, 3.0]))
    np.testing.assert_allclose(infrared.sum(axis=0), 1.0, rtol=1e-12)


# --- words -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "s, words",
    [
        (0.0, "looks alike side by side (below 3.5)"),
        (3.4, "looks alike side by side (below 3.5)"),
        (3.6, "hardly different side by side (below 5)"),
        (7.9, "visibly different side by side (below 8)"),
        (8.1, "different (above 8)"),
        (40.0, "different (above 8)"),
        (float("nan"), "cannot be told"),
    ],
)
def test_bands_in_words(s, words):
    assert seen.band_words(s) == words


@pytest.mark.parametrize(
    "better, worse, words",
    [(3.0, 3.6, "alike to the eye"), (3.0, 4.2, "probably closer"), (3.0, 5.9, "closer"), (3.0, 6.1, "clearly closer")],
)
def test_order_in_words(better, worse, words):
    assert seen.order_words(better, worse) == words


def test_close_enough_is_within_a_quarter_or_below_two_and_a_half():
    assert seen.close_enough(6.2, 5.0) and not seen.close_enough(6.3, 5.0)
    assert seen.close_enough(2.4, 0.1) and not seen.close_enough(2.6, 0.1)


def test_two_are_alike_by_the_ratio_or_because_they_look_alike_themselves():
    assert seen.alike(6.2, 5.0, 9.0) and seen.alike(6.8, 5.0, 2.4) and not seen.alike(6.8, 5.0, 2.6)
    assert not seen.alike(6.8, 5.0, float("nan"))


def test_scans_in_the_plane_of_incidence_are_geometry_too():
    geom = rows(in_plane(45.0, np.array([30.0, 45.0, 60.0])))
    assert seen.lightness(lambert(1.0)(geom), geom.cos_i)[0, 0] == pytest.approx(116 * np.cbrt(np.cos(pi / 4)))
