"""Runs the tests in an environment of their own: `python3 tests/run.py [--extra NAME ...] [pytest options]`.

With `--prepare` the environment is only made, and its interpreter printed. With `--lowest` it holds the least versions
that pyproject.toml allows at run time, in an environment of its own.

The environment is made beside the project in `.venv-tests` and used again while pyproject.toml stays the same.
"""

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import tomllib
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PLACE, LOWEST = ROOT / ".venv-tests", ROOT / ".venv-lowest"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--extra", action="append", default=[], help="also install this extra, such as validate")
    parser.add_argument("--prepare", action="store_true", help="only make the environment, and print its interpreter")
    parser.add_argument("--group", action="append", default=[], help="also install this dependency group, such as lint")
    parser.add_argument("--lowest", action="store_true", help="the least versions that are declared")
    wanted, rest = parser.parse_known_args()
    python = environment(wanted.extra, ["test", *wanted.group], wanted.lowest)
    if wanted.prepare:
        print(python)
        return 0
    calm = ["-W", "ignore::DeprecationWarning"] if wanted.lowest else []  # old libraries beside newer ones of theirs
    return subprocess.call([python, "-m", "pytest", "-n", "auto", *calm, *rest], cwd=ROOT)


def environment(extras: list[str], groups: list[str], lowest: bool) -> str:
    """The interpreter of an environment with the project, as it stands, its extras and dependency groups installed."""
    place = LOWEST if lowest else PLACE
    python = str(place / ("Scripts" if os.name == "nt" else "bin") / "python")
    words = ",".join(sorted([*extras, *groups, str(lowest)]))
    about = (ROOT / "pyproject.toml").read_bytes() + words.encode() + sys.version.encode()
    state, mark = hashlib.sha256(about).hexdigest(), place / "installed"
    if not (mark.exists() and mark.read_text() == state):
        shutil.rmtree(place, ignore_errors=True)
        venv.create(place, with_pip=True)
        of = f"[{','.join(extras)}]" if extras else ""  # older versions of pip take no empty list
        install = [python, "-m", "pip", "install", "--quiet", "--editable", f"{ROOT}{of}"]
        subprocess.check_call([*install, *members(groups), *(least() if lowest else ())])
        mark.write_text(state)
    return python


def declared() -> dict:
    return tomllib.loads((ROOT / "pyproject.toml").read_text())


def members(groups: list[str]) -> list[str]:
    """What the dependency groups hold, for a pip that does not know groups yet."""
    found: list[str] = []
    for group in groups:
        for each in declared()["dependency-groups"][group]:
            found += members([each["include-group"]]) if isinstance(each, dict) else [each]
    return found


def least() -> list[str]:
    """The run-time dependencies, each at the least version that is allowed."""
    return [each.partition(",")[0].replace(">=", "==") for each in declared()["project"]["dependencies"]]


if __name__ == "__main__":
    sys.exit(main())
