"""Files, documents, names and options that no honest person makes, for as long as you like:

    python benchmarks/fuzz/run.py --minutes 60 --seed 1
    python benchmarks/fuzz/run.py --cases 60 --seed 1

The first tries what there is time for, the second the same cases on any machine, however long they take.

Every case is made from its target, the seed and its number alone, so that `--case table:1:4711` makes it again, says
how it ended with the whole traceback, and leaves its file in the current folder. A case may take 20 seconds of the
processor and 6 GB.
At the end: a line for each target, and each kind of failure once. Ends with status 1 where there was any.
"""

import argparse
import math
import multiprocessing
import os
import resource
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path
from random import Random

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):  # before NumPy is imported
    os.environ.setdefault(name, "1")
sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[2])]

import tries

HANG_S = 20.0  # of the processor, so that other work on the machine makes no hang
STUCK_S = 600.0  # of the clock, for a case that waits and does nothing
GLANCE_S = 1.0
MOST_BYTES = 6 * 2**30
UNLIMITED = 10**9  # cases
LONG = {"merl": 10}  # targets whose cases each take as long as so many others: 35 MB of table
COLUMNS = ("answered", "refused", "traceback", "warning", "unfit", "hang", "died")
HANG, DIED = "hang", "died"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, help="in all, shared by the targets; 5 where no --cases are given")
    parser.add_argument("--cases", type=int, help="of each target, at most; a tenth of merl's")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help=f"some of: {', '.join(tries.TARGETS)}")
    parser.add_argument("--case", help="one case again, as TARGET:SEED:NUMBER")
    asked = parser.parse_args()
    if asked.case:
        return again(*asked.case.split(":"))
    targets = asked.only.split(",") if asked.only else tries.TARGETS
    minutes = asked.minutes or (math.inf if asked.cases else 5.0)
    most = f"{asked.cases} cases" if asked.cases else f"{minutes:g} minutes"
    print(f"seed {asked.seed}, {most}, {HANG_S:g} s and {MOST_BYTES // 2**30} GB a case", flush=True)
    head = f"{'target':16}{'cases':>8}" + "".join(f"{each:>11}" for each in COLUMNS) + f"{'peak MB':>9}{'s':>7}"
    print(head, flush=True)
    failures: dict[str, str] = {}
    for target in targets:
        share = 60 * minutes / len(targets)
        counts, peak, seconds, wrong = tried(target, asked.seed, share, _cases(target, asked.cases))
        cells = "".join(f"{counts[each]:11}" for each in COLUMNS)
        print(f"{target:16}{sum(counts.values()):8}{cells}{peak:9.0f}{seconds:7.0f}", flush=True)
        failures |= wrong
    for kind, first in failures.items():
        print(f"{kind}\n    first: --case {first}")
    return int(bool(failures))


def _cases(target: str, most: int | None) -> int:
    return UNLIMITED if most is None else -(-most // LONG.get(target, 1))


def tried(
    target: str, seed: int, seconds: float, most: int = UNLIMITED
) -> tuple[dict[str, int], float, float, dict[str, str]]:
    """As many cases of a target as there is time for: how they ended, the peak of memory [MB], and the failures."""
    counts, failures, peak = dict.fromkeys(COLUMNS, 0), {}, 0.0
    begun, index = time.monotonic(), 0
    while time.monotonic() - begun < seconds and index < most:
        worker = Worker(target, seed, index, seconds - (time.monotonic() - begun), most)
        for number, outcome, detail, megabytes in worker.outcomes():
            counts[outcome] += 1
            peak = max(peak, megabytes)
            if outcome not in ("answered", "refused"):
                failures.setdefault(f"{target}: {outcome}: {detail}", f"{target}:{seed}:{number}")
            index = number + 1
    return counts, peak, time.monotonic() - begun, failures


class Worker:
    """A process that does one case after the other until its time is over, or it hangs or dies."""

    def __init__(self, target: str, seed: int, first: int, seconds: float, most: int):
        self.first = first
        self.ours, its = multiprocessing.Pipe(duplex=False)
        context = multiprocessing.get_context("fork")
        self.process = context.Process(target=work, args=(its, target, seed, first, seconds, most), daemon=True)
        self.process.start()
        its.close()

    def outcomes(self):
        """(number, outcome, detail, peak MB) as they come."""
        number, peak = self.first, 0.0
        while True:
            if not self.comes():
                self.process.kill()
                self.process.join()
                yield number, HANG, f"more than {HANG_S:g} s", peak
                return
            try:
                number, outcome, detail, peak = self.ours.recv()
            except EOFError:
                self.process.join()
                if self.process.exitcode:
                    yield number, DIED, f"exit code {self.process.exitcode}", peak
                return
            yield number, outcome, detail, peak
            number += 1

    def comes(self) -> bool:
        """Whether the next outcome comes before its case has used up its time."""
        until, begun = time.monotonic() + STUCK_S, processor_s(self.process.pid)
        while not self.ours.poll(GLANCE_S):
            if time.monotonic() > until or processor_s(self.process.pid) - begun > HANG_S:
                return self.ours.poll(0)
        return True


def processor_s(pid: int) -> float:
    """Processor time [s] that a process has used."""
    fields = Path("/proc", str(pid), "stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def work(line, target: str, seed: int, first: int, seconds: float, most: int) -> None:
    """In the other process."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    os.environ["BRDFGUIDE_FUZZ"] = "1"
    with tempfile.TemporaryDirectory() as folder, open(os.devnull) as nothing:
        os.chdir(folder)
        sys.stdin = nothing
        tries.furnished(Path(folder))
        until, index = time.monotonic() + seconds, first
        while time.monotonic() < until and index < most:
            found = tries.case(target, seed, index)
            peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
            line.send((index, found.outcome, found.detail, peak))
            index += 1
        os.chdir("/")


def again(target: str, seed: str, index: str) -> int:
    """One case once more, with its traceback."""
    tries.furnished(Path())
    found = tries.case(target, int(seed), int(index))
    print(found.outcome, found.detail)
    warnings.simplefilter("error")
    try:
        tries.tried(target, Random(f"{target}:{seed}:{index}"), int(index))
    except Exception:
        traceback.print_exc()
    return int(found.outcome not in ("answered", "refused"))


if __name__ == "__main__":
    sys.exit(main())
