"""A law of models fitted to a surface: as it stands, and in the setting that makes a metal of a shader."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from ..models.model import Composite, Model, Parameter
from ..physics.geometry import Geometry
from ._choice import Choice, choose
from ._grained import axis_of
from ._refit import TargetModel
from .exporter import ColouredSurface


def nearest_of_law(model: Composite, surface: ColouredSurface, geom: Geometry | None = None) -> Choice:
    """The values of the law that come nearest to the finite part of a surface. Raises NoAnswer where it has none."""
    axis = axis_of(surface)
    grain = {} if axis is None else {key: axis for key in model.parameters if key.rpartition(".")[2] == "axis"}
    targets = {"as it is": _target(model, grain)}
    if len(model.terms) == 1:
        [only] = model.terms
        longer = tuple(only.key(name) for name in _of_streak(only.model) if grain)
        if "metal" in only.model.settings:
            fixed = {only.key(name): value for name, value in only.model.settings["metal"].fixed.items()}
            targets["metal"] = _target(model, grain | fixed)
            if longer:
                targets["metal with a grain"] = _target(model, grain | fixed, longer)
        if longer:
            targets["with a grain"] = _target(model, grain, longer)
    return choose(surface, geom, targets)


def _of_streak(law: Model) -> tuple[str, ...]:
    """What a shader frees beside the axis where it has a grain."""
    found = law.settings["grain"].free if "grain" in law.settings else ()
    return tuple(name for name in found if name != "axis")


def _target(model: Composite, fixed: Mapping, freed: tuple[str, ...] = ()) -> TargetModel:
    """A law of models as one to be fitted; its free parameters, and what is freed besides, under their keys."""
    open_ = {*model.free, *freed}
    free = {key: p for key, p in model.parameters.items() if (p.free or key in open_) and key not in fixed}
    held = {key: value for key, value in (model.defaults() | dict(fixed)).items() if key not in free}
    parameters = tuple(replace(p, name=key, linear=False, starts=_starts(p, freed)) for key, p in free.items())
    return TargetModel(parameters, partial(_evaluated, model, held), held)


def _starts(p: Parameter, freed: tuple[str, ...]) -> tuple[float, ...]:
    if p.starts:
        return p.starts
    return (
        (0.3, 0.7) if freed and p.default == 0 and p.name in {key.rpartition(".")[2] for key in freed} else (p.default,)
    )


def _evaluated(model: Composite, held: Mapping, geom, **values) -> np.ndarray:
    return model(geom, {**held, **values})
