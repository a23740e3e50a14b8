"""What an instrument reported: values with their directions, channels and doubts."""

from dataclasses import replace
from functools import cached_property

import numpy as np

from ..finding import Finding
from ..formed import KeepsFormed, formed
from ..physics.aperture import Instrument
from ..physics.directions import rows_taken
from ..physics.geometry import Directions, Geometry
from ..records import dataclass
from .noise_model import NoiseModel
from .otherwise import Otherwise

SMALLEST = 1e-300  # 1/sr; where a law underflows its logarithm is taken here: far off, but finite
LARGEST = 1e100  # 1/sr, and its inverse the least: beyond is no measurement
FEW = 10_000  # values, beyond which short numbers sort sooner
MOST_HELD = 120  # distinct incidence angles; with more, none was held


@dataclass(frozen=True, eq=False, repr=False)
class Measurement(KeepsFormed):
    """BRDF values [1/sr] of shape (samples, channels); NaN where there is none.

    `geom` has angles of shape (samples, 1) and wavelengths [µm] of shape (channels,). A single-wavelength scan
    in the plane of incidence is the case channels = 1.
    """

    geom: Geometry
    brdf: np.ndarray
    channels: tuple[str, ...] = ("brdf",)
    stderr: np.ndarray | None = None  # standard errors [1/sr], in the shape of brdf
    solid_angle: float | None = None  # of the detector [sr]
    name: str = ""
    format: str = ""
    findings: tuple[Finding, ...] = ()  # rows dropped and conventions assumed, in the reader's order
    noise: NoiseModel | None = None  # what its values are worth, once that was asked
    otherwise: tuple[Otherwise, ...] = ()  # under faults that nobody would notice

    def __post_init__(self):
        samples, channels = self.brdf.shape
        if self.geom.shape != (samples, 1) or len(self.channels) != channels:
            raise ValueError(f"brdf is {self.brdf.shape}, geom {self.geom.shape}, channels {len(self.channels)}")

    def __repr__(self) -> str:
        """What there is, and what was noticed, a line each."""
        theta_i, theta_r = self.geom.theta_i_deg, self.geom.theta_r_deg
        where = "in the plane of incidence" if self.in_plane else "over the hemisphere"
        head = (
            f"{self.name or 'measurement'}: {len(self.brdf)} directions {where}, theta_i {theta_i.min():.3g}.."
            f"{theta_i.max():.3g}, theta_r {theta_r.min():.3g}..{theta_r.max():.3g} deg; {', '.join(self.channels)}"
            if len(self.brdf)
            else f"{self.name or 'measurement'}: no directions"
        )
        return "\n  ".join([head, *(f"{each.printed}: {each.text}" for each in self.findings)])

    @cached_property
    def usable(self) -> np.ndarray:
        """(samples, channels): positive, of a size that squares and quotients survive, and above the horizon; the rest
        is censored, never clipped."""
        with np.errstate(invalid="ignore"):
            return (self.brdf > 1 / LARGEST) & (self.brdf < LARGEST) & self.geom.lit

    @cached_property
    def readings(self) -> np.ndarray:
        """(samples, channels) [1/sr]: of either sign, of a size that can be, above the horizon; NaN elsewhere."""
        with np.errstate(invalid="ignore"):
            return np.where((np.abs(self.brdf) < LARGEST) & self.geom.lit, self.brdf, np.nan)

    @property
    def stated_errors(self) -> np.ndarray | None:
        """(samples, channels) [1/sr]: standard errors of a size that can be, NaN elsewhere; None where no value that is
        clear of the dark level has one."""
        if self.stderr is None:
            return None
        with np.errstate(invalid="ignore"):
            known = (self.stderr >= 0) & (self.stderr < LARGEST)
        return np.where(known, self.stderr, np.nan) if known[self.clear].any() else None

    @cached_property
    def has_value(self) -> np.ndarray:
        """(samples,): where any channel has a value that a fit looks at."""
        return np.any(self.weighed, axis=1)

    @cached_property
    def weighed(self) -> np.ndarray:
        """(samples, channels): what a fit looks at. Where the dark level is in doubt, values below zero as well."""
        if self.noise is None or not self.noise.matters:
            return self.usable
        return self.usable_beside(self.noise)

    def usable_beside(self, noise: NoiseModel) -> np.ndarray:
        """(samples, channels): usable, or of either sign in a channel whose dark level is in doubt."""
        return self.usable | ((noise.limit > 0) & np.isfinite(self.readings))

    @cached_property
    def clear(self) -> np.ndarray:
        """(samples, channels): clear of the dark level, so that their errors are told; the others are upper limits."""
        if self.noise is None or not self.noise.matters:
            return self.usable
        with np.errstate(invalid="ignore"):
            return self.usable & (self.brdf >= self.noise.limit)

    @cached_property
    def level(self) -> np.ndarray:
        """The values that a fit looks at, none below the scale's floor: what a difference is taken in parts of."""
        if self.noise is None or not self.noise.matters:
            return self.brdf
        return np.maximum(self.brdf, self.noise.floor)

    @cached_property
    def least(self) -> np.ndarray | float:
        """(channels,) [1/sr]: a law that gives less is taken here, since nothing tells less from nothing."""
        if self.noise is None or not self.noise.matters:
            return SMALLEST
        return np.maximum(np.array(self.noise.absolute), SMALLEST)

    @cached_property
    def ln(self) -> np.ndarray:
        """ln of the usable values, (samples, channels); NaN elsewhere."""
        return np.log(np.where(self.usable, self.brdf, np.nan))

    @cached_property
    def instrument(self) -> Instrument:
        return Instrument(self.geom, self.solid_angle)

    @property
    def censored(self) -> int:
        """How many values are missing, or not positive where that cannot be noise."""
        return int(self.weighed.size - np.count_nonzero(self.weighed))

    @cached_property
    def in_plane(self) -> bool:
        """Whether every direction lies in the plane of incidence, to 0.1°."""
        return bool(np.all(self.geom.off_plane_deg < 0.1))

    @property
    def theta_i_groups(self) -> dict[float, np.ndarray]:
        """Incidence angle [deg], to 0.1° -> its rows."""
        return _theta_i_groups(self.geom)

    @property
    def incidences(self) -> dict[float, np.ndarray]:
        """Incidence angle [deg] -> its rows: `theta_i_groups`, in bands of a degree where no incidence was held."""
        return _incidences(self.geom)

    def __getitem__(self, rows) -> "Measurement":
        """The same for some of the rows: a slice, mask or list of row numbers."""

        if isinstance(rows, np.ndarray) and rows.dtype == bool:
            rows = np.flatnonzero(rows)
        picked = rows_taken(rows)
        stderr, otherwise = self.stderr, tuple(each[rows] for each in self.otherwise)
        stderr = None if stderr is None else picked(stderr)
        return replace(self, geom=self.geom[rows], brdf=picked(self.brdf), stderr=stderr, otherwise=otherwise)

    def of_channels(self, picked) -> "Measurement":
        """The same for some of the channels, by their numbers."""
        wavelength = np.atleast_1d(self.geom.wavelength)
        geom = self.geom.at(wavelength[picked] if len(wavelength) > 1 else wavelength)
        stderr = None if self.stderr is None else self.stderr[:, picked]
        channels = tuple(self.channels[place] for place in picked)
        noise = None if self.noise is None else self.noise.of_channels(np.atleast_1d(picked).tolist())
        otherwise = tuple(each.of_channels(picked, geom) for each in self.otherwise)
        return replace(
            self,
            geom=geom,
            brdf=self.brdf[:, picked],
            channels=channels,
            stderr=stderr,
            noise=noise,
            otherwise=otherwise,
        )

    def under(self, fault: Otherwise) -> "Measurement":
        """As it would read with that fault."""
        return replace(self, geom=fault.geom, brdf=self.brdf * fault.factor, otherwise=())

    def settled(self, question: str) -> bool:
        """Whether reader, option or correction have answered it: "side", "rotation", "cosine" or "scale"."""
        return any(question in finding.settles for finding in self.findings)

    def noting(self, *findings: Finding) -> "Measurement":
        """The same with more findings."""
        return replace(self, findings=self.findings + findings)


@formed
def _incidences(to: Directions) -> dict[float, np.ndarray]:
    groups = _theta_i_groups(to)
    return groups if len(groups) <= MOST_HELD else rows_of_each(np.round(to.theta_i_deg[:, 0]))


@formed
def _theta_i_groups(to: Directions) -> dict[float, np.ndarray]:
    return rows_by_tenth(to.theta_i_deg[:, 0])


def row_median(values) -> np.ndarray:
    """(samples,): median over channels that have a value, NaN where none has; NumPy's own takes ten times as long."""
    if values.shape[1] == 1:
        return values[:, 0].copy()
    if values.shape[1] == 3 and not np.isnan(values.sum()):
        first, second, third = values.T
        return np.maximum(np.minimum(first, second), np.minimum(np.maximum(first, second), third))
    ascending, known = np.sort(values, axis=1), np.count_nonzero(~np.isnan(values), axis=1)  # NaN last
    middle = np.stack([np.maximum(known - 1, 0) // 2, np.minimum(known // 2, values.shape[1] - 1)], axis=1)
    return np.take_along_axis(ascending, middle, axis=1).mean(axis=1)


def rows_by_tenth(angles) -> dict[float, np.ndarray]:
    """Angle [deg], to 0.1° -> the rows that have it."""
    return rows_of_each(np.round(angles, 1))


def _as_short(values) -> np.ndarray:
    """Tenths of degrees as small whole numbers, which sort in a tenth of the time; others as they are."""
    tenths = np.rint(values * 10) if len(values) > FEW else values
    if len(values) <= FEW or not np.all((tenths >= 0) & (tenths < 2**16)) or np.any(tenths / 10 != values):
        return values
    return tenths.astype(np.uint16)


def rows_of_each(values) -> dict[float, np.ndarray]:
    """Value -> the rows that have it, both in ascending order."""
    order = np.argsort(_as_short(values), kind="stable")
    values = values[order]
    starts = np.flatnonzero(np.r_[True, values[1:] != values[:-1]])
    return {
        value: order[start:stop]
        for value, start, stop in zip(
            values[starts].tolist(), starts.tolist(), [*starts[1:].tolist(), len(order)], strict=True
        )
    }
