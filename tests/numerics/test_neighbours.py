"""Near points without a tree, against every distance."""

import numpy as np
import pytest

from brdfguide.numerics.neighbours import squared_distance


@pytest.mark.parametrize("points, groups", [(1, 1), (3, 2), (60, 9), (900, 1), (900, 40)])
@pytest.mark.parametrize("crowded", [False, True])
def test_the_fourth_nearest_is_that_of_all_distances(points, groups, crowded):
    random = np.random.default_rng(points + groups)
    radius = random.uniform(size=points) ** (4 if crowded else 0.5)
    x, y = radius * np.cos(6.3 * random.uniform(size=points)), radius * np.sin(6.3 * random.uniform(size=points))
    group = np.sort(random.integers(0, groups, points))
    group = random.permutation(np.unique(group, return_inverse=True)[1])
    wanted = np.zeros(points)
    for each in range(group.max() + 1):
        rows = np.flatnonzero(group == each)
        apart = np.sort((x[rows, None] - x[rows]) ** 2 + (y[rows, None] - y[rows]) ** 2, axis=1)
        wanted[rows] = apart[:, min(4, len(rows) - 1)]
    np.testing.assert_allclose(squared_distance(x, y, group, 4), wanted, rtol=1e-9, atol=1e-12)


def test_points_in_one_line_and_in_one_place():
    x = np.r_[np.zeros(6), np.arange(6.0)]
    found = squared_distance(x, np.zeros(12), np.repeat([0, 1], 6), 4)
    assert found.tolist() == [0.0] * 6 + [16.0, 9.0, 4.0, 4.0, 9.0, 16.0]
