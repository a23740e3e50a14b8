"""The stability audit: every check of every model, how far it was missed at worst and where."""

from dataclasses import field, replace

import numpy as np

from ..models import Model, get, names, term
from ..records import dataclass
from . import checks, limits
from .references import REFERENCES, RTOL, our_value
from .trials import Outcome, Worst

# check -> how it is measured, how much may be missed, in words
CHECKS = {
    "references": (checks.references, RTOL, "relative error against values computed at 50 or more digits"),
    "finite": (checks.finite, 0.0, "overflow, 0/0, or no number, over the whole box of parameters"),
    "positive": (checks.positive, 0.0, "negative values, of the greatest"),
    "horizon": (checks.horizon, 0.0, "what is sent from or to below the horizon"),
    "reciprocity": (checks.reciprocity, 1e-12, "relative change when light and detector change places"),
    "rotation": (checks.rotation, 1e-8, "relative change when the surface is turned"),
    "grain": (checks.grain, 1e-8, "relative change when surface and axis are turned, or both widths change places"),
    "energy": (checks.energy, 1e-3, "reflectance above 1, to 0.01° from grazing"),
    "normal": (limits.normal, 1e-6, "relative change within 1e-9° of the normal"),
    "grazing": (limits.grazing, 0.0, "no value 1e-9° above the horizon"),
    "n to 1": (limits.weak, 1e-5, "departure from (n - 1)² as the interface vanishes"),
    "k to infinity": (limits.opaque, 1e-7, "departure from F = 1"),
    "smooth": (limits.smooth, 2e-3, "narrowest lobe against a mirror"),
    "continuity": (checks.continuity, 1e-7, "jump along a parameter or an angle"),
    "gradient": (checks.gradient, 1e-5, "analytic derivatives against differences of sixth order"),
    "condition": (checks.condition, 1e4, "condition number of the fitted parameters at the defaults"),
}


@dataclass(frozen=True)
class Result:
    """One check of one model."""

    model: str
    check: str
    cases: int
    worst: float
    allowed: float
    at: dict = field(default_factory=dict)
    verdict: str = "holds"  # holds, declared, fails
    reason: str = ""


def audit(expressions=(), wanted=tuple(CHECKS)):
    """Results, one by one, of the terms that the expressions name, or of every model and the interface below them."""
    found = {each.model.name: each.model for expression in expressions for each in get(expression).terms}
    for model in found.values() or map(term, names()):
        yield from audit_term(model, wanted)
    if not found and "references" in wanted:
        yield fresnel_references()


def audit_term(model: Model, wanted=tuple(CHECKS)):
    """Every check that has a case for this model."""
    for check in wanted:
        measure, allowed, _ = CHECKS[check]
        try:
            with np.errstate(over="raise", divide="raise", invalid="raise"):
                outcome = measure(model)
        except FloatingPointError as error:
            outcome = Outcome(1, float("inf"), {"error": str(error)})
        if outcome.cases:
            yield against_declaration(model, check, outcome, allowed)


def against_declaration(model: Model, check: str, outcome: Outcome, allowed: float) -> Result:
    """What a model declares to break must be seen broken: a declaration that is out of date fails too."""
    holds, reason = outcome.worst <= allowed, model.breaks.get(check, "")
    if holds and model.base is not None:  # under a coat a law may keep what it breaks in the open
        reason = ""
    verdict = "holds" if holds else "fails"
    if reason and holds:
        verdict, reason = "fails", f"declared as broken but it holds: {reason}"
    elif reason:
        verdict = "declared"
    return Result(model.name, check, outcome.cases, outcome.worst, allowed, outcome.at, verdict, reason)


def audit_surface(name: str, brdf, breaks):
    """Every check that needs no other parameters, for a surface whose values are already in `brdf(geom)`.

    `breaks` says what its terms break somewhere; here it may well hold.
    """
    frozen = Model(name, brdf, parameters=())
    for result in audit_term(frozen, tuple(check for check in CHECKS if check != "references")):
        if result.verdict == "fails" and result.check in breaks:
            result = replace(result, verdict="declared", reason=breaks[result.check])
        yield result


def fresnel_references() -> Result:
    """The interface that many models share, at its stiff points."""
    worst = Worst()
    for point in REFERENCES:
        if point.model == "fresnel":
            worst.see(abs(our_value(point) - point.right) / abs(point.right), point.geom, point.values, why=point.why)
    outcome = worst.outcome()
    return Result(
        "fresnel",
        "references",
        outcome.cases,
        outcome.worst,
        RTOL,
        outcome.at,
        "holds" if outcome.worst <= RTOL else "fails",
    )
