"""The stability audit: every law of every model, how far it was missed at worst and where."""

from dataclasses import dataclass, field, replace

import numpy as np

from . import laws, limits
from .models import Model, get, names, term
from .references import REFERENCES, RTOL, evaluate

# law -> how it is measured, how much may be missed, in words
LAWS = {
    "references": (laws.references, RTOL, "relative error against values computed at 50 or more digits"),
    "finite": (laws.finite, 0.0, "overflow, 0/0, or no number, over the whole box of parameters"),
    "positive": (laws.positive, 0.0, "negative values, of the greatest"),
    "horizon": (laws.horizon, 0.0, "what is sent from or to below the horizon"),
    "reciprocity": (laws.reciprocity, 1e-12, "relative change when light and detector change places"),
    "rotation": (laws.rotation, 1e-8, "relative change when the surface is turned"),
    "energy": (laws.energy, 2e-3, "reflectance above 1, to 0.01° from grazing"),
    "normal": (limits.normal, 1e-6, "relative change within 1e-9° of the normal"),
    "grazing": (limits.grazing, 0.0, "no value 1e-9° above the horizon"),
    "n to 1": (limits.weak, 1e-5, "departure from (n - 1)² as the interface vanishes"),
    "k to infinity": (limits.opaque, 1e-7, "departure from F = 1"),
    "smooth": (limits.smooth, 2e-3, "narrowest lobe against a mirror"),
    "continuity": (laws.continuity, 1e-7, "jump along a parameter or an angle"),
    "gradient": (laws.gradient, 1e-5, "analytic derivatives against differences"),
    "condition": (laws.condition, 1e4, "condition number of the fitted parameters at the defaults"),
}


@dataclass(frozen=True)
class Check:
    """One law, tried on one model."""

    model: str
    law: str
    cases: int
    worst: float
    allowed: float
    at: dict = field(default_factory=dict)
    verdict: str = "holds"  # holds, declared, fails
    reason: str = ""


def audit(expressions=(), wanted=tuple(LAWS)):
    """Checks, one by one, of the terms that the expressions name, or of every model and of the interface below them."""
    found = {each.model.name: each.model for expression in expressions for each in get(expression).terms}
    for model in found.values() or map(term, names()):
        yield from audit_term(model, wanted)
    if not found and "references" in wanted:
        yield fresnel_references()


def audit_term(model: Model, wanted=tuple(LAWS)):
    """Every law that has a case for this model."""
    for law in wanted:
        measure, allowed, _ = LAWS[law]
        try:
            with np.errstate(over="raise", divide="raise", invalid="raise"):
                outcome = measure(model)
        except FloatingPointError as error:
            outcome = laws.Outcome(1, float("inf"), {"error": str(error)})
        if outcome.cases:
            yield judged(model, law, outcome, allowed)


def judged(model: Model, law: str, outcome: laws.Outcome, allowed: float) -> Check:
    """A law that a model declares to break must be seen broken: a declaration that is out of date fails too."""
    holds, reason = outcome.worst <= allowed, model.breaks.get(law, "")
    verdict = ("holds" if holds else "fails") if not reason else ("fails" if holds else "declared")
    if reason and holds:
        reason = f"declared as broken but it holds: {reason}"
    return Check(model.name, law, outcome.cases, outcome.worst, allowed, outcome.at, verdict, reason)


def audit_surface(name: str, brdf, breaks):
    """Every law that needs no other parameters, for a surface whose values are already in `brdf(geom)`.

    `breaks` says what its terms break somewhere; here it may well hold.
    """
    frozen = Model(name, brdf, parameters=())
    for check in audit_term(frozen, tuple(law for law in LAWS if law != "references")):
        if check.verdict == "fails" and check.law in breaks:
            check = replace(check, verdict="declared", reason=breaks[check.law])
        yield check


def fresnel_references() -> Check:
    """The interface that many models share, at its stiff points."""
    worst = laws.Worst()
    for point in REFERENCES:
        if point.model == "fresnel":
            worst.see(abs(evaluate(point) - point.right) / abs(point.right), point.geom, point.values, why=point.why)
    outcome = worst.outcome()
    return Check("fresnel", "references", outcome.cases, outcome.worst, RTOL, outcome.at, "holds" if outcome.worst <= RTOL else "fails")
