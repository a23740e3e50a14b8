"""Results as one dict, which terminal, JSON, plot and page all read, so that they cannot disagree."""

import dataclasses
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

import numpy as np

from ...data.measurement import Measurement
from ...data.metal_or_dielectric import Verdict
from ...fitting.cross_validation import thinned_rows
from ...fitting.fit import Fit
from ...fitting.missing_term import missing_term
from ...fitting.next_measurement import Next
from ...fitting.next_picture import NextPicture
from ...fitting.objective import METRICS, SEEN
from ...fitting.off_plane_price import off_plane_price
from ...fitting.prepared import few_channels
from ...fitting.ranked import Ranking, Row
from ...fitting.stray_light import stray_light
from ...flags import Effect
from ...physics import seen
from .data import data_block, read_with_block
from .digest import with_digest
from .errors_of_grain import errors_of_grain
from .findings import finding
from .off_plane import missing_block, price_block
from .plain import off_percent, plain
from .reflectances import reflectances
from .stray_light import stray_light_block

NOTICED = "lightness on a sphere: what people notice side by side [L*]"


def fit_document(
    ranking: Ranking,
    measurement: Measurement,
    judged: Verdict | None = None,
    *,
    timing: bool = True,
    read_with: Mapping[str, Any] = MappingProxyType({}),
) -> dict:
    """`brdfguide fit --json` (CLI contract); `read_with` is what was said of the file's meaning, for `verify`."""
    rows = [_row(row, measurement, timing, _shows(row, ranking)) for row in _recommended_first(ranking)]
    return with_digest(
        {
            "schema": "brdfguide/fit/1",
            "data": data_block(measurement.noting(*ranking.weighing)) | {"read_with": read_with_block(read_with)},
            "kind": {"verdict": judged.kind, "evidence": list(judged.evidence), "numbers": dict(judged.numbers)}
            if judged
            else None,
            "metric": ranking.metric,
            "close": ranking.close,
            "seen_weights": ranking.seen_weights,
            "noise": _noise(ranking, measurement),
            "noise_rms_ln": _round(ranking.noise),
            "ranking": rows,
            "held_out_on": _held_out_on(ranking, measurement),
            "floor": floor_block(ranking),
            "seen_order": _seen_order(ranking),
            "no_answer": ranking.no_answer or None,
            "recommended": ranking.recommended.fit.name,
            "recommended_fit": rows[0],
            "trustworthy": not ranking.no_answer,
            "because": ranking.because,
            "winners": ranking.winners,
            "scales": {
                name: {"counts": counts, "order": _order(ranking, name)}
                for name, counts in [*((name, metric.emphasis) for name, metric in METRICS.items()), (SEEN, NOTICED)]
            },
            "warnings": [finding(each) for each in ranking.warnings],
            "left_out": [],
            "grown": grown_block(ranking),
            "stray_light": stray_light_block(stray_light(ranking, measurement)),
            "off_plane": price_block(off_plane_price(ranking, measurement)),
            "missing": missing_block(missing_term(ranking.recommended.fit, measurement)),
        }
    )


def grown_block(ranking: Ranking, *, explain: bool = False) -> list[dict]:
    """How candidates grew, step by step; what a step tried besides what it took only to `explain` it."""
    steps = [dataclasses.asdict(each) for each in ranking.grown]
    for step in steps:
        step["tried"] = [each for each in step["tried"] if explain or each["candidate"] == step["taken"]]
    return plain(steps)


def _recommended_first(ranking: Ranking) -> list[Row]:
    """The row to use, then the others in order of error."""
    return [ranking.recommended, *(row for row in ranking.rows if row.fit is not ranking.recommended.fit)]


def floor_block(ranking: Ranking) -> dict | None:
    """How well anything could describe the data (rms ln), and the share of the best model's squared misfit that would
    go.
    """
    floor = ranking.floor
    if floor is None:
        return None
    unlike = floor.unlike
    return {
        "candidate": floor.candidate,
        "model": _told(floor.model),
        "smooth": _told(floor.smooth),
        "factored": _told(floor.factored),
        "noise": _told(floor.noise),
        "coefficients": _told(floor.coefficients),
        "lambda": _told(floor.stiffness),
        "gcv": _told(floor.smooth),
        "residual": _told(floor.residual),
        "reducible": _told(floor.reducible),
        "resolves": floor.resolves,
        "by_form": _told(floor.by_form),
        "beyond_form": _told(floor.beyond_form),
        "not_reciprocal": _told(floor.one_way),
        "channels": list(floor.of),
        "directions": floor.directions,
        "unlike": None
        if unlike is None
        else {
            "factor": unlike.factor,
            "angle_of": unlike.of,
            "angle_deg": [_told(each) for each in unlike.at_deg],
            "free_over_model": [_told(each) for each in unlike.ratio],
            "rms_ln": _told(unlike.rms_ln),
        },
    }


def _told(value: float | None) -> float | None:
    """Four digits: what a machine's own order of sums leaves alone."""
    return None if value is None else float(f"{value:.4g}")


def _noise(ranking: Ranking, measurement: Measurement) -> dict:
    """What single values are worth, and over how many of them errors are told: those clear of the dark level."""
    worth, told = measurement.noise, int(np.count_nonzero(measurement.clear))
    if worth is None:
        return {"relative": ranking.noise, "values_told": told}
    return {
        "relative": worth.relative,
        "absolute_per_sr": list(worth.absolute),
        "dark_level_per_sr": list(worth.dark) if worth.has_dark_level else None,
        "dark_level_stderr_per_sr": list(worth.dark_stderr) if worth.has_dark_level else None,
        "told_from_per_sr": list(worth.limit) if worth.matters else None,
        "missed": ranking.rows[0].fit.missed,
        "values_told": told,
    }


def _order(ranking: Ranking, scale: str) -> list[dict]:
    """Candidates and errors on a scale: its winner, the others in order; alike to five digits, the simpler first."""

    def error(row):
        return float(f"{row.errors[scale]:.5g}") if np.isfinite(row.errors[scale]) else np.inf

    first = None if scale == SEEN else ranking.winners[scale]  # to the eye others may be as good as the least
    rows = sorted(ranking.rows, key=lambda row: (row.fit.name != first, error(row), row.fit.free))
    return [{"candidate": row.fit.name, "error": row.errors[scale]} for row in rows]


def _seen_order(ranking: Ranking) -> list[dict]:
    """Candidates as people would order them, in words, and which look as good as the first."""
    known = sorted((row for row in ranking.rows if np.isfinite(row.seen)), key=lambda row: row.seen)
    return [
        {"candidate": row.fit.name, "seen": row.seen, "seen_words": seen.words(row.seen), "alike": row.alike}
        for row in known
    ]


def next_block(proposed: Next) -> dict:
    """`fit --next`: what one more measurement is for, and where."""
    gain = "differ_by_noise" if proposed.purpose == "separate" else "standard_error_left"
    places = [
        {"theta_i_deg": each.theta_i_deg, "theta_r_deg": each.theta_r_deg, "phi_deg": each.phi_deg, gain: each.gain}
        for each in proposed.directions
    ]
    block = {
        "purpose": proposed.purpose,
        "of": list(proposed.subject),
        "narrows": proposed.narrows,
        "directions": places,
        "scans": [
            {
                "theta_i_deg": each.theta_i_deg,
                "theta_r_deg": list(each.theta_r_deg),
                "step_deg": each.step_deg,
                "standard_error_left": each.gain,
            }
            for each in proposed.scans
        ],
        **({"turns_deg": list(proposed.turns_deg)} if proposed.turns_deg else {}),
    }
    return plain(block)


def next_picture_block(proposed: NextPicture) -> dict:
    """`fit --next` of photographs: what one more picture is for, and at which phase."""
    gain = "differ_by_noise" if proposed.purpose == "separate" else "standard_error_left"
    phases = [{"phase_deg": each.phase_deg, gain: each.gain} for each in proposed.phases]
    return plain({"purpose": proposed.purpose, "of": list(proposed.subject), "narrows": True, "phases": phases})


def _shows(row: Row, ranking: Ranking) -> Mapping:
    """What would show, of the recommended row alone."""
    return ranking.shows if row.fit is ranking.recommended.fit else {}


def _row(row: Row, measurement: Measurement, timing: bool, shows: Mapping) -> dict:
    fit = row.fit
    entry = {
        "rank": row.rank,
        "tied": row.tied,
        "model": fit.model.name,
        "candidate": fit.name,
        "freed": list(fit.model.free),
        "close": row.close,
        "off_percent": off_percent(row.rms_ln),
        "rms_ln": row.rms_ln,
        "seen": row.seen,
        "seen_words": seen.band_words(row.seen),
        "seen_says": seen.says(row.seen),
        "seen_from_best": row.from_best,
        "rms_ln_by_theta_i": {f"{theta:g}": value for theta, value in row.rms_ln_by_theta_i.items()},
        "errors": row.errors,
        "held_out_rms_ln": row.held_out.rms_ln if row.held_out else None,
        "held_out_highest": {"theta_i_deg": row.held_out.highest_theta_i_deg, "rms_ln": row.held_out.highest_rms_ln}
        if row.held_out
        else None,
        "held_out_fits": _held_out_fits(row, measurement),
        "growth": row.growth,
        "behind": row.behind,
        "behind_se": row.behind_se,
        "parameters": _parameters(fit, shows, measurement),
        "typed": _typed(fit),
        "free_parameters": fit.free,
        "instrument": _instrument(fit),
        "evaluations": fit.evaluations,
        "converged": fit.converged,
        "flags": [finding(each) for each in row.warnings],
    }
    if timing:
        entry |= {"time_per_sample_ns": row.ns_per_sample, "fit_time_s": fit.seconds, "on_front": row.on_front}
    return entry


def _instrument(fit: Fit) -> dict | None:
    """What was fitted beside the model: errors are without it. The values were that much too bright, the true angle is
    the reported one plus the zero."""
    found = fit.instrument
    if found is None:
        return None
    return {"zero_deg": found.zero_deg, "theta_i_deg": list(found.theta_i_deg), "ln_gains": list(found.ln_gains)}


def _held_out_fits(row: Row, measurement: Measurement) -> list[dict] | None:
    """What was searched for without each group of incidences or of turns, in the channels that were looked at."""
    if row.held_out is None:
        return None
    parameters, channels = row.fit.model.parameters, len(few_channels(len(measurement.channels)))
    return [
        {
            "theta_i_deg": fold.theta_i_deg,
            "turns_deg": fold.turns_deg,
            "values": {
                key: _of_channels(parameters[key], parameters[key].outside(value), channels)
                for key, value in fold.values.items()
            },
        }
        for fold in row.held_out.folds
    ]


def _held_out_on(ranking: Ranking, measurement: Measurement) -> dict | None:
    """Which directions and channels repeated fits looked at; None where those were all that have a value."""
    if not any(row.held_out for row in ranking.rows):
        return None
    rows, channels = thinned_rows(measurement), few_channels(len(measurement.channels))
    if (len(rows), len(channels)) == (np.count_nonzero(measurement.has_value), len(measurement.channels)):
        return None
    return {"rows": rows.tolist(), "channels": [measurement.channels[place] for place in channels]}


def _parameters(fit: Fit, shows: Mapping, measurement: Measurement) -> dict:
    """Every value, fitted or fixed, and what follows from them; at_bound is "low", "high" or null.

    Of those in `shows` also how well they are known, as two standard errors, and from which share of their value on a
    change begins to show; null: none within the bounds.
    """
    out, channels = {}, len(fit.surface.channels)
    at_bound = {warning.subject for warning in fit.warnings if warning.effect is Effect.AT_BOUND}
    for key, parameter in fit.model.parameters.items():
        value, stderr = fit.values[key], fit.stderr.get(key)
        ends = [end for end in ("low", "high") if key in at_bound and _at(parameter, value, end)]
        shown = [
            None if each is None else _of_channels(parameter, parameter.outside(each), channels)
            for each in (value, stderr)
        ]
        out[key] = {
            "value": shown[0],
            "stderr": shown[1],
            "unit": parameter.outside_unit,
            "at_bound": ends[0] if ends else None,
            "fitted": stderr is not None,
        }
        if key in shows:
            out[key] |= {"known_to": _known_to(value, stderr), "shows_from": shows[key]}
    for term in fit.model.terms:
        own = fit.surface.values_of(term)
        for derived in term.model.derived:
            out[f"{term.label}.{derived.name}"] = {
                "value": derived.of(**own),
                "stderr": None,
                "unit": derived.unit,
                "at_bound": None,
                "derived": True,
            }
    for key, known in errors_of_grain(fit, measurement).items():
        out[key] |= known
    out |= reflectances(fit, measurement)
    for warning in fit.warnings:
        if warning.effect is Effect.BOUNDS:
            key, numbers = warning.subject, dict(warning.numbers)
            out[key]["above"] = numbers["sigma_um_above"]
            out[key.removesuffix("sigma") + "tau"]["above"] = numbers["sigma_um_above"] / numbers["slope"]
    return out


def _of_channels(parameter, value, channels: int):
    """Of what belongs to channels an array with a value for each, also where it was held; of the rest a number."""
    if not parameter.per_channel or np.shape(value) == (channels,):
        return value
    return np.broadcast_to(value, channels)


def _typed(fit: Fit) -> dict:
    """name -> value of all that `evaluate` and `export --model` want; what is left out keeps its default."""
    return {
        key: _of_channels(parameter, parameter.outside(fit.values[key]), len(fit.surface.channels))
        for key, parameter in fit.model.parameters.items()
        if fit.stderr.get(key) is not None or not np.all(np.asarray(fit.values[key]) == parameter.default)
    }


def _known_to(value, stderr) -> float:
    """Two standard errors, as a share of the value; the median over channels."""
    value, stderr = np.broadcast_arrays(np.asarray(value, float), np.asarray(stderr, float))
    return float(np.median(2 * stderr[value > 0] / value[value > 0]))


def _at(parameter, value, end: str) -> bool:
    bound = getattr(parameter, end)
    return bool(np.any(np.abs(np.asarray(value) - bound) <= 1e-5 * max(abs(bound), 1e-9)))


def _round(value: float) -> float:
    return float(f"{value:.6g}")
