"""What a camera's pixel sees of a sphere, a rod or a plate: the point, its normal, and where the camera is.

A sphere of radius 1 lies at the origin, the camera at c = (0, 0, D), z toward it, x to the right, y up in the picture:

    ray d of a pixel;   b = d·c;   t = -b - √(b² - D² + 1);   n = c + t d;   r = -d;   i = (L - n)/|L - n|
    radius of the outline [px] = focal length [px] · tan(asin(1/D))

so that with the outline known the focal length is not needed. A rod of radius 1 along y is the same with the ray's and
the camera's y left out of the quadratic. Lengths are in radii.
"""

import numpy as np

from ..physics.directions import Directions
from ..records import dataclass

FAR = np.inf


@dataclass(frozen=True)
class Pinhole:
    """Where the solid stands in the picture, and how far the camera is from it."""

    centre_px: tuple[float, float]  # x to the right, y down, from the picture's upper left corner
    radius_px: float
    distance: float  # [radii]; FAR for a camera without perspective

    @property
    def camera(self) -> np.ndarray:
        return np.array([0.0, 0.0, self.distance])

    def rays(self, x_px, y_px) -> tuple[np.ndarray, np.ndarray]:
        """Origins and unit directions (..., 3) of the rays of pixels."""
        x = (np.asarray(x_px, float) - self.centre_px[0]) / self.radius_px
        y = (self.centre_px[1] - np.asarray(y_px, float)) / self.radius_px
        x, y = np.broadcast_arrays(x, y)
        if not np.isfinite(self.distance):
            along = np.broadcast_to([0.0, 0.0, -1.0], (*x.shape, 3))
            return np.stack([x, y, np.full(x.shape, 2.0)], -1), along
        slope = 1 / np.sqrt(self.distance**2 - 1)  # tan(asin(1/D))
        along = np.stack([x * slope, y * slope, np.full(x.shape, -1.0)], -1)
        along /= np.linalg.norm(along, axis=-1, keepdims=True)
        return np.broadcast_to(self.camera, along.shape), along

    def pixels(self, at) -> tuple[np.ndarray, np.ndarray]:
        """x and y [px] of points (..., 3)."""
        nearer = 1.0
        if np.isfinite(self.distance):
            nearer = np.sqrt(self.distance**2 - 1) / (self.distance - at[..., 2])
        x = self.centre_px[0] + self.radius_px * nearer * at[..., 0]
        return x, self.centre_px[1] - self.radius_px * nearer * at[..., 1]


@dataclass(frozen=True, eq=False)
class Points:
    """Points of a surface (..., 3) with their normals and the directions toward the camera; NaN where it misses."""

    at: np.ndarray
    normal: np.ndarray
    toward: np.ndarray

    def __getitem__(self, which) -> "Points":
        return Points(self.at[which], self.normal[which], self.toward[which])

    @property
    def cos_r(self) -> np.ndarray:
        return np.einsum("...k,...k", self.normal, self.toward)

    def toward_lamp(self, lamp) -> np.ndarray:
        """Unit vectors to a lamp at a position, or far away in a direction (where it is longer than 1e6)."""
        away = np.asarray(lamp, float) - self.at
        return away / np.linalg.norm(away, axis=-1, keepdims=True)

    def irradiance(self, lamp) -> np.ndarray:
        """cos θi |L|²/|L - n|²: that of a point lamp in units of what it gives at the origin."""
        away = np.asarray(lamp, float) - self.at
        squared = np.einsum("...k,...k", away, away)
        cosine = np.einsum("...k,...k", self.normal, away) / np.sqrt(squared)
        return np.maximum(cosine, 0.0) * np.dot(lamp, lamp) / squared

    def directions(self, lamp) -> Directions:
        """Directions of lamp and camera in the frame of each point, as columns of the same shape."""
        return Directions.from_vectors(
            _in_frame(self.normal, self.toward_lamp(lamp)), _in_frame(self.normal, self.toward)
        )


def plate_points(distance: float, angle_deg: float, width: float, size, x_px, y_px) -> Points:
    """What pixels see of a plate in the plane z = 0, x to the right, y away from the camera, lengths in one unit.

    The camera stands at `distance` from the plate's middle, `angle_deg` off its normal, and looks at the middle, which
    is the picture's; what it shows across there is `width`, of a picture of `size` (columns, rows).
    """
    angle = np.radians(angle_deg)
    camera = distance * np.array([0.0, -np.sin(angle), np.cos(angle)])
    up = np.array([0.0, np.cos(angle), np.sin(angle)])
    pixel = width / size[0]
    x, y = np.broadcast_arrays((np.asarray(x_px) - size[0] / 2) * pixel, (size[1] / 2 - np.asarray(y_px)) * pixel)
    along = x[..., None] * np.array([1.0, 0.0, 0.0]) + y[..., None] * up - camera
    along = along / np.linalg.norm(along, axis=-1, keepdims=True)
    with np.errstate(divide="ignore", invalid="ignore"):
        far = np.where(along[..., 2] < 0, -camera[2] / along[..., 2], np.nan)
    at = camera + far[..., None] * along
    return Points(at, np.broadcast_to([0.0, 0.0, 1.0], at.shape), -along)


def points(solid: str, view: Pinhole, x_px, y_px) -> Points:
    """What pixels see of a unit "sphere", or of a "cylinder" along y."""
    origin, along = view.rays(x_px, y_px)
    keep = np.array([1.0, float(solid == "sphere"), 1.0])
    o, d = origin * keep, along * keep
    a = np.einsum("...k,...k", d, d)
    b = np.einsum("...k,...k", d, o)
    c = np.einsum("...k,...k", o, o) - 1
    with np.errstate(invalid="ignore"):
        root = np.sqrt(b * b - a * c)
    at = origin + ((-b - root) / a)[..., None] * along
    return Points(at, at * keep, np.where(np.isnan(root)[..., None], np.nan, -along))


def _in_frame(normal, vector) -> np.ndarray:
    """A vector in a frame whose third axis is the normal.

    Source: Duff et al. 2017, "Building an orthonormal basis, revisited", JCGT 6(1).
    """
    x, y, z = np.moveaxis(normal, -1, 0)
    sign = np.copysign(1.0, z)
    a = -1 / (sign + z)
    b = x * y * a
    first = np.stack([1 + sign * x * x * a, sign * b, -sign * x], -1)
    second = np.stack([b, sign + y * y * a, -y], -1)
    return np.stack([np.einsum("...k,...k", axis, vector) for axis in (first, second, normal)], -1)
