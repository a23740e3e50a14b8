"""The statement of a target that holds the model's own law."""

from ..geometry import Geometry
from ._base import Statement, Surface
from ._directions import chosen


def exact_statement(target: str, surface: Surface, geom: Geometry | None, notes=()) -> Statement:
    """Exact, over the directions that a refit would have been judged by."""
    if set(surface.laws) == {"mirror"}:
        wanted, over = (), "the mirror direction"
    else:
        _, wanted, over = chosen(surface, geom)
    written = {key: value for key, value in sorted(surface.values.items())}
    return Statement(target, "exact", 0.0, len(wanted), over, written, (), tuple(notes), surface.colour.how)
