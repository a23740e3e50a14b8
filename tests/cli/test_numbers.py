"""`--numbers`: what to type into other programs, in answers, in JSON and on every page."""

import json
import re

import pytest

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


def test_a_row_for_each_program_begins_with_how_far_off_it_is_and_fits_a_terminal():
    text = run("recommend", "copper", "-m", "ggx", "--numbers", "--no-timing").stdout
    said = " ".join(text.split())
    assert re.search(
        r"Unreal [\d.]+ % Base Color #[0-9a-f]{6}, Metallic 1, Roughness 0\.\d+, Specular 0\.5 Substance", said
    )
    block = text[text.index("numbers to type") :].splitlines()
    assert max(map(len, block)) <= 80 and not any(line.strip().startswith("#") for line in block)


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
