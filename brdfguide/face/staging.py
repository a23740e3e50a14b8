"""Pictures of surfaces among surroundings, and rows of a surface with one number changed step by step."""

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ..exporters.exporter import ColouredSurface

SKY = "sky"
ROW = re.compile(r"([\w.:+-]+)=([-+.\deE]+)\.\.([-+.\deE]+)(?:/(\d+))?")
STEPS = 5  # of a row
MOST_STEPS = 12


def pictures_among(
    surfaces: "Sequence[ColouredSurface]", size: int, around: str, light: str | None, objects: str | None, progress
) -> tuple[list[np.ndarray], str]:
    """Radiance (size, size, 3) of each surface, and in words what lights them.

    Raises InputError for surroundings, lights and objects that are not there, or that have no effect.
    """
    from ..errors import InputError, choices
    from ..report import render

    picture = around.lower().endswith(".exr")
    if light is not None and picture:
        raise InputError(f"--light {light}: {around} holds its own light, which stands where it stands")
    if light is not None and light not in render.LIGHTS_DEG:
        raise choices("place for the light", light, render.LIGHTS_DEG)
    if around == SKY and objects is not None:
        raise InputError(f"--object {objects}: under the sky stand a sphere and a bent sheet, whatever is asked for")

    def told(each):
        return progress(each.name) if progress else None

    place = light or "side"
    if around == SKY:
        elevation, azimuth = render.LIGHTS_DEG[place]
        words = f"sun {elevation:g}° high, {azimuth:g}° to the right of the camera, and a sky"
        return [render.render(each, size, place, told(each)) for each in surfaces], words
    from ..report.still_life.lit_by import PAIR, staged

    stage = staged(surfaces, around, place, objects or PAIR, size)
    words = f"lit by {around.rsplit('/', 1)[-1]}" if picture else f"{_ARTICLE[around]}, main light at the {place}"
    return [stage.picture(each, told(each)) for each in surfaces], words


_ARTICLE = {"studio": "a studio", "overcast": "an overcast sky", "room": "a room with a window"}


def row_of(surface: "ColouredSurface", asked: str) -> "list[ColouredSurface]":
    """A surface with one number in even steps, NAME=LOW..HIGH or NAME=LOW..HIGH/STEPS, angles in degrees.

    Raises InputError for other words, other names, and values where the law does not hold.
    """
    from .. import exporters
    from ..errors import InputError

    found = ROW.fullmatch(asked)
    try:
        name, low, high = found[1], float(found[2]), float(found[3])  # type: ignore[index]
    except (TypeError, ValueError):
        raise InputError(f"--row {asked}: wanted NAME=LOW..HIGH, such as alpha=0.1..0.9") from None
    steps = int(found[4] or STEPS)  # type: ignore[index]
    if not 2 <= steps <= MOST_STEPS:
        raise InputError(f"--row {asked}: a row has 2 to {MOST_STEPS} steps")
    values = np.linspace(low, high, steps).tolist()
    return [exporters.coloured(surface.with_values({name: each}), f"{name} {each:.4g}") for each in values]
