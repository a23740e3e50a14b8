"""Nodes of tables: the warp is its own inverse's inverse, and lines between nodes miss a function by no more than was
allowed.
"""

import numpy as np
import pytest

from brdfguide.exporters.tables.placement import GROWTH, Warp, density, march

U = np.linspace(0.0, 1.0, 1001)
SHAPES = {
    "narrow": lambda u: 0.01 + np.exp(-((u / 0.02) ** 2)),
    "growing": lambda u: 1e-4 + np.exp(8 * u),
    "cosine": lambda u: np.cos(1.5 * u),
}


def test_warp_and_back_is_where_it_began():
    warp = Warp(np.array([1.0, 30.0, 0.2, 0.2, 5.0]))
    np.testing.assert_allclose(warp.back(warp.to(U)), U, atol=1e-12)
    assert warp.to(np.array([0.0, 1.0])).tolist() == [0.0, 1.0]


def test_warp_is_the_integral_of_its_density():
    warp = Warp(np.array([1.0, 30.0, 0.2, 0.2, 5.0]))
    slope = np.diff(warp.to(U)) / np.diff(U)
    middle = 0.5 * (U[1:] + U[:-1])
    np.testing.assert_allclose(slope, warp.at(middle) / np.trapezoid(warp.density, dx=0.25), rtol=1e-9)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("tolerance", [0.01, 0.001])
def test_lines_between_placed_nodes_keep_the_tolerance(shape, tolerance):
    f = SHAPES[shape]
    fine = np.linspace(0.0, 1.0, 2001)
    values = f(fine)[:, None]
    found = density(values, values > 0, tolerance, 401, 10)
    warp, count = Warp(found), int(np.ceil(1 + np.trapezoid(found, dx=1 / 400)))
    nodes = warp.back(np.linspace(0.0, 1.0, count))
    missed = np.interp(warp.to(U), np.linspace(0.0, 1.0, count), f(nodes)) / f(U) - 1
    assert np.abs(missed).max() < 2 * tolerance
    even = np.interp(U, np.linspace(0.0, 1.0, count), f(np.linspace(0.0, 1.0, count))) / f(U) - 1
    assert shape != "narrow" or np.abs(even).max() > 3 * np.abs(missed).max()


def test_neighbouring_steps_are_alike():
    values = SHAPES["narrow"](np.linspace(0.0, 1.0, 2001))[:, None]
    step = 1 / density(values, values > 0, 1e-3, 401, 10)
    assert np.abs(np.diff(step)).max() <= GROWTH / 400 * (1 + 1e-9)


def test_march_keeps_what_is_allowed_and_takes_the_longest_steps():
    x = np.linspace(0.0, 1.0, 101)
    values = np.stack((np.exp(3 * x), np.cos(x)), axis=1)
    places = march(x, values, 0.01 * values, np.full(101, 0.5))
    assert places[0] == 0 and places[-1] == 100 and len(places) < 20
    lines = np.stack([np.interp(x, x[places], values[places, column]) for column in range(2)], axis=1)
    assert np.abs(lines / values - 1).max() <= 0.01
    assert march(x, np.ones((101, 1)), np.ones((101, 1)), np.full(101, 0.5)) == [0, 50, 100]
