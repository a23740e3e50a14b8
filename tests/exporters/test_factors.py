"""Factors as tables: what a reader of the JSON and of the GLSL has is what the statement was judged by."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest

from brdfguide import exporters
from brdfguide.errors import NoAnswer
from brdfguide.exporters import factors
from brdfguide.exporters._directions import judged_over, rms_ln

from .conftest import EVERY_LAW, directions, surface

CLOSE = {"paint": 0.005, "ggx": 0.02, "student-t": 0.02, "ward-gmd": 0.02, "blinn": 0.01, "low-facet": 0.02}


@pytest.mark.parametrize("name, most", CLOSE.items())
def test_laws_of_this_form_are_held(name, most):
    made = exporters.export("factors", EVERY_LAW[name])
    assert made.statement.status == "refit" and made.statement.rms_ln < most


@pytest.mark.parametrize("alpha", [0.01, 0.0045, 0.001])
def test_a_body_stays_beside_a_lobe_a_million_times_brighter(alpha):
    gloss = surface("lambertian+ggx", lambertian__albedo=0.3, ggx__alpha=alpha, ggx__n=1.5)
    made = exporters.export("factors", gloss)
    assert made.statement.rms_ln < 0.02 and made.statement.seen < 0.1


def test_a_surface_that_reflects_nothing_is_refused():
    rough = surface("mirror", mirror__n=2.7, mirror__k=23.0, mirror__sigma=0.94)  # its image is all scattered away
    with pytest.raises(NoAnswer, match="reflects nothing .* nothing to write"):
        exporters.export("factors", rough)


def test_a_reader_of_the_json_gets_what_was_judged():
    surface = EVERY_LAW["paint"]
    made = exporters.export("factors", surface)
    held = json.loads(made.content)
    geom, wanted, _ = judged_over(surface, None)
    u = np.arcsinh(np.sqrt(geom.tan2_h[:, 0]) / held["scale"]) / np.arcsinh(np.tan(1.5) / held["scale"])

    def at(key, x):
        return np.interp(x, np.linspace(0, 1, len(key)), key)

    ln = (
        at(held["tilt"], u)
        + at(held["angle"], geom.theta_i_deg[:, 0] / 90)
        + at(held["angle"], geom.theta_r_deg[:, 0] / 90)
    )
    theta_d = np.degrees(np.arccos(np.minimum(geom.cos_d[:, 0], 1)))
    value = np.stack([at(each, theta_d / 90) for each in held["difference"]], axis=1)
    ours = np.array(held["albedo"]) / np.pi + np.exp(ln[:, None] + value)
    assert rms_ln(ours, wanted) == pytest.approx(made.statement.rms_ln, rel=1e-6)


def test_the_cumulative_of_the_tilt_rises_from_0_to_1():
    tables = factors.tables_of(EVERY_LAW["ggx"])
    assert tables.cumulative[0] == 0 and tables.cumulative[-1] == pytest.approx(1)
    assert np.all(np.diff(tables.cumulative) >= 0)


@pytest.mark.validate
def test_glsl_compiles(tmp_path):
    if shutil.which("glslangValidator") is None:
        pytest.skip("apt-get install glslang-tools: compiles the shaders")
    made = exporters.export("factors", EVERY_LAW["paint"], stem="paint")
    text = made.beside["paint.glsl"]
    own = re.search(r"vec3 (\w+)_brdf", text)[1]
    main = f"in vec3 L; in vec3 V; out vec4 o; void main() {{ o = vec4({own}_brdf(L, V, vec3(0, 0, 1)), 1); }}"
    for version in ("#version 130", "#version 300 es\nprecision highp float;"):
        (tmp_path / "law.frag").write_text(f"{version}\n{text}\n{main}\n")
        run = subprocess.run(["glslangValidator", str(tmp_path / "law.frag")], capture_output=True, text=True)
        assert run.returncode == 0, run.stdout


def test_glsl_holds_the_numbers_of_the_json():
    made = exporters.export("factors", EVERY_LAW["paint"], stem="paint")
    held, text = json.loads(made.content), made.beside["paint.glsl"]
    for key in ("tilt", "angle"):
        numbers = re.search(rf"_{key}\[\d+\] = float\[\d+\]\((.*?)\)", text)[1]
        np.testing.assert_allclose([float(each) for each in numbers.split(", ")], held[key], rtol=1e-8)


def test_exchange_of_light_and_view_changes_nothing():
    tables, geom = factors.tables_of(EVERY_LAW["paint"]), directions(200)
    np.testing.assert_allclose(tables(geom), tables(geom.swapped()), rtol=1e-9)
