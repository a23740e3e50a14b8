"""Our fit against what a careful user would write: a plain SciPy script and lmfit, same data, same run; and whole
commands, cold.

    python benchmarks/fit_speed.py [MERL table] [--before TREE]

20,000 scattered directions, three channels, 3 % noise, a Lambertian body under a GGX lobe: one width, an albedo and an
index for each channel, residuals ln(model/data). The scripts get the formula written out in NumPy, start from the
defaults and let least_squares difference it (as nearly every published script does), and once more with our
derivatives. Processor time, one thread, least of three turns. Whole commands also on the small files of examples/ and
on a MERL table, in turns with another tree of this program where one is given.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

import numpy as np

from brdfguide import models
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.objective import Misfit, metric
from tests import synthetic

DIRECTIONS, CHANNELS, TURNS, COLD_TURNS = 20_000, 3, 3, 7
SMALL = ("white_paper.csv", "rough_plastic.csv", "rough_aluminium.csv", "metallic_paint.csv", "smooth_steel.csv")
MODEL = models.get("lambertian+ggx")
TRUTH = {"lambertian.albedo": np.array([0.30, 0.20, 0.10]), "ggx.alpha": 0.25, "ggx.n": np.array([1.50, 1.52, 1.55])}
START = np.r_[0.2, [0.5] * 3, [1.5] * 3]
LOW = np.r_[1e-4, [0.0] * 3, [1.0001] * 3]
HIGH = np.r_[1.5, [1.0] * 3, [100.0] * 3]


def plain(geom, x):
    """The model as a script would have it: x = alpha, three albedos, three indices."""
    alpha2, albedo, n = x[0] ** 2, x[1:4], x[4:7]
    facets = alpha2 / (np.pi * (geom.tan2_h + alpha2) ** 2) * (1 + geom.tan2_h) ** 2

    def hidden(cos):
        return np.sqrt(alpha2 + (1 - alpha2) * cos**2)

    mask = 2 / (geom.cos_r * hidden(geom.cos_i) + geom.cos_i * hidden(geom.cos_r))
    c = geom.cos_d
    g = np.sqrt(n**2 + c**2 - 1)
    fresnel = 0.5 * ((g - c) / (g + c)) ** 2 * (1 + ((c * (g + c) - 1) / (c * (g - c) + 1)) ** 2)
    return albedo / np.pi + fresnel * facets * mask / 4


def with_scipy(data):
    from scipy.optimize import least_squares

    ln_data = np.log(data.brdf)
    found = least_squares(
        lambda x: (np.log(plain(data.geom, x)) - ln_data).ravel(), START, bounds=(LOW, HIGH), x_scale=START
    )
    return np.sqrt(np.mean(found.fun**2))


def with_scipy_and_derivatives(data):
    from scipy.optimize import least_squares

    layout = Layout(MODEL, CHANNELS)
    misfit, memory = Misfit(layout, data, metric("ln"), np.ones_like(data.brdf)), {}

    def split(x):
        return (x[:1], x[1:].reshape(CHANNELS, 2))

    def residuals(x):
        memory["x"], (memory["r"], memory["shared"], memory["per_channel"]) = x.copy(), misfit(*split(x), True)
        return memory["r"].T.ravel()

    def jacobian(x):
        if not np.array_equal(x, memory.get("x")):
            residuals(x)
        out = np.zeros((CHANNELS, len(data.brdf), 1 + 2 * CHANNELS))
        out[:, :, :1] = memory["shared"]
        for channel in range(CHANNELS):
            out[channel, :, 1 + 2 * channel : 3 + 2 * channel] = memory["per_channel"][channel]
        return out.reshape(-1, out.shape[2])

    shared, per_channel = layout.encode(MODEL.defaults())
    low, high = (
        np.r_[a, np.tile(b, CHANNELS)]
        for a, b in zip(layout.bounds(layout.shared), layout.bounds(layout.per_channel), strict=True)
    )
    found = least_squares(residuals, np.r_[shared, per_channel.ravel()], jac=jacobian, bounds=(low, high))
    return np.sqrt(np.mean(found.fun**2))


def with_lmfit(data):
    import lmfit

    ln_data, parameters = np.log(data.brdf), lmfit.Parameters()
    for place, (value, low, high) in enumerate(zip(START, LOW, HIGH, strict=True)):
        parameters.add(f"x{place}", value=value, min=low, max=high)
    found = lmfit.minimize(
        lambda p: (np.log(plain(data.geom, np.array(list(p.valuesdict().values())))) - ln_data).ravel(), parameters
    )
    return np.sqrt(np.mean(found.residual**2))


def ours(data):
    return fitting.fit(MODEL, data).rms_ln


def cold(path, tree: Path) -> tuple[float, float]:
    """Processor seconds and peak memory [MB] of a whole command in a new process, without the card."""
    words = ["--no-numbers"] if tree == ROOT else []  # which an older tree has not
    process = subprocess.Popen(
        [sys.executable, "-m", "brdfguide", "fit", str(path), "--quiet", *words],
        cwd=tree,
        env={**os.environ, "PYTHONPATH": str(tree)},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 1):  # 1: an answer that is not to be trusted, such as of smooth_steel.csv
        raise RuntimeError(f"{path}: status {process.returncode} in {tree}")
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1024


def in_turns(path, before: Path | None, turns: int) -> str:
    """The least processor time and the greatest memory of the whole command, and those of the tree before."""
    trees = [ROOT] if before is None else [ROOT, before]
    rounds = [[cold(path, tree) for tree in trees] for _ in range(turns)]
    shown, sums = [], []
    for each in zip(*rounds, strict=True):
        seconds, memory = zip(*each, strict=True)
        shown.append(f"{min(seconds):.2f} s, {max(memory):.0f} MB")
        sums.append(sum(seconds))
    return f"  {Path(path).name:26} {' against '.join(shown)}; by their sums {sums[0] / sums[-1]:.2f} times"


def whole_commands(data, table: str | None, before: Path | None) -> None:
    """Before SciPy is imported: a new process is born with the peak memory of its parent."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "data.csv"
        angles = (
            data.geom.theta_i_deg[:, 0],
            0 * data.geom.theta_r_deg[:, 0],
            data.geom.theta_r_deg[:, 0],
            data.geom.phi_deg[:, 0],
        )
        np.savetxt(
            path,
            np.column_stack((*angles, data.brdf)),
            "%.7g",
            ",",
            header="theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,450,550,650",
            comments="",
        )
        print(
            f"whole commands, cold, all default candidates with uncertainties and held-out errors, one core, least "
            f"processor time of {COLD_TURNS} turns ({TURNS} of a MERL table), against {before or 'no other tree'}:"
        )
        with one_core():
            print(in_turns(path, before, COLD_TURNS), f"({DIRECTIONS} directions x {CHANNELS} channels)")
            for small in SMALL:
                print(in_turns(ROOT / "examples" / small, before, COLD_TURNS))
            if table:
                print(in_turns(Path(table).resolve(), before, TURNS))


@contextmanager
def one_core():
    """Where the system lets a process choose."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    every = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(every)})
    yield
    os.sched_setaffinity(0, every)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", nargs="?")
    parser.add_argument("--before", type=Path, help="a tree of this program to take turns with")
    asked = parser.parse_args()
    data = synthetic.surface(MODEL, synthetic.hemisphere(DIRECTIONS), TRUTH, noise=0.03, seed=1, channels=CHANNELS)
    assert np.allclose(
        plain(data.geom, np.r_[0.25, TRUTH["lambertian.albedo"], TRUTH["ggx.n"]]), MODEL(data.geom, TRUTH), rtol=1e-12
    )
    whole_commands(data, asked.table, asked.before and asked.before.resolve())
    rivals = {
        "ours: starts, fit, intervals, doubts": ours,
        "SciPy, differences": with_scipy,
        "SciPy, our derivatives": with_scipy_and_derivatives,
        "lmfit": with_lmfit,
    }
    least, error = {}, {}
    for _ in range(TURNS):
        for name, fit in rivals.items():
            fresh = synthetic.surface(
                MODEL, synthetic.hemisphere(DIRECTIONS), TRUTH, noise=0.03, seed=1, channels=CHANNELS
            )
            began = time.process_time()
            try:
                error[name] = fit(fresh)
            except ImportError:
                continue
            least[name] = min(least.get(name, np.inf), time.process_time() - began)
    print("one model, processor time of the fit alone:")
    for name in rivals:
        if name in least:
            print(
                f"  {name:38} {least[name]:6.2f} s  {least[name] / least[next(iter(rivals))]:5.1f} x   rms ln "
                f"{error[name]:.6f}"
            )
        else:
            print(f"  {name:38} absent: not installed")


if __name__ == "__main__":
    main()
