"""One polished surface told three times, by its scatter, its profile and its total scatter: whether they agree, over
which band, and which assumption fails first where they do not.

The scan gives the spectrum of the heights (Rayleigh and Rice), and so what a profile and an integrating sphere should
have read. Each is compared in the band that it shares with the scan alone.
"""

import numpy as np

from ..physics import hemisphere, smooth_scatter
from ..physics.height_spectrum import Spectrum, TabulatedSpectrum, profile_height
from ..records import dataclass

TOLERANCE = 0.25  # of a variance or a total: 10 % of a height or of a scatterometer's scale, twice (ours)
LEAST_SHARED = 0.5  # of a profile's variance that has to lie in the scan's frequencies
ALIKE = 0.2  # by which two ratios may differ and still have one cause (ours)


@dataclass(frozen=True, eq=False)
class Profile:
    """What a profilometer read between its cut-offs [1/µm]: a height [µm], or a spectrum."""

    band: tuple[float, float]
    rq: float | None = None
    spectrum: Spectrum | None = None


@dataclass(frozen=True)
class Total:
    """Light gathered beyond an angle from the mirror direction, as a share of what is reflected."""

    tis: float
    wavelength: float  # [µm]
    theta_i_deg: float
    stop_deg: float


@dataclass(frozen=True)
class Compared:
    """One reading against what the scan expects of it."""

    what: str  # profile, TIS
    read: float  # Rq [µm] or TIS
    expected: float
    ratio: float  # of variances, or of totals
    band: tuple[float, float]  # [1/µm], in which it was compared
    shared: float  # part of what is expected that comes from the frequencies of the scan

    @property
    def agrees(self) -> bool:
        return abs(np.log(self.ratio)) < np.log1p(TOLERANCE)

    @property
    def comparable(self) -> bool:
        return self.shared >= LEAST_SHARED


@dataclass(frozen=True)
class Agreement:
    """The three, and which assumption fails first."""

    compared: tuple[Compared, ...]
    phase: float  # (4π sigma cos θi/λ)² by the scan
    fails: str  # the code of an assumption, "" where all agree
    because: str

    @property
    def agree(self) -> bool:
        return not self.fails


def agreement(spectrum: TabulatedSpectrum, phase: float, profile: Profile | None, total: Total | None) -> Agreement:
    """What a profile and a total scatter say beside the spectrum that a scan shows; `phase` of its heights."""
    compared = []
    if profile is not None:
        compared.append(_with_profile(spectrum, profile))
    if total is not None:
        compared.append(_with_total(spectrum, total))
    fails, because = _first_failure(tuple(compared), phase)
    return Agreement(tuple(compared), phase, fails, because)


def _with_profile(spectrum: TabulatedSpectrum, profile: Profile) -> Compared:
    low, high = profile.band
    inside = max(low, spectrum.ends[0]), min(high, spectrum.ends[1])
    overlap = inside[0] < inside[1]
    if profile.spectrum is not None and overlap:
        read, expected = (profile_height(each, *inside) for each in (profile.spectrum, spectrum))
        return Compared("profile", read, expected, (read / expected) ** 2, inside, 1.0)
    read = profile_height(profile.spectrum, low, high) if profile.spectrum is not None else profile.rq or 0.0
    expected = profile_height(spectrum, low, high)
    shared = (profile_height(spectrum, *inside) / expected) ** 2 if overlap else 0.0
    return Compared("profile", read, expected, (read / expected) ** 2, (low, high), shared)


def _with_total(spectrum: TabulatedSpectrum, total: Total) -> Compared:
    """Rayleigh and Rice's scatter of the spectrum, added up beyond the stop."""
    stop2 = (2 * np.sin(np.radians(total.stop_deg) / 2)) ** 2
    low, high = spectrum.ends

    def lobe(geom, known_only=False):
        geom = geom.at(total.wavelength)
        nu = smooth_scatter.frequency(geom)
        brdf = smooth_scatter.rayleigh_rice(geom, spectrum.of_surface(np.maximum(nu, 1e-12)), 1.0)
        counts = geom.mirror_distance2 >= stop2
        return np.where(counts & ((nu >= low) & (nu <= high) if known_only else True), brdf, 0.0)

    def of_scan(geom):
        return lobe(geom, known_only=True)

    whole, known = (float(hemisphere.dhr(each, (total.theta_i_deg,))[0, 0]) for each in (lobe, of_scan))
    first = smooth_scatter.frequency_at(total.stop_deg, total.wavelength), 1 / total.wavelength
    expected = -np.expm1(-whole)
    return Compared("TIS", total.tis, expected, total.tis / expected, first, known / whole)


def _first_failure(compared: tuple[Compared, ...], phase: float) -> tuple[str, str]:
    """The assumption that fails first, and how that shows: smoothness, then bands, then which reading stands alone."""
    if phase >= smooth_scatter.SMOOTH:
        return "smooth", (
            f"the first order of the roughness does not hold: the phase is {phase:.2g}, above "
            f"{smooth_scatter.SMOOTH:g}; compare by `he-torrance`, or at a longer wavelength"
        )
    for each in compared:
        if not each.comparable:
            return "band", (
                f"only {100 * each.shared:.0f} % of what the {each.what} should read lies in the frequencies of the "
                "scan: the rest is extrapolated, and nothing can be compared"
            )
    wrong = [each for each in compared if not each.agrees]
    if not wrong:
        return "", "they agree"
    if len(wrong) == 2 and abs(np.log(wrong[0].ratio / wrong[1].ratio)) < np.log1p(2 * ALIKE):
        factor = float(np.sqrt(wrong[0].ratio * wrong[1].ratio))
        return "scale", (
            f"profile and TIS agree with each other and read {factor:.2g} times what the scan expects of both: the "
            "scan's scale is wrong by that factor (calibration, solid angle), or the reflectance that was taken"
        )
    if len(wrong) == 2:
        return "several", "profile, TIS and scan all differ: more than one assumption fails"
    alone = wrong[0]
    return _alone(alone, len(compared))


def _alone(alone: Compared, count: int) -> tuple[str, str]:
    """One reading that differs; where there are two besides, the others agree."""
    others = {"profile": "scan and TIS agree", "TIS": "scan and profile agree"}[alone.what] if count == 2 else ""
    head = f"{others}, and " if others else ""
    more = alone.ratio > 1
    if alone.what == "profile" and not more:
        return "heights", (
            f"{head}the profile has {1 / alone.ratio:.2g} times less variance than the light scatters: something else "
            "than heights scatters (dust, a film, what lies below the surface), or it was measured along a lay"
        )
    if alone.what == "profile":
        return "profile", (
            f"{head}the profile has {alone.ratio:.2g} times more variance than the light scatters: noise, form or "
            "waves outside its stated cut-offs, or it was measured across a lay"
        )
    if more:
        return "beam", (
            f"{head}the TIS is {alone.ratio:.2g} times what they expect: mirror beam or stray light was gathered with "
            "it"
        )
    return "stop", (
        f"{head}the TIS is {1 / alone.ratio:.2g} times less than they expect: the stop about the mirror beam is wider "
        "than stated"
    )
