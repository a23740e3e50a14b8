"""`--as`: what a shader can do for a measurement or a description, and exports in the JSON."""

import pytest

from .test_advice import answer, run

PLASTIC = "examples/rough_plastic.csv"


def test_fit_says_how_far_the_shader_is_from_the_measurement_and_the_best_law_beside_it(tmp_path):
    words = ("fit", PLASTIC, "-m", "lambertian+phong", "--as", "openpbr", "--export", f"openpbr:{tmp_path}/a.mtlx")
    found = answer(*words, "--no-timing")
    block, [written] = found["as"], found["exports"]
    assert block["candidate"].startswith("openpbr") and 0.05 < block["rms_ln"] < 0.1
    assert block["best_law"]["candidate"] == "lambertian+phong"
    assert block["best_law"]["rms_ln"] == found["ranking"][0]["rms_ln"]
    [otherwise] = block["readings"]
    assert "broad term" in otherwise["with"] and otherwise["rms_ln"] == pytest.approx(block["rms_ln"], rel=0.2)
    assert written["status"] == "exact" and written["rms_ln"] < 1e-6, "a shader's own fit is written as it is"
    assert written["measured_rms_ln"] == pytest.approx(block["rms_ln"], rel=0.1)
    assert written["files"] == [f"{tmp_path}/a.mtlx"]


def test_the_bound_on_an_exports_error_counts_against_the_measurement(tmp_path):
    file = tmp_path / "a.gltf"
    words = ("fit", PLASTIC, "-m", "lambertian", "--export", f"gltf:{file}", "--max-export-error", "0.3")
    done = run(*words, "--no-timing", status=1)
    assert not file.exists()
    assert "against the measurement" in done.stderr, "the target holds the model exactly, and the model is far off"


def test_a_described_metal_gets_the_candidate_that_the_shader_holds():
    found = answer("recommend", "copper", "--as", "standard-surface", "--no-timing")
    first, *rest = (each["model"] for each in found["candidates"])
    assert first == found["as"]["model"] == "ggx" and "ward" in rest, "the guidelines' first is ward, which none holds"
    assert "without --as ward comes first" in found["candidates"][0]["why"]
    assert found["recommended"] == found["as"]["model"] and found["as"]["rms_ln"] < 0.05
    assert found["as"]["written"]["metalness"] == 1.0


def test_an_unknown_shader_is_named_with_those_that_there_are():
    done = run("fit", PLASTIC, "--as", "lambert", status=2)
    assert "there are: disney, gltf, openpbr, standard-surface" in done.stderr
