"""What a dask cluster costs: processor time of the whole, against the same files answered in one process.

    python benchmarks/farm.py [FILES] [WORKERS] [SEED]           300, 2 and 2026 where none is said

Scans thinned from examples/*.csv (every 2nd to 4th line), with 1 to 5 % noise. Of the cluster counts what its
processes, scheduler, workers and the processes that these keep for files, take between the command's beginning and its
end. What a cluster takes anyway is what another one takes in that time, of which nothing is asked. The workers have
answered files before, so that starting Python and importing NumPy is the cluster's own affair.
"""

import os
import subprocess
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples"
NAMES = ("white_paper", "rough_plastic", "rough_aluminium", "metallic_paint", "smooth_steel")
TICK = os.sysconf("SC_CLK_TCK")
CLUSTER = """
import sys
from distributed import LocalCluster
if __name__ == "__main__":
    workers = int(sys.argv[1])
    with LocalCluster(n_workers=workers, threads_per_worker=1, host="127.0.0.1", dashboard_address=None) as cluster:
        print(cluster.scheduler_address, flush=True)
        sys.stdin.read()
"""


def made(folder: Path, count: int, seed: int) -> list[Path]:
    """So many scans, each with a thinning and noise of its own."""
    files = []
    for number in range(count):
        draw = np.random.default_rng(seed + number)
        lines = (EXAMPLES / f"{NAMES[number % len(NAMES)]}.csv").read_text().splitlines()
        head = next(place for place, line in enumerate(lines) if not line.startswith("#"))
        values = [place for place, name in enumerate(lines[head].split(",")) if name.startswith("brdf")]
        every, noise = int(draw.integers(2, 5)), draw.uniform(0.01, 0.05)
        rows = [line.split(",") for line in lines[head + 1 :][int(draw.integers(every)) :: every]]
        for row in rows:
            for place in values:
                row[place] = f"{float(row[place]) * np.exp(noise * draw.standard_normal()):.6g}"
        files.append(folder / f"{number:05d}.csv")
        files[-1].write_text("\n".join([*lines[: head + 1], *map(",".join, rows)]) + "\n")
    return files


def spent(pid: int) -> dict[str, float]:
    """Seconds of processor time so far of a cluster's process, of its workers and of theirs."""
    found, each = {}, {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            fields = stat.read_text().rpartition(")")[2].split()
            each[int(stat.parent.name)] = int(fields[1]), (int(fields[11]) + int(fields[12])) / TICK
    generation = {pid}
    for name in ("scheduler", "workers", "files"):
        found[name] = sum(each[one][1] for one in generation)
        generation = {one for one, (parent, _) in each.items() if parent in generation}
    return found


def command(files: list[Path], out: Path, *engine: str) -> float:
    """Processor time of a batch, itself and what it started."""
    words = ["fit", "--files-from", "-", "--no-timing", "-q", "--out", str(out), *engine]
    run = subprocess.Popen(
        [sys.executable, "-m", "brdfguide", *words], cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL
    )
    run.stdin.write("".join(f"{file}\n" for file in files).encode())
    run.stdin.close()
    _, status, usage = os.wait4(run.pid, 0)
    run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode > 1:
        raise SystemExit(f"status {run.returncode}")
    return usage.ru_utime + usage.ru_stime


def cluster(folder: Path, workers: int) -> tuple[subprocess.Popen, str]:
    """One that stands, and its address."""
    script = folder / "cluster.py"
    script.write_text(CLUSTER)
    run = subprocess.Popen(
        [sys.executable, str(script), str(workers)],
        cwd=folder, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    )  # fmt: skip
    return run, run.stdout.readline().strip()


def main(count: int = 300, workers: int = 2, seed: int = 2026) -> None:
    os.environ |= {"PYTHONPATH": str(ROOT), "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "warm").mkdir()
        files, warm = made(folder, count, seed), made(folder / "warm", 6 * workers, seed + 10**6)
        alone = command(files, folder / "alone", "--jobs", "1")
        print(f"{count} files, {sum(file.stat().st_size for file in files) / 1e6:.1f} MB: --jobs 1 {alone:.1f} s")
        (asked, address), (idle, _) = cluster(folder, workers), cluster(folder, workers)
        command(warm, folder / "warm-fits", "--scheduler", address)
        before, stood = spent(asked.pid), sum(spent(idle.pid).values())
        far = {"command": command(files, folder / "far", "--scheduler", address)}
        standing = sum(spent(idle.pid).values()) - stood
        far |= {part: seconds - before[part] for part, seconds in spent(asked.pid).items()}
        whole = sum(far.values())
        print(f"a cluster of {workers}:", ", ".join(f"{part} {seconds:.1f} s" for part, seconds in far.items()))
        print(f"together {whole:.1f} s, {whole / alone - 1:+.1%}", end="; ")
        print(f"without what it takes anyway, {standing:.1f} s, {(whole - standing) / alone - 1:+.1%}", flush=True)
        for each in (asked, idle):
            each.stdin.close()
            each.wait()


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
