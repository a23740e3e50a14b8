"""Commands that write a file, where they may not and under a name of any bytes; commands that read one, from a pipe."""

import ctypes
import os
import subprocess
import sys
from contextlib import suppress

import pytest

from brdfguide import catalog

from ..conftest import ROOT
from . import test_streams

SAMPLE = str(ROOT / "examples" / "rough_plastic.csv")
QUICK = ("fit", SAMPLE, "-m", "lambertian+ggx", "--no-timing")
ODD = "\udcff\udce9 $\\frac{$\n"  # two bytes that are no UTF-8, a formula and a line's end
# A road to a file each; NAME stands for its name without an ending.
WRITING = {
    "fit --plot": (*QUICK, "--plot", "NAME.png"),
    "fit --report": (*QUICK, "--report", "NAME.html"),
    "fit --residuals": (*QUICK, "--residuals", "NAME.csv"),
    "fit --export": (*QUICK, "--export", "glsl:NAME.glsl"),
    "fit --out": (*QUICK, "--out", "NAME"),
    "recommend --report": ("recommend", "porcelain", "--report", "NAME.html"),
    "inspect --plot": ("inspect", SAMPLE, "--plot", "NAME.svg"),
    "convert": ("convert", SAMPLE, "NAME.csv"),
    "export": ("export", "office-paper", "--to", "osl", "-o", "NAME.osl"),
    "compare --plot": ("compare", "lambertian", "lambertian lambertian.albedo=0.2", "--plot", "NAME.png"),
    "preview": ("preview", "office-paper", "--size", "64", "-o", "NAME.png"),
    "explore": ("explore", "lambertian+ggx", "-o", "NAME.html"),
    "figures": ("figures", "NAME", "--only", "1"),
    "plan": ("plan", "porcelain", "--budget", "2", "--theta-max", "40", "-o", "NAME.csv"),
    "plan --plot": ("plan", "porcelain", "--budget", "2", "--theta-max", "40", "--plot", "NAME.png"),
    "examples": ("examples", "NAME"),
    "collect": ("collect", "{answers}/fits", "-o", "NAME.sqlite"),
    "scatter --plot": ("scatter", "abg", "a=1e-4", "b=1e-5", "g=1.8", "--plot", "NAME.svg"),
    "roughness --plot": ("roughness", "--angle", "80", "--plot", "NAME.svg"),
}
C_LOCALE = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}
# Of a file that can be read only once; @ stands for it.
READING = {
    "fit": (SAMPLE, ("fit", "@", "-m", "lambertian+ggx", "--no-timing", "--residuals", "out.csv")),
    "inspect": (SAMPLE, ("inspect", "@", "--json")),
    "compare": (SAMPLE, ("compare", "@", "lambertian lambertian.albedo=0.5")),
    "convert": (SAMPLE, ("convert", "@", "out.csv")),
    "convert a fit": ("fit.json", ("convert", "@", "out.binary")),
    "evaluate": ("fit.json", ("evaluate", "--fit", "@")),
    "figures": (SAMPLE, ("figures", ".", "--only", "5", "--data", "5=@")),
}
FIT = """
{"schema": "brdfguide/fit/1", "data": {"channels": ["brdf"], "wavelength_nm": [550]}, "recommended": "lambertian",
 "ranking": [{"model": "lambertian", "candidate": "lambertian", "freed": [],
              "parameters": {"lambertian.albedo": {"value": 0.5}}}]}
"""

pytestmark = pytest.mark.skipif(os.name == "nt", reason="names, pipes and permissions as POSIX has them")


def run(words, folder, env=(), **more):
    command = [sys.executable, "-W", "error", "-m", "brdfguide", *test_streams.with_answers(words)]
    environment = {**os.environ, **dict(env), "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, cwd=folder, capture_output=True, env=environment, timeout=300, **more)
    test_streams.sound(done.stderr)
    return done


def without_privileges():
    """The process may no longer write where permissions say that it may not; as root it could."""
    drop_from_bounds, dac_override, dac_read_search = 24, 1, 2  # Linux, capabilities(7)
    with suppress(AttributeError):
        for capability in (dac_override, dac_read_search):
            ctypes.CDLL(None).prctl(drop_from_bounds, capability, 0, 0, 0)


def test_every_command_has_its_rows():
    told = {words[0] for words in test_streams.COMMANDS.values()} | {words[0] for words in WRITING.values()}
    assert set(catalog.names("cli")) <= told


@pytest.mark.parametrize("road", WRITING)
def test_a_folder_that_is_read_only_is_one_sentence_before_any_work(road, tmp_path):
    tmp_path.chmod(0o555)
    words = [word.replace("NAME", "made") for word in WRITING[road]]
    done = run(words, tmp_path, preexec_fn=without_privileges)
    assert (done.returncode, done.stdout, done.stderr.count(b"\n")) == (2, b"", 1)
    assert b"nothing may be written into" in done.stderr or b"Permission denied" in done.stderr
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("road", WRITING)
def test_a_file_of_any_name_is_written_where_letters_are_ascii(road, tmp_path):
    words = [word.replace("NAME", ODD) for word in WRITING[road]]
    done = run(words, tmp_path, C_LOCALE)
    assert done.returncode == 0, done.stderr
    assert done.stdout.isascii() and done.stderr.isascii()
    (made,) = tmp_path.iterdir()
    assert made.name.startswith(ODD)


@pytest.mark.parametrize("command", READING)
def test_a_pipe_that_can_be_read_only_once_is_enough(command, tmp_path):
    content, words = READING[command]
    (tmp_path / "fit.json").write_text(FIT)
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with subprocess.Popen(["sh", "-c", f"cat '{content}' > pipe"], cwd=tmp_path) as writer:
        try:
            done = run([word.replace("@", "pipe") for word in words], tmp_path)
        finally:
            writer.kill()
    assert done.returncode == 0, done.stderr
    if command == "inspect":
        plain = run(("inspect", content, "--json"), tmp_path)
        assert plain.stdout.replace(content.encode(), b"pipe") == done.stdout


def test_a_substance_of_bytes_that_are_no_text_is_one_sentence(tmp_path):
    done = run(("index", ODD.replace("\n", "")), tmp_path)
    assert (done.returncode, done.stdout, done.stderr.count(b"\n")) == (2, b"", 1)
