"""Surroundings by name, and those of an equirectangular picture; all light level ground alike."""

from collections.abc import Sequence

import numpy as np

from ...errors import InputError, choices
from ...exporters.exporter import ColouredSurface
from ...photographs import readers
from ...physics.colour import luminance
from ...scene.surroundings import Surroundings
from ..grained_view import has_grain
from .composition import Stage
from .light_map import ROWS, Lighting, map_directions, resampled
from .standing import GRAINED_PAIR, SETS

STAGED = ("studio", "overcast", "room")  # of `scene.surroundings`
WHITE = 1.6  # radiance of a white floor in the open: a white card reads 0.88 after EXPOSURE, a grey one 0.16
TURN_DEG = {"side": 0.0, "front": 30.0, "back": -95.0}  # of the surroundings about upward; ours
PAIR = "pair"


def staged(surfaces: Sequence[ColouredSurface], around: str, light: str, objects: str, size: int) -> Stage:
    """Objects among surroundings by name, or those of an .exr file.

    Raises InputError for other names, for a file that is no equirectangular picture, and for one that is black.
    """
    if objects not in SETS:
        raise choices("object", objects, SETS)
    things = GRAINED_PAIR if objects == PAIR and any(has_grain(each) for each in surfaces) else SETS[objects]
    if around.lower().endswith(".exr"):
        return Stage(things, _of_picture(around), size, has_floor=False)
    if around not in STAGED:
        raise choices("surroundings", around, [*STAGED, "sky"])
    found = Surroundings(around, turn_deg=-TURN_DEG[light])
    x, y, z = np.moveaxis(map_directions().astype(np.float32), -1, 0)
    world = np.stack((z, x, y), axis=-1) @ found.of_object.T.astype(np.float32)
    return Stage(things, _scaled(found.relative_rgb(world), around), size)


def _of_picture(path: str) -> Lighting:
    picture = np.asarray(readers.read_picture(path).codes, float)
    height, width = picture.shape[:2]
    if abs(width - 2 * height) > 1:
        raise InputError(
            f"{path}: {width} x {height} pixels; wanted twice as wide as high: all directions, once around"
        )
    if not np.isfinite(picture).all():
        raise InputError(f"{path}: pixels without a number, or infinite; wanted radiances")
    rows = ROWS if height < 2 * ROWS else 2 * ROWS
    return _scaled(resampled(np.maximum(picture, 0), rows), path)


def _scaled(radiance, name: str) -> Lighting:
    """Scaled so that white level ground sends `WHITE`."""
    white = luminance(Lighting(radiance).upper_cells()[1].sum(axis=0)) / np.pi
    if not white > 0:
        raise InputError(f"{name}: no light comes from above the horizon")
    return Lighting((radiance * (WHITE / white)).astype(np.float32))
