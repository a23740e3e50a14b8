"""Surfaces found among many answers by how they look, and those that look the same.

How far two of them lie apart is S, the rms difference in lightness of two spheres [L*] (`physics.seen`), under lamps
all around, or over the directions that a scene asks for.
"""

import sqlite3

import numpy as np

from ..errors import InputError
from ..models.surface import Surface
from ..physics import seen
from ..records import dataclass
from ..scene.radiance import sample
from ..scene.scene import Scene
from .described_rows import LOOKS, look_vector

PIXELS, SEED = 20000, 25  # of a scene, for where its directions lie
NARROW = 0.01  # rad, of the lobe that a scene's directions are drawn for
TENTH = 10  # the neighbour whose distance says how crowded the place is
BLOCK = 512  # surfaces compared at once with all


@dataclass(frozen=True, eq=False)
class AllLooks:
    """Lightness of all answers at the directions of LOOKS, and what each direction counts."""

    keys: list[str]
    lightness: np.ndarray  # (answers, directions, 3) [L*]
    weights: np.ndarray  # (directions,), whose sum is 1

    def from_one(self, shown: np.ndarray) -> np.ndarray:
        """S [L*] between each of them and one (directions, colours)."""
        counts = np.repeat(self.weights / 3, 3)
        at = np.broadcast_to(shown, self.lightness.shape[1:]).astype(np.float32).ravel()
        each = self.lightness.reshape(len(self.keys), -1)
        blocks = (each[begin : begin + BLOCK] - at for begin in range(0, len(each), BLOCK))
        return np.sqrt(np.concatenate([np.square(block, out=block) @ counts for block in blocks] or [counts[:0]]))

    def flat(self) -> np.ndarray:
        """(answers, 3 directions): the distance of two rows is S."""
        scaled = self.lightness * np.sqrt(self.weights / 3)[None, :, None]
        return scaled.reshape(len(self.keys), -1).astype(np.float32)


def all_looks(base: sqlite3.Connection, scene: Scene | None = None) -> AllLooks:
    """Of every answer, on a sphere under lamps all around, or at the directions that a scene asks for."""
    rows = base.execute("SELECT key, colours, vector FROM look ORDER BY key").fetchall()
    count = len(seen.sphere(LOOKS).weights)
    lightness = np.empty((len(rows), count, 3), np.float32)
    for colours in {each for _, each, _ in rows}:  # 3, or 1 of a grey one
        places = [place for place, row in enumerate(rows) if row[1] == colours]
        read = np.frombuffer(b"".join(rows[place][2] for place in places), np.float32)
        lightness[places] = read.reshape(-1, count, colours)
    weights = seen.sphere(LOOKS).weights if scene is None else scene_weights(scene)
    return AllLooks([key for key, *_ in rows], np.nan_to_num(lightness), (weights / weights.sum()).astype(np.float32))


def scene_weights(scene: Scene) -> np.ndarray:
    """How much of a scene's picture each of the directions of LOOKS stands for: that of the pixels nearest to it.

    Near is meant as these directions are spread: evenly in √θh, θd and φd. Raises InputError for a scene of which no
    pixel lies within 80 degrees.
    """
    picture, place = sample(scene, PIXELS, SEED, NARROW), seen.sphere(LOOKS).geom
    geom, factor, pixel = picture.lit
    counted = np.flatnonzero(seen.counts(geom.directions)[:, 0] & geom.lit[:, 0])
    weights, there = np.zeros(len(place)), _even(place)
    for begin in range(0, len(counted), BLOCK):
        some = counted[begin : begin + BLOCK]
        close = np.argmin(np.sum((_even(geom[some])[:, None] - there[None]) ** 2, axis=2), axis=1)
        np.add.at(weights, close, picture.weights[pixel[some]] * factor[some])
    if not weights.sum() > 0:
        raise InputError("the scene asks for no direction within 80 degrees of the normal")
    return weights


def _even(geom) -> np.ndarray:
    """(samples, 3) coordinates in which the cells of `seen.sphere` are alike."""
    theta_h, theta_d = np.arctan(np.sqrt(geom.tan2_h[:, 0])), np.arccos(np.clip(geom.cos_d[:, 0], -1, 1))
    # cos θi = cos θd cos θh - sin θd cos φd sin θh
    with np.errstate(invalid="ignore", divide="ignore"):
        cos_phi = (np.cos(theta_d) * np.cos(theta_h) - geom.cos_i[:, 0]) / (np.sin(theta_d) * np.sin(theta_h))
    phi_d = np.arccos(np.clip(np.nan_to_num(cos_phi), -1, 1))
    ends = np.pi / 2, np.pi / 2, np.pi
    parts = np.sqrt(theta_h / ends[0]), theta_d / ends[1], phi_d / ends[2]
    return np.stack([part * cells for part, cells in zip(parts, LOOKS, strict=True)], axis=1)


@dataclass(frozen=True)
class Near:
    """Answers by how far they look from one surface."""

    distance: dict[str, float]  # S [L*] by key
    tenth: float | None  # that of the tenth nearest: how crowded the place is


def nearest(looks: AllLooks, surface: Surface) -> Near:
    """Every answer's distance from a surface."""
    apart = looks.from_one(look_vector(surface))
    order = np.sort(apart)
    tenth = float(order[TENTH - 1]) if len(order) >= TENTH else None
    return Near(dict(zip(looks.keys, map(float, apart), strict=True)), tenth)


def alike_groups(looks: AllLooks, doubts: dict[str, float | None], most: float = seen.ALIKE) -> list[list[str]]:
    """Groups of answers that look the same: closer than `most` [L*], a step that is just visible, and than two standard
    errors of both fits.

    The first of a group stands for it: the one nearest to the others. Nothing is deleted.
    """
    flat, keys = looks.flat(), looks.keys
    doubt = np.array([doubts.get(key) or 0.0 for key in keys])
    norms = np.einsum("nd,nd->n", flat, flat)
    root = list(range(len(keys)))

    def of(place: int) -> int:
        while root[place] != place:
            root[place] = root[root[place]]
            place = root[place]
        return place

    for begin in range(0, len(keys), BLOCK):
        block = slice(begin, begin + BLOCK)
        squares = norms[block, None] + norms[None] - 2 * flat[block] @ flat.T
        limit = np.minimum(most, 2 * np.hypot(doubt[block, None], doubt[None]))
        for one, other in zip(*np.nonzero(squares < limit**2), strict=True):
            if begin + one < other:
                root[of(begin + one)] = of(int(other))
    groups: dict[int, list[int]] = {}
    for place in range(len(keys)):
        groups.setdefault(of(place), []).append(place)
    return [[keys[place] for place in _from_the_middle(flat, each)] for each in groups.values() if len(each) > 1]


def _from_the_middle(flat: np.ndarray, places: list[int]) -> list[int]:
    middle = flat[places].mean(axis=0)
    return sorted(places, key=lambda place: float(np.sum((flat[place] - middle) ** 2)))
