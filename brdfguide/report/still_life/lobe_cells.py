"""A law as weights of cells of directions: ∫ f cos θi dω over each, for every angle of view.

Near the mirror direction cells are of half vectors h, so that they keep their place in a lobe as the view moves; far
from it they are of the incident direction. Both quadratures cover a belt of tilts between, where their shares add to 1.

    dω_i = 4 cos d dω_h,  dω_h = t dt dφ/(1 + t²)^{3/2},  t = tan of the half vector's tilt
"""

from dataclasses import replace

import numpy as np

from ...exporters.exporter import ColouredSurface
from ...physics.geometry import Geometry
from ...records import dataclass
from ..grained_view import sample_turned
from ..toward_light import TURN, share_of_mirror_side, shines_back

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
FAR_STEP, WIDE_STEP, MIDDLE_STEP = 0.06, 0.03, 0.015  # turn of the normal [rad] from one place of a sum to the next


@dataclass(frozen=True, eq=False)
class LobeCells:
    """Unit vectors (cells, 3) in the frame x in the plane of view, z the normal; their solid angles, and their weights
    over turn and angle; `step` [rad of the normal] may lie between those places where they are summed.
    """

    vectors: np.ndarray
    halved: bool  # half vectors, or directions of incidence
    turned: bool  # half vectors of the light turned about the normal by half a turn: about the light, not its mirror
    solid: np.ndarray
    theta: np.ndarray  # (thetas,)
    weights: np.ndarray  # (turns, thetas, cells, 3)
    step: float = WIDE_STEP

    @property
    def turns(self) -> int:
        return self.weights.shape[0]

    def part(self, kept, step: float) -> "LobeCells":
        return replace(
            self, vectors=self.vectors[kept], solid=self.solid[kept], weights=self.weights[:, :, kept], step=step
        )


def lobe_parts(surface: ColouredSurface, grained: bool) -> list[LobeCells]:
    """A lobe's core, its flanks, the same about the light where it shines back, and what is far from both; the smoother
    a part, the fewer places it needs. LobeCells that send nothing are left out.
    """
    *about, far = _cells(surface, grained)
    total = sum(np.abs(each.weights).sum(axis=2) for each in (*about, far)).max()
    if not total > 0:
        return []
    found = [part for each in about for part in _core_and_flanks(each, total)]
    kept = np.abs(far.weights).max(axis=(0, 1, 3)) > 1e-4 * total
    return [each for each in (*found, far.part(kept, FAR_STEP)) if each.solid.size]


def _core_and_flanks(half: LobeCells, total: float) -> list[LobeCells]:
    size = np.abs(half.weights)
    tilt = np.hypot(half.vectors[:, 0], half.vectors[:, 1])
    facing = size[:, 0].mean(axis=(0, 2)).astype(float)

    def within(most):
        return facing[tilt < most].sum() / max(facing.sum(), 1e-300)

    core = WIDE_STEP if within(PEAK) < PEAK_SHARE else MIDDLE_STEP
    if within(INNER) > FINEST_SHARE:
        core = 0.0
    seen, narrow = size.max(axis=(0, 1, 3)) > 1e-4 * total, tilt < NARROW
    return [half.part(narrow & seen, core), half.part(~narrow & seen, WIDE_STEP)]


def _cells(surface: ColouredSurface, grained: bool) -> list[LobeCells]:
    theta = 0.5 * np.pi * (1 - (1 - np.linspace(0, 1, GRAINED_THETAS if grained else THETAS)) ** 1.5)
    theta[-1] = GRAZING
    back = shines_back(surface)
    about = [_of_half_vectors(surface, theta, grained, back, turned) for turned in ([False, True] if back else [False])]
    return [*about, _of_directions(surface, theta, grained, back)]


def _of_half_vectors(surface: ColouredSurface, theta, grained: bool, back: bool, turned: bool) -> LobeCells:
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
        i = i * TURN if turned else i
        one, other = _near(i, view, back)
        return i, np.where(cos_d > 0, 4 * cos_d * (other if turned else one) * solid, 0)

    weights = _weights(surface, theta, grained, directions, cell, first[-1])
    count = first[-1]
    every = np.bincount(cell.ravel(), solid.ravel(), count)
    tilt = np.exp(np.bincount(cell.ravel(), (solid * np.log(t)[:, None]).ravel(), count) / every)
    tilt[0] = 0.0  # the first cell lies about the normal
    place = np.arange(count) - np.repeat(first[:-1], spokes)
    vectors = _polar(np.arctan(tilt), 2 * np.pi * (place + 0.5) / np.repeat(spokes, spokes))
    return LobeCells(vectors, True, turned, every, theta, weights)


def _of_directions(surface: ColouredSurface, theta, grained: bool, back: bool) -> LobeCells:
    def grid(bands, sectors):
        at = 0.5 * np.pi * (np.arange(bands) + 0.5) / bands
        vectors = _polar(at[:, None], 2 * np.pi * (np.arange(sectors) + 0.5) / sectors)
        edge = np.cos(0.5 * np.pi * np.arange(bands + 1) / bands)
        return vectors, np.broadcast_to(((edge[:-1] - edge[1:]) * 2 * np.pi / sectors)[:, None], (bands, sectors))

    fine, solid = grid(FINE_BANDS, FINE_SECTORS)
    cell = (np.arange(FINE_BANDS) * BANDS // FINE_BANDS)[:, None] * SECTORS
    cell = cell + np.arange(FINE_SECTORS) * SECTORS // FINE_SECTORS

    def directions(view):
        return fine, solid * (1 - sum(_near(fine, view, back)))

    vectors, large = grid(BANDS, SECTORS)
    weights = _weights(surface, theta, grained, directions, cell, BANDS * SECTORS)
    return LobeCells(vectors.reshape(-1, 3), False, False, large.ravel(), theta, weights)


def _near(i, view, back: bool):
    """Shares of directions (..., 3) that are counted about the mirror direction, and about the light."""
    one = 1 - _belt(i, view)
    if not back:
        return one, 0.0
    other = 1 - _belt(i * TURN, view)
    either = one + other - one * other
    share = share_of_mirror_side(i, view, one, other)
    return either * share, either * (1 - share)


def _belt(i, view):
    """0 near the mirror direction, 1 far from it: the share of the quadrature over directions."""
    tilt = np.hypot(i[..., 0] + view[0], i[..., 1]) / np.maximum(i[..., 2] + view[2], 1e-9)
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
