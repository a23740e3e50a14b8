"""Our recommended error against a careful SciPy script that fits the same laws to the same values.

    python benchmarks/scipy_peer.py FILE...

The script knows what a text-book does: a Lambertian body and a lobe (GGX, Beckmann, Ward, Blinn) or two of GGX, with
Fresnel's factor after Schlick, every amplitude free per channel, several starts, `scipy.optimize.least_squares` in ln
over the values that count, on up to 3000 directions, of a spectrum in four channels. Its best error stands against that
of our recommended model, fitted to all, on the same values, with `--close none` and as by default. The last line is the
geometric mean of the ratios: below 1 ours is nearer.
"""

import os
import sys
from dataclasses import replace
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np
from scipy.optimize import least_squares, nnls

import brdfguide
from brdfguide.data import subsample
from brdfguide.errors import BrdfguideError
from brdfguide.fitting.choosing import recommending

MOST = 3000  # directions
CHANNELS = 4  # of a spectrum
STARTS = {"ggx": (0.03, 0.1, 0.3), "beckmann": (0.05, 0.15, 0.4), "ward": (0.05, 0.15, 0.4), "blinn": (0.05, 0.15, 0.4)}
F0 = (0.04, 0.5)
SUMS = (("ggx",), ("beckmann",), ("ward",), ("blinn",), ("ggx", "ggx"))


def lobe(kind: str, geom, alpha: float, f0: float) -> np.ndarray:
    """One lobe (samples,) without its amplitude."""
    tan2, cos_i, cos_r, cos_d = (each[:, 0] for each in (geom.tan2_h, geom.cos_i, geom.cos_r, geom.cos_d))
    fresnel = f0 + (1 - f0) * (1 - cos_d) ** 5
    sec2 = 1 + tan2
    if kind == "ward":
        return np.exp(-tan2 / alpha**2) / (4 * np.pi * alpha**2 * np.sqrt(cos_i * cos_r))
    if kind == "ggx":
        facets = sec2**2 / (np.pi * alpha**2 * (1 + tan2 / alpha**2) ** 2)
    elif kind == "beckmann":
        facets = sec2**2 * np.exp(-tan2 / alpha**2) / (np.pi * alpha**2)
    else:
        exponent = 2 / alpha**2 - 2
        facets = (exponent + 2) / (2 * np.pi) * sec2 ** (-exponent / 2)

    def mask(cos):
        return 2 / (1 + np.sqrt(1 + alpha**2 * (1 / cos**2 - 1)))

    return fresnel * facets * mask(cos_i) * mask(cos_r) / (4 * cos_i * cos_r)


class Sum:
    """ln of a body and lobes under it, minus ln of the values, as `least_squares` wants it.

    A point holds ln alpha and F0 of each lobe, then the logarithms of the heights, part by part, channel by channel.
    """

    def __init__(self, kinds, geom, values, known):
        self.kinds, self.geom, self.known = kinds, geom, known
        self.ln, self.channels = np.log(values), values.shape[1]
        self.shapes = 2 * len(kinds)

    def columns(self, shapes) -> np.ndarray:
        """(samples, parts): the body and each lobe, every height 1."""
        pairs = zip(self.kinds, shapes[::2], shapes[1::2], strict=True)
        parts = [lobe(kind, self.geom, np.exp(alpha), f0) for kind, alpha, f0 in pairs]
        return np.stack([np.full(len(self.ln), 1 / np.pi), *parts], axis=1)

    def heights(self, point) -> np.ndarray:
        """(parts, channels)."""
        return np.exp(point[self.shapes :]).reshape(-1, self.channels)

    def residual(self, point) -> np.ndarray:
        with np.errstate(all="ignore"):
            found = np.log(np.maximum(self.columns(point[: self.shapes]) @ self.heights(point), 1e-300)) - self.ln
        return found[self.known]

    def jacobian(self, point) -> np.ndarray:
        """Exact for the heights; for the shapes by differences."""
        out = np.zeros((np.count_nonzero(self.known), len(point)))
        here = self.residual(point)
        for place in range(self.shapes):
            step = 1e-6 if point[place] < 0.5 else -1e-6
            moved = point.copy()
            moved[place] += step
            out[:, place] = (self.residual(moved) - here) / step
        columns, heights = self.columns(point[: self.shapes]), self.heights(point)
        total = np.maximum(columns @ heights, 1e-300)
        for part in range(len(heights)):
            for channel in range(self.channels):
                share = np.zeros_like(total)
                share[:, channel] = columns[:, part] * heights[part, channel] / total[:, channel]
                out[:, self.shapes + part * self.channels + channel] = share[self.known]
        return out


def model_error(kinds, geom, values, known) -> float:
    """rms ln of the best sum of a body and these lobes over all starts; amplitudes by channel."""
    problem, best = Sum(kinds, geom, values, known), np.inf
    grids = [[(np.log(alpha), f0) for alpha in STARTS[kind] for f0 in F0] for kind in kinds]
    starts = grids[0] if len(kinds) == 1 else [(*a, *b) for a in grids[0] for b in grids[1] if b[0] > a[0] + 0.5]
    for start in starts:
        table = problem.columns(np.array(start, float))
        heights = np.stack(
            [nnls(table[k] / v[k, None], np.ones(k.sum()))[0] for v, k in zip(values.T, known.T, strict=True)],
            axis=1,
        )
        heights = np.log(np.maximum(heights, 1e-6))
        low = np.r_[np.tile([np.log(0.002), 0.0], len(kinds)), np.full(heights.size, -30.0)]
        high = np.r_[np.tile([np.log(2.0), 1.0], len(kinds)), np.full(heights.size, 12.0)]
        point = np.clip(np.r_[start, heights.ravel()], low + 1e-9, high - 1e-9)
        end = least_squares(problem.residual, point, problem.jacobian, bounds=(low, high), max_nfev=60, x_scale="jac")
        best = min(best, float(np.sqrt(np.mean(end.fun**2))))
    return best


def compared(answer):
    """The directions on which both are judged, and the numbers of the channels."""
    measurement = answer.measurement
    rows = subsample.representative_rows(measurement, MOST, among=measurement.clear.any(axis=1))
    count = measurement.brdf.shape[1]
    picked = np.unique(np.linspace(0, count - 1, min(count, CHANNELS)).round().astype(int))
    return measurement[rows], picked


def row(path: str) -> tuple[float, float, float, str]:
    """The script's best error, ours with ties alone and as by default, and our model."""
    answer = brdfguide.fit(brdfguide.read(path), timing=False)
    few, picked = compared(answer)
    known = few.clear[:, picked]
    values = np.where(known, few.brdf[:, picked], 1.0)
    best = min(model_error(kinds, few.geom, values, known) for kinds in SUMS)
    by_ties = recommending(replace(answer.ranking, close="none"), answer.measurement).recommended.fit

    def error(fit):
        part = fit.residuals_on(few)[:, picked]
        return float(np.sqrt(np.mean(part[known & np.isfinite(part)] ** 2)))

    return best, error(by_ties), error(answer.recommended), by_ties.name


def main(paths: list[str]) -> None:
    print(f"{'file':32} {'scipy':>7} {'ours':>7} {'ratio':>6} {'by look':>8} {'ratio':>6}  recommended")
    ratios = []
    for path in paths:
        try:
            peer, ties, look, name = row(path)
        except BrdfguideError as error:
            print(f"{Path(path).name:32} {error}"[:120])
            continue
        ratios.append((ties / peer, look / peer))
        print(
            f"{Path(path).name:32} {peer:7.3f} {ties:7.3f} {ties / peer:6.2f} {look:8.3f} {look / peer:6.2f}  {name}",
            flush=True,
        )
    means = np.exp(np.mean(np.log(ratios), axis=0))
    print(f"geometric mean over {len(ratios)} tables: {means[0]:.2f} by ties alone, {means[1]:.2f} as by default")


if __name__ == "__main__":
    main(sys.argv[1:])
