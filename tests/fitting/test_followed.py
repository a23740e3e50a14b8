"""Starts and held-out folds that are followed side by side end where each ends by itself."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.fitting.followed import Following, Together, follow
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.objective import Misfit, metric
from brdfguide.fitting.starting_grid import grid_starts
from brdfguide.models import candidates

from .. import synthetic

TRUTH = {"lambertian.albedo": np.array([0.3, 0.2]), "ggx.alpha": 0.25, "ggx.n": np.array([1.5, 1.6])}


def made(**more):
    data = synthetic.surface(models.get("lambertian+ggx"), synthetic.scan(step=9.0), TRUTH, noise=0.05, channels=2)
    return replace(data, **more)


def misfit_of(model, data, scale="ln", shape_per_channel=False) -> Misfit:
    return Misfit(Layout(model, 2, shape_per_channel), data, metric(scale), np.ones_like(data.brdf))


def starts_of(misfit: Misfit):
    """The grid's best, and two places around."""
    shared, per_channel = misfit.layout.encode(grid_starts(misfit.layout, misfit.measurement)[0])
    return [(shared + away, per_channel * (1 + 0.1 * abs(away))) for away in (0.0, 0.1, -0.15)]


def alone(misfit: Misfit, start, most: int):
    return misfit.descend(start, 1e-6, most)


@pytest.mark.parametrize("model", [each.name for each in candidates.of_kind(None)])
def test_every_candidate_ends_alike(model):
    misfit = misfit_of(models.get(model), made())
    if not Following(misfit, starts_of(misfit)).goes_together:
        pytest.fail(f"{model} would be followed one start at a time")
    for start, end in zip(starts_of(misfit), follow([Following(misfit, starts_of(misfit))], 1e-6, 6)[0], strict=True):
        by_itself = alone(misfit, start, 6)
        assert end.evaluations == by_itself.evaluations
        assert end.cost == pytest.approx(by_itself.cost, rel=1e-8)


@pytest.mark.parametrize("scale", ["ln", "cube-root", "relative", "cosine"])
@pytest.mark.parametrize("more", [{}, {"solid_angle": 0.01}], ids=["point", "aperture"])
@pytest.mark.parametrize("shape_per_channel", [False, True])
def test_every_scale_and_instrument_ends_alike(scale, more, shape_per_channel):
    misfit = misfit_of(models.get("lambertian+ggx"), made(**more), scale, shape_per_channel)
    for start, end in zip(starts_of(misfit), follow([Following(misfit, starts_of(misfit))], 1e-6, 30)[0], strict=True):
        by_itself = alone(misfit, start, 30)
        assert end.evaluations == by_itself.evaluations
        np.testing.assert_allclose(end.shared, by_itself.shared, rtol=1e-8, atol=1e-9)
        np.testing.assert_allclose(end.per_channel, by_itself.per_channel, rtol=1e-8)


def test_a_fold_looks_at_no_value_that_is_held_out():
    data = made()
    kept = np.stack([data.geom.theta_i_deg[:, 0] != angle for angle in (10, 40, 75)])
    wrong = data.brdf.copy()
    wrong[~kept[0]] *= 1e3  # what the first fold must not notice
    misfit = misfit_of(models.get("lambertian+ggx"), replace(data, brdf=wrong))
    start = misfit.layout.encode(TRUTH)
    ends = follow([Following(misfit, [start] * 3, kept)], 1e-6, 30)[0]
    for mask, end in zip(kept, ends, strict=True):
        rest = misfit_of(models.get("lambertian+ggx"), replace(data, brdf=wrong)[mask])
        assert end.cost == pytest.approx(rest.descend(start, 1e-6, 30).cost, rel=1e-9)
    assert ends[0].cost < 1e-2 * ends[1].cost


def test_one_evaluation_of_many_is_that_of_each():
    misfit = misfit_of(models.get("lambertian+he-torrance"), made())
    starts = starts_of(misfit)
    rows = np.array([np.concatenate((shared, own.ravel())) for shared, own in starts])
    for start, stacked in zip(starts, Together(misfit)(np.arange(3), rows), strict=True):
        r, by_shared, by_own = misfit(*start, True)
        np.testing.assert_allclose(stacked[:, -1], r.T, rtol=1e-10, atol=1e-12)
        slopes = np.concatenate((by_shared, by_own), axis=2).swapaxes(1, 2)
        np.testing.assert_allclose(stacked[:, :-1], slopes, rtol=1e-7, atol=1e-9)
