"""A BRDF as the tensors of the RGL material database, which Mitsuba's and pbrt's `measured` read and importance-sample.

    f cos θr = spectra(u_m; θi) ndf(u_m) / (4 sigma(θi)),   u_m = (√(2 θm/π), (φm - φi + π)/2π),   m the half vector

A reader interpolates `spectra` linearly in u_m and θi, so it must be smooth: `ndf` carries the lobe, `sigma` its
growth toward grazing, both finely sampled. `vndf` is flat, so that no warp stands between u_m and the table, and
`luminance` alone steers the sampling.

Layout: FORMATS of the database (Dupuy and Jakob 2018, "An adaptive parameterization for efficient material
acquisition and rendering"), as Mitsuba 3.9 reads it. Numbers of nodes: ours.
"""

import struct
from dataclasses import dataclass
from math import pi

import numpy as np

from ..errors import NoAnswer
from ..geometry import Geometry, rows
from ._directions import rms_ln

# closer toward grazing; off the round angles at which the residual is taken, so that this sees what interpolation costs
THETA_I = np.radians(np.concatenate(([0.0], np.arange(0.75, 74.0, 1.5), np.arange(74.6, 88.0, 0.8), [88.4, 88.9, 89.3, 89.6, 89.9])))
FINE = 1024  # nodes of ndf and sigma
LEAST = 1e-12  # 1/sr: below it float32 tables hold nothing
FAINT = 1e-6  # least ndf and sigma, of their greatest


@dataclass(frozen=True, eq=False)
class Table:
    """Arrays as written: theta_i (N,), sigma (2, FINE), ndf (2, FINE), spectra (N, channels, R, R), float32."""

    theta_i: np.ndarray
    sigma: np.ndarray
    ndf: np.ndarray
    spectra: np.ndarray

    def at(self, geom: Geometry) -> np.ndarray:
        """BRDF (samples, channels) as a reader gets it."""
        theta_i = np.arctan2(geom.sin_i, geom.cos_i)[:, 0]
        theta_m = np.arctan(np.sqrt(geom.tan2_h))[:, 0]
        phi = np.radians(geom.phi_deg)[:, 0]
        phi_m = np.arctan2(geom.sin_r[:, 0] * np.sin(phi), geom.sin_i[:, 0] + geom.sin_r[:, 0] * np.cos(phi))
        u, v = np.sqrt(2 * theta_m / pi), (phi_m + pi) / (2 * pi)
        node = np.clip(np.searchsorted(self.theta_i, theta_i) - 1, 0, len(self.theta_i) - 2)
        part = np.clip((theta_i - self.theta_i[node]) / (self.theta_i[node + 1] - self.theta_i[node]), 0, 1)
        size = self.spectra.shape[-1]
        x, y = np.clip(u, 0, 1) * (size - 1), np.clip(v, 0, 1) * (size - 1)
        i, j = np.minimum(x.astype(int), size - 2), np.minimum(y.astype(int), size - 2)
        p, q = (x - i)[:, None], (y - j)[:, None]
        value = 0.0
        for step, weight in ((0, 1 - part), (1, part)):
            s = self.spectra[node + step]
            row = np.arange(len(node))
            corner = lambda b, a: s[row, :, j + b, i + a]  # noqa: B023, E731
            flat = (corner(0, 0) * (1 - p) + corner(0, 1) * p) * (1 - q) + (corner(1, 0) * (1 - p) + corner(1, 1) * p) * q
            value = value + weight[:, None] * flat
        fine = np.linspace(0, 1, FINE)
        ndf = np.interp(u, fine, self.ndf[0])
        sigma = np.interp(np.sqrt(2 * theta_i / pi), fine, self.sigma[0])
        return value * (ndf / (4 * sigma))[:, None] / geom.cos_r


def tabulate(brdf, size: int) -> Table:
    """The Table of brdf(geom (samples, 1)) -> (samples, channels), with size x size half vectors for each incidence."""
    fine = np.linspace(0, 1, FINE)
    sigma, height = _sigma(brdf, fine)
    sigma_at = lambda theta: np.interp(np.sqrt(2 * theta / pi), fine, sigma)  # noqa: E731
    ndf = _ndf(brdf, fine, sigma_at, height)
    u = np.linspace(0, 1, size)
    theta_m, phi_m = u * u * (pi / 2), (2 * u - 1) * pi
    ndf_at = np.tile(np.interp(u, fine, ndf), size)
    layers = []
    for theta in THETA_I:
        value = _outgoing(brdf, np.full(size * size, theta), np.tile(theta_m, size), np.repeat(phi_m, size))
        layers.append((value * (4 * sigma_at(theta) / ndf_at)[:, None]).T.reshape(-1, size, size))
    twice = lambda values: np.stack((values, values)).astype(np.float32)  # noqa: E731
    return Table(THETA_I.astype(np.float32), twice(sigma), twice(ndf), np.array(layers).astype(np.float32))


def _sigma(brdf, fine):
    """One over the greatest f cos θr in the plane of incidence, so that the tables of all incidences reach about the same height; and that height."""
    theta = np.minimum(fine * fine * (pi / 2), np.radians(89.9))
    to = np.concatenate((np.arange(-80.0, 81.0, 8.0), [np.nan]))
    angles = np.degrees(theta)[:, None]
    out = np.where(np.isnan(to), angles, to)
    geom = rows(Geometry.from_degrees(np.broadcast_to(angles, out.shape).ravel(), 0.0, np.abs(out).ravel(), np.where(out < 0, 0.0, 180.0).ravel()))
    value = (brdf(geom).mean(axis=1) * geom.cos_r[:, 0]).reshape(out.shape).max(axis=1)
    if value.max() < LEAST:
        raise NoAnswer(f"a table of this surface would be black: it reflects at most {value.max():.1g}/sr at any angle that was tried")
    floor = FAINT * value.max()
    return floor / np.maximum(value, floor), 4 * floor


def _ndf(brdf, fine, sigma_at, height):
    """4 sigma f cos θr where light and view are both on the facet's normal: above the horizon for every tilt, hence without a step."""
    theta_m = np.minimum(fine * fine * (pi / 2), np.radians(89.9))
    value = _outgoing(brdf, theta_m, theta_m, np.zeros(FINE)).mean(axis=1) * 4 * sigma_at(theta_m)
    return np.maximum(value, FAINT * max(value.max(), height))


def _outgoing(brdf, theta_i, theta_m, phi_m):
    """f cos θr (samples, channels) for light at theta_i and half vectors; 0 below the horizon and behind the facet.

    A smooth continuation below the horizon was tried: no better up to 87 degrees, and readers met negative values beyond.
    """
    sin_m = np.sin(theta_m)
    m = np.stack((sin_m * np.cos(phi_m), sin_m * np.sin(phi_m), np.cos(theta_m)), axis=-1)
    i = np.stack((np.sin(theta_i), np.zeros_like(theta_i), np.cos(theta_i)), axis=-1)
    along = 2 * np.sum(i * m, axis=-1, keepdims=True)
    r = along * m - i
    seen = (along > 0) & (r[:, 2:] > 1e-9)
    geom = rows(Geometry.from_vectors(i, np.where(seen, r, [0.0, 0.0, 1.0])))
    return np.where(seen, brdf(geom) * geom.cos_r, 0.0)


# --- the container ----------------------------------------------------------------------------------

TYPES = {np.dtype(np.uint8): 1, np.dtype(np.float32): 10}


def packed(fields: dict[str, np.ndarray]) -> bytes:
    """`tensor_file` 1.0, little-endian: a directory of named arrays, then the arrays, each at a multiple of 8 bytes."""
    header = b"tensor_file\0" + struct.pack("<BBI", 1, 0, len(fields))
    length = len(header) + sum(2 + len(name.encode()) + 2 + 1 + 8 + 8 * array.ndim for name, array in fields.items())
    directory, body = b"", b""
    for name, array in fields.items():
        body += b"\0" * (-(length + len(body)) % 8)
        offset = length + len(body)
        directory += struct.pack("<H", len(name.encode())) + name.encode()
        directory += struct.pack("<HBQ", array.ndim, TYPES[array.dtype], offset) + struct.pack(f"<{array.ndim}Q", *array.shape)
        body += np.ascontiguousarray(array).astype(array.dtype.newbyteorder("<")).tobytes()
    return header + directory + body


def fields(table: Table, comment: str, spectra: str, wavelengths: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """The arrays of a file, in the database's order; `spectra` is the name of the table, rgb or spectra."""
    nodes, _, size, _ = table.spectra.shape
    u = np.linspace(0, 1, size)
    theta_m, phi_m = u * u * (pi / 2), (2 * u - 1) * pi
    # solid angle of view directions per area of u_m: 4 (i·m) 2π² u sin θm; the sampling density a reader divides by
    toward = np.cos(table.theta_i)[:, None, None] * np.cos(theta_m) + np.sin(table.theta_i)[:, None, None] * np.sin(theta_m) * np.cos(phi_m)[:, None]
    carrier = np.interp(u, np.linspace(0, 1, FINE), table.ndf[0])
    bright = table.spectra.mean(axis=1) * carrier * np.maximum(toward, 0) * u * np.sin(theta_m)
    mean = bright.mean(axis=(1, 2), keepdims=True)
    bright = np.where(mean > 0, np.maximum(bright, 1e-3 * mean) / np.where(mean > 0, mean, 1.0), 1.0)  # nothing that reflects is left unsampled
    arrays = {
        "description": np.frombuffer(comment.encode(), np.uint8), "phi_i": np.zeros(1, np.float32), "theta_i": table.theta_i,
        "sigma": table.sigma, "ndf": table.ndf, "vndf": np.ones((1, nodes, 2, 2), np.float32), "luminance": bright[None].astype(np.float32),
        spectra: table.spectra[None], "jacobian": np.ones(1, np.uint8),
    }  # fmt: skip
    return arrays if wavelengths is None else arrays | {"wavelengths": wavelengths.astype(np.float32)}


SIZES = (48, 96, 160)  # half vectors along each side: the first with 99 % of the directions within CLOSE
CLOSE = 0.01


def best_table(brdf, geom: Geometry, wanted: np.ndarray) -> tuple[Table, float]:
    """The smallest good table and its rms ln."""
    for size in SIZES:
        table = tabulate(brdf, size)
        counted = np.isfinite(wanted)
        far = np.abs(table.at(geom)[counted] / wanted[counted] - 1) > CLOSE
        if np.mean(far) <= 0.01:
            break
    return table, rms_ln(table.at(geom), wanted)
