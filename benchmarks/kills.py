"""What a killed worker costs: files answered and files begun again, with processes of our own and on a dask cluster.

    python benchmarks/kills.py FILES SEED...           such as 300 1 2 3 4 5 6 7 8 9 10

Made scans of a paper, one model; the seed says when, as a share of the answers, and which worker is killed (SIGKILL).
A file is begun again where it was started twice: `--events` tells it of our own processes, and those that do the files
on a cluster tell it themselves, each in a file of the folder of answers.
"""

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAPER = ROOT / "examples" / "white_paper.csv"
CLUSTER = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    with LocalCluster(n_workers=2, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
        print(cluster.scheduler_address, *(nanny.process.pid for nanny in cluster.workers.values()), flush=True)
        sys.stdin.read()
"""


def made(folder: Path, count: int) -> list[Path]:
    """So many scans, each with values of its own."""
    lines = PAPER.read_text().splitlines()
    head = next(place for place, line in enumerate(lines) if not line.startswith("#")) + 1
    rows, files = [line.split(",") for line in lines[head:]], []
    column = lines[head - 1].split(",").index("brdf")
    for number in range(count):
        draw = random.Random(number)
        each = [
            [*row[:column], f"{float(row[column]) * draw.uniform(0.97, 1.03):.6g}", *row[column + 1 :]] for row in rows
        ]
        files.append(folder / f"{number:05d}.csv")
        files[-1].write_text("\n".join([*lines[:head], *map(",".join, each)]) + "\n")
    return files


def children(pid: int) -> list[int]:
    """Processes that do the work of another: its children that have our command in them."""
    found = subprocess.run(["ps", "-o", "pid=,args=", "--ppid", str(pid)], capture_output=True, text=True).stdout
    return [int(line.split()[0]) for line in found.splitlines() if "spawn_main" in line]


def one(files: list[Path], seed: int, engine: list[str], workers) -> str:
    """A run with one kill: a line on what came of it. `workers(pid)` gives the processes that may be killed."""
    draw = random.Random(seed)
    with tempfile.TemporaryDirectory() as name:
        fits, events = Path(name) / "fits", Path(name) / "events"
        words = ["fit", "--files-from", "-", "-m", "lambertian", "--no-timing", "-q", "--out", str(fits)]
        run = subprocess.Popen(
            [sys.executable, "-m", "brdfguide", *words, "--events", str(events), *engine],
            cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        )  # fmt: skip
        run.stdin.write("\n".join(map(str, files)) + "\n")
        run.stdin.close()
        when = draw.randrange(1, len(files) - 1)
        while len(list(fits.glob("answers/*/*.json"))) < when and run.poll() is None:
            time.sleep(0.01)
        victim = draw.choice(workers(run.pid))
        os.kill(victim, signal.SIGKILL)
        rows = run.stdout.read().splitlines()[1:]
        run.wait()
        tales = list((fits / "events").glob("*.jsonl")) or [events]  # of those that did the files
        told = [json.loads(line) for tale in tales for line in tale.read_text().splitlines()]
        started = [each["file"] for each in told if each["state"] == "started"]
        answered = sum(row.rstrip().endswith("answered") for row in rows)
        return (
            f"seed {seed}: killed after {when} answers: {answered} of {len(files)} answered, begun again: "
            f"{len(started) - len(set(started))}, exit {run.returncode}"
        )


def main(count: int, seeds: list[int]) -> None:
    with tempfile.TemporaryDirectory() as name:
        files = made(Path(name), count)
        for seed in seeds:
            print("--jobs 2,  ", one(files, seed, ["--jobs", "2"], children), flush=True)
        script = Path(name) / "cluster.py"
        script.write_text(CLUSTER)
        for seed in seeds:  # a cluster of its own for each, so that two workers are there
            environment = {**os.environ, "PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1"}
            cluster = subprocess.Popen(
                [sys.executable, str(script)],
                cwd=name, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                text=True,
            )  # fmt: skip
            address, *pids = cluster.stdout.readline().split()
            print(
                "a cluster, ",
                one(files, seed, ["--scheduler", address], lambda _, of=pids: list(map(int, of))),
                flush=True,
            )
            cluster.stdin.close()
            cluster.wait()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", type=int, help="how many")
    parser.add_argument("seeds", type=int, nargs="+")
    asked = parser.parse_args()
    main(asked.files, asked.seeds)
