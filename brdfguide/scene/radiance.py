"""The radiance that a reflectance law sends into the camera, over the pixels of a scene.

    L = Σ_lights E ⟨f cos θi⟩_disc  +  mirror · (radiance of what is seen in the mirror)  +  environment

A light is a disc and is averaged over; a mirror shows it; a uniform environment is integrated for a few view angles
and interpolated. Everything is linear in f, so that the parts of a law can be integrated apart and added.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, pi, radians

import numpy as np

from ..numerics import sphere
from ..physics.geometry import Geometry, rows
from . import pixels
from .scene import Scene

LEAST_RADIUS = radians(0.5 / 60)  # half an arc minute: what the eye takes for a point
MOST_DISC_POINTS = 24
ENVIRONMENT_NODES = 16  # view angles at which the light all around is integrated
ENVIRONMENT_POINTS = 512  # directions for each of them
FEWER_POINTS = 128  # the same while shapes are searched
# 1/p and 1/p² of p³ = p + 1: points that fill the square evenly
EVEN_STEPS = np.array([0.7548776662466927, 0.5698402909980532])
FLIP = np.array([-1.0, -1.0, 1.0])  # a direction to its mirror direction


@dataclass(frozen=True, eq=False)
class Quadrature:
    """Pixels of a picture: light and view directions in the frame of the surface there."""

    scene: Scene
    seed: int
    weights: np.ndarray  # (pixels,): share of the picture, sums to 1
    to_camera: np.ndarray  # (pixels, 3)
    to_lights: np.ndarray  # (pixels, lights, 3)
    width: float  # of the narrowest lobe [rad]
    points: int = ENVIRONMENT_POINTS  # of the environment, for each view angle integrated

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
        directions, factors, pixels = [], [], []
        for place, (light, radius) in enumerate(zip(self.scene.lights, self.radii, strict=True)):
            # as many points as a lobe needs to vary little from one to the next
            count = int(np.clip(ceil(2 * (radius / self.width) ** 2), 1, MOST_DISC_POINTS))
            points = sphere.cap(self.to_lights[:, place], radius if count > 1 else 0.0, count)
            directions.append(points.reshape(-1, 3))
            factors.append(np.full(len(self) * count, light.irradiance / count))
            pixels.append(np.repeat(np.arange(len(self)), count))
        towards, pixel = np.concatenate(directions), np.concatenate(pixels)
        above = towards[:, 2] > 0
        geom = rows(Geometry.from_vectors(towards[above], self.to_camera[pixel[above]]))
        return geom, (np.concatenate(factors) * towards[:, 2])[above] * self.unit, pixel[above]

    @cached_property
    def mirrored(self) -> tuple[Geometry, np.ndarray]:
        """The mirror pair of each view direction (pixels, 1), and the radiance that a perfect mirror shows there."""
        image = self.to_camera * FLIP
        chord2 = np.sum((image[:, None, :] - self.to_lights) ** 2, axis=2)
        brightness = np.array([light.irradiance for light in self.scene.lights]) / (pi * self.radii**2)
        radiance = np.where(chord2 <= self.radii**2, brightness, 0.0).sum(axis=1) + self.scene.environment / pi
        return rows(Geometry.from_vectors(image, self.to_camera)), radiance * self.unit

    @cached_property
    def around(self) -> tuple[Geometry, np.ndarray, np.ndarray]:
        """Directions all around at a few view angles, the factor of each row, and (pixels, nodes) to interpolate."""
        angles = np.radians(89.5 * np.sin(np.linspace(0, pi / 2, ENVIRONMENT_NODES)))  # closer together toward grazing
        view = np.repeat(sphere.from_angles(np.cos(angles), 0.0)[:, None, :], self.points, axis=1)
        half = self.points // 2
        u, v = np.remainder(np.arange(half)[:, None] * EVEN_STEPS + 0.5 / half, 1.0).T
        mirror, spread = view * FLIP, 2 * self.width
        # half of the points even under the cosine, half about the mirror direction, each weighed by both densities
        even = np.broadcast_to(sphere.from_angles(np.sqrt(1 - u), 2 * pi * v), mirror[:, :half].shape)
        towards = np.concatenate([even, sphere.near(mirror[:, half:], spread, u, v)], axis=1)
        cosine = np.maximum(towards[..., 2], 0.0)
        density = 0.5 * cosine / pi + 0.5 * sphere.near_density(towards, mirror, spread)
        factor = self.scene.environment / pi * cosine / density / self.points * self.unit
        geom = rows(Geometry.from_vectors(towards.reshape(-1, 3), view.reshape(-1, 3)))
        theta = np.minimum(
            np.arctan2(np.hypot(self.to_camera[:, 0], self.to_camera[:, 1]), self.to_camera[:, 2]), angles[-1]
        )
        low = np.minimum(np.searchsorted(angles, theta, side="right") - 1, ENVIRONMENT_NODES - 2)
        share = (theta - angles[low]) / (angles[low + 1] - angles[low])
        between, pixel = np.zeros((len(self), ENVIRONMENT_NODES)), np.arange(len(self))
        between[pixel, low], between[pixel, low + 1] = 1 - share, share
        return geom, factor.ravel(), between

    def radiance(self, brdf) -> np.ndarray:
        """Relative radiance (pixels, channels) of the finite part of a law, `brdf(geom)` [1/sr]."""
        geom, factor, pixel = self.lit
        values = brdf(geom) * factor[:, None]
        total = np.stack([np.bincount(pixel, column, len(self)) for column in values.T], axis=1)
        if self.scene.environment:
            geom, factor, between = self.around
            values = brdf(geom) * factor[:, None]
            total = total + between @ values.reshape(ENVIRONMENT_NODES, self.points, -1).sum(axis=1)
        return total

    def mirror_radiance(self, mirror) -> np.ndarray:
        """Relative radiance (pixels, channels) of the ideal specular part of a law, `mirror(geom)`, dimensionless."""
        geom, radiance = self.mirrored
        return mirror(geom) * radiance[:, None]

    def angles_deg(self, pixel: int) -> tuple[float, float, float]:
        """theta_i, theta_r and phi [deg] of one pixel, to the light nearest to its mirror direction."""
        nearest = np.argmin(np.sum((self.to_lights[pixel] - self.to_camera[pixel] * FLIP) ** 2, axis=1))
        geom = Geometry.from_vectors(self.to_lights[pixel, nearest], self.to_camera[pixel])
        phi = abs(float(np.degrees(sphere.wrapped(np.radians(geom.phi_deg)))))
        return round(float(geom.theta_i_deg), 2), round(float(geom.theta_r_deg), 2), round(phi, 2)

    def some(self, pixels) -> "Quadrature":
        """The same for some of the pixels, with their shares of the picture unchanged, and a coarser environment."""
        return replace(
            self,
            weights=self.weights[pixels],
            to_camera=self.to_camera[pixels],
            to_lights=self.to_lights[pixels],
            points=FEWER_POINTS,
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
            theta_r = self.centres.theta_r_deg
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
        if self.scene.environment:
            return dict.fromkeys(("theta_i_deg", "theta_r_deg", "theta_h_deg", "theta_d_deg"), (0.0, 90.0)) | {
                "phi_deg": (0.0, 180.0)
            }
        rim = float(np.degrees(self.radii.max()))
        widen = {"theta_i_deg": rim, "theta_h_deg": rim / 2, "theta_d_deg": rim / 2}
        return {
            name: (max(low - widen.get(name, 0.0), 0.0), min(high + widen.get(name, 0.0), 90.0))
            for name, (low, high) in self.box().items()
        }


def sample(scene: Scene, size: int, seed: int, width: float) -> Quadrature:
    """About `size` pixels of `scene`, only those that face the camera and some light; fewer of a thin crescent.

    Takes  width [rad], of the narrowest lobe that may be seen.    Gives  a Quadrature, the same for the same seed.
    """
    for more in (1, 8, 64):
        weights, camera, lights = (
            pixels.listed_pixels(scene) if scene.pairs else pixels.sampled(scene, more * size, seed, width)
        )
        lit = np.any(lights[..., 2] > 0, axis=1) | (scene.environment > 0)
        kept = (weights > 0) & (camera[:, 2] > 0) & lit
        if scene.pairs or np.count_nonzero(kept) > size / 4:
            break
    weights = weights[kept]
    return Quadrature(scene, seed, weights / max(weights.sum(), 1e-300), camera[kept], lights[kept], width)
