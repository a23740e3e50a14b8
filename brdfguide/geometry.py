"""Directions of light and detector, and every angle that a reflectance law is written in.

Both directions point away from the surface; the mirror direction is phi_r - phi_i = 180°. What a law
needs near the mirror direction, near the normal and near grazing is formed from components, never
from an arc cosine or a difference of numbers near 1:

    tan² of the tilt of the half vector  = |i_xy + r_xy|² / (cos θi + cos θr)²
    cosine from light to half vector     = ½ √((cos θi + cos θr)² + |i_xy + r_xy|²)

Directions stand in rows, channels in columns: a data set has angles of shape (samples, 1) and
wavelengths of shape (channels,), and a law simply broadcasts.
"""

from dataclasses import dataclass, fields, replace
from functools import cached_property, wraps

import numpy as np

WAVELENGTH_UM = 0.55  # where nothing else is said, as in the report


def once(function):
    """A function of one Geometry or Measurement, computed once for each: what a law forms from the directions alone, say."""
    key = (function.__module__, function.__qualname__)

    @wraps(function)
    def found(of):
        if key not in of.__dict__:
            of.__dict__[key] = function(of)
        return of.__dict__[key]

    return found


@dataclass(frozen=True, eq=False)
class Geometry:
    """Pairs of directions of one common shape, and the wavelength [µm].

    Make one with `from_degrees`, `from_vectors` or `in_plane`. The fields are what can be formed exactly
    from angles or from vectors; everything else is derived once, when first asked for.
    """

    cos_i: np.ndarray
    sin_i: np.ndarray
    cos_r: np.ndarray
    sin_r: np.ndarray
    vxy2: np.ndarray  # |i_xy + r_xy|²: 0 in the mirror direction
    dot_xy: np.ndarray  # i_xy · r_xy: -sin θi sin θr in the mirror plane
    cos_difference: np.ndarray  # cos θi - cos θr
    phi_i_deg: np.ndarray
    phi_deg: np.ndarray  # phi_r - phi_i; the mirror direction is 180
    wavelength: np.ndarray | float = WAVELENGTH_UM

    @classmethod
    def from_degrees(cls, theta_i, phi_i, theta_r, phi_r, wavelength=WAVELENGTH_UM) -> "Geometry":
        """From zenith and azimuth angles [deg], which broadcast; exact at 89.9999999° and at the mirror azimuth."""
        theta_i, phi_i, theta_r, phi_r = np.broadcast_arrays(*(np.asarray(a, float) for a in (theta_i, phi_i, theta_r, phi_r)))
        cos_i, sin_i = _cos_sin(theta_i)
        cos_r, sin_r = _cos_sin(theta_r)
        phi, lost = _two_difference(phi_r, phi_i)
        # half the azimuth away from the mirror plane, from the wrapped difference and what its rounding lost
        off_mirror = np.remainder(phi, 360.0) - 180.0
        off_mirror = np.where(off_mirror == -180.0, 180.0, off_mirror)
        half = np.radians(0.5 * (off_mirror + lost))
        half_difference = np.radians(0.5 * (theta_i - theta_r))
        cos_mean, sin_mean = _cos_sin(0.5 * (theta_i + theta_r), 0.5 * ((90.0 - theta_i) + (90.0 - theta_r)))
        sin_half = np.sin(half)
        vxy2 = (2 * cos_mean * np.sin(half_difference)) ** 2 + 4 * sin_i * sin_r * sin_half**2
        dot_xy = -sin_i * sin_r * _cos_twice(half, sin_half)
        difference = -2 * sin_mean * np.sin(half_difference)
        return cls(cos_i, sin_i, cos_r, sin_r, vxy2, dot_xy, difference, phi_i, phi, wavelength)

    @classmethod
    def from_vectors(cls, i, r, wavelength=WAVELENGTH_UM) -> "Geometry":
        """From unit vectors (..., 3) toward the light and toward the detector."""
        i, r = np.broadcast_arrays(np.asarray(i, float), np.asarray(r, float))
        (ix, iy, iz), (rx, ry, rz) = np.moveaxis(i, -1, 0), np.moveaxis(r, -1, 0)
        phi_i = np.degrees(np.arctan2(iy, ix))
        phi = np.degrees(np.arctan2(ix * ry - iy * rx, ix * rx + iy * ry))
        return cls(
            iz, np.hypot(ix, iy), rz, np.hypot(rx, ry),
            (ix + rx) ** 2 + (iy + ry) ** 2, ix * rx + iy * ry, iz - rz, phi_i, phi, wavelength,
        )  # fmt: skip

    # --- what laws are written in -------------------------------------------------------------------

    @cached_property
    def v_z(self):
        """cos θi + cos θr."""
        return self.cos_i + self.cos_r

    @cached_property
    def tan2_h(self):
        """tan² of the angle from the normal to the half vector."""
        return self.vxy2 / self.v_z**2

    @cached_property
    def v2(self):
        """|i + r|² = 2 (1 + i·r)."""
        return self.v_z**2 + self.vxy2

    @cached_property
    def cos_d(self):
        """Cosine of the angle between light and half vector, which Fresnel's equations take."""
        return 0.5 * np.sqrt(self.v2)

    @cached_property
    def mirror_distance2(self):
        """Squared chord from the mirror direction to the detector; cos of the angle between is 1 - half of it."""
        return self.vxy2 + self.cos_difference**2

    @cached_property
    def in_front(self):
        """Where the detector is less than 90° from the mirror direction: elsewhere a mirror lobe is 0."""
        return self.mirror_distance2 < 2.0

    @cached_property
    def ln_cos_m(self):
        """ln of the cosine of the angle from the mirror direction to the detector; 0 where not `in_front`."""
        return np.log1p(np.where(self.in_front, -0.5 * self.mirror_distance2, 0.0))

    @cached_property
    def sec2_h(self):
        """1/cos² of the angle from the normal to the half vector."""
        return 1.0 + self.tan2_h

    @cached_property
    def ln_sec2_h(self):
        return np.log1p(self.tan2_h)

    @cached_property
    def cos2_i(self):
        return self.cos_i * self.cos_i

    @cached_property
    def cos2_r(self):
        return self.cos_r * self.cos_r

    @cached_property
    def cos_cos(self):
        """cos θi cos θr."""
        return self.cos_i * self.cos_r

    @cached_property
    def tan_i(self):
        return self.sin_i / self.cos_i

    @cached_property
    def tan_r(self):
        return self.sin_r / self.cos_r

    @cached_property
    def lit(self):
        """Where both directions are above the horizon."""
        return (self.cos_i > 0) & (self.cos_r > 0)

    @cached_property
    def all_lit(self) -> bool:
        return bool(np.all(self.lit))

    @cached_property
    def theta_i(self):
        """Zenith angle of the light [rad]."""
        return np.arctan2(self.sin_i, self.cos_i)

    @cached_property
    def theta_r(self):
        return np.arctan2(self.sin_r, self.cos_r)

    # --- what people read ---------------------------------------------------------------------------

    @cached_property
    def theta_i_deg(self):
        return _degrees(self.sin_i, self.cos_i)

    @cached_property
    def theta_r_deg(self):
        return _degrees(self.sin_r, self.cos_r)

    @cached_property
    def off_plane_deg(self):
        """Azimuth away from the plane of incidence, 0..90."""
        wrapped = np.abs(np.remainder(self.phi_deg, 180.0))
        off = np.minimum(wrapped, 180.0 - wrapped)
        return np.where((self.sin_i < 1e-9) | (self.sin_r < 1e-9), 0.0, off)

    @cached_property
    def signed_theta_r_deg(self):
        """The report's reflection angle: positive on the mirror side, negative on the side of the light."""
        toward_mirror = np.where(self.sin_i < 1e-9, -np.cos(np.radians(self.phi_deg)), -self.dot_xy)
        return np.where(toward_mirror >= 0, self.theta_r_deg, -self.theta_r_deg)

    # --- other views --------------------------------------------------------------------------------

    @property
    def shape(self) -> tuple[int, ...]:
        return np.shape(self.cos_i)

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, rows) -> "Geometry":
        """The same for some of the rows: an index, slice or mask over the first axis."""
        picked = {name: np.asarray(getattr(self, name))[rows] for name in DIRECTIONAL}
        return replace(self, **picked)

    def blocks(self, size: int = 16384):
        """Slices of rows that fit the processor's cache, each with its own Geometry."""
        for start in range(0, len(self), size):
            rows = slice(start, start + size)
            yield rows, self[rows]

    def swapped(self) -> "Geometry":
        """Light and detector exchanged."""
        return replace(
            self, cos_i=self.cos_r, sin_i=self.sin_r, cos_r=self.cos_i, sin_r=self.sin_i,
            cos_difference=-self.cos_difference, phi_i_deg=self.phi_i_deg + self.phi_deg, phi_deg=-self.phi_deg,
        )  # fmt: skip

    def where_lit(self) -> "Geometry":
        """The same with every unlit pair replaced by a harmless one, so that no law meets the horizon."""
        if self.all_lit:
            return self
        normal = dict(cos_i=1.0, sin_i=0.0, cos_r=1.0, sin_r=0.0, vxy2=0.0, dot_xy=0.0, cos_difference=0.0, phi_i_deg=0.0, phi_deg=180.0)
        return replace(self, **{name: np.where(self.lit, getattr(self, name), value) for name, value in normal.items()})

    @cached_property
    def lying(self) -> "Geometry":
        """The same with directions (1, samples) along the last axis and wavelengths (channels, 1): three channels make a short inner loop."""
        wavelength = np.reshape(self.wavelength, (-1, 1)) if np.ndim(self.wavelength) else self.wavelength
        return replace(self, **{name: np.transpose(getattr(self, name)) for name in DIRECTIONAL}, wavelength=wavelength)

    def at(self, wavelength) -> "Geometry":
        """The same directions at another wavelength [µm], with what was derived from them so far."""
        other = replace(self, wavelength=wavelength)
        other.__dict__.update({name: value for name, value in self.__dict__.items() if name not in ("wavelength", "lying")})
        return other


DIRECTIONAL = tuple(field.name for field in fields(Geometry) if field.name != "wavelength")


def in_plane(theta_i_deg, theta_r_deg, wavelength=WAVELENGTH_UM) -> Geometry:
    """Directions in the plane of incidence; theta_r [deg] is positive on the mirror side, as the report plots it."""
    theta_r_deg = np.asarray(theta_r_deg, float)
    phi_r = np.where(theta_r_deg < 0, 0.0, 180.0)
    return Geometry.from_degrees(theta_i_deg, 0.0, np.abs(theta_r_deg), phi_r, wavelength)


def rows(geom: Geometry) -> Geometry:
    """A flat list of directions as rows of one column, (samples, 1), so that channels can stand beside."""
    return replace(geom, **{name: np.reshape(getattr(geom, name), (-1, 1)) for name in DIRECTIONAL})


def _cos_sin(degrees, complement=None):
    """Cosine and sine; beyond 45° from the complement, since 90 - θ is exact there in floating point."""
    steep = degrees > 45.0
    angle = np.radians(np.where(steep, 90.0 - degrees if complement is None else complement, degrees))
    cos, sin = np.cos(angle), np.sin(angle)
    return np.where(steep, sin, cos), np.where(steep, cos, sin)


def _degrees(sin, cos):
    """Zenith angle [deg], rounded to 1e-9 so that 30 comes back as 30."""
    return np.round(np.degrees(np.arctan2(sin, cos)), 9)


def _two_difference(a, b):
    """a - b and what its rounding lost (Knuth's two-sum)."""
    difference = a - b
    b_virtual = a - difference
    a_virtual = difference + b_virtual
    return difference, (a - a_virtual) + (b_virtual - b)


def _cos_twice(half, sin_half):
    """cos(2 half), exact at 0 and at ±90°."""
    return np.where(np.abs(sin_half) > 0.5, -np.cos(np.pi - 2 * np.abs(half)), 1 - 2 * sin_half**2)
