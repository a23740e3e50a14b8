"""What the numbers of a profilometer and a total scatter say of rms height and correlation length, and by which key.

Heights are taken as Gaussian, and so is their correlation (`physics.profile_numbers`).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import cos, erf, log1p, pi, radians, sqrt

from ..physics import profile_numbers
from ..physics.emergence import WAVELENGTH

# keys of a height, the most direct first -> rms height over it
HEIGHTS = {
    "sigma_um": 1.0,
    "rq_um": 1.0,
    "sq_um": 1.0,
    "ra_um": profile_numbers.RQ_OF_RA,
    "sa_um": profile_numbers.RQ_OF_RA,
}
LENGTHS = ("tau_um", "rsm_um", "rdq", "sdq")


@dataclass(frozen=True)
class Known:
    """A length [µm], the key that told it, and how in words; no words where it was told itself."""

    key: str
    value: float
    how: str = ""


def height_of(given: Mapping) -> Known | None:
    """Rms height by a profile, else by a total scatter."""
    stylus = given.get("stylus", {})
    for key, factor in HEIGHTS.items():
        if key in stylus:
            name = key.removesuffix("_um").capitalize()
            how = (
                f"rms height {factor * stylus[key]:.4g} µm: 1.2533 {name}, heights being Gaussian"
                if factor != 1
                else ""
            )
            return Known(f"stylus.{key}", factor * stylus[key], how)
    if tis := given.get("tis"):
        light = tis.get("wavelength_nm", 1000 * WAVELENGTH) / 1000
        sigma = light * sqrt(-log1p(-tis["share"])) / (4 * pi * cos(radians(tis.get("theta_i_deg", 0.0))))
        return Known(
            "tis", sigma, f"rms height {sigma:.3g} µm: TIS = 1 - exp(-(4π sigma cos θi/λ)²) at {1000 * light:g} nm"
        )
    return None


def length_of(given: Mapping) -> Known | None:
    """Correlation length, by a spacing or a slope beside the height."""
    stylus, height = given.get("stylus", {}), height_of(given)
    key = next((each for each in LENGTHS if each in stylus), None)
    if key == "tau_um":
        return Known("stylus.tau_um", stylus[key])
    if key == "rsm_um":
        tau = profile_numbers.tau_from_spacing(stylus[key])
        return Known(
            "stylus.rsm_um", tau, f"correlation length {tau:.3g} µm: RSm/(√2 π), the correlation being Gaussian"
        )
    if key is None or height is None:
        return None
    rdq = stylus[key] / sqrt(2) if key == "sdq" else stylus[key]
    tau = profile_numbers.tau_from_slope(height.value, rdq)
    how = f"correlation length {tau:.3g} µm: √2 Rq/Rdq, alpha = √2 Rdq = {profile_numbers.alpha_from_slope(rdq):.3g}"
    return Known(f"stylus.{key}", tau, how)


def kept(stylus: Mapping, tau: float) -> float | None:
    """Share of the variance of a Gaussian correlation of length tau [µm] that the cut-offs leave; None without any.

    1 - (variance of waves longer than λc) - (of waves shorter than λs), each of S1 ∝ exp(-(π tau ν)²).
    """
    if not stylus.keys() & {"cutoff_um", "shortest_um"}:
        return None
    shorter = _within(tau, 1 / stylus["shortest_um"]) if "shortest_um" in stylus else 1.0
    longer = _within(tau, 1 / stylus["cutoff_um"]) if "cutoff_um" in stylus else 0.0
    return max(shorter - longer, 0.0)


def _within(tau: float, frequency: float) -> float:
    """Share of the variance below a frequency [1/µm]."""
    return erf(pi * tau * frequency)
