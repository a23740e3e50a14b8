"""`recommend`, `inspect` and `export` over many surfaces: a row each, and what one alone would say."""

import json
from pathlib import Path

import pytest

from ..cli.test_options import run
from .test_run import some


def answered(line: str) -> tuple[int, str, str]:
    return run(line, {})


def test_folders_are_inspected_as_their_files_are(tmp_path):
    files = [some(tmp_path, f"{part}.csv", part) for part in range(2)]
    status, out, _ = answered(f"inspect {tmp_path} --json")
    rows = json.loads(out)["rows"]
    assert status == 0 and [row["file"] for row in rows] == [str(file) for file in files]
    alone = json.loads(answered(f"inspect {files[1]} --json")[1])
    assert rows[1]["inspect"] == alone
    status, out, err = answered(f"inspect {tmp_path} --out {tmp_path / 'd'}")
    assert status == 0 and "answered" in out and "2 files, 0 answered before" in err
    assert "2 files, 2 answered before" in answered(f"inspect {tmp_path} --out {tmp_path / 'd'}")[2]


def test_what_the_program_printed_beside_its_data_is_no_measurement(tmp_path):
    file = some(tmp_path, "a.csv", 0)
    (tmp_path / "fit.json").write_text(answered(f"fit {file} -m lambertian --json")[1])
    status, out, err = answered(f"inspect {tmp_path}")
    assert status == 0 and len(out.splitlines()) == 2 and "1 files of the folders" in err
    status, _, err = answered(f"inspect {tmp_path / 'fit.json'}")
    assert status == 2 and "found what this program printed, brdfguide/fit/1; wanted measured data" in err


def test_many_descriptions_are_a_row_each_and_one_outside_stops_none(tmp_path):
    (tmp_path / "hair.yaml").write_text("structure: hair\n")
    (tmp_path / "list").write_text(f"porcelain\n{tmp_path / 'hair.yaml'}\noffice-paper\nnonsense\n")
    status, out, err = answered(f"recommend --files-from {tmp_path / 'list'} --no-timing --out {tmp_path / 'd'}")
    states = [line.rsplit("  ", 1)[1] for line in out.splitlines()[1:]]
    assert status == 2 and states == ["answered", "no trustworthy answer", "answered", "bad input"]
    assert "--anyway answers all the same" in err and "nonsense" in err
    again = answered(f"recommend --files-from {tmp_path / 'list'} --no-timing --out {tmp_path / 'd'} --json")[1]
    rows = json.loads(again)["rows"]
    alone = json.loads(answered("recommend porcelain --no-timing --json")[1])
    assert rows[0]["answered_before"] and rows[0]["recommend"]["candidates"] == alone["candidates"]


def test_a_description_is_answered_with_the_spectrum_beside_it_and_by_its_own_name(tmp_path):
    """The same words in two folders, with two spectra, are two surfaces; without a name they have their files'."""
    for folder, power in (("a", 1e-4), ("b", 4e-3)):
        (tmp_path / folder).mkdir()
        rows = [f"{f},{power / (1 + (20 * f) ** 2) ** 1.5}" for f in (0.001, 0.01, 0.1, 0.5, 1, 2)]
        (tmp_path / folder / "psd.csv").write_text("\n".join(["f (1/um),S (um^3)", *rows]) + "\n")
        (tmp_path / folder / "m.yaml").write_text("composition: aluminium\nstylus: {spectrum: psd.csv}\n")
    (tmp_path / "b" / "n.yaml").write_text((tmp_path / "b" / "m.yaml").read_text())
    line = f"recommend {tmp_path / 'a'} {tmp_path / 'b'} --no-timing --json"
    alone = [row["recommend"] for row in json.loads(answered(line)[1])["rows"]]
    assert alone[0]["candidates"] != alone[1]["candidates"]
    for before in (False, True):
        rows = json.loads(answered(f"{line} --out {tmp_path / 'd'}")[1])["rows"]
        assert [row["recommend"]["candidates"] for row in rows] == [each["candidates"] for each in alone]
        assert [row["recommend"]["name"] for row in rows] == ["m", "m", "n"]
        assert [row["answered_before"] for row in rows] == [before] * 3
    (tmp_path / "a" / "psd.csv").write_text((tmp_path / "b" / "psd.csv").read_text())
    rows = json.loads(answered(f"{line} --out {tmp_path / 'd'}")[1])["rows"]
    assert rows[0]["recommend"]["candidates"] == rows[1]["recommend"]["candidates"]


def test_a_measurement_that_one_of_many_descriptions_names_is_not_passed_over(tmp_path):
    some(tmp_path, "scan.csv", 1)
    (tmp_path / "paint.yaml").write_text("composition: paint\nmeasurements: [scan.csv]\n")
    status, out, err = answered(f"recommend {tmp_path} --no-timing")
    assert status == 2 and out.splitlines()[1].endswith("bad input") and "it names a measurement" in err


def test_of_a_folder_recommend_takes_the_descriptions(tmp_path):
    (tmp_path / "cup.yaml").write_text("composition: porcelain\nfinish: high gloss\n")
    (tmp_path / "sheet.yml").write_text("composition: copper\nfinish: satin\n")
    some(tmp_path, "scan.csv", 1)
    status, out, err = answered(f"recommend {tmp_path} --no-timing")
    assert status == 0 and [Path(line.split()[0]).name for line in out.splitlines()[1:]] == ["cup.yaml", "sheet.yml"], (
        err
    )


def test_answers_of_a_folder_are_exported_under_their_files_names(tmp_path):
    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    fits = f"fit {' '.join(map(str, files))} -m lambertian+ggx --no-timing --out {tmp_path / 'd'}"
    assert answered(fits)[0] == 0
    status, out, err = answered(f"export {tmp_path / 'd'} --to mitsuba -o {tmp_path}/x/{{{{stem}}}}.xml --jobs 2")
    assert status == 0 and out.count("mitsuba") == 3, err
    assert sorted(path.name for path in (tmp_path / "x").iterdir()) == ["0.xml", "1.xml", "2.xml"]
    status, _, err = answered(f"export {tmp_path / 'd'} --to mitsuba -o {tmp_path}/x/{{{{stem}}}}.xml")
    assert status == 2 and "exists; --force replaces it" in err
    shards = [
        answered(f"export {tmp_path / 'd'} --to gltf -o {tmp_path}/y/{{{{stem}}}}.gltf --shard {number}/2 -q")
        for number in range(2)
    ]
    assert all(each[0] == 0 for each in shards)
    assert sum(path.suffix == ".gltf" for path in (tmp_path / "y").iterdir()) == 3


@pytest.mark.parametrize(
    "line, sentence",
    [
        ("inspect", "no DATA"),
        ("recommend", "no INPUT"),
        ("inspect {tmp} --plot {tmp}/x.png", "--plot: a picture is of one file"),
        ("recommend porcelain office-paper --jobs 2 --numbers", "--numbers: of one description at a time"),
        ("recommend porcelain --jobs 2 --explain", "--explain: a row has no place for it"),
        ("export porcelain office-paper --to mitsuba -o {tmp}/x.xml", "wanted {stem} in it"),
        (
            "export porcelain office-paper --to mitsuba -o {tmp}/{{stem}}.xml --out {tmp}/d",
            "--out: the files themselves",
        ),
        ("export porcelain --to mitsuba -o {tmp}/x.xml --jobs 2", "--jobs: one file"),
    ],
)
def test_what_many_cannot_have_is_a_sentence(line, sentence, tmp_path):
    some(tmp_path, "a.csv", 0)
    some(tmp_path, "b.csv", 1)
    line = line.replace("{tmp}", str(tmp_path)).replace("{{stem}}", "{{stem}}")
    status, out, err = run(line, {})
    assert status == 2 and out == "" and sentence in err and err.count("\n") == 1
