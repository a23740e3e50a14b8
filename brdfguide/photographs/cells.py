"""Hundreds of thousands of pixels gathered into hundreds of values, evenly over the lobe."""

import numpy as np

from ..records import dataclass
from .solids import Points

THETA_H_DEG = (0.25, 80.0)  # between which ln tan θh is cut
STEPS = 40
AZIMUTHS = 24  # about the mirror normal
VARIES = 0.25  # of θh, beyond which a mean over a cell would be one over the lobe's flank
LEAST_ERROR = 0.005  # no camera's pixel is known better (ours)
BLOCKS = 6  # of a plate's pixels, along each side
FITTED = 12  # pixels from which the surface's course inside a cell is fitted
STEEP = 1.0  # scatter of ln f about that course, beyond which there is more noise than signal (ours)
STANDS_OUT = 2.0  # times the body, from which a highlight has a width (ours)


@dataclass(frozen=True, eq=False)
class Cells:
    """Values f (cells, 3) [1/sr] at points of the surface, with standard errors, how many pixels made each, and into
    which each pixel went."""

    points: Points
    f: np.ndarray
    stderr: np.ndarray
    count: np.ndarray
    of_pixel: np.ndarray


@dataclass(frozen=True, eq=False)
class Tilts:
    """How far normals (n,) lean from the half vector [rad], in which direction about the mirror normal, and the half
    vectors (n, 3)."""

    theta: np.ndarray
    azimuth: np.ndarray
    half: np.ndarray
    axes: np.ndarray  # (2, 3) across the mirror normal, from which the azimuth counts


def tilts(seen: Points, lamp) -> Tilts:
    """θh and azimuth of points (n,) lit by a lamp."""
    half = _unit(seen.toward_lamp(lamp) + seen.toward)
    mirror = _unit(half.mean(axis=0))
    first = _unit(np.cross(mirror, [0.0, 1.0, 0.0] if abs(mirror[1]) < 0.9 else [1.0, 0.0, 0.0]))
    axes = np.stack([first, np.cross(mirror, first)])
    across = seen.normal - half
    theta = 2 * np.arcsin(np.minimum(np.linalg.norm(across, axis=-1) / 2, 1.0))
    return Tilts(theta, np.arctan2(across @ axes[1], across @ axes[0]), half, axes)


def gather(seen: Points, f: np.ndarray, lamp) -> Cells:
    """Cells in ln tan θh and azimuth.

    Takes  points (n,), f (n, 3), NaN where there is none.    Gives  Cells, one for each part that a pixel fell into:
    the value at the mean of its pixels' θh and azimuth, or that of the pixel nearest to it where θh varies by more than
    a quarter inside.
    """
    lean = tilts(seen, lamp)
    height = np.log(np.tan(np.maximum(lean.theta, 1e-6)))
    low, high = np.log(np.tan(np.radians(THETA_H_DEG)))
    row = np.clip((height - low) // ((high - low) / STEPS), 0, STEPS - 1).astype(int)
    column = np.clip((lean.azimuth + np.pi) // (2 * np.pi / AZIMUTHS), 0, AZIMUTHS - 1).astype(int)
    _, cell, count = np.unique(row * AZIMUTHS + column, return_inverse=True, return_counts=True)
    least, most = np.full(len(count), np.inf), np.zeros(len(count))
    np.minimum.at(least, cell, lean.theta)
    np.maximum.at(most, cell, lean.theta)
    x, y = (_mean(each, cell, count)[:, 0] for each in (height, lean.azimuth))
    wide = most - least > VARIES * np.exp(x)
    nearest = _nearest(cell, np.hypot(height - x[cell], lean.azimuth - y[cell]))
    value, error = _averages(f, cell, count, height - x[cell], lean.azimuth - y[cell])
    middle = _middle(seen, lean, cell, count, np.arctan(np.exp(x)), y)
    points = Points(
        *(np.where(wide[:, None], getattr(seen, name)[nearest], getattr(middle, name)) for name in vars(middle))
    )
    value = np.where(wide[:, None], f[nearest], value)
    return Cells(points, value, np.maximum(error, LEAST_ERROR) * np.abs(value), count, cell)


def gather_blocks(seen: Points, f: np.ndarray, used: np.ndarray) -> Cells:
    """Means over blocks of a plate's pixels, six by six at most: over it the angles change slowly.

    Takes  points (rows, columns), f (used, 3), `used` (rows, columns).
    """
    rows, columns = used.shape
    row, column = np.nonzero(used)
    number = (row * min(BLOCKS, rows) // rows) * BLOCKS + column * min(BLOCKS, columns) // columns
    _, cell, count = np.unique(number, return_inverse=True, return_counts=True)
    some = seen[used]
    value = _mean(f, cell, count)
    spread = np.sqrt(_mean((f - value[cell]) ** 2, cell, count) / np.maximum(count - 1, 1)[:, None])
    points = Points(
        _mean(some.at, cell, count), _unit(_mean(some.normal, cell, count)), _unit(_mean(some.toward, cell, count))
    )
    return Cells(points, value, np.maximum(spread, LEAST_ERROR * np.abs(value)), count, cell)


def _mean(values, cell, count) -> np.ndarray:
    """(cells, k) of values (n,) or (n, k)."""
    columns = np.reshape(values, (len(cell), -1)).T
    return np.stack([np.bincount(cell, each, minlength=len(count)) for each in columns], -1) / count[:, None]


def _middle(seen: Points, lean: Tilts, cell, count, theta, azimuth) -> Points:
    """The point of each cell at a θh and azimuth: the mean of normals along a ring would lie inside the ring."""
    half = _unit(_mean(lean.half, cell, count))
    along = np.cos(azimuth)[:, None] * lean.axes[0] + np.sin(azimuth)[:, None] * lean.axes[1]
    along = _unit(along - np.einsum("ck,ck->c", along, half)[:, None] * half)
    normal = np.cos(theta)[:, None] * half + np.sin(theta)[:, None] * along
    return Points(_mean(seen.at, cell, count), normal, _unit(_mean(seen.toward, cell, count)))


def _averages(f, cell, count, x, y) -> tuple[np.ndarray, np.ndarray]:
    """Value (cells, 3) at x = y = 0, and its relative standard error.

    ln f = a + b x + c x² + d y inside a cell, by least squares, since f falls off there like a power or an exponential;
    a plain mean where pixels are few or scatter about this by more than themselves.
    """
    plain = _mean(f, cell, count)
    spread = np.sqrt(_mean((f - plain[cell]) ** 2, cell, count) * (count / np.maximum(count - 1, 1))[:, None])
    with np.errstate(divide="ignore", invalid="ignore"):
        positive = _mean(f > 0, cell, count) == 1
        scatter = np.where((count > 1)[:, None], spread / np.abs(plain), 1.0)
        ln = np.log(np.where(f > 0, f, 1.0))
    design = np.stack([np.ones(len(x)), x, x * x, y], -1)
    normal = _mean(design[:, :, None] * design[:, None, :], cell, count).reshape(-1, 4, 4)
    scale = np.sqrt(np.einsum("cpp->cp", normal)) + 1e-12
    normal = normal / (scale[:, :, None] * scale[:, None, :]) + 1e-9 * np.eye(4)
    right = np.stack([_mean(design * each[:, None], cell, count) for each in ln.T], -1) / scale[:, :, None]
    course = np.linalg.solve(normal, right) / scale[:, :, None]
    left = ln - np.einsum("np,npc->nc", design, course[cell])
    about = np.sqrt(_mean(left**2, cell, count) * (count / np.maximum(count - 4, 1))[:, None])
    fitted = positive & (count >= FITTED)[:, None] & (about < STEEP)
    value = np.where(fitted, np.exp(np.where(fitted, course[:, 0], 0.0)), plain)
    return value, np.where(fitted, about, scatter) / np.sqrt(count)[:, None]


def _nearest(cell, distance) -> np.ndarray:
    """For each cell its pixel of least distance."""
    order = np.lexsort((distance, cell))
    return order[np.r_[True, np.diff(cell[order]) > 0]]


def _unit(vectors) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def highlight_alpha(cells: Cells, lamp) -> float | None:
    """Roughness alpha of the highlight from its half width, as of a GGX lobe; None where no highlight stands out.

    The half width at half height in θh is alpha √(√2 - 1).
    """
    level = cells.f.mean(-1)
    order = np.argsort(tilts(cells.points, lamp).theta)
    order = order[level[order] > 0]
    if len(order) < STEPS:
        return None
    theta, level = tilts(cells.points, lamp).theta[order], level[order]
    body, top = float(np.quantile(level, 0.25)), float(np.median(level[: max(len(level) // 40, 3)]))
    if top < STANDS_OUT * body:
        return None
    below = np.flatnonzero(np.cumsum(level < body + 0.5 * (top - body)) >= 3)
    return float(np.tan(theta[below[0]]) / np.sqrt(np.sqrt(2) - 1)) if len(below) else None
