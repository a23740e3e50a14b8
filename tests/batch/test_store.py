"""An answer belongs to its content, to what was asked and to what computed it; nothing else is ever served for it."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from brdfguide.batch import keys, run, store
from brdfguide.batch.products import listed, patterned
from brdfguide.batch.run import Again, Task, run_tasks
from brdfguide.batch.work import FitWork
from brdfguide.batch.workers import Limits
from brdfguide.errors import InputError
from brdfguide.fitting.job import Job

from ..conftest import ROOT
from .test_run import kept, some

WORK = FitWork(job=Job(models=("lambertian",), timing=False), command="brdfguide fit")


def rows(folder, *files, work=WORK, again=run.NOT_AGAIN, engine=run.in_this_process):
    answers = store.store_at(folder)
    return list(run_tasks([Task(str(file), Path(file), work, answers) for file in files], answers, engine, again))


def states(*words, **more) -> list[str]:
    return [row.state for row in rows(*words, **more)]


def content(folder) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in kept(folder)}


def test_an_answer_is_the_same_whatever_its_name_and_whoever_computes_it(tmp_path):
    (tmp_path / "other").mkdir()
    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    twin = shutil.copy(files[0], tmp_path / "other" / "twin.csv")
    assert states(tmp_path / "a", *files, twin) == ["answered"] * 3 + ["answered before"]
    assert states(tmp_path / "b", twin, *reversed(files)) == ["answered"] * 3 + ["answered before"]
    assert content(tmp_path / "a") == content(tmp_path / "b") and len(content(tmp_path / "a")) == 3
    shown = [run.with_name(json.loads(row.place.read_text()), row.file) for row in rows(tmp_path / "a", files[0], twin)]
    assert [each["data"]["file"] for each in shown] == [str(files[0]), str(twin)] and "stored" not in shown[0]
    names = dict(store.known_store(tmp_path / "a").names())
    assert len(names) == 4 and names[str(files[0])] == names[str(twin)]


def test_shards_in_any_order_make_the_folder_that_one_run_makes(tmp_path):
    from brdfguide.batch.listing import shard_of

    files = [some(tmp_path, f"{part}.csv", part) for part in range(9)]
    rows(tmp_path / "one", *files)
    for turn in ((2, 0, 1), (1, 2, 0)):
        for number in turn:
            mine = [file for file in files if shard_of(f"{number}/3").has(str(file))]
            rows(tmp_path / "shards", *mine)
    assert content(tmp_path / "one") == content(tmp_path / "shards") and len(content(tmp_path / "one")) == 9


def test_nothing_is_served_for_what_it_does_not_follow_from(tmp_path, monkeypatch):
    file = some(tmp_path, "a.csv", 0)
    assert states(tmp_path / "d", file) == ["answered"]
    assert states(tmp_path / "d", file) == ["answered before"]
    some(tmp_path, "a.csv", 1)
    assert states(tmp_path / "d", file) == ["answered"]
    some(tmp_path, "a.csv", 0)
    assert states(tmp_path / "d", file) == ["answered before"]
    other = replace(WORK, job=replace(WORK.job, aperture_deg=3.0))
    assert states(tmp_path / "d", file, work=other) == ["answered"]
    monkeypatch.setattr(run, "engine", lambda: "another program")
    monkeypatch.setattr(keys, "engine", lambda: "another program")
    assert states(tmp_path / "d", file) == ["answered"]


def test_the_fingerprint_is_of_sources_that_count():
    assert len(keys.engine()) == 64 and keys.engine() != keys.drawing_engine()


def test_pictures_that_a_description_names_are_part_of_what_was_read(tmp_path):
    shutil.copytree(ROOT / "examples" / "photographs", tmp_path / "shots")
    shots = tmp_path / "shots" / "shots.yaml"
    named = WORK.reads(shots)
    assert named and all(path.exists() for path in named)
    before = keys.key_of(WORK.asked(), keys.bytes_of(shots), keys.beside(named))
    named[0].write_bytes(named[0].read_bytes() + b"\0")
    assert keys.key_of(WORK.asked(), keys.bytes_of(shots), keys.beside(named)) != before


def test_a_failure_is_an_answer_too_until_something_changes(tmp_path):
    bad = tmp_path / "bad.csv"
    bad.write_text("theta_i,theta_r,brdf\n10,x,0.1\n")
    first, second = rows(tmp_path / "d", bad), rows(tmp_path / "d", bad)
    assert not first[0].from_before and second[0].from_before and first[0].error == second[0].error
    twin = shutil.copy(bad, tmp_path / "twin.csv")
    assert "twin.csv" in rows(tmp_path / "d", twin)[0].error
    assert not rows(tmp_path / "d", bad, again=Again(all=True))[0].from_before
    shutil.copy(some(tmp_path, "a.csv", 0), bad)
    assert states(tmp_path / "d", bad) == ["answered"]


def test_what_took_too_long_is_tried_again_with_other_limits_and_what_was_killed_always(tmp_path):
    answers, file = store.store_at(tmp_path / "d"), some(tmp_path, "a.csv", 0)
    task = run._placed(Task("a", file, WORK, answers), answers, run.NOT_AGAIN)
    for state, limits, served in (
        ("timed out", [1.0, None], True),
        ("timed out", [0.5, None], False),
        ("killed", [1.0, None], False),
        ("nonsense", [1.0, None], False),
    ):
        answers.fail(task.key, {"state": state, "error": "a: x", "file": "a", "tries": 1, "limits": limits})
        placed = run._placed(Task("a", file, WORK, answers), answers, Again(limits=Limits(1.0)))
        assert isinstance(placed, run.FileRow) == served, state


def test_products_follow_the_surface_and_are_made_again_where_they_are_not_its_own(tmp_path):
    file, plot = some(tmp_path, "a.csv", 0), tmp_path / "pics" / "a.svg"
    work = replace(WORK, products=(patterned("plot", tmp_path / "pics" / "{stem}.svg", True), *listed("residuals")))
    assert states(tmp_path / "d", file, work=work) == ["answered"]
    first = plot.read_bytes()
    assert states(tmp_path / "d", file, work=work) == ["answered before"]
    assert [path.suffixes for path in (tmp_path / "d").glob("answers/*/*.csv")] == [[".residuals", ".csv"]]
    some(tmp_path, "a.csv", 1)
    assert states(tmp_path / "d", file, work=work) == ["answered"] and plot.read_bytes() != first
    some(tmp_path, "a.csv", 0)  # the answer is known, the picture is of the other data
    assert states(tmp_path / "d", file, work=work) == ["answered"] and plot.read_bytes() == first
    plot.unlink()
    assert states(tmp_path / "d", file, work=work) == ["answered"] and plot.read_bytes() == first


def test_what_a_target_cannot_hold_is_told_once_and_kept(tmp_path):
    file = some(tmp_path, "a.csv", 0)
    refused = patterned("export", tmp_path / "{stem}.xml", True, target="mitsuba", most=1e-9)
    work = replace(WORK, products=(refused,))
    first, second = (rows(tmp_path / "d", file, work=work)[0] for _ in range(2))
    assert first.state == second.state == "answered, not exported" and first.status == second.status == 1
    assert "more than --max-export-error" in first.error == second.error and second.from_before


@pytest.mark.parametrize("words, wanted", [("report,plott", "did you mean plot"), ("export:mitsubi", "mitsuba")])
def test_unknown_products_are_a_sentence(words, wanted):
    with pytest.raises(InputError, match=wanted):
        listed(words)


def test_a_folder_of_something_else_is_left_alone(tmp_path):
    (tmp_path / store.SIGN).write_text('{"schema": "other/1"}')
    with pytest.raises(InputError, match="no folder of answers"):
        store.store_at(tmp_path)


def test_a_claim_is_respected_while_its_owner_lives(tmp_path):
    answers = store.store_at(tmp_path)
    assert answers.claim("ab") and answers.claim("ab")  # our own
    place = tmp_path / "claims" / "cd"
    place.write_text('{"host": "elsewhere", "pid": 1}')
    assert not answers.claim("cd") and answers.claim("cd", stale_s=-1)
    place.write_text(json.dumps({**store._me(), "pid": 2**22 + 1}))  # no process has such a number
    assert answers.claim("cd")
    answers.release("ab")
    assert not (tmp_path / "claims" / "ab").exists()


def test_a_claim_for_which_there_is_no_room_is_none(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(store.json, "dump", full)
    assert store.store_at(tmp_path / "d").claim("ab" * 32)


def test_what_another_run_is_at_comes_last_and_is_done_all_the_same(tmp_path):
    answers = store.store_at(tmp_path / "d")
    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    key = run._placed(Task("a", files[0], WORK, answers), answers, run.NOT_AGAIN).key
    (tmp_path / "d" / "claims").mkdir()
    (tmp_path / "d" / "claims" / key).write_text('{"host": "elsewhere", "pid": 1}')
    heard = []

    def watched(do, tasks):
        for number, task in tasks:
            heard.append(number)
            yield number, do(task)

    assert states(tmp_path / "d", *files, engine=watched) == ["answered"] * 3 and heard == [1, 2, 0]
