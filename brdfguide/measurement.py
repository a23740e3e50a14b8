"""What an instrument reported: values with their directions, channels and doubts."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from . import aperture
from .geometry import Geometry

LARGEST = 1e100  # 1/sr, and its inverse the least: beyond is no measurement
MOST_HELD = 120  # distinct incidence angles; with more, none was held


@dataclass(frozen=True)
class Finding:
    """Something noticed: a stable code for programs, a sentence for people, the numbers behind it."""

    code: str
    text: str
    severity: str = "note"  # note, warning, error
    consequence: str = ""  # what it changes in the answer
    option: str = ""  # the command-line option that overrides it
    numbers: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True, eq=False)
class Measurement:
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

    def __post_init__(self):
        samples, channels = self.brdf.shape
        if self.geom.shape != (samples, 1) or len(self.channels) != channels:
            raise ValueError(f"brdf is {self.brdf.shape}, geom {self.geom.shape}, channels {len(self.channels)}")

    @cached_property
    def usable(self) -> np.ndarray:
        """(samples, channels): positive, of a size that squares and quotients survive, and above the horizon; the rest is censored, never clipped."""
        with np.errstate(invalid="ignore"):
            return (self.brdf > 1 / LARGEST) & (self.brdf < LARGEST) & self.geom.lit

    @cached_property
    def seen(self) -> np.ndarray:
        """(samples,): where any channel has a usable value."""
        return np.any(self.usable, axis=1)

    @cached_property
    def ln(self) -> np.ndarray:
        """ln of the usable values, (samples, channels); NaN elsewhere."""
        return np.log(np.where(self.usable, self.brdf, np.nan))

    @cached_property
    def views(self) -> list[tuple[float, Geometry]]:
        """What the detector averages: weights and directions; one of each where it is taken for a point."""
        return aperture.views(self.geom, self.solid_angle)

    @property
    def censored(self) -> int:
        """How many values are missing or not positive."""
        return int(self.usable.size - np.count_nonzero(self.usable))

    @cached_property
    def in_plane(self) -> bool:
        """Whether every direction lies in the plane of incidence, to 0.1°."""
        return bool(np.all(self.geom.off_plane_deg < 0.1))

    @cached_property
    def theta_i_groups(self) -> dict[float, np.ndarray]:
        """Incidence angle [deg], to 0.1° -> its rows."""
        return rows_by_tenth(self.geom.theta_i_deg[:, 0])

    @cached_property
    def incidences(self) -> dict[float, np.ndarray]:
        """Incidence angle [deg] -> its rows: `theta_i_groups`, in bands of a degree where no incidence was held."""
        if len(self.theta_i_groups) <= MOST_HELD:
            return self.theta_i_groups
        return rows_of_each(np.round(self.geom.theta_i_deg[:, 0]))

    def __getitem__(self, rows) -> "Measurement":
        """The same for some of the rows: a slice, mask or list of row numbers."""
        pick = lambda values: None if values is None else values[rows]  # noqa: E731
        return replace(self, geom=self.geom[rows], brdf=self.brdf[rows], stderr=pick(self.stderr))

    def of_channels(self, picked) -> "Measurement":
        """The same for some of the channels, by their numbers."""
        wavelength = np.atleast_1d(self.geom.wavelength)
        geom = self.geom.at(wavelength[picked] if len(wavelength) > 1 else wavelength)
        stderr = None if self.stderr is None else self.stderr[:, picked]
        channels = tuple(self.channels[place] for place in picked)
        return replace(self, geom=geom, brdf=self.brdf[:, picked], channels=channels, stderr=stderr)

    def noting(self, *findings: Finding) -> "Measurement":
        """The same with more findings, and with what was derived from the values so far."""
        other = replace(self, findings=self.findings + findings)
        other.__dict__.update({key: value for key, value in self.__dict__.items() if key not in other.__dict__})
        return other


def row_median(values) -> np.ndarray:
    """(samples,): median over the channels that have a value, NaN where none has; NumPy's own takes ten times as long."""
    ascending, known = np.sort(values, axis=1), np.count_nonzero(~np.isnan(values), axis=1)  # NaN last
    middle = np.stack([np.maximum(known - 1, 0) // 2, np.minimum(known // 2, values.shape[1] - 1)], axis=1)
    return np.take_along_axis(ascending, middle, axis=1).mean(axis=1)


def rows_by_tenth(angles) -> dict[float, np.ndarray]:
    """Angle [deg], to 0.1° -> the rows that have it."""
    return rows_of_each(np.round(angles, 1))


def rows_of_each(values) -> dict[float, np.ndarray]:
    """Value -> the rows that have it, both in ascending order."""
    order = np.argsort(values, kind="stable")
    values = values[order]
    starts = np.flatnonzero(np.r_[True, values[1:] != values[:-1]])
    return {value: order[start:stop] for value, start, stop in zip(values[starts].tolist(), starts.tolist(), [*starts[1:].tolist(), len(order)])}
