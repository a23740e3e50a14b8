"""Every command works on photographs as on any other data: inspect, fit, convert, --next, --report; and raw files."""

import base64
import json
import re
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image

from brdfguide import fit
from brdfguide.data import formats

from .pictures import describe, srgb, write_codes, write_dng


@pytest.fixture(scope="module")
def one_phase(tmp_path_factory, rendered):
    folder = tmp_path_factory.mktemp("one")
    for name in ("paint", "white"):
        write_codes(folder / f"{name}.png", srgb(rendered[name, 40] / 1.05))
    return describe(folder, [("paint.png", "white.png", "reference")])


def run(*words):
    ran = subprocess.run([sys.executable, "-m", "brdfguide", *map(str, words)], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


def test_inspect_and_convert_take_photographs(one_phase, tmp_path):
    told = run("inspect", one_phase)
    assert "format: photographs" in told and "one-difference-angle" in told and "outline-found" in told
    run("convert", one_phase, tmp_path / "it.csv")
    again = formats.read(tmp_path / "it.csv")
    assert again.brdf == pytest.approx(formats.read(one_phase).brdf, rel=1e-4)


def test_recommend_and_compare_know_photographs_from_a_material(one_phase):
    assert "recommended: " in run("recommend", one_phase, "-m", "lambertian+ggx", "--no-timing")
    assert run("compare", one_phase, "lambertian+ggx lambertian.albedo=0.3,0.2,0.1 ggx.alpha=0.15").startswith("seen 0")


def test_next_names_a_phase_and_the_page_shows_the_pictures(one_phase, tmp_path):
    page = tmp_path / "it.html"
    words = ("fit", one_phase, "-m", "lambertian+ggx,lambertian+beckmann", "--next", "--no-timing")
    assert re.search(r"to tell lambertian\+\w+ from lambertian\+\w+, take a picture at phase \d+", run(*words))
    block = json.loads(run(*words, "--json", "--report", page))["next"]
    assert block["purpose"] == "separate" and abs(block["phases"][0]["phase_deg"] - 40) > 15
    text = page.read_text()
    assert "in blue the pixels that were used" in text and text.count("<figure>") == 4
    assert any(
        base64.b64decode(each)[:4] == b"\x89PNG" for each in re.findall(r"data:image/png;base64,([\w+/=]+)", text)
    )


def test_raw_files_go_from_the_sensor_to_a_model(rendered, tmp_path):
    pytest.importorskip("rawpy", reason="raw files need the extra photo")
    rows = []
    for phase in (40, 110):
        for name in ("paint", "white"):
            write_dng(tmp_path / f"{name}{phase}.dng", rendered[name, phase] / 1.05)
        rows.append((f"paint{phase}.dng", f"white{phase}.dng", "reference"))
    path = describe(tmp_path, rows)
    assert "clipped" in {each.code for each in formats.read(path).findings}
    row = fit(path, models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
    assert row["ggx.alpha"]["value"] == pytest.approx(0.15, rel=0.02)
    assert row["ggx.n"]["value"] == pytest.approx([1.5] * 3, abs=0.02)
    assert row["lambertian.albedo"]["value"] == pytest.approx([0.3, 0.2, 0.1], rel=0.015)


def test_a_large_picture_with_a_soft_limb_is_measured_in_blocks(rendered, tmp_path):
    for name in ("paint", "white"):
        light = np.uint8(np.round(255 * srgb(rendered[name, 40] / 1.05)))
        Image.fromarray(light).resize((1600, 1600), Image.Resampling.BICUBIC).save(tmp_path / f"{name}.jpg", quality=95)
    path = describe(tmp_path, [("paint.jpg", "white.jpg", "reference")])
    found = {each.code: dict(each.numbers) for each in formats.read(path).findings}
    assert found["outline-found"]["radius_px"] == pytest.approx(720, rel=0.005)
    assert found["lamp-found"]["phase_deg"] == pytest.approx(40, abs=0.5)
