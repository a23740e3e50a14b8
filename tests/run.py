"""Runs the tests in an environment of their own: `python3 tests/run.py [--extra NAME ...] [pytest options]`.

The environment is made beside the project in `.venv-tests` and used again while pyproject.toml stays the same.
"""

import argparse
import hashlib
import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PLACE = ROOT / ".venv-tests"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--extra", action="append", default=[], help="also install this extra, such as validate")
    wanted, rest = parser.parse_known_args()
    python = environment(["test", *wanted.extra])
    return subprocess.call([python, "-m", "pytest", "-n", "auto", *rest], cwd=ROOT)


def environment(extras: list[str]) -> str:
    """The interpreter of an environment with the project, as it stands, and its extras installed."""
    python = str(PLACE / ("Scripts" if os.name == "nt" else "bin") / "python")
    state = hashlib.sha256((ROOT / "pyproject.toml").read_bytes() + ",".join(sorted(extras)).encode() + sys.version.encode()).hexdigest()
    mark = PLACE / "installed"
    if not (mark.exists() and mark.read_text() == state):
        shutil.rmtree(PLACE, ignore_errors=True)
        venv.create(PLACE, with_pip=True)
        subprocess.check_call([python, "-m", "pip", "install", "--quiet", "--editable", f"{ROOT}[{','.join(extras)}]"])
        mark.write_text(state)
    return python


if __name__ == "__main__":
    sys.exit(main())
