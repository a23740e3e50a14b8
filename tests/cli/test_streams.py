"""Every command on every kind of standard output, in every encoding: an answer or one sentence, never a traceback."""

import os
import pty
import signal
import subprocess
import sys
import tempfile
from functools import cache
from io import StringIO
from time import sleep

import pytest

from brdfguide.cli import _options

from .. import patience
from ..conftest import ROOT

SAMPLE = str(ROOT / "examples" / "rough_plastic.csv")
FIT = ("fit", SAMPLE, "-m", "lambertian+ggx", "--no-timing")
# Commands whose words hold the most signs beyond ASCII, and one of every road to standard output.
COMMANDS = {
    "version": ("--version",),
    "help": ("fit", "--help"),
    "roughness": ("roughness", "--angle", "80"),
    "roughness plot": ("roughness", "--angle", "80", "--contour", "--json"),
    "fit": FIT,
    "fit json": (*FIT, "--json"),
    "several": ("fit", SAMPLE, SAMPLE, "-m", "lambertian+ggx", "--no-timing"),
    "inspect": ("inspect", SAMPLE),
    "recommend": ("recommend", "porcelain", "--explain"),
    "evaluate": ("evaluate", "lambertian+ggx"),
    "export": ("export", "porcelain", "--to", "glsl", "-o", "-"),
    "targets": ("export",),
    "models": ("models", "he-torrance"),
    "materials": ("materials", "porcelain"),
    "index": ("index", "gold"),
    "gloss": ("gloss", "--at-60", "80"),
    "albedo": ("albedo", "--patch", "white"),
    "check": ("check", "lambertian"),
    "numbers": ("numbers", "gltf roughness=0.4"),
    "scatter": ("scatter", "--ra", "12nm"),
    "bench": ("bench", "-m", "lambertian"),
    "compare": ("compare", "lambertian", "lambertian lambertian.albedo=0.2"),
    "schema": ("schema", "fit"),
    "plan": ("plan", "porcelain", "--budget", "2", "--theta-max", "40"),
    "verify": ("verify", "{answers}/answer.json"),
    "search": ("search", "{answers}/fits"),
    "prune-answers": ("prune-answers", "{answers}/fits"),
    "wrong": ("evaluate", "größe\x1b[31m"),
}
ENCODINGS = {
    "ascii": {"PYTHONIOENCODING": "ascii"},
    "cp1252": {"PYTHONIOENCODING": "cp1252"},
    "strict": {"PYTHONIOENCODING": "utf-8:strict"},
    "C": {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"},
}


@cache
def answers() -> str:
    """A folder with one answer, and what a run over several surfaces makes."""
    made = tempfile.mkdtemp()
    alone = [sys.executable, "-m", "brdfguide", "fit", SAMPLE, "-m", "lambertian", "--no-timing"]
    with open(f"{made}/answer.json", "w") as file:
        subprocess.run([*alone, "--json"], cwd=ROOT, stdout=file, check=True)
    several = [*alone, "examples/white_paper.csv", "--out", f"{made}/fits"]
    subprocess.run(several, cwd=ROOT, capture_output=True, check=True)
    return made


def with_answers(words) -> list[str]:
    """`{answers}` in the words of a command as the folder that it stands for."""
    return [word.replace("{answers}", answers()) if "{answers}" in word else word for word in words]


def start(words, stdout, env=(), warnings=("error",), **more):
    run = [sys.executable, *(f"-W{each}" for each in warnings), "-m", "brdfguide", *with_answers(words)]
    environment = {**os.environ, **dict(env)}
    return subprocess.Popen(run, cwd=ROOT, stdout=stdout, stderr=subprocess.PIPE, env=environment, **more)


def default_hangup() -> None:
    """Whoever is started under nohup ignores it."""
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


def sound(err: bytes) -> None:
    """No traceback, no mistake of ours, nothing that acts on a terminal."""
    assert b"Traceback" not in err and b"mistake of brdfguide" not in err and b"Exception ignored" not in err, err
    assert b"\x1b" not in err


@pytest.mark.parametrize("encoding", ENCODINGS)
@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_answers_in_any_encoding(command, encoding):
    run = start(COMMANDS[command], subprocess.PIPE, ENCODINGS[encoding])
    out, err = run.communicate(timeout=patience.AN_AGE_S)
    sound(err)
    assert run.returncode == (2 if command == "wrong" else 0), err
    assert b"\x1b" not in out
    if encoding in ("ascii", "C") and command != "export":  # a file's bytes are the same everywhere
        assert out.isascii() and err.isascii() and (command == "wrong" or b"\\u" not in out + err)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")
@pytest.mark.parametrize("command", COMMANDS)
def test_a_full_standard_output_is_one_sentence_and_status_2(command):
    with open("/dev/full", "wb") as full:
        run = start(COMMANDS[command], full)
    _, err = run.communicate(timeout=patience.AN_AGE_S)
    sound(err)
    assert run.returncode == 2
    assert command == "wrong" or b"No space left on device" in err


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize("command", ["fit json", "export", "schema"])
def test_a_disk_that_is_full_in_the_middle_is_one_too(command, unbuffered, tmp_path):
    """With PYTHONUNBUFFERED Python itself drops what does not fit, and says nothing."""
    import resource

    def small_files() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (500, 500))

    with (tmp_path / "out").open("wb") as out:
        run = start(COMMANDS[command], out, {"PYTHONUNBUFFERED": unbuffered}, preexec_fn=small_files)
        _, err = run.communicate(timeout=patience.AN_AGE_S)
    assert run.returncode == 2 and err == b"brdfguide: cannot write standard output: File too large\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_a_reader_who_has_enough_is_no_error(command):
    reading, writing = os.pipe()
    os.close(reading)
    run = start(COMMANDS[command], writing)
    os.close(writing)
    _, err = run.communicate(timeout=patience.AN_AGE_S)
    sound(err)
    assert run.returncode == (2 if command == "wrong" else 0), err


@pytest.mark.parametrize("command", COMMANDS)
def test_closed_streams_are_told_from_none(command):
    run = start(COMMANDS[command], None, preexec_fn=lambda: os.close(1))
    _, err = run.communicate(timeout=patience.AN_AGE_S)
    sound(err)
    assert run.returncode == 2
    assert command == "wrong" or b"Bad file descriptor" in err


@pytest.mark.parametrize("command", COMMANDS)
def test_a_terminal_shows_signs_and_obeys_none(command, tmp_path):
    """On a terminal colours are ours; what names hold is shown."""
    odd = tmp_path / "a\x1b]0;T\x07[red]\nb.csv"
    odd.write_bytes((ROOT / "examples" / "rough_plastic.csv").read_bytes())
    words = with_answers([str(odd) if word == SAMPLE else word for word in COMMANDS[command]])
    leader, follower = pty.openpty()
    environment = {**os.environ, "TERM": "xterm-256color", "PYTHONIOENCODING": "utf-8", "COLUMNS": "200"}
    run = subprocess.Popen(
        [sys.executable, "-m", "brdfguide", *words], cwd=ROOT, stdout=follower, stderr=follower, env=environment
    )
    os.close(follower)
    out = b""
    while True:
        try:
            piece = os.read(leader, 65536)
        except OSError:
            break
        if not piece:
            break
        out += piece
    os.close(leader)
    assert run.wait(timeout=patience.AN_AGE_S) == (2 if command == "wrong" else 0)
    assert b"Traceback" not in out and b"\x1b]0;" not in out and b"\x07" not in out
    if SAMPLE in COMMANDS[command] and "--json" not in COMMANDS[command]:
        assert rb"a\x1b]0;T\x07[red]\nb.csv" in out.replace(b"\r\n", b"")


@pytest.mark.parametrize("closed", [0, 2])
def test_without_standard_input_or_error_the_answer_is_there(closed):
    run = start(COMMANDS["inspect"], subprocess.PIPE, preexec_fn=lambda: os.close(closed))
    out, _ = run.communicate(timeout=patience.AN_AGE_S)
    assert run.returncode == 0 and SAMPLE.encode() in out and b"Traceback" not in out
    run = start(("inspect", "-"), subprocess.PIPE, preexec_fn=lambda: os.close(closed), stdin=subprocess.DEVNULL)
    out, err = run.communicate(timeout=patience.AN_AGE_S)
    assert run.returncode == 2 and out == b"" and (closed == 2 or b"standard input: the file is empty" in err)


def test_a_stream_of_requests_ends_with_its_reader():
    words = f"yes 80 | {sys.executable} -W error -m brdfguide roughness --batch - | head -2; echo ${{PIPESTATUS[@]}}"
    run = subprocess.run(["bash", "-c", words], cwd=ROOT, capture_output=True, text=True, timeout=patience.AN_AGE_S)
    assert run.stdout.splitlines()[-1] == "141 0 0" and len(run.stdout.splitlines()) == 3
    sound(run.stderr.encode())


def test_odd_bytes_and_endless_lines_in_a_stream_of_requests_are_rows():
    run = start(("roughness", "--batch", "-"), subprocess.PIPE, stdin=subprocess.PIPE)
    out, err = run.communicate(b"\xff\xfe\n80\n" + b"9" * 1_000_000 + b"\n\x1b[31m\n81\n", timeout=patience.AN_AGE_S)
    sound(err)
    rows = out.decode().splitlines()
    assert run.returncode == 2 and len(rows) == 6 and b"\x1b" not in out and all(len(row) < 1500 for row in rows)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_a_command_at_once_and_leaves_nothing(number, tmp_path):
    unclosed = ("error", "ignore::ResourceWarning")  # it may meet an import that has its file open
    run = start(("check",), subprocess.PIPE, warnings=unclosed, preexec_fn=default_hangup)
    patience.until(lambda: patience.listens(run, signal.SIGHUP), run)  # the last that it begins to listen to
    before = patience.processor_s(run.pid)
    run.send_signal(number)
    heard: list = []
    spent = patience.spent(lambda: heard.extend(run.communicate(timeout=patience.AN_AGE_S)))
    err = heard[1]
    assert run.returncode == 128 + number and spent - before < 2.0  # the whole audit takes minutes
    sound(err)


@pytest.mark.parametrize(
    "words", [("inspect", "\udcff\udce9.csv"), ("fit", "\udcff.csv"), ("recommend", "\udcff.yaml")]
)
def test_a_name_that_is_not_utf_8_is_shown_by_its_bytes(words, tmp_path):
    run = start(words, subprocess.PIPE)
    _, err = run.communicate(timeout=patience.AN_AGE_S)
    sound(err)
    assert run.returncode == 2 and rb"\xff" in err


def test_every_product_of_a_fit_takes_a_name_that_is_not_utf_8(tmp_path):
    odd = os.fsencode(tmp_path) + b"/\xffa\n$\\frac{$.csv"
    with open(odd, "wb") as file:
        file.write((ROOT / "examples" / "rough_plastic.csv").read_bytes())
    words = ["fit", os.fsdecode(odd), "-m", "lambertian+ggx", "--plot", "p.png", "--report", "p.html"]
    words += ["--residuals", "r.csv", "--export", "glsl:p.glsl", "--export", "gltf:p.gltf", "--json"]
    words = [word if word.startswith("-") or "." not in word else word for word in words]
    run = subprocess.run(
        [sys.executable, "-W", "error", "-m", "brdfguide", *words],
        cwd=tmp_path,
        capture_output=True,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    sound(run.stderr)
    assert run.returncode == 0, run.stderr
    for name in ("p.html", "r.csv", "p.glsl", "p.gltf"):
        text = (tmp_path / name).read_text(encoding="utf-8")
        assert r"\xffa\n" in text.replace("\\\\", "\\") or name == "p.gltf", name
    assert (tmp_path / "r.csv").read_text().splitlines()[1].startswith("theta_i_deg,")
    run = start(("inspect", os.fsdecode(odd), "--plot", str(tmp_path / "i.png")), subprocess.PIPE)
    _, err = run.communicate(timeout=patience.AN_AGE_S)
    sound(err)
    assert run.returncode == 0 and (tmp_path / "i.png").exists()
    run = start(("convert", os.fsdecode(odd), str(tmp_path / "c.csv")), subprocess.PIPE)
    _, err = run.communicate(timeout=patience.AN_AGE_S)
    sound(err)
    assert run.returncode == 0, err


def test_without_a_home_pictures_are_drawn_in_silence(tmp_path):
    gone = {"HOME": str(tmp_path / "none"), "MPLCONFIGDIR": str(tmp_path / "no" / "such")}
    (tmp_path / "no").write_text("")  # so that no folder can be made there
    run = start(("roughness", "--angle", "80", "--plot", str(tmp_path / "p.png")), subprocess.PIPE, gone)
    _, err = run.communicate(timeout=patience.AN_AGE_S)
    assert run.returncode == 0 and err.decode().count("\n") == 1, err


class Screen(StringIO):
    """A terminal in memory."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


def test_what_takes_long_is_said_on_a_terminal_until_it_is_done(monkeypatch):
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setattr(_options, "PATIENCE_S", 0.01)
    monkeypatch.setattr(sys, "stderr", Screen())
    with _options.working("drawing \x1b[2J.png"):
        sleep(0.1)
        said = sys.stderr.getvalue()
    assert "drawing " in said and ", 0 s" in said and "\x1b[2J" not in said
    assert sys.stderr.getvalue().endswith("\r\x1b[K")


def test_what_takes_long_is_not_said_in_a_pipe_nor_when_quiet(monkeypatch):
    monkeypatch.setattr(_options, "PATIENCE_S", 0.01)
    for stream, quiet in ((StringIO(), False), (Screen(), True)):
        monkeypatch.setattr(sys, "stderr", stream)
        with _options.working("drawing", quiet):
            sleep(0.05)
        assert stream.getvalue() == ""
