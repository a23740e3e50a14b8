"""What each command may load. Seconds and instructions depend on the machine; the list of loaded modules does not."""

import subprocess
import sys
from functools import cache

import pytest

from .conftest import ROOT

HEAVY = ("numpy", "scipy", "yaml", "matplotlib")
# command line -> modules that it must not load; one row for each command
MAY_NOT_LOAD = {
    "--help": HEAVY,
    "--version": (*HEAVY, "typer", "json", "dataclasses", "re"),
    "roughness --angle 80": (*HEAVY, "typer", "rich", "json", "dataclasses", "re", "typing"),
    "roughness --angle 80 --json": (*HEAVY, "typer", "rich", "json", "dataclasses", "re", "typing"),
    "roughness --help": HEAVY,
    "inspect --help": HEAVY,
    "inspect examples/rough_plastic.csv": ("scipy", "yaml", "matplotlib"),
    "convert --help": HEAVY,
    "albedo --patch white": HEAVY,
    "materials porcelain": ("numpy", "scipy", "matplotlib"),
    "index gold": ("scipy", "yaml", "matplotlib"),
    "gloss --at-60 80": ("scipy", "yaml", "matplotlib"),
    "recommend porcelain": ("scipy", "matplotlib", "rich"),
    "check lambertian": ("scipy", "yaml", "matplotlib"),
    "bench -m lambertian": ("scipy", "yaml", "matplotlib"),
}
RUN = """
import sys
from brdfguide.__main__ import main
try:
    status = main()
except SystemExit as end:
    status = end.code
print("LOADED", status or 0, *sys.modules)
"""


@cache
def before_anything() -> set[str]:
    """What the interpreter itself loads at its start, an editable installation's hook included."""
    run = subprocess.run([sys.executable, "-c", "import sys; print(*sys.modules)"], cwd=ROOT, capture_output=True, text=True)
    return set(run.stdout.split())


@pytest.mark.parametrize("line", MAY_NOT_LOAD)
def test_loads_only_what_it_uses(line):
    run = subprocess.run([sys.executable, "-c", RUN, *line.split()], cwd=ROOT, capture_output=True, text=True)
    status, *loaded = run.stdout.rpartition("LOADED ")[2].split()
    assert status == "0", run.stderr
    assert not (set(loaded) - before_anything()) & set(MAY_NOT_LOAD[line])
