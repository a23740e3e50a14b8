"""An answer, or a failure, is kept for the data that it is named after and for no others."""

import os
import shutil
from pathlib import Path

import pytest

from brdfguide.batch import run, store
from brdfguide.batch.run import Again, Task

from .test_run import some
from .test_store import WORK, rows, states


@pytest.mark.parametrize("bad", [False, True])
def test_data_that_are_written_anew_before_their_turn_are_not_kept_as_the_former(bad, tmp_path):
    answers, file = store.store_at(tmp_path / "d"), some(tmp_path, "a.csv", 0)
    first = file.read_bytes()
    task = run._placed(Task("a.csv", file, WORK, answers), answers, run.NOT_AGAIN)
    file.unlink() if bad else some(tmp_path, "a.csv", 1)
    row = run.one(task)
    assert row.state == "bad input" and ("no such file" if bad else "written anew") in row.error
    assert answers.read(task.key) is None and answers.failure(task.key) is None
    file.write_bytes(first)
    assert states(tmp_path / "d", file) == ["answered"]
    os.utime(file, (1, 1))  # the same bytes, by another time
    assert states(tmp_path / "d", file) == ["answered before"]
    again = run._placed(Task("a.csv", file, WORK, answers), answers, Again(all=True))
    assert again.key == task.key


def test_data_that_were_touched_are_the_same(tmp_path):
    answers, file = store.store_at(tmp_path / "d"), some(tmp_path, "a.csv", 0)
    task = run._placed(Task("a.csv", file, WORK, answers), answers, run.NOT_AGAIN)
    os.utime(file, (1, 1))
    assert run.one(task).state == "answered"


def test_a_failure_under_another_name_keeps_its_words(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("n").write_text("theta_i,theta_r,brdf\n10,n,0.1\n")
    shutil.copy("n", "m")
    (first,), (second,) = rows(Path("d"), "n"), rows(Path("d"), "m")
    assert second.from_before and first.error.startswith("n, line 2") and "'n'" in first.error
    assert second.error == "m" + first.error[1:]


def test_what_no_other_run_would_meet_is_no_answer(tmp_path, monkeypatch):
    """Too many open files, no memory left where none was limited: of a machine at a moment."""
    answers, file = store.store_at(tmp_path / "d"), some(tmp_path, "a.csv", 0)
    task = run._placed(Task("a.csv", file, WORK, answers), answers, run.NOT_AGAIN)
    for error in (OSError(24, "Too many open files"), MemoryError()):
        with monkeypatch.context() as patch:
            patch.setattr("brdfguide.batch.work.answered", lambda *_, of=error: (_ for _ in ()).throw(of))
            assert run.one(task).state in ("bad input", "out of memory")
        assert not isinstance(run._placed(task, answers, run.NOT_AGAIN), run.FileRow)
