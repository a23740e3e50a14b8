"""Tasks done by a cluster that dask.distributed runs: its workers may be killed, and others do what they had."""

from collections.abc import Callable, Generator, Iterator
from typing import Any

from ..errors import EngineLost, InputError
from .workers import Died, Done

WAITED_S = 10.0  # for the scheduler
AHEAD = 4  # tasks handed out for each of the cluster's threads
EXTRA = "--scheduler needs dask.distributed: pip install 'brdfguide[farm]'"


def by_scheduler(
    do: Callable[[Any], Any],
    tasks: Iterator[tuple[int, Any]],
    address: str,
    tell: Callable[[int, int], None] = lambda number, tries: None,
) -> Generator[tuple[int, Any]]:
    """(number, do(task)) of each task as it is done, or a Died; `tell` hears of each that is handed out.

    Files, and the folder for answers, must have the same names on every machine. Raises InputError where the package is
    not there or the address is none, EngineLost where nobody answers, or no longer.
    """
    client, as_completed = _connected(address)
    try:
        running = as_completed(loop=client.loop)
        numbers: dict[Any, int] = {}
        more = True
        while more or numbers:
            while more and len(numbers) < AHEAD * max(1, sum(client.nthreads().values())):
                number, task = next(tasks, (None, None))
                if number is None:
                    more = False
                elif isinstance(task, Done):
                    yield number, task.result
                else:
                    tell(number, 1)
                    future = client.submit(do, task, pure=False)
                    numbers[future] = number
                    running.add(future)
            if numbers:
                future = next(running)
                yield numbers.pop(future), _result(future, client, address)
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
    try:
        return Client(address, timeout=WAITED_S, set_as_default=False), as_completed
    except ValueError as error:
        raise InputError(f"--scheduler {address}: {error}; wanted an address such as tcp://127.0.0.1:8786") from None
    except (OSError, TimeoutError):
        raise EngineLost(f"--scheduler {address}: nobody answers there within {WAITED_S:g} seconds") from None


def _result(future, client, address: str):
    """What became of a task."""
    if future.status == "finished":
        return future.result()
    if future.status == "error":
        error = future.exception()
        if type(error).__name__ == "KilledWorker":
            return Died("not done: every worker that had it was ended, perhaps for want of memory", 1)
        return Died(f"not done: its worker says {type(error).__name__}: {error}", 1)
    raise _lost(address, f"a task is {future.status}")


def _lost(address: str, why: str) -> EngineLost:
    return EngineLost(f"--scheduler {address}: lost ({why}); answers so far are kept, and the same command goes on")
