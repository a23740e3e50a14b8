"""A smooth unknown beside a linear model, against the same by the covariance of everything at once."""

import numpy as np
import pytest

from brdfguide.numerics import gaussian_process
from brdfguide.numerics.gaussian_process import Places, weighed

RANDOM = np.random.default_rng(7)
KNOWN, OTHERS = RANDOM.uniform(0, 4, (40, 2)), RANDOM.uniform(0, 4, (9, 2))
SLOPES, ONWARD = RANDOM.standard_normal((40, 2)), RANDOM.standard_normal((9, 2))


def _kernel(one, other):
    return np.exp(-0.5 * np.sum((one[:, None] - other) ** 2, axis=2))


def test_mean_and_variance_are_those_of_one_large_normal_distribution(monkeypatch):
    monkeypatch.setattr(gaussian_process, "RATIOS", np.array([30.0]))
    values = RANDOM.standard_normal(40)
    known = weighed(Places.between(KNOWN, OTHERS), values, SLOPES)
    found = known.elsewhere(ONWARD)
    ratio = 30.0 * found.noise
    inside = ratio * _kernel(KNOWN, KNOWN) + SLOPES @ SLOPES.T + found.noise * np.eye(40)
    across = ratio * _kernel(OTHERS, KNOWN) + ONWARD @ SLOPES.T
    prior = ratio + np.sum(ONWARD**2, axis=1)
    assert found.mean == pytest.approx(across @ np.linalg.solve(inside, values), rel=1e-6)
    variance = prior - np.sum(across * np.linalg.solve(inside, across.T).T, axis=1)
    assert found.variance == pytest.approx(variance, rel=1e-6)
    evidence = -0.5 * (np.linalg.slogdet(inside)[1] + values @ np.linalg.solve(inside, values))
    assert known.evidence == pytest.approx(evidence, rel=1e-6)


def test_errors_elsewhere_are_as_large_as_foretold_on_seeds_0_to_59():
    squares, foreseen = 0.0, 0.0
    everywhere = np.concatenate([KNOWN, OTHERS])
    root = np.linalg.cholesky(_kernel(everywhere, everywhere) + 1e-10 * np.eye(49))
    for seed in range(60):
        random = np.random.default_rng(seed)
        unknown, b = 0.2 * root @ random.standard_normal(49), random.standard_normal(2)
        values = unknown[:40] + SLOPES @ b + 0.02 * random.standard_normal(40)
        found = weighed(Places.between(KNOWN, OTHERS), values, SLOPES).elsewhere(ONWARD)
        squares += np.sum((unknown[40:] + ONWARD @ b - found.mean) ** 2)
        foreseen += np.sum(found.variance)
    assert 0.8 < squares / foreseen < 1.25


def test_others_that_stand_at_one_place_are_foretold_as_each_alone():
    values, which = RANDOM.standard_normal(40), np.array([3, 0, 3, 8, 1])
    alone = weighed(Places.between(KNOWN, OTHERS[which]), values, SLOPES).elsewhere(ONWARD[:5])
    once = weighed(Places.between(KNOWN, OTHERS, which), values, SLOPES).elsewhere(ONWARD[:5])
    assert once.mean == pytest.approx(alone.mean, rel=1e-9, abs=1e-12)
    assert once.variance == pytest.approx(alone.variance, rel=1e-9, abs=1e-12)


def test_an_unknown_that_is_usually_small_leaves_less_in_doubt_elsewhere():
    values = 0.5 * np.sin(3 * KNOWN[:, 0]) + 0.02 * np.random.default_rng(3).standard_normal(40)
    far = Places.between(KNOWN, OTHERS + 10.0)
    doubts = [
        weighed(far, values, np.zeros((40, 0)), usual).elsewhere(np.zeros((9, 0))).variance.mean()
        for usual in (0.05, 0.3, np.inf)
    ]
    assert doubts[0] < 0.5 * doubts[1] < 0.5 * doubts[2]
