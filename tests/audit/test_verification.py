"""`verify`: an answer's numbers derived again, and no changed digit that stays unseen."""

import ast
import json
import subprocess
import sys
from copy import deepcopy

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from mpmath import mp, mpf, workdps

from brdfguide import models
from brdfguide.audit import exact_surface, textbook_more, verification
from brdfguide.data.formats.format import InputError
from brdfguide.face.functions import fit
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import rows
from brdfguide.report.documents.digest import digest_holds

from .. import synthetic
from ..conftest import ROOT

MODELS = ("lambertian+ggx", "lambertian+he-torrance", "lambertian+lafortune:2", "lambertian+ward")
CODE = ("textbook", "textbook_more", "textbook_grain", "exact_surface", "exact_errors", "verification", "answer_shape")


def made(seed: int = 3, **options):
    """A small measurement of a made surface, and the answer on it."""
    model = models.get("lambertian+he-torrance")
    values = {**model.defaults(), "lambertian.albedo": 0.3, "he-torrance.sigma": 0.3, "he-torrance.slope": 0.12}
    geom = rows(synthetic.scan(theta_i=(15, 45, 70), step=10.0))
    data = synthetic.surface(model, geom, values, noise=0.03, seed=seed)
    return data, fit(data, MODELS, timing=False, **options)


@pytest.fixture(scope="module")
def answer():
    data, found = made()
    return found.measurement, json.loads(json.dumps(found.document))


def verified(answer, document=None):
    measurement, own = answer
    document = own if document is None else document
    return verification.verify(document, verification.readings_of(measurement, document))


def test_it_shares_no_code_with_models_fits_and_physics():
    for name in CODE:
        for node in ast.walk(ast.parse((ROOT / "brdfguide" / "audit" / f"{name}.py").read_text())):
            if isinstance(node, ast.ImportFrom) and node.level:
                target = "." * node.level + (node.module or "")
                assert target in (".", ".textbook", ".exact_surface", ".exact_errors", "..errors", "..data.measurement")


def test_an_honest_answer_holds(answer):
    found = verified(answer)
    assert not found.wrong and not found.left
    places = {each.place.partition(".")[2] for each in found.derived}
    assert {"rms_ln", "behind_se", "errors.cosine", "seen", "off_percent", "seen_from_best"} <= places
    assert any(place.endswith("he-torrance.tau.value[0]") for place in places)
    assert digest_holds(answer[1])


@pytest.mark.parametrize("options", [{"robust": True}, {"metric": "cube-root"}, {"shape_per_channel": True}])
def test_so_does_one_by_other_rules(options):
    data, found = made(**options)
    assert not verified((found.measurement, found.document)).wrong


def test_several_channels_through_an_aperture_hold_too():
    model = models.get("lambertian+mirror+ggx")
    geom = synthetic.scan(theta_i=(20, 60), step=8.0)
    made = synthetic.surface(model, geom, model.defaults(), noise=0.02, channels=3)
    from dataclasses import replace

    found = fit(replace(made, solid_angle=0.004), ("lambertian+ggx", "lambertian+mirror+ggx"), timing=False)
    result = verified((found.measurement, found.document))
    assert not result.wrong and len(result.derived) > 40


def test_a_changed_digit_of_any_derived_number_is_found(answer):
    measurement, document = answer
    for place in (each.place for each in verified(answer).derived):
        if place.startswith("ranking[0]") and "parameters" not in place and "flags" not in place:
            changed = deepcopy(document)
            *path, last = place.removeprefix("ranking[0].").split(".", 1) if "." in place[11:] else [place[11:]]
            target = changed["ranking"][0]
            for name in path:
                target = target[name]
            target[last] = _one_digit_off(target[last])
            assert place in [each.place for each in verified(answer, changed).wrong]


def test_a_changed_digit_of_a_parameter_is_found(answer):
    document = deepcopy(answer[1])
    for row in document["ranking"]:
        key = next(key for key, each in row["parameters"].items() if each.get("fitted"))
        entry = row["parameters"][key]
        before = entry["value"]
        entry["value"] = [_one_digit_off(v) for v in before] if isinstance(before, list) else _one_digit_off(before)
    wrong = {each.place.partition(".")[0] for each in verified(answer, document).wrong}
    assert wrong == {f"ranking[{place}]" for place in range(len(MODELS))}


def _one_digit_off(value):
    """The sixth significant digit one higher or lower."""
    if value == 0:
        return 1e-5
    digits = list(f"{value:.15e}")
    place = 7 if digits[0] != "-" else 8
    digits[place] = str(int(digits[place]) - 1 if digits[place] != "0" else 1)
    return float("".join(digits))


def test_the_digest_finds_what_does_not_follow(answer):
    document = deepcopy(answer[1])
    document["ranking"][1]["held_out_rms_ln"] *= 1.001
    assert not verified(answer, document).wrong and digest_holds(document) is False
    del document["digest"]
    assert digest_holds(document) is None


def test_other_data_are_refused_or_differ(answer):
    measurement, document = answer
    assert verified((measurement[5:], document)).wrong
    with pytest.raises(InputError, match="3 channels; the answer has 1"):
        three = synthetic.surface(models.get("lambertian"), synthetic.scan(), {}, channels=3)
        verification.readings_of(three, document)


def test_a_law_that_no_textbook_has_is_named(answer):
    document = deepcopy(answer[1])
    document["ranking"][0]["model"] = "lambertian+openpbr"
    assert "openpbr" in next(iter(verified(answer, document).left.values()))


@pytest.mark.parametrize("pin", models.term("he-torrance").pins, ids=lambda pin: pin.source)
def test_he_torrance_is_written_down_a_second_time(pin):
    angles = (pin.geom.theta_i_deg, pin.geom.phi_i_deg, pin.geom.theta_r_deg, pin.geom.phi_i_deg + pin.geom.phi_deg)
    values = {**models.term("he-torrance").defaults(), **pin.values, "wavelength": float(pin.geom.wavelength)}
    right = textbook_more.exact_value("he-torrance", [float(np.squeeze(a)) for a in angles], values)
    assert float(right) == pytest.approx(pin.f, rel=1e-15)


def test_a_coat_an_aperture_and_its_mirror_beam_are_too():
    from brdfguide.fitting.reading import reading
    from brdfguide.physics.aperture import Instrument
    from brdfguide.physics.geometry import Geometry

    surface = Surface.named("coated:lambertian+flakes", {"lambertian.albedo": 0.4, "coat.sigma": 0.05})
    geom = rows(Geometry.from_degrees([30.0, 30.0, 60.0], 0.0, [30.0, 10.0, 50.0], [180.0, 90.0, 181.0]))
    ours = reading(surface, Instrument(geom, 0.003))[:, 0]
    parameters = {key: {"value": float(np.squeeze(value))} for key, value in surface.values.items()}
    exact = exact_surface.surface_of("coated:lambertian+flakes", parameters)
    with workdps(30):
        for value, theta_i, theta_r, phi in zip(ours, (30, 30, 60), (30, 10, 50), (180, 90, 181), strict=True):
            sight = exact_surface.ExactReading((theta_i, 0.0, theta_r, phi), 0.003)
            assert value == pytest.approx(float(sight.reading(exact, 0, mpf(0.55))), rel=1e-11)
    assert mp.dps == 15


def test_the_command_ends_with_1_where_a_digit_was_changed_and_2_for_no_answer(tmp_path):
    def run(*words):
        return subprocess.run([sys.executable, "-m", "brdfguide", *words], cwd=ROOT, capture_output=True, text=True)

    made = run("fit", "examples/white_paper.csv", "-m", "lambertian+ggx", "--theta-max", "60", "--json")
    (tmp_path / "fit.json").write_text(made.stdout)
    honest = run("verify", str(tmp_path / "fit.json"))
    assert honest.returncode == 0 and "holds" in honest.stdout and "digest is intact" in honest.stdout
    document = json.loads(made.stdout)
    document["ranking"][0]["behind_se"] += 1e-4
    (tmp_path / "changed.json").write_text(json.dumps(document))
    changed = run("verify", str(tmp_path / "changed.json"), "--json")
    assert changed.returncode == 1 and json.loads(changed.stdout)["differ"][0]["place"] == "ranking[0].behind_se"
    (tmp_path / "none.json").write_text('{"schema": "brdfguide/fit/1"}')
    assert run("verify", str(tmp_path / "none.json")).returncode == 2
    wrong = run("verify", str(tmp_path / "fit.json"), "--model", "wrad")
    assert wrong.returncode == 2 and "no fitted model called 'wrad'" in wrong.stderr
