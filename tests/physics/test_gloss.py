"""Gloss units against an independent Monte Carlo of the standard's geometry, and back to roughness."""

from functools import partial
from math import pi, radians

import numpy as np
import pytest

from brdfguide import models
from brdfguide.physics import fresnel as optics
from brdfguide.physics import gloss
from brdfguide.physics.geometry import Geometry

ALPHAS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5)


def monte_carlo(angle: int, alpha: float, lobe: str, samples: int = 400_000, seed: int = 20041) -> float:
    """Facet normals drawn from the lobe, light reflected by each, counted in the receptor.

    Written apart from gloss.py.
    """
    rng = np.random.default_rng(seed)
    high, wide = (radians(size) / 2 for size in gloss.RECEPTOR_DEG[angle])
    theta = radians(angle) + rng.uniform(-1, 1, samples) * radians(gloss.LAMP_DEG[0]) / 2
    out_of_plane = rng.uniform(-1, 1, samples) * radians(gloss.LAMP_DEG[1]) / 2
    i = np.stack(
        [-np.sin(theta) * np.cos(out_of_plane), np.sin(out_of_plane), np.cos(theta) * np.cos(out_of_plane)], -1
    )
    u, phi = rng.random(samples), rng.uniform(0, 2 * pi, samples)
    t2 = -np.log1p(-u) * alpha**2 if lobe == "beckmann" else alpha**2 * u / (1 - u)
    slope = np.sqrt(t2)
    h = np.stack([slope * np.cos(phi), slope * np.sin(phi), np.ones(samples)], -1) / np.sqrt(1 + t2)[:, None]
    i_h = np.sum(i * h, -1)
    r = 2 * i_h[:, None] * h - i
    above = (i_h > 0) & (r[:, 2] > 0)
    x = np.arctan2(r[:, 0], r[:, 2]) - radians(angle)
    y = np.arcsin(np.clip(r[:, 1], -1, 1))
    caught = above & (np.abs(x) <= high) & (np.abs(y) <= wide)

    def tan(v):
        return np.sqrt(np.maximum(1 - v[:, 2] ** 2, 0)) / v[:, 2]

    if lobe == "ggx":

        def hidden(v):
            return (np.sqrt(1 + (alpha * tan(v)) ** 2) - 1) / 2
    else:
        from scipy.special import erfc

        def hidden(v):
            a = 1 / (alpha * tan(v))
            return (np.exp(-a * a) / (a * np.sqrt(pi)) - erfc(a)) / 2

    i, r, h, i_h = i[caught], r[caught], h[caught], i_h[caught]
    fresnel = (
        ((i_h - (q := np.sqrt(1.25 + i_h**2))) / (i_h + q)) ** 2 + ((2.25 * i_h - q) / (2.25 * i_h + q)) ** 2
    ) / 2
    weight = fresnel * i_h / (h[:, 2] * i[:, 2] * (1 + hidden(i) + hidden(r)))
    weight *= h[:, 2]  # facets are drawn by D cos, whose integral is 1 with the slopes drawn above
    return 100 * float(np.sum(weight)) / samples / gloss.black_glass(angle)


@pytest.mark.parametrize("lobe", gloss.LOBES)
@pytest.mark.parametrize("angle", gloss.ANGLES)
def test_units_agree_with_a_monte_carlo_seed_20041(angle, lobe):
    for alpha in ALPHAS:
        assert gloss.facet_units(angle, alpha, 1.5, lobe) == pytest.approx(monte_carlo(angle, alpha, lobe), abs=0.5)


@pytest.mark.parametrize("lobe", gloss.LOBES)
def test_gloss_to_alpha_and_back_within_a_unit(lobe):
    for alpha in np.geomspace(0.01, 0.5, 12):
        for angle in gloss.ANGLES:
            reading = gloss.facet_units(angle, float(alpha), 1.5, lobe)
            back = gloss.alpha_from(reading, angle, 1.5, lobe)
            assert back == pytest.approx(alpha, rel=1e-3)
            assert gloss.facet_units(angle, back, 1.5, lobe) == pytest.approx(reading, abs=0.01)


def test_three_readings_give_width_and_index_together():
    readings = {angle: gloss.facet_units(angle, 0.03, 1.6) for angle in gloss.ANGLES}
    found = gloss.roughness_from(readings)
    assert found.agrees and found.n == pytest.approx(1.6, abs=0.02) and found.alpha == pytest.approx(0.03, rel=0.02)


def test_readings_that_no_lobe_can_give_are_not_averaged():
    found = gloss.roughness_from({20: 80.0, 60: 30.0, 85: 60.0})
    assert not found.agrees and found.worst > 10


def test_a_smooth_surface_of_n_1_5_reads_82_89_and_99():
    assert [gloss.facet_units(angle, 0.0, 1.5) for angle in gloss.ANGLES] == pytest.approx([82.0, 89.1, 99.0], abs=0.1)
    assert [gloss.facet_units(angle, 0.0, gloss.STANDARD_N) for angle in gloss.ANGLES] == pytest.approx(
        [100, 100, 100], abs=1e-9
    )


def test_the_standard_reflects_what_the_norm_says():
    assert [gloss.black_glass(angle) for angle in gloss.ANGLES] == pytest.approx([0.04908, 0.10006, 0.61915], abs=1e-5)


def test_a_lambertian_body_adds_what_is_stated():
    for angle, stated in gloss.DIFFUSE.items():
        assert float(gloss.units(lambda geom: np.full(geom.shape, 1 / pi), angle)[0]) == pytest.approx(stated, abs=0.01)


@pytest.mark.parametrize("lobe", gloss.LOBES)
def test_the_lobes_here_are_those_of_the_models(lobe):
    geom = Geometry.from_degrees(np.linspace(1, 88, 30), 0.0, np.linspace(80, 2, 30), np.linspace(0, 350, 30))
    own = gloss.LOBES[lobe](geom, 0.2) * optics.fresnel(geom.cos_d, 1.5)
    assert own == pytest.approx(models.term(lobe)(geom, alpha=0.2, n=1.5), rel=1e-12)


def test_the_closed_form_holds_where_it_says_and_not_at_85():
    for alpha in (0.02, 0.05, 0.1, 0.2):
        assert gloss.closed_form(60, alpha, 1.5) == pytest.approx(gloss.facet_units(60, alpha, 1.5), abs=0.4)
    for alpha in (0.05, 0.1, 0.2):
        assert gloss.closed_form(20, alpha, 1.5) == pytest.approx(gloss.facet_units(20, alpha, 1.5), abs=0.15)
    assert gloss.closed_form(85, 0.2, 1.5) - gloss.facet_units(85, 0.2, 1.5) > 3
    assert gloss.closed_form(20, 0.01, 1.5) - gloss.facet_units(20, 0.01, 1.5) > 5


def test_quick_prediction_is_good_to_a_unit():
    ggx = models.term("ggx")
    for alpha in (0.003, 0.01, 0.05):
        f = partial(ggx, alpha=alpha, n=1.5)
        for angle in gloss.ANGLES:
            assert float(gloss.units(f, angle, quick=True)[0]) == pytest.approx(float(gloss.units(f, angle)[0]), abs=1)


def test_ward_cannot_read_as_a_real_surface_at_85_degrees():
    real = gloss.facet_units(85, 0.05, 1.5)
    ward = float(gloss.units(lambda geom: models.term("ward")(geom, rho_s=0.04, alpha=0.05), 85)[0])
    assert ward < real / 10


@pytest.mark.parametrize("count", gloss.GAUSS_LEGENDRE)
def test_the_kept_rules_are_those_of_numpy(count):
    x, weights = np.polynomial.legendre.leggauss(count)
    half, their_weights = gloss.GAUSS_LEGENDRE[count]
    np.testing.assert_allclose(half, x[count // 2 :], rtol=1e-15, atol=1e-16)
    np.testing.assert_allclose(their_weights, weights[count // 2 :], rtol=1e-13)
