"""Figures 3, 6, 8, 10 and 12 of the guide, rendered; and what its text says of each as numbers on their pixels."""

import numpy as np

from ... import exporters, models
from ...data.measurement import Measurement
from ...fitting import fit
from ...models.surface import Surface
from ...physics.colour import luminance
from ...records import dataclass
from .. import render
from ..figures.spheres import noticeable_steps
from . import meshes
from .meshes import Mesh
from .tracer import Body, Camera, Sun, Traced, traced

TITLES = {
    3: "Rough aluminium at two viewing angles",
    6: "Off-white rough plastic by two models",
    8: "Paper by two models under a sunset, from above and near grazing",
    10: "A nearly smooth metal pot, as a mirror and by He-Torrance",
    12: "Metallic paint by Lafortune's model under a clear coat",
}
# figure -> the sample in examples/ that it needs
NEEDS = {3: "rough_aluminium.csv", 6: "rough_plastic.csv", 8: "white_paper.csv", 12: "metallic_paint.csv"}
GREY = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.3}}
DARK = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.03}}
WHITE = {"type": "diffuse", "reflectance": {"type": "rgb", "value": 0.85}}
COAT_INDEX = 1.5  # of clear lacquer
FENCE, POST = -3.0, 0.25  # where the fence of Figure 3 stands, and the width of its posts and gaps
SIZE, SAMPLES = 220, 64  # pixels of a panel's width, paths a pixel


@dataclass(frozen=True, eq=False)
class Rendering:
    """Panels with their names, and claims: what the guide says, and the number that these pixels give."""

    panels: list[tuple[str, np.ndarray]]
    claims: list[tuple[str, float]]


def day(directions) -> np.ndarray:
    """The preview's sky and ground."""
    return render.sky(directions[..., 1])


def sunset(directions) -> np.ndarray:
    """A golden glow about the horizon where the sun stands (ours), a dim blue above, dark ground."""
    height = directions[..., 1]
    toward = np.clip(-directions[..., 2], 0, 1) ** 2
    glow = np.exp(-np.maximum(height, 0) / 0.22) * (0.35 + 0.9 * toward)
    up = np.array([0.10, 0.14, 0.26]) + glow[..., None] * np.array([1.5, 0.78, 0.28])
    return np.where(height[..., None] >= 0, up, np.array([0.09, 0.07, 0.05]))


def rendering(number: int, measurement: Measurement | None, size: int = SIZE, samples: int = SAMPLES) -> Rendering:
    """One of the five. Raises InputError without Mitsuba."""
    made = {3: _aluminium, 6: _plastic, 8: _paper, 12: _paint}
    return _pot(size, samples) if number == 10 else made[number](measurement, size, samples)


def plate(half_x: float, near: float, far: float, height: float = 0.0) -> Mesh:
    """A level rectangle."""

    def place(u, v):
        return np.stack((half_x * v, height + 0 * u, u), axis=-1)

    return meshes.surface_mesh(place, np.linspace(near, far, 2), np.linspace(-1, 1, 2))


def upright(left: float, right: float, low: float, high: float, z: float) -> Mesh:
    """A standing rectangle."""

    def place(u, v):
        return np.stack((v, u, z + 0 * u), axis=-1)

    return meshes.surface_mesh(place, np.linspace(low, high, 2), np.linspace(left, right, 2))


def fitted(name: str, measurement: Measurement, **fixed: float):
    """A model as the guide's figures fit it: every direction alike."""
    found = fit.fit(models.get(name), measurement, fit.FitOptions(fixed=fixed, weights="none"))
    return exporters.coloured(found.surface.channel(0), name)


def _aluminium(measurement, size: int, samples: int) -> Rendering:
    """A plate with a fence of white posts behind it: the mirror image of the posts shows toward grazing."""
    index = {"he-torrance.n": 0.958, "he-torrance.k": 6.69}
    surface = fitted("lambertian+he-torrance", measurement, **index)
    posts = [upright(x, x + POST, 0.0, 1.6, FENCE) for x in np.arange(-2.5, 2.5, 2 * POST)]
    board = [upright(-3, 3, 0, 1.6, FENCE - 0.05)]
    bodies = [Body([plate(3.0, FENCE, 3.0)], surface), Body(posts, WHITE), Body(board, DARK)]
    sun = Sun(40, 35, (2.0, 1.9, 1.7))  # behind the camera: the posts are lit, and throw no shadow on the plate
    panels, claims = [], []
    for angle in (50.0, 80.0):
        place = np.radians(angle)
        camera = Camera((0.0, 7 * np.cos(place), 7 * np.sin(place) - 1.6), (0.0, 0.0, -1.6), 26)
        made = traced(bodies, camera, day, sun, (size, size), samples)
        panels.append((f"seen at {angle:g}° from the normal", made.radiance))
        claims.append((f"contrast of the posts' mirror image over their own at {angle:g}°", _image(made, camera)))
    return Rendering(panels, claims)


def _image(made: Traced, camera: Camera) -> float:
    """Contrast of the posts in the plate, half a unit to one and a half before them, over their own: 1 in a mirror, 0
    if matt. A mirrored ray goes on in x and z as if there were no plate, so that its post is known.
    """
    x, y, z = np.moveaxis(camera.rays(made.body.shape), -1, 0)
    across = camera.eye[0] + (FENCE - camera.eye[2]) * x / z  # where the ray meets the plane of the fence
    before = camera.eye[2] - camera.eye[1] * z / np.minimum(y, -1e-9) - FENCE  # of the place on the plate
    there, post = (across + 2.5) / POST % 1, (across + 2.5) / POST % 2 < 1
    kept = (np.abs(across) < 2.4) & (np.abs(there - 0.5) < 0.35)  # not at a post's edge
    light = luminance(made.radiance)

    def contrast(seen, other):
        return (light[seen & post].mean() - light[other & ~post].mean()) / light[kept & (seen | other)].mean()

    on = kept & (made.body == 0) & (before > 0.5) & (before < 1.5)
    return float(contrast(on, on) / contrast(kept & (made.body == 1), kept & (made.body == 2)))


def _ball(radius: float = 1.0) -> Mesh:
    return meshes.lathe(lambda t: radius * np.sin(np.pi * t), lambda t: radius * (1 - np.cos(np.pi * t)))


def _plastic(measurement, size: int, samples: int) -> Rendering:
    """A ball and a table of the same plastic against a low sun."""
    sun, camera = Sun(14, 150, (4.2, 3.9, 3.4)), Camera((0.0, 1.5, 9.0), (0.0, 0.9, 0.0), 22)
    made = {}
    for name in ("lambertian+lafortune", "lambertian+phong"):
        bodies = [Body([_ball()], fitted(name, measurement)), Body([plate(6, -8, 6)], DARK)]
        made[name] = traced(bodies, camera, day, sun, (size, size), samples)
    angle = _seen_at(made["lambertian+phong"], camera)
    light = {name: luminance(each.radiance) for name, each in made.items()}
    upper = made["lambertian+phong"].normal[..., 1] > 0
    on = (made["lambertian+phong"].body == 0) & upper

    def ratio(low, high):
        kept = on & (angle >= low) & (angle < high)
        return float(light["lambertian+phong"][kept].mean() / light["lambertian+lafortune"][kept].mean())

    claims = [
        ("Phong over Lafortune up to 25° from the normal, upper half", ratio(0, 25)),
        ("Phong over Lafortune at 65° to 85°, upper half", ratio(65, 85)),
    ]
    return Rendering([(name, each.radiance) for name, each in made.items()], claims)


def _seen_at(made: Traced, camera: Camera) -> np.ndarray:
    """Angle between normal and line of sight [deg], of a camera that is far away."""
    view = np.subtract(camera.eye, camera.target)
    return np.degrees(np.arccos(np.clip(np.abs(made.normal @ view) / np.linalg.norm(view), 0, 1)))


def _paper(measurement, size: int, samples: int) -> Rendering:
    """A sheet on a table, the sun low ahead: from above and from near grazing."""
    sun = Sun(12, 180, (2.6, 1.5, 0.6))
    views = {
        "from above": Camera((0.0, 7.0, 2.4), (0.0, 0.0, 0.0), 24),
        "near grazing": Camera((0.0, 0.85, 7.5), (0.0, 0.0, 0.0), 24),
    }
    made = {}
    for name in ("lambertian+lafortune", "lambertian+phong"):
        bodies = [Body([plate(1.0, 1.4, -1.4, 0.01)], fitted(name, measurement)), Body([plate(8, 8, -12)], DARK)]
        for where, camera in views.items():
            made[name, where] = traced(bodies, camera, sunset, sun, (size, size), samples)
    claims = []
    for where in views:
        one, other = made["lambertian+lafortune", where], made["lambertian+phong", where]
        steps = noticeable_steps(other.radiance, one.radiance)[one.body == 0]
        claims.append((f"Lafortune over Phong {where}, median just noticeable steps", float(np.median(steps))))
    return Rendering([(f"{name}, {where}", each.radiance) for (name, where), each in made.items()], claims)


def _pot(size: int, samples: int) -> Rendering:
    """The pot by He-Torrance at the report's roughness with the index of iron, and as a mirror of that index."""
    index = {"n": 2.87, "k": 3.36}
    rough = Surface(models.get("he-torrance"), {f"he-torrance.{key}": value for key, value in index.items()})
    rough = rough.with_values({"sigma": 0.08, "slope": 0.08 / 1.52})
    mirror = exporters.coloured(Surface.named("mirror", index), "mirror")
    sun, camera = Sun(32, 35, (3.5, 3.3, 3.0), radius=0.0046), Camera((0.0, 1.1, 9.0), (-0.05, 0.85, 0.0), 24)
    made = {}
    for name, surface in (("ideal mirror", mirror), ("He-Torrance", exporters.coloured(rough, "steel"))):
        made[name] = traced([Body(meshes.teapot(), surface)], camera, day, sun, (size, size), samples)
    clipped = {name: int(np.sum(luminance(each.radiance) > 1.5)) for name, each in made.items()}
    claims = [(f"pixels brighter than 1.5 times white, {name}", float(count)) for name, count in clipped.items()]
    for where, share in (("on the front", 0.0), ("at the edge", 0.93)):
        row, sharp = None, {}
        for name, each in made.items():
            line = _column(each, share)
            row = int(np.argmin(line[3:] - line[:-3])) + 1 if row is None else row  # of the mirror, which comes first
            sharp[name] = _sharpness(line, row)
        claims += [(f"sharpness of the horizon {where}, {name}", value) for name, value in sharp.items()]
    return Rendering([(name, each.radiance) for name, each in made.items()], claims)


def _column(made: Traced, share: float) -> np.ndarray:
    """Luminance down the belly (radius 1, at 9 before a camera that takes in 24°), at this share of its half width."""
    size = made.body.shape[0]
    column = int(0.5 * size * (1 + (0.05 + share) / (9 * np.tan(np.radians(12)))))
    rows = slice(int(0.40 * size), int(0.66 * size))
    return luminance(made.radiance[rows, column - 2 : column + 3]).mean(axis=1)


def _sharpness(line: np.ndarray, row: int) -> float:
    """How much of the step from sky to ground within a twentieth of the belly is taken within three rows."""
    apart = max(4, len(line) // 10)
    whole = line[max(row - apart, 0)] - line[min(row + apart, len(line) - 1)]
    return float((line[row - 1] - line[row + 2]) / whole)


def _paint(measurement, size: int, samples: int) -> Rendering:
    """The body under the preview's sky: paint as fitted to what lies under the coat; and with the coat's mirror image,
    which is that of a clear lacquer's smooth face alone. Both come from our exports, and their light adds.
    """
    under = fitted("lambertian+lafortune", measurement)
    lacquer = exporters.coloured(Surface.named("mirror", {"n": COAT_INDEX}), "clear coat")
    sun, camera = Sun(38, 40, (4.0, 3.8, 3.4)), Camera((4.6, 2.0, 8.0), (0.0, 0.55, 0.0), 29)
    floor, shape = Body([plate(9, 9, -9, 0.0)], GREY), (int(1.3 * size), int(0.8 * size))
    paint, coat = (
        traced([Body([meshes.car_body()], surface), floor], camera, day, sun, shape, samples)
        for surface in (under, lacquer)
    )
    angle, on = _seen_at(paint, camera), paint.body == 0
    reflected = np.where(on[..., None], coat.radiance, 0)
    gain = luminance(reflected)

    def share(low, high):
        return float(np.median(gain[on & (angle >= low) & (angle < high)]))

    claims = [
        ("light that the coat adds at 20° to 45°, median", share(20, 45)),
        ("at 75° to 86°, median", share(75, 86)),
    ]
    panels = [("without the coat", paint.radiance), ("with it", paint.radiance + reflected)]
    return Rendering(panels, claims)
