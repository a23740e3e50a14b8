"""Shaders of their own: a fit of one is written as it is, a mirror becomes a coat, the best candidate is taken."""

import json
import re
from math import log, log1p

import numpy as np
import pytest

from brdfguide import exporters
from brdfguide.errors import NoAnswer
from brdfguide.exporters import coloured
from brdfguide.exporters._refit import Goal, TargetModel, least_of_amplitude, refit
from brdfguide.models.model import Parameter
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import in_plane, rows

OWN = {
    "openpbr": {"base_color": [0.8, 0.1, 0.05], "specular_roughness": 0.4, "coat_weight": 0.6, "coat_roughness": 0.2},
    "standard-surface": {"base_color": [0.3, 0.6, 0.05], "specular_roughness": 0.4, "sheen": 0.3, "coat": 0.0},
    "gltf": {"base_color": [0.3, 0.6, 0.05], "metallic": 1.0, "roughness": 0.4, "clearcoat": 1.0},
}


def of(expression, values=None):
    return coloured(Surface.named(expression, values or {}), "it")


@pytest.mark.parametrize("target", OWN)
def test_a_shader_is_written_as_it_is(target):
    made = exporters.export(target, of(target, OWN[target]))
    assert made.statement.status == "exact" and made.statement.rms_ln < 1e-6
    for name, value in OWN[target].items():
        written = made.statement.written[name]
        assert written == pytest.approx(value), name


def test_the_file_holds_the_numbers_of_the_statement():
    text = exporters.export("openpbr", of("openpbr", OWN["openpbr"])).content
    found = dict(re.findall(r'name="(\w+)" type="\w+" value="([^"]*)"', text))
    assert found["coat_weight"] == "0.6" and found["specular_roughness"] == "0.4"
    assert found["base_color"] == "0.8, 0.1, 0.05"
    material = json.loads(exporters.export("gltf", of("gltf", OWN["gltf"])).content)["materials"][0]
    assert material["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] == 1.0


@pytest.mark.parametrize(
    "target, coat", [("openpbr", "coat_weight"), ("standard-surface", "coat"), ("gltf", "clearcoat")]
)
def test_a_mirror_beside_a_finite_part_becomes_a_coat(target, coat):
    statement = exporters.export(target, of("lambertian+ggx+mirror", {"ggx.alpha": 0.3})).statement
    assert statement.written[coat] > 0.4 and statement.rms_ln < 0.35
    assert "mirror directions" in statement.over


def off(sentence: str) -> float:
    """The rms of ln of `7.4 % off` or `a factor 2.1 off` at the end of a sentence."""
    percent = re.search(r"([\d.]+) % off$", sentence)
    return log1p(float(percent[1]) / 100) if percent else log(float(re.search(r"a factor ([\d.]+) off$", sentence)[1]))


def test_both_readings_of_openpbr_are_told():
    metal = of("ggx", {"alpha": 0.5, "n": 1.2, "k": 6.0})
    [note] = exporters.export("openpbr", metal).statement.notes
    assert off(note) > 0.05 and "light between facets" in note


def test_of_several_candidates_the_target_gets_the_one_that_it_holds():
    ward, ggx = of("ward", {"alpha": 0.2}), of("ggx", {"alpha": 0.2, "n": 1.2, "k": 6.0})
    taken, made = exporters.held_best("standard-surface", [ward, ggx])
    assert taken is ggx and made.statement.rms_ln < 0.05
    assert "written of ggx" in made.statement.notes[-1]
    assert exporters.held_best("standard-surface", [ggx, ward])[0] is ggx


def test_flakes_under_a_coat_are_a_metallic_base_under_a_coat():
    paint = of("coated:flakes", {"flakes.flake": 0.2, "flakes.tilt": 0.13})
    statement = exporters.export("openpbr", paint).statement
    assert statement.written["base_metalness"] == 1.0 and statement.written["coat_weight"] == 1.0
    assert statement.status == "lossy" and "light is not bent" in statement.lost[-1]
    high = off(statement.lost[-1])
    assert high < 0.3 < statement.rms_ln, "it holds them where neither light nor eye is low"


def test_a_coats_mirror_is_not_given_up_for_a_better_number():
    coated, bare = of("ggx+mirror", {"ggx.alpha": 0.2, "ggx.n": 0.5, "ggx.k": 2.4}), of("ggx", {"alpha": 0.2})
    taken, made = exporters.held_best("openpbr", [coated, bare])
    assert taken is coated and made.statement.written["coat_weight"] > 0.4
    assert exporters.export("openpbr", bare).statement.rms_ln < made.statement.rms_ln


@pytest.mark.parametrize(
    "first, other",
    [
        (of("lambertian+beckmann", {"beckmann.alpha": 0.05}), of("lambertian+mirror")),
        (of("ggx-aniso", {"alpha_x": 0.2, "alpha_y": 0.04, "n": 1.2, "k": 6.0}), of("ggx", {"alpha": 0.09, "k": 6.0})),
        (of("lambertian+sheen"), of("lambertian+ggx", {"ggx.alpha": 0.35})),
        (of("lambertian+beckmann", {"beckmann.alpha": 0.04}), of("ggx", {"alpha": 0.04, "n": 1.2, "k": 6.0})),
    ],
    ids=["a highlight's width", "a grain", "a rim of fibres", "a body"],
)
def test_what_the_first_candidate_has_is_not_given_up_for_a_better_number(first, other):
    taken, made = exporters.held_best("usd", [first, other])
    assert taken is first
    assert exporters.export("usd", other).statement.rms_ln < made.statement.rms_ln


def test_what_is_far_off_says_what_the_shader_lacks():
    glossy = of("lambertian+ggx", {"ggx.alpha": 0.02, "lambertian.albedo": 0.8})
    [why] = exporters.export("openpbr", glossy).statement.lost
    assert "takes from the body" in why
    [why] = exporters.export("gltf", of("mirror", {"n": 1.5})).statement.lost
    assert "Schlick" in why


@pytest.mark.parametrize(
    "target, metalness", [("openpbr", "base_metalness"), ("standard-surface", "metalness"), ("gltf", "metallic")]
)
def test_smooth_glass_is_no_metal(target, metalness):
    written = exporters.export(target, of("mirror", {"n": 1.5})).statement.written
    assert written[metalness] == 0


@pytest.mark.parametrize("lobe", ["ggx", "mirror"])
def test_a_metal_is_no_glass_of_a_high_index(lobe):
    written = exporters.export("gltf", of(lobe, {"n": 3.18, "k": 4.41})).statement.written
    assert written["metallic"] == 1 and np.all(written["base_color"] > 0.5)


def test_a_refusal_names_the_nearest_target_and_the_nearest_law_with_their_errors():
    with pytest.raises(NoAnswer) as refused:
        exporters.held_best("usd", [of("lambertian+ggx+mirror", {"ggx.alpha": 0.3})])
    said = str(refused.value)
    target, error = re.search(r"(\S+) as a material holds it to rms ln (\S+?);", said).groups()
    held = exporters.export(target, of("lambertian+ggx+mirror", {"ggx.alpha": 0.3})).statement.rms_ln
    assert float(error) == pytest.approx(held, rel=0.1) and held < 0.1
    law, seen, error = re.search(r"that usd holds is (\S+): seen (\S+) L\* .* rms ln (\S+)$", said).groups()
    assert law == "lambertian+ggx" and float(seen) > 2, "the mirror is seen to be missing"
    assert float(error) < 1e-3, "its finite part is that law"


@pytest.mark.parametrize(
    "target, coat, index", [("openpbr", "coat_weight", "coat_ior"), ("standard-surface", "coat", "coat_ior")]
)
def test_a_coat_that_is_known_is_written_as_it_is(target, coat, index):
    varnish = of("coated:lambertian", {"lambertian.albedo": [0.5, 0.2, 0.1], "coat.n": 1.45})
    statement = exporters.export(target, varnish).statement
    assert statement.written[coat] == 1.0 and statement.written["coat_ior"] == 1.45
    assert statement.rms_ln < 0.16 and "light is not bent" in statement.lost[0]
    assert off(statement.lost[0]) < 0.08, "to 60 degrees"


def test_a_rough_coat_over_flakes_stays_a_coat():
    statement = exporters.export("openpbr", of("ggx+coated:flakes", {"ggx.alpha": 0.1})).statement
    assert statement.written["coat_weight"] == 1.0 and statement.written["coat_roughness"] > 0.2
    assert not any("become one" in each for each in statement.lost)


def test_what_no_amplitude_can_take_away_is_known_without_a_search():
    geom = rows(in_plane(40.0, np.linspace(-70, 70, 60)))
    amplitude = Parameter("albedo", 0.5, 0.0, 1.0, per_channel=True, linear=True)
    law = TargetModel((amplitude,), lambda geom, albedo: albedo * np.ones(geom.shape), broadcasts=True)
    wanted = np.exp(0.3 * np.sin(geom.theta_r_deg)) * np.array([0.2, 0.1, 0.05])
    goal = Goal(geom, wanted)
    assert np.isclose(least_of_amplitude(law, goal), refit(law, goal)[0], rtol=1e-3)
    assert least_of_amplitude(TargetModel((), law.brdf, broadcasts=True), goal) == 0.0
