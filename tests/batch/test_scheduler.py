"""A dask cluster on this machine: every file is answered, also where a worker is killed."""

import json
import os
import signal
import socket
import subprocess
import sys
import time

import pytest

from brdfguide.batch import far
from brdfguide.batch.scheduler import by_scheduler
from brdfguide.batch.workers import Died, Done
from brdfguide.errors import EngineLost, InputError

from .. import patience
from ..conftest import ROOT
from . import far_tasks
from .test_run import kept, some

pytest.importorskip("distributed")
pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals as POSIX has them")
CLUSTER = """
import json, sys
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
        print(cluster.scheduler_address, *(nanny.process.pid for nanny in cluster.workers.values()), flush=True)
        sys.stdin.read()
"""


MAIN = "from brdfguide.cli import main; main()"


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """(address, numbers of the workers' processes)."""
    folder = tmp_path_factory.mktemp("cluster")
    (folder / "cluster.py").write_text(CLUSTER)
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
    run = subprocess.Popen(
        [sys.executable, str(folder / "cluster.py")],
        cwd=folder,
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    address, *pids = run.stdout.readline().split()
    yield address, [int(pid) for pid in pids]
    run.stdin.close()
    run.wait(timeout=patience.AN_AGE_S)
    run.stdout.close()


@pytest.mark.filterwarnings("default")
def test_every_file_is_answered_though_a_worker_is_killed(cluster, tmp_path):
    address, pids = cluster
    files = [some(tmp_path, f"{part}.csv", part) for part in range(9)]
    (tmp_path / "bad.csv").write_text("theta_i,theta_r,brdf\n10,x,0.1\n")
    words = ["fit", *map(str, files), str(tmp_path / "bad.csv"), "-m", "lambertian+ggx", "--no-timing"]
    words += ["--out", str(tmp_path / "d"), "--scheduler", address, "--events", str(tmp_path / "events")]
    command = [sys.executable, "-m", "brdfguide", *words]
    run = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    patience.until(lambda: kept(tmp_path / "d"), run)
    os.kill(pids[0], signal.SIGKILL)
    out, err = run.communicate(timeout=patience.AN_AGE_S)
    lines = out.splitlines()[1:]
    assert [line.split()[-1] for line in lines] == ["answered"] * 9 + ["input"], err
    assert run.returncode == 2 and "bad.csv" in err and len(kept(tmp_path / "d")) == 9
    told = [line for tale in (tmp_path / "d" / "events").glob("*.jsonl") for line in tale.read_text().splitlines()]
    begun = [json.loads(line)["file"] for line in told]
    assert len(set(begun)) == 10 and len(begun) <= 11  # at most the one that was under way


@pytest.mark.filterwarnings("default")
def test_tasks_come_back_by_their_numbers(cluster):
    tasks = [(number, Done("before") if number == 3 else number) for number in range(20)]
    found = dict(by_scheduler(far_tasks.double, iter(tasks), cluster[0]))
    assert found == {number: 2 * number for number in range(20)} | {3: "before"}


@pytest.mark.filterwarnings("default")
def test_a_mistake_over_there_is_a_result(cluster):
    ((number, result),) = by_scheduler(far_tasks.fail, iter([(5, 0)]), cluster[0])
    assert number == 5 and isinstance(result, Died) and "ZeroDivisionError" in result.words


@pytest.mark.filterwarnings("default")
def test_nobody_there_and_no_address_are_sentences(monkeypatch):
    monkeypatch.setattr("brdfguide.batch.scheduler.WAITED_S", 0.5)
    with pytest.raises(EngineLost, match="tcp://127.0.0.1:9: no scheduler answers"):
        list(by_scheduler(far_tasks.double, iter([(0, 1)]), "tcp://127.0.0.1:9"))
    with pytest.raises(InputError, match="wanted an address such as"):
        list(by_scheduler(far_tasks.double, iter([(0, 1)]), "nonsense://x"))
    with pytest.raises(InputError, match="TLS expects .* wanted an address such as"):
        list(by_scheduler(far_tasks.double, iter([(0, 1)]), "tls://127.0.0.1:9"))


@pytest.mark.filterwarnings("default")
def test_a_port_where_something_else_listens_is_a_sentence():
    with socket.create_server(("127.0.0.1", 0)) as other:  # takes a greeting and never answers it
        address = f"tcp://127.0.0.1:{other.getsockname()[1]}"
        words = ["fit", "examples/white_paper.csv", "-m", "lambertian", "--scheduler", address]
        run = [sys.executable, "-c", f"import brdfguide.batch.scheduler as s; s.WAITED_S = 0.5; {MAIN}", *words]
        done = subprocess.run(run, cwd=ROOT, capture_output=True, text=True, timeout=patience.AN_AGE_S)
    assert done.returncode == 3 and f"{address}: no scheduler answers there" in done.stderr, done.stderr


def test_an_empty_address_is_not_passed_over():
    words = ["fit", "examples/white_paper.csv", "-m", "lambertian", "--scheduler", ""]
    done = subprocess.run([sys.executable, "-m", "brdfguide", *words], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 2 and "--scheduler '': wanted something" in done.stderr


@pytest.fixture
def own_process():
    """What a thread of the cluster keeps is ended with the test."""
    yield
    kept_one = getattr(far.HERE, "process", None)
    if kept_one is not None:
        far.HERE.process = None
        for stream in (kept_one.asked, kept_one.answers):
            stream.close()
        kept_one.process.wait(timeout=patience.AN_AGE_S)


def test_a_file_whose_process_was_ended_is_tried_once_more(tmp_path, own_process):
    one, other = far.answer_part(far.PartOfBatch(far_tasks.ended_once, [tmp_path / "one"] * 2, far.asker()))
    assert one == other != os.getpid()  # and the process goes on with the next
    (died,) = far.answer_part(far.PartOfBatch(far_tasks.ended, [0], far.asker()))
    assert isinstance(died, Died) and died.words == "not done, twice: its process ended with status 3"


def test_what_would_be_answered_by_another_program_is_not(cluster, own_process, monkeypatch):
    """Answers are named after the program that asks, so that one of another would be served as its own."""
    other = far.asker()._replace(engine="0" * 64)
    (found,) = far.answer_part(far.PartOfBatch(far_tasks.double, [2], other))
    assert isinstance(found, far.OtherProgram) and found.engine == far.asker().engine
    assert far.answer_part(far.PartOfBatch(far_tasks.double, [2], far.asker())) == [4]
    monkeypatch.setattr("brdfguide.batch.scheduler.asker", lambda: other)
    with pytest.raises(EngineLost, match="another brdfguide, or none .*install the same one"):
        list(by_scheduler(far_tasks.double, iter([(0, 1)]), cluster[0]))


WITHOUT_WORKERS = CLUSTER.replace("n_workers=2", "n_workers=0")


@pytest.mark.filterwarnings("default")
def test_a_cluster_without_a_worker_is_not_waited_for_for_ever(tmp_path, monkeypatch):
    (tmp_path / "cluster.py").write_text(WITHOUT_WORKERS)
    command, environment = [sys.executable, str(tmp_path / "cluster.py")], {**os.environ, "PYTHONPATH": str(ROOT)}
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    run = subprocess.Popen(command, env=environment, text=True, **pipes)
    monkeypatch.setattr("brdfguide.batch.scheduler.WORKERLESS_S", 0.2)
    monkeypatch.setattr("brdfguide.batch.scheduler.LOOK_S", 0.1)
    with pytest.raises(EngineLost, match="it has had no worker for 0.2 seconds"):
        list(by_scheduler(far_tasks.double, iter([(0, 1)]), run.stdout.readline().strip()))
    run.stdin.close()
    run.wait(timeout=patience.AN_AGE_S)
    run.stdout.close()


def test_relative_names_are_of_where_the_command_was_given(tmp_path, own_process):
    here = os.getcwd()
    for folder, wanted in ((str(tmp_path), str(tmp_path)), (str(tmp_path / "none"), os.path.abspath(os.sep))):
        part = far.PartOfBatch(far_tasks.folder, [0], far.asker()._replace(folder=folder))
        assert far.answer_part(part) == [wanted] and os.getcwd() == here


ASKING = """
import sys
from pathlib import Path
from brdfguide.batch import far
from tests.batch import far_tasks
if __name__ == "__main__":
    far.answer_part(far.PartOfBatch(far_tasks.asleep, [Path(sys.argv[1])], far.asker()))
"""


def test_a_process_ends_with_the_one_that_it_works_for(tmp_path):
    run = subprocess.Popen([sys.executable, "-c", ASKING, str(tmp_path / "pid")], cwd=ROOT)
    patience.until((tmp_path / "pid").exists, run)
    number = int((tmp_path / "pid").read_text())
    run.kill()
    run.wait()
    end = time.monotonic() + patience.AN_AGE_S
    while is_there(number) and time.monotonic() < end:
        time.sleep(0.01)
    assert not is_there(number)


def is_there(number: int) -> bool:
    """Whether a process runs; one that ended and that nobody waited for does not."""
    found = subprocess.run(["ps", "-o", "stat=", "-p", str(number)], capture_output=True, text=True, check=False)
    return found.stdout.strip() not in ("", "Z")
