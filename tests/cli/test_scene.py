"""--scene at the command line: text, JSON, doubts, and the same bytes twice."""

import json
import subprocess
import sys

import pytest

from ..conftest import ROOT

PRODUCT = "examples/scenes/frontal_product_shot.yaml"
FIT = ("fit", "examples/rough_plastic.csv", "--models", "lambertian+ggx", "--scene")


def run(*words, status=0):
    done = subprocess.run([sys.executable, "-m", "brdfguide", *words], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == status, done.stderr
    return done


def test_fit_with_a_scene_says_what_can_go_and_where_that_holds():
    text = run(*FIT, PRODUCT).stdout
    assert "ggx.masking of lambertian+ggx" in " ".join(text.split())
    assert "<- picked" in text
    assert "holds for theta_i" in text
    assert "beyond the measured directions" in " ".join(text.split())


def test_json_carries_the_same_and_two_runs_are_alike():
    first, again = (run(*FIT, PRODUCT, "--json", "--no-timing").stdout for _ in range(2))
    assert first == again
    document = json.loads(first)
    block = document["scene"]
    assert block["without"] == [each["term"] for each in document["left_out"]]
    assert block["error"]["worst_visible"] <= block["tolerance"]["worst"]
    assert {each["code"] for each in block["findings"]} >= {"scene-beyond-data"}
    assert "time_per_sample_ns" not in first
    assert set(block["parameters"]) == {"lambertian.albedo", "ggx.alpha", "ggx.n", "ggx.k", "ggx.scale"}


def test_recommend_takes_a_scene_too():
    document = json.loads(run("recommend", "gloss-plastic", "--scene", "default", "--json").stdout)
    assert document["scene"]["model"] == document["candidates"][0]["model"]
    assert document["scene"]["time_per_sample_ns"]["whole"] > 0


@pytest.mark.parametrize("command", [FIT[:-1], ("recommend", "gloss-plastic")], ids=lambda words: words[0])
def test_a_missing_scene_is_one_sentence(command):
    assert (
        run(*command, "--scene", "nowhere.yaml", status=2).stderr.strip()
        == "brdfguide: nowhere.yaml: there is no such file"
    )


def test_without_timing_no_clock_decides_nor_speaks(tmp_path):
    """A part that saves little is left out by its operations, and a budget in ns is not judged."""
    tight = tmp_path / "tight.yaml"
    tight.write_text(
        "{name: tight, shape: plane, camera: {theta_deg: [0, 30]}, lights: [{theta_deg: [0, 30], radius_deg: "
        "5}], colour: grey, budget_ns: 1}"
    )
    assert "do not fit the budget" in " ".join(run("recommend", "satin-plastic", "--scene", str(tight)).stdout.split())
    first, again = (run("recommend", "satin-plastic", "--scene", str(tight), "--no-timing").stdout for _ in range(2))
    assert first == again and "budget" not in first
