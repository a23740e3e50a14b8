"""Light from all around, reflected by a law into the camera.

    L = ∫ f(h, θr) Li cos θi dωi,    dωi = 4 (h·r) dωh,    dωh = t dt dφ/(1 + t²)^{3/2},    t = tan of h's tilt

Half vectors lie on rings about the normal in even steps of ln t, so that a lobe of any width is met. At a given half
vector f cos θi cos θr hardly changes with the angle of view (of a microfacet law it is D G F/4): it is tabulated over a
few angles and interpolated, while the surroundings are looked up for every pixel. So the law is evaluated as seldom as
for one pixel in a hundred, and everything stays linear in it.
"""

from functools import cached_property
from math import pi
from typing import ClassVar

import numpy as np

from ..numerics import sphere
from ..physics.geometry import Geometry, rows
from ..records import dataclass
from .surroundings import Surroundings

NODES = 32  # angles of view at which the law is tabulated
RINGS, SPOKES = 24, 24  # of half vectors
FEWER_RINGS, FEWER_SPOKES = 16, 14  # while shapes are searched
LEAST_TILT = 0.03  # of the lobe's width, the innermost ring
MOST_TILT = 40.0  # tangent, the outermost
TURN = 0.618  # of a spoke, from ring to ring
BLOCK = 256  # pixels that are looked up at a time


def half_vectors(width: float, rings: int, spokes: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors (points, 3) on rings about the normal for a lobe of `width` [rad], and 4 dωh of each."""
    edges = np.linspace(np.log(LEAST_TILT * width), np.log(MOST_TILT), rings + 1)
    t = np.exp(0.5 * (edges[1:] + edges[:-1]))[:, None]
    phi = 2 * pi / spokes * (np.arange(spokes) + 0.5 + TURN * np.arange(rings)[:, None])
    cosine = 1 / np.sqrt(1 + t * t)
    half = np.stack(np.broadcast_arrays(t * cosine * np.cos(phi), t * cosine * np.sin(phi), cosine), axis=-1)
    area = np.broadcast_to(4 * t * t * cosine**3 * (edges[1] - edges[0]) * 2 * pi / spokes, phi.shape)
    return half.reshape(-1, 3), area.ravel()


@dataclass(frozen=True, eq=False)
class AllAround:
    """The quadrature of one picture: half vectors, angles of view, and what each pixel sees by each half vector."""

    surroundings: Surroundings
    to_camera: np.ndarray  # (pixels, 3) in the frame of the surface
    to_world: np.ndarray | None  # (pixels, 3, 3), or nothing where the light is even
    width: float  # of the narrowest lobe [rad]
    fewer: bool = False
    angles: ClassVar[int] = NODES
    rings_and_spokes: ClassVar = (RINGS, SPOKES), (FEWER_RINGS, FEWER_SPOKES)

    @cached_property
    def half_vectors(self) -> tuple[np.ndarray, np.ndarray]:
        """Half vectors (points, 3) in the frame whose first axis points to the camera's side, and 4 dωh of each."""
        return half_vectors(self.width, *self.rings_and_spokes[self.fewer])

    @cached_property
    def nodes(self) -> np.ndarray:
        """Angles of view [rad], closer together toward grazing."""
        return np.radians(89.5 * np.sin(np.linspace(0, pi / 2, self.angles)))

    @property
    def views(self) -> np.ndarray:
        """Unit vectors to the camera at which the law is tabulated, (nodes, 3)."""
        return sphere.from_angles(np.cos(self.nodes), 0.0)

    @cached_property
    def tabulated(self) -> tuple[Geometry, np.ndarray, np.ndarray]:
        """The lit directions (rows, 1) of the table, cos θi cos θr of each, and its place in (*views, points)."""
        half, _ = self.half_vectors
        camera = self.views[..., None, :]
        along = sphere.dot(half, camera)
        light = 2 * along[..., None] * half - camera
        lit = np.flatnonzero((along > 0) & (light[..., 2] > 0))
        light, camera = (np.broadcast_to(each, (*along.shape, 3)).reshape(-1, 3)[lit] for each in (light, camera))
        return rows(Geometry.from_vectors(light, camera)), light[:, 2] * camera[:, 2], lit

    @property
    def asked(self) -> Geometry:
        """The directions in which the law is asked."""
        return self.tabulated[0]

    @cached_property
    def places(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each pixel the node below its angle of view, and how far it is on the way to the next."""
        theta = np.arctan2(np.hypot(self.to_camera[:, 0], self.to_camera[:, 1]), self.to_camera[:, 2])
        count = len(self.nodes)
        at = np.interp(theta, self.nodes, np.arange(count))
        low = np.minimum(at.astype(int), count - 2)
        return low, at - low

    @cached_property
    def seen(self) -> np.ndarray:
        """Radiance from each half vector's light times 4 (h·r) dωh / cos θr, (pixels, points); of light that is even
        (nodes, points)."""
        half, area = self.half_vectors
        cos_r, frames = np.cos(self.nodes), None if self.to_world is None else self._frames(self.to_world)
        if frames is not None:
            low, share = self.places
            cos_r = np.cos(np.interp(low + share, np.arange(NODES), self.nodes))
        found = np.empty((len(cos_r), len(half)), np.float32)
        for at in range(0, len(cos_r), BLOCK):
            block = slice(at, at + BLOCK)
            camera = sphere.from_angles(cos_r[block], 0.0)[:, None, :]
            along = np.maximum(sphere.dot(half, camera), 0.0)
            light = 2 * along[..., None] * half - camera
            apart = np.sqrt(along * area)  # directions of light, one from the next
            incident = self.surroundings.radiance(light if frames is None else light @ frames[block], apart)
            reached = (along > 0) & (light[..., 2] > 0)
            found[block] = np.where(reached, incident * along * area / cos_r[block, None], 0.0)
        return found

    def _frames(self, to_world: np.ndarray) -> np.ndarray:
        """(pixels, 3, 3) that turn a row vector, its first axis on the camera's side, into the world."""
        across = np.hypot(self.to_camera[:, 0], self.to_camera[:, 1])
        sure = across > 1e-12
        length = np.where(sure, across, 1.0)
        x = np.where(sure, self.to_camera[:, 0] / length, 1.0)
        y = np.where(sure, self.to_camera[:, 1] / length, 0.0)
        zero = np.zeros_like(x)
        local = np.stack(
            [np.stack([x, y, zero], 1), np.stack([-y, x, zero], 1), np.stack([zero, zero, zero + 1], 1)], 1
        )
        return local @ np.swapaxes(to_world, 1, 2)

    def reflected(self, brdf) -> np.ndarray:
        """Radiance (pixels, channels) of a finite law, `brdf(geom)` [1/sr], in the unit of the surroundings."""
        geom, cosines, place = self.tabulated
        values = brdf(geom) * cosines[:, None]
        points = len(self.half_vectors[0])
        table = np.zeros((NODES * points, values.shape[1]))
        table[place] = values
        table = table.reshape(NODES, points, -1)
        low, share = self.places
        if self.to_world is None:
            at_nodes = np.einsum("nk,nkc->nc", self.seen, table)
            return (1 - share[:, None]) * at_nodes[low] + share[:, None] * at_nodes[low + 1]
        found = np.empty((len(low), table.shape[2]))
        for node in range(NODES - 1):
            here = np.flatnonzero(low == node)
            if len(here):
                both = self.seen[here] @ np.concatenate([table[node], table[node + 1]], axis=1).astype(np.float32)
                one, other = np.split(both, 2, axis=1)
                found[here] = (1 - share[here, None]) * one + share[here, None] * other
        return found
