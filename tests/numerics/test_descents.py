"""Descents side by side end where each ends alone, and where NIST certifies that they should."""

import numpy as np
import pytest

from brdfguide.numerics.descents import Descents, minimise_all
from brdfguide.numerics.least_squares import minimise

from .test_least_squares import DIGITS, PROBLEMS, residuals_of


def stacked_of(problem):
    """What `minimise_all` asks for, of one problem from several starts."""
    residuals = residuals_of(problem)

    def evaluate(which, at):
        found = [residuals(each, None, True) for each in at]
        return np.stack([np.concatenate((slopes[0].T, r.T))[None] for r, slopes, _ in found])

    return evaluate


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda problem: problem.name)
def test_both_starts_of_nist_reach_the_certified_digits_together(problem):
    starts = np.array(problem.starts, float)
    ends = minimise_all([Descents(stacked_of(problem), starts, starts.shape[1])], tolerance=1e-14, most=1000)[0]
    digits = -np.log10(np.maximum(np.abs(ends.at - problem.certified) / np.abs(problem.certified), 1e-11))
    assert ends.converged.all()
    assert digits.min() >= DIGITS
    assert ends.cost == pytest.approx(problem.squares, rel=1e-6)


@pytest.mark.parametrize("most", [1, 3, 8, 100])
def test_each_takes_the_steps_that_it_takes_alone(most):
    """Three channels that share a width, a bound in the way of one, starts near and far, a parameter without effect."""
    x = np.linspace(0, 3, 40)
    truth = np.array([1.0, 0.5, 2.0])
    data = truth[:, None] * np.exp(-1.7 * x) + 0.05 * np.sin(9 * x)

    def parts(shared, own):
        curve = np.exp(-shared[0] * x)
        f = own * curve
        by_shared = np.stack([-x * f, np.zeros_like(f)])  # the second has no effect
        return f - data, by_shared.transpose(1, 2, 0), np.broadcast_to(curve, f.shape)[:, :, None]

    def alone(shared, own, want):
        r, by_shared, by_own = parts(shared, own)
        return (r.T, by_shared, by_own) if want else r.T

    def together(which, at):
        found = [parts(each[:2], each[2:, None]) for each in at]
        return np.stack(
            [np.concatenate((by.swapaxes(1, 2), own.swapaxes(1, 2), r[:, None]), axis=1) for r, by, own in found]
        )

    starts = np.array([[0.1, 0.3, 1, 1, 1], [9.0, 0.3, 0.1, 5, 1], [1.7, 0.0, 1, 0.5, 1.5], [30.0, 0, 1, 1, 1]])
    low, high = np.array([0.01, -1, 0, 0, 0]), np.array([50.0, 1, 9, 9, 1.5])
    family = Descents(together, starts, 2, 3, low, high)
    line = Descents(
        lambda which, at: np.stack((np.ones_like(at), at - 3), axis=1)[:, None], np.array([[7.0], [3.0]]), 1
    )
    before, ends, behind = minimise_all([line, family, line], tolerance=1e-10, most=most)
    assert before.at == pytest.approx(behind.at) and (most < 3 or before.at == pytest.approx(3.0))
    for place, start in enumerate(starts):
        end = minimise(
            alone, start[:2], start[2:, None], low=low[:2], high=high[:2],
            per_channel_low=low[2:, None], per_channel_high=high[2:, None], tolerance=1e-10, most=most,
        )  # fmt: skip
        assert ends.evaluations[place] == end.evaluations
        assert ends.converged[place] == end.converged
        assert ends.cost[place] == pytest.approx(end.cost, rel=1e-12)
        np.testing.assert_allclose(ends.at[place], [*end.shared, *end.per_channel[:, 0]], rtol=1e-9, atol=1e-12)


def test_a_start_with_no_number_ends_without_an_answer_and_stops_no_other():
    def evaluate(which, at):
        with np.errstate(invalid="ignore"):
            r = np.sqrt(at) - 2
            slope = 0.5 / np.sqrt(at)
        return np.stack([np.concatenate((s, r)) for s, r in zip(slope, r, strict=True)])[:, None, :, None]

    starts, low = np.array([[1.0], [9.0]]), np.array([0.1])
    ends = minimise_all([Descents(evaluate, starts, 1, low=low)], tolerance=1e-12)[0]
    np.testing.assert_allclose(ends.at[:, 0], 4.0, rtol=1e-9)

    def broken(which, at):
        found = evaluate(which, at)
        found[which == 0, :, -1] = np.nan
        return found

    ends = minimise_all([Descents(broken, starts, 1, low=low)], tolerance=1e-12)[0]
    assert not ends.converged[0] and not np.isfinite(ends.cost[0])
    assert ends.converged[1] and ends.at[1, 0] == pytest.approx(4.0, rel=1e-9)


def _bent(which, at):
    """x - 3 and a little of its square."""
    r = np.stack((at - 3, 0.1 * at**2 + 0.5), axis=2)
    return np.concatenate((np.stack((np.ones_like(at), 0.2 * at), axis=2), r), axis=1)[:, None]


def test_others_go_on_where_some_ended_without_looking_there_again():
    seen = []

    def evaluate(which, at):
        seen.append(len(at))
        return _bent(which, at)

    starts = np.array([[7.0], [-2.0]])
    short = minimise_all([Descents(evaluate, starts, 1)], tolerance=1e-12, most=3)[0]
    looked = len(seen)
    known = short.cost, short.slope, short.normal
    found = minimise_all([Descents(evaluate, short.at, 1, known=known)], tolerance=1e-12)[0]
    again = minimise_all([Descents(_bent, short.at, 1)], tolerance=1e-12)[0]
    np.testing.assert_array_equal(found.at, again.at)
    assert len(seen) - looked == found.evaluations.max() - 1


def test_a_foreseen_step_ends_where_one_that_was_looked_at_does():
    seen = []

    def evaluate(which, at):
        seen.append(len(at))
        return _bent(which, at)

    start = np.array([[7.0]])
    looked = minimise_all([Descents(_bent, start, 1)], tolerance=1e-5)[0]
    ends = minimise_all([Descents(evaluate, start, 1)], tolerance=1e-5, foreseen=True)[0]
    np.testing.assert_array_equal(ends.at, looked.at)
    assert ends.converged.all() and ends.cost[0] > looked.cost[0] and len(seen) == looked.evaluations[0] - 1
