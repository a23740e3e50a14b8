"""A surface with a grain as tensors of the RGL database: the same table for each azimuth of the light.

    f cos θr = spectra(u_m; φi, θi) ndf(u_m)/(4 sigma),   u_m = (√(2 θm/π), (φm + π)/2π),   m the half vector

With more than two φi a reader counts φm from the sample's own azimuth 0. `ndf` is a map over both coordinates then and
carries the streak; what is left is smooth, and its nodes are even. φi goes from -π to π, as readers form it with an
arctangent and refuse a table of less than a turn. Light and view turned by half a turn have the same value: half of the
azimuths are computed. `vndf` is constant, `luminance` alone steers the sampling.

Layout: as in `tensor`; Mitsuba 3.9's reading of anisotropic files. Numbers of nodes: ours.
"""

from collections.abc import Callable
from dataclasses import replace
from math import pi

import numpy as np

from ...errors import NoAnswer
from ...physics.geometry import Geometry, rows
from ...records import dataclass
from .._directions import off_peak, rms_ln
from .tensor import CLOSE, FAINT, LEAST

FINE = (721, 512)  # nodes of ndf along φm and θm
STEEP = (0, 10, 20, 30, 40, 50, 57, 63, 68, 72, 76, 79, 82, 84, 86, 88, 89.5)  # incidences [deg]
# turns of the light, parts of each step of incidence, nodes along φm and along θm
LEVELS = ((24, 1, 49, 49), (48, 2, 65, 65))
TURNED_BY_DEG = (0.0, 17.0, 52.0, 88.0, 131.0)  # under which a table is judged off the peak


@dataclass(frozen=True, eq=False)
class TurnedTable:
    """Nodes [rad], the carrier ndf and spectra (φi, θi, channels, φm, θm), with what it costs."""

    phi_i: np.ndarray
    theta_i: np.ndarray
    ndf: np.ndarray
    spectra: np.ndarray
    rms_ln: float = 0.0
    note: str = ""

    def read(self, geom: Geometry) -> np.ndarray:
        """BRDF (samples, channels) as a reader gets it that goes linearly along all four coordinates."""
        phi_i = np.remainder(np.radians(geom.phi_i_deg[:, 0]) + pi, 2 * pi) - pi
        theta_i = np.arctan2(geom.sin_i, geom.cos_i)[:, 0]
        x, y = (each[:, 0] for each in geom.v_xy)
        v, u = (np.arctan2(y, x) + pi) / (2 * pi), np.sqrt(2 / pi * np.arctan(np.sqrt(geom.tan2_h[:, 0])))
        along = [
            _between(phi_i, self.phi_i),
            _between(theta_i, self.theta_i),
            _between(v, np.linspace(0, 1, self.spectra.shape[3])),
            _between(u, np.linspace(0, 1, self.spectra.shape[4])),
        ]
        value: np.ndarray | float = 0.0
        for corner in np.ndindex(2, 2, 2, 2):
            (p, t, j, i), weight = self._corner(along, corner)
            value = value + weight[:, None] * self.spectra[p, t, :, j, i]
        (row, down), (column, right) = (
            _between(place, np.linspace(0, 1, count)) for place, count in zip((v, u), FINE, strict=True)
        )
        carried = (1 - down) * ((1 - right) * self.ndf[row, column] + right * self.ndf[row, column + 1])
        carried += down * ((1 - right) * self.ndf[row + 1, column] + right * self.ndf[row + 1, column + 1])
        return value * carried[:, None] / geom.cos_r

    @staticmethod
    def _corner(along, corner):
        places = tuple(node + step for (node, _), step in zip(along, corner, strict=True))
        weight = np.prod([part if step else 1 - part for (_, part), step in zip(along, corner, strict=True)], axis=0)
        return places, weight

    @property
    def size(self) -> dict[str, int]:
        """How many nodes there are."""
        phi_i, theta_i, _, v, u = self.spectra.shape
        return {"phi_i": phi_i, "theta_i": theta_i, "half_vectors": v * u}

    def of_channels(self, places) -> "TurnedTable":
        """The same with its channels in another order."""
        return replace(self, spectra=self.spectra[:, :, places])

    def fields(self, comment: str, name: str, wavelengths: np.ndarray | None = None) -> dict[str, np.ndarray]:
        """The arrays of a file, in the database's order; `name` is that of the table, rgb or spectra."""
        v, u = (np.linspace(0, 1, count) for count in self.spectra.shape[3:])
        bright = self.spectra.mean(axis=2) * self._seen(v, u)
        mean = bright.mean(axis=(2, 3), keepdims=True)
        # nothing that reflects is left unsampled
        bright = np.where(mean > 0, np.maximum(bright, 1e-3 * mean) / np.where(mean > 0, mean, 1.0), 1.0)
        arrays: dict[str, np.ndarray] = {
            "description": np.frombuffer(comment.encode(), np.uint8),
            "phi_i": self.phi_i.astype(np.float32),
            "theta_i": self.theta_i.astype(np.float32),
            "sigma": np.full((2, 2), 0.25, np.float32),
            "ndf": self.ndf,
            "vndf": np.ones((len(self.phi_i), len(self.theta_i), 2, 2), np.float32),
            "luminance": bright.astype(np.float32),
            name: self.spectra,
            "jacobian": np.ones(1, np.uint8),
        }
        return arrays if wavelengths is None else arrays | {"wavelengths": wavelengths.astype(np.float32)}

    def _seen(self, v, u) -> np.ndarray:
        """ndf and the solid angle of views per area of u_m at the nodes of the table, (φi, θi, φm, θm)."""
        theta_m, phi_m = u * u * (pi / 2), (2 * v - 1)[:, None] * pi
        rows_, columns = (np.round(each * (count - 1)).astype(int) for each, count in zip((v, u), FINE, strict=True))
        carried = self.ndf[np.ix_(rows_, columns)] * u * np.sin(theta_m)
        theta_i, phi_i = self.theta_i[:, None, None], self.phi_i[:, None, None, None]
        toward = np.cos(theta_i) * np.cos(theta_m) + np.sin(theta_i) * np.sin(theta_m) * np.cos(phi_m - phi_i)
        return carried * np.maximum(toward, 0.0)


def _between(x, nodes) -> tuple[np.ndarray, np.ndarray]:
    """The node below x and how far x is toward the next."""
    place = np.interp(x, nodes, np.arange(len(nodes)))
    low = np.minimum(place.astype(int), len(nodes) - 2)
    return low, place - low


def best_turned_table(brdf: Callable[[Geometry], np.ndarray], geom: Geometry, wanted: np.ndarray) -> TurnedTable:
    """The first table that is within CLOSE in 95 of 100 directions off the peak, or the last. Its note says it.

    Takes  brdf(geometry (samples, 1)) -> (samples, channels) [1/sr], the export's directions and the values there.
    Raises NoAnswer where all would be black.
    """
    ndf, judged, where = _carrier(brdf), [], ""
    for turn in TURNED_BY_DEG:
        at, truth, where = off_peak(lambda each, turn=turn: brdf(each.at_azimuth(turn)))
        judged.append((at.at_azimuth(turn), truth))
    for level in LEVELS:
        made = _table(brdf, ndf, *level)
        off = np.concatenate([np.abs(made.read(at) / truth - 1).ravel() for at, truth in judged])
        usual, most = 100 * np.nanquantile(off, (0.95, 1.0))
        if usual <= 100 * CLOSE:  # four times the size takes the rest down slowly
            break
    phi_i, theta_i, _, v, u = made.spectra.shape
    note = (
        f"a table of {phi_i} azimuths and {theta_i} incidences of the light and {v} x {u} half vectors: off the peak "
        f"its reader is within {usual:.2g} % of the model in 95 of 100 directions and {most:.2g} % in all, "
        f"{where}, under each of {len(TURNED_BY_DEG)} turns"
    )
    note += "" if most <= 100 * CLOSE else f"; {100 * CLOSE:g} % could not be held"
    return TurnedTable(made.phi_i, made.theta_i, ndf, made.spectra, rms_ln(made.read(geom), wanted), note)


def _carrier(brdf) -> np.ndarray:
    """ndf (φm, θm), float32: f cos θr where light and view are on the facet's normal."""
    v, u = (np.linspace(0, 1, count) for count in (FINE[0] // 2 + 1, FINE[1]))
    theta = np.minimum(u * u * (pi / 2), np.radians(89.9))
    phi, theta = (each.ravel() for each in np.meshgrid((v - 1) * pi, theta, indexing="ij"))
    facet = rows(Geometry.from_vectors(*[_upward(theta, phi)] * 2))
    value = (brdf(facet) * facet.cos_r).mean(axis=1).reshape(len(v), len(u))
    if value.max() < LEAST:
        raise NoAnswer(f"a table of this surface would be black: it reflects at most {value.max():.1g}/sr")
    whole = np.concatenate((value, value[1:]))  # a facet and the one half a turn on are alike
    return np.maximum(whole, FAINT * value.max()).astype(np.float32)


def _upward(theta, phi) -> np.ndarray:
    return np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), axis=-1)


def _table(brdf, ndf, turns: int, parts: int, v_nodes: int, u_nodes: int) -> TurnedTable:
    """A table of even nodes; `turns` is even, `v_nodes` odd."""
    steep = np.interp(np.arange(parts * (len(STEEP) - 1) + 1) / parts, np.arange(len(STEEP)), STEEP)
    theta_i, phi_i = np.radians(steep), np.linspace(-pi, pi, turns + 1)
    v, u = np.linspace(0, 1, v_nodes), np.linspace(0, 1, u_nodes)
    phi_m, theta_m = (each.ravel() for each in np.meshgrid((2 * v - 1) * pi, u * u * (pi / 2), indexing="ij"))
    half = _upward(theta_m, phi_m)
    (row, down), (column, right) = (_between(each, np.linspace(0, 1, n)) for each, n in zip((v, u), FINE, strict=True))
    across = (1 - right) * ndf[:, column] + right * ndf[:, column + 1]
    carried = ((1 - down)[:, None] * across[row] + down[:, None] * across[row + 1]).ravel()
    first = []
    for phi in phi_i[: turns // 2]:
        layers = [_layer(brdf, theta, phi, half) / carried[:, None] for theta in theta_i]
        first.append(np.array(layers).transpose(0, 2, 1).reshape(len(theta_i), -1, v_nodes, u_nodes))
    begun = np.array(first, np.float32)
    step = v_nodes // 2  # half a turn along φm, whose last node is the first again
    onward = np.concatenate((begun[..., step:, :], begun[..., 1 : step + 1, :]), axis=-2)
    return TurnedTable(phi_i, theta_i, ndf, np.concatenate((begun, onward, begun[:1])))


def _layer(brdf, theta_i: float, phi_i: float, half) -> np.ndarray:
    """f cos θr (half vectors, channels) of light from one direction; 0 below the horizon and behind the facet."""
    light = _upward(np.array(theta_i), np.array(phi_i))
    along = 2 * (half @ light)
    view = along[:, None] * half - light
    above = (along > 0) & (view[:, 2] > 1e-9)
    geom = rows(Geometry.from_vectors(np.broadcast_to(light, (int(above.sum()), 3)), view[above]))
    value = brdf(geom) * geom.cos_r
    found = np.zeros((len(half), value.shape[1]))
    found[above] = value
    return found
