"""Where to go from a refusal: the nearest target that holds the surface, and the nearest law that the target holds."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..errors import NoAnswer
from ..models import get
from ..physics.geometry import Geometry
from ._law_fit import nearest_of_law
from ._shown import seen_of
from .exporter import ColouredSurface, Export, Refused

TARGETS = ("mitsuba", "openpbr", "standard-surface", "gltf")  # materials that hold a mirror beside a finite part
LAWS = ("lambertian+ggx", "ggx", "lambertian")  # that every target of finite values holds
Exported = Callable[[str, ColouredSurface, Geometry | None], Export]


def with_the_nearest(refused: Refused, surface: ColouredSurface, geom: Geometry | None, export: Exported) -> NoAnswer:
    """The refusal with the nearest target and the nearest law there, each with its error."""
    ways = [*_nearest_target(refused, surface, geom, export), *_nearest_law(refused, surface, geom, export)]
    return NoAnswer("; ".join([str(refused), *ways]))


def _nearest_target(refused: Refused, surface: ColouredSurface, geom: Geometry | None, export: Exported):
    errors = {}
    for target in TARGETS:
        try:
            errors[target] = export(target, surface, geom).statement.rms_ln
        except NoAnswer:
            continue
    if errors:
        best = min(errors, key=lambda target: errors[target])
        yield f"{best} as a material holds it to rms ln {errors[best]:.2g}"


def _nearest_law(refused: Refused, surface: ColouredSurface, geom: Geometry | None, export: Exported):
    """The law whose finite part comes nearest, as the target's file shows it beside the whole surface."""
    found = []
    for name in LAWS:
        try:
            model = get(name)
            choice = nearest_of_law(model, surface, geom)
            values = {key: _of_channels(value, surface) for key, value in choice.values.items()}
            law = replace(surface, model=model, values=values)
            shown = export(refused.target, law, geom).statement.shown
        except NoAnswer:
            continue
        if shown is not None:
            found.append((seen_of(surface, shown), name, choice.rms_ln))
    if found:
        seen, name, error = min(found)
        words = f"the nearest law that {refused.target} holds is {name}"
        yield f"{words}: seen {seen:.1f} L* from it, the finite part to rms ln {error:.2g}"


def _of_channels(value, surface: ColouredSurface):
    """A fitted value as the surface's channels have it: one where all colours agree."""
    if np.ptp(value) == 0 or len(surface.channels) != 3:
        return float(np.mean(value))
    return np.asarray(value, float)
