"""Scattered directions as the tables that programs want: each rotation and incidence with one list of azimuths and one
of polar angles, about the normal or about the mirror direction.

What was measured stands in its cell as it is. Between two measured cells of one azimuth the others are interpolated,
linearly in the logarithm; beyond them there is nothing. Below the horizon the last value goes on, so that no reader
interpolates toward a hole there.
"""

import numpy as np

from ...errors import InputError
from ...physics.geometry import Geometry
from ...records import dataclass
from ..measurement import Measurement

NODE_DEG = 1e-5  # angles nearer than this are one
MOST_CELLS = 20  # cells for each measured direction; with more, the directions lie on no such grid
FEW_CELLS = 4000  # of a table that is small anyhow
FINER = 8  # steps between two nodes where a table is integrated
ROTATION_DEG = 0.05  # azimuths of the light nearer than this are one rotation


@dataclass(frozen=True, eq=False)
class ProductGrid:
    """Nodes [deg] and values (rotations, incidences, azimuths, polars, channels) [1/sr], NaN where there is none."""

    rotations: np.ndarray  # of the sample: minus the azimuth of the light
    theta_i: np.ndarray
    azimuth: np.ndarray
    polar: np.ndarray
    values: np.ndarray
    measured: int  # cells that hold a direction's own value
    about_mirror: bool

    @property
    def half(self) -> bool:
        """Whether azimuths of half a turn stand for both sides of the plane of incidence."""
        return bool(self.azimuth[-1] <= 180 + NODE_DEG)

    @property
    def sentences(self) -> list[str]:
        """What a user of the table should know."""
        said = []
        if self.filled > self.measured:
            said.append(f"{self.filled - self.measured} of {self.filled} cells are interpolated between measured ones")
        if np.all(np.isin(self.azimuth, (0.0, 180.0))):
            said.append(
                "only the plane of incidence was measured: between its two sides a reader interpolates what nobody "
                "measured; the total is of that"
            )
        return said

    def whole_turn(self, light_deg: float) -> tuple[np.ndarray, np.ndarray]:
        """Azimuths of a whole turn [deg] in order, each once, where the light's is `light_deg`, and their places among
        `azimuth`."""
        places = np.arange(len(self.azimuth))
        inner = places[(self.azimuth > NODE_DEG) & (self.azimuth < 180 - NODE_DEG)] if self.half else places[:0]
        azimuth = np.concatenate((self.azimuth, 360.0 - self.azimuth[inner]))
        turned = np.round(np.remainder(azimuth + light_deg, 360.0), 5)
        order = np.argsort(turned, kind="stable")
        return turned[order], np.concatenate((places, inner))[order]

    @property
    def filled(self) -> int:
        """Cells with a value, above the horizon."""
        lit = self.cos_r > 1e-9
        return int(np.count_nonzero(np.isfinite(self.values[..., 0]) & lit))

    @property
    def cos_r(self) -> np.ndarray:
        """cos θr of each cell, (1, incidences, azimuths, polars)."""
        return _cos_r(self.theta_i, self.azimuth, self.polar, self.about_mirror)

    def totals(self) -> np.ndarray:
        """Total scatter ∫ f cos θr dω of each rotation and incidence, (rotations, incidences, channels), of what is
        linear between the nodes; missing cells are dark."""
        fine_a, part_a = _finer(_whole_turn(self.azimuth, self.half))
        fine_p, part_p = _finer(self.polar)
        values = np.nan_to_num(self.values[:, :, _places(len(self.azimuth), self.half)])
        cosine = np.maximum(_cos_r(self.theta_i, fine_a, fine_p, self.about_mirror), 0.0)
        area = np.outer(_steps(np.radians(fine_a), turn=True), _steps(np.radians(fine_p)) * np.sin(np.radians(fine_p)))
        weights = part_a.T @ (cosine[0] * area) @ part_p  # (incidences, azimuths, polars), of the nodes themselves
        return np.sum(weights[None, ..., None] * values, axis=(2, 3))


def product_grid(measurement: Measurement, about_mirror: bool, what: str) -> ProductGrid:
    """The measurement as one grid. Raises InputError where its directions lie on none; `what` names the format."""
    geom = measurement.geom
    azimuth, polar = _angles_about(geom, about_mirror)
    axes = [_nodes(each) for each in (_rotation(geom), geom.theta_i_deg[:, 0], _folded(azimuth), polar)]
    shape = tuple(len(nodes) for nodes, _ in axes)
    cells, rows = int(np.prod(shape, dtype=float)), len(geom)
    if cells > max(MOST_CELLS * rows, FEW_CELLS):
        center = "mirror direction" if about_mirror else "normal"
        raise InputError(
            f"{measurement.name}: its {rows} directions lie on no grid of incidences, azimuths and angles about the "
            f"{center}, as {what} wants ({cells} cells); fit them and export the fit, or convert to fred, astm, "
            f"tracepro or csv, which take any directions"
        )
    places = tuple(place for _, place in axes)
    channels = len(measurement.channels)
    total, count = np.zeros((*shape, channels)), np.zeros((*shape, channels))
    usable = np.isfinite(measurement.brdf)
    np.add.at(total, places, np.where(usable, measurement.brdf, 0.0))
    np.add.at(count, places, usable)
    with np.errstate(invalid="ignore", divide="ignore"):
        values = np.where(count > 0, total / count, np.nan)
    rotations, theta_i, azimuths, polars = (nodes for nodes, _ in axes)
    _spread_pole(values, polars)
    measured = int(np.count_nonzero(np.isfinite(values[..., 0])))
    _fill(values, polars)
    below = _cos_r(theta_i, azimuths, polars, about_mirror) <= 1e-9
    _go_on_below(values, np.broadcast_to(below, values.shape[:4]))
    return ProductGrid(rotations, theta_i, azimuths, polars, values, measured, about_mirror)


def _angles_about(geom: Geometry, about_mirror: bool):
    """Azimuth and polar angle [deg] (samples,) about the normal, light at azimuth 0, or about the mirror direction,
    azimuth 0 toward the normal."""
    phi, theta_i, theta_r = (np.radians(each[:, 0]) for each in (geom.phi_deg, geom.theta_i_deg, geom.theta_r_deg))
    if not about_mirror:
        azimuth = np.where(theta_r < 1e-9, 0.0, np.degrees(phi))
        return np.remainder(azimuth, 360.0), np.degrees(theta_r)
    x, y, z = np.sin(theta_r) * np.cos(phi), np.sin(theta_r) * np.sin(phi), np.cos(theta_r)
    toward = x * np.cos(theta_i) + z * np.sin(theta_i)
    along = z * np.cos(theta_i) - x * np.sin(theta_i)
    across = np.hypot(toward, y)
    azimuth = np.where(across < 1e-7, 0.0, np.degrees(np.arctan2(y, toward)))
    return np.remainder(azimuth, 360.0), np.degrees(np.arctan2(across, along))


def _rotation(geom: Geometry) -> np.ndarray:
    """Rotation of the sample (samples,) [deg]; 0 where there is only one."""
    turned = np.remainder(-geom.phi_i_deg[:, 0] + ROTATION_DEG / 2, 360.0) - ROTATION_DEG / 2
    tilted = geom.theta_i_deg[:, 0] > 1e-6
    if not np.any(tilted) or np.ptp(turned[tilted]) < ROTATION_DEG:
        return np.zeros(len(turned))
    return turned


def _folded(azimuth) -> np.ndarray:
    """Within 0..180 where only one side of the plane of incidence was measured."""
    azimuth = np.where(azimuth > 360 - NODE_DEG, 0.0, azimuth)
    left = (azimuth > NODE_DEG) & (azimuth < 180 - NODE_DEG)
    right = azimuth > 180 + NODE_DEG
    return np.where(right, 360.0 - azimuth, azimuth) if not (np.any(left) and np.any(right)) else azimuth


def _nodes(angles) -> tuple[np.ndarray, np.ndarray]:
    """The distinct angles in order, and the place of each."""
    nodes, place = np.unique(np.round(angles / NODE_DEG) * NODE_DEG, return_inverse=True)
    return np.round(nodes, 5) + 0.0, place.reshape(-1)


def _spread_pole(values, polars) -> None:
    """At the pole all azimuths are one direction; in place."""
    if polars[0] > NODE_DEG:
        return
    pole = values[:, :, :, 0]
    known = np.isfinite(pole)
    count = known.sum(axis=2, keepdims=True)
    mean = np.where(known, pole, 0.0).sum(axis=2, keepdims=True) / np.maximum(count, 1)
    values[:, :, :, 0] = np.where(known, pole, np.where(count > 0, mean, np.nan))


def _fill(values, polars) -> None:
    """Missing cells between two of one azimuth; in place."""
    lines = values.reshape(-1, len(polars), values.shape[-1])
    for line in lines:
        for channel in range(line.shape[1]):
            known = np.isfinite(line[:, channel])
            if known.all() or np.count_nonzero(known) < 2:
                continue
            within = np.arange(len(polars))
            inner = ~known & (within > np.argmax(known)) & (within < len(polars) - 1 - np.argmax(known[::-1]))
            own = line[known, channel]
            if np.all(own > 0):
                line[inner, channel] = np.exp(np.interp(polars[inner], polars[known], np.log(own)))
            else:
                line[inner, channel] = np.interp(polars[inner], polars[known], own)
    values[...] = lines.reshape(values.shape)


def _go_on_below(values, below) -> None:
    """Cells below the horizon take the value of the last one above it; in place."""
    for place in range(1, values.shape[3]):
        here = below[:, :, :, place, None] & ~np.isfinite(values[:, :, :, place])
        values[:, :, :, place] = np.where(here, values[:, :, :, place - 1], values[:, :, :, place])


def _cos_r(theta_i, azimuth, polar, about_mirror: bool) -> np.ndarray:
    if not about_mirror:
        return np.broadcast_to(np.cos(np.radians(polar)), (1, len(theta_i), len(azimuth), len(polar)))
    i, a, p = np.radians(theta_i)[:, None, None], np.radians(azimuth)[:, None], np.radians(polar)
    return (np.cos(i) * np.cos(p) + np.sin(i) * np.sin(p) * np.cos(a))[None]


def _places(count: int, half: bool) -> list[int]:
    """The azimuths of a whole turn, its last equal to its first, by their places."""
    if count == 1:
        return [0, 0, 0, 0]
    return [*range(count), *range(count - 2, -1, -1)] if half else [*range(count), 0]


def _whole_turn(azimuth, half: bool) -> np.ndarray:
    if len(azimuth) == 1:
        return np.array([0.0, 120.0, 240.0, 360.0])
    if half:
        return np.concatenate((azimuth, 360.0 - azimuth[-2::-1]))
    return np.concatenate((azimuth, azimuth[:1] + 360.0))


def _finer(nodes) -> tuple[np.ndarray, np.ndarray]:
    """FINER steps between nodes, and the weights (fine, nodes) that interpolate there."""
    if len(nodes) == 1:
        return nodes, np.ones((1, 1))
    place = np.linspace(0, len(nodes) - 1, FINER * (len(nodes) - 1) + 1)
    low = np.minimum(place.astype(int), len(nodes) - 2)
    part = place - low
    weights = np.zeros((len(place), len(nodes)))
    weights[np.arange(len(place)), low] += 1 - part
    weights[np.arange(len(place)), low + 1] += part
    return weights @ nodes, weights


def _steps(nodes, turn: bool = False) -> np.ndarray:
    """Weights of the trapezoidal rule; of a whole turn, scaled to it."""
    if len(nodes) == 1:
        return np.array([2 * np.pi]) if turn else np.array([0.0])
    step = np.diff(nodes)
    weights = np.zeros(len(nodes))
    weights[1:] += step / 2
    weights[:-1] += step / 2
    return weights * (2 * np.pi / weights.sum()) if turn else weights
