"""What to type into other programs: in answers, in JSON where asked for, and on every page."""

import json
import re

import pytest

from brdfguide.report.text.numbers import card_text

from .test_advice import answer, run

PLASTIC = "examples/rough_plastic.csv"


def test_a_described_metal_comes_with_what_to_type():
    found = answer("recommend", "copper", "-m", "ggx", "--numbers", "--no-timing")
    by_program = {each["program"]: each for each in found["numbers"]}
    assert len(by_program) == 8
    typed = by_program["Blender"]["numbers"]
    alpha = found["candidates"][0]["start"]["ggx.alpha"]
    assert typed["Metallic"] == 1.0 and typed["Roughness"] == pytest.approx(alpha**0.5, rel=0.02)
    assert re.fullmatch("#[0-9a-f]{6}", by_program["Blender"]["hex"]["Base Color"])
    assert by_program["Blender"]["measured_rms_ln"] is None


def block_of(*words) -> list[str]:
    """The lines of the block in an answer for people."""
    text = run(*words, "--no-timing").stdout
    return text[text.index("numbers to type") :].splitlines()


def test_a_line_for_each_program_begins_with_how_far_off_it_is_and_fits_a_terminal():
    head, *rows, under = block_of("recommend", "copper", "-m", "ggx")
    assert head.split() == ["numbers", "to", "type", "off", "colour", "metal", "rough"]
    assert len(rows) == 8 and max(map(len, (head, *rows, under))) <= 80
    assert re.fullmatch(r"  Unreal +[\d.]+ %  #[0-9a-f]{6} +1 +0\.\d+", rows[3])
    assert under.startswith("off: from ggx by the program's formula")


def test_a_coat_and_a_grain_stand_in_one_line_under_words_that_say_their_order():
    coated = block_of("recommend", "lacquered-brass")
    assert re.search(r"OpenPBR .* coat 1/0/1\.\d+$", "\n".join(coated), re.M)
    assert "coat: weight/roughness/index" in " ".join(" ".join(coated).split())
    grained = block_of("recommend", "brushed-steel")
    assert re.search(r"Substance .* grain 0\.\d+/0$", "\n".join(grained), re.M)
    assert max(map(len, (*coated, *grained))) <= 80


def test_it_is_left_out_where_told_and_where_nothing_is_seen():
    assert "numbers to type" not in run("recommend", "copper", "--no-numbers").stdout
    infrared = "theta_i_deg,theta_r_deg,phi_deg,brdf_10600nm\n" + "".join(
        f"{i},{r},180,{0.1 + 0.02 * (i == r)}\n" for i in (10, 40, 70) for r in range(0, 80, 10)
    )
    found = run("fit", "-", "-m", "lambertian+ggx", "--anyway", stdin=infrared)
    assert "recommended" in found.stdout and "numbers to type" not in found.stdout


def test_a_surface_that_no_shader_holds_is_said_to_be_one():
    far = {"program": "Unreal", "rms_ln": 0.9, "off_percent": 146.0, "measured_off_percent": None}
    assert "within a factor 2" in card_text([far])


def test_after_a_fit_the_error_against_the_measurement_stands_beside(tmp_path):
    page = tmp_path / "a.html"
    found = answer("fit", PLASTIC, "-m", "lambertian+ggx", "--report", page, "--no-timing")
    [openpbr] = [each for each in found["numbers"] if each["program"] == "OpenPBR"]
    assert found["ranking"][0]["rms_ln"] == pytest.approx(openpbr["measured_rms_ln"], abs=0.05)
    text = page.read_text()
    assert "Numbers to type" in text and openpbr["hex"]["base_color"] in text
    assert json.dumps(openpbr["measured_rms_ln"]) in text


def test_without_a_page_or_the_option_there_are_none():
    assert "numbers" not in answer("recommend", "copper", "-m", "ggx", "--no-timing")


@pytest.mark.parametrize("words, named", [("gltf", "gltf"), ("porcelain", "porcelain (lambertian+he-torrance)")])
def test_a_surface_is_named_once(words, named):
    assert run("numbers", words).stdout.startswith(f"{named}: the numbers to type")
