"""A dask cluster on this machine: every file is answered, also where a worker is killed."""

import os
import signal
import subprocess
import sys

import pytest

from brdfguide.batch.scheduler import by_scheduler
from brdfguide.batch.workers import Died, Done
from brdfguide.errors import EngineLost, InputError

from .. import patience
from ..conftest import ROOT
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
    words += ["--out", str(tmp_path / "d"), "--scheduler", address]
    command = [sys.executable, "-m", "brdfguide", *words]
    run = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    patience.until(lambda: kept(tmp_path / "d"), run)
    os.kill(pids[0], signal.SIGKILL)
    out, err = run.communicate(timeout=patience.AN_AGE_S)
    lines = out.splitlines()[1:]
    assert [line.split()[-1] for line in lines] == ["answered"] * 9 + ["input"], err
    assert run.returncode == 2 and "bad.csv" in err and len(kept(tmp_path / "d")) == 9


def double(number):
    return 2 * number


@pytest.mark.filterwarnings("default")
def test_tasks_come_back_by_their_numbers(cluster):
    tasks = [(number, Done("before") if number == 3 else number) for number in range(20)]
    found = dict(by_scheduler(double, iter(tasks), cluster[0]))
    assert found == {number: 2 * number for number in range(20)} | {3: "before"}


def fail(_):
    raise ZeroDivisionError("x")


@pytest.mark.filterwarnings("default")
def test_a_mistake_over_there_is_a_result(cluster):
    ((number, result),) = by_scheduler(fail, iter([(5, 0)]), cluster[0])
    assert number == 5 and isinstance(result, Died) and "ZeroDivisionError" in result.words


@pytest.mark.filterwarnings("default")
def test_nobody_there_and_no_address_are_sentences(monkeypatch):
    monkeypatch.setattr("brdfguide.batch.scheduler.WAITED_S", 0.5)
    with pytest.raises(EngineLost, match="tcp://127.0.0.1:9: nobody answers"):
        list(by_scheduler(double, iter([(0, 1)]), "tcp://127.0.0.1:9"))
    with pytest.raises(InputError, match="wanted an address such as"):
        list(by_scheduler(double, iter([(0, 1)]), "nonsense://x"))
