import numpy as np
import pytest
from scipy.optimize import lsq_linear

from brdfguide.numerics.nonnegative import non_negative


@pytest.mark.parametrize("terms", [1, 2, 3])
def test_amplitudes_are_those_of_scipys_bounded_least_squares(terms):
    rng = np.random.default_rng(terms)
    columns = rng.normal(0.3, 1.0, (20, 30, terms))
    found = non_negative(columns, np.zeros(terms, bool), np.full(terms, np.inf))
    for shape in range(20):
        best = lsq_linear(columns[shape], np.ones(30), (0, np.inf), method="bvls").x
        assert found[shape] == pytest.approx(best, abs=1e-7)


def test_fixed_terms_stay_and_rows_that_do_not_count_have_no_say():
    columns = np.array([[[0.25, 1.0], [0.25, 1.0], [0.25, 0.0]]])  # the last asks for nothing
    found = non_negative(columns, np.array([True, False]), np.array([1.0, np.inf]), np.array([[True, True, False]]))
    assert found[0] == pytest.approx([1.0, 0.75], rel=1e-9)
