"""What a shell offers after a tabulator: commands, options and the values of both, in bash, zsh and fish."""

import os
import subprocess
import sys

import pytest

from brdfguide import catalog
from brdfguide.cli import _complete
from brdfguide.fitting.objective import METRICS
from brdfguide.models import every

from ..conftest import ROOT

SHELLS = {
    "bash": lambda line: {"COMP_WORDS": line, "COMP_CWORD": str(len(line.split(" ")) - 1)},
    "zsh": lambda line: {"_TYPER_COMPLETE_ARGS": line},
    "fish": lambda line: {"_TYPER_COMPLETE_ARGS": line, "_TYPER_COMPLETE_FISH_ACTION": "get-args"},
}
OFFERED = {
    "brdfguide export --to mits": {"mitsuba", "mitsuba-dict"},
    "brdfguide fit x.csv --metric cu": {"cube-root"},
    "brdfguide fit x.csv -m lambertian+he": {"lambertian+he-torrance"},
    "brdfguide fit x.csv -m ggx,wa": {"ggx,ward", "ggx,ward-gmd"},
    "brdfguide fit x.csv --kind m": {"metal"},
    "brdfguide recommend porc": {"porcelain"},
    "brdfguide materials gold": {"gold-leaf"},
    "brdfguide models he": {"he-torrance"},
    "brdfguide schema ins": {"inspect"},
    "brdfguide roug": {"roughness"},
    "brdfguide --explain discr": {"discrepancy"},
}


@pytest.mark.parametrize("shell", SHELLS)
@pytest.mark.parametrize("line", list(OFFERED) if os.name == "posix" else [])
def test_a_tabulator_offers_the_values(line, shell):
    if shell != "bash" and line not in list(OFFERED)[:3]:
        return
    environment = {**os.environ, _complete.ASKED: f"complete_{shell}", **SHELLS[shell](line)}
    run = subprocess.run([sys.executable, "-m", "brdfguide"], cwd=ROOT, env=environment, capture_output=True, text=True)
    shown = run.stdout.replace('"', " ").replace("\t", " ").split()
    assert OFFERED[line] <= set(shown), run.stdout + run.stderr


def test_only_the_command_on_the_line_is_built(monkeypatch):
    known = catalog.names("cli")
    monkeypatch.setenv("COMP_WORDS", "brdfguide export --to mi")
    assert _complete.wanted(known) == ["export"]
    monkeypatch.setenv("COMP_WORDS", "brdfguide exp")
    assert _complete.wanted(known) == known


def test_the_words_are_those_that_the_program_takes():
    assert set(_complete.WORDS["--metric"]) == {*METRICS, "seen"}
    assert set(_complete.WORDS["--as"]) == {model.name for model in every() if model.settings}
    assert set(_complete.CONVERTED) <= set(catalog.names("exporters"))
