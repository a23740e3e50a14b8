"""Every file of a batch ends in a row whatever happens, and nothing is answered with what belongs to another file."""

import json
import os
import signal
import subprocess
import sys

import pytest

from brdfguide.batch import run as batch
from brdfguide.batch import store, work
from brdfguide.batch.work import FitWork
from brdfguide.fitting.job import Job

from .. import patience
from ..conftest import ROOT

SAMPLE = (ROOT / "examples" / "rough_plastic.csv").read_text().splitlines(keepends=True)
QUICK = ("-m", "lambertian+ggx", "--no-timing")

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals, pipes and limits as POSIX has them")


def some(folder, name: str, part: int):
    """A few lines of a sample, other ones for each part."""
    path = folder / name
    head = [line for line in SAMPLE if line.startswith(("#", "theta"))]
    rows = [line for line in SAMPLE if not line.startswith(("#", "theta"))]
    path.write_text("".join(head + rows[part::9]))
    return path


def fit(*words, stdin=subprocess.DEVNULL, **more):
    command = [sys.executable, "-W", "error", "-m", "brdfguide", "fit", *map(str, words), *QUICK]
    run = subprocess.run(command, cwd=ROOT, capture_output=True, stdin=stdin, timeout=patience.AN_AGE_S, **more)
    assert b"Traceback" not in run.stderr and b"mistake of brdfguide" not in run.stderr, run.stderr
    return run.returncode, run.stdout.decode(), run.stderr.decode()


def rows(out: str) -> list[str]:
    return out.splitlines()[1:]


def kept(folder):
    """The answers in a folder."""
    return sorted(folder.glob("answers/*/*.json"))


def test_standard_input_and_pipes_are_answered_by_what_they_held(tmp_path):
    for part, how in ((0, "answered"), (1, "answered"), (1, "answered before")):
        with some(tmp_path, "x.csv", part).open() as stdin:
            status, out, _ = fit("-", "--out", tmp_path / "d", stdin=stdin)
        assert status == 0 and rows(out)[0].split()[-len(how.split()) :] == how.split()
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    for part, how in ((2, "answered"), (3, "answered"), (3, "before")):
        writer = subprocess.Popen(["sh", "-c", f"cat {some(tmp_path, 'y.csv', part)} > {pipe}"])
        status, out, _ = fit(pipe, "--out", tmp_path / "d")
        assert writer.wait() == 0 and status == 0 and rows(out)[0].split()[-1] == how


def test_several_processes_share_standard_input_with_nobody(tmp_path):
    with some(tmp_path, "x.csv", 0).open() as stdin:
        status, out, err = fit("-", some(tmp_path, "y.csv", 1), "--jobs", 2, stdin=stdin)
    assert status == 0 and [row.split()[-1] for row in rows(out)] == ["answered"] * 2, err


def test_every_file_ends_in_a_row(tmp_path):
    """Good ones among those that cannot be read, of every kind."""
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    bad = [
        tmp_path / "none.csv",
        tmp_path / "folder",
        "/proc/self/mem",
        "/dev/zero",
        tmp_path / "pipe",
        tmp_path / ("x" * 300),
    ]
    (tmp_path / "empty").write_text("")
    good = some(tmp_path, "a.csv", 0), some(tmp_path, "b.csv", 1)
    status, out, err = fit(good[0], *bad, tmp_path / "empty", good[1], "--out", tmp_path / "d")
    assert status == 2 and len(rows(out)) == 9 and err.count("\n") == 8  # seven sentences and the summary
    assert [row.split()[-1] for row in rows(out)] == ["answered", *["input"] * 7, "answered"]


def test_a_mistake_of_ours_is_a_row(monkeypatch, tmp_path):
    def broken(*_):
        raise ZeroDivisionError("x")

    monkeypatch.setattr(work, "answered", broken)
    file = some(tmp_path, "a.csv", 0)
    row = batch.one(batch.Task("a.csv", file, FitWork(job=Job())))
    assert row.status == 2 and "mistake of brdfguide" in row.error and "ZeroDivisionError" in row.error

    def greedy(*_):
        raise MemoryError

    monkeypatch.setattr(work, "answered", greedy)
    row = batch.one(batch.Task("a.csv", file, FitWork(job=Job())))
    assert row.state == "out of memory" and row.status == 1 and "not enough memory" in row.error


EMPTY = '{"schema": "brdfguide/fit/1", "ranking": []}'


@pytest.mark.parametrize("text", ["", "[]", "{}", "null", EMPTY, "\0", "digits"])
def test_a_damaged_answer_is_done_again(text, tmp_path):
    file, answers = some(tmp_path, "a.csv", 0), tmp_path / "d"
    fit(file, "--out", answers)
    (answer,) = kept(answers)
    answer.write_text(text if text != "digits" else answer.read_text().replace('"rms_ln":0.', '"rms_ln":1.', 1))
    status, out, _ = fit(file, "--out", answers)
    assert status == 0 and rows(out)[0].endswith(" answered") and json.loads(answer.read_text())["ranking"]


@pytest.mark.parametrize("name", ["x" * 251 + ".csv", "é" * 125 + ".csv", "a\nb\x1b[31m.csv", "-"])
def test_any_name_of_a_file_has_a_place_for_its_answer(name, tmp_path):
    file = some(tmp_path, name, 0)
    for how in (" answered", " answered before"):
        status, out, err = fit(file, "--out", tmp_path / "d")
        assert status == 0 and len(rows(out)) == 1 and out.rstrip().endswith(how) and "\x1b" not in out + err


def test_a_folder_for_answers_that_cannot_be_is_one_sentence(tmp_path):
    (tmp_path / "file").write_text("")
    for out, sentence in ((tmp_path / "file", "is a file; wanted a folder"), (tmp_path / "file" / "d", "cannot make")):
        status, text, err = fit(some(tmp_path, "a.csv", 0), "--out", out)
        assert (status, text, err.count("\n")) == (2, "", 1) and sentence in err


def test_an_answer_that_cannot_be_kept_is_told_all_the_same(monkeypatch, tmp_path):
    from brdfguide.errors import InputError

    def full(*_, **__):
        raise InputError("cannot write x: No space left on device")

    folder = store.store_at(tmp_path / "x")
    monkeypatch.setattr(store, "write_whole", full)
    file = some(tmp_path, "a.csv", 0)
    asked = FitWork(job=Job(models=("lambertian+ggx",)))
    tasks = [batch.Task(name, file, asked, folder) for name in ("a", "b", "c")]
    rows = list(batch.run_tasks(tasks, folder))
    assert rows[0].status == 2 and rows[0].document is not None and "No space left" in rows[0].error
    assert [row.state for row in rows] == ["answered, not kept", "not done", "not done"]  # it would fail again


def test_few_open_files_are_a_sentence_or_enough(tmp_path):
    import resource

    files = [some(tmp_path, f"{part}.csv", part) for part in range(3)]
    status, out, err = fit(*files, "--jobs", 2, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (12, 12)))
    assert status in (0, 2) and (len(rows(out)) == 3 or "--jobs 1 needs none" in err)


def started(tmp_path, count=120, jobs=2):
    files = [str(some(tmp_path, f"{part}.csv", part % 9)) for part in range(count)]
    for number, file in enumerate(files):
        with open(file, "a") as stream:
            stream.write(f"# {number}\n")  # or equal files would share an answer
    command = [sys.executable, "-m", "brdfguide", "fit", *files, "--jobs", str(jobs), "--out", str(tmp_path / "d")]
    run = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)
    patience.until(lambda: len(kept(tmp_path / "d")) >= 4, run)
    return run, count


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("whom", ["the program", "the whole group"])
def test_ctrl_c_stops_at_once_and_says_how_to_go_on(whom, jobs, tmp_path):
    run, count = started(tmp_path, jobs=jobs)
    (run.send_signal if whom == "the program" else lambda number: os.killpg(run.pid, number))(signal.SIGINT)
    out, err = run.communicate(timeout=patience.AN_AGE_S)
    assert run.returncode == 130 and b"Traceback" not in err, err
    told = out.decode().splitlines()[1:]
    answered = sum(row.endswith(" answered") for row in told)
    assert len(told) == count and 2 <= answered < count
    assert answered + sum(row.endswith("not done") for row in told) == count
    assert f"stopped: {answered} of {count} files done" in err.decode() and "goes on from there" in err.decode()
    there = kept(tmp_path / "d")
    assert answered <= len(there) <= answered + jobs and all(json.loads(each.read_text()) for each in there)


def test_sigterm_ends_all_of_it_and_keeps_what_was_done(tmp_path):
    run, count = started(tmp_path)
    run.terminate()
    out, err = run.communicate(timeout=patience.AN_AGE_S)  # until the last process has let go of the pipes
    assert run.returncode == 143 and b"Traceback" not in err, err
    told = out.decode().splitlines()[1:]
    assert len(told) == count and sum(row.endswith(" answered") for row in told) < count


def test_sigkill_leaves_no_process_behind(tmp_path):
    run, count = started(tmp_path)
    run.kill()
    run.communicate(timeout=patience.AN_AGE_S)  # the pipes are closed once the last of them is gone
    assert len(kept(tmp_path / "d")) < count
