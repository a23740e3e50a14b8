"""Running what `commands` finds in a page, and whether it prints what the page shows.

`python -m tests.transcripts` prints every block of the language `console` anew.
"""

import os
import re
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from .conftest import ROOT

BLOCK = re.compile(r"```console\n(.*?)```", re.S)
PROMPT = re.compile(r"^\$ ", re.M)
NUMBER = re.compile(r"\d+\.\d+")
FULL = 14  # characters, from which a number is printed in full
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
SHOWN = [page for page in PAGES if BLOCK.search(page.read_text())]


def alike(said: str, shown: str) -> bool:
    """The same words, and decimal numbers that agree to two units of the last digit: another NumPy may round
    otherwise. Those that are printed in full agree to twelve digits, however many there are.
    """
    if NUMBER.sub("#", said) != NUMBER.sub("#", shown):
        return False
    pairs = zip(NUMBER.findall(said), NUMBER.findall(shown), strict=True)
    return all(_alike_numbers(a, b) for a, b in pairs)


def _alike_numbers(said: str, shown: str) -> bool:
    apart = abs(float(said) - float(shown))
    if min(len(said), len(shown)) > FULL:
        return apart <= 1e-12 * abs(float(shown))
    return len(said) == len(shown) and apart <= 2.001 * 10.0 ** -len(shown.partition(".")[2])


def missing(printed: str, shown: str) -> str | None:
    """The first line of the page that the program does not print in its place; None where all are there."""
    said = [line.rstrip() for line in printed.splitlines()]
    place = 0
    for line in (line.rstrip() for line in shown.splitlines()):
        if line == "...":
            continue
        found = next((at for at in range(place, len(said)) if alike(said[at], line)), None)
        if found is None:
            return line
        place = found + 1
    return None


def run(command: str, folder: Path, path: str) -> subprocess.CompletedProcess:
    """A shell line with `brdfguide` found on the path."""
    environment = {**os.environ, "PATH": f"{path}{os.pathsep}{os.environ['PATH']}", "PYTHONUTF8": "1"}
    return subprocess.run(
        ["sh", "-c", command], cwd=folder, env=environment, capture_output=True, text=True, timeout=1800
    )


def printed_anew(page: Path, path: str) -> str:
    """The page with what its commands print now; where `...` stands it is left as it is."""
    from .commands import commands, furnished

    with TemporaryDirectory() as folder:
        furnished(page, Path(folder), path)
        printed = []
        for command, shown in commands(page):
            done = run(command, Path(folder), path)
            assert done.returncode == 0, f"{page}: {command}: {done.stderr}"
            if shown is not None:
                printed.append(f"{shown}\n" if "..." in shown.splitlines() else done.stdout)

    def block(found: re.Match) -> str:
        parts = [f"$ {part.partition(chr(10))[0]}\n{printed.pop(0)}" for part in PROMPT.split(found.group(1))[1:]]
        return "```console\n" + "".join(parts) + "```"

    return BLOCK.sub(block, page.read_text())


if __name__ == "__main__":
    with TemporaryDirectory() as bin_folder:
        program = Path(bin_folder, "brdfguide")
        program.write_text(f'#!/bin/sh\nPYTHONPATH="{ROOT}" exec "{sys.executable}" -m brdfguide "$@"\n')
        program.chmod(0o755)
        for each in map(Path, sys.argv[1:]) if sys.argv[1:] else SHOWN:
            each.write_text(printed_anew(each, bin_folder))
