"""Random directions on the sphere, with the densities they were drawn from.

Every draw takes uniform numbers in 0..1 and arrays of unit vectors (..., 3), so that who draws keeps the seed.
"""

from math import pi, sqrt

import numpy as np

GOLDEN_ANGLE = pi * (3 - sqrt(5))


def from_angles(cos_theta, phi) -> np.ndarray:
    """Unit vectors (..., 3) of a cosine from the z axis and an azimuth [rad]."""
    sin_theta = np.sqrt((1 - cos_theta) * (1 + cos_theta))
    return np.stack(np.broadcast_arrays(sin_theta * np.cos(phi), sin_theta * np.sin(phi), cos_theta), axis=-1)


def dot(a, b) -> np.ndarray:
    """Scalar products of vectors (..., 3), shape (...)."""
    return np.sum(a * b, axis=-1)


def unit(vectors) -> np.ndarray:
    """The same directions with length 1; a zero vector stays zero."""
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.where(length > 0, length, 1.0)


def tangents(normals) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors across each normal, continuous but at -z (Duff et al. 2017)."""
    x, y, z = np.moveaxis(normals, -1, 0)
    sign = np.where(z >= 0, 1.0, -1.0)
    a = -1 / (sign + z)
    b = x * y * a
    return np.stack([1 + sign * x * x * a, sign * b, -sign * x], axis=-1), np.stack([b, sign + y * y * a, -y], axis=-1)


def turned(normals, cos_theta, phi) -> np.ndarray:
    """Directions at an angle from `normals`, all round them."""
    x, y = tangents(normals)
    local = from_angles(cos_theta, phi)
    return local[..., :1] * x + local[..., 1:2] * y + local[..., 2:] * normals


def near(mean, width, u, v) -> np.ndarray:
    """Directions scattered about `mean`, rms `width` [rad] along each axis (von Mises and Fisher's distribution)."""
    below = -(width**2) * np.log(u + (1 - u) * np.exp(-2 / width**2))  # 1 - cosine
    return turned(mean, 1 - np.clip(below, 0.0, 2.0), 2 * pi * v)


def near_density(directions, mean, width) -> np.ndarray:
    """Density [1/sr] of `near`: exp(-chord²/(2 width²)) / (2π width² (1 - exp(-2/width²)))."""
    chord2 = np.sum((directions - mean) ** 2, axis=-1)
    return np.exp(-chord2 / (2 * width**2)) / (2 * pi * width**2 * -np.expm1(-2 / width**2))


def gaussian(offset, width) -> np.ndarray:
    """Density of a normal distribution."""
    return np.exp(-0.5 * (offset / width) ** 2) / (sqrt(2 * pi) * width)


def cap(axis, radius: float, count: int) -> np.ndarray:
    """(..., count, 3): points that share a cap of angular `radius` evenly, in a sunflower's pattern."""
    place = (np.arange(count) + 0.5) / count
    spiral = from_angles(1 - (1 - np.cos(radius)) * place, GOLDEN_ANGLE * np.arange(count))
    x, y = tangents(axis)
    return spiral[:, :1] * x[..., None, :] + spiral[:, 1:2] * y[..., None, :] + spiral[:, 2:] * axis[..., None, :]


def wrapped(angle) -> np.ndarray:
    """An angle [rad] between -π and π."""
    return np.remainder(angle + pi, 2 * pi) - pi
