"""The best that one shader can do for a measurement: all of its settings fitted, beside the best of the laws."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..data.measurement import Measurement
from ..errors import InputError
from ..models import Composite, every, get
from ..models.candidates import METAL, of_kind, set_as, settings
from ..models.model import Model
from .compare import compare
from .fit import Fit, FitOptions
from .ranked import Ranking

TURNED_DEG = 5.0  # azimuths of the light that differ by more show a grain


def shader_law(name: str) -> Model:
    """The law of a shader by its name. Raises InputError for another word."""
    found = {model.name: model for model in every() if model.settings}
    wanted = name.strip().lower().replace("_", "-")
    if wanted not in found:
        raise InputError(f"--as {name}: no such shader; there are: {', '.join(found)}")
    return found[wanted]


def shader_candidates(law: Model, kind: str | None, measurement: Measurement) -> tuple[Composite, ...]:
    """Body and metal, each also under a coat, and with a grain where the light came from several sides."""
    plain = of_kind(kind or None, (law.name,))
    turned = np.ptp(measurement.geom.phi_i_deg) > TURNED_DEG
    words = [word for word in settings(get(law.name)) if word != METAL and (turned or word != "grain")]
    return (*plain, *(set_as(each, word) for each in plain for word in words))


def as_shader(
    measurement: Measurement,
    law: Model,
    options: FitOptions = FitOptions(),
    progress: Callable[[str], None] = lambda what: None,
    *,
    kind: str | None = None,
) -> Ranking:
    """The shader's settings in order of error. Raises NoAnswer where none converged."""
    return compare(measurement, shader_candidates(law, kind, measurement), options, progress, kind=kind)


def read_otherwise(fit: Fit, measurement: Measurement) -> dict[str, float]:
    """rms ln of the same numbers against the measurement where programs read the shader's text in another published
    way; by the words for it. Empty where there is one reading."""
    [term] = fit.model.terms
    found = {}
    for words, law in term.model.readings.items():
        other = replace(fit.model, terms=(replace(term, model=replace(term.model, brdf=law, gradient=None)),))
        left = replace(fit, surface=replace(fit.surface, model=other)).residuals_on(measurement)
        found[words] = float(np.sqrt(np.nanmean(left**2)))
    return found
