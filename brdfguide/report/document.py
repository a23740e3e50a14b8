"""Results as one dict, which terminal, JSON, plot and page all read, so that they cannot disagree."""

import numpy as np

from ..fitting import Fit
from ..measurement import Measurement
from ..misfit import METRICS
from ..next_measurement import Next
from ..ranking import Ranking, Row
from .data import data_block, finding
from ..verdict import Verdict
from .plain import plain


def fit_document(ranking: Ranking, measurement: Measurement, judged: Verdict | None = None, *, timing: bool = True) -> dict:
    """`brdfguide fit --json` (CLI contract)."""
    return plain({
        "schema": "brdfguide/fit/1",
        "data": data_block(measurement.noting(*ranking.weighing)),
        "kind": {"verdict": judged.kind, "evidence": list(judged.evidence), "numbers": dict(judged.numbers)} if judged else None,
        "metric": ranking.metric,
        "noise_rms_ln": _round(ranking.noise),
        "ranking": [_row(row, measurement, timing) for row in ranking.rows],
        "recommended": ranking.recommended.fit.name,
        "because": ranking.because,
        "winners": ranking.winners,
        "scales": {name: {"counts": metric.emphasis, "order": _order(ranking, name)} for name, metric in METRICS.items()},
        "warnings": [finding(each) for each in ranking.warnings],
        "left_out": [],
    })  # fmt: skip


def _order(ranking: Ranking, scale: str) -> list[dict]:
    """Candidates and their errors on a scale: its winner, then the others in order of error; alike to five digits, the simpler first."""
    error = lambda row: float(f"{row.errors[scale]:.5g}") if np.isfinite(row.errors[scale]) else np.inf  # noqa: E731
    rows = sorted(ranking.rows, key=lambda row: (row.fit.name != ranking.winners[scale], error(row), row.fit.free))
    return [{"candidate": row.fit.name, "error": row.errors[scale]} for row in rows]


def next_block(proposed: Next) -> dict:
    """`fit --next`: what one more measurement is for, and where."""
    gain = "differ_by_noise" if proposed.purpose == "separate" else "standard_error_left"
    places = [{"theta_i_deg": each.theta_i_deg, "theta_r_deg": each.theta_r_deg, "phi_deg": each.phi_deg, gain: each.gain} for each in proposed.directions]
    return plain({"purpose": proposed.purpose, "of": list(proposed.subject), "directions": places})


def _row(row: Row, measurement: Measurement, timing: bool) -> dict:
    fit = row.fit
    entry = {
        "rank": row.rank,
        "tied": row.tied,
        "model": fit.model.name,
        "candidate": fit.name,
        "freed": list(fit.model.free),
        "rms_ln": row.rms_ln,
        "rms_ln_by_theta_i": {f"{theta:g}": value for theta, value in row.rms_ln_by_theta_i.items()},
        "errors": row.errors,
        "held_out_rms_ln": row.held_out.rms_ln if row.held_out else None,
        "held_out_highest": {"theta_i_deg": row.held_out.highest_theta_i_deg, "rms_ln": row.held_out.highest_rms_ln} if row.held_out else None,
        "growth": row.growth,
        "behind": row.behind,
        "behind_se": row.behind_se,
        "parameters": _parameters(fit),
        "free_parameters": fit.free,
        "evaluations": fit.evaluations,
        "converged": fit.converged,
        "flags": [finding(each) for each in row.warnings],
    }
    if timing:
        entry |= {"time_per_sample_ns": row.ns_per_sample, "fit_time_s": fit.seconds, "on_front": row.on_front}
    return entry


def _parameters(fit: Fit) -> dict:
    """Every value, fitted or fixed, and what follows from them; at_bound is "low", "high" or null."""
    out = {}
    for key, parameter in fit.model.parameters.items():
        value, stderr = fit.values[key], fit.stderr.get(key)
        ends = [end for end in ("low", "high") if fit.has(f"at-bound:{key}") and _at(parameter, value, end)]
        shown = parameter.outside(value), None if stderr is None else parameter.outside(stderr)
        out[key] = {"value": shown[0], "stderr": shown[1], "unit": parameter.outside_unit, "at_bound": ends[0] if ends else None, "fitted": stderr is not None}
    for term in fit.model.terms:
        own = {**term.model.defaults(), **fit.model.of_term(term, fit.values)}
        for derived in term.model.derived:
            out[f"{term.label}.{derived.name}"] = {"value": derived.of(**own), "stderr": None, "unit": derived.unit, "at_bound": None, "derived": True}
    for finding in fit.warnings:
        kind, _, key = finding.code.partition(":")
        if kind == "rough-regime":  # its sigma and tau are not numbers but bounds
            numbers = dict(finding.numbers)
            out[key]["above"] = numbers["sigma_um_above"]
            out[key.removesuffix("sigma") + "tau"]["above"] = numbers["sigma_um_above"] / numbers["slope"]
    return out


def _at(parameter, value, end: str) -> bool:
    bound = getattr(parameter, end)
    return bool(np.any(np.abs(np.asarray(value) - bound) <= 1e-5 * max(abs(bound), 1e-9)))


def _round(value: float) -> float:
    return float(f"{value:.6g}")


def residuals_csv(fit: Fit, measurement: Measurement) -> str:
    """Directions, data, model and ln(model/data), a row for each direction and channel that was measured."""
    geom = measurement.geom
    wavelength = np.broadcast_to(np.atleast_1d(geom.wavelength) * 1e3, measurement.brdf.shape[1:])
    lines = [f"# ln(model/data) of {fit.name} on {measurement.name}", "theta_i_deg,theta_r_deg,phi_deg,channel,wavelength_nm,brdf,model,ln_ratio"]
    for row, column in zip(*np.nonzero(np.isfinite(fit.residuals))):
        angles = ",".join(f"{float(angle[row, 0]):.9g}" for angle in (geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg))
        value, ratio = measurement.brdf[row, column], fit.residuals[row, column]
        lines.append(f"{angles},{measurement.channels[column]},{wavelength[column]:g},{value:.9g},{value * np.exp(ratio):.9g},{ratio:.9g}")
    return "\n".join(lines) + "\n"
