"""A picture of a surface on objects among surroundings: rays from a camera, and light summed cell by cell of the lobe.

What is left out: objects neither shade nor reflect one another or themselves, and send no light to the floor.
"""

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from ...exporters.exporter import ColouredSurface
from ...physics.geometry import Geometry
from ...records import dataclass
from ..grained_view import grain_axis, has_grain
from ..toward_light import TURN
from . import lobe_cells as lobes
from .chequer import Chequer, floor_under
from .light_map import Lighting, map_directions
from .standing import Thing

DISTANCE, ELEVATION = 12.0, np.radians(7.0)  # of the camera
AIM = np.array([0.0, 0.72, 0.0])
MIDDLE = np.array([0.0, 0.85, 0.0])  # from where the map of the surroundings is made
HALF_WIDTH = 1.8  # of the picture at the aim
LOCAL_ROWS = 384  # of what an object sees about itself
APART = 1.6  # times a part's step: a corner whose normal differs by more is not asked
LEAST_WEIGHT = 0.5  # of the corners that are asked, on the finest grid
BLOCK = 20_000  # pairs of pixel and cell at once: what caches hold
SPREAD = 2.0  # times the variance of a cell: Gaussians half as wide as they are apart sum to an even light


@dataclass(frozen=True, eq=False)
class Layer:
    """One object's pixels: rows of the flat picture, points, normals, directions across the grooves, share covered."""

    thing: Thing
    rows: np.ndarray
    points: np.ndarray
    normal: np.ndarray
    across: np.ndarray
    ray: np.ndarray
    covered: np.ndarray


@dataclass(frozen=True, eq=False)
class Stage:
    """Objects, floor, light and camera: what all surfaces of a sheet share."""

    things: Sequence[Thing]
    around: Lighting
    size: int
    has_floor: bool = True  # an image of the surroundings holds its own ground

    @cached_property
    def floor(self) -> Chequer | None:
        return floor_under(self.things, self.around) if self.has_floor else None

    @cached_property
    def layers(self) -> list[Layer]:
        """Farthest first."""
        found = [_layer(each, self.size) for each in sorted(self.things, key=lambda thing: thing.z)]
        return [each for each in found if each.rows.size]

    @cached_property
    def behind(self) -> np.ndarray:
        """(size², 3): floor and surroundings without the objects."""
        origin, ray = _rays(self.size, np.arange(self.size**2))
        return self.toward(origin, ray, 1.5 * 2 * HALF_WIDTH / DISTANCE / self.size)  # half a pixel more: no moiré

    def toward(self, origin, ray, spread) -> np.ndarray:
        """Radiance (n, 3) that comes along rays against them, averaged over an angle `spread` (...) [rad]."""
        spread = np.broadcast_to(spread, ray.shape[:-1])
        light = np.empty(ray.shape)
        down = ray[:, 1] < -1e-4 if self.floor else np.zeros(len(ray), bool)
        light[~down] = self.around.seen(ray[~down], (spread[~down] ** 2 / 12).astype(np.float32))
        if self.floor is None:
            return light
        ray, spread = ray[down], spread[down]
        far = origin[down, 1] / -ray[:, 1]
        at = origin[down] + far[:, None] * ray
        level = np.maximum(np.hypot(ray[:, 0], ray[:, 2]), 1e-9)
        across = far * spread
        along = across / -ray[:, 1]
        x, z = np.abs(ray[:, 0]) / level, np.abs(ray[:, 2]) / level
        light[down] = self.floor.radiance(at[:, 0], at[:, 2], x * along + z * across, z * along + x * across)
        return light

    @cached_property
    def _local(self) -> Lighting:
        """The surroundings with the floor, as they are seen from `MIDDLE`."""
        if self.floor is None:
            return self.around
        to = map_directions(LOCAL_ROWS).reshape(-1, 3)
        half = len(to) // 2
        above = self.around.seen(to[:half], 0.0)
        below = self.toward(np.broadcast_to(MIDDLE, (half, 3)), to[half:], np.pi / LOCAL_ROWS)
        return Lighting(np.concatenate((above, below)).reshape(LOCAL_ROWS, -1, 3).astype(np.float32))

    def picture(self, surface: ColouredSurface, progress=None) -> np.ndarray:
        """Radiance in linear sRGB, (size, size, 3)."""
        image = np.array(self.behind, float)
        grained = has_grain(surface)
        parts = lobes.lobe_parts(surface, grained)
        for place, layer in enumerate(self.layers):
            lit = np.zeros((len(layer.rows), 3))
            for part in parts:
                lit += self._stepwise(surface, layer, part)
            if surface.model.has_mirror:
                lit += self._mirrored(surface, layer)
            share = layer.covered[:, None]
            image[layer.rows] += share * (lit - image[layer.rows])
            if progress:
                progress((place + 1) / len(self.layers))
        return image.reshape(self.size, self.size, 3)

    def _mirrored(self, surface: ColouredSurface, layer: Layer) -> np.ndarray:
        cos = np.clip(-np.sum(layer.normal * layer.ray, axis=1), 1e-6, 1)
        table = np.linspace(0, 89.99, 400)
        share = surface.mirror_rgb(Geometry.from_degrees(table, 0.0, table, 180.0))
        angle = np.degrees(np.arccos(cos))
        share = np.stack([np.interp(angle, table, share[:, channel]) for channel in range(3)], axis=-1)
        to = layer.ray + 2 * cos[:, None] * layer.normal
        pixel = 2 * 2 * HALF_WIDTH / self.size / layer.thing.size
        return share * self.toward(layer.points, to, pixel)

    def _stepwise(self, surface, layer: Layer, cells: lobes.LobeCells) -> np.ndarray:
        """A part of a lobe at every so many pixels and between them; closer together where the normal turns fast."""
        step = int(cells.step / (2 * HALF_WIDTH / self.size / layer.thing.size))
        found = np.zeros((len(layer.rows), 3))
        left = np.arange(len(layer.rows))
        where = np.full(self.size**2, -1)
        where[layer.rows] = left
        while step > 1 and left.size:
            at, share, apart, light = self._corners(surface, layer, cells, left, step, where)
            share = np.where((at >= 0) & (apart < ((1 if step > 2 else 2) * APART * cells.step) ** 2), share, 0)
            weight = share.sum(axis=0)
            good = weight > (1 - 1e-9 if step > 2 else LEAST_WEIGHT)
            found[left[good]] = np.einsum("kp,kpx->px", share, light)[good] / weight[good, None]
            left, step = left[~good], max(step // 2, 2) if step > 2 else 1
        found[left] = self._summed(surface, _taken(layer, left), cells)
        return found

    def _corners(self, surface, layer: Layer, cells: lobes.LobeCells, pixels, step: int, where):
        """Of the square of a grid that pixels lie in: corners among the layer's pixels or -1, their shares, squared
        difference of their normals, and light (4, pixels, 3) there.
        """
        row, column = np.divmod(layer.rows[pixels], self.size)
        down, right = np.array([[0], [0], [1], [1]]), np.array([[0], [1], [0], [1]])
        y, x = (row // step + down) * step, (column // step + right) * step
        at = np.where((y < self.size) & (x < self.size), where[np.minimum(y * self.size + x, self.size**2 - 1)], -1)
        s, t = row % step / step, column % step / step
        share = np.where(down, s, 1 - s) * np.where(right, t, 1 - t)
        used, place = np.unique(at, return_inverse=True)
        kept = used >= 0
        summed = np.zeros((len(used), 3))
        summed[kept] = self._summed(surface, _taken(layer, used[kept]), cells)
        off = layer.normal[at] - layer.normal[pixels]
        return at, share, np.einsum("kpx,kpx->kp", off, off), summed[place.reshape(at.shape)]

    def _summed(self, surface, layer: Layer, cells: lobes.LobeCells) -> np.ndarray:
        """Light (pixels, 3) of cells of the lobe."""
        out = np.zeros((len(layer.rows), 3))
        axis = grain_axis(surface) if cells.turns > 1 else 0.0
        step = max(1, BLOCK // len(cells.solid))
        for start in range(0, len(out), step):
            block = _taken(layer, slice(start, start + step))
            out[start : start + step] = self._block(block, cells, axis)
        return out

    def _block(self, layer: Layer, cells: lobes.LobeCells, axis: float) -> np.ndarray:
        normal, view = layer.normal.astype(np.float32), -layer.ray.astype(np.float32)
        cos = np.clip(np.sum(normal * view, axis=1), 1e-4, 1)
        sin = np.sqrt(np.maximum(1 - cos**2, 1e-9))
        x = (view - cos[:, None] * normal) / sin[:, None]
        y = np.cross(normal, x)
        own = cells.vectors.astype(np.float32)
        variance = np.broadcast_to((SPREAD / (4 * np.pi) * cells.solid).astype(np.float32), (len(view), len(own)))
        if cells.halved:
            seen_from = np.stack((sin, np.zeros_like(sin), cos), axis=-1)
            cos_d = np.maximum(seen_from @ own.T, 0)
            own = 2 * cos_d[..., None] * own - seen_from[:, None]
            if cells.turned:
                own *= TURN.astype(np.float32)
            variance = 4 * cos_d * variance
        to = own @ np.stack((x, y, normal), axis=1)
        light = self._local.seen(self._from_middle(layer, to), variance)
        return np.einsum("pcx,pcx->px", light, _weights(cells, np.arccos(cos), layer, x, axis))

    def _from_middle(self, layer: Layer, to) -> np.ndarray:
        """Directions from the object's middle to where rays from its surface meet the floor; the others as they are."""
        if self.floor is None:
            return to
        pixel, cell = np.nonzero(to[..., 1] < -1e-3)
        points, down = layer.points.astype(np.float32)[pixel], to[pixel, cell]
        seen = points - (points[:, 1] / down[:, 1])[:, None] * down - MIDDLE.astype(np.float32)
        to[pixel, cell] = seen / np.sqrt(np.einsum("px,px->p", seen, seen))[:, None]
        return to


def _weights(cells: lobes.LobeCells, theta, layer: Layer, x, axis: float) -> np.ndarray:
    """Weights (pixels, cells, 3) at angles of view, between those of the table."""
    row = np.interp(theta, cells.theta, np.arange(len(cells.theta)))
    low = np.minimum(row.astype(int), len(cells.theta) - 2)
    share = (row - low).astype(np.float32)[:, None, None]

    def at(turn):
        here = cells.weights[turn, low]
        return here + share * (cells.weights[turn, low + 1] - here)

    if cells.turns == 1:
        return at(0)
    beside = np.cross(layer.normal, layer.across)
    azimuth = np.arctan2(np.sum(x * beside, axis=1), np.sum(x * layer.across, axis=1)) + axis
    place = np.remainder(azimuth, np.pi) / np.pi * cells.turns
    turn = np.floor(place).astype(int)
    part = (place - turn).astype(np.float32)[:, None, None]
    one = at(turn % cells.turns)
    return one + part * (at((turn + 1) % cells.turns) - one)


def _taken(layer: Layer, rows) -> Layer:
    return Layer(
        layer.thing,
        layer.rows[rows],
        layer.points[rows],
        layer.normal[rows],
        layer.across[rows],
        layer.ray[rows],
        layer.covered[rows],
    )


def _rays(size: int, rows, off=(0.5, 0.5)) -> tuple[np.ndarray, np.ndarray]:
    """Where rays through pixels begin, and whither they go, (n, 3) each."""
    toward = np.array([0.0, np.sin(ELEVATION), np.cos(ELEVATION)])
    up = np.array([0.0, np.cos(ELEVATION), -np.sin(ELEVATION)])
    row, column = np.divmod(rows, size)
    x = ((column + off[0]) / size * 2 - 1) * HALF_WIDTH
    y = (1 - (row + off[1]) / size * 2) * HALF_WIDTH
    ray = x[:, None] * np.array([1.0, 0.0, 0.0]) + y[:, None] * up - DISTANCE * toward
    ray /= np.linalg.norm(ray, axis=1)[:, None]
    return np.broadcast_to(AIM + DISTANCE * toward, ray.shape), ray


def _layer(thing: Thing, size: int) -> Layer:
    """The pixels that an object covers; at its edges by nine rays a pixel."""
    every = _near(thing, size)
    origin, ray = _rays(size, every)
    far = np.full(size**2, np.inf)
    far[every] = thing.hit(origin, ray)
    on = np.isfinite(far).reshape(size, size)
    grown = np.pad(on, 1)
    near = np.stack([grown[1 + a : size + 1 + a, 1 + b : size + 1 + b] for a in (-1, 0, 1) for b in (-1, 0, 1)])
    edge = np.flatnonzero((near.any(axis=0) & ~near.all(axis=0)).ravel())
    covered = on.ravel().astype(float)
    points = np.zeros((size**2, 3))
    points[every] = origin + np.where(on.ravel()[every], far[every], 0)[:, None] * ray
    count, total = np.zeros(len(edge)), np.zeros((len(edge), 3))
    for a in (1 / 6, 0.5, 5 / 6):
        for b in (1 / 6, 0.5, 5 / 6):
            start, each = _rays(size, edge, (a, b))
            length = thing.hit(start, each)
            met = np.isfinite(length)
            count += met
            total[met] += start[met] + length[met, None] * each[met]
    covered[edge] = count / 9
    met = count > 0
    points[edge[met]] = total[met] / count[met, None]
    rows = np.flatnonzero(covered)
    ray = _rays(size, rows)[1]
    normal, across = thing.normals(points[rows], ray)
    return Layer(thing, rows, points[rows], normal, across, ray, covered[rows])


def _near(thing: Thing, size: int) -> np.ndarray:
    """Pixels of the rectangle about an object."""
    pixel = 2 * HALF_WIDTH / size
    reach = 1.6 * thing.size + 0.1
    left, right = (int((each + HALF_WIDTH) / pixel) for each in (thing.x - reach, thing.x + reach))
    low, high = (int((HALF_WIDTH + AIM[1] - each) / pixel) for each in (2.25 * thing.size, -0.35 * thing.size - 0.2))
    row = np.arange(max(low, 0), min(high + 1, size))
    column = np.arange(max(left, 0), min(right + 1, size))
    return (row[:, None] * size + column).ravel()
