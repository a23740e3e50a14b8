"""What stands on the floor: sphere, bent sheet, disc and knob, hit by rays, with a direction across their grooves.

Lengths are in radii of the sphere; x points right, y up from the floor, z toward the camera.
"""

from collections.abc import Callable

import numpy as np

from ...records import dataclass

SHEET_RADIUS, SHEET_WIDTH = 1.25, 2.9
DISC_TILT, DISC_TURN = np.radians(
    [18.0, -13.0]
)  # of its normal up from level, and to the right: it mirrors the edge of the key
HOLE = 0.06
STEPS = 64  # of the march to the knob, which ends at a twentieth of a pixel from it
NEAR, MET = 1e-4, 4e-4
UP = np.array([0.0, 1.0, 0.0])


@dataclass(frozen=True)
class Thing:
    """One object: where its middle stands, and its size."""

    name: str
    x: float = 0.0
    z: float = 0.0
    size: float = 1.0

    def hit(self, origin, ray) -> np.ndarray:
        """How far along rays (n, 3) of length 1 it is met, (n,); infinite where it is not."""
        return self.size * HITS[self.name](self._own(origin), np.asarray(ray))

    def normals(self, points, ray) -> tuple[np.ndarray, np.ndarray]:
        """Normals that face the rays, and directions across the grooves, (n, 3) each."""
        normal, across = NORMALS[self.name](self._own(points))
        turned = np.sum(normal * ray, axis=-1, keepdims=True) > 0
        normal = np.where(turned, -normal, normal)
        across = across - np.sum(across * normal, axis=-1, keepdims=True) * normal
        length = np.linalg.norm(across, axis=-1, keepdims=True)
        return normal, across / np.maximum(length, 1e-9)

    def blocks(self, origin, ray) -> np.ndarray:
        """Whether rays (n, 3) meet it, (n,): for shade, where the knob is two cylinders."""
        own = self._own(origin)
        if self.name == "knob":
            return _in_cylinder(own, ray, 1.0, 0.4) | _in_cylinder(own, ray, 0.68, 1.75)
        return np.isfinite(HITS[self.name](own, ray))

    @property
    def middle(self) -> np.ndarray:
        """The point from which the surroundings are seen."""
        return np.array([self.x, 0.9 * self.size, self.z])

    def _own(self, points) -> np.ndarray:
        return (np.asarray(points) - np.array([self.x, 0.0, self.z])) / self.size


def _hit_sphere(origin, ray):
    to = origin - UP
    along = np.sum(to * ray, axis=-1)
    depth = along**2 - np.sum(to * to, axis=-1) + 1
    far = -along - np.sqrt(np.maximum(depth, 0))
    return np.where((depth > 0) & (far > NEAR), far, np.inf)


def _normal_sphere(points):
    normal = points - UP
    return normal / np.linalg.norm(normal, axis=-1, keepdims=True), np.broadcast_to(UP, points.shape)


def _hit_sheet(origin, ray):
    """A quarter of a cylinder that lies on the floor: its lower edge faces the camera, its upper looks up."""
    y, z = origin[..., 1], origin[..., 2] + 0.6
    dy, dz = ray[..., 1], ray[..., 2]
    a = dy**2 + dz**2
    b = y * dy + z * dz
    depth = b**2 - a * (y**2 + z**2 - SHEET_RADIUS**2)
    root = np.sqrt(np.maximum(depth, 0))
    best = np.full(np.shape(depth), np.inf)
    for far in ((-b + root) / np.maximum(a, 1e-12), (-b - root) / np.maximum(a, 1e-12)):
        at_y, at_z = y + far * dy, z + far * dz
        on = (depth > 0) & (far > NEAR) & (at_y > 0) & (at_z > 0)
        on &= np.abs(origin[..., 0] + far * ray[..., 0]) < 0.5 * SHEET_WIDTH
        best = np.where(on, far, best)
    return best


def _normal_sheet(points):
    normal = points * [0.0, 1.0, 1.0] + [0.0, 0.0, 0.6]
    normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    return normal, np.stack((np.zeros(len(normal)), normal[:, 2], -normal[:, 1]), axis=-1)


DISC_NORMAL = np.array(
    [np.cos(DISC_TILT) * np.sin(DISC_TURN), np.sin(DISC_TILT), np.cos(DISC_TILT) * np.cos(DISC_TURN)]
)
DISC_CENTRE = np.array([0.0, np.cos(DISC_TILT), 0.0])


def _hit_disc(origin, ray):
    toward = ray @ DISC_NORMAL
    far = ((DISC_CENTRE - origin) @ DISC_NORMAL) / np.where(np.abs(toward) > 1e-9, toward, 1e-9)
    radius = np.linalg.norm(origin + far[..., None] * ray - DISC_CENTRE, axis=-1)
    return np.where((far > NEAR) & (radius < 1) & (radius > HOLE), far, np.inf)


def _normal_disc(points):
    outward = points - DISC_CENTRE
    return np.broadcast_to(DISC_NORMAL, points.shape), outward / np.linalg.norm(outward, axis=-1, keepdims=True)


def _rounded_box(rho, y, radius, top, rounding):
    a, b = rho - radius + rounding, np.abs(y - 0.5 * top) - 0.5 * top + rounding
    return np.minimum(np.maximum(a, b), 0) + np.hypot(np.maximum(a, 0), np.maximum(b, 0)) - rounding


def _blend(one, other, width):
    """The lesser of two distances, with a fillet where they meet (a quadratic blend)."""
    share = np.maximum(width - np.abs(one - other), 0) / width
    return np.minimum(one, other) - 0.25 * width * share**2


def _distance_knob(rho, y):
    """Signed distance to the knob's profile: foot, fillet, body with a groove, round top."""
    solid = _blend(_rounded_box(rho, y, 1.0, 0.4, 0.1), _rounded_box(rho, y, 0.68, 1.75, 0.3), 0.3)
    groove = np.hypot(rho - 0.72, y - 1.08) - 0.13
    return -_blend(-solid, groove, 0.06)


def _hit_knob(origin, ray):
    origin, ray = np.broadcast_arrays(origin, ray)
    far = np.full(len(ray), np.inf)
    to = origin - [0.0, 0.875, 0.0]
    along = np.sum(to * ray, axis=-1)
    depth = along**2 - np.sum(to * to, axis=-1) + 1.36**2
    rows = np.flatnonzero((depth > 0) & (-along + np.sqrt(np.maximum(depth, 0)) > NEAR))
    at = np.maximum(-along[rows] - np.sqrt(depth[rows]), NEAR)
    end = -along[rows] + np.sqrt(depth[rows])
    for _ in range(STEPS):
        points = origin[rows] + at[:, None] * ray[rows]
        apart = _distance_knob(np.hypot(points[:, 0], points[:, 2]), points[:, 1])
        met = apart < MET
        far[rows[met]] = at[met]
        go = ~met & (at + apart < end)
        rows, at, end = rows[go], (at + apart)[go], end[go]
        if not rows.size:
            break
    return far


def _in_cylinder(origin, ray, radius: float, top: float):
    """Whether rays pass an upright cylinder on the floor."""
    a = ray[:, 0] ** 2 + ray[:, 2] ** 2
    b = origin[:, 0] * ray[:, 0] + origin[:, 2] * ray[:, 2]
    depth = b**2 - a * (origin[:, 0] ** 2 + origin[:, 2] ** 2 - radius**2)
    root, a = np.sqrt(np.maximum(depth, 0)), np.maximum(a, 1e-12)
    rise = np.maximum(ray[:, 1], 1e-9)
    enter = np.maximum((-b - root) / a, 0)
    leave = np.minimum((-b + root) / a, (top - origin[:, 1]) / rise)
    return (depth > 0) & (leave > enter)


def _normal_knob(points):
    rho, step = np.hypot(points[:, 0], points[:, 2]), 1e-4
    out = _distance_knob(rho + step, points[:, 1]) - _distance_knob(rho - step, points[:, 1])
    up = _distance_knob(rho, points[:, 1] + step) - _distance_knob(rho, points[:, 1] - step)
    outward = points * [1.0, 0.0, 1.0] / np.maximum(rho, 1e-9)[:, None]
    normal = out[:, None] * outward + up[:, None] * UP
    normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    around = np.cross(np.broadcast_to(UP, outward.shape), outward)
    return normal, np.cross(around, normal)


HITS: dict[str, Callable] = {"sphere": _hit_sphere, "sheet": _hit_sheet, "disc": _hit_disc, "knob": _hit_knob}
NORMALS: dict[str, Callable] = {
    "sphere": _normal_sphere,
    "sheet": _normal_sheet,
    "disc": _normal_disc,
    "knob": _normal_knob,
}
SETS = {
    "pair": (Thing("sphere", -0.82, -0.25, 0.86), Thing("knob", 0.95, 0.15, 0.72)),
    "sphere": (Thing("sphere"),),
    "sheet": (Thing("sheet"),),
    "disc": (Thing("disc", size=1.1),),
    "knob": (Thing("knob", size=1.05),),
}
GRAINED_PAIR = (Thing("sphere", -0.85, -0.25, 0.8), Thing("disc", 0.9, 0.1, 0.8))
