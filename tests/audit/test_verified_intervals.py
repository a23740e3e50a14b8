"""`verify`: standard errors derived again, under every way a fit weighs values, and beside a drifted instrument."""

import json
from copy import deepcopy
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from mpmath import mpf, workdps

from brdfguide import models
from brdfguide.audit import exact_errors, exact_intervals, exact_neighbours, exact_surface, verification
from brdfguide.data import examine
from brdfguide.data.measurement import Measurement
from brdfguide.data.scans import arm_turned
from brdfguide.face.functions import fit
from brdfguide.fitting.diagnostics import standard_errors
from brdfguide.physics.geometry import Geometry, rows
from brdfguide.report.text.ranking import noise_line

from .. import synthetic
from ..data.test_noise_model import dim_run
from .test_verification import _one_digit_off

SMALL = synthetic.scan(theta_i=(15, 45, 70), step=10.0)
LAWS = ("lambertian+ggx", "lambertian+ward", "lambertian+he-torrance")


def answered(data: Measurement, laws=LAWS, **options):
    """What was fitted, and the answer as it is printed."""
    found = fit(data, laws, timing=False, **options)
    return found.measurement, json.loads(json.dumps(found.document))


def made(law: str = "lambertian+he-torrance", geom=SMALL, channels: int = 1, **values):
    model = models.get(law)
    return synthetic.surface(model, rows(geom), {**model.defaults(), **values}, noise=0.03, seed=3, channels=channels)


def verified(answer):
    return verification.verify(answer[1], verification.readings_of(*answer))


def stderrs(found) -> list[str]:
    return [each.place for each in found.derived if "stderr" in each.place and each.place.startswith("ranking")]


def printed(document) -> int:
    """Standard errors of the rows."""
    return sum(
        np.size(entry["stderr"])
        for row in document["ranking"]
        for entry in row["parameters"].values()
        if entry["stderr"] is not None
    )


@pytest.mark.parametrize("metric", ["ln", "cube-root", "relative", "cosine"])
@pytest.mark.parametrize("channels", [1, 3])
def test_every_standard_error_is_derived(metric, channels):
    answer = answered(made(channels=channels), metric=metric, shape_per_channel=channels > 1 and metric == "ln")
    found = verified(answer)
    assert not found.wrong and not found.left
    assert len(stderrs(found)) == printed(answer[1])


@pytest.mark.parametrize("noise", [0.0, 0.002])
def test_so_is_one_of_values_weighed_by_their_errors_and_by_scan(noise):
    geom = rows(synthetic.scan(theta_i=(15, 45), step=10.0))
    dense = rows(synthetic.scan(theta_i=(70,), step=2.0))
    parts = [made(geom=geom), made(geom=dense)]
    from brdfguide.physics.geometry import Geometry

    both = rows(Geometry.from_degrees(*(
        np.concatenate([getattr(each.geom, name)[:, 0] for each in parts])
        for name in ("theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_deg")
    )))  # fmt: skip
    brdf = np.concatenate([each.brdf for each in parts])
    stated = brdf * np.linspace(0.01, 0.05, len(brdf))[:, None] + noise
    answer = answered(Measurement(both, brdf, stderr=stated))
    codes = {each["code"] for each in answer[1]["data"]["findings"]}
    assert {"weighed-by-stderr", "weighed-by-scan"} <= codes
    found = verified(answer)
    assert not found.wrong
    assert len(stderrs(found)) == printed(answer[1])


@pytest.mark.parametrize("number", ["correlation", "z", "chance", "systematic_rms_ln"])
def test_how_neighbours_err_together_is_derived(number):
    answer = answered(made(), ("lambertian+ward",))
    changed = deepcopy(answer[1])
    flag = next(each for each in changed["ranking"][0]["flags"] if each["code"] == "discrepancy")
    flag["numbers"][number] = _one_digit_off(flag["numbers"][number])
    wrong = [each.place for each in verified((answer[0], changed)).wrong]
    assert not verified(answer).wrong and f"ranking[0].flags.discrepancy.{number}" in wrong


@pytest.mark.parametrize("stated", [False, True])
def test_so_is_one_of_values_too_dim_for_their_logarithm(stated):
    run = dim_run(0.02, 0.0005, 1)
    run = replace(run, stderr=np.hypot(0.02 * np.abs(run.brdf), 0.0005)) if stated else run
    answer = answered(examine.prepared(run[::3]), ("lambertian+ggx", "lambertian+ward"))
    assert answer[1]["noise"]["told_from_per_sr"] is not None
    found = verified(answer)
    assert not found.wrong
    drifted = any(each["code"] == "instrument" for row in answer[1]["ranking"] for each in row["flags"])
    assert drifted or len(stderrs(found)) == printed(answer[1])


def test_the_noise_of_single_values_follows_from_its_parts():
    answer = answered(made(geom=synthetic.scan(theta_i=(15, 45, 70), step=4.0)), ("lambertian+ggx",))
    assert "noise_rms_ln" in [each.place for each in verified(answer).derived]
    changed = deepcopy(answer[1])
    changed["noise_rms_ln"] = float(f"{changed['noise_rms_ln'] * 1.00001:.6g}")
    assert [each.place for each in verified((answer[0], changed)).wrong] == ["noise_rms_ln"]


def test_values_scatter_by_no_more_than_a_law_leaves_where_a_lobe_bends_between_them():
    """Five degrees apart, neighbours of a narrow lobe differ from their cubic by 0.1 %; the values err by 0.01 %."""
    truth = {"lambertian.albedo": 0.06, "ggx.alpha": 0.12, "ggx.n": 1.5}
    geom = synthetic.scan(theta_i=(15, 30, 45, 60, 75), step=5.0)
    data = synthetic.surface(models.get("lambertian+ggx"), geom, truth, noise=1e-4)
    answer = answered(data, ("lambertian+ggx",))
    assert answer[1]["noise"]["relative"] > 5e-4 and 5e-5 < answer[1]["noise_rms_ln"] < 1.2e-4
    assert "noise_rms_ln" in [each.place for each in verified(answer).derived] and not verified(answer).wrong
    assert "single values scatter by less than 0.01 %" in noise_line(answer[1])


def test_of_a_robust_fit_none_is_told_to_be_wrong():
    answer = answered(made(), robust=True)
    assert "weighed-robustly" in {each["code"] for each in answer[1]["data"]["findings"]}
    found = verified(answer)
    assert not found.wrong and not stderrs(found)


@pytest.mark.parametrize(
    "law", ["lambertian+gtr", "lambertian+sgd", "lambertian+sgd-published", "ggx+coated:lambertian"]
)
def test_laws_whose_masking_is_an_integral_and_lobes_on_a_coat_are_derived(law):
    answer = answered(made(law), (law,))
    found = verified(answer)
    assert not found.wrong and not found.left and len(stderrs(found)) == printed(answer[1])


def test_a_changed_digit_of_any_standard_error_is_found():
    answer = answered(made())
    for row, entry in enumerate(answer[1]["ranking"]):
        for key in (key for key, each in entry["parameters"].items() if each["stderr"] is not None):
            changed = deepcopy(answer[1])
            target = changed["ranking"][row]["parameters"][key]
            before = target["stderr"]
            target["stderr"] = [_one_digit_off(before[0])] if isinstance(before, list) else _one_digit_off(before)
            wrong = [each.place for each in verified((answer[0], changed)).wrong]
            assert any(f"ranking[{row}].parameters.{key}.stderr" in place for place in wrong)


@pytest.mark.parametrize("turns", [[0.0], [10.0, 190.0, 100.0]])
def test_neighbours_are_put_in_the_order_of_the_fit(turns):
    """In whole scans most directions have others alike in tilt or half angle."""
    turn, theta_i, theta_r = (
        each.ravel() for each in np.meshgrid(turns, [0.0, 20.0, 40.0, 60.0], np.arange(-80.0, 81.0, 10.0))
    )
    from brdfguide.physics.geometry import Geometry

    phi = np.where(theta_r < 0, 0.0, 180.0)
    geom = rows(Geometry.from_degrees(theta_i, turn, np.abs(theta_r), turn + phi))
    data = verification.readings_of(
        Measurement(geom, np.ones((len(turn), 1))), {"data": {"channels": ["1"], "findings": []}, "noise": {}}
    )
    measurement = Measurement(geom, np.ones((len(turn), 1)))
    for ours, wanted in zip(
        exact_neighbours.orders_of_neighbours(data), standard_errors.orderings(measurement), strict=True
    ):
        assert ours == wanted.tolist()
    ways = [standard_errors.even_blocks(each) for each in standard_errors.orderings(measurement)[1:]]
    for blocks, wanted in zip(exact_neighbours.ways_to_cut(data)[1:], ways, strict=True):
        assert blocks == wanted.tolist()


@pytest.fixture(scope="module")
def drifted():
    """Scans with gains of their own and an arm that stands beside its zero, and the answer on them."""
    law, rng = models.get("lambertian+ggx"), np.random.default_rng(1)
    geom = rows(synthetic.scan(theta_i=(15, 30, 45, 60, 70), step=4.0))
    clean = synthetic.surface(
        law, arm_turned(geom, 0.15), {**law.defaults(), "lambertian.albedo": 0.3, "ggx.alpha": 0.15}
    )
    gains = dict(zip((15, 30, 45, 60, 70), np.exp(0.02 * rng.standard_normal(5)), strict=True))
    gain = np.array([gains[round(theta)] for theta in geom.theta_i_deg[:, 0]])[:, None]
    brdf = clean.brdf * gain * np.exp(0.003 * rng.standard_normal(clean.brdf.shape))
    return answered(Measurement(geom, brdf), ("lambertian+ggx", "lambertian+student-t", "lambertian+ward"))


def test_an_answer_beside_a_drifted_instrument_holds(drifted):
    found = verified(drifted)
    assert not found.wrong and not found.left
    places = [each.place for each in found.derived]
    assert "ranking[0].rms_ln" in places and "ranking[1].behind_se" in places
    assert "ranking[0].flags.instrument.gains_rms" in places
    without = next(row for row in drifted[1]["ranking"] if "instrument" not in {each["code"] for each in row["flags"]})
    assert without["candidate"] == "lambertian+ward" and len(without["instrument"]["ln_gains"]) == 5


def test_so_does_one_that_told_it_in_flags_alone(drifted):
    """As answers did before rows had `instrument`; then a row whose misfit is a discrepancy is left out."""
    document = deepcopy(drifted[1])
    for row in document["ranking"]:
        del row["instrument"]
    found = verified((drifted[0], document))
    assert not found.wrong and list(found.left) == ["lambertian+ward"]


@pytest.mark.parametrize("number", ["zero_deg", "ln_gain_45", "gains_rms"])
def test_a_changed_digit_of_what_the_instrument_did_is_found(drifted, number):
    changed = deepcopy(drifted[1])
    flag = next(each for each in changed["ranking"][0]["flags"] if each["code"] == "instrument")
    flag["numbers"][number] = _one_digit_off(flag["numbers"][number])
    assert f"ranking[0].flags.instrument.{number}" in {each.place for each in verified((drifted[0], changed)).wrong}


@pytest.mark.parametrize("key", ["zero_deg", "ln_gains"])
@pytest.mark.parametrize("row", [0, 2])
def test_so_is_one_beside_each_row(drifted, key, row):
    changed = deepcopy(drifted[1])
    told = changed["ranking"][row]["instrument"]
    if key == "ln_gains":
        told[key][1] = _one_digit_off(told[key][1])
    else:
        told[key] = _one_digit_off(told[key])
    assert any(each.place.startswith(f"ranking[{row}].") for each in verified((drifted[0], changed)).wrong)


def test_every_angle_that_is_told_in_degrees_is_known():
    told = {
        (name, law)
        for law in exact_surface.KNOWN
        for parameter in models.term(law).parameters
        if (name := parameter.name) and parameter.outside(1.0) != 1.0
    }
    assert told <= {(name, law) for name, laws in exact_surface.ANGLES.items() for law in laws}


def test_faults_that_were_counted_as_doubt_leave_standard_errors_alone():
    measurement, document = answered(made())
    data = replace(verification.readings_of(measurement, document), faults=True)
    assert not stderrs(verification.verify(document, data))


@pytest.mark.parametrize("phi", [90.0, -90.0, 270.0, 450.0])
def test_directions_at_right_angles_to_the_plane_are_in_one_order(phi):
    theta_i, theta_r = (each.ravel() for each in np.meshgrid([10.0, 35.0, 70.0], np.arange(0.0, 80.0, 5.0)))
    for light in (0.0, 180.0, 33.3):
        geom = rows(Geometry.from_degrees(theta_i, light, theta_r, light + phi))
        assert np.all(geom.signed_theta_r_deg >= 0)
        angles = tuple((i, light, r, light + phi) for i, r in zip(theta_i.tolist(), theta_r.tolist(), strict=True))
        data = exact_errors.Readings(angles, ((1.0,),) * len(angles), (0.0,), (0.55,))
        assert data.signed_theta_r == geom.signed_theta_r_deg[:, 0].tolist()


@pytest.mark.parametrize("turns", [[0.0], [0.0, 90.0, 45.0], [10.0, 190.0, 100.0]])
@pytest.mark.parametrize("incidences", [[30.0], [0.0, 20.0, 50.0]])
def test_neighbours_of_a_turned_samples_scans_are_those_of_the_fit(turns, incidences):
    turn, theta_i, theta_r = (each.ravel() for each in np.meshgrid(turns, incidences, np.arange(-80.0, 81.0, 4.0)))
    phi_r = turn + np.where(theta_r < 0, 0.0, 180.0)
    measurement = Measurement(
        rows(Geometry.from_degrees(theta_i, turn, np.abs(theta_r), phi_r)), np.ones((len(turn), 1))
    )
    angles = tuple(zip(theta_i.tolist(), turn.tolist(), np.abs(theta_r).tolist(), phi_r.tolist(), strict=True))
    data = exact_errors.Readings(angles, ((1.0,),) * len(turn), (0.0,), (0.55,))
    wanted = standard_errors.blocks_of(measurement, standard_errors.along_scans(measurement))
    together = np.array(exact_errors.neighbours_of_scans(data))
    assert len(set(zip(together.tolist(), wanted.tolist(), strict=True))) == len(set(wanted.tolist()))
    assert len(set(together.tolist())) == len(set(wanted.tolist()))


def test_slopes_that_are_parallel_but_for_rounding_have_no_inverse():
    parallel = exact_intervals._Equations(row=None, part=None)
    with workdps(30):
        one = {(row, 0): mpf(row + 1) / 7 for row in range(6)}
        for over in range(3, 40):  # rounded another way each time; the inverse is of either sign
            other = {at: value * 1000 / over for at, value in one.items()}
            even = {at: mpf(1) / over for at in one}
            vars(parallel)["columns"] = [one, other, even]
            vars(parallel).pop("inverse", None)
            found = parallel.inverse
            assert found is None or found[1] > mpf(10) ** 20
