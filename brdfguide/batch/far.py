"""Tasks done on a machine of a cluster: by processes of our own, which each of the cluster's threads keeps one of.

In the cluster's process they would take turns with its talk, its watching of itself every few milliseconds and its
other threads: a quarter to a half more processor time was measured. A process ends as soon as the one that it works for
has, and one that is ended takes no other task with it.
"""

import os
import pickle
import queue
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import IO, Any, NamedTuple

from .workers import Died

TRIES = 2  # of a task whose process ended
HERE = threading.local()  # the process of this thread


class PartOfBatch(NamedTuple):
    """Some of a batch, done by one thread of the cluster, one after the other."""

    do: Callable[[Any], Any]
    tasks: Sequence[Any]


class _Process(NamedTuple):
    process: subprocess.Popen
    asked: IO[bytes]
    answers: IO[bytes]


def answer_part(part: PartOfBatch) -> list:
    """do(task) of each, or a Died."""
    return [_asked(part.do, task) for task in part.tasks]


def _asked(do: Callable[[Any], Any], task: Any) -> Any:
    for _ in range(TRIES):
        mine = getattr(HERE, "process", None) or _started()
        HERE.process = None  # until it has answered, it is none to go on with
        try:
            pickle.dump((do, task), mine.asked)
            mine.asked.flush()
            result = pickle.load(mine.answers)
        except (EOFError, OSError, pickle.UnpicklingError):
            how = _gone(mine)
            continue
        HERE.process = mine
        return result
    return Died(f"not done, twice: its process ended with status {how}", TRIES)


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
    asked: queue.SimpleQueue = queue.SimpleQueue()
    threading.Thread(target=_read, args=(sys.stdin.buffer, asked), daemon=True).start()
    while True:
        do, task = asked.get()
        try:
            result = do(task)
        except Exception as error:
            result = Died(f"not done: its worker says {type(error).__name__}: {error}", 1)
        pickle.dump(result, answers)
        answers.flush()


def _read(stream: IO[bytes], asked: queue.SimpleQueue) -> None:
    """Ends this process with the stream, whatever it is doing."""
    with suppress(EOFError, OSError):
        while True:
            asked.put(pickle.load(stream))
    os._exit(1)
