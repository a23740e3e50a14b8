"""What follows from both widths of a fitted grain, with its standard error and interval."""

from dataclasses import replace
from functools import partial

import numpy as np

from ...data.measurement import Measurement
from ...fitting.diagnostics.derived_error import ln_stderrs
from ...fitting.fit import Fit
from ...models.model import Derived, Term

ENOUGH = 2_000  # directions that tell how both widths err together
WIDE = 2.0  # standard errors of its logarithm from a value to either end of its interval
UNKNOWN = 100.0  # standard error of a logarithm from which the data say nothing


def errors_of_grain(fit: Fit, measurement: Measurement) -> dict[str, dict]:
    """Standard error and 95 % interval of each number that follows from the fitted widths of a grain, by its key. Both
    widths err together; a ratio ends at 1."""
    numbers = {
        f"{term.label}.{derived.name}": partial(_number, fit, term, derived)
        for term in fit.model.terms
        for derived in term.model.derived
        if term.model.grain is not None and _widths_fitted(fit, term)
    }
    if not numbers:
        return {}
    few = measurement[np.unique(np.linspace(0, len(measurement.brdf) - 1, ENOUGH).astype(int))]
    found = {}
    for (key, of), error in zip(numbers.items(), ln_stderrs(fit, few, list(numbers.values())), strict=True):
        if error < UNKNOWN:
            value = of(fit.values)
            low, high = value * np.exp(-WIDE * error), value * np.exp(WIDE * error)
            low = max(low, 1.0) if key.endswith(".ratio") else low
            found[key] = {"stderr": value * error, "interval": [low, high]}
    return found


def _widths_fitted(fit: Fit, term: Term) -> bool:
    keys = (term.key(name) for name in (term.model.grain.first, term.model.grain.second))  # type: ignore[union-attr]
    return all(np.ndim(fit.values[key]) == 0 and fit.stderr.get(key) is not None for key in keys)


def _number(fit: Fit, term: Term, derived: Derived, values) -> float:
    return float(derived.of(**replace(fit.surface, values=values).values_of(term)))
