"""Do the printed intervals hold the truth? Made-up surfaces of every model, fitted by that model: those that are tried
from the start, then those that grow or are named.

    python benchmarks/recovery.py [sets per model] [model ...]

Each set: random parameters, six scans in the plane of incidence with gaps and missing values, three channels, 2 to 5 %
of independent noise. A value counts as covered if it lies within 1.96 standard errors of the fitted one; values that
the program itself calls undetermined or at a bound, or for which it names a second answer as good, are counted apart.
Drift: the same with a gain of 2 % for each scan and an arm whose zero is 0.2 degrees off (both normal), in plane and
over the hemisphere; named is how often the flag says the instrument, and not the model.
"""

import os
import re
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from brdfguide.data.scans import arm_turned
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.layout import Layout
from brdfguide.models import candidates
from brdfguide.physics.geometry import Geometry, rows
from tests import synthetic

GAIN, ZERO_DEG = 0.02, 0.2  # standard deviations of the drift
GROWN = (  # what is tried only where the best so far leaves something, or where it is named
    "lambertian+gtr",
    "lambertian+sgd",
    "lambertian+low-smooth",
    "lambertian+low-facet",
    "lambertian+ggx-ms",
    "lambertian+stam",
    "coated:lambertian",
    "ggx+coated:lambertian",
    "coated:ggx",
    "coated:flakes",
    "coated:lambertian+flakes",
    "ggx+coated:lambertian+flakes",
    "lambertian+ggx+retro",
    "lambertian+ggx (height free)",
    "lambertian+ggx:2",
    "lambertian+beckmann:2",
    "ggx:2 (metal)",
    "ggx (metal, edge free)",
)


def dome() -> Geometry:
    """Five incidences over the hemisphere."""
    grid = np.meshgrid([5.0, 20.0, 35.0, 50.0, 65.0], np.arange(2.0, 81.0, 6.0), np.arange(0.0, 181.0, 30.0))
    theta_i, theta_r, phi = (each.ravel() for each in grid)
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def drifted(data, truth, random, noise: float):
    """What an instrument reports of the truth, a function of Geometry, whose scans and arm have drifted."""
    turned = arm_turned(data.geom, ZERO_DEG * random.standard_normal())
    angles, scan = np.unique(data.geom.theta_i_deg[:, 0], return_inverse=True)
    gains = GAIN * random.standard_normal(len(angles))[scan.ravel()]
    doubt = gains[:, None] + noise * random.standard_normal(data.brdf.shape)
    return replace(data, brdf=np.where(np.isfinite(data.brdf), truth(turned) * np.exp(doubt), np.nan))


def one_set(model, seed: int, drift: str = ""):
    """(z of each determined value, how many were not determined, Fit, noise, true values), under drift in `plane` or
    `dome`."""
    random = np.random.default_rng([seed, sum(map(ord, fitting.candidate_label(model)))])
    values = synthetic.random_values(Layout(model, 3), random)
    noise = random.uniform(0.02, 0.05)
    geom = dome() if drift == "dome" else synthetic.scan()
    data = synthetic.surface(model, geom, values, noise=noise, seed=seed, channels=3)
    if drift:
        data = drifted(data, partial(model, values=values), random, noise)
    fit = fitting.fit(model, synthetic.with_gaps(data, seed))
    scores, aside, values = {}, 0, nearest_order(model, values, fit)
    for key, stderr in fit.stderr.items():
        if (
            fit.has("starts-disagree")
            or fit.has("undetermined", key)
            or fit.has("at-bound", key)
            or fit.has(f"unused:{key}")
        ):
            aside += np.size(fit.values[key])
            continue
        scores[key] = np.atleast_1d((fit.values[key] - values[key]) / np.maximum(stderr, 1e-300))
    return scores, aside, fit, noise, values


def nearest_order(model, values: dict, fit) -> dict:
    """Two lobes of one law may come out in either order; the true values in the order that the fit chose."""
    if not any(".1." in key for key in values) or any(key.endswith(".k") for key in fit.stderr):
        return values  # the first lobe of a metal is as high as F0 makes it: their order shows
    other = {".1.": ".2.", ".2.": ".1."}
    twins = {key: re.sub(r"\.[12]\.", lambda found: other[found[0]], key) for key in values}
    turned = {key: values.get(twin, values[key]) for key, twin in twins.items()}  # what they share has no twin

    def far(each):
        return sum(
            np.sum(np.abs(fit.values[key] - each[key]) / (stderr + 1e-300)) for key, stderr in fit.stderr.items()
        )

    return min((values, turned), key=far)


def under_drift(model, sets: int, where: str) -> tuple[float, float]:
    """Coverage of 95 % intervals, and how often the instrument was named."""
    inside, named = [], 0
    for seed in range(sets):
        z, _, fit, _, _ = one_set(model, seed, where)
        inside += [abs(each) < 1.96 for values in z.values() for each in values]
        named += fit.has("instrument") and not fit.has("discrepancy")
    return float(np.mean(inside)), named / sets


def study(model, sets: int) -> dict:
    """Coverage of 95 % intervals, median bias in standard errors, and what went wrong, over `sets` surfaces."""
    scores, aside, unreported, stopped, flagged, ridges = [], 0, 0, 0, 0, 0
    by_key: dict[str, list] = {}
    for seed in range(sets):
        z, apart, fit, noise, _ = one_set(model, seed)
        scores += [each for values in z.values() for each in values]
        for key, values in z.items():
            by_key.setdefault(key, []).extend(values)
        aside += apart
        stopped += not fit.converged
        flagged += fit.has("discrepancy")
        ridges += fit.has("ridge")
        # a fit that ended far above the noise and says nothing of it
        unreported += (
            fit.converged and fit.rms_ln > 1.3 * noise and not (fit.has("discrepancy") or fit.has("starts-disagree"))
        )
    z = np.array(scores)
    return {
        "coverage": float(np.mean(np.abs(z) < 1.96)), "bias": float(np.median(z)), "values": len(z), "aside": aside,
        "unreported": unreported, "stopped": stopped, "flagged": flagged, "ridges": ridges,
        "by_key": {key: float(np.mean(np.abs(each) < 1.96)) for key, each in by_key.items()},
    }  # fmt: skip


def main(sets: int, wanted: list[str]) -> None:
    models = [candidates.named(name) for name in wanted or GROWN]
    models = models if wanted else [*candidates.of_kind(), *models]
    print(
        f"{'model':28} drift: plane named  dome named  covered  bias  values  apart  ridge  not converged  "
        f"said nothing  discrepancy   ({sets} sets each)"
    )
    for model in models:
        found = study(model, sets)
        plane, dome_ = (under_drift(model, sets, where) for where in ("plane", "dome"))
        print(
            f"{fitting.candidate_label(model):28} {100 * plane[0]:10.1f}% {100 * plane[1]:4.0f}% "
            f"{100 * dome_[0]:5.1f}% {100 * dome_[1]:4.0f}% {100 * found['coverage']:6.1f}%  {found['bias']:+.2f}  "
            f"{found['values']:6}  {found['aside']:5}  {found['ridges']:5}"
            f"  {found['stopped']:13}  {found['unreported']:12}  {found['flagged']:11}   "
            + " ".join(f"{key} {100 * each:.0f}" for key, each in found["by_key"].items()), flush=True,
        )  # fmt: skip


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200, sys.argv[2:])
