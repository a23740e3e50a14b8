"""Where the lamp is, from the shading of a matt reference: and whether that shading is that of one lamp, told linearly.

A point lamp at L = e/κ (e a unit vector, κ = 1/distance) lights a matt unit sphere as

    P = S (c - κ)/(1 - 2 κ c + κ²)^(3/2),   c = n·e

with four unknowns: two of direction, κ and the strength S. A picture whose codes are not light shows P^g in its place.
"""

import numpy as np

from ..errors import InputError
from ..numerics.least_squares import minimise
from ..records import dataclass
from .solids import Points

DARKEST = 0.05  # of the brightest, below which the shading is not looked at
MOST_POINTS = 10_000
LEAST_POINTS = 50
FEW_POINTS = 1_500  # while the outline is sought
TRUSTED = 0.003  # of the shading: no real reference is matt to better (ours)
WORTH = 200.0  # as many independent values is the shading taken for, whose pixels err together (ours)
LIMB_PX = 0.15  # by so much the limb alone may mislead, where the light falls off toward it (ours)
NEAREST = 0.4  # κ: a lamp at 2.5 radii
GAMMAS = (0.2, 5.0)
FARTHEST = 1e3  # radii: a lamp beyond is as far away as this


@dataclass(frozen=True)
class Lamp:
    """A lamp that was found: its position [radii], how far the shading misses it, and the exponent of the shading."""

    position: np.ndarray
    strength: float
    rms: float  # of the shading, relative
    gamma: float
    bent_rms: float  # of the shading with that exponent
    doubt_deg: float  # of the direction
    doubt_distance: float  # relative

    @property
    def distance(self) -> float:
        return float(np.linalg.norm(self.position))


def phase_deg(position) -> float:
    """Angle lamp - sphere - camera [deg]."""
    position = np.asarray(position, float)
    return float(np.degrees(np.arctan2(np.hypot(position[0], position[1]), position[2])))


def position_of(phase: float, roll: float, distance: float) -> np.ndarray:
    """A lamp at a phase angle, turned about the camera's axis by `roll` from the right upward [deg, deg, radii]."""
    p, q = np.radians(phase), np.radians(roll)
    return distance * np.array([np.sin(p) * np.cos(q), np.sin(p) * np.sin(q), np.cos(p)])


def _straight(seen: Points, shading: np.ndarray, most: int):
    """Normals and relative shading of what is bright, the axes about the lamp, and the fit of (a, b, κ, S)."""
    top = np.quantile(shading, 0.999) if len(shading) else 0.0
    bright = np.flatnonzero((shading > DARKEST * top) & (shading > 0))
    if len(bright) < LEAST_POINTS:
        raise InputError(f"hardly any light on the reference ({len(bright)} pixels): its shading shows no lamp")
    bright = bright[:: max(1, len(bright) // most)]
    normal, value = seen.normal[bright], shading[bright] / top
    aim = np.linalg.lstsq(normal, value, rcond=None)[0]
    axes = _axes(aim)
    start = np.array([0.0, 0.0, 0.03, np.linalg.norm(aim)])
    return normal, value, axes, _fitted(normal, value, axes, start)


def shading_residuals(seen: Points, shading: np.ndarray) -> np.ndarray:
    """What the best lamp and exponent leave of a shading, in units in which `WORTH` of them count as independent."""
    normal, value, axes, straight = _straight(seen, shading, FEW_POINTS)
    fit = _fitted(normal, value, axes, np.r_[straight.shared, 1.0])
    left = fit.at_minimum[0][:, 0]
    return left / TRUSTED * np.sqrt(WORTH / len(left))


def find_lamp(seen: Points, shading: np.ndarray, most: int = MOST_POINTS) -> Lamp:
    """The lamp that shades a matt sphere or rod.

    Takes  points (n,), their shading (n,) in any unit, none of it clipped.    Gives  the lamp, with the exponent that
    the shading would rather have, which is 1 for light.    Raises InputError where hardly anything is lit.
    """
    normal, value, axes, straight = _straight(seen, shading, most)
    bent = _fitted(normal, value, axes, np.r_[straight.shared, 1.0])
    a, b, kappa, strength = straight.shared
    direction = _direction(axes, a, b)
    rms = float(np.sqrt(straight.cost / len(value)))
    variance = straight.cost / max(len(value) - 4, 1)
    spread = np.sqrt(np.maximum(variance * straight.normal.covariance()[0].diagonal(), 0))
    return Lamp(
        position=direction / max(kappa, 1 / FARTHEST),
        strength=float(strength),
        rms=rms,
        gamma=float(bent.shared[4]),
        bent_rms=float(np.sqrt(bent.cost / len(value))),
        doubt_deg=float(np.degrees(np.hypot(spread[0], spread[1]))),
        doubt_distance=float(spread[2] / max(kappa, 1e-9)),
    )


def _axes(aim) -> np.ndarray:
    """Rows: a unit vector along `aim` and two across it."""
    along = aim / np.linalg.norm(aim)
    across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    across /= np.linalg.norm(across)
    return np.stack([along, across, np.cross(along, across)])


def _direction(axes, a: float, b: float) -> np.ndarray:
    e = axes[0] + a * axes[1] + b * axes[2]
    return e / np.linalg.norm(e)


def _fitted(normal, value, axes, start):
    """Least squares over (a, b, κ, S) and, where `start` has five numbers, the exponent."""

    def residuals(shared, per_channel, slopes):
        a, b, kappa, strength = shared[:4]
        length = np.sqrt(1 + a * a + b * b)
        e = _direction(axes, a, b)
        c = normal @ e
        w = 1 - 2 * kappa * c + kappa**2
        lit = np.maximum(c - kappa, 1e-6)
        shade = lit / w**1.5
        g = shared[4] if len(shared) == 5 else 1.0
        power = shade**g
        r = (strength * power - value)[:, None]
        if not slopes:
            return r
        slope = strength * g * power / shade
        by_c = slope * (w**-1.5 + 3 * kappa * lit * w**-2.5)
        columns = [
            by_c * (normal @ (axes[1] - a / length * e)) / length,
            by_c * (normal @ (axes[2] - b / length * e)) / length,
            slope * (-(w**-1.5) + 3 * lit**2 * w**-2.5),
            power,
        ]
        if len(shared) == 5:
            columns.append(strength * power * np.log(shade))
        j = np.stack(columns, -1)[None]
        return r, j, np.zeros((1, len(value), 0))

    low = np.array([-2.0, -2.0, 0.0, 0.0, GAMMAS[0]])[: len(start)]
    high = np.array([2.0, 2.0, NEAREST, np.inf, GAMMAS[1]])[: len(start)]
    return minimise(residuals, start, low=low, high=high, tolerance=1e-7, most=25)
