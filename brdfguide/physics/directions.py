"""Directions of light and detector, and every angle that a reflectance law is written in.

Both directions point away from the surface; the mirror direction is phi_r - phi_i = 180°. What a law
needs near the mirror direction, near the normal and near grazing is formed from components, never
from an arc cosine or a difference of numbers near 1:

    tan² of the tilt of the half vector  = |i_xy + r_xy|² / (cos θi + cos θr)²
    cosine from light to half vector     = ½ √((cos θi + cos θr)² + |i_xy + r_xy|²)

None of it knows a wavelength, so that what a law forms from it serves every channel and is formed once.
"""

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from functools import cached_property

import numpy as np

from ..formed import KeepsFormed
from ..records import dataclass


@dataclass(frozen=True, eq=False)
class Directions(KeepsFormed):
    """Pairs of directions of one common shape.

    The fields are what can be formed exactly from angles or from vectors; everything else is derived once, when first
    asked for.
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

    @classmethod
    def from_degrees(cls, theta_i, phi_i, theta_r, phi_r) -> "Directions":
        """From zenith and azimuth angles [deg], which broadcast; exact at 89.9999999° and at the mirror azimuth."""
        theta_i, phi_i, theta_r, phi_r = np.broadcast_arrays(
            *(np.asarray(a, float) for a in (theta_i, phi_i, theta_r, phi_r))
        )
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
        return cls(cos_i, sin_i, cos_r, sin_r, vxy2, dot_xy, difference, phi_i, phi)

    @classmethod
    def from_vectors(cls, i, r) -> "Directions":
        """From unit vectors (..., 3) toward the light and toward the detector; azimuths, which hardly any law is
        written in, are formed when they are asked for."""
        i, r = np.broadcast_arrays(np.asarray(i, float), np.asarray(r, float))
        (ix, iy, iz), (rx, ry, rz) = np.moveaxis(i, -1, 0), np.moveaxis(r, -1, 0)
        known = (
            iz, np.hypot(ix, iy), rz, np.hypot(rx, ry), (ix + rx) ** 2 + (iy + ry) ** 2, ix * rx + iy * ry, iz - rz
        )  # fmt: skip
        return _OfVectors.made(known, (ix, iy, ix * ry - iy * rx, rx, ry))

    @classmethod
    def from_half_difference(cls, theta_h, theta_d, phi_d) -> "Directions":
        """From the zenith of the half vector and the angles of the light about it [rad], which broadcast; the half
        vector stands at azimuth 0 and phi_d counts from there. Nothing is subtracted that could cancel.

        Source: Rusinkiewicz 1998, "A new change of variables for efficient BRDF representation".
        """
        sin_h, cos_h, sin_d, cos_d = np.sin(theta_h), np.cos(theta_h), np.sin(theta_d), np.cos(theta_d)
        along, across = sin_d * np.cos(phi_d), sin_d * np.sin(phi_d)  # of the light, in the frame of the half vector
        ix, iz = cos_h * along + sin_h * cos_d, cos_h * cos_d - sin_h * along
        rx, rz = sin_h * cos_d - cos_h * along, cos_h * cos_d + sin_h * along
        dot = ix * rx - across**2
        known = (
            iz, np.hypot(ix, across), rz, np.hypot(rx, across), 4 * (sin_h * cos_d) ** 2, dot, -2 * sin_h * along
        )  # fmt: skip
        arrays = np.broadcast_arrays(*known, ix, across, -across * (ix + rx), rx, -across)
        return _OfVectors.made(arrays[: len(known)], arrays[len(known) :])

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
    def ln_vxy(self):
        """ln |i_xy + r_xy|; 0 in the mirror direction itself, where a power of it counts and no logarithm does."""
        return 0.5 * np.log(np.where(self.vxy2 > 0, self.vxy2, 1.0))

    @cached_property
    def v2(self):
        """|i + r|² = 2 (1 + i·r)."""
        return self.v_z**2 + self.vxy2

    @cached_property
    def cos_d(self):
        """Cosine of the angle between light and half vector, which Fresnel's equations take."""
        return 0.5 * np.sqrt(self.v2)

    @cached_property
    def v_xy(self):
        """The tangential components of v = i + r, in the sample's frame.

        Each is the mean of what light first and detector first give, so that exchanging the two changes no digit.
        """
        phi_i, off = np.radians(self.phi_i_deg), np.radians(np.fmod(self.phi_deg, 360) - np.copysign(180, self.phi_deg))
        phi_r, sines = phi_i + np.radians(self.phi_deg), self.sin_i + self.sin_r
        rise = self.cos_difference * self.v_z / np.where(sines > 0, sines, 1.0)  # sin θr - sin θi, without a difference
        twist, bend = np.sin(off), 2 * np.sin(0.5 * off) ** 2
        along_i, across_i = self.sin_r * bend - rise, -self.sin_r * twist
        along_r, across_r = self.sin_i * bend + rise, self.sin_i * twist
        cos_i, sin_i, cos_r, sin_r = np.cos(phi_i), np.sin(phi_i), np.cos(phi_r), np.sin(phi_r)
        x = 0.5 * ((along_i * cos_i - across_i * sin_i) + (along_r * cos_r - across_r * sin_r))
        y = 0.5 * ((along_i * sin_i + across_i * cos_i) + (along_r * sin_r + across_r * cos_r))
        return x, y

    @cached_property
    def phi_r_deg(self):
        """Azimuth of the detector in the sample's frame."""
        return self.phi_i_deg + self.phi_deg

    def offset_from(self, axis):
        """The tangential part of v = i + r along and across the azimuth `axis` [rad] of the sample."""
        x, y = self.v_xy
        cos, sin = np.cos(axis), np.sin(axis)
        return x * cos + y * sin, y * cos - x * sin

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
        """The report's reflection angle: positive on the mirror side, negative on the side of the light; at right
        angles to the plane of incidence positive, on whichever side rounding lies."""
        toward_mirror = np.where(self.sin_i < 1e-9, -np.cos(np.radians(self.phi_deg)), -self.dot_xy)
        return np.where(toward_mirror >= -ACROSS, self.theta_r_deg, -self.theta_r_deg)

    # --- other views --------------------------------------------------------------------------------

    @property
    def shape(self) -> tuple[int, ...]:
        return np.shape(self.cos_i)

    def __len__(self) -> int:
        return self.shape[0]

    def each(self, function) -> "Directions":
        """The same with a function of arrays taken of every field: an index, another shape."""
        return Directions(**{name: function(np.asanyarray(getattr(self, name))) for name in FIELDS})

    def __getitem__(self, rows) -> "Directions":
        """Some of the rows: an index, slice or mask over the first axis; zenith angles that were formed are kept."""
        picked = rows_taken(rows)
        some = self.each(picked)
        vars(some).update(
            {name: picked(vars(self)[name]) for name in ("theta_i_deg", "theta_r_deg") if name in vars(self)}
        )
        return some

    def swapped(self) -> "Directions":
        """Light and detector exchanged."""
        return replace(
            self, cos_i=self.cos_r, sin_i=self.sin_r, cos_r=self.cos_i, sin_r=self.sin_i,
            cos_difference=-self.cos_difference, phi_i_deg=self.phi_i_deg + self.phi_deg, phi_deg=-self.phi_deg,
        )  # fmt: skip

    @cached_property
    def with_light_turned(self) -> "Directions":
        """The same with the light turned by half a turn about the normal, so that its mirror direction is where it was.

        |r_xy - i_xy|² = (sin θi - sin θr)² + 4 sin θi sin θr sin² of half the azimuth, without a difference of sines.
        """
        sines, half = self.sin_i + self.sin_r, np.radians(0.5 * self.phi_deg)
        apart = self.cos_difference * self.v_z / np.where(sines > 0, sines, 1.0)
        vxy2 = apart * apart + 4 * self.sin_i * self.sin_r * np.sin(half) ** 2
        return replace(self, vxy2=vxy2, dot_xy=-self.dot_xy, phi_i_deg=self.phi_i_deg + 180, phi_deg=self.phi_deg - 180)

    @cached_property
    def transposed(self) -> "Directions":
        """(samples, 1) as (1, samples)."""
        return self.each(np.transpose)

    @cached_property
    def only_lit(self) -> "Directions":
        """The same with every unlit pair replaced by a harmless one, so that no law meets the horizon."""
        if self.all_lit:
            return self
        return self._with_unlit_at_normal()

    def _with_unlit_at_normal(self) -> "Directions":
        return Directions(
            **{name: np.where(self.lit, getattr(self, name), AT_NORMAL.get(name, 0.0)) for name in FIELDS}
        )


class _OfVectors(Directions):
    """Directions whose azimuths are not formed yet."""

    # x and y of the light, its cross product with the detector, x and y of the detector; gone where azimuths are fields
    _tangents: tuple

    @classmethod
    def made(cls, known, tangents) -> "_OfVectors":
        """Takes  the fields of KNOWN in their order."""
        new = object.__new__(cls)
        vars(new).update(zip(KNOWN, known, strict=True), _tangents=tuple(tangents))
        return new

    @property
    def _known(self) -> list:
        return [getattr(self, name) for name in KNOWN]

    @cached_property
    def phi_i_deg(self):
        """Azimuth of the light; 0 at the normal, where the detector alone says where a grain lies."""
        ix, iy, *_ = self._tangents
        return np.where((ix == 0) & (iy == 0), 0.0, np.degrees(np.arctan2(iy, ix)))

    @cached_property
    def phi_deg(self):
        ix, iy, cross, rx, ry = self._tangents
        phi, normal = np.degrees(np.arctan2(cross, self.dot_xy)), (ix == 0) & (iy == 0)
        return np.where(normal, np.degrees(np.arctan2(ry, rx)), phi) if np.any(normal) else phi

    def each(self, function) -> Directions:
        if "_tangents" not in vars(self):
            return super().each(function)
        return self.made(*([function(np.asanyarray(each)) for each in some] for some in (self._known, self._tangents)))

    def _with_unlit_at_normal(self) -> Directions:
        if "_tangents" not in vars(self):
            return super()._with_unlit_at_normal()
        known = [np.where(self.lit, getattr(self, name), AT_NORMAL.get(name, 0.0)) for name in KNOWN]
        apart = (0.0, 0.0, 0.0, -1.0, 0.0)  # the detector's azimuth at 180
        return self.made(known, (np.where(self.lit, *each) for each in zip(self._tangents, apart, strict=True)))


def rows_taken(rows) -> Callable[[np.ndarray], np.ndarray]:
    """What takes an index, slice or mask over the first axis of arrays: one look at a mask for all of them."""
    if not isinstance(rows, np.ndarray) or rows.ndim != 1:
        return lambda values: values[rows]
    places = np.flatnonzero(rows) if rows.dtype == bool else rows
    return lambda values: values.take(places, axis=0)


def gathered(parts: Sequence[Directions]) -> Directions:
    """The rows of all parts, one after the other; azimuths that are not formed stay so."""
    if all("_tangents" in vars(each) for each in parts):
        known = [np.concatenate([getattr(each, name) for each in parts]) for name in KNOWN]
        tangents = zip(*(each._tangents for each in parts if isinstance(each, _OfVectors)), strict=True)
        return _OfVectors.made(known, map(np.concatenate, tangents))
    return Directions(**{name: np.concatenate([getattr(each, name) for each in parts]) for name in FIELDS})


ACROSS = 1e-14  # sin θi sin θr cos φ, up to which a direction lies at right angles to the plane of incidence
AT_NORMAL = {"cos_i": 1.0, "cos_r": 1.0, "phi_deg": 180.0}  # a pair that meets no horizon; other fields are 0
FIELDS = tuple(field.name for field in fields(Directions))
KNOWN = FIELDS[:-2]  # all but the azimuths


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
