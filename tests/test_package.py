"""What is published: a wheel with all that commands read, an sdist whose tests run, metadata that say what it is."""

import re
import subprocess
import sys
import tomllib
import zipfile
from email import message_from_string

import pytest

import brdfguide

from .conftest import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_every_package_of_the_source_is_declared():
    packages = {
        path.parent.relative_to(ROOT).as_posix().replace("/", ".") for path in (ROOT / "brdfguide").rglob("__init__.py")
    }
    assert packages <= set(PROJECT["tool"]["setuptools"]["packages"])


def test_the_wheel_is_pure_and_holds_what_commands_read(package):
    names = zipfile.ZipFile(package.wheel).namelist()
    assert package.wheel.name.endswith("py3-none-any.whl")
    source = [path for folder in ("brdfguide", "materials") for path in (ROOT / folder).rglob("*") if path.is_file()]
    wanted = {path.relative_to(ROOT).as_posix() for path in source if "__pycache__" not in path.parts}
    assert {name if name.startswith("brdfguide/") else f"brdfguide/{name}" for name in wanted} <= set(names)
    assert {"brdfguide/examples/rough_plastic.csv", "brdfguide/examples/photographs/shots.yaml"} <= set(names)
    assert not [name for name in names if name.startswith("tests/")]


def test_the_sdist_holds_every_file_of_the_project(package):
    tracked = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True)
    if tracked.returncode or not tracked.stdout:
        pytest.skip("no git here to say which files there are")
    files = [name for name in tracked.stdout.split("\0") if name and (ROOT / name).is_file() and name != ".gitignore"]
    assert len(files) > 500 and [name for name in files if not (package.sdist / name).is_file()] == []


def test_the_tests_run_from_the_sdist(package):
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "tests/test_files.py",
        "tests/test_flags.py",
    ]
    run = subprocess.run(command, cwd=package.sdist, capture_output=True, text=True)
    assert run.returncode == 0 and " passed" in run.stdout, run.stdout[-2000:]


def test_the_metadata_say_what_it_is(package):
    wheel = zipfile.ZipFile(package.wheel)
    name = next(each for each in wheel.namelist() if each.endswith(".dist-info/METADATA"))
    metadata = message_from_string(wheel.read(name).decode())
    assert metadata["License-Expression"] == "MIT" and metadata["Version"] == brdfguide.__version__
    assert metadata["Author"] and metadata["Keywords"] and len(metadata.get_all("Classifier")) > 8
    assert metadata["Requires-Python"] == ">=3.11"


def test_the_version_is_the_one_of_the_changes_and_of_the_citation():
    first = re.search(r"^## (\S+)", (ROOT / "CHANGELOG.md").read_text(), re.M).group(1)
    cited = re.search(r"^version: (\S+)", (ROOT / "CITATION.cff").read_text(), re.M).group(1)
    assert first == cited == brdfguide.__version__


@pytest.mark.parametrize(
    "line, says",
    [
        ("materials porcelain", "name: porcelain"),
        ("schema fit", '"title": "brdfguide/fit/1"'),
        ("figures pictures --only 4", ""),
        ("examples", "rough_plastic.csv"),
        ("examples data", ""),
        ("check lambertian", "laws tried"),
    ],
)
def test_a_command_that_reads_files_works_from_an_empty_folder(package, tmp_path, line, says):
    run = subprocess.run([package.bin / "brdfguide", *line.split()], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0 and says in run.stdout, run.stderr
