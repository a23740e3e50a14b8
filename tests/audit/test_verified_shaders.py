"""`verify`: rows of production shaders, and files that hold a surface as another law."""

import json
from copy import deepcopy

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from mpmath import mpf, workdps

from brdfguide import exporters, models
from brdfguide.audit import textbook_shaders, verification
from brdfguide.audit.exact_targets import SHADERS
from brdfguide.audit.textbook import ExactDirections
from brdfguide.exporters import gltf_pbr
from brdfguide.face.functions import fit
from brdfguide.physics.geometry import Geometry
from brdfguide.report.documents.plain import plain

from .. import synthetic

REFITS = ("gltf", "gltf-pbr", "openpbr", "standard-surface", "mitsuba", "pbrt", "materialx", "usd", "radiance")
LAWS = [*map(models.term, textbook_shaders.LAWS), gltf_pbr.LAW]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.module.rpartition(".")[2])
def test_shaders_are_written_down_a_second_time_with_their_mirrors(law):
    brdf, mirror = SHADERS.get("gltf-pbr" if law is gltf_pbr.LAW else law.name, (textbook_shaders.disney, None))
    draw = np.random.default_rng(5)
    for _ in range(24):
        values = {p.name: draw.uniform(max(p.low, 0.2), min(p.high, 1.0 + (p.low > 1))) for p in law.parameters}
        for key in values:
            if key.endswith("roughness") and mirror and draw.random() < 0.4:
                values[key] = 0.0
        angles = draw.uniform((0, 0, 0, 0), (80, 360, 80, 360))
        geom = Geometry.from_degrees(*angles)
        with workdps(30):
            told = {key: mpf(float(value)) for key, value in values.items()}
            pair = ExactDirections(*angles)
            right = float(brdf(pair, **told))
            reflected = float(mirror(pair, **told)) if mirror else None
        assert float(np.squeeze(law(geom, **values))) == pytest.approx(right, rel=1e-11)
        if mirror:
            assert float(np.squeeze(law.mirror(geom, **values))) == pytest.approx(reflected, rel=1e-11, abs=1e-15)


def answer_on(model: str, values, candidates, targets, folder, **more):
    """The readings and the document of a fit to a made surface, with files of it."""
    geom = synthetic.scan(theta_i=(15, 45, 70), step=10.0)
    data = synthetic.surface(models.get(model), geom, values, noise=0.03, seed=3)
    found = fit(data, candidates, timing=False, anyway=True, **more)
    surface = exporters.coloured(found.ranking.recommended.fit.surface)
    told = [
        exporters.export_to(f"{target}:{folder / target}", surface, data.geom, measured=data.brdf)[1]
        for target in targets
    ]
    document = json.loads(json.dumps(found.document | {"exports": plain(told)}))
    return verification.readings_of(found.measurement, document), document


@pytest.fixture(scope="module")
def refitted(tmp_path_factory):
    return answer_on("lambertian+ggx", {}, ["lambertian+ggx"], REFITS, tmp_path_factory.mktemp("refitted"))


def test_every_refit_is_derived_from_the_numbers_in_its_file(refitted):
    readings, document = refitted
    found = verification.verify(document, readings)
    assert not found.wrong
    places = {each.place for each in found.derived}
    for number in range(len(REFITS)):
        assert {f"exports[{number}].{key}" for key in ("rms_ln", "directions", "measured_rms_ln")} <= places
    assert found.used > verification.verify(document | {"exports": []}, readings).used


@pytest.mark.parametrize("target", REFITS)
@pytest.mark.parametrize("key", ["rms_ln", "measured_rms_ln", "directions", "written"])
def test_a_changed_digit_of_them_is_found(refitted, target, key):
    readings, document = refitted[0], deepcopy(refitted[1])
    place = REFITS.index(target)
    entry = document["exports"][place]
    if key == "written":
        name = next(each for each in ("roughness", "specular_roughness", "alpha") if each in entry["written"])
        entry["written"][name] *= 1 + 1e-5
    else:
        entry[key] = entry[key] + 1 if key == "directions" else entry[key] * (1 + 1e-8)
    wrong = {each.place for each in verification.verify(document, readings).wrong}
    assert wrong and all(each.startswith(f"exports[{place}].") for each in wrong)
    assert key == "written" or wrong == {f"exports[{place}].{key}"}


def test_a_coats_mirror_is_judged_beside_what_lies_under_it(tmp_path):
    targets = ("gltf", "gltf-pbr", "openpbr", "standard-surface", "glsl")
    readings, document = answer_on(
        "coated:lambertian+flakes", {"lambertian.albedo": 0.3}, ["coated:lambertian+flakes"], targets, tmp_path
    )
    assert document["exports"][0]["over"].startswith("33 mirror directions")
    found = verification.verify(document, readings)
    places = {each.place for each in found.derived}
    assert not found.wrong and {f"exports[{n}].measured_rms_ln" for n in range(len(targets))} <= places
    document["exports"][1]["written"]["clearcoat"] *= 1 + 1e-4
    assert {each.place for each in verification.verify(document, readings).wrong} == {
        "exports[1].rms_ln",
        "exports[1].measured_rms_ln",
    }


@pytest.mark.parametrize("key", ["rms_ln", "off_percent", "parameters"])
def test_rows_of_shaders_are_derived_and_a_changed_digit_of_them_is_found(key, shader_rows):
    readings, document = shader_rows[0], deepcopy(shader_rows[1])
    found = verification.verify(document, readings)
    assert not found.wrong and not found.left
    assert sum(".stderr" in each.place for each in found.derived) >= 3
    row = document["ranking"][1]
    if key == "parameters":
        name = next(each for each in row["parameters"] if each.endswith("roughness"))
        row["parameters"][name]["value"] *= 1 + 1e-7
    else:
        row[key] *= 1 + 1e-8 if key == "rms_ln" else 1.01
    assert any(each.place.startswith("ranking[1]") for each in verification.verify(document, readings).wrong)


@pytest.fixture(scope="module")
def shader_rows(tmp_path_factory):
    shaders = list(textbook_shaders.LAWS)
    return answer_on("lambertian+ggx", {}, shaders, (), tmp_path_factory.mktemp("rows"))
