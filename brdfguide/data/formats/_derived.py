"""Sheets with a column for each incidence, or for each reflected angle, as one angle a row."""

from dataclasses import replace

import numpy as np

from ...finding import Finding
from ..columns.facts import Column
from ..columns.grammar import understood
from ._angle_units import OF_DIRECTIONS
from ._roles import first_names
from ._sheet import Sheet
from .format import Source

SHOWN = 8  # angles in a note
HEADS_OF_SCANS = (*OF_DIRECTIONS, "wavelength")
MOST_HEADS = 0.5  # share of rows that have the angle of a scan, where only the first of each has


def filled_down(table: Sheet, columns: list[Column], notes: list[Finding]) -> Sheet:
    """The table with what stands at the head of each scan, and nowhere else, on every row of it; noted."""
    values = table.values
    for column in columns:
        told = np.isfinite(values[:, column.place])
        sparse = len(told) > 2 and told[0] and np.count_nonzero(told) < MOST_HEADS * len(told)
        if column.role not in HEADS_OF_SCANS or not sparse or column.place in table.texts:
            continue
        last = np.maximum.accumulate(np.where(told, np.arange(len(told)), 0))
        values = values.copy()
        values[:, column.place] = values[last, column.place]
        text = f"most cells of '{column.name[:40]}' are empty: they hold what stands above them"
        notes.append(Finding("columns-read", text))
    return table if values is table.values else replace(table, values=values)


def _names_an_angle(name: str) -> bool:
    """Whether a name would state an angle but for a hyphen."""
    return "-" in name and understood(name.replace("-", " ")).at is not None


def one_angle_a_row(
    source: Source, table: Sheet, columns: list[Column], notes: list[Finding]
) -> tuple[Sheet, list[Column]]:
    """The table with its columns for angles under one another, and a column that says which angle; noted.

    Raises InputError where the sign of some of the angles is not clear.
    """
    stated = [column for column in columns if column.at is not None and column.role in ("value", "stderr")]
    kinds = list(dict.fromkeys((column.role, column.channel) for column in stated))
    angles = list(dict.fromkeys(column.at for column in stated))
    cells = {(column.at, column.role, column.channel): column for column in stated}
    unclear = [column.name for column in columns if column.role is None and _names_an_angle(column.name)]
    if stated and unclear:
        raise source.error(
            f"the columns {first_names(unclear)}: a minus sign or a hyphen before the angle? Write it as theta_r=-30"
        )
    if not stated or len(cells) < len(stated) or len(cells) != len(kinds) * len(angles):
        return table, columns
    others = [column for column in columns if column not in stated]
    blocks = []
    for angle in angles:
        places = [*(column.place for column in others), *(cells[angle, *kind].place for kind in kinds)]
        blocks.append(np.column_stack([table.values[:, places], np.full(len(table.values), angle)]))
    role = stated[0].at_role or "theta_i"
    if role == "theta_i":
        what, code = "incidences", "incidence-columns"
    else:
        what, code = "reflected angles", "reflected-columns"
    shown = ", ".join(f"{angle:g}" for angle in angles[:SHOWN])
    text = f"columns for {len(angles)} {what}, {shown} degrees, from their names"
    notes.append(Finding(code, text, option="--columns"))
    kept = [*others, *(replace(cells[angles[0], *kind], at=None, at_role=None) for kind in kinds)]
    kept.append(Column(name=role, role=role, unit="deg"))
    texts = {
        place: table.texts[column.place] * len(angles)
        for place, column in enumerate(others)
        if column.place in table.texts
    }
    table = replace(
        table,
        names=[column.name for column in kept],
        values=np.concatenate(blocks),
        lines=np.tile(table.lines, len(angles)),
        texts=texts,
    )
    return table, [replace(column, place=place) for place, column in enumerate(kept)]
