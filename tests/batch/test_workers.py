"""A process that dies takes its task with it and no other; with ours all of them end."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from contextlib import closing

import pytest

from brdfguide.batch import workers
from brdfguide.batch.workers import Limits
from brdfguide.errors import InputError

from .. import patience
from ..conftest import ROOT

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals as POSIX has them")


def double(number):
    return 2 * number


def double_or_die(number):
    if number == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return 2 * number


def die_once(path):
    if not os.path.exists(path):
        open(path, "w").close()
        os._exit(7)
    return "done"


def greedy(mb):
    try:
        return str(len(bytearray(mb * 2**20)) // 2**20)
    except MemoryError:
        return "MemoryError"


def greedy_without_words(mb):
    return str(len(bytearray(mb * 2**20)))


def sleep(path):
    open(path, "w").close()
    time.sleep(600)


def double_or_sleep(task):
    return sleep(task) if isinstance(task, str) else double(task)


def test_every_task_is_done_once():
    assert dict(workers.done(double, enumerate(range(7)), 2)) == {number: 2 * number for number in range(7)}


def test_a_task_that_kills_its_process_twice_is_told_and_the_others_are_done():
    found = dict(workers.done(double_or_die, enumerate(range(6)), 2))
    died = found.pop(3)
    assert found == {number: 2 * number for number in (0, 1, 2, 4, 5)}
    assert died.words == "not done, twice: its process was ended by signal 9, perhaps for want of memory"


def test_a_task_whose_process_died_once_is_done_by_another(tmp_path):
    assert dict(workers.done(die_once, enumerate([str(tmp_path / "mark"), str(tmp_path / "other")]), 2)) == {
        0: "done",
        1: "done",
    }


def test_a_task_that_takes_too_long_is_ended_and_the_others_are_done(tmp_path):
    files = [str(tmp_path / name) for name in "ab"]
    found = dict(workers.done(sleep, iter([(0, files[0]), (1, workers.Done("before")), (2, files[1])]), 2, Limits(0.5)))
    assert found[1] == "before"
    assert [found[number].words for number in (0, 2)] == ["not done within 0.5 seconds"] * 2


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems set no such limit")
def test_a_task_that_wants_more_memory_than_it_may_have_fails_in_its_own_process():
    found = dict(workers.done(greedy, iter([(0, 2000), (1, 1)]), 1, Limits(memory_mb=500)))
    assert found == {0: "MemoryError", 1: "1"}


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems set no such limit")
def test_less_memory_than_the_program_itself_takes_is_no_death():
    assert dict(workers.done(greedy, iter([(0, 20)]), 1, Limits(memory_mb=5))) == {0: "MemoryError"}


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="other systems set no such limit")
def test_too_little_memory_for_any_words_is_told_too():
    ((number, ended),) = workers.done(greedy_without_words, iter([(0, 20)]), 1, Limits(memory_mb=5))
    assert number == 0 and isinstance(ended, workers.OverMemory) and ended.words == "not done within 5 MB"
    assert dict(workers.done(double, iter([(0, 20)]), 1, Limits(memory_mb=1e300))) == {0: 40}


def test_leaving_early_ends_the_processes(tmp_path):
    files = [str(tmp_path / str(number)) for number in range(1000)]
    with closing(workers.done(double_or_sleep, enumerate([1, *files]), 2)) as answers:
        assert next(answers) == (0, 2)  # and the other one sleeps, for longer than the test may take
    assert len(list(tmp_path.iterdir())) < 1000 and not multiprocessing.active_children()


def test_no_process_at_all_is_a_sentence(monkeypatch):
    def none(*_, **__):
        raise OSError(24, "Too many open files")

    monkeypatch.setattr(workers, "get_context", lambda _: type("Context", (), {"Pipe": staticmethod(none)}))
    with pytest.raises(InputError, match="no process can be started: Too many open files; --jobs 1 needs none"):
        list(workers.done(double, iter([(0, 1)]), 2))


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_workers_end_with_their_parent(number, tmp_path):
    """Whatever ended it: they would hold its pipes, and whoever reads these would wait for ever."""
    script = "\n".join(
        (
            "from brdfguide.batch import workers",
            "from tests.batch.test_workers import sleep",
            f"list(workers.done(sleep, enumerate([{str(tmp_path / 'a')!r}, {str(tmp_path / 'b')!r}]), 2))",
        )
    )
    (tmp_path / "main.py").write_text(f'if __name__ == "__main__":\n    {script.replace(chr(10), chr(10) + "    ")}\n')
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    run = subprocess.Popen(
        [sys.executable, str(tmp_path / "main.py")], stdout=subprocess.PIPE, cwd=ROOT, env=environment
    )
    patience.until((tmp_path / "a").exists, run)
    patience.until((tmp_path / "b").exists, run)
    run.send_signal(number)
    # the pipe is closed once the last of them is gone, and they would sleep for longer
    assert run.communicate(timeout=patience.AN_AGE_S) == (b"", None)


def deaf_to_the_keyboard(_):
    return signal.SIGINT in signal.pthread_sigmask(signal.SIG_BLOCK, ())


def test_no_worker_hears_the_keyboard_the_first_one_neither():
    """In a process of its own: what multiprocessing starts with its first process lets signals through afterwards."""
    script = "\n".join(
        (
            "from brdfguide.batch import workers",
            "from tests.batch.test_workers import deaf_to_the_keyboard",
            "print(*dict(workers.done(deaf_to_the_keyboard, enumerate(range(4)), 2)).values())",
        )
    )
    run = subprocess.run([sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True)
    assert run.stdout.split() == ["True"] * 4
