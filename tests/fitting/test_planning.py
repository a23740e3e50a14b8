"""Plans of measurements: they promise what comes true, keep to the instrument, and begin as `fit --next` does."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

from brdfguide import models
from brdfguide.errors import InputError
from brdfguide.fitting import fit as fitting
from brdfguide.fitting import goniometer, hypotheses, lobe_bands, next_measurement, planning, ranking
from brdfguide.fitting.fit import ln_residuals
from brdfguide.physics.geometry import Geometry
from brdfguide.report.documents.plan import plan_document, plan_table
from brdfguide.report.figures import style
from brdfguide.report.figures.plan import plan_figure
from brdfguide.report.text.plan import plan_text

from .. import synthetic
from ..conftest import ROOT
from ..report import probe

GGX = models.get("lambertian+ggx")
TRUTH = {**models.get("lambertian+student-t").defaults(), "lambertian.albedo": 0.3, "student-t.alpha": 0.2}


@pytest.fixture(scope="module")
def blind():
    return planning.plan_everywhere(goniometer.hemisphere(80.0), goniometer.Goniometer(), hypotheses.unknown(), 16)


def error_everywhere(geom, everywhere) -> float:
    """Of GGX, fitted to a surface that it is not, at some directions."""
    model = models.get("lambertian+student-t")
    few = synthetic.surface(model, geom, {**TRUTH, "student-t.g": 4.0})
    every = synthetic.surface(model, everywhere, {**TRUTH, "student-t.g": 4.0})
    found = fitting.fit(GGX, few)
    return float(np.sqrt(np.mean(ln_residuals(found.surface, every) ** 2)))


def test_sixteen_directions_serve_nearly_as_well_as_all_and_better_than_random_ones_with_seed_4(blind):
    everywhere, weights = goniometer.hemisphere(80.0)
    random = np.random.default_rng(4)
    drawn = everywhere[random.choice(len(weights), 3000, p=weights)]
    whole = error_everywhere(drawn, drawn)
    planned = error_everywhere(blind.geom, drawn) / whole
    chance = [error_everywhere(drawn[random.choice(3000, 16)], drawn) / whole for _ in range(9)]
    assert planned < 1.1 and planned < np.median(chance)


def test_what_is_expected_falls_from_block_to_block(blind):
    first, second = blind.blocks
    assert first.before is None and second.before == first.after and 1 < second.after < first.after < 1.2
    assert len(first.geom) == len(second.geom) == planning.BLOCK and len(blind.geom) == 16


def test_of_sixteen_directions_one_is_the_mirrors_where_alone_a_narrow_lobe_is_seen(blind):
    assert np.min(lobe_bands.tilts_deg(blind.geom)) < lobe_bands.MIRROR_DEG
    some, target, reach = hypotheses.unknown()[::6], goniometer.hemisphere(80.0), goniometer.Goniometer()
    eight = planning.plan_everywhere(target, reach, some, 8).geom
    assert np.min(lobe_bands.tilts_deg(eight)) > lobe_bands.MIRROR_DEG  # too dear for eight
    more = planning.plan_everywhere(target, reach, some, 8, measured=eight).geom
    assert np.min(lobe_bands.tilts_deg(more)) < lobe_bands.MIRROR_DEG


def test_a_lobe_of_half_a_degree_has_its_height_from_sixteen_directions(blind):
    model = models.get("lambertian+beckmann")
    narrow = {"lambertian.albedo": 0.3, "beckmann.alpha": 0.006, "beckmann.n": 1.5}
    mirror = Geometry.from_degrees(np.array([[30.0]]), 0.0, 30.0, 180.0)

    def missed(geom) -> float:
        found = fitting.fit(model, synthetic.surface(model, geom, narrow, noise=0.02, seed=3))
        return abs(float(ln_residuals(found.surface, synthetic.surface(model, mirror, narrow))[0, 0]))

    assert missed(blind.geom) < 0.4
    assert missed(blind.geom[lobe_bands.tilts_deg(blind.geom) > lobe_bands.MIRROR_DEG]) > 1


def file_of_directions(*crowd: tuple[float, int]) -> Geometry:
    """Directions far from the mirror's, and some (tilt [deg], how many) near it, one of each at 45 degrees."""
    random = np.random.default_rng(7)
    parts = [Geometry.from_degrees(random.uniform(5, 75, (400, 1)), 0.0, random.uniform(5, 75, (400, 1)), 90.0)]
    for tilt, count in crowd:
        theta_i = np.r_[45.0, random.uniform(5, 75, count - 1)][:, None]
        parts.append(Geometry.from_degrees(theta_i, 0.0, theta_i + 2 * tilt, 180.0))
    return planning.joined_rows(parts)


def planned_among(offered: Geometry, count: int, measured=None):
    return planning.plan_everywhere(
        planning.evenly(offered, 80.0),
        goniometer.Goniometer(),
        hypotheses.unknown()[::9],
        count,
        among=offered,
        measured=measured,
    )


def test_where_hardly_any_direction_of_a_file_is_the_mirrors_none_is_taken_for_its_sake():
    offered = file_of_directions((0.0, 3))
    assert not lobe_bands.lobe_bands(offered, 16)
    none_exact = file_of_directions((0.2, 20), (1.0, 4))  # crowded, but nothing within a tenth of a degree
    assert not lobe_bands.lobe_bands(none_exact, 16) and not lobe_bands.lobe_rows(none_exact)


def test_where_a_file_crowds_about_the_mirror_direction_eight_see_the_lobes_height_flank_and_foot():
    offered = file_of_directions((0.0, 20), (1.0, 4), (4.0, 4))
    plan = planned_among(offered, 8)
    eight = plan.geom
    assert plan.blocks[-1].after < 1.5  # those three stand beside the mean, which they would spoil
    tilt = lobe_bands.tilts_deg(eight)
    assert len(eight) == 8
    for low, high in lobe_bands.BANDS_DEG:
        assert np.any((tilt >= low) & (tilt <= high))
    far = offered[lobe_bands.tilts_deg(offered) > lobe_bands.BANDS_DEG[-1][1]][:8]
    assert len(planned_among(offered, 2, measured=far).geom) == 2  # no more than the budget
    more = planned_among(offered, 8, measured=eight).geom  # what was seen already is not asked for again
    assert np.count_nonzero(lobe_bands.tilts_deg(more) <= lobe_bands.BANDS_DEG[-1][1]) < 3


def test_of_a_large_file_the_directions_offered_hold_its_mirror_direction():
    theta_i, theta_r = (each.reshape(-1, 1) for each in np.meshgrid(np.arange(5.3, 75, 1.0), np.arange(5.9, 75, 1.0)))
    many = planning.joined_rows(
        [
            Geometry.from_degrees(theta_i, 0.0, theta_r, 120.0),
            Geometry.from_degrees(np.array([[40.0]]), 0.0, 40.0, 180.0),
        ]
    )
    data = synthetic.surface(GGX, many, {"ggx.alpha": 0.2})
    offered = planning.some_directions(data)
    assert len(offered) < len(many) and np.min(lobe_bands.tilts_deg(offered)) < lobe_bands.MIRROR_DEG


def test_after_few_directions_other_surfaces_stay_possible():
    eight = planning.plan_everywhere(
        goniometer.hemisphere(80.0), goniometer.Goniometer(), hypotheses.unknown()[::6], 8
    ).geom
    truth = {"lambertian.albedo": 0.3, "ggx.alpha": 0.2}
    few = synthetic.surface(GGX, eight, truth, noise=0.03)
    many = synthetic.surface(GGX, synthetic.scan((20, 60)), truth, noise=0.03)
    after_few, after_many = (hypotheses.after(ranking.rank(fitting.fit_all([GGX], each), each)) for each in (few, many))
    assert len(after_many) == len(hypotheses.AROUND)
    assert len({each.layout.model.name for each in after_few}) > 5


def test_it_keeps_to_what_the_instrument_reaches():
    reach = goniometer.Goniometer(60.0, in_plane=True, value_s=2.0, move_s=30.0)
    plan = planning.plan_everywhere(goniometer.hemisphere(80.0), reach, hypotheses.unknown()[::6], 12)
    assert np.all(reach.reaches(plan.geom)) and np.all(plan.geom.off_plane_deg < 0.1)
    assert np.max(plan.geom.theta_i_deg) <= 60 and plan.seconds >= 12 * 2 + 2 * 30
    with pytest.raises(InputError, match="reaches 1[0-9]* scans of those that are offered; wanted at least the 50"):
        planning.plan_everywhere(goniometer.hemisphere(80.0), reach, hypotheses.unknown()[:2], 50, scans=True)


def test_whole_scans_come_with_their_angles_and_the_best_first():
    reach = goniometer.Goniometer(in_plane=True, step_deg=10.0)
    plan = planning.plan_everywhere(goniometer.hemisphere(80.0), reach, hypotheses.unknown()[::6], 3, scans=True)
    assert [len(each.scans) for each in plan.blocks] == [1, 1, 1]
    after = [each.after for each in plan.blocks]
    assert after == sorted(after, reverse=True)
    text = plan_text(plan_document(plan, timed=False))
    assert text.count("in the plane of incidence, theta_r -80 to 80 deg") >= 1


def tied():
    """GGX and Cook and Torrance's facets, which scans near the normal do not tell apart."""
    cook = models.get("lambertian+cook-torrance")
    data = synthetic.surface(
        GGX, synthetic.scan((10, 20)), {"lambertian.albedo": 0.3, "ggx.alpha": 0.22, "ggx.n": 1.5}, noise=0.05, seed=2
    )
    data = data[np.abs(data.geom.signed_theta_r_deg[:, 0]) <= 30]
    return ranking.rank(fitting.fit_all([GGX, cook], data), data), data


def test_the_first_direction_that_tells_is_the_one_that_next_names():
    ranked, data = tied()
    reach = goniometer.Goniometer(85.0)
    plan = planning.plan_to_tell(ranked, data, reach, 1)
    first = next_measurement.propose(ranked, data).directions[0]
    geom = plan.geom
    assert [geom.theta_i_deg[0, 0], geom.theta_r_deg[0, 0]] == pytest.approx([first.theta_i_deg, first.theta_r_deg])
    assert plan.blocks[0].after == pytest.approx(first.gain)
    more = planning.plan_to_tell(ranked, data, reach, 12)
    assert more.blocks[1].after > more.blocks[0].after > first.gain
    alone = replace(ranked, rows=ranked.rows[:1])
    with pytest.raises(InputError, match="no two models tie"):
        planning.plan_to_tell(alone, data, reach, 4)


def test_pinning_leaves_less_with_every_direction_and_a_whole_scan_is_named_where_one_does_little():
    data = synthetic.surface(GGX, synthetic.scan(), {"lambertian.albedo": 0.3, "ggx.alpha": 0.2}, noise=0.05, seed=1)
    ranked = ranking.rank(fitting.fit_all([GGX], data), data)
    plan = planning.plan_to_pin(ranked, data, goniometer.Goniometer(85.0), 10)
    first = next_measurement.propose(ranked, data)
    assert plan.subject == first.subject and first.purpose == "pin" and not first.narrows
    assert plan.blocks[1].after < plan.blocks[0].after <= first.directions[0].gain
    assert first.scans[0].gain < first.directions[0].gain and first.scans[0].gain <= first.scans[-1].gain


def test_data_that_are_there_count():
    ranked, data = tied()
    known = hypotheses.after(ranked)
    target, reach = goniometer.hemisphere(80.0), goniometer.Goniometer()
    plan = planning.plan_everywhere(target, reach, known, 8, measured=planning.measured_part(data))
    (block,) = plan.blocks
    assert plan.measured == len(data.geom) and block.before > 1.1 > block.after
    assert np.median(block.geom.theta_i_deg) > 30  # where nothing was measured yet


def test_data_of_several_channels_count_as_well():
    colours = synthetic.surface(GGX, synthetic.scan((20, 60)), {"ggx.alpha": 0.2}, noise=0.03, channels=3)
    ranked = ranking.rank(fitting.fit_all([GGX], colours), colours)
    known = hypotheses.after(ranked)
    assert len(known) == len(hypotheses.AROUND) and len({each.surface.values["ggx.alpha"] for each in known}) == 3
    assert all(each.layout.channels == len(each.surface.channels) == 1 for each in known)


def test_the_table_is_taken_back_once_its_values_are_there(tmp_path, blind):
    document = plan_document(blind, timed=False)
    lines = plan_table(document).splitlines()
    filled = [line + "0.2" if line.endswith(",") else line for line in lines]
    (tmp_path / "plan.csv").write_text("\n".join(filled))
    from brdfguide.data import formats

    back = formats.read(tmp_path / "plan.csv")
    assert len(back.brdf) == 16 and not back.in_plane
    assert np.allclose(np.sort(back.geom.theta_i_deg[:, 0]), np.sort(blind.geom.theta_i_deg[:, 0]))
    assert np.sum(back.geom.vxy2) == pytest.approx(np.sum(blind.geom.vxy2))


def test_the_picture_shows_every_direction(blind):
    document = plan_document(blind, timed=True)
    with style.look():
        figure = plan_figure(document)
        marks = [line for axis in figure.axes for line in axis.lines if line.get_markersize() == 4.2]
    assert sum(len(line.get_xdata()) for line in marks) == 16
    assert figure.get_suptitle().replace("\n", " ") == plan_text(document).partition("\n")[0]


def test_what_is_expected_is_drawn_where_it_changes_alone(blind):
    """A panel of one point says no more than the title; no label of any leaves the picture."""
    document = plan_document(blind, timed=True)
    block = document["blocks"][0] | {"expected_before": 2.0}
    with style.look():
        one, today = (plan_figure(document | {"blocks": [each]}) for each in (document["blocks"][0], block))
    assert len(today.axes) == len(one.axes) + 1
    assert probe.faults(one) == probe.faults(today) == []


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--purpose", "tell"], "without --after no model is tied"),
        (["--budget", "0"], "--budget 0: wanted 1 to 512"),
        (["--purpose", "tel"], "no purpose called 'tel'"),
        (["--step-deg", "2"], "--step-deg: it is the step of --scans"),
        (["--theta-max", "95"], "angles up to 95 degrees: wanted 10 to 89"),
        (["--after", "examples/white_paper.csv", "porcelain"], "the data of --after say more"),
    ],
)
def test_what_does_not_go_together_is_refused(words, sentence):
    run = subprocess.run([sys.executable, "-m", "brdfguide", "plan", *words], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 2 and sentence in run.stderr


def test_all_that_were_measured_are_counted(capsys):
    from brdfguide.cli import main

    with pytest.raises(SystemExit):
        main(["plan", "--after", str(ROOT / "examples" / "white_paper.csv"), "--budget", "1", "--json", "-q"])
    document = json.loads(capsys.readouterr().out)
    assert document["measured_before"] == 480  # of which half stand for all


def test_a_scene_asks_for_its_own_directions():
    run = subprocess.run(
        [sys.executable, "-m", "brdfguide", "plan", "porcelain", "--scene", "default", "--budget", "4", "--json"],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    document = json.loads(run.stdout)
    assert document["schema"] == "brdfguide/plan/1" and document["directions"] == 4
