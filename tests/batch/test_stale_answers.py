"""What no run will ask for again is named with its reason, and is removed only when that is said."""

import json
from dataclasses import replace

import pytest

from brdfguide.batch import stale_answers, store
from brdfguide.batch.products import listed
from brdfguide.batch.work import FitWork
from brdfguide.errors import InputError

from ..conftest import ROOT
from .test_run import kept, some
from .test_store import WORK, rows, states


def found(folder) -> list[tuple[str, tuple[str, ...]]]:
    return [(each.why, each.names) for each in stale_answers.stale_answers(store.known_store(folder))]


def test_an_answer_stays_while_one_of_its_names_has_its_data(tmp_path):
    one, two = some(tmp_path, "one.csv", 1), some(tmp_path, "two.csv", 2)
    twin = tmp_path / "twin.csv"
    twin.write_bytes(one.read_bytes())
    rows(tmp_path / "fits", one, two, twin)
    assert found(tmp_path / "fits") == []
    one.unlink()
    assert found(tmp_path / "fits") == []  # its twin has it still
    twin.write_bytes(two.read_bytes())
    assert found(tmp_path / "fits") == [("data gone", (str(one), str(twin)))]
    assert states(tmp_path / "fits", two, twin) == ["answered before"] * 2  # now both are the second's
    assert found(tmp_path / "fits") == [("data gone", (str(one),))]


def test_another_version_and_damage_are_named_and_go_with_all_that_lies_beside(tmp_path, monkeypatch):
    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    work = FitWork(job=WORK.job, products=tuple(listed("residuals")), command="brdfguide fit")
    made = rows(tmp_path / "fits", *files, work=work)
    made[0].place.write_text(made[0].place.read_text().replace('"rms_ln":', '"rms_ln" :', 1)[:-20])
    document = json.loads(made[1].place.read_text())
    monkeypatch.setattr(stale_answers, "engine", lambda: document["stored"]["fingerprint"])
    answers = store.known_store(tmp_path / "fits")
    (stale,) = stale_answers.stale_answers(answers)
    assert (stale.why, stale.names, len(stale.files)) == ("damaged", (str(files[0]),), 2)
    monkeypatch.setattr(stale_answers, "engine", lambda: "of tomorrow")
    assert sorted(why for why, _ in found(tmp_path / "fits")) == ["another version"] * 2 + ["damaged"]
    stale_answers.remove(answers, [stale])
    assert not made[0].place.exists() and not made[0].place.with_suffix(".residuals.csv").exists()
    assert len(kept(tmp_path / "fits")) == 2 and str(files[0]) not in dict(answers.names())
    monkeypatch.undo()
    assert states(tmp_path / "fits", *files, work=work) == ["answered", "answered before", "answered before"]


def test_an_answer_that_another_took_the_place_of_is_not_said_to_have_lost_its_data(tmp_path):
    file = some(tmp_path, "a.csv", 0)
    rows(tmp_path / "fits", file)
    rows(tmp_path / "fits", file, work=FitWork(job=replace(WORK.job, aperture_deg=3.0), command="brdfguide fit"))
    assert found(tmp_path / "fits") == [("answered anew", ())]
    file.unlink()
    assert sorted(why for why, _ in found(tmp_path / "fits")) == ["answered anew", "data gone"]


def test_a_failure_goes_with_its_file(tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("theta_i,theta_r,brdf\n10,10,words\n")
    assert states(tmp_path / "fits", bad) == ["bad input"]
    assert found(tmp_path / "fits") == []
    bad.unlink()
    assert found(tmp_path / "fits") == [("data gone", (str(bad),))]


def test_the_command_lists_and_removes(tmp_path, capsys, monkeypatch):
    from brdfguide.cli import main

    def run(*words) -> tuple[str, str]:
        with pytest.raises(SystemExit) as end:
            main(["prune-answers", str(tmp_path / "fits"), *words])
        assert not end.value.code
        return capsys.readouterr()

    file = some(tmp_path, "a.csv", 0)
    rows(tmp_path / "fits", file, ROOT / "examples" / "white_paper.csv")
    assert run()[0] == "nothing is stale\n"
    file.unlink()
    out, err = run()
    assert out.splitlines()[1].startswith("data gone  ") and out.splitlines()[1].endswith(f"  {file}")
    assert err.startswith("1 answers, ") and err.endswith("would go with --yes\n") and len(kept(tmp_path / "fits")) == 2
    document = json.loads(run("--json", "--yes", "-q")[0])
    assert document["removed"] and [each["names"] for each in document["stale"]] == [[str(file)]]
    assert len(kept(tmp_path / "fits")) == 1 and run()[0] == "nothing is stale\n"


def test_no_folder_of_answers_is_a_sentence(tmp_path):
    with pytest.raises(InputError, match="found no folder of answers"):
        store.known_store(tmp_path)
