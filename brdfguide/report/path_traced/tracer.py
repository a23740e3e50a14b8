"""A scene of meshes with surfaces of ours, as Mitsuba traces it: each surface from the file that `export` writes."""

import ast
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from ... import exporters
from ...errors import InputError
from ...exporters.exporter import ColouredSurface
from ...records import dataclass
from .meshes import Mesh

SKY_ROWS = 512
WITHOUT = "needs Mitsuba, which is not installed: pip install 'brdfguide[render]'"


@dataclass(frozen=True, eq=False)
class Camera:
    """From where to where it looks, and how much of the picture's width it takes in [deg]."""

    eye: tuple[float, float, float]
    target: tuple[float, float, float]
    wide_deg: float = 30.0

    def rays(self, shape: tuple[int, int]) -> np.ndarray:
        """Through the middle of each pixel of a picture (height, width), from the eye, (height, width, 3)."""
        ahead = np.subtract(self.target, self.eye) / np.linalg.norm(np.subtract(self.target, self.eye))
        right = np.cross(ahead, (0.0, 1.0, 0.0))
        right /= np.linalg.norm(right)
        half = np.tan(np.radians(0.5 * self.wide_deg))
        across = half * (2 * np.arange(shape[1]) + 1 - shape[1]) / shape[1]
        down = half * (2 * np.arange(shape[0]) + 1 - shape[0]) / shape[1]
        return ahead + across[:, None] * right - down[:, None, None] * np.cross(right, ahead)


@dataclass(frozen=True, eq=False)
class Sun:
    """Elevation and azimuth from +z toward +x [deg], irradiance of linear sRGB, and radius [rad]."""

    elevation_deg: float
    azimuth_deg: float
    irradiance: tuple[float, float, float]
    radius: float = 0.012

    @property
    def toward(self) -> np.ndarray:
        e, a = np.radians([self.elevation_deg, self.azimuth_deg])
        return np.array([np.cos(e) * np.sin(a), np.sin(e), np.cos(e) * np.cos(a)])


@dataclass(frozen=True, eq=False)
class Traced:
    """Linear sRGB (height, width, 3), normals (height, width, 3) and which body is seen, -1 none (height, width)."""

    radiance: np.ndarray
    normal: np.ndarray
    body: np.ndarray


@dataclass(frozen=True, eq=False)
class Body:
    """Meshes of one surface: ours, or one of Mitsuba's own plugins as a dict."""

    meshes: Sequence[Mesh]
    surface: ColouredSurface | dict


def traced(
    bodies: Sequence[Body], camera: Camera, sky, sun: Sun, size: tuple[int, int], samples: int, depth: int = 3
) -> Traced:
    """A picture (width, height). sky(directions (..., 3)) gives radiance (..., 3), y up; the sun is a disc in it.

    The sampler is seeded: the same scene gives the same numbers. Raises InputError without Mitsuba.
    """
    mitsuba = _mitsuba()
    with TemporaryDirectory() as folder:
        scene = {
            "type": "scene",
            "sensor": _sensor(mitsuba, camera, size, samples),
            "integrator": {
                "type": "aov",
                "aovs": "n:sh_normal,s:shape_index",
                "image": {"type": "path", "max_depth": depth, "rr_depth": 100},
            },
            "sky": {"type": "envmap", "bitmap": mitsuba.Bitmap(_sky_map(sky, sun))},
        }
        for place, body in enumerate(bodies):
            bsdf = _plugin(body.surface, Path(folder) / f"surface{place}.bsdf")
            for part, mesh in enumerate(body.meshes):
                file = Path(folder) / f"body{place}_{part}.ply"
                mesh.write(file)
                # two-sided, since a mesh does not say which side is out
                plugin = {"type": "twosided", "side": bsdf}
                scene[f"body{place}_{part}"] = {"type": "ply", "filename": str(file), "bsdf": plugin}
        loaded = mitsuba.load_dict(scene, optimize=False)  # merged shapes would lose their names
        kinds = [int(shape.id().removeprefix("body").partition("_")[0]) for shape in loaded.shapes()]
        found = np.array(mitsuba.render(loaded, seed=22), dtype=float)
    normal = found[..., 3:6]
    index = np.round(found[..., 6]).astype(int)  # counts from 1; between two bodies it is no whole number
    whole = (np.abs(found[..., 6] - index) < 1e-3) & (index > 0)
    lengths = np.linalg.norm(normal, axis=-1)
    kept = np.where(whole & (lengths > 0.95), np.take(kinds, np.clip(index - 1, 0, len(kinds) - 1)), -1)
    return Traced(found[..., :3], normal / np.maximum(lengths, 1e-9)[..., None], kept)


def _mitsuba():
    try:
        import mitsuba
    except ImportError:
        raise InputError(f"a rendering {WITHOUT}") from None
    mitsuba.set_variant("scalar_rgb")
    return mitsuba


def _plugin(surface, file: Path) -> dict:
    if isinstance(surface, dict):
        return surface
    if all(term.model.mirror is not None for term in surface.model.terms):
        written = exporters.export("mitsuba-dict", surface).content
        assert isinstance(written, str)
        return ast.literal_eval(written.partition("MATERIAL = ")[2])
    made = exporters.export("rgl", surface)
    file.write_bytes(made.content if isinstance(made.content, bytes) else made.content.encode())
    return {"type": "measured", "filename": str(file)}


def _sensor(mitsuba, camera: Camera, size: tuple[int, int], samples: int) -> dict:
    return {
        "type": "perspective",
        "fov": camera.wide_deg,
        "fov_axis": "x",
        "to_world": mitsuba.ScalarTransform4f().look_at(list(camera.eye), list(camera.target), [0, 1, 0]),
        "sampler": {"type": "multijitter", "sample_count": samples},
        "film": {"type": "hdrfilm", "width": size[0], "height": size[1], "rfilter": {"type": "box"}},
    }


def _sky_map(sky, sun: Sun) -> np.ndarray:
    """Equirectangular, (rows, 2 rows, 3): Mitsuba's column is atan2(x, -z) / 2π of the way across."""
    theta = np.pi * (np.arange(SKY_ROWS) + 0.5) / SKY_ROWS
    phi = 2 * np.pi * (np.arange(2 * SKY_ROWS) + 0.5) / (2 * SKY_ROWS)
    t, p = np.meshgrid(theta, phi, indexing="ij")
    to = np.stack((np.sin(t) * np.sin(p), np.cos(t), -np.sin(t) * np.cos(p)), axis=-1)
    light = np.array(sky(to), float)
    disc = to @ sun.toward > np.cos(max(sun.radius, 1.5 * np.pi / SKY_ROWS))
    solid = np.sum(disc * np.sin(t)) * (np.pi / SKY_ROWS) ** 2
    light[disc] += np.array(sun.irradiance) / solid
    return light.astype(np.float32)
