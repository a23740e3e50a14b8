"""The fuzz harness sees what it should: a planted error of each kind, the same case again, and nothing else today."""

import math
import subprocess
import sys
import time
from importlib.util import find_spec

import pytest

from brdfguide.data import formats

from .conftest import ROOT

FOLDER = ROOT / "benchmarks" / "fuzz"
LIBRARIES = {"hdf5": "h5py", "zarr": "zarr", "parquet": "pyarrow", "spreadsheet": "openpyxl"}  # they make cases too


@pytest.fixture
def fuzz(monkeypatch, tmp_path):
    """The harness' modules, in a folder of their own."""
    monkeypatch.syspath_prepend(str(FOLDER))
    monkeypatch.chdir(tmp_path)
    import run
    import tries

    tries.furnished(tmp_path)
    return run, tries


def test_a_case_is_the_same_again(fuzz):
    _, tries = fuzz
    for target in ("table", "rgl", "fit-json", "description", "options"):
        assert [tries.case(target, 1, index) for index in range(5)] == [
            tries.case(target, 1, index) for index in range(5)
        ]


def test_every_reader_has_cases_and_some_of_them_are_read(fuzz):
    _, tries = fuzz
    assert set(formats.names()) <= {target.replace("_", "-") for target in tries.TARGETS}
    absent = {target for target, library in LIBRARIES.items() if find_spec(library) is None}
    for target in set(tries.TARGETS) - absent:
        outcomes = [tries.case(target, 4, index) for index in range(2 if target == "merl" else 15)]
        assert target == "merl" or any(each.outcome == "answered" for each in outcomes), target
        assert {each.outcome for each in outcomes} <= {"answered", "refused"}, (target, outcomes)


@pytest.mark.parametrize("index", [32, 44, 254])
def test_scans_at_the_end_of_arithmetic_that_warned_do_not(fuzz, index):
    """The ratio of two values, or their weights' sum, had no number."""
    _, tries = fuzz
    assert tries.case("extremes", 1, index).outcome in ("answered", "refused")


@pytest.mark.parametrize(
    "planted, outcome",
    [(ZeroDivisionError("x"), "traceback"), (RuntimeWarning("x"), "warning"), (MemoryError(), "traceback")],
)
def test_a_planted_error_is_seen(fuzz, monkeypatch, planted, outcome):
    _, tries = fuzz

    def broken(*_, **__):
        raise planted

    monkeypatch.setattr(formats, "read", broken)
    found = tries.case("table", 1, 0)
    assert found.outcome == outcome and type(planted).__name__ in found.detail


def test_a_sentence_that_acts_or_has_no_end_is_seen(fuzz, monkeypatch):
    from brdfguide.errors import InputError

    _, tries = fuzz

    class Raw(InputError):
        def __str__(self):
            return self.args[0]

    for text in ("\x1b[31m", "x" * 5000):

        def broken(*_, said=text, **__):
            raise Raw(said)

        monkeypatch.setattr(formats, "read", broken)
        assert tries.case("table", 1, 0).outcome == "unfit"


def test_a_hang_and_a_death_are_seen_and_the_next_case_is_tried(fuzz, monkeypatch):
    import os

    run, tries = fuzz

    def busy():
        while True:
            pass

    plan = {0: busy, 1: lambda: os._exit(3)}

    def case(target, seed, index):
        plan.get(index, lambda: None)()
        return tries.Case("answered")

    monkeypatch.setattr(tries, "case", case)
    monkeypatch.setattr(run, "HANG_S", 2.0)
    monkeypatch.setattr(run, "GLANCE_S", 0.1)
    counts, _, _, failures = run.tried("table", 1, math.inf, most=5)
    assert counts["hang"] == 1 and counts["died"] == 1 and counts["answered"] == 3
    assert sorted(failures.values()) == ["table:1:0", "table:1:1"]


def test_a_case_that_waits_for_ever_is_a_hang(fuzz, monkeypatch):
    run, tries = fuzz
    monkeypatch.setattr(tries, "case", lambda *_: time.sleep(6000))
    monkeypatch.setattr(run, "STUCK_S", 0.5)
    monkeypatch.setattr(run, "GLANCE_S", 0.1)
    counts, _, _, failures = run.tried("table", 1, math.inf, most=1)
    assert counts["hang"] == 1 and sum(counts.values()) == 1 and list(failures.values()) == ["table:1:0"]


def test_it_runs_from_anywhere_and_ends_with_a_line_for_each_target(tmp_path):
    words = [sys.executable, str(FOLDER / "run.py"), "--cases", "25", "--seed", "5", "--only", "scene,fit-json"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
    lines = done.stdout.splitlines()
    assert done.returncode == 0 and [line.split()[0] for line in lines] == ["seed", "target", "scene", "fit-json"]
    assert [int(line.split()[1]) for line in lines[2:]] == [25, 25] and not list(tmp_path.iterdir())
