"""Tasks done by several processes. A process that ends takes its task with it and no other; with ours all of them end.

Each has one task at a time, and as much time and memory for it as it is given. None of them hears the keyboard: who
stops us stops them.
"""

import os
import signal
import threading
import time
from collections import deque
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from multiprocessing import get_context, parent_process, resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, NamedTuple

from .. import stopping
from ..errors import InputError
from .process import limit_data


class Limits(NamedTuple):
    """What a task may take; None: all that there is."""

    seconds: float | None = None
    memory_mb: float | None = None  # of data, the program's own included


UNLIMITED = Limits()


class Done(NamedTuple):
    """Among tasks: one that is done already, with its result."""

    result: Any


class Ended:
    """In place of a result: the process that had the task was ended before it was done."""

    def __init__(self, words: str, tries: int):
        self.words, self.tries = words, tries


class Died(Ended):
    """By somebody else, each time."""


class OverTime(Ended):
    """By us, since it took too long."""


class OverMemory(Ended):
    """By itself: there was not even the memory to say so in its own words."""


class _Worker(NamedTuple):
    process: BaseProcess
    line: Connection


class _Task(NamedTuple):
    number: int
    task: Any
    tries: int = 1
    until: float | None = None


def done(
    do: Callable[[Any], Any],
    tasks: Iterator[tuple[int, Any]],
    jobs: int,
    limits: Limits = UNLIMITED,
    retries: int = 1,
    tell: Callable[[int, int], None] = lambda number, tries: None,
) -> Generator[tuple[int, Any]]:
    """(number, do(task)) of each task as it is done, or an Ended. Closing it, or any exception, ends the processes.

    A task whose process died is tried again once the others are done, alone: they may only have been in its way. `tell`
    hears of each task that is begun, and which try it is.
    """
    return _Pool(do, tasks, jobs, limits, retries, tell).results()


class _Pool:
    """Processes, and who has which task."""

    def __init__(self, do, tasks, jobs: int, limits: Limits, retries: int, tell):
        self.do, self.tasks, self.jobs = do, tasks, jobs
        self.limits, self.retries, self.tell = limits, retries, tell
        self.again: deque[_Task] = deque()
        self.busy: dict[_Worker, _Task] = {}
        self.idle: list[_Worker] = []
        self.more = True  # whether `tasks` may hold another one

    def results(self) -> Generator[tuple[int, Any]]:
        try:
            while self.more or self.busy or self.again:
                while self._room() and (task := self._next()) is not None:
                    if isinstance(task.task, Done):
                        yield task.number, task.task.result
                    else:
                        self._hand(task)
                for worker in self._ready():
                    yield from self._heard(worker)
        finally:
            stopping.heard()  # or the next reminder would stop this in the middle
            _ended([*self.busy, *self.idle])

    def _room(self) -> bool:
        return len(self.busy) < self.jobs

    def _next(self) -> _Task | None:
        """The next task, if there is one now."""
        if self.more:
            number, task = next(self.tasks, (None, None))
            if number is not None:
                return _Task(number, task)
            self.more = False
        return self.again.popleft() if self.again and not self.busy else None

    def _hand(self, task: _Task) -> None:
        worker = self.idle.pop() if self.idle else _started(self.do, bool(self.busy), self.limits)
        if worker is None:  # no more can be had, and those that there are go on
            self.jobs = len(self.busy)
            self.again.append(task)
            return
        self.busy[worker] = task
        self.tell(task.number, task.tries)
        _sent(worker, task.task)

    def _ready(self) -> list[_Worker]:
        """Those that have something to say, never will, or have had their time."""
        if not self.busy:
            return []
        lines = {worker.line: worker for worker in self.busy}
        ends = [task.until for task in self.busy.values() if task.until is not None]
        found = wait(list(lines), max(0.0, min(ends) - time.monotonic()) if ends else None)
        over = [worker for worker, task in self.busy.items() if task.until and time.monotonic() >= task.until]
        told = [lines[line] for line in found]  # type: ignore[index]
        return [*told, *(worker for worker in over if worker not in told)]

    def _heard(self, worker: _Worker) -> Generator[tuple[int, Any]]:
        """What became of a task, if it has come to an end."""
        task = self.busy.pop(worker)
        if not worker.line.poll():
            _ended([worker])
            yield task.number, OverTime(f"not done within {self.limits.seconds:g} seconds", task.tries)
            return
        result = _received(worker)
        if isinstance(result, _Begun):
            until = None if self.limits.seconds is None else time.monotonic() + self.limits.seconds
            self.busy[worker] = task._replace(until=until)
        elif not isinstance(result, _Exit):
            self.idle.append(worker)
            yield task.number, result
        elif task.tries <= self.retries:
            self.again.append(task._replace(tries=task.tries + 1, until=None))
        else:
            often = {1: "", 2: ", twice"}.get(task.tries, f", {task.tries} times")
            yield task.number, Died(f"not done{often}: {result.words}", task.tries)


class _Begun(NamedTuple):
    """A process is at work on its task."""


class _Exit(NamedTuple):
    """How a process ended."""

    code: int | None

    @property
    def words(self) -> str:
        code = self.code or 0
        if code >= 0:
            return f"its process ended with status {code}"
        return f"its process was ended by signal {-code}" + (", perhaps for want of memory" if code == -9 else "")


def _started(do, others: bool, limits: Limits) -> _Worker | None:
    """One more process; None where there can be no more `others`. Raises InputError where there can be none at all."""
    context = get_context("spawn")
    try:
        ours, its = context.Pipe()
        with _deaf():
            process = context.Process(target=_serve, args=(do, its, limits.memory_mb), daemon=True)
            process.start()
        its.close()
    except OSError as error:
        if others:
            return None
        raise InputError(f"--jobs: no process can be started: {error.strerror or error}; --jobs 1 needs none") from None
    return _Worker(process, ours)


@contextmanager
def _deaf() -> Iterator[None]:
    """What is started inside never hears the keyboard; what we hear meanwhile we are told afterwards."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # it starts with the first process, and would let that one hear again
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _sent(worker: _Worker, task) -> None:
    try:
        worker.line.send(task)
    except OSError:  # it died before; `_received` says how
        return


def _received(worker: _Worker):
    try:
        return worker.line.recv()
    except (EOFError, OSError):
        worker.process.join()
        worker.line.close()
        return _Exit(worker.process.exitcode)


def _ended(workers: list[_Worker]) -> None:
    for worker in workers:
        worker.process.kill()
    for worker in workers:
        worker.process.join()
        worker.line.close()


def _serve(do, line: Connection, memory_mb: float | None) -> None:
    """In the other process: one task after the other, until ours is gone."""
    threading.Thread(target=_watch, daemon=True).start()
    wanting = OverMemory(f"not done within {memory_mb:g} MB" if memory_mb else "there is not enough memory", 1)
    if memory_mb is not None:
        limit_data(memory_mb)  # last: with less than the program itself takes no thread could begin
    while True:
        try:
            task = line.recv()
            line.send(_Begun())  # what came before, such as imports, is not the task's time
            result = do(task)
        except MemoryError:
            result = wanting
        except (EOFError, OSError):  # nobody is there to hear it
            return
        try:
            line.send(result)
        except OSError:
            return


def _watch() -> None:
    """Ends this process with the one that started it, whatever ended that."""
    parent = parent_process()
    if parent is not None:
        wait([parent.sentinel])
    os._exit(1)
