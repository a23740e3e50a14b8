"""What a scene does not need, as a document."""

from math import degrees

from ...physics import seen
from ...scene.difference import Errors
from ...scene.features import Ablation
from ...scene.prune import Pruned, Single
from ...scene.search import Candidate
from .findings import finding
from .plain import plain


def document(found: Pruned, timing: bool = True) -> dict:
    """The `scene` block of `fit --json` and `recommend --json`."""
    scene = found.scene
    block = {
        "name": scene.name,
        "file": scene.source or None,
        "assumptions": scene.describe(),
        "unit": "JND" if scene.colour == "grey" else "Delta E ITP",
        "tolerance": {"worst": scene.tolerance.worst, "p95": scene.tolerance.p95, "look": scene.tolerance.look},
        "model": found.whole.model.name,
        "pruned": found.surface.model.name,
        "without": names_of(found.ablation),
        "other_law": found.substitute,
        "parameters": {
            key: _outside(found.surface.model.parameters[key], value) for key, value in found.surface.values.items()
        },
        "seen": found.seen,
        "seen_words": seen.band_words(found.seen),
        "error": errors(found.errors),
        "error_fresh": errors(found.fresh),
        "error_strayed": [{"angles_times": factor, **errors(each)} for factor, each in found.moved.items()],
        "parts": [_single(each, timing) for each in found.singles],
        "operations": {"whole": dict(found.operations[0]), "pruned": dict(found.operations[1])},
        "pareto": [_candidate(each, found, timing) for each in found.pareto],
        "next_cheaper": _next(found, -1),
        "next_better": _next(found, 1),
        "box": {name: [round(low, 2), round(high, 2)] for name, (low, high) in found.box_deg.items()},
        "quadrature": {
            "pixels": found.pixels,
            "skipped_dark": found.skipped,
            "convergence": found.convergence,
            "seed": found.seed,
            "listed": bool(scene.pairs),
        },
        "findings": [finding(each) for each in found.findings],
    }
    if timing:
        block["time_per_sample_ns"] = {
            "whole": found.whole_time.ns,
            "pruned": found.time.ns,
            "saved": found.saving.ns if found.ablation.out else 0.0,
            "saved_stderr": found.saving.stderr if found.ablation.out else 0.0,
        }
    return plain(block)


def left_out(found: Pruned, timing: bool = True) -> list[dict]:
    """The parts left out, as the `left_out` list of a fit's document."""
    return plain(
        [
            {
                "term": str(each.feature),
                "error": errors(each.errors),
                "saving_ns": each.saving.ns if timing and each.saving.measurable else None,
                "why": f"replaced by {found.surface.model.terms[-1].label}"
                if found.substitute and not each.feature.name
                else f"changes {found.scene.name} by {each.errors.visible:.2g} {_unit(found)} at worst",
            }
            for each in found.singles
            if each.left_out
        ]
    )


def errors(each: Errors) -> dict:
    return {
        "mean": each.mean,
        "p95": each.p95,
        "worst": each.worst,
        "worst_visible": each.visible,
        "worst_codes": each.codes,
        "at": dict(zip(("theta_i_deg", "theta_r_deg", "phi_deg"), each.at_deg, strict=True)),
    }


def names_of(ablation: Ablation) -> list[str]:
    return [str(feature) for feature in sorted(ablation.out)]


def _single(each: Single, timing: bool) -> dict:
    entry = {
        "part": str(each.feature),
        "left_out": each.left_out,
        "error_alone": errors(each.errors),
        "bound": each.bound,
    }
    return entry | (
        {
            "saving_ns": each.saving.ns,
            "saving_stderr_ns": each.saving.stderr,
            "saving_measurable": each.saving.measurable,
        }
        if timing
        else {}
    )


def _candidate(each: Candidate, found: Pruned, timing: bool) -> dict:
    entry = {
        "model": each.surface.model.name,
        "without": names_of(each.ablation),
        "other_law": each.substitute,
        "worst": each.errors.visible,
        "p95": each.errors.p95,
        "operations": each.work,
        "picked": each.surface is found.surface,
    }
    return entry | ({"time_per_sample_ns": each.time.ns} if timing else {})


def _next(found: Pruned, step: int) -> dict | None:
    """The neighbour of the pick on the Pareto list, by cost."""
    work = next((each.work for each in found.pareto if each.surface is found.surface), None)
    if work is None:
        return None
    others = [each for each in found.pareto if (each.work - work) * step > 0]
    pick = min(others, key=lambda each: abs(each.work - work), default=None)
    return (
        {
            "model": pick.surface.model.name,
            "without": names_of(pick.ablation),
            "worst": pick.errors.visible,
            "operations": pick.work,
        }
        if pick
        else None
    )


def _outside(parameter, value):
    """A value with angles in degrees."""
    turn = degrees if parameter.unit == "rad" else float
    return turn(value) if not hasattr(value, "__len__") else [turn(each) for each in value]


def _unit(found: Pruned) -> str:
    return "JND" if found.scene.colour == "grey" else "ΔE_ITP"
