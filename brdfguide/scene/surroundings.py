"""Surroundings as radiance in closed form: a studio, an overcast sky, a room with a window, even light.

Directions are of the world: z up, azimuth 0 the side that the surface faces (for a picture, the camera's), azimuth 90
to the camera's right. Nothing here is an image: what a quadrature, pruning and a preview ask is one function of
direction.

    uniform    L = 1
    overcast   L = Lz (1 + 2 sin γ)/3 above the horizon (CIE standard overcast sky, Moon and Spencer 1942: ISO 15469),
               below it a ground that reflects a fifth of the 7π/9 Lz that fall on it
    studio     a floor, a backdrop that darkens upward, and three soft boxes: the key, a strip and a rim light
    room       a box of walls with one window; what the walls send is what the window, taken for a small source, gives
               them, and an even part for light that went round
"""

from functools import cached_property, lru_cache
from math import cos, pi, radians, sin, tan

import numpy as np

from ..numerics import sphere
from ..physics import colour
from ..records import dataclass

KINDS = ("uniform", "studio", "overcast", "room")
GROUND_ALBEDO = 0.2  # of the ground under an overcast sky: grass and soil, ours
EDGE = 0.02  # tangent over which a soft box fades: half a hand's breadth at two metres, ours
# azimuth, elevation and half the width and height [deg] of the soft boxes, and how bright each is; ours
SOFT_BOXES = ((-50.0, 42.0, 24.0, 18.0, 9.0), (68.0, 34.0, 8.0, 30.0, 4.5), (165.0, 38.0, 26.0, 9.0, 6.0))
ROOM_LOW = np.array([-2.5, -2.0, -0.9])  # corners [m] from the object on its table: 5 by 4 by 2.7 m; ours
ROOM_HIGH = np.array([2.5, 2.0, 1.8])
WINDOW = ((-0.3, 1.5), (0.0, 1.4))  # its bounds along the wall and upward [m], in the wall at azimuth -90
BAR = 0.035  # half the width [m] of the cross of its frame
WALLS = {"wall": 0.6, "ceiling": 0.8, "floor": 0.25}  # diffuse reflectance: paint, white paint, wood; ours
ROUND = 0.03  # radiance of light that went round a room, over the window's; ours
TINTS = {
    "neutral": (1.0, 1.0, 1.0),
    "sky": (0.92, 1.0, 1.16),  # of linear sRGB, each scaled to luminance 1
    "earth": (1.12, 0.98, 0.78),
    "warm": (1.10, 0.98, 0.88),
}


@dataclass(frozen=True)
class Surroundings:
    """Light from all around; `irradiance` is what falls on a surface that faces its brightest side, relative to the
    lights of a scene."""

    kind: str = "studio"
    irradiance: float = 1.0
    up_deg: tuple[float, float] = (0.0, 0.0)  # zenith angle and azimuth of upward, in the frame of the object
    turn_deg: float = 0.0  # about upward

    def rgb(self, directions) -> np.ndarray:
        """Radiance (..., 3) in linear sRGB, of directions (..., 3) in the world; its luminance is `radiance`."""
        return self.irradiance / _brightest_side(self.kind) * self.relative_rgb(np.asarray(directions, float))

    def relative_rgb(self, directions) -> np.ndarray:
        """The same to a factor that is the same for all directions."""
        return _FORMS[self.kind](directions, 0.0)[..., None] * _tint_of(self.kind, directions)

    def radiance(self, directions, blur=0.0) -> np.ndarray:
        """Radiance (...) [irradiance/sr] of white light, of unit directions (..., 3) in the world.

        Its edges are averaged over `blur` (...) [rad], for a quadrature whose directions stand that far apart.
        """
        return self.irradiance / _brightest_side(self.kind) * _FORMS[self.kind](np.asarray(directions), blur)

    @cached_property
    def brightest(self) -> float:
        """The greatest radiance of any direction, in the unit of `radiance`."""
        return float(self.radiance(_all_directions()[0]).max())

    @cached_property
    def of_object(self) -> np.ndarray:
        """(3, 3) that turns a direction of the object's frame into one of the world."""
        theta, phi = (radians(angle) for angle in self.up_deg)
        up = np.array([sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)])
        # azimuth 0 is where the object's axis leans; of an object that stands upright, its own azimuth 0
        front = np.array([0.0, 0.0, 1.0]) if sin(theta) > 1e-6 else np.array([1.0, 0.0, 0.0])
        front = sphere.unit(front - (front @ up) * up)
        turn = radians(self.turn_deg)
        turned = np.array([[cos(turn), -sin(turn), 0.0], [sin(turn), cos(turn), 0.0], [0.0, 0.0, 1.0]])
        return turned @ np.stack([front, np.cross(up, front), up])

    def describe(self) -> str:
        """What it is and how bright."""
        name = {"uniform": "even light from all around", "overcast": "an overcast sky", "studio": "a studio"}
        return f"{name.get(self.kind, 'a room with a window')}, {self.irradiance:g}"


def surroundings_from_yaml(said) -> Surroundings:
    """Surroundings from their name alone, or from a group."""
    if isinstance(said, str):
        return Surroundings(said)
    up = {name: angles[0] for name, angles in said.get("up", {}).items()}
    return Surroundings(
        **{key: said[key] for key in ("kind", "irradiance", "turn_deg") if key in said},
        up_deg=(up.get("theta_deg", 0.0), up.get("phi_deg", 0.0)),
    )


def sensible_surroundings(values):
    """(key, sentence) of what the values of a scene contradict: surroundings once only, and one direction upward."""
    around = values.get("surroundings")
    if around is not None and values.get("environment"):
        yield "environment", "'environment' and 'surroundings' exclude each other: even light is surroundings: uniform"
    if isinstance(around, dict):
        for name, angles in around.get("up", {}).items():
            if len(set(angles)) > 1:
                yield f"surroundings.up.{name}", f"'surroundings.up.{name}' is a range; upward is one direction"


def _uniform(directions, _blur):
    return np.ones(directions.shape[:-1])


def _overcast(directions, blur):
    up = directions[..., 2]
    above = _share_above(up, blur)
    return above * (1 + 2 * np.maximum(up, 0)) / 3 + (1 - above) * (GROUND_ALBEDO * 7 / 9)


def _studio(directions, blur):
    up = directions[..., 2]
    above = _share_above(up, blur)
    wall = 0.12 + 0.30 * np.exp(np.minimum(-up, 0) / 0.35)
    floor = 0.15 + 0.4 * np.minimum(up, 0) ** 2  # lit by the boxes where it is near
    level = above * wall + (1 - above) * floor
    for frame, half, bright in _soft_boxes():
        level += bright * _soft_box(directions @ frame.astype(directions.dtype), half, blur)
    return level


def _share_above(up, blur):
    """How much of what is averaged over `blur` lies above the horizon."""
    return np.clip(up / np.maximum(blur, 1e-9) + 0.5, 0, 1)


def _covered(place, low: float, high: float, blur):
    """How much of a stretch of length `blur` about `place` lies between two bounds."""
    blur = np.maximum(blur, 1e-9)
    return np.maximum(np.minimum(high, place + blur / 2) - np.maximum(low, place - blur / 2), 0) / blur


@lru_cache(maxsize=1)
def _soft_boxes():
    """Of each box the directions to its middle, across and along it as columns, half its sides and its brightness."""
    found = []
    for azimuth, elevation, wide, high, bright in SOFT_BOXES:
        a, e = radians(azimuth), radians(elevation)
        centre = [cos(e) * cos(a), cos(e) * sin(a), sin(e)]
        along = [-sin(e) * cos(a), -sin(e) * sin(a), cos(e)]
        found.append(
            (np.array([centre, [-sin(a), cos(a), 0.0], along]).T, (tan(radians(wide)), tan(radians(high))), bright)
        )
    return found


def _soft_box(place, half, blur):
    """0..1: a rectangle with soft edges that is a quarter darker at its corners, as a lamp behind a cloth makes it."""
    ahead = np.maximum(place[..., 0], 1e-9)  # behind, nothing is within its sides
    x, y = np.abs(place[..., 1]) / ahead, np.abs(place[..., 2]) / ahead
    edge = np.maximum(blur / np.maximum(ahead, 0.1), EDGE)
    inside = _covered(x, -half[0], half[0], edge) * _covered(y, -half[1], half[1], edge)
    return inside * (1 - 0.125 * (np.minimum(x / half[0], 1) ** 2 + np.minimum(y / half[1], 1) ** 2))


def _room(directions, blur):
    with np.errstate(divide="ignore"):
        far = np.where(directions > 0, ROOM_HIGH, ROOM_LOW) / directions
    side = np.argmin(np.where(np.isfinite(far), far, np.inf), axis=-1)
    reach = np.take_along_axis(far, side[..., None], axis=-1)
    place = directions * reach  # [m] where the line of sight meets a wall
    (left, right), (sill, top) = WINDOW
    at = np.array([(left + right) / 2, ROOM_LOW[1], (sill + top) / 2])
    area = (right - left) * (top - sill)
    from_window = place - at
    distance2 = np.sum(from_window**2, axis=-1)
    leaves = from_window[..., 1]  # times the cosine at the window
    arrives = np.abs(np.take_along_axis(from_window, side[..., None], axis=-1)[..., 0])  # and at the wall
    given = area * leaves * arrives / (distance2 + area / pi) ** 2
    below = directions[..., 2] < 0
    albedo = np.select([side < 2, below], [WALLS["wall"], WALLS["floor"]], WALLS["ceiling"])
    level = albedo * (given / pi + ROUND)
    pane = _pane(directions, blur)
    # the sky outside, an overcast one, above houses up to six degrees
    outside = np.where(directions[..., 2] > sin(radians(6.0)), (1 + 2 * directions[..., 2]) / 1.8, 0.15)
    return pane * outside + (1 - pane) * level


def _pane(directions, blur):
    """How much of a direction leads out of the window of the room: between its sides and past the bars of its frame."""
    (left, right), (sill, top) = WINDOW
    toward = np.maximum(-directions[..., 1], 1e-9) / -ROOM_LOW[1]
    x, z, blur = directions[..., 0] / toward, directions[..., 2] / toward, blur / np.maximum(toward, 0.05)
    share = 1.0
    for place, low, high in ((x, left, right), (z, sill, top)):
        bar = (low + high) / 2
        share = share * (_covered(place, low, high, blur) - _covered(place, bar - BAR, bar + BAR, blur))
    return np.where(directions[..., 1] < 0, share, 0.0)


_FORMS = {"uniform": _uniform, "overcast": _overcast, "studio": _studio, "room": _room}


def _tint_of(kind: str, directions) -> np.ndarray:
    """Linear sRGB (..., 3) of luminance 1: a cool sky, a warm floor, ground and walls."""
    named = {name: np.array(tint) / (np.array(tint) @ colour.LUMINANCE) for name, tint in TINTS.items()}
    if kind == "uniform":
        return named["neutral"]
    if kind == "studio":
        return np.where(directions[..., 2:] >= 0, named["neutral"], named["warm"])
    cool = _pane(directions, 0.0) > 0.5 if kind == "room" else directions[..., 2] >= 0
    return np.where(cool[..., None], named["sky"], named["earth" if kind == "overcast" else "warm"])


@lru_cache(maxsize=1)
def _all_directions(rows: int = 120) -> tuple[np.ndarray, float]:
    """Directions all around that share the sphere evenly, and the solid angle of each."""
    height = (np.arange(rows) + 0.5) / rows * 2 - 1
    azimuth = (np.arange(2 * rows) + 0.5) * pi / rows
    grid = sphere.from_angles(height[:, None], azimuth[None, :]).reshape(-1, 3)
    return grid, 4 * pi / len(grid)


@lru_cache(maxsize=len(KINDS))
def _brightest_side(kind: str) -> float:
    """The greatest irradiance that any plane receives, of what `_FORMS` gives."""
    if kind == "uniform":
        return pi
    directions, share = _all_directions()
    level = _FORMS[kind](directions, 0.0) * share
    best, received = np.array([0.0, 0.0, 1.0]), 0.0
    for step in (1.0, 0.08):  # all sides, then those about the best
        sides = np.concatenate([sphere.cap(best[None], step * pi, 200)[0], best[None]])
        each = np.maximum(sides @ directions.T, 0.0) @ level
        best, received = sides[np.argmax(each)], float(each.max())
    return received
