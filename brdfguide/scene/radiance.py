"""The radiance that a reflectance law sends into the camera, over the pixels of a scene.

    L = Σ_lights E ⟨f cos θi⟩_disc  +  mirror · (radiance of what is seen in the mirror)  +  light from all around

A light is a disc and is averaged over (`lamps`); a mirror shows it; what stands all around is integrated
(`all_around`).
Everything is linear in f, so that the parts of a law can be integrated apart and added.
"""

from dataclasses import replace
from functools import cached_property
from math import pi, radians

import numpy as np

from ..numerics import sphere
from ..physics.geometry import Geometry, rows
from ..records import dataclass
from . import lamps, pixels
from .all_around import AllAround
from .grained_around import GrainedAround
from .lamps import FLIP
from .scene import Scene

LEAST_RADIUS = radians(0.5 / 60)  # half an arc minute: what the eye takes for a point


@dataclass(frozen=True, eq=False)
class Quadrature:
    """Pixels of a picture: light and view directions in the frame of the surface there."""

    scene: Scene
    seed: int
    weights: np.ndarray  # (pixels,): share of the picture, sums to 1
    to_camera: np.ndarray  # (pixels, 3)
    to_lights: np.ndarray  # (pixels, lights, 3)
    width: float  # of the narrowest lobe [rad]
    to_world: np.ndarray | None = None  # (pixels, 3, 3) to the world of the surroundings, where these have a form
    fewer: bool = False  # whether light from all around is integrated coarsely
    turns: bool = False  # whether the surface changes as it is turned in its plane

    def __len__(self) -> int:
        return len(self.weights)

    @property
    def unit(self) -> float:
        """Radiance is counted in that of a perfect white diffuser facing every light."""
        return pi / self.scene.total_irradiance

    @cached_property
    def radii(self) -> np.ndarray:
        """Radius [rad] of each light as one pixel sees it mirrored: its disc, and the turn of the normal within the
        pixel.

        A disc of radius a has a variance of a²/4 about each axis; the mirror direction turns twice as far as the
        normal.
        """
        radius = np.maximum([radians(light.radius_deg) for light in self.scene.lights], LEAST_RADIUS)
        return np.sqrt(radius**2 + 4 * (2 * self.scene.pixel_normal) ** 2)

    @cached_property
    def lit(self) -> tuple[Geometry, np.ndarray, np.ndarray]:
        """Directions (rows, 1) to the points of all discs, the factor each carries, and the pixel it belongs to."""
        parts = [
            (directions, light.irradiance * shares, pixel)
            for place, (light, radius) in enumerate(zip(self.scene.lights, self.radii, strict=True))
            for directions, shares, pixel in [
                lamps.lit_points(self.to_lights[:, place], self.to_camera, radius, self.width)
            ]
        ]
        parts.append((np.zeros((0, 3)), np.zeros(0), np.zeros(0, int)))  # of a scene without lamps
        towards, factor, pixel = (np.concatenate(each) for each in zip(*parts, strict=True))
        geom = rows(Geometry.from_vectors(towards, self.to_camera[pixel]))
        return geom, factor * towards[:, 2] * self.unit, pixel

    @cached_property
    def mirrored(self) -> tuple[Geometry, np.ndarray]:
        """The mirror pair of each view direction (pixels, 1), and the radiance that a perfect mirror shows there."""
        image = self.to_camera * FLIP
        chord2 = np.sum((image[:, None, :] - self.to_lights) ** 2, axis=2)
        brightness = np.array([light.irradiance for light in self.scene.lights]) / (pi * self.radii**2)
        radiance = np.where(chord2 <= self.radii**2, brightness, 0.0).sum(axis=1)
        if self.scene.around:
            world = image if self.to_world is None else np.einsum("pij,pj->pi", self.to_world, image)
            radiance = radiance + self.scene.around.radiance(world)
        return rows(Geometry.from_vectors(image, self.to_camera)), radiance * self.unit

    @cached_property
    def around(self) -> AllAround | None:
        """The quadrature of light from all around, where there is any."""
        around = self.scene.around
        if around is None:
            return None
        kind = GrainedAround if self.turns else AllAround
        return kind(around, self.to_camera, self.to_world, self.width, self.fewer)

    @property
    def representative(self) -> Geometry:
        """Directions (rows, 1) in which the law is asked: to the lamps, or all around where none is seen."""
        geom = self.lit[0]
        return geom if len(geom) or self.around is None else self.around.asked

    def radiance(self, brdf) -> np.ndarray:
        """Relative radiance (pixels, channels) of the finite part of a law, `brdf(geom)` [1/sr]."""
        geom, factor, pixel = self.lit
        total: np.ndarray = np.zeros((len(self), 1))
        if len(geom) or self.around is None:
            values = brdf(geom) * factor[:, None]
            total = np.stack([np.bincount(pixel, column, len(self)) for column in values.T], axis=1)
        if self.around is not None:
            total = total + self.around.reflected(brdf) * self.unit
        return total

    def mirror_radiance(self, mirror) -> np.ndarray:
        """Relative radiance (pixels, channels) of the ideal specular part of a law, `mirror(geom)`, dimensionless."""
        geom, radiance = self.mirrored
        return mirror(geom) * radiance[:, None]

    def angles_deg(self, pixel: int) -> tuple[float, float, float]:
        """theta_i, theta_r and phi [deg] of one pixel, to the light nearest to its mirror direction; without lights to
        that direction itself."""
        if not self.scene.lights:
            theta = float(np.degrees(np.arccos(np.clip(self.to_camera[pixel, 2], 0, 1))))
            return round(theta, 2), round(theta, 2), 180.0  # what it mirrors
        nearest = np.argmin(np.sum((self.to_lights[pixel] - self.to_camera[pixel] * FLIP) ** 2, axis=1))
        geom = Geometry.from_vectors(self.to_lights[pixel, nearest], self.to_camera[pixel])
        phi = abs(float(np.degrees(sphere.wrapped(np.radians(geom.phi_deg)))))
        return round(float(geom.theta_i_deg), 2), round(float(geom.theta_r_deg), 2), round(phi, 2)

    def some(self, pixels) -> "Quadrature":
        """The same for some of the pixels, with their shares of the picture unchanged, and coarser surroundings."""
        return replace(
            self,
            weights=self.weights[pixels],
            to_camera=self.to_camera[pixels],
            to_lights=self.to_lights[pixels],
            to_world=None if self.to_world is None else self.to_world[pixels],
            fewer=True,
        )

    @cached_property
    def centres(self) -> Geometry:
        """Each pixel with the centre of each light, (pixels · lights,)."""
        pixel = np.repeat(np.arange(len(self)), self.to_lights.shape[1])
        return Geometry.from_vectors(self.to_lights.reshape(-1, 3), self.to_camera[pixel])

    def box(self) -> dict[str, tuple[float, float]]:
        """Smallest and largest angle [deg] of those a law is written in; of the view alone where no light reaches."""
        geom = self.centres[self.centres.lit]
        if not len(geom):
            theta_r = np.degrees(np.arctan2(np.hypot(self.to_camera[:, 0], self.to_camera[:, 1]), self.to_camera[:, 2]))
            return {"theta_r_deg": (float(theta_r.min()), float(theta_r.max()))}
        angles = {
            "theta_i_deg": geom.theta_i_deg,
            "theta_r_deg": geom.theta_r_deg,
            "phi_deg": np.abs(np.degrees(sphere.wrapped(np.radians(geom.phi_deg)))),
            "theta_h_deg": np.degrees(np.arctan(np.sqrt(geom.tan2_h))),
            "theta_d_deg": np.degrees(np.arccos(np.clip(geom.cos_d, 0, 1))),
        }
        return {name: (float(values.min()), float(values.max())) for name, values in angles.items()}

    @cached_property
    def angular_range_deg(self) -> dict[str, tuple[float, float]]:
        """The box widened to the rims of the lights, and to all angles where light comes from all around."""
        if self.scene.around:
            return dict.fromkeys(("theta_i_deg", "theta_r_deg", "theta_h_deg", "theta_d_deg"), (0.0, 90.0)) | {
                "phi_deg": (0.0, 180.0)
            }
        rim = float(np.degrees(self.radii.max()))
        widen = {"theta_i_deg": rim, "theta_h_deg": rim / 2, "theta_d_deg": rim / 2}
        return {
            name: (max(low - widen.get(name, 0.0), 0.0), min(high + widen.get(name, 0.0), 90.0))
            for name, (low, high) in self.box().items()
        }


def sample(scene: Scene, size: int, seed: int, width: float, turns: bool = False) -> Quadrature:
    """About `size` pixels of `scene`, only those that face the camera and some light; fewer of a thin crescent.

    Takes  width [rad], of the narrowest lobe that may be seen; turns, whether the surface changes as it is turned.
    Gives  a Quadrature, the same for the same seed.
    """
    for more in (1, 8, 64):
        weights, camera, lights, frame = (
            pixels.listed_pixels(scene) if scene.pairs else pixels.sampled(scene, more * size, seed, width)
        )
        if turns:
            weights, camera, lights, frame = pixels.under_turns(scene, weights, camera, lights, frame)
        lit = np.any(lights[..., 2] > 0, axis=1) | (scene.around is not None)
        kept = (weights > 0) & (camera[:, 2] > 0) & lit
        if scene.pairs or np.count_nonzero(kept) > size / 4:
            break
    weights, to_world = weights[kept], None
    if scene.around and scene.around.kind != "uniform":
        to_world = np.broadcast_to(scene.around.of_object @ np.swapaxes(frame, -1, -2), (len(kept), 3, 3))[kept]
    weights = weights / max(weights.sum(), 1e-300)
    return Quadrature(scene, seed, weights, camera[kept], lights[kept], width, to_world, turns=turns)
