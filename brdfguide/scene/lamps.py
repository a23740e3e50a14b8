"""Lamps of real size: the points of a disc that stand for it, as many as the lobe on it needs.

How much a law varies over a disc follows from the disc's radius over the scale on which the law varies there: its width
near the mirror direction, half the way to it elsewhere. A few points of a rule that is exact for polynomials are enough
while that ratio is small; beyond, the disc is integrated in polar coordinates about the mirror direction.
"""

from math import cos, pi

import numpy as np

from ..numerics import sphere

# radius over scale up to which a rule does
ONE_POINT, FOUR_POINTS, SEVEN_POINTS = 0.05, 0.5, 1.2
WIDE = 0.05  # radius [rad] from which even a flat law varies over the disc, by its cosine
AZIMUTHS, ALONG = 12, 8  # rays about the mirror direction, and points on each
EVEN_STEP = 0.7548776662466927  # 1/p of p³ = p + 1: its multiples fill an interval evenly
FLIP = np.array([-1.0, -1.0, 1.0])  # a direction to its mirror direction


def lit_points(to_light, to_camera, radius: float, width: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points of the disc as each pixel sees it: directions (rows, 3), shares of its light, and the pixel of each row.

    Takes  to_light, to_camera (pixels, 3) in the frame of the surface; the disc's angular radius and the lobe's width
    [rad].    Gives  rows in which Σ share f cos θi is the mean of f cos θi over the disc; none below the horizon.
    """
    image = to_camera * FLIP
    # from the mirror direction to the rim of the disc
    gap = np.maximum(2 * np.arcsin(np.clip(np.linalg.norm(image - to_light, axis=1) / 2, 0, 1)) - radius, 0.0)
    ratio = radius / np.maximum(width, gap / 2)
    rule = np.searchsorted([ONE_POINT, FOUR_POINTS, SEVEN_POINTS], ratio)
    rule = np.maximum(rule, int(radius > WIDE))
    rule = np.where(np.abs(to_light[:, 2]) < np.sin(radius), len(_RULES), rule)  # cut by the horizon
    parts = []
    for which in range(len(_RULES) + 1):
        pixel = np.flatnonzero(rule == which)
        if not len(pixel):
            continue
        if which < len(_RULES):
            area, azimuth, share = _RULES[which]
            directions = _on_disc(to_light[pixel], radius, area, azimuth)
            shares = np.broadcast_to(share, directions.shape[:2])
        else:
            directions, shares = _about_the_mirror_direction(to_light[pixel], image[pixel], radius, width, pixel)
        parts.append((directions.reshape(-1, 3), shares.ravel(), np.repeat(pixel, directions.shape[1])))
    directions, shares, pixel = (np.concatenate(each) for each in zip(*parts, strict=True))
    above = (directions[:, 2] > 0) & (shares > 0)
    return directions[above], shares[above], pixel[above]


def _about_the_mirror_direction(to_light, image, radius: float, width: float, pixel):
    """Points of the disc in polar coordinates about the mirror direction, (pixels, points, 3), with their shares.

    A ray of azimuth φ lies in the disc between two angles ρ from the mirror direction,
    cos d cos ρ + sin d cos φ sin ρ = cos(radius), with d from there to the disc's middle. On it Gauss's points stand in
    the mean of two distributions of R = 1 - cos ρ: evenly over the disc, and as 1/(1 + R/W)², as a lobe falls.
    """
    cos_d = np.clip(np.sum(to_light * image, axis=1), -1.0, 1.0)[:, None]
    sin_d = np.linalg.norm(np.cross(to_light, image), axis=1)[:, None]
    phi, of_phi = _azimuths(cos_d, sin_d, radius, pixel)
    middle = np.arctan2(sin_d * np.cos(phi), cos_d)
    half = np.arccos(np.clip(cos(radius) / np.maximum(np.hypot(sin_d * np.cos(phi), cos_d), 1e-12), -1.0, 1.0))
    first = (1 - np.cos(np.maximum(middle - half, 0.0)))[..., None]
    span = np.maximum((1 - np.cos(np.minimum(middle + half, pi)))[..., None] - first, 0.0)
    near = first + 1 - cos(width)  # R + W at the nearer end
    b = 2 * near + span - 2 * _ALONG * span
    x = 4 * _ALONG * near / (b + np.sqrt(b * b + 8 * _ALONG * near * span))  # place on the ray, 0 to 1 in R
    density = 0.5 + 0.5 * near * (near + span) / (near + span * x) ** 2  # of the points, over dx
    share = of_phi[..., None] * _ALONG_SHARE * span / density / (2 * pi * (1 - cos(radius)))
    toward = sphere.unit(to_light - cos_d * image)
    toward = np.where(sin_d > 1e-9, toward, sphere.tangents(image)[0])
    across = np.cross(image, toward)
    local = sphere.from_angles(1 - np.clip(first + span * x, 0.0, 2.0), phi[..., None])
    place = (slice(None), None, None)
    points = local[..., :1] * toward[place] + local[..., 1:2] * across[place] + local[..., 2:] * image[place]
    return points.reshape(len(pixel), -1, 3), share.reshape(len(pixel), -1)


def _azimuths(cos_d, sin_d, radius: float, pixel):
    """Azimuths (pixels, AZIMUTHS) about the mirror direction, 0 toward the disc's middle, and what each stands for: all
    around where that direction is within the disc, Chebyshev's points between the two that touch it elsewhere."""
    step = (np.arange(AZIMUTHS) + 0.5) * pi / AZIMUTHS
    # each pixel turns its points, so that their errors average out over the picture
    turned = 2 * step + np.remainder((pixel[:, None] + 1) * EVEN_STEP, 1.0) * 2 * pi / AZIMUTHS
    widest = np.arcsin(np.minimum(np.sin(radius) / np.maximum(sin_d, 1e-12), 1.0))
    inside = cos_d >= cos(radius)
    phi = np.where(inside, turned, widest * np.cos(step))
    return phi, np.where(inside, 2 * pi / AZIMUTHS, widest * np.sin(step) * pi / AZIMUTHS)


def _on_disc(axis, radius: float, area, azimuth) -> np.ndarray:
    """(pixels, points, 3): points at a share of the disc's `area` from its middle."""
    x, y = sphere.tangents(axis)
    local = sphere.from_angles(1 - (1 - cos(radius)) * area, azimuth)
    return local[:, :1] * x[..., None, :] + local[:, 1:2] * y[..., None, :] + local[:, 2:] * axis[..., None, :]


def _even_ring(count: int, turn: float = 0.0) -> np.ndarray:
    return (np.arange(count) + turn) * 2 * pi / count


# square of the radius, azimuth and weight of the points of rules of degree 1, 3 and 5 on a disc (Stroud 1971)
_RULES = (
    (np.zeros(1), np.zeros(1), np.ones(1)),
    (np.full(4, 0.5), _even_ring(4), np.full(4, 0.25)),
    (np.array([0.0, *[2 / 3] * 6]), np.array([0.0, *_even_ring(6)]), np.array([0.25, *[0.125] * 6])),
)
_ALONG, _ALONG_SHARE = (0.5 * each for each in np.polynomial.legendre.leggauss(ALONG))
_ALONG = _ALONG + 0.5
