"""What a fit of polished optics says beyond its parameters: light scattered, heights in the band that was measured,
what holds at another wavelength, and whether the laws of physics beside it agree.
"""

from collections.abc import Mapping

import numpy as np

from ..data.measurement import Measurement
from ..models.model import Term
from ..models.surface import Surface
from ..physics import hemisphere, smooth_scatter
from ..physics.geometry import in_plane
from ..physics.height_spectrum import KCorrelation, SurfaceSpectrum, surface_height
from ..records import dataclass
from .diagnostics import derived_error
from .ranked import Ranking, Row

WAVE_LAWS, STRAY_LIGHT_LAWS = "wave optics", "polished optics"  # the families of those
INCIDENCES = 3  # at most, at which light is added up
SIGMAS = 1.96  # standard errors of an interval of 95 %
AGREE = 0.2  # by which two heights of one surface may differ (ours)


@dataclass(frozen=True)
class Scattered:
    """Light scattered out of one incidence, as a share of what arrives."""

    theta_i_deg: float
    measured: float  # within the |β - β0| that were measured
    extrapolated: float  # by the law, from the mirror direction to the horizon


@dataclass(frozen=True)
class Beside:
    """A law of physics in the same ranking."""

    law: str
    rms_ln: float
    tied: bool
    sigma_um: float | None


@dataclass(frozen=True)
class StrayLight:
    """Of one law of polished optics in one channel."""

    law: str
    physics: bool  # its numbers belong to the surface and not to a wavelength
    wavelength: float  # [µm]
    intervals: Mapping[str, tuple[float, float, float]]  # value and ends of 95 %
    beta: tuple[float, float]  # |β - β0| measured
    scattered: tuple[Scattered, ...]
    band: tuple[float, float]  # spatial frequencies measured [1/µm]
    reflectance: float  # of the smooth surface, as it was taken
    sigma: float  # rms height of the waves in the band [µm]
    sigma_total: float | None  # of all waves, extrapolated [µm]; None: the law has none, infinite: without a bound
    sigma_total_ends: tuple[float, float] | None  # of 95 %; None: not known
    phase: float  # (4π sigma/λ)² of the band
    shortest: float  # wavelength [µm] from which on the first order holds for these heights
    highest_deg: float  # incidence measured
    beside: tuple[Beside, ...]


def stray_light(ranking: Ranking, measurement: Measurement) -> tuple[StrayLight, ...]:
    """Of the recommended row, and of the best with a law of physics beside it; none where no polished optics won."""
    pick = ranking.recommended
    if _polished(pick) is None:
        return ()
    physics = next((row for row in ranking.rows if _is_abc(row) and row is not pick), None)
    rows = [pick] + ([physics] if physics is not None and not _is_abc(pick) and _worth_telling(physics, pick) else [])
    beside = tuple(_beside(row) for row in _best_of_physics(ranking) if not (_is_abc(row) and _is_abc(pick)))
    return tuple(_of_row(row, measurement, beside) for row in rows)


def _worth_telling(row: Row, pick: Row) -> bool:
    """Whether its error leaves its numbers a meaning."""
    return row.rms_ln < max(2 * pick.rms_ln, 0.1)


def _of_row(row: Row, measurement: Measurement, beside: tuple[Beside, ...]) -> StrayLight:
    channel = int(np.argmax(np.count_nonzero(measurement.usable, axis=0)))
    surface, term = row.fit.surface.channel(channel), _polished(row)
    assert term is not None  # the row was chosen for it
    wavelength = float(surface.wavelengths[0])
    used = measurement.clear[:, channel] & ~(measurement.instrument.beam[:, 0] > 0)
    x = np.sqrt(measurement.geom.vxy2[used, 0])
    low, high = float(x[x > 0].min()), float(x.max())
    band = low / wavelength, high / wavelength
    values = {name: float(value) for name, value in surface.model.of_term(term, surface.values).items()}
    reflectance = values.get("f0", 1.0)
    spectrum = _spectrum(term, values, wavelength)
    sigma = surface_height(spectrum, *band)
    total = float(term.model.derived[0].of(**values)) if term.model.name == "abc" else None
    return StrayLight(
        law=row.fit.name,
        physics=term.model.name == "abc",
        wavelength=wavelength,
        intervals=_intervals(row, term, channel),
        beta=(low, high),
        scattered=scattered_shares(surface, _picked(measurement), low, high),
        band=band,
        reflectance=reflectance,
        sigma=sigma,
        sigma_total=total,
        sigma_total_ends=_ends_of_total(row, measurement, term, total),
        phase=float(smooth_scatter.phase(sigma, wavelength)),
        shortest=4 * np.pi * sigma / np.sqrt(smooth_scatter.SMOOTH),
        highest_deg=float(measurement.geom.theta_i_deg.max()),
        beside=tuple(each for each in beside if each.law != row.fit.name),
    )


def _ends_of_total(row: Row, measurement: Measurement, term: Term, total: float | None) -> tuple[float, float] | None:
    """Both ends of 95 % of the height over all waves, whose a, b and c err together."""
    if total is None or not np.isfinite(total):
        return None
    keys = term.keys

    def height(values: Mapping) -> float:
        return float(term.model.derived[0].of(**{name: values[key] for name, key in keys.items() if key in values}))

    error = derived_error.ln_stderr(row.fit, measurement, height)
    return (total * np.exp(-SIGMAS * error), total * np.exp(SIGMAS * error)) if error < 1 else None


def _picked(measurement: Measurement) -> tuple[float, ...]:
    """Of the incidences [deg] the least, the greatest and one between."""
    angles = np.array(list(measurement.theta_i_groups))
    return tuple(angles[np.unique(np.linspace(0, len(angles) - 1, INCIDENCES).round().astype(int))].tolist())


def scattered_shares(
    surface: Surface, theta_i_deg: tuple[float, ...], low: float, high: float
) -> tuple[Scattered, ...]:
    """What a law scatters out of each incidence [deg], within `low` to `high` of |β - β0| and in all."""

    def lobe(geom):
        return surface.model(geom.at(surface.wavelengths), surface.values)

    def seen(geom):
        return np.where((geom.vxy2 >= low**2) & (geom.vxy2 <= high**2), lobe(geom), 0.0)

    whole, part = (hemisphere.dhr(each, theta_i_deg)[:, 0] for each in (lobe, seen))
    return tuple(Scattered(*map(float, each)) for each in zip(theta_i_deg, part, whole, strict=True))


@dataclass(frozen=True, eq=False)
class _LawSpectrum:
    """S2 that Rayleigh and Rice see in a law without cosines, near the normal."""

    term: Term
    values: Mapping[str, float]
    wavelength: float
    ends: tuple[float, float] = (0.0, 0.0)

    def of_surface(self, frequency) -> np.ndarray:
        x = np.asarray(frequency) * self.wavelength
        half = np.degrees(np.arcsin(np.minimum(x / 2, 1)))  # both ways by half: no direction lies below the horizon
        brdf = self.term.model(in_plane(half, -half, self.wavelength), **self.values)
        return brdf * self.wavelength**4 / (16 * np.pi**2)


def _spectrum(term: Term, values: Mapping[str, float], wavelength: float) -> SurfaceSpectrum:
    if term.model.name == "abc":
        return KCorrelation(values["a"], values["b"], values["c"])
    return _LawSpectrum(term, values, wavelength)


def _intervals(row: Row, term: Term, channel: int) -> dict[str, tuple[float, float, float]]:
    """Value and both ends of 95 % of what was fitted of a term."""
    found = {}
    for name, key in term.keys.items():
        if (error := row.fit.stderr.get(key)) is None:
            continue
        value, spread = (
            float(np.ravel(each)[channel if np.size(each) > 1 else 0]) for each in (row.fit.values[key], error)
        )
        if term.model.parameter(name).log and spread < value:
            factor = np.exp(SIGMAS * spread / value)
            found[name] = value, value / factor, value * factor
        else:
            found[name] = value, value - SIGMAS * spread, value + SIGMAS * spread
    return found


def _best_of_physics(ranking: Ranking) -> list[Row]:
    """The best row of each kind: with `abc`, and with a law of wave optics."""
    kinds = (_is_abc, lambda row: any(term.model.family == WAVE_LAWS for term in row.fit.model.terms))
    found = (next((row for row in ranking.rows if kind(row)), None) for kind in kinds)
    return [row for row in found if row is not None]


def _beside(row: Row) -> Beside:
    for term in row.fit.model.terms:
        values = row.fit.surface.model.of_term(term, row.fit.values)
        if "sigma" in values and term.model.family == WAVE_LAWS:
            return Beside(row.fit.name, row.rms_ln, row.tied, float(np.ravel(values["sigma"])[0]))
        if term.model.name == "abc":
            sigma = float(np.ravel(term.model.derived[0].of(**values))[0])
            return Beside(row.fit.name, row.rms_ln, row.tied, sigma if np.isfinite(sigma) else None)
    return Beside(row.fit.name, row.rms_ln, row.tied, None)


def _is_abc(row: Row) -> bool:
    return any(term.model.name == "abc" for term in row.fit.model.terms)


def _polished(row: Row) -> Term | None:
    """The term of polished optics, if the row has one."""
    return next((term for term in row.fit.model.terms if term.model.family == STRAY_LIGHT_LAWS), None)
