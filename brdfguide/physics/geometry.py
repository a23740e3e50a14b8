"""What a reflectance law is given: pairs of directions, and the wavelengths that they are looked at in.

Directions stand in rows, channels in columns: a data set has angles of shape (samples, 1) and
wavelengths of shape (channels,), and a law simply broadcasts.
"""

from dataclasses import replace
from functools import cached_property
from operator import attrgetter
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import InputError
from ..records import dataclass
from .directions import FIELDS, Directions

WAVELENGTH_UM = 0.55  # where nothing else is said, as in the report


@dataclass(frozen=True, eq=False)
class Geometry:
    """Directions, and the wavelength [µm]. Every angle of the directions is an attribute of the geometry too.

    Make one with `from_degrees`, `from_vectors` or `in_plane`.
    """

    directions: Directions
    wavelength: np.ndarray | float = WAVELENGTH_UM

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    @classmethod
    def from_degrees(cls, theta_i, phi_i, theta_r, phi_r, wavelength=WAVELENGTH_UM) -> "Geometry":
        """From zenith and azimuth angles [deg], which broadcast; exact at 89.9999999° and at the mirror azimuth."""
        return cls(Directions.from_degrees(theta_i, phi_i, theta_r, phi_r), wavelength)

    @classmethod
    def from_vectors(cls, i, r, wavelength=WAVELENGTH_UM) -> "Geometry":
        """From unit vectors (..., 3) toward the light and toward the detector."""
        return cls(Directions.from_vectors(i, r), wavelength)

    def __len__(self) -> int:
        return len(self.directions)

    def __getitem__(self, rows) -> "Geometry":
        """The same for some of the rows: an index, slice or mask over the first axis."""
        return Geometry(self.directions[rows], self.wavelength)

    def blocks(self, size: int = 16384):
        """Slices of rows that fit the processor's cache, each with its own Geometry."""
        return ((rows, self[rows]) for rows in (slice(at, at + size) for at in range(0, len(self), size)))

    def swapped(self) -> "Geometry":
        """Light and detector exchanged."""
        return Geometry(self.directions.swapped(), self.wavelength)

    def light_turned(self) -> "Geometry":
        """The same with the light turned by half a turn about the normal."""
        return Geometry(self.directions.with_light_turned, self.wavelength)

    def where_lit(self) -> "Geometry":
        """The same with every unlit pair replaced by a harmless one, so that no law meets the horizon."""
        return Geometry(self.directions.only_lit, self.wavelength)

    @cached_property
    def channels_first(self) -> "Geometry":
        """The same with directions (1, samples) along the last axis and wavelengths (channels, 1): three channels make
        a short inner loop."""
        wavelength = np.reshape(self.wavelength, (-1, 1)) if np.ndim(self.wavelength) else self.wavelength
        return Geometry(self.directions.transposed, wavelength)

    def at_azimuth(self, azimuth_deg: float) -> "Geometry":
        """The same with light and detector turned about the normal by an angle [deg], counter-clockwise."""
        if azimuth_deg == 0:
            return self
        directions = replace(self.directions, phi_i_deg=self.directions.phi_i_deg + azimuth_deg)
        return Geometry(directions, self.wavelength)

    def at(self, wavelength) -> "Geometry":
        """The same directions at another wavelength [µm], with what was formed from them so far."""
        return self if wavelength is self.wavelength else Geometry(self.directions, wavelength)

    def formed(self, function):
        """`function(directions)`, called once, whatever the wavelength."""
        return self.directions.formed(function)

    def afresh(self) -> "Geometry":
        """The same directions with nothing formed from them yet."""
        return Geometry(replace(self.directions), self.wavelength)


for _name in (*FIELDS, *vars(Directions)):  # what a geometry does not say itself, its directions do
    if not (_name.startswith("_") or hasattr(Geometry, _name)):
        setattr(Geometry, _name, property(attrgetter(f"directions.{_name}")))


def in_plane(theta_i_deg, theta_r_deg, wavelength=WAVELENGTH_UM) -> Geometry:
    """Directions in the plane of incidence; theta_r [deg] is positive on the mirror side, as the report plots it."""
    theta_r_deg = np.asarray(theta_r_deg, float)
    phi_r = np.where(theta_r_deg < 0, 0.0, 180.0)
    return Geometry.from_degrees(theta_i_deg, 0.0, np.abs(theta_r_deg), phi_r, wavelength)


def rows(geom: Geometry) -> Geometry:
    """A flat list of directions as rows of one column, (samples, 1), so that channels can stand beside."""
    if len(geom.shape) == 2 and geom.shape[1] == 1:
        return geom
    return Geometry(geom.directions.each(lambda values: np.reshape(values, (-1, 1))), geom.wavelength)


def signed(theta_i_deg, theta_r_deg, phi_deg=180.0, wavelength=WAVELENGTH_UM) -> Geometry:
    """Directions of angles [deg] that broadcast: phi is phi_r - phi_i, 180 in the mirror direction, as everywhere.

    A negative theta_r is that angle on the other side, half a turn away: -30, 180 is 30, 0.

    Raises InputError beyond the horizon.
    """
    theta_i_deg, theta_r_deg = np.asarray(theta_i_deg, float), np.asarray(theta_r_deg, float)
    if np.any((theta_i_deg < 0) | (theta_i_deg > 90)) or np.any(np.abs(theta_r_deg) > 90):
        raise InputError("theta_i lies in 0..90 and theta_r in -90..90 degrees")
    phi_deg = np.remainder(np.asarray(phi_deg, float) + np.where(theta_r_deg < 0, 180.0, 0.0), 360.0)
    return Geometry.from_degrees(theta_i_deg, 0.0, np.abs(theta_r_deg), phi_deg, wavelength)
