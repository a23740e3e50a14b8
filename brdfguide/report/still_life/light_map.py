"""What is seen from one point in every direction, sharp and blurred: a map of angles with a scale of Gaussian widths.

A lobe is summed cell by cell, and each cell looks up the map blurred to its own size: no direction is drawn at random,
and a bright lamp that falls between the cells is not missed.
"""

from functools import cached_property

import numpy as np

from ...records import dataclass

ROWS = 384  # of the sharp map, 0.47 deg each
WIDTHS = np.radians(0.7) * np.sqrt(2.0) ** np.arange(13)  # standard deviation along each axis, up to 45 deg
ROWS_OF_WIDTHS = np.array([192] * 2 + [96] * 4 + [48] * 7)  # half a width a texel or less, from 1 deg on


@dataclass(frozen=True, eq=False)
class Lighting:
    """Radiance (rows, 2 rows, 3) over directions: row by angle from straight up, column by azimuth about it.

    x points right, y up, z toward the camera: an equirectangular map whose middle is what stands behind the object.
    """

    sharp: np.ndarray

    @cached_property
    def _levels(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """All maps as one list of texels, where each begins in it, and how many rows it has; the sharp one first."""
        maps = [self.sharp]
        small = self.sharp
        for width, rows in zip(WIDTHS, ROWS_OF_WIDTHS.tolist(), strict=True):
            small = _reduced(self.sharp if small is self.sharp or small.shape[0] != rows else small, rows)
            maps.append(_blurred(small, width))
        rows = np.array([each.shape[0] for each in maps], np.int32)
        begin = np.concatenate(([0], np.cumsum(2 * rows**2)[:-1])).astype(np.int32)
        return _packed(np.concatenate([each.reshape(-1, 3) for each in maps])), begin, rows

    def seen(self, directions, variance) -> np.ndarray:
        """Radiance (..., 3) toward unit vectors (..., 3), blurred with `variance` (...) [rad²] along each axis: the map
        of the nearest width.
        """
        texels, begin, rows = self._levels
        edges = np.concatenate(([0.5 * WIDTHS[0]], WIDTHS[:-1] * 2**0.25)).astype(np.float32) ** 2
        level = np.searchsorted(edges, np.asarray(variance, np.float32))
        return _bilinear(texels, begin[level], rows[level], np.asarray(directions, np.float32))

    def upper_cells(self, rows: int = 12) -> tuple[np.ndarray, np.ndarray]:
        """Directions (cells, 3) above the horizon and what each sends to level ground, (cells, 3): L cos θ dω."""
        half = self.sharp.shape[0] // 2 // rows * rows
        theta = np.pi * (np.arange(half) + 0.5) / self.sharp.shape[0]
        solid = np.sin(theta) * np.cos(theta) * (np.pi / self.sharp.shape[0]) ** 2
        sent = self.sharp[:half] * solid[:, None, None]
        columns = 3 * rows
        edges = np.linspace(0, sent.shape[1], columns + 1).astype(int)[:-1]
        cells = np.add.reduceat(sent.reshape(rows, half // rows, -1, 3).sum(axis=1), edges, axis=1)
        up = 0.5 * np.pi * (np.arange(rows) + 0.5) / rows
        middle = (edges + np.append(edges[1:], sent.shape[1])) * np.pi / sent.shape[1]
        return map_direction(up[:, None], middle[None]).reshape(-1, 3), cells.reshape(-1, 3)


def map_direction(theta, phi) -> np.ndarray:
    """Unit vectors (..., 3) of the map's angles [rad]."""
    theta, phi = np.broadcast_arrays(theta, phi)
    return np.stack((-np.sin(theta) * np.sin(phi), np.cos(theta), np.sin(theta) * np.cos(phi)), axis=-1)


def map_directions(rows: int = ROWS) -> np.ndarray:
    """Directions (rows, 2 rows, 3) of a map's texels."""
    theta = np.pi * (np.arange(rows) + 0.5) / rows
    return map_direction(theta[:, None], (np.pi * (np.arange(2 * rows) + 0.5) / rows)[None])


def resampled(picture, rows: int = ROWS) -> np.ndarray:
    """An equirectangular picture (height, width, 3) averaged to (rows, 2 rows, 3) by areas of angle, wherever the edges
    of its pixels lie.
    """
    for axis, count in ((0, rows), (1, 2 * rows)):
        whole = np.moveaxis(np.asarray(picture, float), axis, 0)
        total = np.concatenate((np.zeros((1, *whole.shape[1:])), np.cumsum(whole, axis=0)))
        at = np.linspace(0, len(whole), count + 1)
        low = np.minimum(at.astype(int), len(whole) - 1)
        edge = total[low] + (at - low)[:, None, None] * whole[low]
        picture = np.moveaxis(np.diff(edge, axis=0) * count / len(whole), 0, axis)
    return picture


def _packed(radiance) -> np.ndarray:
    """(texels,) of 16 bytes, which are fetched at once: red, green, blue and nothing."""
    made = np.zeros((len(radiance), 4), np.float32)
    made[:, :3] = radiance
    return made.view(np.complex128)[:, 0]


def _bilinear(texels, begin, rows, directions) -> np.ndarray:
    """Values (..., 3) of maps of so many rows that begin there; beyond a pole the last row, around without an end."""
    scale = np.asarray(rows / np.pi, np.float32)
    row = np.arccos(np.clip(directions[..., 1], -1, 1)) * scale - np.float32(0.5)
    column = np.arctan2(-directions[..., 0], directions[..., 2]) * scale - np.float32(0.5)
    top, left = np.floor(row).astype(np.int32), np.floor(column).astype(np.int32)
    s, t = (row - top)[..., None], (column - left)[..., None]
    columns = 2 * rows
    first = np.maximum(top, 0) * columns + begin
    second = np.minimum(top + 1, rows - 1) * columns + begin
    here = np.where(left < 0, left + columns, left)
    beside = np.where(left + 1 >= columns, left + 1 - columns, left + 1)
    beside = np.where(beside < 0, beside + columns, beside)

    def fetched(place):
        return texels[place].view(np.float32).reshape(*np.shape(place), 4)

    upper = fetched(first + here)
    upper += t * (fetched(first + beside) - upper)
    lower = fetched(second + here)
    lower += t * (fetched(second + beside) - lower)
    upper += s * (lower - upper)
    return upper[..., :3]


def _reduced(sharp, rows: int) -> np.ndarray:
    """A map averaged over blocks to so many rows, which divide its own, by solid angle."""
    have = sharp.shape[0]
    if have == rows:
        return sharp
    factor = have // rows
    theta = np.pi * (np.arange(have) + 0.5) / have
    weighted = sharp * np.sin(theta).astype(np.float32)[:, None, None]
    blocks = weighted.reshape(rows, factor, 2 * rows, factor, 3).mean(axis=(1, 3))
    return blocks / np.sin(theta).reshape(rows, factor).mean(axis=1)[:, None, None]


def _blurred(small, width: float) -> np.ndarray:
    """Gaussian on the sphere: along rows by frequency, along columns across the poles, each direction weighted with the
    solid angle that it stands for.
    """
    rows, columns = small.shape[:2]
    sin = np.sin(np.pi * (np.arange(rows) + 0.5) / rows)[:, None, None]
    turns = np.fft.rfft(small * sin, axis=1)
    order = np.arange(turns.shape[1])
    along = np.exp(-0.5 * (order * np.minimum(width / sin[..., 0], np.pi)) ** 2)
    smooth = np.fft.irfft(turns * along[..., None], columns, axis=1)
    meridian = np.concatenate((smooth, np.roll(smooth, columns // 2, axis=1)[::-1]))
    decay = np.exp(-0.5 * (np.arange(rows + 1) * width) ** 2)
    down = np.fft.irfft(np.fft.rfft(meridian, axis=0) * decay[:, None, None], 2 * rows, axis=0)[:rows]
    over = np.abs(np.sin(np.pi * (np.arange(2 * rows) + 0.5) / rows))
    share = np.fft.irfft(np.fft.rfft(over) * decay, 2 * rows)[:rows]
    return np.maximum(down / share[:, None, None], 0)
