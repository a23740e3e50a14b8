"""200 surfaces, each fitted twice from two noisy halves of one measurement: does `search --like` find the twin first,
and does `--alike` pair twins and no strangers?

    python benchmarks/twins.py [surfaces] [seed]
"""

import os
import sys
import tempfile

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

from pathlib import Path

import numpy as np

from brdfguide.batch import collected, conditions, searching
from brdfguide.batch.run import Task, run_tasks
from brdfguide.batch.store import store_at
from brdfguide.batch.work import FitWork
from brdfguide.data import formats
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import saved
from brdfguide.fitting.job import Job
from brdfguide.models.surface import Surface
from brdfguide.physics.colour import CHANNEL_UM
from brdfguide.physics.geometry import rows, signed

NOISE = 0.03
UM = np.array([CHANNEL_UM[name] for name in "RGB"])
WORK = FitWork(job=Job(models=("lambertian+ggx", "lambertian+beckmann", "ggx"), timing=False))


def halves(draw, folder: Path, number: int) -> list[Path]:
    """A dielectric or a metal of any lightness and roughness, every other direction in each of two files."""
    alpha = float(np.exp(draw.uniform(np.log(0.05), np.log(0.6))))
    if draw.random() < 0.75:
        colour = draw.uniform(0.03, 0.9) * draw.uniform(0.3, 1.0, 3)
        made = Surface.named("lambertian+ggx", {"albedo": colour, "ggx.alpha": alpha, "ggx.n": draw.uniform(1.35, 1.7)})
    else:
        made = Surface.named("ggx", {"alpha": alpha, "n": draw.uniform(0.3, 3.0, 3), "k": draw.uniform(2.0, 6.0, 3)})
    grid = np.meshgrid([10.0, 25, 40, 55, 70], np.arange(-78.0, 79, 2), [180.0, 210.0], indexing="ij")
    geom = rows(signed(*(each.ravel() for each in grid))).at(UM)
    brdf = made.at(UM).brdf(geom) * (1 + NOISE * draw.standard_normal((len(geom), 3)))
    files = []
    for half in range(2):
        measured = Measurement(geom[half::2], brdf[half::2], ("R", "G", "B"), name="made", format="made")
        files.append(folder / f"{number}{'ab'[half]}.csv")
        files[-1].write_text(formats.write("csv", measured)[0])
    return files


def main(count: int, seed: int) -> None:
    with tempfile.TemporaryDirectory() as place:
        folder, draw = Path(place), np.random.default_rng(seed)
        files = [file for number in range(count) for file in halves(draw, folder, number)]
        store = store_at(folder / "fits")
        failed = sum(
            row.brief is None for row in run_tasks([Task(each.name, each, WORK, store) for each in files], store)
        )
        collected.collect_into(store, folder / "all.sqlite")
        with collected.opened(folder / "all.sqlite") as base:
            found = {row["key"]: row for row in conditions.matching(base, [], "doubt", "surface")}
            looks = searching.all_looks(base)
            names = {key: row["file"].partition(".")[0] for key, row in found.items()}
            first = 0
            for key, row in found.items():
                near = searching.nearest(looks, saved.surface_in(row["surface"].encode(), key)).distance
                nearest = min((other for other in near if other != key), key=lambda other: near[other])
                first += names[nearest][:-1] == names[key][:-1]
            groups = searching.alike_groups(looks, {key: row["doubt"] for key, row in found.items()})
        pairs = [(one, other) for group in groups for one in group for other in group if one < other]
        true = sum(names[one][:-1] == names[other][:-1] for one, other in pairs)
        print(f"{count} surfaces, seed {seed}: {failed} of {len(files)} halves without an answer")
        print(f"twin found first: {first} of {len(found)} ({first / len(found):.1%})")
        print(f"alike: {true} of {count} twins paired, {len(pairs) - true} false pairs of {len(pairs)}")


if __name__ == "__main__":
    main(*(int(word) for word in (sys.argv[1:] + ["200", "7"][len(sys.argv) - 1 :])))
