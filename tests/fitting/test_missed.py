"""How probable laws are by few directions, what is recommended of these, and when candidates grow there."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.face.functions import fit
from brdfguide.fitting import choosing, learnt_design, missed
from brdfguide.fitting.residuals import ln_residuals, rms
from brdfguide.models import candidates

from .. import synthetic

GGX = models.get("lambertian+ggx")
PLASTIC = {**GGX.defaults(), "lambertian.albedo": 0.2, "ggx.alpha": 0.15, "ggx.n": 1.5}
PAINT = candidates.named("ggx+coated:lambertian+flakes")
PAINTED = {**PAINT.defaults(), "ggx.alpha": 0.12, "lambertian.albedo": 0.1, "flakes.flake": 0.3, "flakes.tilt": 0.15}
SIXTEEN = learnt_design.learnt_directions(16, in_plane=False)


def missed_by_all(measurement):
    """The same with a smooth factor that no law has."""
    geom = measurement.geom
    factor = 1 + 0.15 * np.cos(np.radians(2 * (geom.theta_i_deg + geom.theta_r_deg)) + 1.0)
    return replace(measurement, brdf=measurement.brdf * factor)


@pytest.fixture(scope="module")
def few():
    """Sixteen directions of a plastic that no law follows."""
    data = missed_by_all(synthetic.surface(GGX, SIXTEEN, PLASTIC, noise=0.02, seed=1, channels=3))
    laws = ["lambertian+ggx", "lambertian+lafortune:2", "lambertian+lafortune", "lambertian+ward"]
    return fit(data, laws, timing=False, anyway=True)


def test_least_error_is_not_most_probable(few):
    assert few.rows[0].fit.name == "lambertian+lafortune:2"
    likely = missed.likelihoods(few.rows, few.measurement)
    by_name = {row.fit.name: likely[id(row.fit)] for row in few.rows}
    assert sum(by_name.values()) == pytest.approx(1) and by_name["lambertian+ggx"] > 0.9


def test_of_few_directions_the_most_probable_is_recommended(few):
    assert few.ranking.recommended.fit.name == "lambertian+ggx"
    assert few.ranking.because.startswith("the most probable by so few directions")


def test_what_has_less_error_and_is_less_probable_is_said(few):
    rows = tuple(replace(row, fit=replace(row.fit, warnings=()), warnings=()) for row in few.rows)
    likely = {id(row.fit): 1.0 if row.fit.name == "lambertian+ward" else 0.01 for row in rows}
    pick, because = choosing.picked(rows, "look", likely=likely)
    assert pick.fit.name == "lambertian+ward"
    assert "lambertian+lafortune:2, lambertian+ggx" in because and "have less error but are less probable" in because
    assert choosing.picked(rows, "look")[0].fit.name == "lambertian+ggx"


def test_those_about_as_probable_tie_and_the_simplest_is_taken(few):
    likely = {id(row.fit): 0.3 if row.fit.name == "lambertian+ggx" else 0.9 for row in few.rows}
    least = min(row.fit.free for row in choosing.trusted(few.rows))
    assert choosing.picked(few.rows, likely=likely)[0].fit.free == least
    far = likely | {each: 1e-3 for each, value in likely.items() if value > 0.5}
    assert choosing.picked(few.rows, likely=far)[0].fit.name == "lambertian+ggx"


@pytest.mark.parametrize("count", [missed.LEAST_SAMPLES - 1, missed.FEW + 1])
def test_of_many_directions_and_of_hardly_any_nothing_is_said(few, count):
    data = synthetic.surface(GGX, synthetic.hemisphere(count), PLASTIC, noise=0.02)
    assert missed.likelihoods(few.rows, data) is None


@pytest.mark.parametrize("seed", range(3))
def test_candidates_grow_on_directions_far_apart(seed):
    """No misfit is like its neighbour's there: that it is larger than noise has to tell."""
    data = synthetic.surface(PAINT, SIXTEEN, PAINTED, noise=0.02, seed=seed)
    answer = fit(data, timing=False, anyway=True)
    there = synthetic.surface(PAINT, synthetic.hemisphere(400, seed), PAINTED)
    assert answer.ranking.recommended.fit.name == PAINT.name
    plain = next(row.fit for row in answer.rows if row.fit.name == "lambertian+ggx")
    assert 5 * rms(ln_residuals(answer.surface, there)) < rms(ln_residuals(plain.surface, there))


def test_what_is_stated_as_noise_does_not_grow():
    data = synthetic.surface(GGX, SIXTEEN, PLASTIC, noise=0.2, seed=2)
    noisy = replace(data, stderr=0.2 * data.brdf)
    assert [step.because for step in fit(noisy, timing=False, anyway=True).ranking.grown] == ["what it leaves is noise"]


def test_another_metric_and_a_percentage_are_heeded(few):
    asked = choosing.recommending(replace(few.ranking, metric="cube-root"), few.measurement)
    assert "probable" not in asked.because
    near = choosing.recommending(replace(few.ranking, close="100%"), few.measurement)
    assert any(row.close for row in near.rows) and near.recommended.fit.free <= few.ranking.recommended.fit.free


def test_scans_in_the_plane_tell_of_each_other():
    scans = synthetic.surface(GGX, synthetic.scan((20, 50), 5.0), PLASTIC, noise=0.02)
    assert missed.FEW_IN_PLANE < len(scans.brdf) <= missed.FEW and scans.in_plane
    assert not missed.few_directions(scans)
    assert missed.few_directions(synthetic.surface(GGX, synthetic.hemisphere(len(scans.brdf)), PLASTIC))
