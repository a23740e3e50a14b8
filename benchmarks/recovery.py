"""Do the printed intervals hold the truth? Made-up surfaces of every model, fitted by that model.

    python benchmarks/recovery.py [sets per model] [model ...]

Each set: random parameters, six scans in the plane of incidence with gaps and missing values, three channels, 2 to 5 %
of independent noise. A value counts as covered if it lies within 1.96 standard errors of the fitted one; values that the
program itself calls undetermined or at a bound, or for which it names a second answer as good, are counted apart.
"""

import os
import re
import sys
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np  # noqa: E402

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from brdfguide import candidates, fitting  # noqa: E402
from brdfguide.misfit import Layout  # noqa: E402
from tests import synthetic  # noqa: E402


def one_set(model, seed: int):
    """(z of each determined value, how many were not determined, Fit, noise, true values)."""
    random = np.random.default_rng([seed, sum(map(ord, fitting.label(model)))])
    values = synthetic.random_values(Layout(model, 3), random)
    noise = random.uniform(0.02, 0.05)
    data = synthetic.surface(model, synthetic.scan(), values, noise=noise, seed=seed, channels=3)
    fit = fitting.fit(model, synthetic.with_gaps(data, seed))
    scores, aside, values = {}, 0, nearest_order(model, values, fit)
    for key, stderr in fit.stderr.items():
        if fit.has("starts-disagree") or fit.has(f"undetermined:{key}") or fit.has(f"at-bound:{key}") or fit.has(f"unused:{key}"):
            aside += np.size(fit.values[key])
            continue
        scores[key] = np.atleast_1d((fit.values[key] - values[key]) / np.maximum(stderr, 1e-300))
    return scores, aside, fit, noise, values


def nearest_order(model, values: dict, fit) -> dict:
    """Two lobes of one law may come out in either order; the true values in the order that the fit chose."""
    if not any(key.startswith("lafortune.1.") for key in values):
        return values
    other = {".1.": ".2.", ".2.": ".1."}
    turned = {re.sub(r"\.[12]\.", lambda found: other[found[0]], key): value for key, value in values.items()}
    far = lambda each: sum(np.sum(np.abs(fit.values[key] - each[key]) / (stderr + 1e-300)) for key, stderr in fit.stderr.items())  # noqa: E731
    return min((values, turned), key=far)


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
        unreported += fit.converged and fit.rms_ln > 1.3 * noise and not (fit.has("discrepancy") or fit.has("starts-disagree"))
    z = np.array(scores)
    return {
        "coverage": float(np.mean(np.abs(z) < 1.96)), "bias": float(np.median(z)), "values": len(z), "aside": aside,
        "unreported": unreported, "stopped": stopped, "flagged": flagged, "ridges": ridges,
        "by_key": {key: float(np.mean(np.abs(each) < 1.96)) for key, each in by_key.items()},
    }  # fmt: skip


def main(sets: int, wanted: list[str]) -> None:
    models = [model for model in candidates.of_kind() if not wanted or fitting.label(model) in wanted]
    print(f"{'model':28} covered  bias  values  apart  ridge  not converged  said nothing  discrepancy   ({sets} sets each)")
    for model in models:
        found = study(model, sets)
        print(
            f"{fitting.label(model):28} {100 * found['coverage']:6.1f}%  {found['bias']:+.2f}  {found['values']:6}  {found['aside']:5}  {found['ridges']:5}"
            f"  {found['stopped']:13}  {found['unreported']:12}  {found['flagged']:11}   "
            + " ".join(f"{key} {100 * each:.0f}" for key, each in found["by_key"].items()), flush=True,
        )  # fmt: skip


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200, sys.argv[2:])
