"""A surface with a grain as the table of a goniometer that turns the sample: one table for each rotation, all around
the mirror direction or the normal, for formats that hold rotations.

A sample turned by ψ, counter-clockwise, has its light at azimuth -ψ. Half a turn changes nothing, so that half of the
rotations are computed. Rotations and nodes are added until a reader that interpolates linearly is within TURNED_CLOSE
in 95 of 100 directions, or the table is as large as such programs take. Numbers of nodes: ours.
"""

from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from ...data import formats
from ...data.measurement import Measurement
from ...physics.geometry import Geometry, rows
from ...records import dataclass
from .. import _grained
from .._directions import half_width, off_peak
from ..exporter import ColouredSurface, Export, Exporter, refuse_mirror
from .blurred import blurred
from .goniometric import FINEST_DEG, STEEPEST_DEG, WIDEST_DEG, GoniometerTable
from .in_table import held_in_table

TURNED_CLOSE = 0.05  # of the surface, off the peak, in 95 of 100 directions: a table of four angles is large
FIRST, GROWTH = 0.12, 1.12  # first step from the mirror direction, of the narrower half width, and growth of the next
TURNED_DEG = (0.0, 45.0, 90.0, 135.0)  # under which a width is looked for, and how far off the table is


@dataclass(frozen=True)
class Steps:
    """Steps of rotation, incidence and azimuth [deg]; of the polar angle about the normal, None about the mirror
    direction. Azimuths may have several: each up to so far [deg] from the mirror direction's, where a lobe is."""

    rotation: float
    theta_i: float
    azimuth: float | tuple[tuple[float, float], ...]  # a step, or (up to, step)
    polar: float | None = None

    def azimuths(self) -> np.ndarray:
        """Nodes [deg] from 0 within a turn."""
        if not isinstance(self.azimuth, tuple):
            return np.arange(0.0, 360.0, self.azimuth)
        away = [0.0]
        for end, step in self.azimuth:
            away.extend(np.arange(away[-1] + step, end + step / 2, step))
        return np.unique(np.remainder(180.0 + np.array([*away, *(-each for each in away)]), 360.0))


ABOUT_MIRROR = (Steps(15.0, 5.0, 10.0), Steps(7.5, 5.0, 5.0), Steps(5.0, 5.0, 5.0))
# about the normal a lobe moves with the incidence, so that this step and that of azimuth near the lobe count most
ABOUT_NORMAL = (
    Steps(15.0, 10.0, 10.0, 5.0),
    Steps(7.5, 5.0, 5.0, 2.5),
    Steps(7.5, 2.5, ((45.0, 2.5), (90.0, 5.0), (180.0, 10.0)), 2.5),
    Steps(5.0, 2.5, ((30.0, 2.0), (60.0, 3.0), (120.0, 6.0), (180.0, 10.0)), 2.0),
)
IN_ROWS = (Steps(15.0, 10.0, 10.0),)  # for formats that spell out four angles beside each value


@dataclass(frozen=True, eq=False)
class TurnedSample:
    """Nodes [deg] and values (rotations, incidences, azimuths, polars, channels) [1/sr]."""

    rotation: np.ndarray
    theta_i: np.ndarray
    azimuth: np.ndarray
    polar: np.ndarray
    values: np.ndarray
    about_mirror: bool

    def read(self, geom: Geometry) -> np.ndarray:
        """BRDF (samples, channels) as a reader gets it that interpolates linearly in all four angles."""
        geom = rows(geom)
        azimuth, polar = _about_mirror(geom) if self.about_mirror else _about_normal(geom)
        rotation = np.remainder(-geom.phi_i_deg[:, 0], 360.0)
        around = [_around(rotation, self.rotation), _between(geom.theta_i_deg[:, 0], self.theta_i)]
        around += [_around(azimuth, self.azimuth), _between(polar, self.polar)]
        value: np.ndarray | float = 0.0
        for corner in np.ndindex(2, 2, 2, 2):
            ends = [
                (high, part) if side else (low, 1 - part)
                for (low, high, part), side in zip(around, corner, strict=True)
            ]
            weight = np.prod([each for _, each in ends], axis=0)
            value = value + weight[:, None] * self.values[tuple(place for place, _ in ends)]
        return np.asarray(value)

    @property
    def size(self) -> dict[str, int]:
        """How many nodes there are."""
        axes = {"rotations": self.rotation, "theta_i": self.theta_i, "azimuths": self.azimuth, "polars": self.polar}
        return {name: len(nodes) for name, nodes in axes.items()}

    def measurement(self, channels, wavelength, name: str, source: str) -> Measurement:
        """The cells above the horizon as what a goniometer reports; the pole once."""
        theta_i, azimuth, polar = (
            a.ravel() for a in np.meshgrid(self.theta_i, self.azimuth, self.polar, indexing="ij")
        )
        theta_r, phi = _angles(theta_i, azimuth, polar) if self.about_mirror else (polar, azimuth)
        lit = (theta_r < 90 - 1e-6) & ((polar > 0) | (azimuth == 0))
        light = -np.repeat(self.rotation, int(lit.sum()))
        theta_i, theta_r, phi = (np.tile(each[lit], len(self.rotation)) for each in (theta_i, theta_r, phi))
        geom = rows(Geometry.from_degrees(theta_i, light, theta_r, phi + light, np.asarray(wavelength, float)))
        values = self.values.reshape(len(self.rotation), len(lit), -1)[:, lit].reshape(len(geom), -1)
        return Measurement(geom, values, tuple(channels), name=name, format=source)


def _between(x, nodes):
    """Nodes below and above x, and how far x is toward the upper."""
    place = np.interp(x, nodes, np.arange(len(nodes)))
    low = np.minimum(place.astype(int), len(nodes) - 2)
    return low, low + 1, place - low


def _around(x, nodes):
    """The same of angles in 0..360 and nodes from 0, whose last is followed by the first."""
    place = np.interp(x, np.append(nodes, nodes[0] + 360.0), np.arange(len(nodes) + 1))
    low = np.minimum(place.astype(int), len(nodes) - 1)
    return low, (low + 1) % len(nodes), place - low


def _about_mirror(geom: Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Azimuth from toward the normal, 0..360, and polar angle about the mirror direction (samples,) [deg]."""
    phi, theta_i, theta_r = (np.radians(each[:, 0]) for each in (geom.phi_deg, geom.theta_i_deg, geom.theta_r_deg))
    x, y, z = np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r)
    toward = x * np.cos(theta_i) + z * np.sin(theta_i)
    along = z * np.cos(theta_i) - x * np.sin(theta_i)
    azimuth = np.remainder(np.degrees(np.arctan2(y, toward)), 360.0)
    return azimuth, np.degrees(np.arctan2(np.hypot(toward, y), along))


def _about_normal(geom: Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Azimuth from the light, 0..360, and polar angle about the normal (samples,) [deg]."""
    return np.remainder(geom.phi_deg[:, 0], 360.0), geom.theta_r_deg[:, 0]


def _angles(theta_i, azimuth, polar):
    """theta_r and the azimuth from the light [deg] of angles about the mirror direction."""
    i, a, p = np.radians(theta_i), np.radians(azimuth), np.radians(polar)
    x = np.cos(i) * np.sin(p) * np.cos(a) - np.sin(i) * np.cos(p)
    z = np.sin(i) * np.sin(p) * np.cos(a) + np.cos(i) * np.cos(p)
    y = np.sin(p) * np.sin(a)
    return np.degrees(np.arctan2(np.hypot(x, y), z)), np.degrees(np.arctan2(y, x))


def with_rotations(round_: Exporter, *, several: bool = False, levels: Sequence[Steps] = ABOUT_MIRROR) -> Exporter:
    """The exporter of such tables that writes a surface with a grain under rotations; `several` says that the format
    holds several channels, `levels` are tried in order."""

    def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
        """The text and its Statement."""
        if not _grained.terms_that_turn(surface):
            return round_.export(surface, geom, stem)
        made = turned_table_of(round_.name, surface, geom, levels, several=several)
        text, notes = formats.write(round_.name, made.measurement)
        return Export(text, replace(made.statement, notes=(*made.statement.notes, *notes)))

    return replace(round_, export=export, grained=True)


def turned_table_of(
    target: str, surface: ColouredSurface, geom: Geometry | None, levels: Sequence[Steps], *, several: bool
) -> GoniometerTable:
    """The table of a surface with a grain and what it costs; in a format of one channel a colour becomes its
    luminance."""
    about_mirror = levels[0].polar is None
    kept, lost = blurred(surface) if about_mirror else (surface, refuse_mirror(surface, target, "zemax"))
    held = held_in_table(surface, kept, lost, several=several)
    made, note = _closest(held.brdf, _narrowest(kept), levels)
    statement = held.stated(target, made.read, geom, made.size, note)
    measurement = made.measurement(held.channels, held.wavelength, surface.name, surface.model.name)
    return GoniometerTable(measurement, statement)


def _closest(brdf, width: float, levels: Sequence[Steps]) -> tuple[TurnedSample, str]:
    """The first level within TURNED_CLOSE off the peak, or the last, and the sentence on it."""
    for steps in levels:
        made, off = _at_nodes(brdf, steps, width), []
        for turn in TURNED_DEG:
            between = turn + 0.27 * steps.rotation  # of two rotations
            at, truth, where = off_peak(lambda each, between=between: brdf(each.at_azimuth(between)))
            off.append(np.abs(made.read(at.at_azimuth(between)) / truth - 1).ravel())
        usual, most = 100 * np.nanquantile(np.concatenate(off), (0.95, 1.0))
        if usual <= 100 * TURNED_CLOSE:
            break
    rotations, incidences, azimuths, polars = made.size.values()
    held = "" if usual <= 100 * TURNED_CLOSE else f"; {100 * TURNED_CLOSE:g} % could not be held"
    note = (
        f"a table of {rotations} rotations, {incidences} incidences, {azimuths} azimuths and {polars} angles: read "
        f"linearly it is within {usual:.2g} % of the surface in 95 of 100 directions and {most:.2g} % in all, {where}, "
        f"between its rotations{held}"
    )
    return made, note


def _narrowest(surface: ColouredSurface) -> float:
    """Least half width [deg] under the turns."""
    return min(
        half_width(SimpleNamespace(spectral=lambda geom, turn=turn: surface.spectral(geom.at_azimuth(turn))))
        for turn in TURNED_DEG
    )


def _at_nodes(brdf, steps: Steps, width: float) -> TurnedSample:
    """A surface at the nodes of a level; `width` [deg] is the half width of its lobe. Below the horizon the value there
    goes on."""
    rotation, azimuth = np.arange(0.0, 360.0, steps.rotation), steps.azimuths()
    theta_i = np.unique(np.append(np.arange(0.0, 86.0, steps.theta_i), 85.0))
    polar = _polar(width) if steps.polar is None else np.append(np.arange(0.0, 89.0, steps.polar), STEEPEST_DEG)
    light, around, away = (a.ravel() for a in np.meshgrid(theta_i, azimuth, polar, indexing="ij"))
    theta_r, phi = _angles(light, around, away) if steps.polar is None else (away, around)
    theta_r, half = np.minimum(theta_r, STEEPEST_DEG), []
    for turned in rotation[: len(rotation) // 2]:
        geom = rows(Geometry.from_degrees(light, -turned, theta_r, phi - turned))
        half.append(brdf(geom).reshape(len(theta_i), len(azimuth), len(polar), -1))
    values = np.array(half)
    return TurnedSample(rotation, theta_i, azimuth, polar, np.concatenate((values, values)), steps.polar is None)


def _polar(width: float) -> np.ndarray:
    """Angles from the mirror direction [deg], closer together there."""
    polar = [0.0, float(np.clip(FIRST * width, FINEST_DEG, WIDEST_DEG))]
    while polar[-1] < 90 + STEEPEST_DEG:
        polar.append(polar[-1] + min((polar[-1] - polar[-2]) * GROWTH, WIDEST_DEG))
    return np.round(polar, 3)
