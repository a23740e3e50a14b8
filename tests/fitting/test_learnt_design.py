"""The learnt plan: reachable, apart, nested, little worse by the general criterion, taken in the plain case alone."""

import json
import subprocess
import sys

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.fitting import goniometer, hypotheses, learnt_design, lobe_bands, planning
from brdfguide.physics.geometry import Geometry

from ..conftest import ROOT

MOST = 1.06  # times what is expected of the general plan
TARGET = goniometer.hemisphere(80.0)


def degrees(geom: Geometry) -> np.ndarray:
    return np.concatenate([geom.theta_i_deg, geom.theta_r_deg, np.abs(geom.phi_deg)], axis=1)


@pytest.mark.parametrize(("count", "in_plane"), list(learnt_design.DESIGNS))
def test_every_direction_is_reached_apart_from_the_others_and_in_half_degrees_at_least(count, in_plane):
    geom = learnt_design.learnt_directions(count, in_plane)
    assert len(geom) == count and np.all(goniometer.Goniometer(in_plane=in_plane).reaches(geom))
    assert not np.any(planning._too_near(geom, [np.array([row]) for row in range(count)]) & ~np.eye(count, dtype=bool))
    assert np.allclose(2 * degrees(geom), np.round(2 * degrees(geom)), atol=1e-6)


def test_sixteen_begin_with_the_eight_and_hold_a_mirror_direction():
    eight, sixteen = (degrees(learnt_design.learnt_directions(count, False)) for count in (8, 16))
    np.testing.assert_allclose(sixteen[:8], eight)
    assert np.min(lobe_bands.tilts_deg(learnt_design.learnt_directions(16, False))) < lobe_bands.MIRROR_DEG
    assert learnt_design.learnt_directions(9, False) is None and learnt_design.learnt_directions(16, True) is None


@pytest.mark.parametrize(("count", "in_plane"), list(learnt_design.DESIGNS))
def test_what_is_expected_of_it_is_little_more_than_of_the_general_plan_which_is_best_in_that(count, in_plane):
    reach, known = goniometer.Goniometer(in_plane=in_plane), hypotheses.unknown()
    general = planning.plan_everywhere(TARGET, reach, known, count)
    learnt = planning.plan_of(learnt_design.learnt_directions(count, in_plane), TARGET, reach, known)
    assert [len(each.geom) for each in learnt.blocks] == [len(each.geom) for each in general.blocks]
    assert learnt.blocks[0].before is None and learnt.measured == 0
    assert general.blocks[-1].after * 0.999 < learnt.blocks[-1].after < general.blocks[-1].after * MOST


def test_the_general_plan_taken_as_it_is_is_expected_to_do_what_it_said():
    reach, known = goniometer.Goniometer(), hypotheses.unknown()[::6]
    general = planning.plan_everywhere(TARGET, reach, known, 16)
    again = planning.plan_of(general.geom, TARGET, reach, known)
    ends = [(each.before, each.after) for each in general.blocks]
    assert [each.before for each in again.blocks][1:] == pytest.approx([ends[1][0]])
    assert [each.after for each in again.blocks] == pytest.approx([after for _, after in ends])


def test_what_the_instrument_does_not_reach_is_refused():
    known = hypotheses.unknown()[:2]
    with pytest.raises(InputError, match="of the directions are beyond the instrument's reach"):
        planning.plan_of(learnt_design.learnt_directions(16, False), TARGET, goniometer.Goniometer(50.0), known)


def planned(*words: str) -> np.ndarray:
    run = subprocess.run(
        [sys.executable, "-m", "brdfguide", "plan", "--json", *words], cwd=ROOT, capture_output=True, text=True
    )
    found = [each for block in json.loads(run.stdout)["blocks"] for each in block["directions"]]
    return np.array(sorted([each["theta_i_deg"], each["theta_r_deg"], each["phi_deg"]] for each in found))


def test_it_is_taken_where_nothing_is_known_and_nowhere_else():
    ours = np.array(sorted(degrees(learnt_design.learnt_directions(16, False)).tolist()))
    np.testing.assert_allclose(planned(), ours, atol=1e-3)
    np.testing.assert_allclose(planned("--move-s", "3"), ours, atol=1e-3)
    for words in (["porcelain"], ["--theta-max", "79"], ["--aperture-deg", "1"]):
        other = planned(*words)
        assert other.shape == ours.shape and not np.allclose(other, ours, atol=1e-3)
    assert len(planned("--budget", "12")) == 12


def test_after_the_first_eight_the_learnt_eight_follow(tmp_path):
    eight, sixteen = (learnt_design.learnt_directions(count, False) for count in (8, 16))
    more = degrees(sixteen)[8:]
    np.testing.assert_allclose(degrees(learnt_design.learnt_directions(8, False, eight)), more)
    np.testing.assert_allclose(degrees(learnt_design.learnt_directions(8, False, eight[::-1].swapped())), more)
    off = Geometry.from_degrees(eight.theta_i_deg + 2.5, 0.0, eight.theta_r_deg, eight.phi_deg)
    for measured, budget, in_plane in ((off, 8, False), (eight[:7], 8, False), (eight, 16, False), (eight, 8, True)):
        assert learnt_design.learnt_directions(budget, in_plane, measured) is None
    values = models.get("lambertian+ggx")(eight, {"lambertian.albedo": 0.3, "ggx.alpha": 0.2, "ggx.n": 1.5})
    lines = [",".join(map(str, [*row, f])) for row, f in zip(degrees(eight), values[:, 0], strict=True)]
    file = tmp_path / "eight.csv"
    file.write_text("theta_i,theta_r,phi,brdf\n" + "\n".join(lines) + "\n")
    np.testing.assert_allclose(
        planned("--after", str(file), "--budget", "8"), np.array(sorted(more.tolist())), atol=1e-3
    )
