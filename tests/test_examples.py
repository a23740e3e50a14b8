"""Every script in examples/ runs as printed."""

import os
import subprocess
import sys

import pytest

from .conftest import ROOT

SCRIPTS = sorted((ROOT / "examples").glob("*.sh"))


@pytest.fixture(scope="module")
def shell(tmp_path_factory):
    """Runs a shell line from the project's root with `brdfguide` on the path."""
    folder = tmp_path_factory.mktemp("bin")
    command = folder / "brdfguide"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m brdfguide "$@"\n')
    command.chmod(0o755)
    environment = {
        **os.environ,
        "PATH": f"{folder}{os.pathsep}{os.environ['PATH']}",
        "TMPDIR": str(folder),
        "PYTHONPATH": str(ROOT),
    }

    def run(line):
        return subprocess.run(
            ["sh", "-c", line], cwd=ROOT, env=environment, capture_output=True, text=True, timeout=300
        )

    return run


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.name)
def test_example_runs(script, shell):
    run = shell(f"sh {script.relative_to(ROOT)}")
    assert run.returncode == 0, run.stderr
    assert run.stdout and "Traceback" not in run.stderr
