"""Facets whose masking is an integral of their own slopes: at 50 digits, and where they are GGX or Beckmann."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.audit import textbook_more as textbook
from brdfguide.physics.geometry import Geometry, rows

BARE = {"n": 1.5, "k": 0.0, "scale": 1.0}


def scattered(seed, count=400, highest=89.99):
    rng = np.random.default_rng(seed)
    theta_i = np.where(rng.uniform(size=count) < 0.5, rng.uniform(0, 90, count), 90 - 10 ** rng.uniform(-2, 1, count))
    theta_r = np.clip(np.abs(theta_i + rng.normal(size=count) * 10 ** rng.uniform(-3, 1.5, count)), 0, highest)
    return rows(Geometry.from_degrees(np.clip(theta_i, 0, highest), 0.0, theta_r, 180 + rng.normal(0, 20, count)))


@pytest.mark.parametrize(
    ("name", "second", "low", "high"), [("gtr", "gamma", 1.0, 10.0), ("sgd", "p", 0.0, 2.0)], ids=["gtr", "sgd"]
)
def test_agrees_with_the_integral_at_50_digits_with_seed_71(name, second, low, high):
    rng, law = np.random.default_rng(71), models.term(name)
    for _ in range(5):
        values = {"alpha": 10 ** rng.uniform(-4, 0), second: rng.uniform(low, high), **BARE}
        theta_i, beside = rng.choice([rng.uniform(5, 85), 90 - 10 ** rng.uniform(-2, 1)]), rng.normal(0, 0.3)
        angles = (theta_i, 0.0, min(abs(theta_i + beside), 89.99), 180.0)
        right = float(textbook.exact_value(name, angles, values))
        assert float(law(Geometry.from_degrees(*angles), **values)) == pytest.approx(right, rel=3e-12, abs=1e-290)


@pytest.mark.parametrize("alpha", [1e-4, 0.03, 0.4, 1.0])
@pytest.mark.parametrize(
    ("name", "values", "parent", "width"),
    [
        ("student-t", {"g": 2.0}, "ggx", lambda alpha: alpha),
        ("gtr", {"gamma": 2.0}, "ggx", lambda alpha: alpha),
        ("sgd", {"p": 0.0}, "beckmann", np.sqrt),
    ],
    ids=["student-t", "gtr", "sgd"],
)
def test_one_shape_is_that_of_a_known_law_with_seed_72(name, values, parent, width, alpha):
    if name == "sgd":
        alpha = max(alpha**2, 1e-6)
    geom = scattered(72)
    ours, known = models.term(name)(geom, alpha=alpha, **values), models.term(parent)(geom, alpha=width(alpha))
    np.testing.assert_allclose(ours, known, rtol=2e-12, atol=1e-250)


def test_large_g_nears_beckmann():
    """The first order in 1/g of (1 + u/(g-1))^-g is e^-u (1 - u + u²/2)/g."""
    geom = scattered(73, highest=70.0)
    student, beckmann = models.term("student-t"), models.term("beckmann")(geom, alpha=0.2)
    near = beckmann > 1e-3 * beckmann.max()
    miss = [np.abs(student(geom, alpha=0.2, g=g)[near] / beckmann[near] - 1).max() for g in (50.0, 500.0)]
    assert miss[0] < 0.6 and miss[1] == pytest.approx(miss[0] / 10, rel=0.3)


@pytest.mark.parametrize("name", ["student-t", "gtr", "sgd"])
def test_a_value_for_each_channel_is_that_of_the_channel_alone(name):
    """Tables are kept for each combination of values; a swap of two would show."""
    geom, law = scattered(74, 50), models.term(name)
    second = {"student-t": "g", "gtr": "gamma", "sgd": "p"}[name]
    pairs = {"alpha": np.array([0.1, 0.3, 0.1]), second: np.array([1.7, 1.7, 1.9])}
    together = law(geom, **pairs)
    for channel in range(3):
        alone = law(geom, **{key: float(value[channel]) for key, value in pairs.items()})[:, 0]
        np.testing.assert_array_equal(together[:, channel], alone)
    side_by_side = law(geom.channels_first, **{key: value[:, None] for key, value in pairs.items()})
    np.testing.assert_allclose(side_by_side, together.T, rtol=1e-14)
