"""Velvet, reflective sheeting, brushed metal, wet stone: numbers that have the property they stand for."""

import numpy as np
import pytest

from brdfguide.advice.material import parse_material
from brdfguide.advice.recommend import recommend
from brdfguide.physics import fresnel, substances
from brdfguide.physics.geometry import Geometry, in_plane


def first(text: str):
    found = recommend(parse_material(text))
    assert found.status == "flagged"
    return found.candidates[0]


@pytest.mark.parametrize("theta", [10.0, 30.0, 60.0])
def test_a_retro_reflector_is_brightest_toward_the_light(theta):
    surface = first("retroreflective: true\ndiffuse_reflectance: 0.2").surface
    scan = np.arange(-89.0, 90.0)
    values = surface.brdf(in_plane(np.full((179, 1), theta), scan[:, None]))[:, 0]
    assert scan[values.argmax()] == -theta


def test_reflective_sheeting_sends_back_what_its_standard_asks_for():
    surface = first("retroreflective: true\ndiffuse_reflectance: 0.2").surface
    assert float(surface.brdf(in_plane([[0.2]], 0.0))[0, 0]) == pytest.approx(70, rel=0.05)


def test_velvet_is_brighter_at_the_rim_than_its_body():
    pick = first("structure: velvet\ndiffuse_reflectance: 0.1")
    assert pick.model.name == "lambertian+sheen"
    near, rim = (float(pick.surface.brdf(in_plane([[theta]], -theta))[0, 0]) for theta in (10.0, 80.0))
    assert rim > 3 * near


def test_a_brushed_metal_has_a_streak_across_its_grain():
    surface = first("composition: stainless steel\nfinish: satin\ntexture: brushed").surface
    along, across = (
        float(surface.brdf(Geometry.from_degrees([[0.0]], 0.0, [[15.0]], phi))[0, 0]) for phi in (90.0, 0.0)
    )
    assert across > 5 * along


@pytest.mark.parametrize("gloss, law", [("{60: 12}", "beckmann"), ("{60: 15, 85: 25}", "he-torrance")])
def test_leather_has_the_highlight_that_was_read_over_a_body_of_steep_bumps(gloss, law):
    pick = first(f"composition: leather\nsteep: true\nbase_color: '#3a2214'\ngloss: {gloss}")
    assert pick.model.name == f"oren-nayar+{law}"
    assert pick.gloss[60] == pytest.approx(12 if law == "beckmann" else 15, abs=1)
    assert np.tan(pick.start["oren-nayar.spread"]) == pytest.approx(0.3 * np.sqrt(2))  # sigma/tau 0.3, along a line


def test_an_alloy_has_the_colour_of_the_metal_it_is_named_for_and_it_is_said_how_far_that_may_be_off():
    found = recommend(parse_material("composition: rose gold\nfinish: satin"))
    [said] = [each.says for each in found.guesses if each.rule == "index_of_alloy"]
    assert found.material.n == substances.find("gold").n
    copper, brass = (
        fresnel.f0(np.array(each.n), np.array(each.k)) for each in map(substances.find, ("copper", "brass"))
    )
    for change in brass / copper - 1:
        assert f"{abs(change):.0%}".replace("%", " %") in said


def test_no_candidate_reads_far_more_gloss_than_was_read():
    found = recommend(parse_material("composition: ABS\nfinish: satin\ngloss: {60: 35}\nemergence_angle_deg: 72"))
    assert "lafortune" in found.left_out
    assert max(each.gloss[60] for each in found.candidates) < 40


def test_house_paint_stays_without_a_highlight():
    assert first("composition: paint\nsteep: true\nfinish: matt\ngloss: {60: 1}").model.name == "oren-nayar"


@pytest.mark.parametrize("composition, body", [("wood", "lambertian+"), ("gold", "")])
def test_beside_gaussian_facets_stands_ggx_which_renderers_have(composition, body):
    seen = f"composition: {composition}\nhighlight_width_deg: {9 if body else 1.5}\nfinish: "
    found = recommend(parse_material(seen + ("satin\ngloss: {60: 42}" if body else "mirror"))).candidates
    assert [each.model.name for each in found[:2]] == [f"{body}beckmann", f"{body}ggx"]
    assert "which would read" in found[1].why and found[1].start["ggx.alpha"] != found[0].start["beckmann.alpha"]


def test_wet_stone_is_darker_than_dry():
    wet = first("composition: stone\nwet: true\ndiffuse_reflectance: 0.4")
    assert wet.model.name == "coated:lambertian" and wet.start["coat.n"] == 1.33
    value = float(wet.surface.brdf(in_plane([[0.0]], 30.0))[0, 0])
    assert 0.4 < value / (0.4 / np.pi) < 0.75
    assert float(wet.surface.mirror(in_plane([[0.0]], 0.0))[0, 0]) == pytest.approx((0.33 / 2.33) ** 2, rel=1e-6)


def test_what_does_not_have_the_property_says_so():
    found = recommend(parse_material("retroreflective: true\ncomposition: plastic\nfinish: satin"))
    for each in found.candidates:
        if "retro" not in each.model.name:
            assert "cannot shine back toward the light" in each.cannot


def test_every_candidate_for_a_wet_surface_is_as_dark_as_it_looks_wet_and_reflects_as_water():
    made = parse_material("composition: stone\nwet: true\ndiffuse_reflectance: 0.4")
    found = {each.model.name: each for each in recommend(made).candidates}
    bare, under = found["lambertian+mirror"], found["coated:lambertian"]
    assert bare.start["mirror.n"] == under.start["coat.n"] == 1.33
    away = in_plane([[0.0]], 30.0)  # Lambert's body sends the same share out evenly, the coated one less at grazing
    assert float(bare.surface.brdf(away)[0, 0]) == pytest.approx(float(under.surface.brdf(away)[0, 0]), rel=0.06)
