"""Reflectance beside a ColorChecker: within the stated doubt, by detector and by corners, and gloss told by two."""

import csv
import json
import subprocess
import sys

import numpy as np
import pytest

from brdfguide.errors import InputError
from brdfguide.photographs.chart_answer import chart_answer
from brdfguide.photographs.chart_found import by_corners, find_chart, homography, read_chart, sample_reflectance
from brdfguide.photographs.readers import read_picture

from .charts import AREA, CORNERS, codes, desk
from .pictures import write_codes

SETS = ["average", "iso17321"]
ALBEDOS = [(0.5, 0.3, 0.1), (0.05, 0.6, 0.7), (0.8, 0.8, 0.8)]


@pytest.mark.parametrize("lamp", [(0.9, -0.6, 2.6), (-2.0, 1.0, 5.0), (1.5, 1.5, 1.5)])
@pytest.mark.parametrize("albedo", ALBEDOS)
def test_a_matt_surface_is_within_its_doubt(tmp_path, albedo, lamp):
    write_codes(tmp_path / "desk.png", codes(desk(albedo, lamp, glare=0.003)))
    found = chart_answer([tmp_path / "desk.png"], CORNERS, AREA, SETS)
    error = found.value / np.array(albedo) - 1
    assert np.abs(error).max() < 0.07 and np.all(np.abs(error) < 3 * found.doubt) and found.doubt.min() >= 0.015
    assert not found.is_albedo and [each.code for each in found.findings] == ["includes-gloss"]


def test_the_chart_of_the_other_data_set_is_read_with_it(tmp_path):
    write_codes(tmp_path / "desk.png", codes(desk((0.5, 0.3, 0.1), data_set="iso17321")))
    found = chart_answer([tmp_path / "desk.png"], CORNERS, AREA, SETS[::-1])
    assert found.value == pytest.approx([0.5, 0.3, 0.1], rel=0.05)
    assert found.shown[0].charts["iso17321"].chi < found.shown[0].charts["average"].chi


def test_the_detector_finds_what_the_corners_say(tmp_path):
    pytest.importorskip("cv2", reason="the detector needs the extra photo")
    write_codes(tmp_path / "desk.png", codes(desk((0.5, 0.3, 0.1))))
    assert find_chart(read_picture(tmp_path / "desk.png")).corners == pytest.approx(np.array(CORNERS), abs=4)


def test_a_chart_on_its_head_is_read_all_the_same(tmp_path):
    write_codes(tmp_path / "desk.png", codes(desk((0.5, 0.3, 0.1)))[::-1, ::-1])
    turned = [(480 - x, 320 - y) for x, y in CORNERS[2:] + CORNERS[:2]]
    x, y, width, height = AREA
    area = (480 - x - width, 320 - y - height, width, height)
    found = chart_answer([tmp_path / "desk.png"], turned, area, SETS)
    assert found.value == pytest.approx([0.5, 0.3, 0.1], rel=0.05)


def test_two_pictures_tell_gloss_and_the_lesser_counts(tmp_path):
    lamps = ((-0.8, 0.0, 2.0), (1.5, 0.8, 2.0))
    for gloss in (0.0, 0.25):
        for number, lamp in enumerate(lamps):
            write_codes(tmp_path / f"{number}.png", codes(desk((0.4, 0.3, 0.2), lamp, gloss)))
        found = chart_answer([tmp_path / "0.png", tmp_path / "1.png"], CORNERS, AREA, SETS)
        assert found.is_albedo and (("gloss" in {each.code for each in found.findings}) == bool(gloss))
        assert np.all(found.value <= found.each.min(axis=0) * 1.001)
        assert gloss or found.value == pytest.approx([0.4, 0.3, 0.2], rel=0.05)
    assert found.each.max() > 1.1 * found.value.max()


def test_the_homography_takes_corners_to_corners():
    frame = np.array([[0, 0], [1, 0], [1, 1], [0, 1.0]])
    matrix = homography(frame, np.array(CORNERS))
    assert by_corners(CORNERS).corners == pytest.approx(np.array(CORNERS), abs=1e-6)
    assert np.array([matrix @ (*each, 1) / (matrix @ (*each, 1))[2] for each in frame])[:, :2] == pytest.approx(
        np.array(CORNERS)
    )
    with pytest.raises(InputError, match="on a line"):
        by_corners([(0, 0), (1, 1), (2, 2), (0, 5)])


def test_what_is_no_chart_is_said_to_be_none(tmp_path):
    write_codes(tmp_path / "noise.png", np.random.default_rng(2).random((320, 480, 3)))
    with pytest.raises(InputError, match="no ColorChecker"):
        read_chart(read_picture(tmp_path / "noise.png"), by_corners(CORNERS), SETS)


def test_rendered_charts_within_7_percent_and_3_doubts(data):
    pytest.importorskip("cv2", reason="the detector needs the extra photo")
    for row in csv.DictReader((data / "photographs" / "chart_truth.csv").read_text().splitlines()):
        picture = read_picture(data / "photographs" / row["file"])
        corners = np.array([[float(row[f"sample_{axis}{k}"]) for axis in "xy"] for k in (1, 2, 3, 4)])
        area = (*(corners.mean(axis=0) - 15).astype(int).tolist(), 30, 30)
        truth = np.array([float(row[f"albedo_{channel}"]) for channel in "rgb"])
        stated = by_corners([[float(row[f"chart_{axis}{k}"]) for axis in "xy"] for k in (1, 2, 3, 4)])
        for placed in (find_chart(picture), stated):
            pixels, doubt = sample_reflectance(read_chart(picture, placed, ["average"]), "average", area)
            error = pixels.mean(axis=(0, 1)) / truth - 1
            assert np.abs(error).max() < 0.07 and np.all(np.abs(error) < 3 * doubt) and doubt.min() >= 0.015, row[
                "file"
            ]


def run(*words):
    ran = subprocess.run([sys.executable, "-m", "brdfguide", "albedo", *words], capture_output=True, text=True)
    return ran.returncode, ran.stdout, ran.stderr


def test_the_command_says_what_its_number_holds(tmp_path):
    write_codes(tmp_path / "desk.png", codes(desk((0.5, 0.3, 0.1))))
    where = ["--chart", *(f"{x:g},{y:g}" for x, y in CORNERS), "--sample", ",".join(map(str, AREA))]
    status, out, notes = run("--photo", str(tmp_path / "desk.png"), *where)
    assert status == 0 and out.startswith("reflectance factor") and "includes whatever gloss fell" in notes
    status, out, _ = run("--photo", str(tmp_path / "desk.png"), *where, "--json")
    found = json.loads(out)
    assert found["reflectance_factor"]["R"] == pytest.approx(0.5, rel=0.05) and "albedo" not in found
    assert np.array(found["pictures"][0]["corners_px"]) == pytest.approx(np.array(CORNERS), abs=0.01)
    two = run("--photo", str(tmp_path / "desk.png"), "--photo", str(tmp_path / "desk.png"), *where)
    assert two[0] == 0 and two[1].startswith("albedo")
    for words, sentence in (
        ([], "--photo needs --sample"),
        (["--sample", "1,2,3"], "wanted x,y,width,height"),
        (["--sample", "470,0,50,50", *where[:5]], "outside"),
        ([*where, "--photo", "b.png", "--photo", "c.png"], "3 times --photo"),
    ):
        status, out, said = run("--photo", str(tmp_path / "desk.png"), *words)
        assert status == 2 and out == "" and sentence in said and said.count("\n") == 1
