"""Where a measurement is drawn: its own scans in the plane of incidence, or a table and scattered directions sliced.

A slice is interpolated where the data are smooth, in the angles of the half vector and of the difference (Rusinkiewicz
1998), and never beyond them.
"""

from dataclasses import replace

import numpy as np

from ...data.measurement import Measurement
from ...data.turning import turn_of_each
from ...physics.geometry import Geometry, in_plane, rows
from ...records import dataclass

# (azimuth off the plane, spread of theta_i) [deg]: as narrow a slice of the data as still has points in it
SCAN, *NEARLY = ((0.1, 0.05), (2.0, 0.5), (5.0, 2.5), (10.0, 5.0))
LEAST_POINTS = 5
ENOUGH_POINTS = 12  # of a scan that needs no interpolation
SCANNED = 0.1  # share of the values that lie in the plane where it was scanned; less is a table over the hemisphere
INCIDENCES = (10.0, 45.0, 75.0)  # of a slice where the data have no incidences of their own
MOST_OWN = 12  # incidences that are the data's own; with more they are a table
STEPS = np.arange(-85.0, 85.1, 1.0)  # theta_r of a slice [deg]
NEIGHBOURS = 12
FAR, FARTHEST = 4.0, 12.0  # from where on the data are too far, in cells of about one degree; where they lie thin
THIN = 2.0  # of the usual distance, where that is more than `FAR`
STIFF = 0.3  # squared cells: slopes are told by values that are spread by more than their root
BEYOND = 3.0  # cells that a slice may reach beyond the values that it is made of
MOST_NEAR = 40_000  # samples beside the plane that a slice is made of


@dataclass(frozen=True)
class Panel:
    """Values at one incidence, in or near the plane."""

    theta_i: float
    theta_r: np.ndarray  # signed, positive on the mirror side [deg]
    value: np.ndarray  # [1/sr]
    geom: Geometry  # of these values, rows
    rows: np.ndarray | None = None  # of the measurement; None where it is interpolated
    azimuth: float = 0.0  # of the light [deg], where the sample was turned


@dataclass(frozen=True)
class Panels:
    """What is drawn of a measurement, least incidence first, and how it was come by."""

    shown: tuple[Panel, ...]
    how: str


def panels(measurement: Measurement, channel: int, most: int = 3) -> Panels:
    """Well-spread incidences with their values; none where no direction is near the plane of incidence."""
    turns = turn_of_each(measurement.geom)
    if turns is not None and measurement.in_plane:
        return _of_one_turn(measurement, turns, channel, most)
    usable = measurement.usable[:, channel]
    if not usable.any():
        return Panels((), "no value")
    scans, complete = _scans(measurement, channel, *SCAN)
    enough = complete >= min(most, _distinct(measurement.geom.theta_i_deg[usable, 0]))
    scanned = sum(len(each.value) for each in scans) >= SCANNED * np.count_nonzero(usable)
    if scans and (
        measurement.in_plane or (enough and scanned and min(len(each.value) for each in scans) >= ENOUGH_POINTS)
    ):
        return Panels(_spread(scans, most), "in plane")
    sliced = [_slice(measurement, channel, theta_i) for theta_i in _incidences(measurement, usable, most)]
    sliced = [each for each in sliced if len(each.value) >= ENOUGH_POINTS]
    if sliced:
        return Panels(tuple(sliced), "interpolated into the plane")
    for off_plane, spread in (SCAN, *NEARLY):
        near, complete = _scans(measurement, channel, off_plane, spread)
        if near and complete >= min(most, _distinct(measurement.geom.theta_i_deg[usable, 0])):
            break
    where = "in plane" if off_plane < 1 else f"within {off_plane:g}° of the plane of incidence"
    return Panels(_spread(near, most), where)


def _of_one_turn(measurement: Measurement, turns, channel: int, most: int) -> Panels:
    """The same of the first turn of the sample alone: scans of several turns are no one curve."""
    picked = np.flatnonzero(turns == turns[np.argmin(np.remainder(measurement.geom.phi_i_deg[:, 0], 180.0))])
    azimuth = float(np.median(np.remainder(measurement.geom.phi_i_deg[picked, 0], 180.0)))
    found = panels(measurement[picked], channel, most)
    shown = tuple(
        replace(each, rows=None if each.rows is None else picked[each.rows], azimuth=azimuth) for each in found.shown
    )
    return Panels(shown, f"{found.how}, light at azimuth {azimuth:g}°")


def _scans(measurement: Measurement, channel: int, off_plane: float, spread: float) -> tuple[list[Panel], int]:
    """Every incidence with enough values that near the plane, and how many there are."""
    theta_i, usable = measurement.geom.theta_i_deg[:, 0], measurement.usable[:, channel]
    near = usable & (measurement.geom.off_plane_deg[:, 0] <= off_plane)
    found = []
    for centre in np.unique(np.round(theta_i[near], 1)):
        picked = np.flatnonzero(near & (np.abs(theta_i - centre) <= spread))
        if picked.size >= LEAST_POINTS:
            geom = measurement.geom[picked]
            value = measurement.brdf[picked, channel]
            found.append(Panel(float(centre), geom.signed_theta_r_deg[:, 0], value, geom, picked))
    return found, len(found)


def _spread(found: list[Panel], most: int) -> tuple[Panel, ...]:
    """The least, the largest, and those nearest to even steps between."""
    if not found:
        return ()
    angles = np.array([each.theta_i for each in found])
    wanted = np.linspace(angles.min(), angles.max(), min(most, len(found)))
    return tuple(found[place] for place in sorted({int(np.argmin(np.abs(angles - target))) for target in wanted}))


def _distinct(theta_i) -> int:
    """Incidences that differ by about five degrees."""
    return np.unique(np.round(theta_i / 5)).size


def _incidences(measurement: Measurement, usable, most: int) -> list[float]:
    """Where to slice: at the data's own incidences if these are few, else at 10, 45 and 75 degrees."""
    own = np.array(list(measurement.theta_i_groups))
    theta_i = measurement.geom.theta_i_deg[usable, 0]
    if len(own) <= MOST_OWN:
        wanted = np.linspace(own.min(), own.max(), min(most, len(own)))
        return sorted({float(own[np.argmin(np.abs(own - target))]) for target in wanted})
    inside = [each for each in INCIDENCES if theta_i.min() - 1 <= each <= theta_i.max() + 1]
    return inside or [float(np.median(theta_i))]


def _slice(measurement: Measurement, channel: int, theta_i: float) -> Panel:
    geom = rows(in_plane(theta_i, STEPS))
    value = sliced(measurement, channel, geom)
    there = np.isfinite(value)
    return Panel(theta_i, STEPS[there], value[there], geom[there])


def sliced(measurement: Measurement, channel: int, geom: Geometry) -> np.ndarray:
    """A channel of the data at other directions [1/sr] (samples,); NaN where none of them is near.

    A plane through ln of the nearest values, weighed by their distance in half-vector coordinates.
    """
    wanted = _half_coordinates(geom)
    usable = np.flatnonzero(measurement.usable[:, channel])
    own = _half_coordinates(measurement.geom[usable])
    apart = np.abs(own[:, 1] - np.median(wanted[:, 1]))
    if len(usable) > MOST_NEAR:
        kept = apart <= max(np.partition(apart, MOST_NEAR)[MOST_NEAR], 1.0)
        usable, own = usable[kept], own[kept]
    count = min(NEIGHBOURS, len(usable))
    out, third = np.full(len(wanted), np.nan), np.full(len(wanted), np.inf)
    among = np.zeros(len(wanted), bool)
    ln = np.log(measurement.brdf[usable, channel])
    for place, each in enumerate(wanted):
        squared = np.sum((own - each) ** 2, axis=1)
        nearest = np.argpartition(squared, count - 1)[:count]
        nearest = nearest[np.argsort(squared[nearest])]
        distance = np.sqrt(squared[nearest])
        third[place] = distance[min(2, count - 1)]
        out[place] = np.exp(_plane_through(own[nearest] - each, distance, ln[nearest]))
        among[place] = _is_among(own[nearest] - each)
    near = among & (third <= np.clip(THIN * np.quantile(third, 0.25), FAR, FARTHEST))
    return np.where(near, out, np.nan)


def _is_among(offset) -> bool:
    """Whether values lie on both sides along the first and the last coordinate, or near on one."""
    along = offset[:, (0, 2)]
    both = (along.min(axis=0) <= 0) & (along.max(axis=0) >= 0)
    return bool(np.all(both | (np.abs(along).min(axis=0) <= BEYOND)))


def _plane_through(offset, distance, ln) -> float:
    """The height at 0 of a weighed plane over the first and the last coordinate; no higher and no lower than what it
    goes through. It is level along a coordinate where all values lie on one side, and nearly so where they lie close
    together: there nothing tells its slope.
    """
    width = max(distance[len(distance) // 2], 0.5)
    weight = np.exp(-0.5 * (distance / width) ** 2)
    along = offset[:, (0, 2)]
    along = along * ((along.min(axis=0) <= 0) & (along.max(axis=0) >= 0))
    basis = np.concatenate([np.ones((len(ln), 1)), along], axis=1)
    square = (basis * weight[:, None]).T @ basis + np.diag([0.0, STIFF, STIFF])
    height = np.linalg.solve(square, basis.T @ (weight * ln))[0]
    return float(np.clip(height, ln.min(), ln.max()))


def _half_coordinates(geom: Geometry) -> np.ndarray:
    """(samples, 3): √θh along and across the plane, and θd, in cells of a table of half-vector angles.

    cos θr - cos θi = 2 sin θh sin θd cos φd. Across is without a sign: what it is of does not tell left from right.
    """
    tan2 = geom.tan2_h[:, 0]
    theta_d = np.degrees(np.arccos(np.clip(geom.cos_d[:, 0], -1.0, 1.0)))
    tilt = np.degrees(np.arctan(np.sqrt(tan2)))
    a = 90.0 * np.sqrt(tilt / 90.0)
    full = 2 * np.sqrt(tan2 / (1 + tan2)) * np.sin(np.radians(theta_d))
    with np.errstate(divide="ignore", invalid="ignore"):
        cos_phi = np.where(full > 1e-9, (geom.cos_r - geom.cos_i)[:, 0] / full, 1.0)
    cos_phi = np.clip(cos_phi, -1.0, 1.0)
    return np.stack([a * cos_phi, a * np.sqrt(1 - cos_phi**2), theta_d], axis=1)
