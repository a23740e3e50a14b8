"""Bounds of time that a loaded or a slower machine does not break: processor time, in units of the machine's speed now.

A bound is stated for a machine at rest, on which `_effort` takes EFFORT_S. What is measured is divided by how much
slower the machine is just before and after, and the quickest of a few tries counts.
"""

import os
import resource
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

EFFORT_S = 0.0118  # of `_effort`, the quickest of thirty on the machine that the bounds were set on
TRIES = 8
AN_AGE_S = 300  # until which a test waits for what comes at once on a machine at rest


def _effort() -> float:
    """Processor time [s] of a fixed piece of work, half of it Python's and half of it NumPy's."""
    begun, total = time.process_time(), 0
    for number in range(100_000):
        total += number * number % 7
    values = np.linspace(0.1, 1, 2000)
    for _ in range(300):
        values = np.exp(-values * values) + 0.5
    return time.process_time() - begun


def _used() -> float:
    """Processor time [s] of this process and of the children that it has waited for."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def spent(do: Callable[[], object]) -> float:
    """Processor time [s] of `do()` and of the processes that it starts and waits for."""
    begun = _used()
    do()
    return _used() - begun


def takes_less_than(seconds: float, do: Callable[[], object]) -> bool:
    """Whether `do()` takes less processor time than that, with the processes that it starts and waits for."""
    for _ in range(TRIES):
        before, took, after = _effort(), spent(do), _effort()
        if took < seconds * max(1.0, before / EFFORT_S, after / EFFORT_S):
            return True
    return False


def until(happened: Callable[[], object], run: subprocess.Popen) -> None:
    """Waits for what a running process brings about. Fails where the process ends before."""
    end = time.monotonic() + AN_AGE_S
    while not happened():
        assert time.monotonic() < end and run.poll() is None
        time.sleep(0.02)


def listens(run: subprocess.Popen, number: int = signal.SIGTERM) -> bool:
    """Whether a process has a handler of its own for a signal, by the kernel's word."""
    status = Path("/proc", str(run.pid), "status").read_text()
    caught = next(line.split()[1] for line in status.splitlines() if line.startswith("SigCgt"))
    return bool(int(caught, 16) >> (number - 1) & 1)


def processor_s(pid: int) -> float:
    """Processor time [s] that a running process has used."""
    fields = Path("/proc", str(pid), "stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
