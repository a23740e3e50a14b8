"""How time and memory of a fit grow beyond memory: made values of three channels, generated while they are read.

python benchmarks/growth.py 1e6 1e7 1e8
"""

import os
import sys

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import resource
import subprocess
from time import perf_counter, process_time

import numpy as np

import brdfguide
from brdfguide.data.blocks import Blocks
from brdfguide.data.measurement import Measurement
from brdfguide.models.surface import Surface
from brdfguide.physics.colour import CHANNEL_UM
from brdfguide.physics.geometry import Geometry, rows

BLOCK = 65_536
PAINT = Surface.named("lambertian+beckmann", {"albedo": [0.4, 0.2, 0.1], "beckmann.alpha": 0.25, "beckmann.n": 1.5})
HAZE = Surface.named("ggx", {"alpha": 0.5, "n": 1.4})
UM = np.array([CHANNEL_UM[name] for name in "RGB"])


def block(number: int, size: int) -> Measurement:
    """So many directions of a surface that no candidate is: a rough lobe with a haze, 3 % of noise."""
    draw = np.random.default_rng(number)
    theta_i, theta_r = np.degrees(np.arccos(np.sqrt(draw.uniform(0.03, 1.0, (2, size)))))
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, draw.uniform(0, 360, size), UM))
    brdf = (PAINT.brdf(geom) + 0.2 * HAZE.brdf(geom)) * (1 + 0.03 * draw.standard_normal((size, 3)))
    return Measurement(geom, brdf, ("R", "G", "B"), name="made", format="made")


def run(size: int, models) -> None:
    """One line: what it took, and the answer."""
    blocks = Blocks("made", lambda: (block(place, min(BLOCK, size - place)) for place in range(0, size, BLOCK)))
    wall, cpu = perf_counter(), process_time()
    if models == ["reading"]:
        print(f"{size:.0e} x 3 read twice alone: ", sum(len(each.brdf) for _ in range(2) for each in blocks), end=" ")
        told = ""
    else:
        best = brdfguide.fit(blocks, models or None, timing=False).recommended
        told = f"{best.name} rms ln {best.rms_ln:.5f}"
    wall, cpu = perf_counter() - wall, process_time() - cpu
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"{size:.0e} x 3: {wall:.1f} s, {cpu:.1f} s of processor, {peak:.0f} MB: {told}", flush=True)


if __name__ == "__main__":
    if sys.argv[1] == "one":
        run(int(float(sys.argv[2])), sys.argv[3:])
    else:
        sizes = [word for word in sys.argv[1:] if word[0].isdigit()]
        for size in sizes:  # each in a process of its own, for its memory
            subprocess.run([sys.executable, __file__, "one", size, *sys.argv[1 + len(sizes) :]], check=True)
