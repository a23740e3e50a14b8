"""The run that decides: every step is taken, the table of consumers ends it, and its status tells of any failure."""

import os
import shutil
import subprocess
import sys

import pytest

from . import consumers
from .conftest import ROOT

STUB = """#!/bin/bash
echo "$(basename "$0") $*" >> "$LOG"
case "$(basename "$0") $*" in
    *--prepare) echo "$STUBS/venv-python" ;;
    *consumers.py) echo "the table"; exit "${CONSUMERS:-0}" ;;
    "python3 tests/run.py --lowest"*) exit "${LOWEST:-0}" ;;
    "python3 tests/run.py"*) echo "the tests"; exit "${TESTS:-0}" ;;
    *fuzz/run.py*) echo "the fuzz"; exit "${FUZZ:-0}" ;;
    "id -u") echo 0 ;;
    "npm install"*) [ "$(grep -c "^npm install" "$LOG")" -gt "${BUSY:-0}" ] ;;
    "venv-python -m mypy") exit "${TYPES:-0}" ;;
esac
"""
NAMES = ("apt-get", "id", "npm", "python3", "sleep", "venv-python")


@pytest.fixture
def run(tmp_path):
    """Runs `.ci/run` with stand-ins for every program that it installs or measures with; its process, and the calls."""
    stubs, log = tmp_path / "stubs", tmp_path / "log"
    (tmp_path / ".ci").mkdir()
    stubs.mkdir()
    shutil.copy(ROOT / ".ci" / "run", tmp_path / ".ci")
    for name in NAMES:
        (stubs / name).write_text(STUB)
        (stubs / name).chmod(0o755)

    def call(**settings):
        log.write_text("")
        environment = {"PATH": f"{stubs}:/usr/bin:/bin", "LOG": str(log), "STUBS": str(stubs), **settings}
        done = subprocess.run([tmp_path / ".ci" / "run"], env=environment, capture_output=True, text=True)
        return done, log.read_text().splitlines()

    return call


def test_all_is_well_and_the_gates_stand_before_the_tests(run):
    done, calls = run()
    assert done.returncode == 0, done.stdout + done.stderr
    order = [calls.index(f"venv-python {step}") for step in ("-m ruff check .", "-m ruff format --check .", "-m mypy")]
    tests = next(place for place, call in enumerate(calls) if call.startswith("python3 tests/run.py") and "-rs" in call)
    assert order == sorted(order) and order[-1] < tests
    assert calls[-1] == "venv-python tests/consumers.py" and done.stdout.endswith("the table\n")


@pytest.mark.parametrize(
    "setting, name",
    [
        ("TESTS", "tests"),
        ("LOWEST", "lowest versions"),
        ("FUZZ", "fuzz"),
        ("TYPES", "mypy"),
        ("CONSUMERS", "consumers"),
    ],
)
def test_one_failure_fails_the_run_which_goes_on_to_the_table(run, setting, name):
    done, calls = run(**{setting: "3"})
    assert done.returncode == 1
    assert "the tests" in done.stdout and done.stdout.endswith(f"the table\nfailed: {name}\n")


def test_an_install_is_tried_three_times(run):
    done, calls = run(BUSY="2")
    assert done.returncode == 0 and sum(call.startswith("npm install") for call in calls) == 3
    done, calls = run(BUSY="9")
    assert sum(call.startswith("npm install") for call in calls) == 3 and "gltf-validator not installed" in done.stdout


def test_an_absent_consumer_is_named_and_fails_the_table(tmp_path):
    """On a path without programs; what Python itself can import is there or not as before."""
    environment = {**os.environ, "PATH": str(tmp_path)}
    command = [sys.executable, ROOT / "tests" / "consumers.py"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    lines = {line.split()[0]: line.split() for line in done.stdout.splitlines()}
    assert done.returncode == 1 and len(lines) == len(consumers.CONSUMERS)
    assert lines["node"][1] == lines["gltf-validator"][1] == lines["chromium"][1] == "ABSENT"
    assert lines["hypothesis"][1][0].isdigit()


def test_blender_alone_may_be_absent():
    versions = dict.fromkeys(consumers.CONSUMERS, "1.0")
    blender = next(each for each in consumers.CONSUMERS if not each.needed)
    assert consumers.status(versions) == 0
    assert consumers.status({**versions, blender: None}) == 0
    assert "oslc through bpy  absent  OSL" in consumers.table({**versions, blender: None})
    for each in consumers.CONSUMERS:
        assert consumers.status({**versions, each: None}) == int(each is not blender)
