"""Where a lit ball stands in a picture: a circle through its lit limb.

Half of the limb is lit, whatever the lamp's direction; the shadow's edge on the other side is half an ellipse, and no
circle. So the circle is sought that most of the boundary lies on, and then moved to where the light falls most steeply.
"""

import numpy as np

from ..errors import InputError
from ..records import dataclass
from .picture import Photograph

COARSE = 400  # pixels across the picture in which the ball is sought
LIT = 0.08  # of the bright level, above which a pixel belongs to something lit (ours)
TRIALS = 600  # circles through three boundary points that are tried
SPOKES = 720  # along which the limb is sought
SHARP_PX = 250.0  # radius of a ball up to which a pixel is the unit; on a larger one the limb is softer (ours)
REACH = 4.0  # units on either side of it
STEPS = 8  # to a unit
LEAST_FALL = 0.7  # of the light inside must end at the limb, or it is the shadow's edge (ours)
LEAST_SPOKES = 40


@dataclass(frozen=True)
class Outline:
    """A circle [px], x to the right and y down from the picture's corner; how far the limb scatters about it."""

    x: float
    y: float
    radius: float
    rms_px: float = 0.0

    @property
    def centre(self) -> tuple[float, float]:
        return self.x, self.y

    def off_px(self, limb: np.ndarray) -> float:
        """How far a limb (spokes, 2) lies off it: median over the spokes."""
        return float(np.median(np.abs(np.hypot(limb[:, 0] - self.x, limb[:, 1] - self.y) - self.radius)))


def find_outline(picture: Photograph) -> tuple[Outline, np.ndarray]:
    """The ball's outline, and the points of the limb (spokes, 2) that show it.

    Raises InputError where no ball stands out from a dark background.
    """
    circle = _coarse(picture)
    for _ in range(3):
        limb = limb_near(picture, circle)
        if len(limb) < LEAST_SPOKES:
            raise _not_found(picture)
        circle, limb = through(limb)
    if circle.rms_px > 0.02 * circle.radius + 0.5:
        raise _not_found(picture)
    return circle, limb


def _not_found(picture: Photograph) -> InputError:
    return InputError(
        f"{picture.name}: no ball stands out from a dark background; "
        f"wanted outline: {{centre_px: [x, y], radius_px: r}} in the description"
    )


def through(limb: np.ndarray) -> tuple[Outline, np.ndarray]:
    """The circle through points (points, 2) by least distance, and the points without those that stand far off it."""
    for _ in range(4):
        x, y = limb.T
        design = np.stack([x, y, np.ones(len(x))], 1)  # x² + y² = 2 a x + 2 b y + c
        a, b, c = np.linalg.lstsq(design, x * x + y * y, rcond=None)[0]
        centre = np.array([a / 2, b / 2])
        radius = np.sqrt(max(c + centre @ centre, 0.0))
        off = np.hypot(*(limb - centre).T) - radius
        spread = 1.4826 * np.median(np.abs(off - np.median(off)))
        keep = np.abs(off - np.median(off)) <= max(3 * spread, 0.05)
        if keep.all() or np.count_nonzero(keep) < LEAST_SPOKES:
            break
        limb = limb[keep]
    return Outline(float(centre[0]), float(centre[1]), float(radius), float(np.sqrt(np.mean(off**2)))), limb


def _coarse(picture: Photograph) -> Outline:
    """The circle that most of the boundary of what is lit lies on, to a pixel of a small copy."""
    columns, rows = picture.size
    stride = max(1, max(columns, rows) // COARSE)
    grey = np.nan_to_num(picture.light(slice(None, None, stride), slice(None, None, stride)).mean(-1), posinf=0.0)
    level = float(np.quantile(grey, 0.999))
    lit = np.pad(grey > LIT * level, 1)
    inner = lit[1:-1, 1:-1] & lit[:-2, 1:-1] & lit[2:, 1:-1] & lit[1:-1, :-2] & lit[1:-1, 2:]
    lit = lit[1:-1, 1:-1]
    y, x = np.nonzero(lit & ~inner)
    if level <= 0 or len(x) < 20:
        raise _not_found(picture)
    edge = np.stack([x, y], 1).astype(float)
    draw = np.random.default_rng(0).integers(len(edge), size=(TRIALS, 3))
    centres, radii = _circles(edge[draw])
    off = np.abs(np.hypot(*(edge[:, None] - centres).transpose(2, 0, 1)) - radii)
    inside = (radii > 8) & (radii < max(grey.shape)) & np.isfinite(radii)
    count = np.where(inside, np.count_nonzero(off < 1.0, axis=0) / np.sqrt(np.maximum(radii, 1)), 0)
    best = int(np.argmax(count))
    if not inside[best]:
        raise _not_found(picture)
    near = edge[off[:, best] < 1.5]
    circle = through(near)[0] if len(near) >= LEAST_SPOKES else Outline(*map(float, (*centres[best], radii[best])))
    return Outline((circle.x + 0.5) * stride, (circle.y + 0.5) * stride, circle.radius * stride)


def _circles(three: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres (n, 2) and radii (n,) of circles through three points (n, 3, 2); infinite where they lie on a line."""
    a, b = three[:, 1] - three[:, 0], three[:, 2] - three[:, 0]
    cross = 2 * (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    a2, b2 = np.einsum("nk,nk->n", a, a), np.einsum("nk,nk->n", b, b)
    with np.errstate(divide="ignore", invalid="ignore"):
        x = (b[:, 1] * a2 - a[:, 1] * b2) / cross
        y = (a[:, 0] * b2 - b[:, 0] * a2) / cross
        return three[:, 0] + np.stack([x, y], 1), np.nan_to_num(np.hypot(x, y), nan=np.inf)


def limb_near(picture: Photograph, circle: Outline) -> np.ndarray:
    """Where the light ends along spokes of a circle, (spokes, 2): those on which nearly all of it does."""
    columns, rows = picture.size
    unit = max(1.0, circle.radius / SHARP_PX)
    reach = max(REACH, 0.03 * circle.radius / unit) if circle.rms_px == 0.0 else REACH
    angle = np.linspace(0, 2 * np.pi, SPOKES, endpoint=False)
    step = unit * np.arange(-reach, reach + 1e-9, 1 / STEPS)
    x = circle.x + np.cos(angle)[:, None] * (circle.radius + step)
    y = circle.y + np.sin(angle)[:, None] * (circle.radius + step)
    whole = (x.min(1) > 1) & (y.min(1) > 1) & (x.max(1) < columns - 1) & (y.max(1) < rows - 1)
    angle, x, y = angle[whole], x[whole], y[whole]
    if not len(angle):
        return np.empty((0, 2))
    light = _between(picture, x - 0.5, y - 0.5)
    fall = light[:, :-STEPS] - light[:, STEPS:]  # over one unit
    at = np.argmax(fall, axis=1)
    spoke = np.arange(len(at))
    window = np.clip(at[:, None] + np.arange(-STEPS, STEPS + 1), 0, fall.shape[1] - 1)
    weight = np.maximum(fall[spoke[:, None], window], 0.0)
    middle = (weight * step[window]).sum(1) / np.maximum(weight.sum(1), 1e-30) + 0.5 * unit
    inside = light[spoke, np.maximum(at - STEPS, 0)]
    outside = light[spoke, np.minimum(at + 2 * STEPS, light.shape[1] - 1)]
    bright = inside > LIT * np.quantile(light, 0.98)
    keep = bright & (inside - outside > LEAST_FALL * inside) & (at > STEPS) & (at < fall.shape[1] - STEPS)
    radius = (circle.radius + middle)[keep]
    return np.stack([circle.x + radius * np.cos(angle[keep]), circle.y + radius * np.sin(angle[keep])], 1)


def _between(picture: Photograph, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Grey light at places between pixels' middles, in the shape of x."""
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    right, down = (x - column)[..., None], (y - row)[..., None]
    above = picture.light(row, column) * (1 - right) + picture.light(row, column + 1) * right
    below = picture.light(row + 1, column) * (1 - right) + picture.light(row + 1, column + 1) * right
    return np.nan_to_num((above * (1 - down) + below * down).mean(-1))
