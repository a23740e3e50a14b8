"""A BRDF as the tensors of the RGL material database, which Mitsuba's and pbrt's `measured` read and importance-sample.

    f cos θr = spectra(s(u_m); θi) ndf(u_m) / (4 sigma(θi)),   u_m = (√(2 θm/π), (φm - φi + π)/2π),   m the half vector

A reader interpolates `spectra` linearly in s and θi, so it must be smooth: `ndf` carries the lobe, finely sampled.
s is the cumulative distribution of `vndf`, which therefore places the nodes: here along each side by itself and the
same for all incidences, close where the table bends. The incidences are placed likewise. `sigma` is constant, and
`luminance` alone steers the sampling.

Layout: FORMATS of the database (Dupuy and Jakob 2018, "An adaptive parameterization for efficient material
acquisition and rendering"), as Mitsuba 3.9 reads it. Numbers of nodes: ours.
"""

import struct
from dataclasses import replace
from math import pi

import numpy as np

from ...errors import NoAnswer
from ...physics.geometry import Geometry, rows
from ...records import dataclass
from .._directions import off_peak, rms_ln, too_dark
from .placement import Warp, density, march

FINE = 4096  # nodes of ndf
PLACES = (193, 97)  # nodes of vndf along u and v
LEAST = 1e-12  # 1/sr: below it float32 tables hold nothing
FAINT = 1e-9  # least ndf, of its greatest
CLOSE = 0.01  # of the BRDF, off the peak: what a table should be within
# nodes are placed for angles up to here, so that what is judged does not reach the horizon; the rest of the
# incidences are:
PLACED_DEG = 86.0
BEYOND = np.radians([87.0, 88.0, 89.0, 89.5, 89.9])
FEWEST = 90  # half vectors along each side; fewer would reach from PLACED_DEG beyond the horizon
MOST = 224
TOLERANCES = (0.012, 0.008, 0.005, 0.003, 0.002)  # of each of the three interpolations


@dataclass(frozen=True, eq=False)
class Grid:
    """Nodes of a table: incidences [rad], warps along u and v, size x size half vectors, the carrier ndf (FINE,)."""

    theta_i: np.ndarray
    along_u: Warp
    along_v: Warp
    size: int
    ndf: np.ndarray

    @property
    def u(self) -> np.ndarray:
        return self.along_u.back(np.linspace(0, 1, self.size))

    @property
    def v(self) -> np.ndarray:
        return self.along_v.back(np.linspace(0, 1, self.size))

    def read(self, geom: Geometry, spectra) -> np.ndarray:
        """BRDF (samples, channels) as a reader gets it; spectra(incidence, along v, along u) -> (samples, channels) at
        nodes by their places."""
        theta_i = np.arctan2(geom.sin_i, geom.cos_i)[:, 0]
        theta_m = np.arctan(np.sqrt(geom.tan2_h))[:, 0]
        phi = np.radians(geom.phi_deg)[:, 0]
        phi_m = np.arctan2(geom.sin_r[:, 0] * np.sin(phi), geom.sin_i[:, 0] + geom.sin_r[:, 0] * np.cos(phi))
        u, v = np.sqrt(2 * theta_m / pi), (phi_m + pi) / (2 * pi)
        node, part = _cell(np.interp(theta_i, self.theta_i, np.arange(len(self.theta_i))), len(self.theta_i))
        i, p = _cell(self.along_u.to(u) * (self.size - 1), self.size)
        j, q = _cell(self.along_v.to(v) * (self.size - 1), self.size)
        value = 0.0
        for a, weight_a in ((0, 1 - part), (1, part)):
            for b, weight_b in ((0, 1 - q), (1, q)):
                for c, weight_c in ((0, 1 - p), (1, p)):
                    value = value + (weight_a * weight_b * weight_c)[:, None] * spectra(node + a, j + b, i + c)
        return value * np.interp(u, np.linspace(0, 1, FINE), self.ndf)[:, None] / geom.cos_r

    def computed(self, brdf):
        """What `read` takes, from the BRDF itself: the errors of a table before there is one."""
        return lambda node, j, i: _smooth(brdf, self.ndf, self.theta_i[node], self.u[i], self.v[j])[0]

    def filled(self, brdf) -> np.ndarray:
        """spectra (incidences, channels, size, size), float32; left and right of the plane of incidence are alike."""
        half = (self.size + 1) // 2
        v, u = (each.ravel() for each in np.meshgrid(self.v[:half], self.u, indexing="ij"))
        layers = []
        for theta in self.theta_i:
            layer = _smooth(brdf, self.ndf, theta, u, v)[0].T.reshape(-1, half, self.size).astype(np.float32)
            layers.append(np.concatenate((layer, layer[:, : self.size - half][:, ::-1]), axis=1))
        return np.array(layers)


def _cell(x, nodes):
    """The node below x, of 0..nodes - 1, and how far x is toward the next."""
    node = np.minimum(x.astype(int), nodes - 2)
    return node, x - node


def grids(brdf):
    """Ever closer Grids for brdf(geom (samples, 1)) -> (samples, channels): each of the three interpolations costs at
    most a tolerance."""
    ndf = _ndf(brdf)
    few, half = np.radians(np.linspace(0.0, PLACED_DEG, 18)), np.linspace(0, 0.5, 25)
    looked_u = _looked(brdf, ndf, few, np.linspace(0, 1, 4 * (PLACES[0] - 1) + 1), half, 1)
    u = Warp(density(*looked_u, TOLERANCES[0], PLACES[0], FEWEST)).back(np.linspace(0, 1, 49))
    looked_v = _looked(brdf, ndf, few, u, np.linspace(0, 0.5, 2 * (PLACES[1] - 1) + 1), 2)
    theta = np.radians(np.arange(0.0, PLACED_DEG + 0.1, 0.25))
    values, counted = _looked(brdf, ndf, theta, u, half, 0)
    for tolerance in TOLERANCES:
        along_u = density(*looked_u, tolerance, PLACES[0], FEWEST)
        along_v = 2 * density(*looked_v, tolerance, PLACES[1] // 2 + 1, FEWEST / 2)
        along_v = np.concatenate((along_v, along_v[-2::-1]))
        size = int(np.ceil(1 + max(np.mean(0.5 * (each[1:] + each[:-1])) for each in (along_u, along_v))))
        places = march(
            theta,
            values,
            np.where(counted, tolerance * values, np.inf),
            np.radians(np.where(theta < np.radians(70.0), 6.0, 1.5)),
        )
        yield Grid(np.concatenate((theta[places], BEYOND)), Warp(along_u), Warp(along_v), min(size, MOST), ndf)


def _looked(brdf, ndf, theta, u, v, axis) -> tuple[np.ndarray, np.ndarray]:
    """The smooth part on the grid theta_i x u x v and where it counts, both with `axis` first and the rest in one."""
    grid = np.meshgrid(theta, u, v, indexing="ij")
    shape, order = grid[0].shape, [axis, *(each for each in range(4) if each != axis)]
    value, counted = (
        each.reshape(*shape, -1).transpose(order).reshape(shape[axis], -1)
        for each in _smooth(brdf, ndf, *(each.ravel() for each in grid))
    )
    return value, counted


def _smooth(brdf, ndf, theta_i, u, v):
    """f cos θr / ndf (samples, channels), 0 below the horizon, and where it counts: both directions up to PLACED_DEG,
    and not too dark."""
    theta_m, phi_m = u * u * (pi / 2), (2 * v - 1) * pi
    value, cos_r = _outgoing(brdf, np.broadcast_to(theta_i, u.shape), theta_m, phi_m)
    limit = np.cos(np.radians(PLACED_DEG))
    counted = (value >= too_dark(ndf) * cos_r) & (cos_r > limit) & (np.cos(theta_i) > limit)[..., None]
    return value / np.interp(u, np.linspace(0, 1, FINE), ndf)[:, None], counted


def _ndf(brdf):
    """f cos θr where light and view are on the facet's normal: above the horizon for every tilt, so without a step."""
    u = np.linspace(0, 1, FINE)
    theta_m = np.minimum(u * u * (pi / 2), np.radians(89.9))
    value = _outgoing(brdf, theta_m, theta_m, np.zeros(FINE))[0].mean(axis=1)
    if value.max() < LEAST:
        raise NoAnswer(
            f"a table of this surface would be black: it reflects at most {value.max():.1g}/sr toward the light "
            f"at any angle"
        )
    return np.maximum(value, FAINT * value.max())


def _outgoing(brdf, theta_i, theta_m, phi_m):
    """f cos θr (samples, channels) for light at theta_i and half vectors, and cos θr; 0 below the horizon and behind
    the facet.

    A smooth continuation below the horizon was tried: no better up to 87 degrees, and readers met negative values
    beyond.
    """
    sin_m = np.sin(theta_m)
    m = np.stack((sin_m * np.cos(phi_m), sin_m * np.sin(phi_m), np.cos(theta_m)), axis=-1)
    i = np.stack((np.sin(theta_i), np.zeros_like(theta_i), np.cos(theta_i)), axis=-1)
    along = 2 * np.sum(i * m, axis=-1, keepdims=True)
    r = along * m - i
    above = (along > 0) & (r[:, 2:] > 1e-9)
    geom = rows(Geometry.from_vectors(i, np.where(above, r, [0.0, 0.0, 1.0])))
    return np.where(above, brdf(geom) * geom.cos_r, 0.0), np.where(above, geom.cos_r, 0.0)


@dataclass(frozen=True, eq=False)
class Made:
    """A table with what it costs."""

    grid: Grid
    spectra: np.ndarray
    rms_ln: float  # over the export's directions
    note: str  # how far off at most, off the peak

    def read(self, geom: Geometry) -> np.ndarray:
        """BRDF (samples, channels) as a reader gets it."""
        return self.grid.read(geom, lambda node, j, i: self.spectra[node, :, j, i])

    @property
    def size(self) -> dict[str, int]:
        """How many nodes there are."""
        return {"theta_i": len(self.grid.theta_i), "half_vectors": self.grid.size**2}

    def of_channels(self, places) -> "Made":
        """The same with its channels in another order."""
        return replace(self, spectra=self.spectra[:, places])

    def fields(self, comment: str, name: str, wavelengths: np.ndarray | None = None) -> dict[str, np.ndarray]:
        """The arrays of a file, in the database's order; `name` is that of the table, rgb or spectra."""
        return table_fields(self.grid, self.spectra, comment, name, wavelengths)


def best_table(brdf, geom: Geometry, wanted: np.ndarray) -> Made:
    """The first grid that is within CLOSE off the peak; the closest where none is, and then the note says so."""
    judged, truth, where = off_peak(brdf)
    off, grid = np.inf, None
    for each in grids(brdf):
        worst = float(np.nanmax(np.abs(each.read(judged, each.computed(brdf)) / truth - 1), initial=0.0))
        if grid is None or worst < off:
            off, grid = worst, each
        if off <= 0.8 * CLOSE:  # so that other directions are within it too
            break
    assert grid is not None  # `grids` gives at least one
    note = f"a table of {len(grid.theta_i)} incidences and {grid.size} x {grid.size} half vectors: "
    note += f"off the peak its reader is within {100 * off:.2g} % of the model, {where}"
    note += "" if off <= CLOSE else f"; {100 * CLOSE:g} % could not be held"
    spectra = grid.filled(brdf)
    made = Made(grid, spectra, 0.0, note)
    return replace(made, rms_ln=rms_ln(made.read(geom), wanted))


# --- the container ----------------------------------------------------------------------------------

TYPES = {np.dtype(np.uint8): 1, np.dtype(np.float32): 10}


def packed(fields: dict[str, np.ndarray]) -> bytes:
    """`tensor_file` 1.0, little-endian: a directory of named arrays, then the arrays, each at a multiple of 8 bytes."""
    header = b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(fields))
    length = len(header) + sum(2 + len(name.encode()) + 2 + 1 + 8 + 8 * array.ndim for name, array in fields.items())
    directory, body = b"", []
    offset = length
    for name, array in fields.items():
        body.append(b"\0" * (-offset % 8))
        offset += len(body[-1])
        directory += struct.pack("<H", len(name.encode())) + name.encode()
        directory += struct.pack("<HBQ", array.ndim, TYPES[array.dtype], offset) + struct.pack(
            f"<{array.ndim}Q", *array.shape
        )
        body.append(np.ascontiguousarray(array).astype(array.dtype.newbyteorder("<")).tobytes())
        offset += len(body[-1])
    return b"".join((header, directory, *body))


def table_fields(
    grid: Grid, spectra: np.ndarray, comment: str, name: str, wavelengths: np.ndarray | None = None
) -> dict[str, np.ndarray]:
    """The arrays of a file, in the database's order; `name` is that of the table, rgb or spectra."""
    u, v = grid.u, grid.v
    theta_i, theta_m, phi_m = grid.theta_i[:, None, None], u * u * (pi / 2), (2 * v - 1)[:, None] * pi
    placing = grid.along_v.density[:, None] * grid.along_u.density
    # solid angle of view directions per area of u_m: 4 (i·m) 2π² u sin θm, per area of s less by the density of
    # nodes; a reader's sampling density
    toward = np.maximum(np.cos(theta_i) * np.cos(theta_m) + np.sin(theta_i) * np.sin(theta_m) * np.cos(phi_m), 0)
    area = u * np.sin(theta_m) / (grid.along_u.at(u) * grid.along_v.at(v)[:, None])
    bright = spectra.mean(axis=1) * np.interp(u, np.linspace(0, 1, FINE), grid.ndf) * toward * area
    mean = bright.mean(axis=(1, 2), keepdims=True)
    # nothing that reflects is left unsampled
    bright = np.where(mean > 0, np.maximum(bright, 1e-3 * mean) / np.where(mean > 0, mean, 1.0), 1.0)
    vndf = np.broadcast_to((placing / placing.mean()).astype(np.float32), (1, len(theta_i), *placing.shape))
    arrays: dict[str, np.ndarray] = {
        "description": np.frombuffer(comment.encode(), np.uint8),
        "phi_i": np.zeros(1, np.float32),
        "theta_i": grid.theta_i.astype(np.float32),
        "sigma": np.full((2, 2), 0.25, np.float32),
        "ndf": np.stack((grid.ndf, grid.ndf)).astype(np.float32),
        "vndf": vndf,
        "luminance": bright[None].astype(np.float32),
        name: spectra[None],
        "jacobian": np.ones(1, np.uint8),
    }
    return arrays if wavelengths is None else arrays | {"wavelengths": wavelengths.astype(np.float32)}
