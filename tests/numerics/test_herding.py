"""A few points that stand for many."""

import numpy as np
import pytest

from brdfguide.numerics.herding import Groups, representatives


def line(count: int = 101, width: float = 0.2):
    x = np.linspace(0, 1, count)
    kernel = np.exp(-0.5 * ((x[:, None] - x) / width) ** 2)
    return x, kernel, np.full(count, 1 / count)


def groups_of(kernel, weights, numbers=None):
    numbers = [np.array([row]) for row in range(len(weights))] if numbers is None else numbers
    return Groups.of_points(kernel, weights, numbers)


def test_the_distance_is_that_of_the_means_and_none_of_all_points():
    x, kernel, weights = line()
    groups = groups_of(kernel, weights)
    assert groups.distance(range(len(x))) == pytest.approx(0, abs=1e-12)
    some = [10, 50, 90]
    share = np.zeros(len(x))
    share[some] = 1 / 3
    assert groups.distance(some) == pytest.approx((share - weights) @ kernel @ (share - weights))
    assert groups.with_each(some)[70] == pytest.approx(groups.distance([*some, 70]))
    across = groups.across([*some, 80]) - groups.between[:, 80]
    np.testing.assert_allclose(groups.with_each(some, across), groups.with_each(some), rtol=1e-9)


def test_it_spreads_them_as_the_measure_is():
    x, kernel, weights = line()
    every = np.ones(len(x), bool)
    picked = representatives(groups_of(kernel, weights), 4, every, np.eye(len(x), dtype=bool))
    assert np.allclose(np.sort(x[picked]), [0.125, 0.375, 0.625, 0.875], atol=0.04)
    uneven = np.where(x < 0.5, 3.0, 1.0) / np.sum(np.where(x < 0.5, 3.0, 1.0))
    picked = representatives(groups_of(kernel, uneven), 4, every, np.eye(len(x), dtype=bool))
    assert np.count_nonzero(x[picked] < 0.5) == 3


def test_the_first_is_the_best_alone_and_none_is_too_near_or_forbidden():
    x, kernel, weights = line()
    groups, near = groups_of(kernel, weights), np.abs(x[:, None] - x) < 0.3
    picked = representatives(groups, 3, x > 0.25, near)
    assert groups.distance(picked[:1]) == min(groups.distance([each]) for each in picked)
    assert np.min(np.diff(np.sort(x[picked]))) >= 0.3 and np.all(x[picked] > 0.25)
    assert len(representatives(groups, 20, x > 0.25, near)) < 20


def test_one_at_least_is_of_those_that_are_wanted_and_the_others_make_up_for_it():
    x, kernel, weights = line()
    groups, every, near = groups_of(kernel, weights), np.ones(len(x), bool), np.eye(len(x), dtype=bool)
    picked = representatives(groups, 4, every, near, one_of=x > 0.99)
    assert np.count_nonzero(x[picked] > 0.99) == 1
    assert groups.distance(picked) < groups.distance([*representatives(groups, 3, every, near), len(x) - 1])


def test_what_is_there_already_counts_and_groups_are_taken_whole():
    x, kernel, weights = line()
    numbers = [*(np.array([row]) for row in range(len(x))), np.flatnonzero(x < 0.5)]
    groups = groups_of(kernel, weights, numbers)
    allowed = np.arange(len(numbers)) < len(x)
    picked = representatives(groups, 3, allowed, np.eye(len(numbers), dtype=bool), fixed=[len(x)])
    assert np.all(x[picked] > 0.5)
    assert groups.distance([len(x), *picked]) < groups.distance([len(x)])
