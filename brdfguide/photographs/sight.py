"""One shot, pixel by pixel: the values f = (albedo/π) P/P_ref, and which pixels are used."""

import numpy as np

from ..records import dataclass
from .solids import Points

DARK_REFERENCE = 0.02  # of its greatest value, below which the quotient is noise
RIM_PX = 2.0  # pixels at the outline that are left out
NEAR_WHITE = 0.98
HOT_MAD = 8.0  # times the median deviation in 3 x 3, beyond which a pixel is hot
HOT_DEG = 5.0  # θh within which a bright pixel may be the highlight (ours)
STANDS_OUT = 1.3  # times its neighbours, below which nothing is looked at (ours)


@dataclass(frozen=True, eq=False)
class Sight:
    """A shot on a grid of pixels (rows, columns): what light came, what of it is used, and what it says."""

    label: str
    light: np.ndarray  # (rows, columns, 3) of the sample
    reference: np.ndarray | None  # of the reference
    unit: np.ndarray  # (rows, columns, 3): light of a BRDF of 1/sr
    points: Points  # (rows, columns)
    lamp: np.ndarray
    clipped: np.ndarray  # (rows, columns)
    hot: int
    missing: int  # pixels without a finite, positive code
    used: np.ndarray  # (rows, columns)
    dimmest: float  # light that is too dim for the file's codes

    @property
    def f(self) -> np.ndarray:
        """BRDF [1/sr] of the used pixels, (used, 3); NaN where the codes are too coarse."""
        light = self.light[self.used].astype(float)
        return np.where(light >= self.dimmest, light, np.nan) / self.unit[self.used]


def sight(label, light, reference, unit, points, rim, lamp, clipped, theta_max_deg, dimmest) -> Sight:
    """A shot with its used pixels chosen; `rim` (rows, columns) is the distance inside the outline [pixels]."""
    least = np.cos(np.radians(theta_max_deg))
    with np.errstate(invalid="ignore"):
        cos_i = np.einsum("...k,...k", points.normal, points.toward_lamp(lamp))
        facing = (points.cos_r > least) & (cos_i > least) & (rim > RIM_PX)
    sound = np.all(np.isfinite(light), axis=-1) & np.all(light >= 0, axis=-1)
    if reference is not None:
        sound &= np.all(np.isfinite(reference), axis=-1)
        dim = np.zeros(facing.shape, bool)
        for channel in range(3):
            values = reference[..., channel]
            top = np.max(values[facing & sound], initial=0.0)
            dim |= ~(values > DARK_REFERENCE * top)
        used = facing & sound & ~dim
    else:
        used = facing & sound
    used &= ~dilated(clipped)
    hot = _hot(light, used, points, lamp)
    return Sight(
        label=label,
        light=light,
        reference=reference,
        unit=unit,
        points=points,
        lamp=np.asarray(lamp, float),
        clipped=clipped & facing,
        hot=int(np.count_nonzero(hot)),
        missing=int(np.count_nonzero(facing & ~sound)),
        used=used & ~hot,
        dimmest=dimmest,
    )


def dilated(mask: np.ndarray) -> np.ndarray:
    """A mask and the pixels that touch it: lenses and JPEG carry a clipped pixel's light there."""
    wide = np.pad(mask, 1)
    out = np.zeros_like(mask)
    for row in range(3):
        for column in range(3):
            out |= wide[row : row + mask.shape[0], column : column + mask.shape[1]]
    return out


def _hot(light, used, points: Points, lamp) -> np.ndarray:
    """Pixels more than 8 median deviations from the median of their 3 x 3, away from the highlight."""
    grey = light.mean(-1)
    inner = grey[1:-1, 1:-1]
    around = np.maximum.reduce([grey[:-2, 1:-1], grey[2:, 1:-1], grey[1:-1, :-2], grey[1:-1, 2:]])
    with np.errstate(invalid="ignore"):
        y, x = np.nonzero((inner > STANDS_OUT * around) & used[1:-1, 1:-1])
    hot = np.zeros(used.shape, bool)
    if not len(y):
        return hot
    block = np.stack([grey[y + dy, x + dx] for dy in range(3) for dx in range(3)], -1)
    median = np.median(block, axis=-1)
    spread = 1.4826 * np.median(np.abs(block - median[:, None]), axis=-1)
    some = points[y + 1, x + 1]
    half = some.toward_lamp(lamp) + some.toward
    cosine = np.einsum("...k,...k", half, some.normal) / np.linalg.norm(half, axis=-1)
    lone = (grey[y + 1, x + 1] - median > HOT_MAD * spread) & (cosine < np.cos(np.radians(HOT_DEG)))
    hot[y[lone] + 1, x[lone] + 1] = True
    return hot


def sparkle(seen: Sight) -> float:
    """Relative scatter of neighbouring used pixels, median over the surface: noise, or flakes."""
    grey = np.full(seen.used.shape, np.nan)
    grey[seen.used] = seen.f.mean(-1)
    left, right = grey[:, :-2:2], grey[:, 2::2]
    middle = grey[:, 1:-1:2]
    columns = min(left.shape[1], right.shape[1], middle.shape[1])
    left, right, middle = left[:, :columns], right[:, :columns], middle[:, :columns]
    with np.errstate(invalid="ignore"):
        bend = np.abs(middle - 0.5 * (left + right)) / np.abs(middle)  # a slope drops out
    bend = bend[np.isfinite(bend)]
    return float(np.median(bend) * 1.4826 / np.sqrt(1.5)) if bend.size else 0.0
