"""A simulated gonioreflectometer: what it reads of a noise-free table, by a seed.

    python examples/samples/instrument.py TRUTH.csv --seed 1 --theta-i 10,45,75 > sample.csv

Per reading 1.5 % noise and 0.1 degrees of angular error, 2 % gain per incidence angle, 0.5 % common gain, a constant
floor of 3e-5/(cos i cos r) 1/sr; blocked within 5 degrees of the light; readings below five standard errors are
dropped, not clipped.
"""

import sys
from argparse import ArgumentParser
from pathlib import Path

import numpy as np

NOISE, ANGLE_DEG, SCAN_GAIN, COMMON_GAIN, FLOOR, BLOCKED_DEG = 0.015, 0.1, 0.02, 0.005, 3e-5, 5.0


def read_truth(path):
    """(header lines, theta_i, theta_r, f of shape (theta_i, theta_r)) of a noise-free table."""
    lines = Path(path).read_text().splitlines()
    header = [line for line in lines if line.startswith("#")]
    theta_i, theta_r, f = np.loadtxt([line for line in lines if not line.startswith(("#", "theta"))], delimiter=",").T
    i, r = np.unique(theta_i), np.unique(theta_r)
    return header, i, r, f.reshape(i.size, r.size)


def measure(i, r, f, seed, wanted=None):
    """Rows (theta_i, theta_r, brdf, stderr) and how many readings were dropped below the floor."""
    rng = np.random.default_rng(seed)
    common = 1 + COMMON_GAIN * rng.standard_normal()
    rows, dropped = [], 0
    for theta_i, curve in zip(i, f, strict=True):
        gain = common * (1 + SCAN_GAIN * rng.standard_normal())
        true = np.interp(r + ANGLE_DEG * rng.standard_normal(r.size), r, curve)
        floor = FLOOR / (np.cos(np.radians(theta_i)) * np.cos(np.radians(r)))
        read = gain * true * (1 + NOISE * rng.standard_normal(r.size)) + floor * rng.standard_normal(r.size)
        stderr = np.hypot(NOISE * read, floor)
        open_ = np.abs(r + theta_i) > BLOCKED_DEG
        strong = read > 5 * stderr
        dropped += np.count_nonzero(open_ & ~strong)
        if wanted is None or theta_i in wanted:
            rows += [
                (theta_i, *row)
                for row in zip(r[open_ & strong], read[open_ & strong], stderr[open_ & strong], strict=True)
            ]
    return rows, dropped


def main():
    parser = ArgumentParser()
    parser.add_argument("truth")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--theta-i", default="", help="incidence angles to keep, such as 10,45,75")
    options = parser.parse_args()
    header, i, r, f = read_truth(options.truth)
    wanted = [float(word) for word in options.theta_i.split(",") if word] or None
    rows, dropped = measure(i, r, f, options.seed, wanted)
    print("\n".join(header))
    print(
        f"# instrument: examples/samples/instrument.py --seed {options.seed}; {dropped} readings below the noise "
        f"floor dropped"
    )
    print("theta_i_deg,theta_r_deg,brdf,stderr")
    for theta_i, theta_r, value, stderr in rows:
        print(f"{theta_i:g},{theta_r:g},{value:.5g},{stderr:.2g}")


if __name__ == "__main__":
    sys.exit(main())
