"""Where the eye and the instrument disagree: a description's values beside the fitted ones."""

from collections.abc import Mapping
from math import pi

import numpy as np

from ..data.measurement import Measurement
from ..data.metal_or_dielectric import Verdict
from ..finding import Finding
from ..fitting.ranked import Ranking
from ..fitting.three_ways import LEAST_SHARED
from ..flags import Effect
from ..models.candidates import KINDS
from ..physics.height_spectrum import GaussianSpectrum, KCorrelation, Spectrum, profile_height
from ..physics.smooth_scatter import frequency
from .profile import band_of
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
        _height(described, ranked, measurement),
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


def _height(described: Recommendation, ranked: Ranking, measurement: Measurement) -> Finding | None:
    """A stylus' rms height beside that of the nearest fit that has one, where the data tell it; where the cut-offs of
    the stylus are known, over the waves that it shares with the light alone."""
    material = described.material
    rows = [ranked.recommended, *ranked.rows]
    fits = [row.fit for row in rows if not any(each.effect is Effect.UNREFINED for each in row.fit.warnings)]
    found = next(((fit, term) for fit in fits for term in fit.model.terms if _has_height(fit, term)), None)
    spectrum = None if found is None else _heights_of(*found)
    if not material.sigma or "sigma" in material.filled_by or found is None or spectrum is None:
        return None
    fit, sigma, stylus = found[0], spectrum.height, material.sigma
    band = _common_band(material.given.get("stylus", {}), measurement)
    where = ""
    if band is not None:
        shared = _in_common(material.given["stylus"], stylus, spectrum, *band)
        if shared is None:
            return None
        stylus, sigma = shared
        where = f" (both in waves of {1 / band[1]:.3g} to {1 / band[0]:.3g} µm, which both see)"
    apart = stylus / sigma
    if 1 / HEIGHTS_APART <= apart <= HEIGHTS_APART:
        return None
    return Finding(
        "height-disagrees",
        f"rms height {stylus:.3g} µm by the stylus, {sigma:.3g} µm by the fit of {fit.name}{where}: a factor "
        f"{max(apart, 1 / apart):.2g}",
        "warning",
        "a profile holds waves too long to spread light, or the sheet names another surface; the fit is used"
        if band is None
        else "one of the two has another scale, or something else than heights scatters; the fit is used",
        numbers=(("stylus_um", float(stylus)), ("fitted_um", sigma)),
    )


def _has_height(fit, term) -> bool:
    """Whether a height was fitted of a term, as it is or by its spectrum."""
    return term.keys.get("sigma") in fit.stderr or term.model.name == "abc"


def _heights_of(fit, term) -> GaussianSpectrum | KCorrelation | None:
    """The spectrum of a term's heights, where the data tell them; else None."""
    values = {name: float(np.median(value)) for name, value in fit.surface.model.of_term(term, fit.values).items()}
    if term.model.name == "abc":
        spectrum = KCorrelation(values["a"], values["b"], values["c"])
        return spectrum if np.isfinite(spectrum.height) and not fit.has("at-bound", term.key("c")) else None
    key = term.keys["sigma"]
    if fit.has("rough-regime", key) or fit.has("at-bound", key):  # slopes alone
        return None
    return GaussianSpectrum(values["sigma"], values["sigma"] / values["slope"])


def _common_band(stylus: Mapping, measurement: Measurement) -> tuple[float, float] | None:
    """Spatial frequencies [1/µm] that the profile and the light both see; None where no cut-off is known."""
    low, high = band_of(stylus)
    if not low and high is None:
        return None
    nu = frequency(measurement.geom)[measurement.geom.vxy2[:, 0] > 0]
    return max(low, float(nu.min())), min(float(nu.max()), high or np.inf)


def _in_common(
    given: Mapping, height: float, spectrum: Spectrum, low: float, high: float
) -> tuple[float, float] | None:
    """Rms heights [µm] of the profile and of the fit over a band; None where less than half of the profile's variance
    lies in it. A profile without a spectrum of its own has as much of its variance there as the fit says."""
    if not low < high:
        return None
    own_low, own_high = band_of(given)
    told = given.get("spectrum", {}).get("points", spectrum)
    share = (profile_height(told, low, high) / profile_height(told, own_low or None, own_high)) ** 2
    if share < LEAST_SHARED:
        return None
    return height * float(np.sqrt(share)), profile_height(spectrum, low, high)


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
