"""A ColorChecker in a photograph: found by OpenCV's detector or by its four corners; its patches, and the sample."""

import numpy as np

from ..errors import InputError
from ..records import dataclass
from . import chart_patches
from .chart import BRIGHTEST, Chart, fit_chart
from .picture import Photograph
from .readers import WITHOUT

INNER = 0.25  # of the pitch, on either side of a patch's middle, that is looked at
LONGEST_SIDE = 1600  # pixels to which a picture is reduced for the detector
LEAST_TRIANGLE = 0.01  # of the frame's box: of three corners, beyond which they do not lie on a line (ours)
FAR_OFF = 6.0  # chi beyond which the patches are not those of a chart (ours)


@dataclass(frozen=True, eq=False)
class Placed:
    """A chart in a picture: the homography from the chart's plane [chart widths] to pixels."""

    to_pixels: np.ndarray  # (3, 3)

    def pixels(self, place) -> np.ndarray:
        """Pixels (..., 2) of places (..., 2)."""
        return _through(self.to_pixels, np.asarray(place, float))

    def places(self, pixels) -> np.ndarray:
        return _through(np.linalg.inv(self.to_pixels), np.asarray(pixels, float))

    @property
    def corners(self) -> np.ndarray:
        """The frame's corners (4, 2) [px]: upper left, upper right, lower right, lower left of the chart."""
        half = np.array([0.5, chart_patches.HEIGHT / 2])
        return self.pixels(np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half)

    def turned(self) -> "Placed":
        """The same chart, taken to stand on its head."""
        return Placed(self.to_pixels @ np.diag([-1.0, -1.0, 1.0]))


def homography(source: np.ndarray, target: np.ndarray) -> np.ndarray:
    """The (3, 3) matrix that takes points (n, 2) to points (n, 2), n >= 4, by linear least squares."""
    (x, y), (p, q), one = source.T, target.T, np.ones(len(source))
    zero = 0 * one
    rows = np.r_[
        np.stack([x, y, one, zero, zero, zero, -p * x, -p * y, -p], 1),
        np.stack([zero, zero, zero, x, y, one, -q * x, -q * y, -q], 1),
    ]
    scale = np.abs(rows).max(axis=0)
    _, _, right = np.linalg.svd(rows / scale)
    return (right[-1] / scale).reshape(3, 3) / (right[-1] / scale)[-1]


def by_corners(corners) -> Placed:
    """A chart whose frame has these corners (4, 2) [px], from the dark skin's corner on toward bluish green's.

    Raises InputError where they lie on a line.
    """
    corners = np.asarray(corners, float)
    side, diagonal = np.roll(corners, -1, axis=0) - corners, np.roll(corners, -2, axis=0) - corners
    doubled_area = np.abs(side[:, 0] * diagonal[:, 1] - side[:, 1] * diagonal[:, 0])
    if doubled_area.min() < LEAST_TRIANGLE * max(np.ptp(corners, axis=0).prod(), 1.0):
        raise InputError("three corners of the chart lie on a line; wanted its four corners, one after the other")
    half = np.array([0.5, chart_patches.HEIGHT / 2])
    frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
    return Placed(homography(frame, corners))


def find_chart(picture: Photograph) -> Placed:
    """The chart that OpenCV's detector finds. Raises InputError where it finds none, and without OpenCV."""
    try:
        import cv2

        detector = cv2.mcc.CCheckerDetector_create()  # type: ignore[attr-defined]
    except (ImportError, AttributeError):
        text = "to find the chart " + WITHOUT.format("opencv-python-headless 5")
        raise InputError(f"{picture.name}: {text}; or give --chart with its four corners") from None
    stride = max(1, -(-max(picture.size) // LONGEST_SIDE))
    light = np.clip(picture.light(slice(None, None, stride), slice(None, None, stride)), 0, None)
    codes = 255 * np.clip(light / max(float(np.quantile(light, 0.999)), 1e-9), 0, 1) ** (1 / 2.2)
    shown = codes.astype(np.uint8)
    detector.setColorChartType(cv2.mcc.MCC24)
    if not detector.process(np.ascontiguousarray(shown[..., ::-1]), 1):
        raise InputError(f"{picture.name}: no ColorChecker was found; give --chart with its four corners, x,y each")
    middles = np.array(detector.getBestColorChecker().getColorCharts()).reshape(24, 4, 2).mean(axis=1)
    return Placed(homography(chart_patches.middles(), (middles + 0.5) * stride))


@dataclass(frozen=True, eq=False)
class Shown:
    """A chart in a picture, read with the two data sets; the first is the one that was asked for."""

    picture: Photograph
    placed: Placed
    charts: dict[str, Chart]


def read_chart(picture: Photograph, placed: Placed, data_sets) -> Shown:
    """The chart at its place, upright or on its head. Raises InputError where its patches are not a chart's."""
    first = data_sets[0]
    found = min(
        (
            (fit_chart(*_patches(picture, each), first).chi, number, each)
            for number, each in enumerate((placed, placed.turned()))
        ),
        key=lambda one: one[:2],
    )
    if found[0] > FAR_OFF:
        raise InputError(
            f"{picture.name}: what stands there is no ColorChecker: its patches are off by {found[0]:.0f} times what "
            f"they may be; wanted its four corners from the dark skin's on"
        )
    patches = _patches(picture, found[2])
    return Shown(picture, found[2], {name: fit_chart(*patches, name) for name in data_sets})


def _patches(picture: Photograph, placed: Placed) -> tuple[np.ndarray, np.ndarray]:
    """Mean light (24, 3) of the patches, and where a channel is too bright to count or outside the picture."""
    grid = np.linspace(-INNER, INNER, 17) * chart_patches.PITCH
    x, y = np.meshgrid(grid, grid)
    inside = np.stack([x.ravel(), y.ravel()], -1)
    at = placed.pixels(chart_patches.middles()[:, None] + inside)
    column, row = np.floor(at[..., 0]).astype(int), np.floor(at[..., 1]).astype(int)
    columns, rows = picture.size
    there = (column >= 0) & (row >= 0) & (column < columns) & (row < rows)
    light = picture.light(np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)).astype(float)
    top = 1.0 if picture.codes.dtype.kind == "u" else np.inf
    count = np.maximum(there.sum(axis=1), 1)[:, None]
    mean = np.where(there[..., None], light, 0).sum(axis=1) / count
    bright = (mean > BRIGHTEST * top) | (there.mean(axis=1) < 0.5)[:, None] | ~np.isfinite(mean)
    return np.where(np.isfinite(mean), mean, 0.0), bright


def sample_reflectance(shown: Shown, data_set: str, area) -> tuple[np.ndarray, np.ndarray]:
    """Reflectance (rows, columns, 3) of each pixel of an area (x, y, width, height), and its relative doubt (3,).

    Raises InputError where it lies outside the picture or is clipped.
    """
    x, y, width, height = area
    columns, rows = shown.picture.size
    if x < 0 or y < 0 or width < 1 or height < 1 or x + width > columns or y + height > rows:
        there = f"{x},{y},{width},{height} lies outside its {columns} x {rows} pixels"
        raise InputError(f"{shown.picture.name}: the sample's area {there}")
    part = (slice(y, y + height), slice(x, x + width))
    if np.mean(shown.picture.clipped(*part)) > 0.01:
        raise InputError(f"{shown.picture.name}: the sample is clipped in places: expose less")
    light = shown.picture.light(*part).astype(float)
    at = shown.placed.places(np.stack(np.meshgrid(x + 0.5 + np.arange(width), y + 0.5 + np.arange(height)), -1))
    chart = shown.charts[data_set]
    return chart.reflectance(light, at), chart.doubt(light.mean(axis=(0, 1)), at.mean(axis=(0, 1)))


def _through(matrix, points) -> np.ndarray:
    flat = points @ matrix[:, :2].T + matrix[:, 2]
    return flat[..., :2] / flat[..., 2:]
