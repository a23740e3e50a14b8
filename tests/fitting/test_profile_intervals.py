"""Intervals of loose parameters against the misfit itself."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.fitting import fit
from brdfguide.fitting.diagnostics import profile_intervals
from brdfguide.fitting.fit import FitOptions
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.objective import Misfit, metric

from .. import synthetic

GGX, PHONG = models.get("lambertian+ggx"), models.get("lambertian+phong")
TRUTH = {"lambertian.albedo": 0.3, "ggx.alpha": 0.5, "ggx.n": 1.5}


def loose(seed):
    """Few directions near the normal, 5 % noise: width and index make up for each other."""
    return synthetic.surface(GGX, synthetic.scan((20, 45), step=10), TRUTH, noise=0.05, seed=seed)


def intervals(found) -> dict:
    return {each.subject: tuple(value for _, value in each.numbers) for each in found.warnings if each.code == "curved"}


def cost_with(data, key, value) -> float:
    """The least sum of squares with one parameter held, by a fit of its own."""
    return float(np.sum(fit.fit(GGX, data, FitOptions(fixed={key: value})).residuals ** 2))


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_at_both_ends_the_misfit_has_risen_as_a_parabola_promises(seed):
    data = loose(seed)
    found = fit.fit(GGX, data)
    layout = Layout(GGX, 1)
    best = fit.prepare(data).settle.misfit(layout, metric("ln")).descend(layout.encode(found.values), 1e-9)
    assert intervals(found)
    for key, ends in intervals(found).items():
        block, place = (
            (best.normal.covariance()[0], layout.shared.index(key))
            if key in layout.shared
            else (best.normal.covariance()[1][0], layout.per_channel.index(key))
        )
        value, origin = float(np.ravel(found.values[key])[0]), layout.parameters[key].origin
        sigma = float(np.ravel(found.stderr[key])[0]) / (value - origin)
        promised = (2 * sigma) ** 2 / block[place, place]
        assert ends[0] < value < ends[1]
        for end in ends:
            assert cost_with(data, key, end) - best.cost == pytest.approx(promised, rel=0.15), (key, end)


def test_the_truth_lies_inside_as_often_as_they_say_with_seeds_0_to_59():
    inside = [
        ends[0] <= TRUTH[key] <= ends[1]
        for seed in range(60)
        for key, ends in intervals(fit.fit(GGX, loose(seed))).items()
    ]
    assert len(inside) > 40 and np.mean(inside) > 0.9


def test_nothing_is_said_where_a_parabola_does_or_the_model_is_wrong():
    dense = synthetic.surface(GGX, synthetic.scan(), TRUTH, noise=0.02, seed=1)
    assert not intervals(fit.fit(GGX, dense))
    wrong = fit.fit(PHONG, dense)
    assert wrong.has("discrepancy") and not intervals(wrong)


def test_an_end_is_no_farther_than_the_bound():
    data = loose(4)
    layout = Layout(GGX, 1)
    part = fit.prepare(data).settle
    best = part.misfit(layout, metric("ln")).descend(layout.encode(TRUTH), 1e-9)
    low, high = layout.bounds(["ggx.alpha"])
    at = best.shared[layout.shared.index("ggx.alpha")]
    misfit = Misfit(layout, part.measurement, metric("ln"), part.weights)
    assert at + profile_intervals._end(layout, misfit, best, "ggx.alpha", 50.0) <= high[0] + 1e-12
    assert at + profile_intervals._end(layout, misfit, best, "ggx.alpha", -50.0) >= low[0] - 1e-12
