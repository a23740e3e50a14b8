"""A signal ends the program also where what its handler raises is lost."""

import os
import signal
import subprocess
import sys

import pytest

from .conftest import ROOT

pytestmark = pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timer to raise it again")

LOST = """
import os, signal, sys, time
from brdfguide import stopping
from brdfguide.errors import Stopped

class Deaf:
    def __del__(self):
        os.kill(os.getpid(), signal.SIG{name})

stopping.listen()
begun = time.monotonic()
try:
    Deaf()  # what the handler raises is lost in here
    while time.monotonic() - begun < 60:
        time.sleep(0.01)
    sys.exit("never heard")
except Stopped as end:
    stopping.heard()
    time.sleep(0.7)  # in peace
    sys.exit(end.code)
"""


@pytest.mark.parametrize("name", ["INT", "TERM"])
def test_a_signal_whose_exception_is_lost_is_raised_again_until_it_is_heard(name):
    words = [sys.executable, "-c", LOST.format(name=name)]
    done = subprocess.run(words, capture_output=True, timeout=300, env={**os.environ, "PYTHONPATH": str(ROOT)})
    assert done.returncode == 128 + getattr(signal, f"SIG{name}"), done.stderr
