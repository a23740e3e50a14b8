"""Bodies made of triangles: what a lathe turns, tubes along a curve, and a car-like body lofted of cross-sections.

Lengths are free; y points up. Every body is smooth: its normals are those of the surface, not of its facets.
"""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from ...records import dataclass


@dataclass(frozen=True, eq=False)
class Mesh:
    """Corners (n, 3), normals there (n, 3), and triangles as three numbers of corners (m, 3)."""

    corners: np.ndarray
    normals: np.ndarray
    triangles: np.ndarray

    def write(self, path: Path) -> None:
        """As binary PLY."""
        names = ("x", "y", "z", "nx", "ny", "nz")
        head = ["ply", "format binary_little_endian 1.0", f"element vertex {len(self.corners)}"]
        head += [f"property float {name}" for name in names]
        head += [f"element face {len(self.triangles)}", "property list uchar int vertex_indices", "end_header"]
        faces = np.empty(len(self.triangles), [("count", "u1"), ("corners", "<i4", 3)])
        faces["count"], faces["corners"] = 3, self.triangles
        vertices = np.concatenate((self.corners, self.normals), axis=1).astype("<f4")
        path.write_bytes("\n".join([*head, ""]).encode() + vertices.tobytes() + faces.tobytes())


def surface_mesh(place: Callable, rows: np.ndarray, columns: np.ndarray) -> Mesh:
    """The mesh of a surface place(u, v) (..., 3) over a grid of its two parameters; normals by differences."""
    u, v = np.meshgrid(rows, columns, indexing="ij")
    step = 1e-4
    along = place(u + step, v) - place(u - step, v)
    across = place(u, v + step) - place(u, v - step)
    normals = np.cross(along, across)
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-12)
    at = np.arange(u.size).reshape(u.shape)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    triangles = np.concatenate((np.stack((a, b, c), axis=1), np.stack((a, c, d), axis=1)))
    return Mesh(place(u, v).reshape(-1, 3), normals.reshape(-1, 3), triangles)


def lathe(radius: Callable, height: Callable, turns: int = 160, rows: int = 160) -> Mesh:
    """What turns about the y axis: radius(t) and height(t) of its profile, t from 0 to 1, upward or downward alike."""

    def place(t, phi):
        return np.stack((radius(t) * np.cos(phi), height(t), radius(t) * np.sin(phi)), axis=-1)

    return surface_mesh(place, np.linspace(1e-3, 1 - 1e-3, rows), np.linspace(0, 2 * np.pi, turns))


def tube(path: Callable, radius: Callable, rows: int = 80, turns: int = 40) -> Mesh:
    """A tube along path(t) (..., 3) in the plane z = 0, of radius(t)."""

    def place(t, phi):
        ahead = path(t + 1e-4) - path(t - 1e-4)
        ahead = ahead / np.linalg.norm(ahead, axis=-1, keepdims=True)
        side = np.stack((-ahead[..., 1], ahead[..., 0], 0 * t), axis=-1)
        out = np.cos(phi)[..., None] * side + np.sin(phi)[..., None] * np.array([0.0, 0.0, 1.0])
        return path(t) + radius(t)[..., None] * out

    return surface_mesh(place, np.linspace(0, 1, rows), np.linspace(0, 2 * np.pi, turns))


def teapot() -> list[Mesh]:
    """A pot: belly and lid of one profile, a spout to the left and a handle to the right."""

    def radius(t):
        belly = np.sqrt(np.maximum(np.sin(np.pi * np.clip(t / 0.8, 0, 1)), 0))
        lid = 0.16 * np.sin(np.pi * np.clip((t - 0.8) / 0.2, 0, 1)) ** 0.8
        return np.where(t < 0.8, 1e-3 + belly, 0.02 + lid)

    def height(t):
        return np.where(t < 0.8, 0.78 - 0.74 * np.cos(np.pi * np.clip(t / 0.8, 0, 1)), 1.5 + 0.3 * (t - 0.8) / 0.2)

    def spout(t):
        return np.stack((-0.8 - 0.85 * t, 0.55 + 0.95 * np.maximum(t, 0) ** 1.6, 0 * t), axis=-1)

    def handle(t):
        turn = np.pi * (t - 0.5)
        return np.stack((0.82 + 0.62 * np.cos(turn), 0.78 + 0.46 * np.sin(turn), 0 * t), axis=-1)

    return [
        lathe(radius, height),
        tube(spout, lambda t: 0.24 - 0.14 * t),
        tube(handle, lambda t: 0.075 + 0 * t),
    ]


def car_body() -> Mesh:
    """A body of cross-sections that are superellipses: bonnet, cabin and tail in one line; no wheels, no glass."""

    def place(u, v):
        x = 2.2 * np.sin(0.5 * np.pi * u)
        roof = 0.36 + 0.42 / (1 + ((x - 0.15) / 1.05) ** 6) + 0.05 * np.cos(1.2 * x)
        end = np.sqrt(np.maximum(1 - np.abs(u) ** 7, 0))
        wide = 0.86 * end * (1 - 0.06 * x)
        power = 0.62
        c, s = np.cos(v), np.sin(v)
        z = wide * np.sign(c) * np.abs(c) ** power
        lean = 1 - 0.26 * np.clip(s, 0, 1) * (roof - 0.4)
        y = 0.42 + np.where(s > 0, roof, 0.26) * end * np.sign(s) * np.abs(s) ** power
        return np.stack((x, y, z * lean), axis=-1)

    rows = 0.9998 * np.sin(np.linspace(-0.5 * np.pi, 0.5 * np.pi, 200))  # close together where it ends
    return surface_mesh(place, rows, np.linspace(-np.pi, np.pi, 241))
