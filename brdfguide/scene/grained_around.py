"""Light from all around, reflected by a law with a grain.

    L = ∫ f(h, r) Li cos θi dωi,    dωi = 4 (h·r) dωh

Half vectors stand still in the frame of the sample, so that the streak that they make is met wherever the camera
stands; at a given half vector f cos θi cos θr hardly changes with the angle and the azimuth that it is seen from: it is
tabulated over both and interpolated, and the light is looked up for every pixel.
"""

from functools import cached_property
from math import pi

import numpy as np

from ..numerics import sphere
from ..physics.geometry import Geometry
from ..records import dataclass
from .all_around import BLOCK, AllAround

RINGS, SPOKES = 24, 36  # of half vectors
FEWER_RINGS, FEWER_SPOKES = 14, 20  # while shapes are searched
AZIMUTHS = 12  # of the view, over a whole turn
ANGLES = 14  # of it from the normal
ASKED = 32  # one direction of so many stands for what a law costs


@dataclass(frozen=True, eq=False)
class GrainedAround(AllAround):
    """The same quadrature with a table over the azimuth of the view as well; azimuths are those of the sample."""

    angles = ANGLES
    rings_and_spokes = (RINGS, SPOKES), (FEWER_RINGS, FEWER_SPOKES)

    @property
    def asked(self) -> Geometry:
        """Some of the directions in which the law is asked, for its cost."""
        return self.tabulated[0][::ASKED]

    @property
    def views(self) -> np.ndarray:
        """The same in the frame of the sample, (azimuths, nodes, 3)."""
        azimuths = 2 * pi / AZIMUTHS * np.arange(AZIMUTHS)[:, None]
        return sphere.from_angles(np.cos(self.nodes), azimuths)

    @cached_property
    def turned(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each pixel the azimuth of the table below its own, and how far it is on the way to the next."""
        at = np.remainder(np.arctan2(self.to_camera[:, 1], self.to_camera[:, 0]) / (2 * pi), 1.0) * AZIMUTHS
        low = np.minimum(at.astype(int), AZIMUTHS - 1)
        return low, at - low

    @cached_property
    def seen(self) -> np.ndarray:
        """Radiance from each half vector's light times 4 (h·r) dωh / cos θr, (pixels, points)."""
        half, area = self.half_vectors
        low, share = self.places
        cos_r = np.cos(np.interp(low + share, np.arange(ANGLES), self.nodes))
        found = np.empty((len(self.to_camera), len(half)), np.float32)
        for at in range(0, len(found), BLOCK):
            block = slice(at, at + BLOCK)
            camera = self.to_camera[block, None, :]
            along = np.maximum(sphere.dot(half, camera), 0.0)
            light = 2 * along[..., None] * half - camera
            apart = np.sqrt(along * area)  # directions of light, one from the next
            world = light if self.to_world is None else light @ np.swapaxes(self.to_world[block], 1, 2)
            reached = (along > 0) & (light[..., 2] > 0)
            incident = self.surroundings.radiance(world, apart)
            found[block] = np.where(reached, incident * along * area / cos_r[block, None], 0.0)
        return found

    def reflected(self, brdf) -> np.ndarray:
        """Radiance (pixels, channels) of a finite law, `brdf(geom)` [1/sr], in the unit of the surroundings."""
        geom, cosines, place = self.tabulated
        values = brdf(geom) * cosines[:, None]
        points = len(self.half_vectors[0])
        table = np.zeros((AZIMUTHS * ANGLES * points, values.shape[1]), np.float32)
        table[place] = values
        table = table.reshape(AZIMUTHS, ANGLES, points, -1)
        (low, share), (turn, between) = self.places, self.turned
        found = np.zeros((len(low), table.shape[3]))
        for azimuth, node in sorted({*zip(turn.tolist(), low.tolist(), strict=True)}):
            here = np.flatnonzero((turn == azimuth) & (low == node))
            for onward, of_azimuth in ((0, 1 - between[here]), (1, between[here])):
                for steeper, of_node in ((0, 1 - share[here]), (1, share[here])):
                    reflected = self.seen[here] @ table[(azimuth + onward) % AZIMUTHS, node + steeper]
                    found[here] += (of_azimuth * of_node)[:, None] * reflected
        return found
