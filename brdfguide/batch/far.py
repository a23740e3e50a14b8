"""Tasks done on a machine of a cluster: by processes of our own, which each of the cluster's threads keeps one of.

In the cluster's process they would take turns with its talk, its watching of itself every few milliseconds and its
other threads: a quarter to a half more processor time was measured. A process ends as soon as the one that it works for
has, and one that is ended takes no other task with it.
"""

import os
import pickle
import queue
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import IO, Any, NamedTuple

from .keys import engine
from .workers import Died

TRIES = 2  # of a task whose process ended
HERE = threading.local()  # the process of this thread


class Asker(NamedTuple):
    """Who hands out a batch."""

    folder: str  # where it runs: what relative names mean
    engine: str  # the fingerprint of its program, after which answers are named


class PartOfBatch(NamedTuple):
    """Some of a batch, done by one thread of the cluster, one after the other."""

    do: Callable[[Any], Any]
    tasks: Sequence[Any]
    asker: Asker


class OtherProgram(NamedTuple):
    """In place of a result: what is here would give another answer than the one that was asked for."""

    host: str
    engine: str


def asker() -> Asker:
    """This process."""
    return Asker(os.getcwd(), engine())


class _Process(NamedTuple):
    process: subprocess.Popen
    asked: IO[bytes]
    answers: IO[bytes]


def answer_part(part: PartOfBatch) -> list:
    """do(task) of each, or a Died, or an OtherProgram."""
    return [_asked(part.do, task, part.asker) for task in part.tasks]


def _asked(do: Callable[[Any], Any], task: Any, by: Asker) -> Any:
    result: Any = None
    for _ in range(TRIES):
        mine = getattr(HERE, "process", None) or _started()
        HERE.process = None  # until it has answered, it is none to go on with
        try:
            pickle.dump((do, task, by), mine.asked)
            mine.asked.flush()
            result = pickle.load(mine.answers)
        except (EOFError, OSError, pickle.UnpicklingError):
            result = Died(f"not done, twice: its process ended with status {_gone(mine)}", TRIES)
            continue
        if not isinstance(result, OtherProgram):
            HERE.process = mine
            return result
        _gone(mine)  # it may be older than what is on the disk now
    return result


def _gone(mine: _Process) -> int:
    """How it ended, or is ended now."""
    mine.process.kill()
    mine.answers.close()
    with suppress(OSError):  # of what it did not read
        mine.asked.close()
    return mine.process.wait()


def _started() -> _Process:
    begin = f"import sys; sys.path[:] = {sys.path!r}; from {__name__} import serve; serve()"
    process = subprocess.Popen([sys.executable, "-c", begin], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert process.stdin is not None and process.stdout is not None
    return _Process(process, process.stdin, process.stdout)


def serve() -> None:
    """In the other process: one task after the other from standard input, until that ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # who asked for this process ends it
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what is printed meanwhile is no answer
    mine = engine()  # of what is loaded here, now
    asked: queue.SimpleQueue = queue.SimpleQueue()
    threading.Thread(target=_read, args=(sys.stdin.buffer, asked), daemon=True).start()
    while True:
        do, task, by = asked.get()
        result: Any = OtherProgram(socket.gethostname(), mine)
        if by.engine == mine:
            result = _done(do, task, by.folder)
        pickle.dump(result, answers)
        answers.flush()


def _done(do: Callable[[Any], Any], task: Any, folder: str) -> Any:
    """do(task) where relative names are of that folder; where it is not, they are of none."""
    try:
        os.chdir(folder if os.path.isdir(folder) else os.path.abspath(os.sep))
        return do(task)
    except Exception as error:
        return Died(f"not done: its worker says {type(error).__name__}: {error}", 1)


def _read(stream: IO[bytes], asked: queue.SimpleQueue) -> None:
    """Ends this process with the stream, whatever it is doing, and with what it cannot understand."""
    try:
        while True:
            asked.put(pickle.load(stream))
    finally:
        os._exit(1)
