"""A shader's words in a description: what is typed means what it means there."""

import pytest

from brdfguide.advice import material
from brdfguide.advice.recommend import recommend
from brdfguide.errors import InputError
from brdfguide.physics.roughness_senses import AS_WIDE, SENSES, alpha_of


def of(**observations):
    return recommend(material.observed(observations))


def said(found, rule):
    return next(each for each in found.advice if each.rule == rule)


def test_a_red_paint_as_an_artist_types_it():
    found = of(base_color="#c83232", metallic=0, roughness=0.5, ior=1.45, appearance="solid colour")
    [ggx] = [each for each in found.candidates if each.model.name == "lambertian+ggx"]
    assert ggx.start["ggx.alpha"] == pytest.approx(0.25, rel=0.02) and ggx.start["ggx.n"] == 1.45
    assert ggx.start["lambertian.albedo"] == pytest.approx((0.5776, 0.0319, 0.0319), rel=1e-3)
    assert "#c83232" in said(found, "base_colour_of_body").says
    assert not found.unused


def test_a_metals_base_colour_is_its_reflectance_and_its_index_means_nothing():
    found = of(base_color=[0.95, 0.64, 0.54], metallic=1, roughness=0.3, ior=1.5)
    assert found.verdict == "metal" and found.material.f0 == (0.95, 0.64, 0.54)
    [ggx] = [each for each in found.candidates if each.model.name == "ggx"]
    assert ggx.start["ggx.alpha"] == pytest.approx(0.09, rel=0.02)
    assert found.unused == ("ior",)


@pytest.mark.parametrize(
    "sense, number", [("pbrt", 0.04), ("alpha", 0.2), ("glossiness", 1 - 0.2**0.5), ("blinn", 48.0), ("phong", 12.0)]
)
def test_whose_roughness_it_is_matters(sense, number):
    assert alpha_of(number, sense) == pytest.approx(0.2)
    assert material.observed({"roughness": number, "in": sense, "kind": "metal"}).typed_alpha == pytest.approx(0.2)


def test_wards_lobe_is_as_wide_as_ggx_at_half_its_height():
    alpha, half = 0.1, 2**0.5 - 1
    tan2 = half * alpha_of(alpha, "ward") ** 2
    assert 2.718281828459045 ** (-tan2 / alpha**2) == pytest.approx(0.5) and AS_WIDE > 1


def test_roughness_nothing_is_a_mirror():
    found = of(roughness=0, kind="metal")
    assert found.material.finish == "mirror" and found.candidates[0].model.has_mirror


@pytest.mark.parametrize(
    "text, sentence",
    [
        ("in: openpbr", "'in' says how 'roughness' is meant"),
        ("metallic: 0.5", "a surface is a metal, 1, or none, 0"),
        ("base_color: #c83232", "a colour such as #c83232 stands in quotes"),
        ("base_color: '#c832'", "'#rrggbb' in quotes, or linear numbers"),
        ("roughness: 3", "in openpbr it is at most 1"),
        ("{ior: 1.5, index: {n: 1.4}}", "one number twice"),
    ],
)
def test_what_means_nothing_is_refused_with_its_line(text, sentence):
    with pytest.raises(InputError) as error:
        material.parse_material(text)
    assert sentence in str(error.value) and str(error.value).startswith("<text>:1:")


def test_colour_is_never_invented_in_silence():
    paint = of(composition="car paint", appearance="metallic flake")
    assert "grey, flakes that send back 0.2" in said(paint, "grey_by_assumption").says
    assert said(of(appearance="solid colour"), "grey_by_assumption").guess
    coloured = of(appearance="solid colour", base_color="#c83232")
    assert all(each.rule != "grey_by_assumption" for each in coloured.advice)


def test_two_colours_that_differ_contradict_each_other():
    found = of(base_color="#c83232", diffuse_reflectance=0.9, kind="dielectric")
    assert said(found, "base_colour_of_body").conflict and found.material.albedo == (0.9,)


def test_every_sense_reads_its_greatest_number():
    for name, sense in SENSES.items():
        assert 0 <= alpha_of(min(sense.most, 1e4), name) <= 1
