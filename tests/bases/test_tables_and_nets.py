"""Wavelets, separable sums, principal components and the net: each against what it must give back."""

import numpy as np

from brdfguide import models
from brdfguide.bases import components, net, tables

from .. import synthetic


def test_haar_and_back_is_nothing_and_keeps_the_norm():
    values = np.random.default_rng(0).standard_normal((16, 16, 16))
    found = tables.haar(values)
    np.testing.assert_allclose(tables.unhaar(found), values, atol=1e-12)
    np.testing.assert_allclose(np.sum(found**2), np.sum(values**2))


def test_a_constant_is_one_wavelet():
    found = tables.largest(tables.haar(np.full((8, 8, 8), 3.0)), 1)
    assert np.count_nonzero(np.abs(found) > 1e-12) == 1
    np.testing.assert_allclose(tables.unhaar(found), 3.0)


def test_a_separable_table_with_gaps_comes_back():
    random = np.random.default_rng(1)
    truth = random.standard_normal((12, 2)) @ random.standard_normal((2, 60))
    gaps = np.where(random.uniform(size=truth.shape) < 0.02, np.nan, truth)
    found = tables.separable(gaps, 2)
    known = np.isfinite(gaps)
    assert found.count == 2 * (12 + 60)
    assert np.sqrt(np.mean((found.table - truth)[known] ** 2)) < 0.1


def test_exchanged_directions_lie_in_one_cell():
    geom = synthetic.hemisphere(300)
    there, back = tables.half_difference_cell(geom), tables.half_difference_cell(geom.swapped())
    around = tables.AROUND
    np.testing.assert_array_equal(there // around, back // around)
    assert np.all(np.abs(there % around + back % around - (around - 1)) <= 1)


def test_components_give_back_a_surface_between_two_others():
    random = np.random.default_rng(2)
    one, other = random.standard_normal((2, 50))
    mean, parts = components.principal(np.stack([one, other, 0.5 * (one + other) + 0.1]))
    wanted = 0.3 * one + 0.7 * other
    found = components.fit_principal(mean, parts, wanted, np.ones(50, bool), 1)
    assert np.sqrt(np.mean((found - wanted) ** 2)) < 0.12


def test_the_net_learns_a_lobe_and_is_reciprocal():
    geom = synthetic.hemisphere(1500)
    values = {"lambertian.albedo": 0.2, "ggx.alpha": 0.3, "ggx.n": 1.5}
    data = synthetic.surface(models.get("lambertian+ggx"), geom, values)
    steps, net.STEPS = net.STEPS, 600
    try:
        found = net.fit_net(geom, data.ln[:, 0])
    finally:
        net.STEPS = steps
    assert net.COUNT == 631
    assert np.sqrt(np.mean((np.log(found(geom)) - data.ln) ** 2)) < 0.12
    np.testing.assert_allclose(found(geom), found(geom.swapped()), rtol=1e-3)
