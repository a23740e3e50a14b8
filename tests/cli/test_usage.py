"""What the parser cannot take is one sentence like any other, with status 2, and an empty word is never taken."""

import subprocess
import sys

import pytest

from brdfguide.cli import main

from .. import patience
from ..conftest import ROOT

SAMPLE = str(ROOT / "examples" / "rough_plastic.csv")
WRONG = {
    ("roughness", "--angle", "80,5"): "--angle '80,5': wanted a number; `brdfguide roughness -h` says what there is",
    ("gloss", "--alpha", "7"): "--alpha 7.0: wanted 0.002 to 1; `brdfguide gloss -h` says what there is",
    ("search", ".", "-n", "0"): "--most 0: wanted 1 or more; `brdfguide search -h` says what there is",
    ("fit", SAMPLE, "--jobs", "1.5"): "--jobs '1.5': wanted a whole number; `brdfguide fit -h` says what there is",
    ("fit", "--modls"): (
        "no option called '--modls'; did you mean --columns or --jobs or --models?; `brdfguide fit -h` says what there "
        "is"
    ),
    ("fit", SAMPLE, "-m"): "-m: requires an argument; `brdfguide fit -h` says what there is",
    ("models", "a", "b"): "found more than it takes: b; `brdfguide models -h` says what there is",
    ("compare",): "found nothing for A B...; `brdfguide compare -h` says what there is",
    ("explain",): "no such command 'explain'; did you mean 'plan'?; `brdfguide -h` says what there is",
    ("fit", SAMPLE, "-m", ""): "--models '': wanted something; of a variable that is not set nothing is left",
    ("fit", SAMPLE, "--out", ""): "--out '': wanted something; of a variable that is not set nothing is left",
    (
        "albedo",
        "--between",
        "",
        "white",
    ): "--between '': wanted something; of a variable that is not set nothing is left",
    ("fit", ""): "[DATA]... '': wanted something; of a variable that is not set nothing is left",
    ("recommend", ""): "[INPUT]... '': wanted something; of a variable that is not set nothing is left",
    ("fit", SAMPLE, "--wavelength", "nan"): ("--wavelength nan: wanted nanometres such as 550, 450,550,650 or 400:700"),
    ("inspect", SAMPLE, "--wavelength", "400:inf"): (
        "--wavelength 400:inf: wanted nanometres such as 550, 450,550,650 or 400:700"
    ),
}  # words -> the sentence


@pytest.mark.parametrize("words", WRONG, ids=lambda words: " ".join(words).replace(SAMPLE, "FILE") or "none")
def test_bad_usage_is_one_sentence(words, capsys):
    with pytest.raises(SystemExit) as end:
        main(list(words))
    out, err = capsys.readouterr()
    assert end.value.code == 2 and not out
    assert err == f"brdfguide: {WRONG[words]}\n"


def test_no_word_at_all_is_answered_by_the_help(capsys):
    with pytest.raises(SystemExit) as end:
        main([])
    assert end.value.code == 2 and capsys.readouterr().err.startswith("Usage: brdfguide [OPTIONS]")


@pytest.mark.parametrize("words", [("--help",), ("fit", "--help"), ("--version",)])
def test_a_full_disk_is_told_once_of_help_too(words):
    with open("/dev/full", "wb") as full:
        run = [sys.executable, "-m", "brdfguide", *words]
        done = subprocess.run(run, cwd=ROOT, stdout=full, stderr=subprocess.PIPE, timeout=patience.AN_AGE_S)
    assert (done.returncode, done.stderr) == (
        2,
        b"brdfguide: cannot write standard output: No space left on device\n",
    )
