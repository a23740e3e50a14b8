"""Where the eye and the instrument disagree: a description's values beside the fitted ones."""

from math import pi

import numpy as np

from ..data.measurement import Measurement
from ..data.metal_or_dielectric import Verdict
from ..finding import Finding
from ..fitting.ranked import Ranking
from ..flags import Effect
from ..models.candidates import KINDS
from .recommend import Recommendation

HEIGHTS_APART = 2.0  # rms heights further apart than this disagree: a stylus and light differ in what they reach (ours)
FACTOR = 1.5  # widths and albedos further apart than this disagree (ours; twice what two observers differ by)


def disagreements(
    described: Recommendation, measured: Verdict, ranked: Ranking, measurement: Measurement
) -> tuple[Finding, ...]:
    """What the description says and the measurement denies, each with both numbers."""
    best = ranked.recommended.fit
    found = [
        _kind(described, measured),
        _width(described, best),
        _albedo(described, best),
        _height(described, ranked),
        _mirror_image(described, best),
        _choice(described, best),
    ]
    return tuple(each for each in found if each is not None)


def _kind(described: Recommendation, measured: Verdict) -> Finding | None:
    if described.material.kind not in KINDS or measured.kind not in KINDS or described.material.kind == measured.kind:
        return None
    text = f"described as a {described.material.kind}, measured as a {measured.kind}: {measured.evidence[0]}"
    return Finding("kind-disagrees", text, "warning", "the description's kind chose the candidates")


def _width(described: Recommendation, best) -> Finding | None:
    fitted = [float(np.median(value)) for key, value in best.values.items() if key.endswith(".alpha")]
    fitted += [2 * float(np.median(value)) for key, value in best.values.items() if key.endswith(".slope")]
    observed = described.material.alpha
    if not fitted or not observed or 1 / FACTOR <= fitted[0] / observed <= FACTOR:
        return None
    by = described.material.filled_by.get("alpha", "observed")
    return Finding(
        "width-disagrees",
        f"alpha {observed:.3g} by eye or description ({by}), {fitted[0]:.3g} by the fit of {best.model.name}",
        "note",
        "the fit is used",
    )


def _albedo(described: Recommendation, best) -> Finding | None:
    fitted = next((float(np.mean(value)) for key, value in best.values.items() if key.endswith(".albedo")), None)
    observed = sum(described.material.albedo) / len(described.material.albedo) if described.material.albedo else None
    if fitted is None or not observed or fitted > 0 and 1 / FACTOR <= fitted / observed <= FACTOR:
        return None
    by = described.material.filled_by.get("albedo", "observed")
    return Finding(
        "albedo-disagrees",
        f"albedo {observed:.3g} by eye or description ({by}), {fitted:.3g} by the fit of {best.model.name}",
        "note",
        "the fit is used",
    )


def _height(described: Recommendation, ranked: Ranking) -> Finding | None:
    """A stylus' rms height beside that of the nearest wave-optical fit, where the data tell it."""
    stylus, material = described.material.sigma, described.material
    rows = [ranked.recommended, *ranked.rows]
    fits = [row.fit for row in rows if not any(each.effect is Effect.UNREFINED for each in row.fit.warnings)]
    found = next(((fit, key) for fit in fits for key in fit.stderr if key.endswith(".sigma")), None)
    if not stylus or "sigma" in material.filled_by or found is None:
        return None
    fit, key = found
    sigma, slopes_alone = float(np.median(fit.values[key])), fit.has("rough-regime", key)
    apart = stylus / sigma
    if slopes_alone or fit.has("at-bound", key) or 1 / HEIGHTS_APART <= apart <= HEIGHTS_APART:
        return None
    return Finding(
        "height-disagrees",
        f"rms height {stylus:.3g} µm by the stylus, {sigma:.3g} µm by the fit of {fit.name}: a factor "
        f"{max(apart, 1 / apart):.2g}",
        "warning",
        "a profile holds waves too long to spread light, or the sheet names another surface; the fit is used",
        numbers=(("stylus_um", float(stylus)), ("fitted_um", sigma)),
    )


def _mirror_image(described: Recommendation, best) -> Finding | None:
    waves = (term.label for term in best.model.terms if term.model.is_lobe and "sigma" in term.model.defaults())
    sigma = next((float(np.median(best.values[f"{label}.sigma"])) for label in waves), None)
    if (
        described.material.emerges is not False
        or sigma is None
        or (4 * pi * sigma / (described.material.wavelength or 0.55)) ** 2 > 20
    ):
        return None
    return Finding(
        "mirror-image-disagrees",
        f"no mirror image was seen, yet the fit's sigma of {sigma:.2g} µm would show one",
        "note",
        "look again toward grazing",
    )


def _choice(described: Recommendation, best) -> Finding | None:
    picks = [each.model.name for each in described.candidates]
    if not picks or best.model.name == picks[0]:
        return None
    where = "among the guidelines' others" if best.model.name in picks else "not among the guidelines' candidates"
    return Finding(
        "choice-disagrees",
        f"the guidelines would choose {picks[0]}, the fit chooses {best.model.name}, {where}",
        "note",
        "the fit decides",
    )
