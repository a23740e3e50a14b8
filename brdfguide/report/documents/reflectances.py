"""What was fitted of a metal as people compare it: F at the normal and, where the data tell, at its edge."""

from collections.abc import Mapping
from functools import partial

import numpy as np

from ...data.measurement import Measurement
from ...fitting.diagnostics.derived_error import ln_stderrs
from ...fitting.fit import Fit
from ...models.candidates import has_edge
from ...physics import fresnel

EDGE_DEG = 82.0  # near the dip that a metal's F has before grazing (Hoffman 2019)
ENOUGH = 2_000  # directions that tell how n and k err together
APART = 0.25  # standard error of n and of k, as a share, up to which the data tell one from the other (ours)


def reflectances(fit: Fit, measurement: Measurement) -> dict:
    """F0 of each lobe of which k was fitted, with its standard error, in place of k; where n was fitted as well also F
    at 82 degrees, in place of n, and both beside n and k where the data tell these apart."""
    out: dict[str, dict] = {}
    absorbing = {term.key("k") for term in fit.model.terms if term.model.has_index}  # another law's k is no index
    for key in (key for key, error in fit.stderr.items() if key in absorbing and error is not None):
        label = key.removesuffix(".k")
        n, k = (np.asarray(fit.values[f"{label}.{name}"], float) for name in "nk")
        if has_edge(fit.model):
            out |= _with_edge(fit, measurement, label)
            continue
        slope = 8 * n * k / ((n + 1) ** 2 + k**2) ** 2  # dF0/dk
        normal = fresnel.f0(n, k)
        out[f"{label}.F0"] = _entry(normal, _farther_side(normal, slope * np.asarray(fit.stderr[key])), key)
    return out


def _with_edge(fit: Fit, measurement: Measurement, label: str) -> dict:
    few = measurement[np.unique(np.linspace(0, len(measurement.brdf) - 1, ENOUGH).astype(int))]
    keys = {name: f"{label}.{name}" for name in "nk"}
    told = all(np.all(np.asarray(fit.stderr[key]) <= APART * np.asarray(fit.values[key])) for key in keys.values())
    channels = np.size(fit.values[keys["k"]])
    out = {}
    for name, deg, replaced in (("F0", 0.0, "k"), (f"F{EDGE_DEG:.0f}", EDGE_DEG, "n")):
        of_each = [partial(_reflectance, label=label, deg=deg, channel=channel) for channel in range(channels)]
        value = np.reshape([of(fit.values) for of in of_each], np.shape(fit.values[keys["k"]]))
        error = np.reshape(ln_stderrs(fit, few, of_each), np.shape(value))
        out[f"{label}.{name}"] = _entry(value, _farther_side(value, value * error), None if told else keys[replaced])
    return out


def _reflectance(values: Mapping, label: str, deg: float, channel: int) -> float:
    n, k = (np.ravel(values[f"{label}.{name}"])[channel] for name in "nk")
    return float(fresnel.fresnel(np.cos(np.radians(deg)), n, k))


def _farther_side(value, stderr) -> np.ndarray:
    """Standard error of a reflectance: half the way to the farther end of an interval of two, formed in ln F/(1 - F).

    F ends at 1. A silver fitted too bright would seem surer than it is: there F hardly changes with n and k.
    """
    value, stderr = np.asarray(value, float), np.asarray(stderr, float)
    odds = value / np.maximum(1 - value, 1e-12)
    with np.errstate(over="ignore", invalid="ignore"):  # of what the data do not tell
        times = np.exp(2 * stderr / np.maximum(value * (1 - value), 1e-300))
        ends = odds / times / (1 + odds / times), np.where(np.isfinite(times), odds * times / (1 + odds * times), 1.0)
    return np.where(np.isfinite(stderr), np.maximum(value - ends[0], ends[1] - value) / 2, stderr)


def _entry(value, stderr, replaced: str | None) -> dict:
    entry = {"value": value, "stderr": stderr, "unit": "", "at_bound": None, "derived": True}
    return {**entry, "in_place_of": replaced or ""}
