"""A law is one file: a new one in models/ is found, ranked, advised, drawn, checked and exported by every command."""

import json
import os
import re
import shutil
import subprocess
import sys

import pytest

from ..conftest import ROOT

LAW = '''"""Ashikhmin and Shirley's lobe about the half vector, isotropic, with Schlick's Fresnel factor.

    f = (n + 1)/(8π) cosⁿδ / (cos θd max(cos θi, cos θr)) (F0 + (1 - F0)(1 - cos θd)⁵),   δ from normal to half vector

Source: Ashikhmin and Shirley 2000, "An anisotropic Phong BRDF model", section 3 with equal exponents.
"""

from math import pi

import numpy as np

from ..physics.geometry import Geometry
from .facts import Candidacy, Formula
from .model import Extreme, Model, Parameter, Pin, at


def brdf(geom: Geometry, *, f0, exponent) -> np.ndarray:
    """Lobe [1/sr], in the shape of `geom`."""
    lobe = (exponent + 1) / (8 * pi) * np.exp(-0.5 * exponent * geom.ln_sec2_h)
    fresnel = f0 + (1 - f0) * (1 - geom.cos_d) ** 5
    return lobe * fresnel / (geom.cos_d * np.maximum(geom.cos_i, geom.cos_r))


def at_normal(geom: Geometry, *, f0, exponent) -> np.ndarray:
    """The same with F0 at every angle."""
    lobe = (exponent + 1) / (8 * pi) * np.exp(-0.5 * exponent * geom.ln_sec2_h)
    return lobe * f0 / (geom.cos_d * np.maximum(geom.cos_i, geom.cos_r))


MODEL = Model(
    __name__,
    brdf,
    parameters=(
        Parameter("f0", 0.04, 0.0, 1.0, per_channel=True, meaning="reflectance of a facet", starts=(0.04, 0.5, 0.9)),
        Parameter("exponent", 100.0, 0.1, 1e6, log=True, meaning="n", starts=(10.0, 100.0, 1000.0)),
    ),
    without={"fresnel": at_normal},
    summary="half-vector lobe with Schlick's Fresnel factor",
    pins=(Pin(at(45, 45), {"f0": 0.2, "exponent": 50.0}, f=PIN, source="the formula by hand", rtol=1e-14),),
    extremes=(Extreme("light from where it is seen, low", at(89.99, -89.99), {"f0": 1.0}),),
    source="Ashikhmin and Shirley 2000",
    family="facets",
    cannot="no mirror image",
    candidacy=CANDIDACY,
    from_facets=lambda facets: {"f0": facets.f0, "exponent": facets.half_exponent},
    formula=FORMULA,
)
'''
# at the mirror direction δ = 0 and θd = 45°: 51/(8π) (0.2 + 0.8 (1 - √½)⁵)/(√½ √½)
PIN = "51 / (8 * pi) * (0.2 + 0.8 * (1 - 0.5**0.5) ** 5) / 0.5"
FORMULA = """Formula(
        "half_phong(ci, cr, q, {f0}, {exponent})",
        (
            (
                "half_phong",
                "ci, cr, q, f0, n",
                "(n + 1.0) / (8.0 * PI) * exp(0.5 * n * ln1m(sin2h(ci, cr, q))) / (cosd(ci, cr, q) * most(ci, cr))"
                " * (f0 + (1.0 - f0) * sq(sq(1.0 - cosd(ci, cr, q))) * (1.0 - cosd(ci, cr, q)))",
            ),
        ),
    )"""
RUN = """
import contextlib, io, json, sys, traceback
from brdfguide.cli import main
import brdfguide
answers = []
for words in json.load(sys.stdin):
    out, err, status = io.StringIO(), io.StringIO(), 0
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            main(words)
        except SystemExit as stop:
            status = stop.code
        except BaseException:
            status, _ = "traceback", traceback.print_exc()
    answers.append([status, out.getvalue(), err.getvalue()])
sys.__stdout__.write(json.dumps([brdfguide.__file__, answers]))
"""
NAME = "half-phong"
PLASTIC, METAL = (str(ROOT / "examples" / f"{name}.csv") for name in ("rough_plastic", "rough_aluminium"))
TYPED = [f"lambertian+{NAME}", "lambertian.albedo=0.3", f"{NAME}.f0=0.05", f"{NAME}.exponent=60"]


def house(folder, candidacy: str, formula: str):
    """The package as it stands and the new law in it."""
    shutil.copytree(ROOT / "brdfguide", folder / "brdfguide", ignore=shutil.ignore_patterns("__pycache__"))
    text = LAW.replace("PIN,", f"{PIN},").replace("CANDIDACY", candidacy).replace("FORMULA", formula)
    (folder / "brdfguide" / "models" / "half_phong.py").write_text(text)
    (folder / "materials").symlink_to(ROOT / "materials")
    (folder / "pyproject.toml").symlink_to(ROOT / "pyproject.toml")
    return folder


def run(folder, *lines: list[str]) -> list[tuple]:
    """(status, standard output, standard error) of each command line, all in one process of the new house."""
    environment = dict(os.environ, PYTHONPATH=str(folder), PYTHONDONTWRITEBYTECODE="1")
    done = subprocess.run(
        [sys.executable, "-c", RUN],
        cwd=folder,
        env=environment,
        input=json.dumps(lines),
        capture_output=True,
        text=True,
        check=True,
    )
    where, answers = json.loads(done.stdout)
    assert where.startswith(str(folder))
    for words, (status, _, err) in zip(lines, answers, strict=True):
        assert status in (0, 1, 2), f"{' '.join(words)}: {err}"
    return answers


def answered(folder, *lines):
    """Their standard output; every one must succeed."""
    answers = run(folder, *lines)
    for words, (status, _, err) in zip(lines, answers, strict=True):
        assert status == 0, f"{' '.join(words)}: {err}"
    return [out for _, out, _ in answers]


@pytest.fixture(scope="module")
def new(tmp_path_factory):
    return house(tmp_path_factory.mktemp("new"), "Candidacy(75, bare=True)", FORMULA)


@pytest.fixture(scope="module")
def quiet(tmp_path_factory):
    """The same law, which asks to be tried nowhere by itself and has no text for shaders."""
    return house(tmp_path_factory.mktemp("quiet"), "None", "None")


def ranked(text: str) -> list[str]:
    return [row["candidate"] for row in json.loads(text)["ranking"]]


def test_it_is_listed_and_explained(new):
    listed, shown = answered(new, ["models", "--json"], ["models", NAME])
    assert NAME in [each["name"] for each in json.loads(listed)["models"]]
    assert shown.startswith("Ashikhmin and Shirley's lobe") and "exponent" in shown
    assert shown.endswith("cannot: no mirror image\ntried by `fit` by default\n")


def test_the_default_ranking_tries_it_where_it_says_so(new):
    fit = ["--json", "--no-timing", "--quiet"]
    plastic, metal = answered(new, ["fit", PLASTIC, *fit], ["fit", METAL, *fit])
    assert f"lambertian+{NAME}" in ranked(plastic)
    assert NAME in ranked(metal)


def test_named_alone_it_is_fitted_drawn_and_reported(new):
    line = ["fit", PLASTIC, "-m", f"lambertian+{NAME}", "--no-timing", "--json"]
    pages = ["--plot", "a.png", "--report", "a.html", "--residuals", "a.csv", "--next", "--scene", "default"]
    (text,) = answered(new, [*line, *pages])
    assert ranked(text) == [f"lambertian+{NAME}"]
    assert all((new / name).stat().st_size > 1000 for name in ("a.png", "a.html", "a.csv"))
    assert NAME in (new / "a.html").read_text()
    (new / "fit.json").write_text(text)
    check, values = answered(new, ["check", "--fit", "fit.json"], ["evaluate", "--fit", "fit.json"])
    assert NAME in check and values.count("\n") > 50


def test_it_is_advised_with_start_values_from_the_description(new):
    line = ["recommend", "porcelain", "--models", f"lambertian+{NAME}", "--json", "--no-timing"]
    (first,) = json.loads(answered(new, line)[0])["candidates"]
    assert first["start"][f"{NAME}.f0"] == pytest.approx([0.04], abs=0.02)
    assert first["start"][f"{NAME}.exponent"] > 1000 and f"{NAME}: no mirror image" in first["cannot"]
    answered(new, ["recommend", "porcelain", "--models", NAME, "--plot", "b.png", "--report", "b.html"])
    answered(new, ["recommend", "porcelain", PLASTIC, "--models", f"lambertian+{NAME}", "--no-timing"])


def test_it_is_evaluated_previewed_timed_and_audited(new):
    lines = (
        ["evaluate", NAME, "f0=0.2", "exponent=50", "--theta-i", "45", "--theta-r", "45", "--json"],
        ["preview", " ".join(TYPED), "--size", "64", "-o", "look.png"],
        ["bench", "-m", NAME, "--json"],
        ["check", NAME, "--json"],
    )
    value, _, bench, check = answered(new, *lines)
    assert f"{51 / (8 * 3.141592653589793) * 0.40344:.4g}"[:4] in value
    assert {row["model"] for row in json.loads(bench)["rows"]} == {NAME}
    assert not [each for each in json.loads(check)["models"][0]["checks"] if each["verdict"] == "fails"]


def test_every_target_writes_a_file(new):
    targets = [each["target"] for each in json.loads(answered(new, ["export", "--json"])[0])["targets"]]
    answered(new, *(["export", "--model", *TYPED, "--to", target, "-o", f"{target}.out"] for target in targets))
    assert len(targets) > 10 and all((new / f"{target}.out").stat().st_size > 200 for target in targets)
    assert "bg_half_phong(float ci" in (new / "glsl.out").read_text()


@pytest.mark.parametrize("target, nearest", [("glsl", "merl"), ("osl", "merl"), ("radiance-cal", "radiance")])
def test_without_a_formula_a_shader_refuses_it_in_one_sentence_that_helps(quiet, target, nearest):
    line = ["export", "--model", *TYPED, "--to", target, "-o", "shader.out"]
    refused, instead = run(quiet, line, [*line[:-3], nearest, "-o", f"{target}.instead"])
    assert refused[0] == 1 and not (quiet / "shader.out").exists()
    assert refused[2].count("\n") == 1 and f"{NAME} states no formula for shaders" in refused[2]
    assert f"the nearest target that can is {nearest}" in refused[2]
    assert f"the nearest law that {target} holds is lambertian+ggx" in refused[2]
    assert instead[0] == 0 and (quiet / f"{target}.instead").is_file()


def test_one_that_asks_for_nothing_is_fitted_only_where_it_is_named(quiet):
    fit = ["fit", PLASTIC, "--json", "--no-timing", "--quiet"]
    default, named, shown = answered(quiet, fit, [*fit, "-m", f"lambertian+{NAME}"], ["models", NAME])
    assert f"tried where it is named: -m {NAME}" in shown and "states no formula for shaders" in shown
    assert not any(NAME in each for each in ranked(default))
    assert ranked(named) == [f"lambertian+{NAME}"]


def test_a_parameter_called_k_is_no_index_of_absorption(tmp_path):
    law = house(tmp_path, "None", "None") / "brdfguide" / "models" / "half_phong.py"
    law.write_text(re.sub(r"\bexponent\b", "k", law.read_text()))
    (text,) = answered(tmp_path, ["fit", PLASTIC, "-m", f"lambertian+{NAME}", "--json", "--no-timing", "--quiet"])
    assert ranked(text) == [f"lambertian+{NAME}"]
