"""Spectra of the heights of a surface without direction: as a profile shows them and as light scatters by them.

    S1(ν) [µm³]  of a profile, one-sided:     sigma² = ∫ S1 dν           over 0 < ν
    S2(ν) [µm⁴]  of the surface:              sigma² = 2π ∫ S2 ν dν      over 0 < ν
    S1(ν) = 4 ∫ S2(ν cosh t) ν cosh t dt,     S2(ν) = -(1/2π) ∫ S1'(ν cosh t) dt     over 0 < t

ν is the spatial frequency [1/µm]. A band of a profile and a ring of the surface are not the same heights: a profile
takes in every wave that crosses it slowly, however short. Height in a band needs the band to be told.

Source: Church, Takacs and Leonard 1989, "The prediction of BRDFs from surface profile measurements"; ISO 10110-8.
"""

from functools import cache, cached_property
from math import pi
from typing import Protocol

import numpy as np

from ..errors import InputError
from ..numerics.special import ln_gamma
from ..records import dataclass

NODES = 12  # of Gauss' rule on a panel
PANEL = 0.5  # of ln ν, over which a spectrum is a polynomial to 1e-12
FAR = 18.0  # ln cosh t at which the tail of a spectrum has ended


class SurfaceSpectrum(Protocol):
    """Heights of a surface by spatial frequency; a density takes and gives (...)."""

    def of_surface(self, frequency) -> np.ndarray: ...  # S2 [µm⁴]

    @property
    def ends(self) -> tuple[float, float]: ...  # [1/µm], beyond which hardly any height lies or nothing is known


class Spectrum(SurfaceSpectrum, Protocol):
    """The same where heights along a profile are known too."""

    def of_profile(self, frequency) -> np.ndarray: ...  # S1 [µm³]


def to_surface(c):
    """K = Γ((c+1)/2)/(2√π Γ(c/2)): what makes the spectrum of a profile into that of a surface (Church)."""
    return np.exp(ln_gamma(0.5 * (np.asarray(c) + 1)) - ln_gamma(0.5 * np.asarray(c))) / (2 * np.sqrt(pi))


@dataclass(frozen=True)
class KCorrelation:
    """S1 = a/(1 + (b ν)²)^(c/2): a level a [µm³], a bend at ν = 1/b [1/µm], a fall with slope -c."""

    a: float
    b: float
    c: float

    def of_profile(self, frequency) -> np.ndarray:
        return self.a * np.exp(-0.5 * self.c * np.log1p(np.square(self.b * np.asarray(frequency, float))))

    def of_surface(self, frequency) -> np.ndarray:
        bent = np.log1p(np.square(self.b * np.asarray(frequency, float)))
        return self.a * self.b * to_surface(self.c) * np.exp(-0.5 * (self.c + 1) * bent)

    @property
    def ends(self) -> tuple[float, float]:
        return 1e-4 / self.b, 1e4 / self.b

    @property
    def height(self) -> float:
        """Rms height sigma [µm] over all spatial frequencies; without a bound for c <= 1."""
        if self.c <= 1:
            return float("inf")
        return float(np.sqrt(2 * pi * to_surface(self.c) * self.a / (self.b * (self.c - 1))))

    @property
    def length(self) -> float:
        """Correlation length b/2π [µm]."""
        return self.b / (2 * pi)


@dataclass(frozen=True)
class GaussianSpectrum:
    """S2 = π sigma² tau² exp(-(π tau ν)²): Gaussian correlation exp(-r²/tau²), as in He-Torrance; lengths [µm]."""

    sigma: float
    tau: float

    def of_profile(self, frequency) -> np.ndarray:
        return 2 * np.sqrt(pi) * self.sigma**2 * self.tau * np.exp(-np.square(pi * self.tau * np.asarray(frequency)))

    def of_surface(self, frequency) -> np.ndarray:
        return pi * (self.sigma * self.tau) ** 2 * np.exp(-np.square(pi * self.tau * np.asarray(frequency)))

    @property
    def ends(self) -> tuple[float, float]:
        return 1e-4 / self.tau, 2.5 / self.tau

    @property
    def height(self) -> float:
        return self.sigma


@dataclass(frozen=True, eq=False)
class TabulatedSpectrum:
    """Points of a spectrum joined by power laws, its first and last ones going on beyond them.

    frequency (points,) [1/µm] ascending, density (points,) [µm³] of a profile or [µm⁴] of a surface.
    Raises InputError for fewer than two points, frequencies that do not ascend, and values that are not positive.
    """

    frequency: np.ndarray
    density: np.ndarray
    profile: bool  # whether the density is a profile's

    def __post_init__(self):
        if len(self.frequency) < 2:
            raise InputError(f"a spectrum of {len(self.frequency)} points; wanted two or more")
        if not (np.all(self.frequency > 0) and np.all(np.diff(self.frequency) > 0)):
            raise InputError("the spatial frequencies of a spectrum have to be positive and ascend")
        if not (np.all(self.density > 0) and np.all(np.isfinite(self.density))):
            raise InputError("a spectrum has a value that is not positive; leave out what lies below the noise")

    @property
    def ends(self) -> tuple[float, float]:
        return float(self.frequency[0]), float(self.frequency[-1])

    def of_profile(self, frequency) -> np.ndarray:
        if self.profile:
            return self._given(frequency)[0]
        return _along(lambda nu: 4 * nu * self._given(nu)[0], frequency, self.frequency)

    def of_surface(self, frequency) -> np.ndarray:
        if not self.profile:
            return self._given(frequency)[0]

        def falls(nu):
            density, slope = self._given(nu)
            return -density * slope / (2 * pi * nu)

        return _along(falls, frequency, self.frequency)

    @cached_property
    def _slopes(self) -> np.ndarray:
        return np.diff(np.log(self.density)) / np.diff(np.log(self.frequency))

    def _given(self, frequency) -> tuple[np.ndarray, np.ndarray]:
        """The density that the table is of, and its slope d ln S/d ln ν."""
        frequency = np.asarray(frequency, float)
        place = np.clip(np.searchsorted(self.frequency, frequency, side="right") - 1, 0, len(self._slopes) - 1)
        slope = self._slopes[place]
        return self.density[place] * (frequency / self.frequency[place]) ** slope, slope


def surface_height(spectrum: SurfaceSpectrum, low: float | None = None, high: float | None = None) -> float:
    """Rms height [µm] of the waves of a surface with low < ν < high [1/µm]: what light scatters by; None: its end."""
    return float(np.sqrt(_over_band(spectrum, low, high, lambda nu: 2 * pi * nu * spectrum.of_surface(nu))))


def profile_height(spectrum: Spectrum, low: float | None = None, high: float | None = None) -> float:
    """Rms height [µm] of a profile between two cut-offs [1/µm]: Rq; None: the spectrum's end."""
    return float(np.sqrt(_over_band(spectrum, low, high, spectrum.of_profile)))


def surface_gradient(spectrum: SurfaceSpectrum, low: float | None = None, high: float | None = None) -> float:
    """Rms gradient of a surface between two cut-offs [1/µm]: Sdq, sqrt ∫ (2πν)² 2πν S2 dν."""
    return float(np.sqrt(_over_band(spectrum, low, high, lambda nu: (2 * pi * nu) ** 3 * spectrum.of_surface(nu))))


def profile_slope(spectrum: Spectrum, low: float | None = None, high: float | None = None) -> float:
    """Rms slope of a profile between two cut-offs [1/µm]: Rdq, sqrt ∫ (2πν)² S1 dν."""
    return float(np.sqrt(_over_band(spectrum, low, high, lambda nu: (2 * pi * nu) ** 2 * spectrum.of_profile(nu))))


def _over_band(spectrum: SurfaceSpectrum, low, high, density) -> float:
    """∫ density dν. Raises InputError where the band is empty."""
    low = spectrum.ends[0] if low is None else low
    high = spectrum.ends[1] if high is None else high
    if not 0 < low < high:
        raise InputError(f"a band from {low:g} to {high:g} 1/µm is empty")
    kinks = np.log(spectrum.frequency) if isinstance(spectrum, TabulatedSpectrum) else np.empty(0)
    nodes, weights = _panels(np.log(low), np.log(high), kinks)
    nu = np.exp(nodes)
    return float(np.sum(weights * nu * density(nu)))


def _panels(low: float, high: float, kinks) -> tuple[np.ndarray, np.ndarray]:
    """Gauss's nodes and weights over low..high, in panels that end at the kinks."""
    inside = kinks[(kinks > low) & (kinks < high)]
    ends = np.unique(np.concatenate((np.linspace(low, high, int((high - low) / PANEL) + 2), inside)))
    half = 0.5 * np.diff(ends)[:, None]
    nodes, weights = _rule()
    return (0.5 * (ends[1:] + ends[:-1])[:, None] + half * nodes).ravel(), (half * weights).ravel()


@cache
def _rule():
    """Nodes and weights over -1..1; formed when they are asked for, since their package takes 10 ms to load."""
    return np.polynomial.legendre.leggauss(NODES)


def _along(density, frequency, knots) -> np.ndarray:
    """∫ density(ν cosh t) dt for every ν, in panels that end where ν cosh t is a knot."""
    frequency = np.asarray(frequency, float)
    out = [_along_one(density, float(nu), knots) for nu in frequency.ravel()]
    return np.reshape(out, frequency.shape)


def _along_one(density, nu: float, knots) -> float:
    kinks = np.arccosh(knots[knots > nu] / nu)
    nodes, weights = _panels(0.0, FAR, kinks)
    return float(np.sum(weights * density(nu * np.cosh(nodes))))
