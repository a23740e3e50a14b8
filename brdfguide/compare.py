"""From a measurement to a ranking: fit every candidate, rank the fits, try each at angles it did not see."""

from collections.abc import Callable, Iterable

from . import fitting, ranking, validation
from .errors import NoAnswer
from .fitting import Options
from .measurement import Measurement
from .models import Sum
from .ranking import Ranking


def compare(
    measurement: Measurement,
    candidates: Iterable[Sum],
    options: Options = Options(),
    progress: Callable[[str], None] = lambda what: None,
) -> Ranking:
    """The candidates in order of error, with held-out errors. Raises NoAnswer where none converged."""
    fits = fitting.fit_all(candidates, measurement, options, progress)
    if not any(fit.converged for fit in fits):
        raise NoAnswer(f"{measurement.name}: none of {len(fits)} models converged; try --robust, or --theta-max to leave out doubtful angles")
    ranked = ranking.rank(fits, measurement, options)
    return validation.validated(ranked, measurement, options, lambda name: progress(f"leaving angles out: {name}"))
