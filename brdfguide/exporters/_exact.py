"""The statement of a target that holds the model's own law."""

from functools import partial

from ..physics.geometry import Geometry
from . import _dialect
from ._directions import judged_over
from ._shown import whole
from .exporter import ColouredSurface, Statement


def exact_statement(target: str, surface: ColouredSurface, geom: Geometry | None, nearest: str, notes=()) -> Statement:
    """Exact, over the directions that a refit would have been judged by. Refuses a law without a formula and names the
    `nearest` target."""
    _dialect.require_formulas(target, surface, nearest)
    count, over = 0, "the mirror direction"
    if not all(term.model.is_mirror for term in surface.model.terms):
        judged, _, over = judged_over(surface, geom)
        count = len(judged)
    written = dict(sorted(surface.values.items()))
    how, shown = surface.colour.how, partial(whole, surface)
    return Statement(target, "exact", 0.0, count, over, written, (), tuple(notes), how, 0.0, shown)
