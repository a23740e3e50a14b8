"""A surface as the table that a goniometer would have measured, for programs that read such tables.

About the mirror direction the angles are close there and wide elsewhere, since a lobe keeps its shape there from one
incidence to the next; about the normal they are even, but for azimuths, which are close near that of the mirror
direction. There are more of them until a reader that interpolates linearly is within `CLOSE` of the surface, or the
table is as large as such programs take; how far off it is stands beside it.
Numbers of nodes: ours.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ...data import formats
from ...data.measurement import Measurement
from ...errors import InputError
from ...physics.colour import CHANNEL_UM
from ...physics.geometry import Geometry, rows
from ...printable import off_words
from ...records import dataclass
from .._directions import half_width, off_peak
from ..exporter import ColouredSurface, Export, Exporter, Statement, refuse_mirror
from .blurred import blurred
from .in_table import held_in_table

CLOSE = 0.01  # of the surface, off the peak
STEEPEST_DEG = 89.5  # the last incidence and reflected angle
WIDEST_DEG = 5.0  # between two angles from the mirror direction
FINEST_DEG = 0.02  # the first of them
LEVELS = (  # steps of incidence and azimuth [deg], first step as a part of the lobe's half width, growth of the next
    (10.0, 15.0, 0.25, 1.25),
    (5.0, 10.0, 0.12, 1.12),
    (2.5, 6.0, 0.06, 1.06),
    (1.25, 4.0, 0.05, 1.05),
)
# steps of incidence, of azimuth away from the mirror direction, and of the angle [deg]
ABOUT_NORMAL = ((10.0, 10.0, 5.0), (5.0, 6.0, 2.5), (2.5, 5.0, 1.5), (1.25, 4.0, 1.0))
NEAR, NEAR_GROWTH, NEAREST_DEG = 0.12, 1.2, 0.1  # of azimuths there: first step over half width, growth, the finest


OF_DENSE = ("average_phi_i", "wavelength")  # options that a dense table heeds when it is sampled
ABOUT_THE_NORMAL = ("lighttools", "speos", "speos-anisotropic")  # formats whose angles count from the normal
WIDTH_DEG = 2.0  # taken for the half width of a lobe in a table, whose cells are wider


@dataclass(frozen=True, eq=False)
class Sampled:
    """Nodes [deg] and values (incidences, azimuths, polars, channels) [1/sr] of a plane-symmetric surface."""

    theta_i: np.ndarray
    azimuth: np.ndarray  # 0..180; about the normal from the light, about the mirror direction from toward the normal
    polar: np.ndarray
    values: np.ndarray
    about_mirror: bool

    def read(self, geom: Geometry) -> np.ndarray:
        """BRDF (samples, channels) as a reader gets it that interpolates linearly in all three angles."""
        azimuth, polar = _angles(rows(geom), self.about_mirror)
        value: np.ndarray | float = 0.0
        cells = [
            _cell(each, nodes)
            for each, nodes in (
                (rows(geom).theta_i_deg[:, 0], self.theta_i),
                (azimuth, self.azimuth),
                (polar, self.polar),
            )
        ]
        (i, p), (j, q), (k, r) = cells
        for a, weight_a in ((0, 1 - p), (1, p)):
            for b, weight_b in ((0, 1 - q), (1, q)):
                for c, weight_c in ((0, 1 - r), (1, r)):
                    value = value + (weight_a * weight_b * weight_c)[:, None] * self.values[i + a, j + b, k + c]
        return np.asarray(value)

    def measurement(self, channels, wavelength, name: str, source: str) -> Measurement:
        """The cells above the horizon as what a goniometer reports; the pole once."""
        theta_i, azimuth, polar = np.meshgrid(self.theta_i, self.azimuth, self.polar, indexing="ij")
        theta_r, phi = _directions(theta_i, azimuth, polar, self.about_mirror)
        lit = (theta_r < 90 - 1e-6) & ((polar > 0) | (azimuth == self.azimuth[0]))
        geom = rows(Geometry.from_degrees(theta_i[lit], 0.0, theta_r[lit], phi[lit], np.asarray(wavelength, float)))
        return Measurement(geom, self.values[lit], tuple(channels), name=name, format=source)


def _cell(x, nodes) -> tuple[np.ndarray, np.ndarray]:
    place = np.interp(x, nodes, np.arange(len(nodes)))
    low = np.minimum(place.astype(int), len(nodes) - 2)
    return low, place - low


def _angles(geom: Geometry, about_mirror: bool) -> tuple[np.ndarray, np.ndarray]:
    """Azimuth folded to 0..180 and polar angle (samples,) [deg]."""
    phi, theta_i, theta_r = (np.radians(each[:, 0]) for each in (geom.phi_deg, geom.theta_i_deg, geom.theta_r_deg))
    if not about_mirror:
        turned = np.remainder(np.degrees(phi), 360.0)
        return np.minimum(turned, 360.0 - turned), np.degrees(theta_r)
    x, y, z = np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r)
    toward = x * np.cos(theta_i) + z * np.sin(theta_i)
    along = z * np.cos(theta_i) - x * np.sin(theta_i)
    return np.degrees(np.arctan2(np.abs(y), toward)), np.degrees(np.arctan2(np.hypot(toward, y), along))


def _directions(theta_i, azimuth, polar, about_mirror: bool) -> tuple[np.ndarray, np.ndarray]:
    """theta_r and the azimuth from the light [deg]."""
    if not about_mirror:
        return polar, azimuth
    i, a, p = np.radians(theta_i), np.radians(azimuth), np.radians(polar)
    x = np.cos(i) * np.sin(p) * np.cos(a) - np.sin(i) * np.cos(p)
    z = np.sin(i) * np.sin(p) * np.cos(a) + np.cos(i) * np.cos(p)
    y = np.sin(p) * np.sin(a)
    return np.degrees(np.arctan2(np.hypot(x, y), z)), np.degrees(np.arctan2(y, x))


def at_nodes(brdf: Callable[[Geometry], np.ndarray], level: int, width: float, about_mirror: bool) -> Sampled:
    """A surface at the nodes of a level; `width` [deg] is the half width of its lobe.

    Takes  brdf(geometry (samples, 1)) -> (samples, channels) [1/sr].    Below the horizon the value there goes on.
    """
    if about_mirror:
        step_i, step_a, part, growth = LEVELS[level]
        first = np.clip(part * width, FINEST_DEG, WIDEST_DEG)
        nodes = np.round(_growing(first, growth, WIDEST_DEG, 90 + STEEPEST_DEG), 3)
    else:
        step_i, step_a, step = ABOUT_NORMAL[level]
        nodes = np.append(np.arange(0.0, 89.0, step), STEEPEST_DEG)
    theta_i = np.append(np.arange(0.0, 86.0, step_i), 85.0 if step_i > 5 else STEEPEST_DEG - 1)
    theta_i = np.unique(theta_i)
    azimuth = np.arange(0.0, 180.0 + step_a / 2, step_a) if about_mirror else _azimuths(width, step_a)
    light, around, away = np.meshgrid(theta_i, azimuth, nodes, indexing="ij")
    theta_r, phi = _directions(light, around, away, about_mirror)
    geom = rows(Geometry.from_degrees(light.ravel(), 0.0, np.minimum(theta_r, STEEPEST_DEG).ravel(), phi.ravel()))
    return Sampled(theta_i, azimuth, nodes, brdf(geom).reshape(*light.shape, -1), about_mirror)


def _azimuths(width: float, widest: float) -> np.ndarray:
    """0..180 [deg] about the normal: a lobe of half width `width` is as narrow across as in the plane of incidence."""
    away = _growing(np.clip(NEAR * width, NEAREST_DEG, widest), NEAR_GROWTH, widest, 180.0)
    return np.unique(np.round(np.append(0.0, 180.0 - np.array(away[:-1])), 3))


def _growing(first: float, growth: float, widest: float, end: float) -> list[float]:
    """0 and on until `end`, in steps that grow from the first by a factor, up to the widest."""
    nodes = [0.0, float(first)]
    while nodes[-1] < end:
        nodes.append(nodes[-1] + min((nodes[-1] - nodes[-2]) * growth, widest))
    return nodes


@dataclass(frozen=True)
class GoniometerTable:
    """A table with what it costs."""

    measurement: Measurement
    statement: Statement


def goniometric_exporter(module: str, suffix: str, what: str, *, several: bool, turned: str = "zemax") -> Exporter:
    """The exporter to a format of such tables; `several` says that the format holds several channels, `turned` names
    the nearest that holds rotations."""

    def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
        """The text and its Statement."""
        made = table_of(exporter.name, surface, geom, several=several)
        text, notes = formats.write(exporter.name, made.measurement)
        return Export(text, replace(made.statement, notes=(*made.statement.notes, *notes)))

    exporter = Exporter(module, suffix, what, export, named=False, turned=turned)
    return exporter


def table_of(target: str, surface: ColouredSurface, geom: Geometry | None, *, several: bool) -> GoniometerTable:
    """The table of a surface and what it costs; `several` says that the format holds several channels.

    A colour in a format of one channel becomes its luminance, and the statement says that colour is lost.
    """
    about_mirror = _counts_from_mirror(target)
    # even steps about the normal are wider than the lobe that a mirror is blurred to
    kept, lost = blurred(surface) if about_mirror else (surface, refuse_mirror(surface, target, "zemax"))
    width, finest = half_width(kept), ABOUT_NORMAL[-1][-1]
    if not about_mirror and width < finest:
        between = f"its lobe, {width:.2g} degrees wide, lies between angles {finest:g} apart; zemax has them as close"
        lost = (*lost, between)
    held = held_in_table(surface, kept, lost, several=several)
    made, note = _closest(held.brdf, width, about_mirror)
    size = {"theta_i": len(made.theta_i), "azimuths": len(made.azimuth), "polars": len(made.polar)}
    statement = held.stated(target, made.read, geom, size, note)
    measurement = made.measurement(held.channels, held.wavelength, surface.name, surface.model.name)
    return GoniometerTable(measurement, statement)


def _counts_from_mirror(target: str) -> bool:
    """Whether a format's angles count from the mirror direction."""
    return target not in ABOUT_THE_NORMAL


def _closest(brdf, width: float, about_mirror: bool) -> tuple[Sampled, str]:
    """The first level within CLOSE off the peak, or the finest, and the sentence on it."""
    judged, truth, where = off_peak(brdf)
    count = len(LEVELS if about_mirror else ABOUT_NORMAL)
    for level in range(count):
        made = at_nodes(brdf, level, width, about_mirror)
        off = np.abs(made.read(judged) / truth - 1)
        usual, most = (100 * np.nanquantile(off, (0.95, 1.0))) if np.isfinite(off).any() else (0.0, 0.0)
        if most <= 100 * CLOSE:
            break
    held = "" if most <= 100 * CLOSE else f"; {100 * CLOSE:g} % could not be held"
    note = (
        f"a table of {len(made.theta_i)} incidences, {len(made.azimuth)} azimuths and {len(made.polar)} angles: read "
        f"linearly it is within {off_words(usual)} of the surface in 95 of 100 directions and {off_words(most)} in "
        f"all, {where}"
    )
    return made, note + held


def of_dense_table(path, target: str, options: dict) -> tuple[Measurement, list[str]] | None:
    """A dense table at the angles of a goniometer, and the sentence on it; None for scattered samples.

    Raises InputError for options that it cannot heed.
    """
    format, source = formats.opened(path)
    if format.function is None:
        return None
    given = [name for name, value in options.items() if value and name not in OF_DENSE]
    if given:
        named = ", ".join(f"--{name.replace('_', '-')}" for name in given)
        raise InputError(
            f"{source.name}: {named}: a dense table is sampled whole; convert to .csv to take a part of it"
        )
    function, channels = formats.function(path, average_phi_i=options.get("average_phi_i", False))
    um = np.array([CHANNEL_UM.get(name) or float(name.removesuffix("nm")) / 1000 for name in channels])

    def brdf(geom: Geometry) -> np.ndarray:
        return np.nan_to_num(np.maximum(function(geom), 0.0))

    made, note = _closest(brdf, WIDTH_DEG, _counts_from_mirror(target))
    measurement = made.measurement(channels, um, str(path), format.name)
    return formats.user_selection(measurement, wavelength=options.get("wavelength")), [note]
