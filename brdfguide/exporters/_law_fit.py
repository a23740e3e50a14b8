"""A law of models fitted to a surface: as it stands, and in the setting that makes a metal of a shader."""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from ..models.model import Composite
from ..physics.geometry import Geometry
from ._choice import Choice, choose
from ._refit import TargetModel
from .exporter import ColouredSurface


def nearest_of_law(model: Composite, surface: ColouredSurface, geom: Geometry | None = None) -> Choice:
    """The values of the law that come nearest to the finite part of a surface. Raises NoAnswer where it has none."""
    targets = {"as it is": _target(model, {})}
    if len(model.terms) == 1:
        [only] = model.terms
        for word, setting in only.model.settings.items():
            if word == "metal":
                targets[word] = _target(model, {only.key(name): value for name, value in setting.fixed.items()})
    return choose(surface, geom, targets)


def _target(model: Composite, fixed: Mapping) -> TargetModel:
    """A law of models as one to be fitted; its free parameters under their keys."""
    free = {key: p for key, p in model.parameters.items() if (p.free or key in model.free) and key not in fixed}
    held = {key: value for key, value in (model.defaults() | dict(fixed)).items() if key not in free}
    parameters = tuple(replace(p, name=key, linear=False, starts=p.starts or (p.default,)) for key, p in free.items())
    return TargetModel(parameters, partial(_evaluated, model, held), held)


def _evaluated(model: Composite, held: Mapping, geom, **values) -> np.ndarray:
    return model(geom, {**held, **values})
