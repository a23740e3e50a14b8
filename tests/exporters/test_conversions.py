"""One shader's numbers as another's: what two programs share comes through, and the error is of the two formulas."""

import json

import numpy as np
import pytest

from brdfguide.errors import InputError, NoAnswer
from brdfguide.exporters import conversions
from brdfguide.models import term

from ..cli.test_advice import run


def converted(source, to, **given):
    listed = {name: value if isinstance(value, list) else [value] for name, value in given.items()}
    return conversions.convert(conversions.read(source, listed), to)


def test_what_programs_share_comes_through():
    found = converted("gltf", "three.js", base_color=[0.8, 0.1, 0.1], roughness=0.4)
    assert found.rms_ln < 1e-6
    assert found.numbers == {"base_color": [0.8, 0.1, 0.1], "metallic": 0.0, "roughness": 0.4, "ior": 1.5}


@pytest.mark.parametrize(
    "to, name",
    [("openpbr", "specular_roughness"), ("unreal", "roughness"), ("substance", "roughness"), ("disney", "roughness")],
)
def test_a_metal_stays_a_metal_at_about_its_roughness(to, name):
    found = converted("gltf", to, base_color=[0.9, 0.6, 0.3], roughness=0.3, metallic=1)
    metal = "base_metalness" if to == "openpbr" else "metallic"
    assert found.numbers[metal] == 1.0 and found.numbers[name] == pytest.approx(0.3, abs=0.01)
    assert found.numbers["base_color"] == pytest.approx([0.9, 0.6, 0.3], abs=0.06) and found.rms_ln < 0.1


def test_the_error_is_between_the_two_formulas():
    from brdfguide.exporters._directions import judged_over, rms_ln

    source = conversions.read("gltf", {"base_color": [0.5], "roughness": [0.5]})
    found = conversions.convert(source, "openpbr")
    geom, wanted, _ = judged_over(source, None)
    assert rms_ln(term("openpbr")(geom, **term("openpbr").defaults() | found.numbers), wanted) == pytest.approx(
        found.rms_ln, rel=1e-6
    )
    assert 0.02 < found.rms_ln < 0.1


def test_pbrts_roughness_is_a_square_root_away():
    there = converted("pbrt", "openpbr", roughness=0.04, eta=1.2, k=6)
    assert there.numbers["specular_roughness"] ** 2 == pytest.approx(0.2, rel=0.03)
    back = converted("openpbr", "pbrt", base_color=0.5, specular_roughness=0.447)
    assert back.numbers["roughness"] == pytest.approx(0.04, rel=0.1)


def test_glossiness_is_one_less_roughness_and_specular_the_reflectance():
    found = converted("glossiness", "gltf", diffuse=0.2, specular=0.04, glossiness=0.7)
    assert found.numbers["roughness"] == pytest.approx(0.3) and found.numbers["ior"] == pytest.approx(1.5)
    gold = converted("glossiness", "gltf", specular=[1.0, 0.77, 0.34], glossiness=0.7)
    assert gold.numbers["metallic"] == 1.0 and gold.numbers["base_color"] == [1.0, 0.77, 0.34]
    again = converted("gltf", "glossiness", base_color=0.2, roughness=0.3)
    assert again.numbers["specular"] == pytest.approx(0.04) and again.numbers["glossiness"] == pytest.approx(0.7)


def test_radiances_plastic_is_wards_bounded_lobe_under_a_body():
    found = converted("radiance", "radiance", RGB=[0.5, 0.1, 0.1], specularity=0.04, roughness=0.1)
    assert found.rms_ln < 1e-4
    assert found.numbers["RGB"] == pytest.approx([0.5, 0.1, 0.1], rel=1e-3)
    assert found.numbers["specularity"] == pytest.approx(0.04, rel=1e-3)


def test_a_blinn_exponent_costs_what_its_shape_costs():
    found = converted("openpbr", "lambertian+blinn", specular_roughness=0.3)
    assert 100 < found.numbers["blinn.exponent"] < 500 and found.rms_ln > 0.3
    assert converted("lambertian+blinn", "gltf", albedo=0.5, exponent=50, ks=0.05).rms_ln > 0.1


def test_a_polished_body_is_polished_there_too():
    found = converted("gltf", "openpbr", base_color=0.6, roughness=0)
    assert found.numbers["specular_roughness"] == 0.0 and "coat_weight" not in found.numbers
    assert converted("gltf", "principled", roughness=0).numbers["roughness"] == 0.0
    with pytest.raises(NoAnswer, match="finite lobes"):
        converted("gltf", "disney", roughness=0)


@pytest.mark.parametrize(
    "source, given, sentence",
    [
        ("foo", {"a": [1.0]}, "no shader, program or law called 'foo'"),
        ("pbrt", {"rough": [1.0]}, "rough is no number of pbrt; there are: reflectance, roughness, eta, k"),
        ("gltf", {"roughness": [2.0]}, "roughness"),
        ("gltf", {"base_color": [0.1, 0.2]}, "wanted one, or three"),
    ],
)
def test_a_wrong_word_is_named(source, given, sentence):
    with pytest.raises(InputError, match=sentence):
        conversions.read(source, given)


def test_the_command_says_the_error_first_and_then_what_to_type():
    words = ("convert", "--from", "gltf", "--to", "openpbr", "base_color=0.8,0.1,0.1", "roughness=0.4")
    head, numbers = run(*words).stdout.splitlines()[:2]
    assert head.startswith("gltf as openpbr: ") and "% off" in head
    found = json.loads(run(*words, "--json").stdout)
    assert f"specular_roughness {found['numbers']['specular_roughness']:.4g}" in numbers
    assert found["hex"]["base_color"] in numbers and found["schema"] == "brdfguide/conversion/1"
    assert np.isclose(found["off_percent"], 100 * np.expm1(found["rms_ln"]), rtol=1e-3)
    assert "no number of pbrt" in run("convert", "--from", "pbrt", "--to", "gltf", "x=1", status=2).stderr
