"""A surface with a grain as the table of a goniometer that turns the sample: one table about the mirror direction for
each rotation, all around it, for formats that hold rotations.

A sample turned by ψ, counter-clockwise, has its light at azimuth -ψ. Numbers of nodes: ours, one level.
"""

from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np

from ...data.measurement import Measurement
from ...physics.geometry import Geometry, rows
from .._directions import half_width, off_peak
from ..exporter import ColouredSurface
from .blurred import blurred
from .goniometric import CLOSE, FINEST_DEG, STEEPEST_DEG, WIDEST_DEG, GoniometerTable
from .in_table import held_in_table

ROTATIONS_DEG = np.arange(0.0, 360.0, 15.0)
THETA_I_DEG = np.arange(0.0, 86.0, 5.0)
AZIMUTH_DEG = np.arange(0.0, 360.0, 10.0)
FIRST, GROWTH = 0.12, 1.12  # first step from the mirror direction, of the narrower half width, and growth of the next
TURNED_DEG = (0.0, 45.0, 90.0, 135.0)  # under which a width is looked for, and how far off the table is


@dataclass(frozen=True, eq=False)
class TurnedSample:
    """Values (rotations, incidences, azimuths, polars, channels) [1/sr] at the nodes above and at `polar` [deg]."""

    polar: np.ndarray
    values: np.ndarray

    def read(self, geom: Geometry) -> np.ndarray:
        """BRDF (samples, channels) as a reader gets it that interpolates linearly in all four angles."""
        geom = rows(geom)
        azimuth, polar = _about_mirror(geom)
        rotation = np.remainder(-geom.phi_i_deg[:, 0], 360.0)
        around = [_around(rotation, ROTATIONS_DEG), _between(geom.theta_i_deg[:, 0], THETA_I_DEG)]
        around += [_around(azimuth, AZIMUTH_DEG), _between(polar, self.polar)]
        value: np.ndarray | float = 0.0
        for corner in np.ndindex(2, 2, 2, 2):
            ends = [
                (high, part) if side else (low, 1 - part)
                for (low, high, part), side in zip(around, corner, strict=True)
            ]
            weight = np.prod([each for _, each in ends], axis=0)
            value = value + weight[:, None] * self.values[tuple(place for place, _ in ends)]
        return np.asarray(value)


def _between(x, nodes):
    """Nodes below and above x, and how far x is toward the upper."""
    place = np.interp(x, nodes, np.arange(len(nodes)))
    low = np.minimum(place.astype(int), len(nodes) - 2)
    return low, low + 1, place - low


def _around(x, nodes):
    """The same of angles in 0..360 and even nodes, whose last is followed by the first."""
    place = x / (nodes[1] - nodes[0])
    low = np.floor(place).astype(int)
    return low % len(nodes), (low + 1) % len(nodes), place - low


def _about_mirror(geom: Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Azimuth from toward the normal, 0..360, and polar angle about the mirror direction (samples,) [deg]."""
    phi, theta_i, theta_r = (np.radians(each[:, 0]) for each in (geom.phi_deg, geom.theta_i_deg, geom.theta_r_deg))
    x, y, z = np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r)
    toward = x * np.cos(theta_i) + z * np.sin(theta_i)
    along = z * np.cos(theta_i) - x * np.sin(theta_i)
    azimuth = np.remainder(np.degrees(np.arctan2(y, toward)), 360.0)
    return azimuth, np.degrees(np.arctan2(np.hypot(toward, y), along))


def _angles(theta_i, azimuth, polar):
    """theta_r and the azimuth from the light [deg] of angles about the mirror direction."""
    i, a, p = np.radians(theta_i), np.radians(azimuth), np.radians(polar)
    x = np.cos(i) * np.sin(p) * np.cos(a) - np.sin(i) * np.cos(p)
    z = np.sin(i) * np.sin(p) * np.cos(a) + np.cos(i) * np.cos(p)
    y = np.sin(p) * np.sin(a)
    return np.degrees(np.arctan2(np.hypot(x, y), z)), np.degrees(np.arctan2(y, x))


def turned_table_of(target: str, surface: ColouredSurface, geom: Geometry | None) -> GoniometerTable:
    """The table of a surface with a grain and what it costs, in one channel: a colour becomes its luminance."""
    held = held_in_table(surface, *blurred(surface), several=False)
    brdf = held.brdf
    made, measurement = _sampled(brdf, _narrowest(held.surface))
    off = []
    for turn in TURNED_DEG:
        at, truth, where = off_peak(lambda each, turn=turn: brdf(each.at_azimuth(turn + 4.0)))
        off.append(np.abs(made.read(at.at_azimuth(turn + 4.0)) / truth - 1).ravel())
    usual, most = 100 * np.nanquantile(np.concatenate(off), (0.95, 1.0))
    note = (
        f"a table of {len(ROTATIONS_DEG)} rotations, {len(THETA_I_DEG)} incidences, {len(AZIMUTH_DEG)} azimuths and "
        f"{len(made.polar)} angles: read linearly it is within {usual:.2g} % of the surface in 95 of 100 directions "
        f"and {most:.2g} % in all, {where}, between its rotations"
    )
    note += "" if most <= 100 * CLOSE else f"; {100 * CLOSE:g} % could not be held"

    size = {"rotations": len(ROTATIONS_DEG), "theta_i": len(THETA_I_DEG), "polars": len(made.polar)}
    statement = held.stated(target, made.read, geom, size, note)
    at = measurement.geom.at(held.wavelength)
    named = Measurement(at, measurement.brdf, held.channels, name=surface.name, format=surface.model.name)
    return GoniometerTable(named, statement)


def _narrowest(surface: ColouredSurface) -> float:
    """Least half width [deg] under the turns."""
    return min(
        half_width(SimpleNamespace(spectral=lambda geom, turn=turn: surface.spectral(geom.at_azimuth(turn))))
        for turn in TURNED_DEG
    )


def _sampled(brdf, width: float) -> tuple[TurnedSample, Measurement]:
    """All nodes, and those above the horizon as what a goniometer reports."""
    polar = [0.0, float(np.clip(FIRST * width, FINEST_DEG, WIDEST_DEG))]
    while polar[-1] < 90 + STEEPEST_DEG:
        polar.append(polar[-1] + min((polar[-1] - polar[-2]) * GROWTH, WIDEST_DEG))
    nodes = np.round(polar, 3)
    theta_i, azimuth, away = np.meshgrid(THETA_I_DEG, AZIMUTH_DEG, nodes, indexing="ij")
    theta_r, phi = (each.ravel() for each in _angles(theta_i, azimuth, away))
    theta_i, away = theta_i.ravel(), away.ravel()
    lit = (theta_r < 90 - 1e-6) & ((away > 0) | (azimuth.ravel() == 0))
    values, seen = [], []
    for rotation in ROTATIONS_DEG:
        geom = rows(Geometry.from_degrees(theta_i, -rotation, np.minimum(theta_r, STEEPEST_DEG), phi - rotation))
        values.append(brdf(geom).reshape(len(THETA_I_DEG), len(AZIMUTH_DEG), len(nodes), -1))
        seen.append((theta_i[lit], np.full(int(lit.sum()), -rotation), theta_r[lit], phi[lit] - rotation))
    made = TurnedSample(nodes, np.array(values))
    directions = rows(Geometry.from_degrees(*(np.concatenate(each) for each in zip(*seen, strict=True))))
    flat = made.values.reshape(len(ROTATIONS_DEG), len(lit), -1)[:, lit].reshape(len(directions), -1)
    return made, Measurement(directions, flat, tuple(f"{place}" for place in range(flat.shape[1])))
