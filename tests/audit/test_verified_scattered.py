"""`verify`: the noise of directions that lie in no scan, of turned samples and of large tables."""

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from brdfguide import models
from brdfguide.audit import exact_scattered
from brdfguide.data import noise
from brdfguide.data.measurement import Measurement
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import Geometry, rows

from .. import synthetic
from ..data.test_rotation import scans
from .test_verified_noise import SURFACE, compared


def spread(seed: int, channels: int = 2) -> Measurement:
    """One side of the plane of incidence on a mesh whose steps are alike both ways: many neighbours are as near."""
    x, y = (each.ravel() for each in np.meshgrid(np.arange(-8, 9) / 10.0, np.arange(1, 9) / 10.0, indexing="ij"))
    x, y = x[x**2 + y**2 < 0.9], y[x**2 + y**2 < 0.9]
    theta_r, phi = np.degrees(np.arcsin(np.hypot(x, y))), np.degrees(np.arctan2(y, x))
    columns = [(np.full(len(x), theta_i), theta_r, phi) for theta_i in (10.0, 35.0, 60.0)]
    theta_i, theta_r, phi = map(np.concatenate, zip(*columns, strict=True))
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi)).at(np.linspace(0.45, 0.65, channels))
    brdf = Surface.named("lambertian+ggx", SURFACE | {"ggx.alpha": 0.5}).brdf(geom) * np.ones(channels)
    noisy = brdf * np.exp(0.02 * np.random.default_rng(seed).standard_normal(brdf.shape))
    return Measurement(geom, noisy, tuple(f"{place}nm" for place in range(channels)))


CASES = {
    "in no scan": spread(4),
    "of turns": scans("ggx", [0.0, 45.0, 90.0], seed=7, noise=0.02, alpha=0.3),
    "more than 2000": synthetic.surface(
        models.get("lambertian+ggx"), synthetic.scan(step=0.4), {"ggx.alpha": 0.4}, noise=0.02
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_the_relative_doubt_follows_and_a_changed_digit_is_found(name):
    found = compared(CASES[name])
    told = {each.place: each.right for each in found.derived}
    assert all(each.agrees for each in found.derived) and told["noise.relative"] == pytest.approx(0.02, rel=0.5)
    wrong = compared(CASES[name], {"relative": told["noise.relative"] * (1 + 1e-6)})
    assert [each.place for each in wrong.derived if not each.agrees] == ["noise.relative"]


def test_of_places_as_near_the_first_in_the_file_are_the_nearest():
    """By the processor's way to sort garnet_red.brdf scattered by 1.2879 or 1.2889 %, a LOFT table by 1.58 or 1.43."""
    random = np.random.default_rng(2)
    places = random.permutation(np.stack(np.meshgrid(np.arange(12), np.arange(12)), axis=-1).reshape(-1, 2)) * 0.1
    places += 1e-13 * random.standard_normal(places.shape)
    asked = np.arange(0, len(places), 5)
    found = noise._beside(places, asked, np.zeros_like(asked), np.full_like(asked, len(places)))
    for row, near in zip(asked, found, strict=True):
        squares = np.round(np.sum((places - places[row]) ** 2, axis=1), 9)
        order = [place for place in np.lexsort((np.arange(len(places)), squares)) if place != row]
        assert near.tolist() == sorted(order[:12])


def test_where_a_last_decimal_decides_which_are_the_nearest_nothing_is_derived():
    places = {row: (0.0 if not row else 0.1, 0.0) for row in range(15)}
    assert exact_scattered._nearest(0, list(places), places) == list(range(1, 13))
    places[14] = (0.1 + 0.5e-9 / 0.2, 0.0)
    with pytest.raises(exact_scattered.NearestUndecided):
        exact_scattered._nearest(0, list(places), places)
