"""A surface with a grain on a sphere, a disc and a bent sheet: pictures in which the grain itself is seen.

    sphere   grooves along circles of latitude about the upward axis: the highlight is a streak along a meridian
    disc     grooves round its centre, as on a pan's bottom or a record: two bow-ties of light
    sheet    straight grooves from left to right: a streak from top to bottom

Each pixel has a frame whose azimuth 0 lies so that the surface's `axis` is across the grooves. Sky and ground are
tabulated as for a surface without a grain, over one angle more: that between the line of sight and the sample's azimuth
0, in steps over half a turn.
"""

from dataclasses import replace

import numpy as np

from ..exporters.exporter import ColouredSurface
from ..models.looks import turns
from ..physics.geometry import Geometry
from ..records import dataclass

TURNS = 16  # azimuths of the line of sight in the sample's frame, over half a turn
THETAS = 28  # angles of the view from the normal
ROLLS = 61
UP = np.array([0.0, 1.0, 0.0])
DISC_TILT_DEG = 28.0  # of the disc's normal up from the camera


@dataclass(frozen=True)
class GrainedView:
    """Normals of the pixels of one picture, and directions across the grooves there; x right, y up, z to the camera."""

    normal: np.ndarray  # (height, width, 3)
    across: np.ndarray  # (height, width, 3), in the surface
    covered: np.ndarray  # (height, width), 0..1: share of the pixel that the object covers


def has_grain(surface: ColouredSurface) -> bool:
    """Whether a surface is drawn with a grain: it changes as it is turned, about one axis."""
    return turns(surface) and any("axis" in term.model.defaults() for term in surface.model.terms)


def grained_view(size: int) -> GrainedView:
    """A sphere to the left, a disc to the right, a bent sheet below."""
    y, x = np.mgrid[0:size, 0:size] + 0.5
    x, y = x / size, 1 - y / size
    parts = (_sheet(x, y, size), _disc(x, y, size), _sphere(x, y, size))
    normal, across, covered = parts[0]
    for more_normal, more_across, more in parts[1:]:
        on = (more > 0)[..., None]
        normal, across = np.where(on, more_normal, normal), np.where(on, more_across, across)
        covered = np.maximum(covered, more)
    return GrainedView(normal, across, covered)


def _sphere(x, y, size: int, radius: float = 0.235):
    sx, sy = (x - 0.265) / radius, (y - 0.68) / radius
    rim = np.hypot(sx, sy)
    inside = np.minimum(1, 0.9999 / np.maximum(rim, 1e-9))
    sx, sy = sx * inside, sy * inside
    normal = np.stack((sx, sy, np.sqrt(1 - sx**2 - sy**2)), axis=-1)
    return normal, _along_surface(normal, UP), np.clip((1 - rim) * radius * size + 0.5, 0, 1)


def _disc(x, y, size: int, radius: float = 0.225):
    tilt = np.radians(DISC_TILT_DEG)
    normal = np.array([0.0, np.sin(tilt), np.cos(tilt)])
    right, up = np.array([1.0, 0.0, 0.0]), np.array([0.0, np.cos(tilt), -np.sin(tilt)])
    u, v = (x - 0.745) / radius, (y - 0.68) / (radius * np.cos(tilt))
    rim = np.hypot(u, v)
    outward = (u / np.maximum(rim, 1e-6))[..., None] * right + (v / np.maximum(rim, 1e-6))[..., None] * up
    edge = np.clip((1 - rim) * radius * np.cos(tilt) * size + 0.5, 0, 1)
    hole = np.clip((rim - 0.06) * radius * size + 0.5, 0, 1)
    return np.broadcast_to(normal, outward.shape), outward, edge * hole


def _sheet(x, y, size: int):
    u, v = (x - 0.06) / 0.88, (y - 0.06) / 0.3
    tilt, bend = np.radians(-12 + 90 * np.clip(v, 0, 1)), np.radians(50 * (u - 0.5))
    normal = np.stack((np.sin(bend) * np.cos(tilt), np.sin(tilt), np.cos(bend) * np.cos(tilt)), axis=-1)

    def edge(t, length):
        return np.clip(t * length * size + 0.5, 0, 1) * np.clip((1 - t) * length * size + 0.5, 0, 1)

    return normal, _along_surface(normal, UP), edge(u, 0.88) * edge(v, 0.3)


def _along_surface(normal, direction):
    """What of a direction lies in the surface, of length 1."""
    found = direction - np.sum(normal * direction, axis=-1, keepdims=True) * normal
    length = np.linalg.norm(found, axis=-1, keepdims=True)
    return found / np.maximum(length, 1e-9)


def frames(surface: ColouredSurface, normal, across) -> np.ndarray:
    """(pixels, 3, 3): x and y of the sample's frame and the normal; `axis` lies along `across`."""
    axis = grain_axis(surface)
    beside = np.cross(normal, across)
    x = np.cos(axis) * across - np.sin(axis) * beside
    return np.stack((x, np.cross(normal, x), normal), axis=1)


def grain_axis(surface: ColouredSurface) -> float:
    """Azimuth of the grain [rad] in the sample's frame."""
    values = [surface.values_of(term) for term in surface.model.terms if "axis" in term.model.defaults()]
    return float(np.ravel(values[0]["axis"])[0])


def sample_turned(geom: Geometry, radians: float) -> Geometry:
    """The same directions on a sample that was turned the other way."""
    return replace(geom, directions=replace(geom.directions, phi_i_deg=geom.phi_i_deg + np.degrees(radians)))


def place_in_turns(surface: ColouredSurface, normal, frame) -> np.ndarray:
    """(pixels,) the azimuth of the line of sight in the sample's frame, in steps of the table; on the right of the
    picture that of the mirror image, for which the table stands there."""
    azimuth = np.arctan2(frame[:, 1, 2], frame[:, 0, 2])  # the camera looks along -z
    mirrored = 2 * grain_axis(surface) - azimuth
    return np.remainder(np.where(normal[:, 0] > 0, mirrored, azimuth), np.pi) / np.pi * TURNS
