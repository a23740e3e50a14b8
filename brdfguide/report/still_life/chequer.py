"""The floor: a chequer, a grey card on it, and the shade that objects throw, all in the light of the surroundings."""

from collections.abc import Sequence

import numpy as np

from ...records import dataclass
from .light_map import Lighting
from .standing import Thing

DARK, BRIGHT = 0.13, 0.30  # reflectance of the squares (ours)
SQUARE = 0.62  # side, in radii of the sphere
CARD = (0.04, 0.18, 0.90)  # reflectance of the fields of a photographer's card, black, grey and white, left to right
CARD_MIDDLE, CARD_HALF = (0.0, 1.55), (0.25, 0.45)  # x and z of its grey field; half its width and depth
EXTENT = 4.0  # of the map of shade, from its middle
TEXELS = 80
LEAST_SHARE = 3e-4  # of all light on level ground: a part of the sky that sends less throws no shade of its own


@dataclass(frozen=True, eq=False)
class Chequer:
    """Light (3,) that leaves a white floor in the open [radiance], and the share of it that objects leave."""

    white: np.ndarray
    shade: np.ndarray  # (texels, texels): row by z, column by x

    def radiance(self, x, z, wide, deep) -> np.ndarray:
        """(..., 3) at points, averaged over a rectangle of sides `wide` along x and `deep` along z."""
        waves = _wave(x, wide) * _wave(z, deep)
        albedo = 0.5 * (BRIGHT + DARK) + 0.5 * (BRIGHT - DARK) * waves
        for place, reflectance in enumerate(CARD):
            off = x - CARD_MIDDLE[0] - 2 * (place - 1) * CARD_HALF[0]
            share = _inside(off, CARD_HALF[0], wide) * _inside(z - CARD_MIDDLE[1], CARD_HALF[1], deep)
            albedo = albedo + share * (reflectance - albedo)
        return (albedo * self.open_to(x, z))[..., None] * self.white

    def open_to(self, x, z) -> np.ndarray:
        """Share of the light that objects leave there; 1 far away."""
        last = TEXELS - 1
        column = np.clip((np.asarray(x) + EXTENT) / (2 * EXTENT) * last, 0, last - 1e-3)
        row = np.clip((np.asarray(z) + EXTENT) / (2 * EXTENT) * last, 0, last - 1e-3)
        a, b = row.astype(int), column.astype(int)
        s, t = row - a, column - b
        flat = self.shade.ravel()
        place = a * TEXELS + b
        upper = flat[place] + t * (flat[place + 1] - flat[place])
        lower = flat[place + TEXELS] + t * (flat[place + TEXELS + 1] - flat[place + TEXELS])
        return upper + s * (lower - upper)


def floor_under(things: Sequence[Thing], around: Lighting) -> Chequer:
    """The floor in the light of what is above the horizon."""
    directions, sent = around.upper_cells()
    white = sent.sum(axis=0) / np.pi
    share = sent.mean(axis=1) / sent.mean(axis=1).sum()
    edge = np.linspace(-EXTENT, EXTENT, TEXELS)
    x, z = np.meshgrid(edge, edge)
    points = np.stack((x, np.full(x.shape, 1e-3), z), axis=-1).reshape(-1, 3)
    shade = np.ones(len(points))
    balls = [_Ball(points, thing) for thing in things]
    for each, part in zip(directions[share > LEAST_SHARE], share[share > LEAST_SHARE], strict=True):
        hidden = np.zeros(len(points), bool)
        for ball in balls:
            near = ball.may_hide(each)
            near = near[~hidden[near]]
            hidden[near] = ball.thing.blocks(points[near], np.broadcast_to(each, (len(near), 3)))
        shade -= part * hidden
    fade = np.clip((EXTENT - np.maximum(np.abs(x), np.abs(z))) / 1.0, 0, 1)  # no edge where the map ends
    return Chequer(white, _softened(1 - fade * (1 - np.maximum(shade, 0).reshape(x.shape))))


class _Ball:
    """The ball about an object, as points (n, 3) of the floor see it."""

    def __init__(self, points, thing: Thing):
        self.thing = thing
        self.toward = thing.middle - points
        self.beyond = np.sum(self.toward**2, axis=1) - (1.75 * thing.size) ** 2

    def may_hide(self, direction) -> np.ndarray:
        """Which points' rays pass it."""
        along = self.toward @ direction
        return np.flatnonzero((self.beyond < along**2) & (along > -1.75 * self.thing.size))


def _softened(shade) -> np.ndarray:
    """Three texels by three averaged 1-2-1, so that steps between the parts of the sky do not show."""
    for axis in (0, 1):
        padded = np.pad(shade, [(1, 1) if axis == k else (0, 0) for k in (0, 1)], mode="edge")
        low, high = (np.take(padded, np.arange(TEXELS) + k, axis=axis) for k in (0, 2))
        shade = 0.25 * (low + high) + 0.5 * shade
    return shade


def _wave(x, blur):
    """A square wave of +1 and -1 averaged over `blur`: the difference of its integral, a triangle."""
    half = 0.5 * np.maximum(blur, 1e-3)

    def integral(at):
        turn = np.mod(at / SQUARE, 2.0)
        return SQUARE * np.where(turn < 1, turn, 2 - turn)

    return (integral(x + half) - integral(x - half)) / (2 * half)


def _inside(off, half, blur):
    """Share of a stretch of length `blur` about `off` that lies within `half` of 0."""
    wide = np.maximum(blur, 1e-3)
    return np.clip((half - np.abs(off)) / wide + 0.5, 0, 1)
