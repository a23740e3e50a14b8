"""Tasks done by a cluster that dask.distributed runs: its workers may be killed, and others do what they had.

Small parts are handed out, not single tasks; what of a part was answered before its worker was killed is not answered
again, since `do` looks whether it is.
"""

import logging
import threading
import time
from collections.abc import Callable, Generator, Iterator
from itertools import islice
from typing import Any

from .. import printable
from ..errors import EngineLost, InputError
from .far import OtherProgram, PartOfBatch, answer_part, asker
from .keys import engine
from .workers import Died, Done

WAITED_S = 10.0  # for the scheduler
WORKERLESS_S = 600.0  # for a worker, which may wait in a queue of its own
LOOK_S = 5.0  # between two looks whether there is one
POLL_S = 0.02
UNDER_WAY = {"pending", "lost"}  # its worker ended before it told: the scheduler has it done again
PAUSES_S = (0.1, 0.5)  # between tries to connect where the library fails otherwise than for want of a scheduler
AHEAD = 3  # parts handed out for each of the cluster's threads
MOST = 4  # tasks of a part: to hand one over and back takes some 5 ms of processor time
EXTRA = "--scheduler needs dask.distributed: pip install 'brdfguide[farm]'"


def by_scheduler(
    do: Callable[[Any], Any],
    tasks: Iterator[tuple[int, Any]],
    address: str,
    of: int = 0,
    tell: Callable[[int, int], None] = lambda number, tries: None,
) -> Generator[tuple[int, Any]]:
    """(number, do(task)) of each of about `of` tasks as it is done, or a Died; `tell` hears of each that is handed out.

    Files, and the folder for answers, must have the same names on every machine. Raises InputError where the package is
    not there or the address is none, EngineLost where nobody answers, or no longer.
    """
    client, as_completed = _connected(address)
    by = asker()
    try:
        running = as_completed(loop=client.loop)
        numbers: dict[Any, list[int]] = {}
        left, more = of, True
        while more or numbers:
            threads = max(1, sum(client.nthreads().values()))
            while more and len(numbers) < AHEAD * threads:
                wanted = max(1, min(MOST, left // (AHEAD * threads)))
                taken = list(islice(tasks, wanted))
                more, left = len(taken) == wanted, left - len(taken)
                yield from ((number, task.result) for number, task in taken if isinstance(task, Done))
                part = {number: task for number, task in taken if not isinstance(task, Done)}
                if part:
                    for number in part:
                        tell(number, 1)
                    future = client.submit(answer_part, PartOfBatch(do, list(part.values()), by), pure=False)
                    numbers[future] = list(part)
                    running.add(future)
            if numbers:
                future = _next(running, client, address)
                if future.status in UNDER_WAY:
                    running.add(future)
                    continue
                yield from _results(future, numbers.pop(future), address)
    except (OSError, TimeoutError) as error:
        raise _lost(address, str(error)) from None
    finally:
        client.close(timeout=2)


def _connected(address: str):
    """A client, and what tells futures as they end."""
    try:
        from distributed import Client, as_completed
    except ImportError:
        raise InputError(EXTRA) from None
    # its traceback of a lost scheduler is our sentence
    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
    made: list = []

    def connect() -> None:
        for pause in (*PAUSES_S, None):
            try:
                made.append(Client(address, timeout=WAITED_S, set_as_default=False))
            except Exception as error:
                if pause is not None and not isinstance(error, (ValueError, TypeError, OSError)):
                    time.sleep(pause)
                    continue
                made.append(error)
            return

    connecting = threading.Thread(target=connect, daemon=True)
    connecting.start()
    connecting.join(WAITED_S + 2)  # what is no scheduler may take a greeting and never answer it
    if not made or isinstance(made[0], OSError):
        raise EngineLost(f"--scheduler {address}: no scheduler answers there within {WAITED_S:g} seconds")
    if isinstance(made[0], Exception):
        words = f"{printable.line(made[0]) or type(made[0]).__name__}; wanted an address such as tcp://127.0.0.1:8786"
        raise InputError(f"--scheduler {address}: {words}")
    return made[0], as_completed


def _next(running, client, address: str):
    """The part that ends next. Raises EngineLost where there is no worker for WORKERLESS_S."""
    seen = looked = time.monotonic()
    while not running.has_ready():
        time.sleep(POLL_S)
        if time.monotonic() - looked > LOOK_S:
            looked = time.monotonic()
            seen = looked if client.nthreads() else seen
            if looked - seen > WORKERLESS_S:
                raise _lost(address, f"it has had no worker for {WORKERLESS_S:g} seconds")
    return next(running)


def _results(future, numbers: list[int], address: str) -> Iterator[tuple[int, Any]]:
    """What became of a part."""
    if future.status == "finished":
        results = future.result()
        for other in results:
            if isinstance(other, OtherProgram):
                raise _unlike(address, f"found {other.engine[:12]} on {other.host}, wanted {engine()[:12]}")
        return zip(numbers, results, strict=True)
    if future.status == "error":
        error = future.exception()
        if type(error).__name__ == "KilledWorker":
            words = "every worker that had it was ended, perhaps for want of memory"
        elif isinstance(error, (OSError, MemoryError)):
            words = f"its worker says {type(error).__name__}: {error}"
        else:  # it cannot even be handed over
            raise _unlike(address, printable.line(f"{type(error).__name__}: {str(error).partition('. ')[0]}"))
        return ((number, Died(f"not done: {words}", 1)) for number in numbers)
    raise _lost(address, f"a task is {future.status}")


def _unlike(address: str, found: str) -> EngineLost:
    return EngineLost(
        f"--scheduler {address}: its machines have another brdfguide, or none ({found}); answers are named after the "
        "program that asks for them: install the same one on the scheduler and on every worker"
    )


def _lost(address: str, why: str) -> EngineLost:
    return EngineLost(f"--scheduler {address}: lost ({why}); answers so far are kept, and the same command goes on")
