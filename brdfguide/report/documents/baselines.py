"""General representations beside a ranking as a list of dicts."""

import dataclasses
from collections.abc import Iterable

from ...fitting.baselines import Baseline
from .plain import plain


def baselines_block(rows: Iterable[Baseline], *, timing: bool = True) -> list[dict]:
    """One dict for each; times only where they were wanted."""
    found = [dataclasses.asdict(row) for row in rows]
    for row in found if not timing else ():
        del row["ns_per_sample"]
    return plain(found)
