"""Where the eye and the instrument disagree: a description's values beside the fitted ones."""

from math import pi

import numpy as np

from .candidates import KINDS
from .measurement import Finding, Measurement
from .ranking import Ranking
from .recommend import Recommendation
from .verdict import Verdict

FACTOR = 1.5  # widths and albedos further apart than this disagree (ours; twice what two observers differ by)


def disagreements(told: Recommendation, measured: Verdict, ranked: Ranking, measurement: Measurement) -> tuple[Finding, ...]:
    """What the description says and the measurement denies, each with both numbers."""
    best = ranked.recommended.fit
    found = [_kind(told, measured), _width(told, best), _albedo(told, best), _mirror_image(told, best), _choice(told, best)]
    return tuple(each for each in found if each is not None)


def _kind(told: Recommendation, measured: Verdict) -> Finding | None:
    if told.material.kind not in KINDS or measured.kind not in KINDS or told.material.kind == measured.kind:
        return None
    text = f"described as a {told.material.kind}, measured as a {measured.kind}: {measured.evidence[0]}"
    return Finding("kind-disagrees", text, "warning", "the description's kind chose the candidates")


def _width(told: Recommendation, best) -> Finding | None:
    fitted = [float(np.median(value)) for key, value in best.values.items() if key.endswith(".alpha")]
    fitted += [2 * float(np.median(value)) for key, value in best.values.items() if key.endswith(".slope")]
    seen = told.material.alpha
    if not fitted or not seen or 1 / FACTOR <= fitted[0] / seen <= FACTOR:
        return None
    by = told.material.filled_by.get("alpha", "observed")
    return Finding("width-disagrees", f"alpha {seen:.3g} by eye or description ({by}), {fitted[0]:.3g} by the fit of {best.model.name}", "note", "the fit is used")


def _albedo(told: Recommendation, best) -> Finding | None:
    fitted = next((float(np.mean(value)) for key, value in best.values.items() if key.endswith(".albedo")), None)
    seen = sum(told.material.albedo) / len(told.material.albedo) if told.material.albedo else None
    if fitted is None or not seen or fitted > 0 and 1 / FACTOR <= fitted / seen <= FACTOR:
        return None
    by = told.material.filled_by.get("albedo", "observed")
    return Finding("albedo-disagrees", f"albedo {seen:.3g} by eye or description ({by}), {fitted:.3g} by the fit of {best.model.name}", "note", "the fit is used")


def _mirror_image(told: Recommendation, best) -> Finding | None:
    sigma = next((float(value) for key, value in best.values.items() if key == "he-torrance.sigma"), None)
    if told.material.emerges is not False or sigma is None or (4 * pi * sigma / (told.material.wavelength or 0.55)) ** 2 > 20:
        return None
    return Finding("mirror-image-disagrees", f"no mirror image was seen, yet the fit's sigma of {sigma:.2g} µm would show one", "note", "look again toward grazing")


def _choice(told: Recommendation, best) -> Finding | None:
    picks = [each.model.name for each in told.candidates]
    if not picks or best.model.name == picks[0]:
        return None
    where = "among the guidelines' others" if best.model.name in picks else "not among the guidelines' candidates"
    return Finding("choice-disagrees", f"the guidelines would choose {picks[0]}, the fit chooses {best.model.name}, {where}", "note", "the fit decides")
