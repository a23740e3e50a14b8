"""Pixels sampled from a scene: where the camera, the lights and the normal are, and how much of the picture each stands
for.

Half of the pixels come from the scene itself, half from the neighbourhood of each light's mirror direction (a
"defensive mixture"), where a highlight would be; every pixel then weighs

    weight = p / (p/2 + q/2),     p: density of the scene, q: of the neighbourhood, in the same variables,

so that means, percentiles and areas are those of the picture and not those of the sample (Hesterberg 1995).
"""

from math import cos, pi, radians, sin

import numpy as np

from ..numerics import sphere
from ..records import dataclass
from .scene import DirectionRange, Scene

LISTED_TURNS = 24  # of a sample with a grain, for each listed pair of directions


@dataclass(frozen=True)
class Range:
    """A range of directions, even in solid angle, or in projected solid angle; only azimuth or zenith may be free."""

    theta: tuple[float, float]  # [rad]
    phi: tuple[float, float]
    projected: bool

    @classmethod
    def of(cls, directions: DirectionRange, scene: Scene) -> "Range":
        low, high = (radians(angle) for angle in directions.theta_deg)
        first, last = (0.0 if scene.in_plane else radians(angle) for angle in directions.phi_deg)
        return cls((low, high), (first, last), scene.shape == "arbitrary")

    @property
    def free_theta(self) -> bool:
        return self.theta[1] > self.theta[0]

    @property
    def free_phi(self) -> bool:
        return self.phi[1] > self.phi[0]

    @property
    def extent(self) -> tuple[int, float]:
        """How many coordinates are free, and the area they span: what has more room is moved."""
        return self.free_theta + self.free_phi, (cos(self.theta[0]) - cos(self.theta[1]) or 1.0) * (
            self.phi[1] - self.phi[0] or 1.0
        )

    def sample(self, u, v) -> np.ndarray:
        """Directions (..., 3) from uniform numbers."""
        low, high = cos(self.theta[1]), cos(self.theta[0])
        cos_theta = np.sqrt(low**2 + (high**2 - low**2) * u) if self.projected else low + (high - low) * u
        return sphere.from_angles(cos_theta, self.phi[0] + (self.phi[1] - self.phi[0]) * v)

    def sample_near(self, target, start, spread, u, v) -> np.ndarray:
        """Directions scattered about `target` in the free coordinates; the others stay as in `start`."""
        if self.free_theta and self.free_phi:
            return sphere.near(target, spread, u, v)
        (theta, phi), (target_theta, target_phi) = _angles(start), _angles(target)
        offset = spread * np.sqrt(-2 * np.log(1 - u)) * np.cos(2 * pi * v)  # Box and Muller
        if self.free_theta:
            return sphere.from_angles(np.cos(np.abs(target_theta + offset)), phi)
        return sphere.from_angles(np.cos(theta), target_phi + offset / max(sin(self.theta[0]), 1e-9))

    def relative_density(self, directions, target, spread) -> np.ndarray:
        """Density of `sample_near` over that of `sample`, at `directions`."""
        theta, phi = _angles(directions)
        target_theta, target_phi = _angles(target)
        low, high = cos(self.theta[1]), cos(self.theta[0])
        weight, whole = (np.cos(theta), (high**2 - low**2) / 2) if self.projected else (1.0, high - low)
        if self.free_theta and self.free_phi:
            return (
                sphere.near_density(directions, target, spread)
                * whole
                * (self.phi[1] - self.phi[0])
                / np.maximum(weight, 1e-12)
            )
        if self.free_theta:
            return sphere.gaussian(theta - target_theta, spread) * whole / np.maximum(weight * np.sin(theta), 1e-12)
        if self.free_phi:
            return sphere.gaussian(sphere.wrapped(phi - target_phi), spread / max(sin(self.theta[0]), 1e-9)) * (
                self.phi[1] - self.phi[0]
            )
        return np.ones(np.shape(theta))

    def contains(self, directions) -> np.ndarray:
        theta, phi = _angles(directions)
        slack = 1e-9
        turn = np.remainder(phi - self.phi[0] + slack, 2 * pi)
        return (
            (theta >= self.theta[0] - slack)
            & (theta <= self.theta[1] + slack)
            & (turn <= self.phi[1] - self.phi[0] + 2 * slack)
        )


def sampled(scene: Scene, size: int, seed: int, width: float):
    """Weights (pixels,), camera (pixels, 3) and lights (pixels, lights, 3) in the frame of the surface, and the axes of
    that frame in the object's, rows of (pixels, 3, 3) or (3, 3).

    Takes  width [rad], of the narrowest lobe that may be seen.    Gives  `size` pixels; weight 0 for those outside.
    """
    rng = np.random.default_rng(seed)
    count = len(scene.lights)
    u = np.stack([(rng.permutation(size) + rng.random(size)) / size for _ in range(6 + 2 * count)])
    camera_range, *ranges = (
        Range.of(each, scene) for each in (scene.camera, *(light.directions for light in scene.lights))
    )
    camera = camera_range.sample(u[0], u[1])
    if scene.in_plane:
        camera = camera * np.where(u[1:2].T < 0.5, [[-1.0, -1.0, 1.0]], 1.0)
    drawn = [each.sample(u[6 + 2 * j], u[7 + 2 * j]) for j, each in enumerate(ranges)]
    lights = np.stack(drawn, axis=1) if drawn else np.zeros((size, 0, 3))
    normals = _normals(scene.shape, camera, u[2])
    spreads = [np.where(u[5] < 0.5, *_spreads(scene, j, width)) for j in range(count)]
    curved = scene.shape in ("sphere", "cylinder")
    moves_light = [each.extent >= camera_range.extent for each in ranges]

    def mirror_of(directions):
        return 2 * sphere.dot(normals, directions)[:, None] * normals - directions

    for j in range(count):
        near = u[4] * 2 * count // 1 == j  # beyond the last light: the scene itself
        if curved:
            half = sphere.unit(camera + lights[:, j])
            moved, new = normals, _normals_near(scene.shape, half, spreads[j] / 2, u[2], u[3])
        elif moves_light[j]:
            moved, new = lights[:, j], ranges[j].sample_near(mirror_of(camera), lights[:, j], spreads[j], u[2], u[3])
        else:
            moved, new = camera, camera_range.sample_near(mirror_of(lights[:, j]), camera, spreads[j], u[2], u[3])
        moved[near] = new[near]

    ratio, inside = np.zeros(size), np.ones(size, bool)
    for j in range(count):
        for spread in _spreads(scene, j, width):
            if curved:
                half = sphere.unit(camera + lights[:, j])
                each = _relative_density_of_normals(scene.shape, normals, half, camera, spread / 2)
            elif moves_light[j]:
                each = ranges[j].relative_density(lights[:, j], mirror_of(camera), spread)
            else:
                each = camera_range.relative_density(camera, mirror_of(lights[:, j]), spread)
            ratio += each / (2 * count)
        inside &= ranges[j].contains(lights[:, j])
    if not scene.in_plane:
        inside &= camera_range.contains(camera)
    weights = np.where(inside, 1 / (0.5 + 0.5 * ratio) if count else 1.0, 0.0)
    if scene.shape in ("plane", "arbitrary"):
        return weights, camera, lights, _upright(scene, size, rng)
    frame = np.stack([*sphere.tangents(normals), normals], axis=1)
    return weights, np.einsum("sij,sj->si", frame, camera), np.einsum("sij,slj->sli", frame, lights), frame


def under_turns(scene: Scene, weights, camera, lights, frame):
    """The same four in the frames of a sample with a grain: azimuth 0 lies along the meridians of a sphere, a cylinder
    and the sides of a box, toward the object's axis, and the sample is turned by what the scene says. Listed directions
    are repeated under each of LISTED_TURNS."""
    low, high = (radians(angle) for angle in scene.turns_deg)
    count = len(weights)
    if scene.pairs and high > low:
        weights, camera, lights = (np.repeat(each, LISTED_TURNS, axis=0) for each in (weights, camera, lights))
        weights, share = weights / LISTED_TURNS, np.tile((np.arange(LISTED_TURNS) + 0.5) / LISTED_TURNS, count)
    else:  # through all values, in no order that a pixel's place has
        share = np.remainder(np.arange(count) * (sphere.GOLDEN_ANGLE / (2 * pi)), 1.0)
    turn = low + (high - low) * share
    frame = np.broadcast_to(frame, (len(turn), 3, 3))
    if scene.shape in ("sphere", "cylinder", "box") and not scene.pairs:
        turn = turn + np.arctan2(frame[:, 1, 2], frame[:, 0, 2])
    cos, sin, zero = np.cos(turn), np.sin(turn), np.zeros(len(turn))
    axes = np.stack(
        [np.stack([cos, sin, zero], 1), np.stack([-sin, cos, zero], 1), np.stack([zero, zero, zero + 1], 1)], 1
    )
    camera, lights = np.einsum("sij,sj->si", axes, camera), np.einsum("sij,slj->sli", axes, lights)
    return weights, camera, lights, axes @ frame


def _upright(scene: Scene, size: int, rng) -> np.ndarray:
    """The frame of a plane, which is the object's; of an arbitrary shape, whose surface may be turned any way, axes
    that are."""
    if scene.shape == "plane" or scene.around is None:
        return np.eye(3)
    normals = sphere.from_angles(2 * rng.random(size) - 1, 2 * pi * rng.random(size))
    turn = 2 * pi * rng.random(size)[:, None]
    x, y = sphere.tangents(normals)
    return np.stack([np.cos(turn) * x + np.sin(turn) * y, np.cos(turn) * y - np.sin(turn) * x, normals], axis=1)


def _spreads(scene: Scene, light: int, width: float) -> tuple[float, float]:
    """Scatter about the mirror direction of a light: that of the lobe, and that of the light's image itself."""
    radius = radians(scene.lights[light].radius_deg) + 2 * scene.pixel_normal
    return max(width, radius), max(radius, radians(0.5 / 60)) / 1.5


def _angles(directions):
    """Zenith angle and azimuth [rad]."""
    x, y, z = np.moveaxis(directions, -1, 0)
    return np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)


def _normals(shape: str, camera, u) -> np.ndarray:
    """Normals (pixels, 3) as the camera sees them: each as often as its share of the picture."""
    if shape == "sphere":
        # the azimuth round the line of sight runs through all values while u does, by the golden ratio
        return sphere.turned(camera, np.sqrt(1 - u), sphere.GOLDEN_ANGLE * len(u) * u)
    if shape == "cylinder":
        return sphere.from_angles(np.zeros(len(u)), _angles(camera)[1] + np.arcsin(2 * u - 1))
    if shape == "box":
        share = np.cumsum(np.abs(camera), axis=1)
        face = np.sum(u[:, None] * share[:, 2:] > share[:, :2], axis=1)
        return np.eye(3)[face] * np.where(camera >= 0, 1.0, -1.0)
    return np.broadcast_to([0.0, 0.0, 1.0], camera.shape).copy()


def _normals_near(shape: str, half, spread, u, v) -> np.ndarray:
    """Normals scattered about the half vector, where the mirror image of a light is."""
    if shape == "sphere":
        return sphere.near(half, spread, u, v)
    offset = spread * np.sqrt(-2 * np.log(1 - u)) * np.cos(2 * pi * v)
    return sphere.from_angles(np.zeros(len(u)), _angles(half)[1] + offset)


def _relative_density_of_normals(shape: str, normals, half, camera, spread) -> np.ndarray:
    """Density of `_normals_near` over that of `_normals`; 0 on the far side, which is not in the picture."""
    facing = sphere.dot(normals, camera)
    if shape == "sphere":
        even = facing / pi
        near = sphere.near_density(normals, half, spread)
    else:
        even = 0.5 * facing / np.maximum(np.hypot(camera[:, 0], camera[:, 1]), 1e-12)
        near = sphere.gaussian(sphere.wrapped(_angles(normals)[1] - _angles(half)[1]), spread)
    return np.where(facing > 0, near / np.where(facing > 0, even, 1.0), 0.0)


def listed_pixels(scene: Scene):
    """The same for a scene that lists its directions: as they are."""
    pairs = scene.pairs
    camera = sphere.from_angles(np.cos(np.radians([p.theta_r_deg for p in pairs])), 0.0)
    lights = sphere.from_angles(
        np.cos(np.radians([p.theta_i_deg for p in pairs])), np.radians([p.phi_deg for p in pairs])
    )
    return np.array([p.weight for p in pairs]), camera, lights[:, None, :], np.eye(3)
