"""Every script in examples/ runs as printed, and what the README shows is what the program says."""

import os
import re
import subprocess
import sys

import pytest

from .conftest import ROOT

SCRIPTS = sorted((ROOT / "examples").glob("*.sh"))
README = (ROOT / "README.md").read_text()


@pytest.fixture(scope="module")
def shell(tmp_path_factory):
    """Runs a shell line from the project's root with `brdfguide` on the path."""
    folder = tmp_path_factory.mktemp("bin")
    command = folder / "brdfguide"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m brdfguide "$@"\n')
    command.chmod(0o755)
    environment = {**os.environ, "PATH": f"{folder}{os.pathsep}{os.environ['PATH']}", "TMPDIR": str(folder), "PYTHONPATH": str(ROOT)}

    def run(line):
        return subprocess.run(["sh", "-c", line], cwd=ROOT, env=environment, capture_output=True, text=True, timeout=180)

    return run


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.name)
def test_example_runs(script, shell):
    run = shell(f"sh {script.relative_to(ROOT)}")
    assert run.returncode == 0, run.stderr
    assert run.stdout and "Traceback" not in run.stderr


def transcripts():
    """(command, what the README prints under it) of every console block that starts with a prompt."""
    for block in re.findall(r"```console\n(.*?)```", README, re.S):
        for part in re.split(r"^\$ ", block, flags=re.M)[1:]:
            command, _, shown = part.partition("\n")
            yield command, shown.strip("\n")


NUMBER = re.compile(r"\d+\.\d+")


def alike(said: str, shown: str) -> bool:
    """The same words, and decimal numbers that agree to two units of the last digit: another NumPy may round otherwise."""
    if NUMBER.sub("#", said) != NUMBER.sub("#", shown):
        return False
    pairs = zip(NUMBER.findall(said), NUMBER.findall(shown), strict=True)
    return all(len(a) == len(b) and abs(float(a) - float(b)) <= 2.001 * 10.0 ** -len(b.partition(".")[2]) for a, b in pairs)


@pytest.mark.parametrize("command, shown", [pytest.param(*each, id=each[0][:60]) for each in transcripts()])
def test_readme_prints_what_it_says(command, shown, shell):
    """Line by line, numbers to the last printed digits; `...` stands for what was left out."""
    run = shell(command)
    assert run.returncode == 0, run.stderr
    said = [line.rstrip() for line in run.stdout.splitlines()]
    place = 0
    for line in (line.rstrip() for line in shown.splitlines()):
        if line == "...":
            continue
        found = next((at for at in range(place, len(said)) if alike(said[at], line)), None)
        assert found is not None, f"the README shows {line!r}; the program says\n{run.stdout}"
        place = found + 1
