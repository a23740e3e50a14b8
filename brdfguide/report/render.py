"""A surface on a sphere and on a bent sheet, under a small sun and a sky with a horizon, in linear light.

The camera looks level and from afar, so that the horizon's reflection runs along the sphere's equator from normal
incidence in the middle to grazing at the rim: there a rough surface shows it sharper (Westin et al. 2004, Figure 10).

Sky and ground depend on height above the horizon alone. A level view has but two angles then, θr and the roll ψ of the
upward direction about the line of sight, and the light reflected is tabulated over these by quadrature over all half
vectors, closer and closer to the normal. Nothing is drawn at random. The sun is a disc; a mirror shows all of it sharp.
"""

import numpy as np

from ..exporters.exporter import ColouredSurface
from ..physics import colour
from ..physics.geometry import Geometry
from ..records import dataclass
from . import grained_view as grain
from .grained_view import GrainedView, frames, grained_view, has_grain, place_in_turns, sample_turned
from .toward_light import TURN, share_of_mirror_side, shines_back

ZENITH = np.array([0.25, 0.42, 0.78])  # linear sRGB radiance, 1 = white at the horizon
HORIZON = np.array([1.0, 0.92, 0.82])
GROUND = np.array([0.16, 0.13, 0.10])
SCALE_HEIGHT = 0.25  # sine of the elevation over which the sky's glow falls to 1/e
SUN = np.array([4.2, 3.9, 3.4])  # irradiance on a surface that faces it; the sky gives about 2 to level ground
SUN_RADIUS = 0.012  # [rad], two and a half times the real one, to cover a pixel or two in a mirror
# elevation, azimuth from the camera to its right
LIGHTS_DEG = {"side": (22.0, 100.0), "front": (35.0, 20.0), "back": (14.0, 150.0)}
EXPOSURE = 0.55
THETAS = 56  # of the table of skylight: angles of the view from the normal
ROLLS = 121  # of the normal about the line of sight
RINGS = 56  # of the quadrature over half vectors
SPOKES = 96


@dataclass(frozen=True)
class View:
    """Normals and kinds of the pixels of one picture; x right, y up, z toward the camera."""

    normal: np.ndarray  # (height, width, 3)
    covered: np.ndarray  # (height, width), 0..1: share of the pixel that the object covers


def sky(height):
    """Radiance (..., 3) from a direction whose elevation has this sine; the ground below the horizon."""
    height = np.asarray(height)[..., None]
    glow = np.exp(-np.maximum(height, 0) / SCALE_HEIGHT)
    return np.where(height >= 0, ZENITH + (HORIZON - ZENITH) * glow, GROUND)


def sun_direction(light: str) -> np.ndarray:
    elevation, azimuth = np.radians(LIGHTS_DEG[light])
    return np.array([np.cos(elevation) * np.sin(azimuth), np.sin(elevation), np.cos(elevation) * np.cos(azimuth)])


def view(size: int) -> View:
    """A sphere above, a bent sheet below: facing the camera at its lower edge, nearly edge-on at its upper."""
    y, x = np.mgrid[0:size, 0:size] + 0.5
    x, y = x / size, 1 - y / size
    radius = 0.29
    sx, sy = (x - 0.5) / radius, (y - 0.66) / radius
    rim = np.hypot(sx, sy)
    sphere = np.clip((1 - rim) * radius * size + 0.5, 0, 1)
    inside = np.minimum(1, 0.9999 / np.maximum(rim, 1e-9))
    sx, sy = sx * inside, sy * inside
    sphere_normal = np.stack((sx, sy, np.sqrt(1 - sx**2 - sy**2)), axis=-1)
    u, v = (x - 0.08) / 0.84, (y - 0.05) / 0.24
    tilt, bend = np.radians(-12 + 100 * np.clip(v, 0, 1)), np.radians(50 * (u - 0.5))
    sheet_normal = np.stack((np.sin(bend) * np.cos(tilt), np.sin(tilt), np.cos(bend) * np.cos(tilt)), axis=-1)

    def edge(t, length):
        return np.clip(t * length * size + 0.5, 0, 1) * np.clip((1 - t) * length * size + 0.5, 0, 1)

    sheet = edge(u, 0.84) * edge(v, 0.24)
    return View(np.where((sphere > 0)[..., None], sphere_normal, sheet_normal), np.maximum(sphere, sheet))


def render(surface: ColouredSurface, size: int = 512, light: str = "side", progress=None) -> np.ndarray:
    """Radiance in linear sRGB, (size, size, 3): the object before sky and ground."""
    grained = has_grain(surface)
    canvas = grained_view(size) if grained else view(size)
    y = 1 - (np.arange(size) + 0.5) / size
    behind = np.broadcast_to(sky(0.9 * (y - 0.66))[:, None, :], (size, size, 3))
    on = canvas.covered > 0
    normal = canvas.normal[on]
    frame = frames(surface, normal, canvas.across[on]) if isinstance(canvas, GrainedView) else None
    around = around_of(surface, normal, progress) if frame is None else _around_grain(surface, normal, frame, progress)
    image = np.array(behind)
    sun = sun_direction(light)
    lit = around + sun_of(surface, normal, sun, frame) + mirror_of(surface, normal, sun)
    share = canvas.covered[on][:, None]
    image[on] = share * lit + (1 - share) * image[on]
    return image


def around_of(surface: ColouredSurface, normal, progress=None) -> np.ndarray:
    """Sky and ground reflected by the finite part, (pixels, 3), from a table over θr and roll."""
    theta = 0.5 * np.pi * (1 - (1 - np.linspace(0, 1, THETAS)) ** 1.5)
    theta[-1] = np.radians(89.6)
    roll = np.sinh(np.linspace(-1, 1, ROLLS) * 6) / np.sinh(6) * 0.5 * np.pi
    table = np.empty((THETAS, ROLLS, 3))
    for place, each in enumerate(theta):
        table[place] = _reflected_sky(surface, each, roll)
        if progress:
            progress((place + 1) / THETAS)
    theta_r = np.arccos(np.clip(normal[:, 2], 0, 1))
    # roll of the normal about the line of sight: 0 along the horizon
    up = np.arctan2(normal[:, 1], np.abs(normal[:, 0]))
    return _interpolate(table, np.interp(theta_r, theta, np.arange(THETAS)), np.interp(up, roll, np.arange(ROLLS)))


def _around_grain(surface: ColouredSurface, normal, frame, progress=None) -> np.ndarray:
    """The same of a surface with a grain: a table for each azimuth of the line of sight in the sample's frame."""
    theta = 0.5 * np.pi * (1 - (1 - np.linspace(0, 1, grain.THETAS)) ** 1.5)
    theta[-1] = np.radians(89.6)
    roll = np.sinh(np.linspace(-1, 1, grain.ROLLS) * 6) / np.sinh(6) * 0.5 * np.pi
    count = grain.TURNS
    table = np.empty((count, len(theta), len(roll), 3))
    for turn in range(count):
        for place, each in enumerate(theta):
            table[turn, place] = _reflected_sky(surface, each, roll, np.pi * turn / count)
        if progress:
            progress((turn + 1) / count)
    row = np.interp(np.arccos(np.clip(normal[:, 2], 0, 1)), theta, np.arange(len(theta)))
    column = np.interp(np.arctan2(normal[:, 1], np.abs(normal[:, 0])), roll, np.arange(len(roll)))
    at = place_in_turns(surface, normal, frame)
    low = np.floor(at).astype(int)
    share = (at - low)[:, None]
    found = np.empty((len(normal), 3))
    for turn in range(count):
        here = low % count == turn
        one, other = (_interpolate(table[k % count], row[here], column[here]) for k in (turn, turn + 1))
        found[here] = (1 - share[here]) * one + share[here] * other
    return found


def _reflected_sky(surface: ColouredSurface, theta_r: float, roll, turn: float = 0.0) -> np.ndarray:
    """(rolls, 3): ∫ f L cos θi dω by rings of half vectors, closer and closer to the normal; the view at azimuth `turn`
    [rad] of the sample.

    dω_i = 4 cos d dω_h,  dω_h = t dt dφ/(1 + t²)^{3/2},  t = tan of the half vector's tilt, in even steps of ln t.
    """
    log_t = np.linspace(np.log(3e-4), np.log(40.0), RINGS + 1)
    t = np.exp(0.5 * (log_t[1:] + log_t[:-1]))[:, None]
    phi = 2 * np.pi / SPOKES * (np.arange(SPOKES) + 0.5 + 0.618 * np.arange(RINGS)[:, None])
    hz = 1 / np.sqrt(1 + t * t)
    half = np.stack(np.broadcast_arrays(t * hz * np.cos(phi), t * hz * np.sin(phi), hz), axis=-1).reshape(-1, 3)
    step = np.broadcast_to(t * t * hz**3 * (log_t[1] - log_t[0]) * 2 * np.pi / SPOKES, phi.shape).ravel()
    r = np.array([np.sin(theta_r), 0.0, np.cos(theta_r)])
    cos_d = half @ r
    i = 2 * cos_d[:, None] * half - r
    good = (cos_d > 0) & (i[:, 2] > 1e-6)
    i, weight = i[good], (4 * cos_d * step)[good] * i[good, 2]
    if shines_back(surface):  # the same about the light, each direction's share to whichever it is near
        share = share_of_mirror_side(i, r)
        i, weight = np.concatenate((i, i * TURN)), np.concatenate((share * weight, share * weight))
    geom = Geometry.from_vectors(i, r)
    f = surface.rgb(sample_turned(geom, turn) if turn else geom) * weight[:, None]
    # upward direction in the frame of the normal: across the line of sight, rolled by ψ from the plane of incidence
    up = np.sin(roll)[:, None] * np.array([-np.cos(theta_r), 0.0, np.sin(theta_r)]) + np.cos(roll)[:, None] * np.array(
        [0.0, 1.0, 0.0]
    )
    height = i @ up.T
    glow = np.where(height >= 0, np.exp(-np.maximum(height, 0) / SCALE_HEIGHT), 0)
    above = (height >= 0).astype(float)
    total = f.sum(axis=0)
    over = above.T @ f
    return ZENITH * over + (HORIZON - ZENITH) * (glow.T @ f) + GROUND * (total - over)


def sun_of(surface: ColouredSurface, normal, sun, frame=None) -> np.ndarray:
    """The sun reflected by the finite part, (pixels, 3): a disc, divided finely where a narrow lobe sees its parts; in
    the sample's own `frame` (pixels, 3, 3) where it has a grain."""
    facing = normal @ sun
    mirrored = 2 * normal[:, 2:] * normal - np.array([0.0, 0.0, 1.0])
    near = mirrored @ sun > np.cos(8 * SUN_RADIUS)
    out = np.zeros(normal.shape)
    for rows_, count in ((np.flatnonzero(~near & (facing > 0)), 1), (np.flatnonzero(near), 91)):
        disc = _disc(sun, count)
        for block in np.array_split(rows_, max(1, rows_.size * count // 60_000 + 1)):
            if not block.size:
                continue
            i, r, cos_i = _local(normal[block], disc, None if frame is None else frame[block])
            f = surface.rgb(Geometry.from_vectors(i, r)).reshape(cos_i.shape + (3,))
            out[block] = SUN * np.mean(f * np.maximum(cos_i, 0)[..., None], axis=1)
    return out


def mirror_of(surface: ColouredSurface, normal, sun) -> np.ndarray:
    """The sharp image that a mirror term shows: sky, ground and the disc of the sun."""
    if not surface.model.has_mirror:
        return np.zeros(normal.shape)
    cos = np.clip(normal[:, 2], 1e-6, 1)
    table = np.linspace(0, 89.99, 400)
    share = surface.mirror_rgb(Geometry.from_degrees(table, 0.0, table, 180.0))
    share = np.stack([np.interp(np.degrees(np.arccos(cos)), table, share[:, c]) for c in range(3)], axis=-1)
    to = 2 * cos[:, None] * normal - np.array([0.0, 0.0, 1.0])
    disc = (to @ sun > np.cos(SUN_RADIUS))[:, None] * SUN / (np.pi * SUN_RADIUS**2)
    return share * (sky(to[:, 1]) + disc)


def _local(normal, directions, frame=None):
    """Directions (pixels·directions, 3) and camera in each normal's frame, and their cosines (pixels, directions)."""
    camera = np.array([0.0, 0.0, 1.0])
    if frame is None:
        x = np.cross(normal, np.where(np.abs(normal[:, :1]) < 0.7, [[1.0, 0, 0]], [[0, 1.0, 0]]))
        x /= np.linalg.norm(x, axis=1)[:, None]
        frame = np.stack((x, np.cross(normal, x), normal), axis=1)
    i = np.einsum("pab,db->pda", frame, directions)
    r = np.broadcast_to((frame @ camera)[:, None, :], i.shape)
    return i.reshape(-1, 3), r.reshape(-1, 3), i[..., 2]


def _disc(sun, count):
    """Directions spread evenly over the sun's disc (sunflower spiral)."""
    across = np.cross(sun, [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    turn = 2.399963 * np.arange(count)
    far = SUN_RADIUS * np.sqrt((np.arange(count) + 0.5) / count) * (count > 1)
    points = sun + far[:, None] * (np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * np.cross(across, sun))
    return points / np.linalg.norm(points, axis=1)[:, None]


def _interpolate(table, row, column):
    """Bilinear values of a table at fractional places, (pixels, 3)."""
    a, b = np.minimum(row.astype(int), table.shape[0] - 2), np.minimum(column.astype(int), table.shape[1] - 2)
    s, t = (row - a)[:, None], (column - b)[:, None]
    return (1 - s) * ((1 - t) * table[a, b] + t * table[a, b + 1]) + s * (
        (1 - t) * table[a + 1, b] + t * table[a + 1, b + 1]
    )


def tone(radiance, exposure: float = EXPOSURE) -> np.ndarray:
    """Display values 0..1: exposed, rolled off smoothly above middle light, sRGB-coded."""
    x = np.maximum(radiance, 0) * exposure
    rolled = np.where(x < 0.5, x, 1 - 0.25 / np.maximum(x, 0.5))
    return colour.encoded(rolled)
