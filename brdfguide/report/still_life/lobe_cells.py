"""A law as weights of cells of directions: ∫ f cos θi dω over each, for every angle of view.

Near the mirror direction cells are of half vectors h, so that they keep their place in a lobe as the view moves; far
from it they are of the incident direction. Both quadratures cover a belt of tilts between, where their shares add to 1.

    dω_i = 4 cos d dω_h,  dω_h = t dt dφ/(1 + t²)^{3/2},  t = tan of the half vector's tilt
"""

from dataclasses import dataclass

import numpy as np

from ...exporters.exporter import ColouredSurface
from ...physics.geometry import Geometry
from ..grained_view import sample_turned

LEAST, INNER, NARROW, FAR = 3e-4, 8e-3, 0.05, 0.35  # tilts [tan] where rings of cells of half vectors begin and end
BELT = (0.2, 0.35)  # tilts [tan] where directions take over
NARROW_RINGS, WIDE_RINGS, FINE = 4, 5, 4  # rings of cells, and of the quadrature in each
CORE_FINE = 12  # of the quadrature in the first cell
NARROW_SPOKES, WIDE_SPOKES = 8, 16
SPOKES = 48  # of the quadrature
BANDS, SECTORS = 8, 20  # of cells of incident directions
FINE_BANDS, FINE_SECTORS = 32, 80  # of the quadrature
TURNS = 16  # azimuths of the line of sight in a sample with a grain, over half a turn
THETAS, GRAINED_THETAS = 36, 20
GRAZING = np.radians(89.6)
PEAK, PEAK_SHARE = 0.025, 0.1  # a lobe with less than this share at smaller tilts is smooth
FINEST_SHARE = 0.3  # of a lobe that is as sharp as the pixels
WIDE_STEP, MIDDLE_STEP = 0.022, 0.015  # turn of the normal [rad] from one place to the next where a part is summed


@dataclass(frozen=True, eq=False)
class LobeCells:
    """Unit vectors (cells, 3) in the frame x in the plane of view, z the normal; their solid angles, and their weights
    over turn and angle; `step` [rad of the normal] may lie between those places where they are summed.
    """

    vectors: np.ndarray
    halved: bool  # half vectors, or directions of incidence
    solid: np.ndarray
    theta: np.ndarray  # (thetas,)
    weights: np.ndarray  # (turns, thetas, cells, 3)
    step: float = WIDE_STEP

    @property
    def turns(self) -> int:
        return self.weights.shape[0]

    def part(self, kept, step: float) -> "LobeCells":
        return LobeCells(self.vectors[kept], self.halved, self.solid[kept], self.theta, self.weights[:, :, kept], step)


def lobe_parts(surface: ColouredSurface, grained: bool) -> list[LobeCells]:
    """A lobe's core, its flanks, and what is far from the mirror direction; the smoother a part, the fewer places it
    needs. LobeCells that send nothing are left out.
    """
    half, far = _cells(surface, grained)
    size = np.abs(half.weights)
    tilt = np.hypot(half.vectors[:, 0], half.vectors[:, 1])
    total = (size.sum(axis=2) + np.abs(far.weights).sum(axis=2)).max()
    facing = size[:, 0].mean(axis=(0, 2)).astype(float)
    if not total > 0:
        return []

    def within(most):
        return facing[tilt < most].sum() / max(facing.sum(), 1e-300)

    core = WIDE_STEP if within(PEAK) < PEAK_SHARE else MIDDLE_STEP
    if within(INNER) > FINEST_SHARE:
        core = 0.0
    seen, narrow = size.max(axis=(0, 1, 3)) > 1e-4 * total, tilt < NARROW
    kept = np.abs(far.weights).max(axis=(0, 1, 3)) > 1e-4 * total
    found = [half.part(narrow & seen, core), half.part(~narrow & seen, WIDE_STEP), far.part(kept, WIDE_STEP)]
    return [each for each in found if each.solid.size]


def _cells(surface: ColouredSurface, grained: bool) -> tuple[LobeCells, LobeCells]:
    theta = 0.5 * np.pi * (1 - (1 - np.linspace(0, 1, GRAINED_THETAS if grained else THETAS)) ** 1.5)
    theta[-1] = GRAZING
    return _of_half_vectors(surface, theta, grained), _of_directions(surface, theta, grained)


def _of_half_vectors(surface: ColouredSurface, theta, grained: bool) -> LobeCells:
    core = np.geomspace(LEAST, INNER, CORE_FINE + 1)
    near = np.geomspace(INNER, NARROW, NARROW_RINGS * FINE + 1)[1:]
    wide = np.geomspace(NARROW, FAR, WIDE_RINGS * FINE + 1)[1:]
    edges = np.concatenate(([0.0], core[1:], near, wide))
    ring = np.repeat(np.arange(1 + NARROW_RINGS + WIDE_RINGS), [CORE_FINE] + [FINE] * (NARROW_RINGS + WIDE_RINGS))
    spokes = np.array([1] + [NARROW_SPOKES] * NARROW_RINGS + [WIDE_SPOKES] * WIDE_RINGS)
    first = np.concatenate(([0], np.cumsum(spokes)))
    t = np.sqrt(edges[1:] * np.maximum(edges[:-1], 0.25 * edges[1:]))
    height = 1 / np.hypot(1, edges)
    solid = np.broadcast_to(((height[:-1] - height[1:]) * 2 * np.pi / SPOKES)[:, None], (len(t), SPOKES))
    cell = first[ring][:, None] + (np.arange(SPOKES) * spokes[ring][:, None]) // SPOKES
    half = _polar(np.arctan(t)[:, None], 2 * np.pi * (np.arange(SPOKES) + 0.5) / SPOKES)

    def directions(view):
        cos_d = half @ view
        i = 2 * cos_d[..., None] * half - view
        return i, np.where(cos_d > 0, 4 * cos_d * (1 - _belt(t))[:, None] * solid, 0)

    weights = _weights(surface, theta, grained, directions, cell, first[-1])
    count = first[-1]
    every = np.bincount(cell.ravel(), solid.ravel(), count)
    tilt = np.exp(np.bincount(cell.ravel(), (solid * np.log(t)[:, None]).ravel(), count) / every)
    tilt[0] = 0.0  # the first cell lies about the normal
    place = np.arange(count) - np.repeat(first[:-1], spokes)
    vectors = _polar(np.arctan(tilt), 2 * np.pi * (place + 0.5) / np.repeat(spokes, spokes))
    return LobeCells(vectors, True, every, theta, weights)


def _of_directions(surface: ColouredSurface, theta, grained: bool) -> LobeCells:
    def grid(bands, sectors):
        at = 0.5 * np.pi * (np.arange(bands) + 0.5) / bands
        vectors = _polar(at[:, None], 2 * np.pi * (np.arange(sectors) + 0.5) / sectors)
        edge = np.cos(0.5 * np.pi * np.arange(bands + 1) / bands)
        return vectors, np.broadcast_to(((edge[:-1] - edge[1:]) * 2 * np.pi / sectors)[:, None], (bands, sectors))

    fine, solid = grid(FINE_BANDS, FINE_SECTORS)
    cell = (np.arange(FINE_BANDS) * BANDS // FINE_BANDS)[:, None] * SECTORS
    cell = cell + np.arange(FINE_SECTORS) * SECTORS // FINE_SECTORS

    def directions(view):
        half = fine + view
        tilt = np.hypot(half[..., 0], half[..., 1]) / half[..., 2]
        return fine, solid * _belt(tilt)

    vectors, large = grid(BANDS, SECTORS)
    weights = _weights(surface, theta, grained, directions, cell, BANDS * SECTORS)
    return LobeCells(vectors.reshape(-1, 3), False, large.ravel(), theta, weights)


def _belt(tilt):
    """0 near the mirror direction, 1 far from it: the share of the quadrature over directions."""
    x = np.clip((tilt - BELT[0]) / (BELT[1] - BELT[0]), 0, 1)
    return x * x * (3 - 2 * x)


def _weights(surface: ColouredSurface, theta, grained: bool, directions, cell, count: int) -> np.ndarray:
    """(turns, thetas, cells, 3). Without a grain one half of the azimuths is the mirror image of the other."""
    turns = TURNS if grained else 1
    rows, columns = cell.shape
    kept = columns if grained else columns // 2
    sent = np.zeros((turns, len(theta), rows, columns, 3))
    views = np.stack((np.sin(theta), np.zeros(len(theta)), np.cos(theta)), axis=-1)
    found = [directions(view) for view in views]
    i = np.stack([np.broadcast_to(each, (rows, columns, 3)) for each, _ in found])[:, :, :kept]
    share = np.stack([each for _, each in found])[:, :, :kept] * i[..., 2]
    good = (i[..., 2] > 1e-6) & (share > 0)
    geom = Geometry.from_vectors(i[good], np.broadcast_to(views[:, None, None], i.shape)[good])
    for turn in range(turns):
        f = surface.rgb(sample_turned(geom, np.pi * turn / turns) if turn else geom)
        sent[turn, :, :, :kept][good] = f * share[good][:, None]
    if not grained:
        sent[:, :, :, kept:] = sent[:, :, :, :kept][:, :, :, ::-1]
    flat = sent.reshape(turns * len(theta), rows * columns, 3)
    order = np.argsort(cell.ravel(), kind="stable")
    starts = np.searchsorted(cell.ravel()[order], np.arange(count))
    summed = np.add.reduceat(flat[:, order], starts, axis=1)
    return summed.reshape(turns, len(theta), count, 3).astype(np.float32)


def _polar(theta, phi) -> np.ndarray:
    theta, phi = np.broadcast_arrays(theta, phi)
    return np.stack((np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), axis=-1)
