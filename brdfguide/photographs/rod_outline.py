"""Where a lit rod stands in a picture: from the shading of its matt reference and the edge that the lamp lights.

Its two edges are upright lines, and of those the lamp lights one only, unless it stands beside the camera: how wide the
rod is tells the place of the shadow's edge. So the middle and the half width are sought with which the light of all
references, dark background and all, is that of a matt rod under one lamp each. The middle row of the picture is taken
as the camera's height, to which the rod stands square.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..errors import InputError
from .outline import LIT, Outline
from .picture import Photograph, Window
from .solids import Pinhole, points

COLUMNS, ROWS = 160, 5  # of the copy in which the rod is sought, at most
ROW_LIT = 0.3  # of the bright level, above which the rod stands in a row (ours)
TRIMMED = 0.05  # of those rows, left out at each end
SUBPIXELS = np.array([-1 / 3, 0.0, 1 / 3])  # of a column, whose light is the mean over its width
WIDTHS = np.geomspace(0.5, 8.0, 41)  # half widths that are tried, in parts of what is lit
LEAST_PX = 8.0  # half width of a rod that can be measured
ANGLES = np.radians(np.arange(-150.0, 151.0, 5.0))  # off the camera's axis, of a lamp that is sought
FAR_LAMP = 40.0  # radii: a lamp whose distance is not known, as the search starts
HELD = 0.1  # per unit of ln distance: where nothing shows it, it stays as it was (ours)
STEP = 0.004  # of the half width and of a radian, over which slopes are taken: wider than the grain of pixels
TRUSTED = 0.05  # of the bright level, which the shading of a matt rod may miss (ours)
CRESCENT = np.radians(
    80.0
)  # off the camera's axis: of what lamps light whose place is not known, no width is told (ours)
LEANS_PX = 1.5  # between the upper and the lower half of the rod, from which it is said to lean


def find_rod(
    pictures: Sequence[Photograph], lamps: Sequence[np.ndarray | None], distance: float
) -> tuple[Outline, tuple[float, float], float]:
    """The outline of a rod that stands upright, the rows [px] in which it stands, and by how much it leans [px].

    Takes  pictures of the matt reference, their lamps [radii] (None: to be found), the camera's distance [radii].
    Raises InputError where no upright rod stands out from a dark background.
    """
    rows = _rows(pictures[0])
    strips = [_Strip(picture, rows, lamp) for picture, lamp in zip(pictures, lamps, strict=True)]
    middle_row = pictures[0].size[1] / 2
    start = min(
        (
            (
                _misses(strips, Pinhole((edge - side * radius, middle_row), radius, distance)),
                edge - side * radius,
                radius,
            )
            for edge, side, radius in _tried(strips)
        ),
        default=None,
    )
    if start is None:
        raise _not_found(pictures[0])
    found, angles = _refined(strips, start[1:], middle_row, distance)
    if found.rms_px > TRUSTED or found.radius < LEAST_PX or (len(angles) == len(strips) and min(angles) > CRESCENT):
        raise _not_found(pictures[0])
    return replace(found, rms_px=0.0), rows, max(strip.leans() for strip in strips)


def _not_found(picture: Photograph) -> InputError:
    return InputError(
        f"{picture.name}: no upright matt rod whose width the light tells stands out from a dark background; "
        f"wanted outline: {{centre_px: [x, y], radius_px: half of its width}} in the description"
    )


class _Strip:
    """Light of one reference, relative to its bright level, where the rod stands and beside it."""

    def __init__(self, picture: Photograph, rows, lamp):
        columns, height = picture.size
        block = max(1, columns // COLUMNS)
        step = max(1, int(rows[1] - rows[0]) // ROWS)
        self.y = np.arange(rows[0] + step / 2, rows[1], step)[:ROWS]
        window = Window(0, 0, columns // block, height // block, block)
        self.x, self.pixel = window.middles()[0], float(block)
        shown = picture.light(np.minimum(self.y, height - 1).astype(int)).astype(float).mean(-1)
        shown = np.nan_to_num(shown, posinf=0.0)[:, : block * window.columns]
        light = shown.reshape(len(self.y), window.columns, block).mean(-1)
        level = float(np.quantile(light, 0.98))
        self.light = light / level if level > 0 else light
        clipped = picture.clipped(np.minimum(self.y, height - 1).astype(int))[:, : block * window.columns]
        self.weight = 1.0 - clipped.reshape(light.shape[0], window.columns, block).any(-1)
        self.lamp = lamp

    def lit(self) -> np.ndarray:
        """Columns [px] in which there is light."""
        return self.x[np.median(self.light, axis=0) > LIT]

    def shading(self, view: Pinhole, lamp) -> np.ndarray:
        """What a matt rod would show, in an unknown unit; nothing beside it."""
        x = (self.x[:, None] + self.pixel * SUBPIXELS).ravel()
        with np.errstate(invalid="ignore"):
            shade = points("cylinder", view, x[None, :], self.y[:, None]).irradiance(lamp)
        return np.maximum(np.nan_to_num(shade), 0.0).reshape(len(self.y), len(self.x), -1).mean(-1)

    def left(self, view: Pinhole, lamp) -> np.ndarray:
        """What the best strength of a lamp leaves of the light."""
        shade = self.shading(view, lamp) * self.weight
        power = float(np.vdot(shade, shade))
        light = self.light * self.weight
        return (light - shade * (np.vdot(shade, light) / power if power > 0 else 0.0)).ravel()

    def leans(self) -> float:
        """How far apart the lit edge stands in the upper and the lower half [px]."""
        half = len(self.y) // 2
        edges = [_edges(self.x, part.mean(axis=0), self.pixel) for part in (self.light[:half], self.light[-half:])]
        return min(abs(one - other) for one, other in zip(*edges, strict=True)) if half else 0.0


def _edges(x, light, pixel) -> tuple[float, float]:
    """Where the light begins and ends [px], to a part of a pixel, at half of the steepest rise."""
    rise = np.diff(light)
    up, down = int(np.argmax(rise)), int(np.argmin(rise))
    return float(x[up] + pixel / 2), float(x[down] + pixel / 2)


def _lamp(angle: float, distance: float = FAR_LAMP) -> np.ndarray:
    return distance * np.array([np.sin(angle), 0.0, np.cos(angle)])


def _tried(strips: Sequence[_Strip]):
    """(lit edge, its side, half width): the edges of what is lit in one strip, with each width."""
    for strip in strips:
        lit = strip.lit()
        if len(lit) < 4:
            continue
        across = lit[-1] - lit[0] + strip.pixel
        for side, edge in ((1.0, lit[-1] + strip.pixel / 2), (-1.0, lit[0] - strip.pixel / 2)):
            for width in WIDTHS:
                yield edge, side, width * across


def _angle(strip: _Strip, view: Pinhole) -> tuple[float, float]:
    """The angle off the camera's axis [radians] of a lamp that would shade the middle row most like the light there, to
    5 degrees, and the sum of squares that it leaves of the row."""
    with np.errstate(invalid="ignore"):
        seen = points("cylinder", view, strip.x, np.full(len(strip.x), view.centre_px[1]))
    if strip.lamp is None:
        cosine = seen.normal[:, [0, 2]] @ np.stack([np.sin(ANGLES), np.cos(ANGLES)])
        shade = (cosine - 1 / FAR_LAMP) / (1 - 2 * cosine / FAR_LAMP + FAR_LAMP**-2) ** 1.5
    else:
        shade = seen.irradiance(strip.lamp)[:, None]
    shade = np.maximum(np.nan_to_num(shade), 0.0)
    light = np.median(strip.light, axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        left = light @ light - np.nan_to_num((light @ shade) ** 2 / np.einsum("xa,xa->a", shade, shade))
    best = int(np.argmin(left))
    return float(ANGLES[best]), float(left[best])


def _misses(strips: Sequence[_Strip], view: Pinhole) -> float:
    """Sum of squares that a middle and a half width leave of the middle rows, with each lamp where it fits best."""
    return sum(_angle(strip, view)[1] for strip in strips)


def _refined(strips: Sequence[_Strip], start, middle_row: float, distance: float):
    """Middle and half width by least squares, in `rms_px` what the shading leaves of the light, and how far off the
    camera's axis the lamps stand that were not known [radians]; their distances are sought as well."""
    from scipy.optimize import least_squares

    unknown = [strip for strip in strips if strip.lamp is None]
    first = Pinhole((start[0], middle_row), start[1], distance)
    angles = [_angle(strip, first)[0] for strip in unknown]

    def view_of(values) -> Pinhole:
        return Pinhole((start[0] + start[1] * (values[0] - 1), middle_row), start[1] * values[1], distance)

    def left(values) -> np.ndarray:
        view = view_of(values)
        turned, log_distance = values[2:].reshape(2, -1) - 1
        found = iter(_lamp(a + t, FAR_LAMP * np.exp(d)) for a, t, d in zip(angles, turned, log_distance, strict=True))
        parts = [strip.left(view, next(found) if strip.lamp is None else strip.lamp) for strip in strips]
        return np.concatenate([*parts, HELD * log_distance])

    guess = np.ones(2 + 2 * len(unknown))
    low, high = guess - [0.5, 0.5, *(0.5,) * len(unknown), *(3.0,) * len(unknown)], guess + 2.0
    answer = least_squares(left, guess, bounds=(low, high), diff_step=STEP, xtol=1e-5, ftol=1e-6, max_nfev=40)
    view = view_of(answer.x)
    light = sum(float(np.sum((strip.light * strip.weight) ** 2)) for strip in strips)
    misses = float(np.sqrt(np.sum(answer.fun**2) / max(light, 1e-30)))
    turned = [abs(angle + by) for angle, by in zip(angles, answer.x[2 : 2 + len(angles)] - 1, strict=True)]
    return Outline(float(view.centre_px[0]), middle_row, float(view.radius_px), misses), turned


def _rows(picture: Photograph) -> tuple[float, float]:
    """The rows in which something lit stands, without their ends."""
    columns, height = picture.size
    stride = max(1, columns // COLUMNS)
    grey = np.nan_to_num(picture.light(slice(None), slice(None, None, stride)).mean(-1), posinf=0.0)
    across = np.quantile(grey, 0.98, axis=1)
    lit = np.flatnonzero(across > ROW_LIT * np.quantile(across, 0.9))
    if not len(lit) or across.max() <= 0:
        raise _not_found(picture)
    first, last = float(lit[0]), float(lit[-1] + 1)
    trimmed = TRIMMED * (last - first) if last - first < height else 0.0
    return first + trimmed, last - trimmed
