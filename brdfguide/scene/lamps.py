"""Lamps of real size: the points of a disc that stand for it, as many as the lobe on it needs.

How much a law varies over a disc follows from the disc's radius over the scale on which the law varies there: its width
near the mirror direction, half the way to it elsewhere. A few points of a rule that is exact for polynomials are enough
while that ratio is small; beyond, points of the disc and points of the lobe share the work, each weighed by all the
densities it could have come from (balance heuristic, Veach and Guibas 1995).
"""

from math import cos, pi, sqrt

import numpy as np

from ..numerics import sphere

# radius over scale up to which a rule does
ONE_POINT, FOUR_POINTS, SEVEN_POINTS, TWELVE_POINTS = 0.05, 0.5, 1.2, 2.5
WIDE = 0.05  # radius [rad] from which even a flat law varies over the disc, by its cosine
DISC_POINTS, LOBE_POINTS, TAIL_POINTS = 24, 16, 12  # where points of the disc and of the lobe share the work
TAIL = 4.0  # width of the tail's points over that of the lobe's
# 1/p and 1/p² of p³ = p + 1: points that fill the square evenly
EVEN_STEPS = np.array([0.7548776662466927, 0.5698402909980532])
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
    rule = np.searchsorted([ONE_POINT, FOUR_POINTS, SEVEN_POINTS, TWELVE_POINTS], ratio)
    rule = np.maximum(rule, int(radius > WIDE))
    rule = np.where(np.abs(to_light[:, 2]) < np.sin(radius), 4, rule)  # cut by the horizon
    parts = []
    for which in range(5):
        pixel = np.flatnonzero(rule == which)
        if not len(pixel):
            continue
        if which < 4:
            area, azimuth, share = _RULES[which]
            directions = _on_disc(to_light[pixel], radius, area, azimuth)
            shares = np.broadcast_to(share, directions.shape[:2])
        else:
            directions, shares = _shared(to_light[pixel], image[pixel], radius, np.maximum(width, gap[pixel]), pixel)
        parts.append((directions.reshape(-1, 3), shares.ravel(), np.repeat(pixel, directions.shape[1])))
    directions, shares, pixel = (np.concatenate(each) for each in zip(*parts, strict=True))
    above = (directions[:, 2] > 0) & (shares > 0)
    return directions[above], shares[above], pixel[above]


def _shared(to_light, image, radius: float, width, pixel):
    """Points of the disc, of the lobe and of its tail, (pixels, points, 3), with their shares."""
    width = width[:, None]
    steps = np.arange(LOBE_POINTS + TAIL_POINTS)[:, None] * EVEN_STEPS
    # each pixel shifts its points, so that their errors average out over the picture
    u, v = np.moveaxis(np.remainder(steps + ((pixel[:, None] + 1) * EVEN_STEPS)[:, None], 1.0), 2, 0)
    mean = np.broadcast_to(image[:, None], (*v.shape, 3))
    count = np.array([DISC_POINTS, LOBE_POINTS, TAIL_POINTS])
    directions = np.concatenate(
        [
            sphere.cap(to_light, radius, DISC_POINTS),
            sphere.near(mean[:, :LOBE_POINTS], width, u[:, :LOBE_POINTS], v[:, :LOBE_POINTS]),
            sphere.near(mean[:, LOBE_POINTS:], TAIL * width, u[:, LOBE_POINTS:], v[:, LOBE_POINTS:]),
        ],
        axis=1,
    )
    inside = np.sum((directions - to_light[:, None]) ** 2, axis=2) <= (2 * np.sin(radius / 2)) ** 2 * (1 + 1e-9)
    even = 1 / (2 * pi * (1 - cos(radius)))
    lobe, tail = (sphere.near_density(directions, image[:, None], factor * width) for factor in (1.0, TAIL))
    return directions, np.where(inside, even / (count[0] * even + count[1] * lobe + count[2] * tail), 0.0)


def _on_disc(axis, radius: float, area, azimuth) -> np.ndarray:
    """(pixels, points, 3): points at a share of the disc's `area` from its middle."""
    x, y = sphere.tangents(axis)
    local = sphere.from_angles(1 - (1 - cos(radius)) * area, azimuth)
    return local[:, :1] * x[..., None, :] + local[:, 1:2] * y[..., None, :] + local[:, 2:] * axis[..., None, :]


def _even_ring(count: int, turn: float = 0.0) -> np.ndarray:
    return (np.arange(count) + turn) * 2 * pi / count


def _twelve_points():
    """Degree 7: 4 points on the axes and 8 on the diagonals (Stroud 1971, S2 7-1)."""
    root = sqrt(29)
    area = np.repeat([0.75, 2 * (27 - 3 * root) / 104, 2 * (27 + 3 * root) / 104], 4)
    share = np.repeat([2 / 27, (551 + 41 * root) / 6264, (551 - 41 * root) / 6264], 4)
    return area, np.concatenate([_even_ring(4), _even_ring(4, 0.5), _even_ring(4, 0.5)]), share


# square of the radius, azimuth and weight of the points of rules of degree 1, 3, 5 and 7 on a disc (Stroud 1971)
_RULES = (
    (np.zeros(1), np.zeros(1), np.ones(1)),
    (np.full(4, 0.5), _even_ring(4), np.full(4, 0.25)),
    (np.array([0.0, *[2 / 3] * 6]), np.array([0.0, *_even_ring(6)]), np.array([0.25, *[0.125] * 6])),
    _twelve_points(),
)
