"""The cost table: counted operations, fronts, the document; never how fast this machine is."""

import json

import pytest

from brdfguide import models
from brdfguide.audit import bench
from brdfguide.cli import main
from brdfguide.report.documents import timing
from brdfguide.report.text.timing import text


def evaluator_of(name):
    surface = models.get(name)
    return lambda geom: surface(geom, surface.defaults())


def test_operations_count_what_is_not_kept_with_the_directions():
    blinn, ward = bench.operations_per_sample(evaluator_of("blinn")), bench.operations_per_sample(evaluator_of("ward"))
    assert blinn["exp"] == 1 and blinn["sqrt"] == 0
    assert ward["exp"] == 1 and ward["sqrt"] == 1


def test_times_have_a_row_for_every_law_and_size():
    found = bench.timings({"ward": evaluator_of("ward"), "ggx": evaluator_of("ggx")}, sizes=(1, 40), repeats=3)
    assert [(row.name, row.n) for row in found] == [("ward", 1), ("ggx", 1), ("ward", 40), ("ggx", 40)]
    assert all(0 < row.least <= row.median for row in found)


def test_document_and_table_say_the_same():
    found = [bench.TimingRow("ward", 1000, 10.0, 12.0), bench.TimingRow("ggx", 1000, 30.0, 31.0)]
    counted = {"ward": {"exp": 1.0, "simple": 6.0}, "ggx": {"exp": 0.0, "simple": 24.0}}
    machine = bench.machine()
    document = timing.document(machine, found, counted, {"ward": 0.3, "ggx": 0.1}, "data.csv")
    assert document["schema"] == "brdfguide/bench/1" and document["rows"][0]["time_per_sample_ns"] == {
        "min": 10.0,
        "median": 12.0,
    }
    lines = text(document).splitlines()
    assert lines[1].split() == ["ggx", "30", "31", "0", "24", "0.1000", "*"]
    assert lines[2].split() == ["ward", "10", "12", "1", "6", "0.3000", "*"]
    assert machine["processor"] in text(document)


def run(argv, capsys):
    with pytest.raises(SystemExit) as stop:
        main(argv)
    captured = capsys.readouterr()
    return stop.value.code, captured.out, captured.err


def test_command_gives_one_object_with_machine_and_rows(capsys, monkeypatch):
    monkeypatch.setattr(bench, "SIZES", (1, 100))
    monkeypatch.setattr(bench.timings, "__defaults__", ((1, 100), 2, lambda what: None))
    status, out, err = run(["bench", "-m", "ward,lambertian+ggx", "--json"], capsys)
    document = json.loads(out)
    assert (status, err) == (0, "") and {row["model"] for row in document["rows"]} == {"ward", "lambertian+ggx"}
    assert {"processor", "numpy", "python", "precision", "threads"} <= document["machine"].keys()


def test_plot_without_data_is_refused_in_words(capsys, tmp_path):
    status, out, err = run(["bench", "--plot", str(tmp_path / "front.png")], capsys)
    assert (status, out) == (2, "") and "give the measured data too" in err
