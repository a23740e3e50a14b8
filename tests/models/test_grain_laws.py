"""What every law with a grain owes beside the contract: it turns with its axis, half a turn of it is none, across and
along change places with its widths, and without a grain it is its parent.
"""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.audit import textbook_more as textbook
from brdfguide.audit.trials import parameter_sets, trial_directions
from brdfguide.physics.geometry import Geometry, rows

GRAINED = [model for model in models.every() if "axis" in model.defaults() and model.turns]
every_grain = pytest.mark.parametrize("law", GRAINED, ids=lambda law: law.name)
PARENTS = {
    "ward-aniso": "ward",
    "ward-duer-aniso": "ward-duer",
    "ward-gmd-aniso": "ward-gmd",
    "ggx-aniso": "ggx",
    "beckmann-aniso": "beckmann",
}


def scattered(seed, turn=0, count=400):
    """Directions turned by so many degrees; azimuths are whole numbers, so that turning them rounds nothing."""
    rng = np.random.default_rng(seed)
    theta_i, phi_i = rng.uniform(0.1, 89.0, count), rng.integers(0, 360, count)
    near = rng.uniform(size=count) < 0.5
    theta_r = np.where(near, np.clip(theta_i + rng.normal(size=count), 0, 89), rng.uniform(0, 89, count))
    phi_r = np.where(near, phi_i + 180 + rng.integers(-4, 5, count), rng.integers(0, 360, count))
    return rows(Geometry.from_degrees(theta_i, phi_i + turn, theta_r, phi_r + turn))


def ordinary(law):
    """Values as surfaces have them: of narrower and longer streaks an azimuth's own rounding moves the tail."""
    return [law.defaults() | dict(pin.values) for pin in law.pins]


@every_grain
def test_turning_the_axis_and_both_azimuths_changes_nothing(law):
    geom = scattered(71)
    for values in ordinary(law):
        f = law(geom, **values)
        again = law(scattered(71, 37), **{**values, "axis": values["axis"] + np.radians(37)})
        bright = f > 1e-30 * f.max()
        np.testing.assert_allclose(again[bright], f[bright], rtol=1e-12)


@every_grain
def test_half_a_turn_of_the_sample_is_none(law):
    geom = scattered(72)
    for values in ordinary(law):
        f, again = law(geom, **values), law(scattered(72, 180), **values)
        bright = f > 1e-30 * f.max()
        np.testing.assert_allclose(again[bright], f[bright], rtol=1e-12)


@every_grain
def test_exchanging_the_widths_turns_the_axis_by_a_quarter(law):
    if law.grain is None or law.grain.second == "ratio":  # which holds the wider one across by itself
        return
    first, second, geom = law.grain.first, law.grain.second, scattered(73)
    for values in ordinary(law):
        other = {**values, first: values[second], second: values[first], "axis": values["axis"] + np.pi / 2}
        f, again = law(geom, **values), law(geom, **other)
        bright = f > 1e-30 * f.max()
        np.testing.assert_allclose(again[bright], f[bright], rtol=1e-12)


@pytest.mark.parametrize("name", PARENTS)
def test_with_both_widths_alike_it_is_its_parent_for_any_axis(name):
    law, parent, geom = models.term(name), models.term(PARENTS[name]), trial_directions(74)
    for alpha in (1e-3, 0.05, 0.4, 1.5):
        ours = law(geom, alpha_x=alpha, alpha_y=alpha, axis=1.3)
        theirs = parent(geom, alpha=alpha)
        seen = theirs > 1e-30 * theirs.max()
        np.testing.assert_allclose(ours[seen], theirs[seen], rtol=1e-13)


def test_waves_without_a_grain_are_he_and_torrance():
    geom, law, he = trial_directions(75), models.term("he-torrance-aniso"), models.term("he-torrance")
    for sigma, slope in ((0.02, 0.05), (0.2, 0.1), (3.0, 0.3)):
        ours = law(geom, sigma=sigma, slope=slope, axis=1.1, n=1.7)
        theirs = he(geom, sigma=sigma, slope=slope, n=1.7)
        np.testing.assert_allclose(ours, theirs, rtol=1e-13, atol=1e-290)
        np.testing.assert_allclose(
            law.mirror(geom, **law.defaults() | {"sigma": sigma, "slope": slope}),
            he.mirror(geom, **he.defaults() | {"sigma": sigma, "slope": slope}),
            rtol=1e-13,
        )


def test_waves_far_above_the_wavelength_are_gaussian_facets_with_a_grain():
    """Both mask in their own way, which is alike away from grazing."""
    geom = rows(Geometry.from_degrees(20.0, np.arange(0, 180, 15.0), 24.0, np.arange(0, 180, 15.0) + 183.0))
    waves = models.term("he-torrance-aniso")(geom, sigma=30.0, slope=0.1, ratio=4.0, axis=0.3)
    facets = models.term("beckmann-aniso")(geom, alpha_x=0.2, alpha_y=0.05, axis=0.3)
    np.testing.assert_allclose(waves, facets, rtol=2e-3)


@pytest.mark.parametrize("name, digits", [("he-torrance-aniso", 2e-10), ("cylinders", 1e-9)])
def test_agrees_with_its_text_at_40_digits_with_seed_76(name, digits):
    law, rng = models.term(name), np.random.default_rng(76)
    for values in parameter_sets(law, 76, 12):
        values = {key: float(value) for key, value in values.items()}
        theta_i, theta_r = rng.uniform(0, 89.9, 2)
        phi_i = rng.uniform(0, 360)
        angles = (theta_i, phi_i, theta_r, phi_i + rng.choice([180 + rng.normal(), rng.uniform(0, 360)]))
        right = float(textbook.exact_value(name, angles, values))
        if right > 1e-200:
            assert float(law(Geometry.from_degrees(*angles), **values)) == pytest.approx(right, rel=digits), values


def test_half_cylinders_are_bright_toward_the_light():
    """f π = 1.57 at 60° across them: every lit element faces the light that it sends back."""
    back = models.term("cylinders")(
        Geometry.from_degrees(60.0, 0.0, 60.0, 0.0), spacing=2.0, sink=0.0, albedo=1.0, ks=0.0
    )
    assert float(back) * np.pi == pytest.approx(1.57, abs=0.005)


def test_the_bounded_lobe_stays_below_one_and_wards_own_does_not_keep_its_light():
    from brdfguide.physics.hemisphere import dhr

    def albedo(name, theta, axis=0.0):
        law = models.term(name)
        return dhr(lambda geom: law(geom, rho_s=1.0, alpha_x=0.3, alpha_y=0.06, axis=axis), [theta], streaks=True)[0, 0]

    assert 0.79 < albedo("ward-gmd-aniso", 80.0) < albedo("ward-gmd-aniso", 0.0) < 0.97
    assert albedo("ward-aniso", 60.0, np.pi / 2) == pytest.approx(0.44, abs=0.01)
    assert albedo("ward-duer-aniso", 89.0) == pytest.approx(4.6, abs=0.1)


def test_kajiya_is_a_name_for_stam_that_explains_itself():
    assert models.term("kajiya") is models.term("stam")
