"""The program as a stranger gets it: an sdist, the wheel built from it, and an environment that holds the wheel."""

import os
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import venv
from pathlib import Path
from typing import NamedTuple

from .conftest import ROOT

NOT_SOURCE = (".git", ".venv*", "__pycache__", "*.egg-info", ".*_cache", ".hypothesis", "build", "dist", "site")
BUILD = "import sys; from setuptools import build_meta; print(getattr(build_meta, sys.argv[1])(sys.argv[2]))"


class Installed(NamedTuple):
    """Where everything is."""

    sdist: Path  # unpacked
    wheel: Path
    bin: Path  # of the environment, with `brdfguide` in it


def installed(folder: Path) -> Installed:
    """Builds and installs; the dependencies are those of this interpreter, which the environment sees by a path."""
    copy = folder / "copy"  # building writes beside the source, and others may build at the same time
    shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*NOT_SOURCE))
    packed = folder / _built("build_sdist", copy, folder)
    with tarfile.open(packed) as archive:
        archive.extractall(folder, filter="data")
    source = folder / packed.name.removesuffix(".tar.gz")
    wheel = folder / _built("build_wheel", source, folder)
    place = folder / "environment"
    venv.create(place, symlinks=os.name != "nt")
    bin_ = place / ("Scripts" if os.name == "nt" else "bin")
    python = bin_ / "python"
    command = [sys.executable, "-m", "pip", "--python", str(python), "install", "-q", "--no-deps", "--no-index"]
    subprocess.run([*command, str(wheel)], check=True, capture_output=True)
    site = subprocess.run(
        [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"], capture_output=True, text=True
    ).stdout.strip()
    Path(site, "dependencies.pth").write_text(sysconfig.get_path("purelib") + "\n")
    return Installed(source, wheel, bin_)


def _built(kind: str, source: Path, folder: Path) -> str:
    run = subprocess.run([sys.executable, "-c", BUILD, kind, str(folder)], cwd=source, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr[-2000:]
    return run.stdout.strip().split("\n")[-1]
