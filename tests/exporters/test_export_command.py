"""`brdfguide export` at the command line, and pbrt's grammar."""

import json
import re
import subprocess
import sys

import pytest

from brdfguide import exporters

from ..conftest import ROOT
from .conftest import EVERY_LAW


def run(*words, cwd):
    return subprocess.run(
        [sys.executable, "-m", "brdfguide", *words],
        cwd=cwd,
        capture_output=True,
        text=True,
        env={"PYTHONPATH": str(ROOT), "PATH": ""},
    )


def test_writes_states_and_does_not_replace(tmp_path):
    words = (
        "export",
        "--model",
        "lambertian+ggx",
        "ggx.alpha=0.1",
        "lambertian.albedo=0.3,0.2,0.1",
        "--to",
        "gltf",
        "-o",
        "paint.gltf",
    )
    first = run(*words, cwd=tmp_path)
    assert first.returncode == 0 and first.stdout == ""
    assert re.match(r"gltf: refit, [\d.]+ % off \(rms ln 0\.", first.stderr)
    text = (tmp_path / "paint.gltf").read_text()
    again = run(*words, cwd=tmp_path)
    assert again.returncode == 2 and "paint.gltf exists; --force replaces it" in again.stderr
    forced = run(*words, "--force", "--json", cwd=tmp_path)
    assert (
        json.loads(forced.stdout)["status"] == "refit" and json.loads(forced.stdout)["schema"] == "brdfguide/export/1"
    )
    assert (tmp_path / "paint.gltf").read_text().replace(" --force --json", "") == text


def test_parameters_are_typed_as_evaluate_takes_them(tmp_path):
    """A name without a term belongs to every term that has it, and an angle is in degrees."""
    written = []
    for words in (("alpha=0.1", "spread=20"), ("ggx.alpha=0.1", "oren-nayar.spread=20")):
        made = run("export", "--model", "oren-nayar+ggx", *words, "--to", "glsl", "-o", "-", cwd=tmp_path)
        written.append(made.stdout.partition("surface:")[2])
    assert written[0] == written[1] and "oren-nayar.spread=0.349066" in written[0]
    beyond = run("export", "--model", "oren-nayar+ggx", "spread=200", "--to", "glsl", "-o", "-", cwd=tmp_path)
    assert beyond.returncode == 2 and "spread = 200 is outside 0..37.8152 deg" in beyond.stderr


def test_error_gate_writes_nothing(tmp_path):
    gated = run("export", "--model", "ward", "--to", "usd", "-o", "w.usda", "--max-export-error", "0.01", cwd=tmp_path)
    assert gated.returncode == 1 and "nothing was written" in gated.stderr and not (tmp_path / "w.usda").exists()


def test_wrong_words_are_sentences(tmp_path):
    for words, said in (
        (("export", "--model", "ggx", "ggx.alhpa=0.1", "--to", "usd", "-o", "x"), "did you mean ggx.alpha"),
        (("export", "--model", "ggx", "ggx.alpha=wide", "--to", "usd", "-o", "x"), "wanted one number, or three"),
        (("export", "--model", "ggx", "alpha=-2", "--to", "usd", "-o", "x"), "alpha = -2 is outside 0.0001..1.5"),
        (("export", "--to", "usd", "-o", "x"), "what to export"),
        (("export", "--model", "ggx", "--to", "usd"), "-o FILE is missing"),
        (("export", "--model", "ggx", "--to", "usd", "-o", "."), "cannot write .: it is a folder"),
        (
            ("export", "--model", "ggx", "--to", "usd", "-o", "x", "--max-export-error", "-1"),
            "--max-export-error -1: wanted an rms ln of 0 or more",
        ),
        (
            ("export", "--model", "ggx", "--to", "usd", "-o", "x", "--max-export-error", "nan"),
            "wanted an rms ln of 0 or more",
        ),
    ):
        made = run(*words, cwd=tmp_path)
        assert made.returncode == 2 and said in made.stderr and "Traceback" not in made.stderr, made.stderr


@pytest.mark.parametrize(
    "spec, said",
    [
        ("foo:b.z", "no exporter called 'foo'"),
        ("mitsuba", "'mitsuba' is not TARGET:FILE"),
        ("usd:no/b.usda", "there is no folder no"),
        ("usd:a.xml", "--export names a.xml twice"),
    ],
)
def test_wrong_export_among_right_ones_is_said_before_anything_is_done(spec, said, tmp_path):
    made = run(
        "fit", str(ROOT / "examples/rough_plastic.csv"), "--export", "mitsuba:a.xml", "--export", spec, cwd=tmp_path
    )
    assert made.returncode == 2 and said in made.stderr and made.stdout == "" and list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["lambertian", "ggx", "paint", "mirror", "polish"])
def test_pbrt_file_follows_its_grammar(name):
    """Directives with quoted names; parameters `"type name" value` or `[ values ]`; every material that a mix names is
    made before it.
    """
    body = "\n".join(
        line for line in exporters.export("pbrt", EVERY_LAW[name]).content.splitlines() if not line.startswith("#")
    )
    made = []
    for material in body.split("MakeNamedMaterial")[1:]:
        title, _, rest = material.strip().partition("\n")
        parameters = re.findall(r'"(string|float|bool|spectrum|rgb) (\w+)" (\[[^\]]*\]|"[^"]*"|\S+)', rest)
        assert re.fullmatch(r'"\w+"', title) and parameters[0][:2] == ("string", "type")
        assert re.sub(r'"(string|float|bool|spectrum|rgb) (\w+)" (\[[^\]]*\]|"[^"]*"|\S+)', "", rest).strip() == ""
        for kind, key, value in parameters:
            if kind == "rgb":
                assert len(value.strip("[ ]").split()) == 3
            if kind == "spectrum":
                assert len(value.strip("[ ]").split()) % 2 == 0
            if key == "materials":
                assert all(each in made for each in re.findall(r'"\w+"', value))
            if key == "remaproughness":
                assert value == "false"
        made.append(title)
    assert made
