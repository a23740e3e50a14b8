"""What the laws cost on this machine, and error against run time where there are data to be wrong about."""

import os
import platform
import time
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

import numpy as np

from ..models import cost
from ..physics.geometry import Geometry, rows
from ..records import dataclass

SIZES = (1, 1_000, 1_000_000)
REPEATS = 7
SHORTEST = 2e-3  # s: fewer samples are evaluated again until a turn lasts as long
BLOCK = 16384  # rows whose arrays stay in the processor's cache
SEED = 9


@dataclass(frozen=True)
class TimingRow:
    """Time per sample of one law at one number of samples [ns], over interleaved repeats."""

    name: str
    n: int
    least: float
    median: float


def timings(
    evaluators: Mapping[str, Callable],
    sizes=SIZES,
    repeats: int = REPEATS,
    tell: Callable[[str], None] = lambda what: None,
) -> list[TimingRow]:
    """Every law at every size, taking turns. Takes laws(geom) -> array.

    Thread processor time, one thread, double precision. The directions are kept from turn to turn, as in a fit, where
    only parameters change: what a law forms from directions alone is paid for once and not counted.
    """
    found = []
    for n in sizes:
        tell(f"{n} samples")
        blocks = [block for _, block in timed_pairs(n).blocks(BLOCK)]
        turns = {name: _turns(evaluator, blocks) for name, evaluator in evaluators.items()}
        several = {name: partial(_over_blocks, evaluator, turns[name]) for name, evaluator in evaluators.items()}
        for name, ns in cost.interleaved(several, partial(list, blocks), repeats).items():
            each = np.array(ns) / (turns[name] * n)
            found.append(TimingRow(name, n, float(each.min()), float(np.median(each))))
    return found


def _over_blocks(evaluator: Callable, turns: int, blocks) -> None:
    for _ in range(turns):
        for block in blocks:
            evaluator(block)


def timed_pairs(n: int) -> Geometry:
    """Random pairs over the hemisphere, seed 9."""
    rng = np.random.default_rng(SEED)
    return rows(Geometry.from_degrees(rng.uniform(1, 89, n), 0.0, rng.uniform(1, 89, n), rng.uniform(0, 360, n)))


def _turns(evaluator: Callable, blocks) -> int:
    """How often a turn goes over the blocks; the first time, which forms what is kept, does not count."""
    for block in blocks:
        evaluator(block)
    began = time.thread_time()
    evaluator(blocks[0])
    return max(1, int(SHORTEST / max((time.thread_time() - began) * len(blocks), 1e-7)))


def operations_per_sample(evaluator: Callable) -> dict[str, float]:
    """Operations per sample with the directions kept, by kind: what a second evaluation adds to a first."""
    geom = timed_pairs(512)
    once, twice = cost.operations(evaluator, geom), cost.operations(lambda g: (evaluator(g), evaluator(g)), geom)
    return {kind: twice[kind] - once[kind] for kind in once}


def machine() -> dict:
    """What the times were measured on."""
    return {
        "processor": _processor(),
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "precision": "float64",
        "threads": 1,
        "clock": "thread processor time",
    }


def _processor() -> str:
    info = Path("/proc/cpuinfo")
    names = (
        [line.partition(":")[2].strip() for line in info.read_text().splitlines() if line.startswith("model name")]
        if info.is_file()
        else []
    )
    return names[0] if names else platform.processor() or platform.machine()
