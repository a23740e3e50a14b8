"""Fresnel by its limits and by complex amplitudes, Eqs. 1 and 2, Table 1 of the report."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from brdfguide.audit import textbook
from brdfguide.errors import InputError
from brdfguide.physics import fresnel as optics

positive = st.floats(-6, 3).map(lambda e: 10**e)


def test_normal_incidence_is_f0_and_grazing_is_1():
    for n, k in ((1.5, 0.0), (0.12, 3.45), (2.4203, 0.0), (3.18, 4.41), (1.0, 0.3)):
        assert optics.fresnel(1.0, n, k) == pytest.approx(optics.f0(n, k), rel=1e-14)
        assert optics.fresnel(0.0, n, k) == pytest.approx(1.0, rel=3e-16)
        assert optics.one_minus_fresnel(0.0, n, k) == 0.0


def test_no_interface_reflects_nothing_even_at_grazing():
    c = np.array([0.0, 0.5, 1.0])
    assert np.all(optics.fresnel(c, 1.0) == 0) and np.all(optics.one_minus_fresnel(c, 1.0) == 1)
    mixed = optics.fresnel(c[:, None], np.array([1.0, 1.5]))
    assert np.all(mixed[:, 0] == 0) and np.all(mixed[:, 1] > 0.03)


def test_total_reflection_inside_a_dielectric():
    c = np.cos(np.arcsin(1 / 1.5))  # critical angle from inside: n = 1/1.5
    assert (
        optics.fresnel(0.9 * c, 1 / 1.5) == pytest.approx(1.0, rel=3e-16)
        and optics.one_minus_fresnel(0.9 * c, 1 / 1.5) == 0.0
    )
    assert optics.fresnel(1.1 * c, 1 / 1.5) < 0.5


@settings(max_examples=200, deadline=None, derandomize=True)
@given(
    st.one_of(st.floats(1e-12, 1), st.floats(-12, 0).map(lambda e: 10**e)), positive, st.one_of(st.just(0.0), positive)
)
def test_both_halves_agree_with_complex_amplitudes_at_50_digits(c, n, k):
    with mp.workdps(60):
        right = textbook.unpolarised(mpf(c), mpf(n), mpf(k))
        inside = float(1 - right)
    assert float(optics.fresnel(c, n, k)) == pytest.approx(float(right), rel=1e-12, abs=1e-300)
    if not (k == 0 and n < 1):  # there the critical angle is a root, as right as its argument
        assert float(optics.one_minus_fresnel(c, n, k)) == pytest.approx(inside, rel=1e-11, abs=1e-300)


def _slopes_by_differences(c, n, k):
    step = mpf("1e-20")
    right_n = (textbook.unpolarised(c, n + step, k) - textbook.unpolarised(c, n - step, k)) / (2 * step)
    right_k = (
        (textbook.unpolarised(c, n, k + step) - textbook.unpolarised(c, n, k - step)) / (2 * step) if k else mpf(0)
    )
    return right_n, right_k


@settings(max_examples=100, deadline=None, derandomize=True)
@given(st.floats(0.01, 1), st.floats(1.01, 20), st.one_of(st.just(0.0), st.floats(0.01, 20)))
def test_gradient_agrees_with_differences_at_50_digits(c, n, k):
    f, by_n, by_k = optics.fresnel_with_slopes(c, n, k)
    assert f == pytest.approx(float(optics.fresnel(c, n, k)), rel=1e-13)
    with mp.workdps(50):
        right_n, right_k = _slopes_by_differences(c, n, k)
    assert float(by_n) == pytest.approx(float(right_n), rel=1e-9, abs=1e-11)
    assert float(by_k) == pytest.approx(float(right_k), rel=1e-9, abs=1e-11)


def test_sign_of_k_does_not_matter():
    assert optics.fresnel(0.4, 0.9, -6.0) == optics.fresnel(0.4, 0.9, 6.0)


def test_table_1_prints_the_reflectance_of_its_own_indices():
    for material, (n, k, printed) in optics.TABLE_1.items():
        assert optics.f0(n, k) == pytest.approx(printed, abs=5.1e-5), material


def test_eq_2_inverts_f0_down_to_where_n_rounds_to_1():
    for n in (1.0001, 1.34, 1.5, 2.4203, 49.0):
        assert optics.index_from_f0(optics.f0(n)) == pytest.approx(n, rel=1e-9)
    assert optics.index_minus_one(1e-40) == pytest.approx(2e-20, rel=1e-12)
    for wrong in (-0.1, 1.0, 1.2, float("nan")):
        with pytest.raises(InputError, match="0 <= f0 < 1"):
            optics.index_from_f0(wrong)


def test_eq_1_shares_the_light_between_mirror_and_lobe():
    fresnel, cos_i = 0.7, np.array([0.01, 0.5, 1.0])
    for sigma in (1e-9, 0.01, 0.3):
        kept, lost = optics.davies(fresnel, cos_i, sigma, 0.55), optics.davies_scattered(fresnel, cos_i, sigma, 0.55)
        np.testing.assert_allclose(kept + lost, fresnel, rtol=1e-14)
    assert optics.davies(fresnel, 1.0, 0.55 / (4 * np.pi), 0.55) == pytest.approx(0.7 * np.exp(-1), rel=1e-14)
    assert optics.davies_ln(fresnel, 1.0, 100.0, 0.55) == pytest.approx(
        np.log(0.7) - (4 * np.pi * 100 / 0.55) ** 2, rel=1e-14
    )
