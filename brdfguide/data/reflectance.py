"""Directional-hemispherical reflectance out of scattered samples: how much light comes back, if the coverage tells."""

import numpy as np

from ..records import dataclass
from .measurement import Measurement

RINGS = 24  # of the quadrature about the mirror direction, on the disc where areas are cos theta_r dω
SPOKES = 24
NEIGHBOURS = 8
MOST = 4000  # samples of one incidence that are looked at
INCIDENCES = 7  # how many are integrated


@dataclass(frozen=True)
class Reflectance:
    """For each incidence [deg]: reflectance within `to_deg` of the normal, brightest channel, and how it was found."""

    theta_i_deg: tuple[float, ...]
    values: tuple[float, ...]
    least: tuple[float, ...]  # what they are at least, whatever the values do between the samples
    to_deg: float
    how: str  # hemisphere: integrated; plane: the least that in-plane data allow


def measured_reflectance(measurement: Measurement, without=None) -> Reflectance | None:
    """Reflectance at up to seven incidences with enough samples; None where the coverage does not tell.

    `without` masks rows.
    """
    if len(measurement.geom) > 200_000:
        return _of_half_difference_cells(measurement)
    usable = measurement.usable if without is None else measurement.usable & ~without[:, None]
    geom, level = measurement.geom, np.where(usable, np.log(np.where(usable, measurement.brdf, 1.0)), np.nan)
    rows = np.flatnonzero(np.any(usable, axis=1))
    if len(rows) < 12:
        return None
    channel = int(np.argmax(np.sum(np.where(usable, measurement.brdf, 0.0) * geom.cos_r, axis=0)))
    found, limits, how = {}, [], "plane" if measurement.in_plane else "hemisphere"
    one = _least_of_plane if how == "plane" else _of_hemisphere
    for angle, group in _incidences(measurement, rows):
        group = group[np.isfinite(level[group, channel])]
        angular_range = float(np.percentile(geom.theta_r_deg[group], 98)) if len(group) >= 12 else 0.0
        if angular_range < 40:
            continue
        value = one(
            geom[group[:: len(group) // MOST + 1]], level[group[:: len(group) // MOST + 1], channel], angular_range
        )
        if value is not None:
            found[angle] = value
            limits.append(angular_range)
    if not found:
        return None
    values, least = zip(*found.values(), strict=True)
    return Reflectance(tuple(found), values, least, float(np.median(limits)), how)


def _incidences(measurement: Measurement, rows):
    """(incidence, its rows), up to seven below 80 degrees; bands of 4 degrees where the incidence was not held."""
    theta_i = measurement.geom.theta_i_deg[rows, 0]
    angles, counts = np.unique(np.round(theta_i, 1), return_counts=True)
    if np.median(counts) < 12:
        theta_i = np.round(theta_i / 4) * 4
        angles, counts = np.unique(theta_i, return_counts=True)
    angles = angles[(counts >= 12) & (angles < 80.5)]
    for angle in angles[np.unique(np.linspace(0, len(angles) - 1, INCIDENCES).astype(int))] if len(angles) else []:
        yield float(angle), rows[np.abs(theta_i - angle) < 0.06]


def _of_half_difference_cells(measurement: Measurement) -> Reflectance | None:
    """Of a whole table whose cells are even in the root of theta_h, in theta_d and in phi_d, such as MERL's.

    The mean of f over the cells of a band of incidences, each weighted by cos theta_r and by the directions it covers,
    sin theta_h √theta_h sin theta_d cos theta_d, times pi.
    """
    geom = measurement.geom
    channel = int(np.argmax(np.sum(np.where(measurement.usable, measurement.brdf, 0.0), axis=0)))
    good = np.flatnonzero(measurement.usable[:, channel] & (geom.theta_r_deg[:, 0] < 80.5))
    theta_i, found = geom.theta_i_deg[good, 0], {}
    for angle in range(10, 80, 10):
        band = good[np.abs(theta_i - angle) < 1.5]
        if len(band) > 500:
            part = geom[band]
            theta_h, cos_d = np.arctan(np.sqrt(part.tan2_h)), np.minimum(part.cos_d, 1.0)
            weight = part.cos_r * np.sin(theta_h) * np.sqrt(theta_h) * np.sqrt(1 - cos_d**2) * cos_d
            mean = np.average(measurement.brdf[band, channel], weights=weight[:, 0])
            found[float(angle)] = float(np.pi * np.sin(np.radians(80)) ** 2 * mean)
    return (
        Reflectance(tuple(found), tuple(found.values()), tuple(found.values()), 80.0, "hemisphere") if found else None
    )


def _of_hemisphere(geom, level, angular_range: float) -> tuple[float, float] | None:
    """Integral of f cos over the directions within `angular_range` [deg], and what it is at least; None where less than
    four azimuths were measured."""
    phi = np.radians(np.abs(np.remainder(geom.phi_deg[:, 0] + 180.0, 360.0) - 180.0))
    top = np.sin(np.radians(angular_range)) ** 2
    if len(np.unique(np.round(np.degrees(phi) / 10))) < 4:
        if geom.theta_i_deg[0, 0] > 5:
            return None
        order = np.argsort(geom.sin_r[:, 0])  # light along the normal: the same all around
        share = (np.arange(1000) + 0.5) / 1000
        fine = np.interp(np.sqrt(top) * share**3, geom.sin_r[order, 0], level[order])
        floor = np.interp(np.sqrt(top) * share**3, geom.sin_r[order, 0], _no_higher_than_neighbours(level[order]))
        value, least = (float(np.average(np.exp(each), weights=share**5) * np.pi * top) for each in (fine, floor))
        return value, least
    places = np.stack([geom.sin_r[:, 0] * np.cos(phi), geom.sin_r[:, 0] * np.sin(phi)], axis=1)
    nodes, areas = _about_the_mirror(min(float(geom.sin_i[0, 0]), 0.98 * np.sqrt(top)), np.sqrt(top))
    value, least = (float(np.exp(each) @ areas * np.pi * top) for each in _interpolated(nodes, places, level))
    return value, least


def _about_the_mirror(distance: float, radius: float):
    """Nodes on the upper half of the disc of projected directions, crowded about its point (-distance, 0), and their
    shares of its area."""
    angle = (np.arange(SPOKES) + 0.5) / SPOKES * np.pi
    edge = distance * np.cos(angle) + np.sqrt(radius**2 - (distance * np.sin(angle)) ** 2)  # how far each spoke reaches
    share = (np.arange(RINGS) + 0.5) / RINGS
    reached = edge * share[:, None] ** 3
    areas = reached * edge * share[:, None] ** 2
    nodes = np.stack([reached * np.cos(angle) - distance, reached * np.sin(angle)], axis=-1).reshape(-1, 2)
    return nodes, areas.ravel() / areas.sum()


def _no_higher_than_neighbours(level) -> np.ndarray:
    """Each value of a scan, or the higher of its neighbours where it stands above both."""
    sides = np.r_[-np.inf, level[:-1]], np.r_[level[1:], -np.inf]
    return np.minimum(level, np.maximum(*sides))


def _interpolated(nodes, places, level):
    """A plane through the nearest samples in ln f, kept within what they span; and the lowest of the four nearest."""
    values, lowest = np.empty(len(nodes)), np.empty(len(nodes))
    count = min(NEIGHBOURS, len(places))
    for start in range(0, len(nodes), 256):
        block = nodes[start : start + 256]
        apart = np.sum((block[:, None] - places[None]) ** 2, axis=2)
        near = np.argpartition(apart, count - 1, axis=1)[:, :count]
        squared = np.take_along_axis(apart, near, axis=1)
        weight = 1 / (squared + 1e-3 * squared.max(axis=1, keepdims=True) + 1e-12) ** 2
        weight /= weight.sum(axis=1, keepdims=True)
        local = places[near] - block[:, None]
        design = np.concatenate([np.ones((*local.shape[:2], 1)), local], axis=2)
        across = np.swapaxes(design * weight[..., None], 1, 2)
        normal = across @ design + np.diag([0.0, 1e-6, 1e-6])
        plane = np.linalg.solve(normal, across @ level[near][..., None])[:, 0, 0]
        values[start : start + 256] = np.clip(plane, level[near].min(axis=1), level[near].max(axis=1))
        nearest = np.take_along_axis(near, np.argsort(squared, axis=1)[:, :4], axis=1)
        lowest[start : start + 256] = level[nearest].min(axis=1)
    return values, lowest


def _least_of_plane(geom, level, angular_range: float) -> tuple[float, float] | None:
    """The least reflectance that in-plane data allow: at every theta_r the darker side, all around.

    None for one-sided data.
    """
    signed = geom.signed_theta_r_deg[:, 0]
    sides = []
    for sign in (1, -1):
        side = signed * sign >= 0
        if np.count_nonzero(side) < 4 or (signed[side] * sign).max() < 0.8 * angular_range:
            return None
        order = np.argsort(signed[side] * sign)
        sides.append((signed[side][order] * sign, level[side][order]))
    theta = np.degrees(np.arcsin(np.sqrt((np.arange(200) + 0.5) / 200) * np.sin(np.radians(angular_range))))
    darker = np.minimum(*(np.interp(theta, *side) for side in sides))
    value = float(np.exp(darker).mean() * np.pi * np.sin(np.radians(angular_range)) ** 2)
    return value, value
