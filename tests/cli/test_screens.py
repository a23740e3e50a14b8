"""What a person sees: every command on a terminal of 80, 100, 120 and 200 columns, and nothing wider than it."""

import os
import re
import struct
import subprocess
import sys

import pytest

from brdfguide.printable import width

from ..conftest import ROOT

pty = pytest.importorskip("pty")  # Unix alone has them
fcntl = pytest.importorskip("fcntl")
termios = pytest.importorskip("termios")

SAMPLE = "examples/rough_plastic.csv"
EVERY_WIDTH = (80, 100, 120, 200)
# command -> the widths that it is tried at; texts that the documents' tests fold are tried where it is narrow
SCREENS = {
    f"fit {SAMPLE} -m lambertian+ggx,lambertian+ward --no-timing": EVERY_WIDTH,
    f"fit {SAMPLE} examples/rough_aluminium.csv -m lambertian+ggx": (80,),
    f"inspect {SAMPLE}": (80, 120),
    "recommend office-paper --no-timing": (80, 120),
    "recommend office-paper --no-timing --full": (80,),
    "roughness --angle 75 --full": (80, 100),
    "compare lambertian+ggx lambertian+ward": (80,),
    "gloss --at-60 40": (80,),
    "index gold": (80,),
    "models": (80,),
    "models he-torrance": (80,),
    "numbers lambertian+ggx": (50, 80),
    "scatter --ra 12nm": (80,),
    "check lambertian": (80,),
    "export": (80,),
    "fit --help": (80,),
}


def screen(words: list[str], columns: int) -> str:
    """What stands on a terminal of so many columns after a command; its standard error goes elsewhere."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    environment = {key: value for key, value in os.environ.items() if key not in ("COLUMNS", "NO_COLOR")}
    command = [sys.executable, "-m", "brdfguide", *words]
    process = subprocess.Popen(
        command,
        cwd=ROOT,
        env={**environment, "TERM": "xterm", "PYTHONUTF8": "1"},
        stdout=theirs,
        stderr=subprocess.PIPE,
        stdin=subprocess.DEVNULL,
    )
    os.close(theirs)
    shown = b""
    while True:
        try:
            some = os.read(ours, 2**16)
        except OSError:  # how Linux says that the other end is closed
            break
        if not some:
            break
        shown += some
    os.close(ours)
    assert process.wait() == 0, process.stderr.read().decode()
    process.stderr.close()
    return re.sub(r"\x1b\[[0-9;]*m", "", shown.decode().replace("\r\n", "\n"))


@pytest.mark.parametrize("line, columns", [(line, each) for line, widths in SCREENS.items() for each in widths])
def test_nothing_is_wider_than_the_terminal(line, columns):
    shown = screen(line.split(), columns)
    assert shown.strip()
    assert max(map(width, shown.split("\n"))) <= columns


def test_a_terminal_and_a_pipe_say_the_same_words():
    words = f"recommend office-paper {SAMPLE} -m lambertian+ggx --no-timing".split()
    piped = subprocess.run(
        [sys.executable, "-m", "brdfguide", *words], cwd=ROOT, capture_output=True, text=True, timeout=300
    )
    assert screen(words, 80).split() == piped.stdout.split()


def test_a_pipe_has_a_line_for_each_row_whatever_the_terminal_is():
    words = [sys.executable, "-m", "brdfguide", "fit", SAMPLE, "-m", "lambertian+ggx,lambertian+lafortune:2"]
    runs = [
        subprocess.run(words + ["--full", "--no-timing"], cwd=ROOT, capture_output=True, text=True, env=environment)
        for environment in ({**os.environ, "COLUMNS": "40"}, {**os.environ, "COLUMNS": "200"})
    ]
    assert runs[0].stdout == runs[1].stdout
    rows = [line for line in runs[0].stdout.split("\n") if line.startswith("lambertian+lafortune:2  ")]
    assert len(rows) == 2 and "lafortune.2.exponent" in rows[1]
