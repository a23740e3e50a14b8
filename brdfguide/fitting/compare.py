"""From a measurement to a ranking: fit every candidate and what grows from the best, rank the fits, try each at angles
it did not see.
"""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from ..data.measurement import Measurement
from ..errors import NoAnswer
from ..finding import Finding
from ..models import Composite
from ..models.visible_change import begins_to_show
from . import cross_validation, describable, growing, ranking
from . import fit as fitting
from .coarse_search import Search, free_count
from .fit_options import FitOptions
from .prepared import Prepared
from .ranked import Ranking, Step


def compare(
    measurement: Measurement,
    candidates: Iterable[Composite],
    options: FitOptions = FitOptions(),
    progress: Callable[[str], None] = lambda what: None,
    *,
    grows: bool = False,
    kind: str | None = None,
    timed: bool = True,
) -> Ranking:
    """The candidates in order of error, with held-out errors, what would show on the recommended one, a floor; where it
    `grows`, also what grew from the best of them, for a surface of this kind (None: not known). Laws are `timed` where
    somebody asks how fast they are.

    Raises NoAnswer where none converged, and where the values are no more than the parameters of any of them.
    """
    known, left_out = _determined(tuple(candidates), measurement, options)
    steps: list[Step] = []

    def more(searches: list[Search], data: Prepared) -> list[Search]:
        found, taken = growing.grow(searches, data, options, kind, progress)
        steps.extend(taken)
        return found

    fits = fitting.fit_all(known, measurement, options, progress, *([more] if grows else []))
    if not any(fit.converged for fit in fits):
        raise NoAnswer(
            f"{measurement.name}: none of {len(fits)} models converged; try --robust, or --theta-max to leave "
            f"out doubtful angles"
        )
    ranked = ranking.rank(fits, measurement, options, timed=timed)
    ranked = replace(ranked, warnings=ranked.warnings + left_out, kind=kind)
    found = cross_validation.validated(
        ranked, measurement, options, lambda name: progress(f"leaving angles out: {name}")
    )
    best = found.recommended.fit
    found = replace(found, shows=begins_to_show(best.surface, best.stderr), grown=tuple(steps))
    floor = describable.floor_of(found, measurement)
    return found if floor is None else replace(found, floor=floor, warnings=found.warnings + floor.findings())


def _determined(
    candidates: tuple[Composite, ...], measurement: Measurement, options: FitOptions
) -> tuple[tuple[Composite, ...], tuple[Finding, ...]]:
    """Those with fewer free parameters than there are values, and the note on the rest: through as many values as
    parameters any of them goes, and no error can be told.

    Raises NoAnswer where there are none, and where of several with a lobe there are none.
    """
    values = int(np.count_nonzero(measurement.weighed))
    free = [free_count(model, len(measurement.channels), options) for model in candidates]
    known = tuple(model for model, count in zip(candidates, free, strict=True) if count < values)
    if len(known) == len(candidates):
        return known, ()
    lobes = [count for model, count in zip(candidates, free, strict=True) if _has_lobe(model)]
    least = min(lobes or free)
    if values <= least:
        raise NoAnswer(
            f"{measurement.name}: {values} usable value{'s' * (values != 1)}, and the models have at least {least} "
            f"free parameter{'s' * (least != 1)}: with no more values than parameters nothing can be told; measure "
            f"more directions, or hold parameters with --fix"
        )
    names = ", ".join(fitting.candidate_label(model) for model in candidates if model not in known)
    text = f"{values} usable values: left out were models with as many parameters: {names}"
    consequence = "the best of the rest may only be the simplest: measure more directions"
    return known, (Finding("few-values", text, "warning", consequence, numbers=(("values", values),)),)


def _has_lobe(model: Composite) -> bool:
    return any(term.model.is_lobe for term in model.terms)
