"""Surfaces side by side, as a document."""

from dataclasses import asdict

from ...fitting.side_by_side import Pair, greatest, middle, parts, seconds_apart
from ...physics import seen
from .plain import plain

SCHEMA = "brdfguide/compare/1"


def of_pair(found: Pair) -> dict:
    """Two surfaces: how different they look, and where that comes from."""
    most, half = greatest(found), middle(found)
    return plain(
        {
            "schema": SCHEMA,
            "surfaces": list(found.names),
            "seen": found.seen,
            "seen_words": seen.band_words(found.seen),
            "seen_weights": found.kind,
            "directions": int((found.weights > 0).sum()),
            "rms_ln": found.rms_ln,
            "brighter": found.mean_brighter,
            "where": {name: [asdict(each) for each in each_part] for name, each_part in parts(found).items()},
            "half": asdict(half) if half else None,
            "greatest": asdict(most) if most else None,
        }
    )


def _order(nearer: Pair, farther: Pair) -> str:
    """What people would say of the nearer one."""
    if seconds_apart(nearer, farther) < seen.ALIKE:
        return seen.ORDERS[0][1]
    return seen.order_words(nearer.seen, farther.seen)


def of_many(found: list[Pair]) -> dict:
    """The first surface against each of the others, nearest first."""
    ordered = sorted(found, key=lambda each: each.seen)
    entries = []
    for place, each in enumerate(ordered):
        before = ordered[place - 1] if place else None
        entries.append({
            "surface": each.names[1],
            "seen": each.seen,
            "seen_words": seen.band_words(each.seen),
            "rms_ln": each.rms_ln,
            "before_it": None if before is None else _order(before, each),
        })  # fmt: skip
    return plain(
        {"schema": SCHEMA, "surfaces": [ordered[0].names[0]], "seen_weights": ordered[0].kind, "ranking": entries}
    )
