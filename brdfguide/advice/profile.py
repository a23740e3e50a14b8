"""What the numbers of a profilometer and a total scatter say of rms height and correlation length, and by which key.

Heights are taken as Gaussian, and so is their correlation (`physics.profile_numbers`). A spectrum in a file is read
where the description is read: under `stylus.spectrum` then stand the height, the slope and the waves that it tells of.
"""

from collections.abc import Mapping
from math import cos, erf, log1p, pi, radians, sqrt
from pathlib import Path

from ..errors import InputError
from ..opening import exists, is_plain
from ..physics import profile_numbers
from ..physics.emergence import WAVELENGTH
from ..records import dataclass
from ..yaml_schema import Document

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
    if told := stylus.get("spectrum"):
        how = f"rms height {told['rq_um']:.3g} µm: of the spectrum in {told['file']}, {_waves(told)}"
        return Known("stylus.spectrum", told["rq_um"], how)
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
    told = stylus.get("spectrum")
    if key is None and told:
        tau = profile_numbers.tau_from_slope(told["rq_um"], told["rdq"])
        return Known("stylus.spectrum", tau, f"correlation length {tau:.3g} µm: √2 Rq/Rdq of the spectrum")
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
    low, high = band_of(stylus)
    if not low and high is None:
        return None
    return max((1.0 if high is None else _within(tau, high)) - _within(tau, low), 0.0)


def band_of(stylus: Mapping) -> tuple[float, float | None]:
    """Spatial frequencies [1/µm] that a profile holds: 0 and None where no cut-off is known."""
    stated = stylus.get("spectrum", {}) | {key: stylus[key] for key in ("cutoff_um", "shortest_um") if key in stylus}
    low = 1 / stated["cutoff_um"] if "cutoff_um" in stated else 0.0
    return low, 1 / stated["shortest_um"] if "shortest_um" in stated else None


def spectrum_at(name: str, description: Document) -> Path:
    """The spectrum's file beside the description that names it.

    Raises InputError unless it is a plain file whose header is a spectrum's: a description comes from other people, and
    may name any file that we can read, so that nothing of another one is quoted.
    """
    from ..data.spectrum_file import is_spectrum

    path = Path(description.name).parent / name
    if not exists(path):
        raise InputError(description.at("stylus.spectrum", f"its spectrum {path}: there is no such file"))
    if not is_plain(path) or not is_spectrum(path):
        wanted = "wanted two columns with the header `f (1/um), S (um^3)` or `S (um^4)`"
        raise InputError(description.at("stylus.spectrum", f"its spectrum {path} is none; {wanted}"))
    return path


def with_spectrum(description: Document) -> Mapping:
    """Observations with what the spectrum's file tells in place of its name: rq_um, rdq and both ends of its waves.

    Raises InputError for a file that is none.
    """
    name = description.values.get("stylus", {}).get("spectrum")
    if not isinstance(name, str):
        return description.values
    from ..data.spectrum_file import read_spectrum
    from ..physics import height_spectrum

    found = read_spectrum(spectrum_at(name, description))
    if found.profile:
        rq, rdq = height_spectrum.profile_height(found), height_spectrum.profile_slope(found)
    else:
        rq, rdq = height_spectrum.surface_height(found), height_spectrum.surface_gradient(found) / sqrt(2)
    low, high = found.ends
    told = {"file": name, "rq_um": rq, "rdq": rdq, "cutoff_um": 1 / low, "shortest_um": 1 / high, "points": found}
    return {**description.values, "stylus": {**description.values["stylus"], "spectrum": told}}


def _waves(told: Mapping) -> str:
    return f"waves of {told['shortest_um']:.3g} to {told['cutoff_um']:.3g} µm"


def _within(tau: float, frequency: float) -> float:
    """Share of the variance below a frequency [1/µm]."""
    return erf(pi * tau * frequency)
