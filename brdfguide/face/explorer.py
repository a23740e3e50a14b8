"""What `explore` writes, and what a fit's page holds of it."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from ..advice.recommend import Proposal
    from ..data.measurement import Measurement
    from ..fitting.fit import Fit
    from ..fitting.ranked import Ranking
    from ..report.explorer.state import Turned

TWO = ("lambertian+ggx", "lambertian+he-torrance")  # where no surface is named
MOST_OF_A_FIT = 4


def explorer_html(words: Sequence[str], data: Path | None = None) -> tuple[str, list[str]]:
    """A page of surfaces named as for `preview`, and their names; without any, of the best of a fit to the data.

    Raises InputError for words that name nothing, NoAnswer for a law without a formula.
    """
    from ..fitting.job import read_for_fit
    from ..report.explorer.block import explorer_page
    from ..report.explorer.state import explorer_state
    from .functions import fit

    measurement = None if data is None else read_for_fit(data)
    if data is not None and not words:
        answer = fit(data, timing=False)
        shown, measurement = turned_of(answer.ranking), answer.measurement
    else:
        shown = [with_errors(each) for each in (words or TWO)]
    state = explorer_state(shown, measurement)
    names = [each.surface.name for each in shown]
    return explorer_page(state, " | ".join(names) if data is None else f"{data.name}: {' | '.join(names)}"), names


def block_of_ranking(ranking: "Ranking", measurement: "Measurement") -> str:
    """The same of a fit, as a part of its page."""
    from ..report.explorer.block import explorer_block
    from ..report.explorer.state import explorer_state

    return explorer_block(explorer_state(turned_of(ranking), measurement))


def block_of_candidates(candidates: "Sequence[Proposal]") -> str:
    """The same of a description's candidates at their start values, those whose laws state formulas."""
    from ..exporters import coloured
    from ..report.explorer.block import explorer_block
    from ..report.explorer.state import Turned, explorer_state

    able = [each for each in candidates if all(term.model.formula is not None for term in each.model.terms)]
    return (
        explorer_block(explorer_state([Turned(coloured(each.surface, each.model.name)) for each in able]))
        if able
        else ""
    )


def with_errors(words: str) -> "Turned":
    """A surface, with standard errors where it is a fit's JSON."""
    from ..fitting import saved
    from ..report.explorer.state import Turned
    from .surfaces import named_surface

    file, _, row = words.partition("#")
    is_fit = Path(file).suffix.lower() == ".json"
    return Turned(named_surface(words), saved.read_stderr(file, row or None) if is_fit else {})


def turned_of(ranking: "Ranking") -> "list[Turned]":
    """The recommended fit first, then the best others whose laws state formulas."""
    picked = [ranking.recommended, *(row for row in ranking.rows if row is not ranking.recommended)]
    waves = [row for row in picked if "he-torrance" in row.fit.name][:1]
    chosen = [row for row in picked if all(term.model.formula is not None for term in row.fit.model.terms)]
    rows = list({id(row): row for row in [*chosen[: MOST_OF_A_FIT - 1], *waves, *chosen[:MOST_OF_A_FIT]]}.values())
    return [_of_fit(row.fit) for row in rows[:MOST_OF_A_FIT]]


def _of_fit(fit: "Fit") -> "Turned":
    from ..exporters import coloured
    from ..report.explorer.state import Turned

    errors = {key: float(np.mean(value)) for key, value in fit.stderr.items() if np.all(np.isfinite(value))}
    return Turned(coloured(fit.surface, fit.name), errors)
