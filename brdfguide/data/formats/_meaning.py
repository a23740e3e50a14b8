"""What the columns of a table mean: directions, channels and values out of named numbers; every inference is noted."""

from dataclasses import replace

import numpy as np

from ...finding import Finding
from ..columns import prose
from ..columns.facts import Column
from ..measurement import Measurement
from . import _derived, _groups, _roles
from ._angles import RowDirections, row_directions, used_columns
from ._roles import Assigned
from ._sheet import Sheet
from ._sides import on_its_side
from ._values import Values, values_of, with_stated_quantity
from .format import Options, Source, measurement, overruled

SKIPPED = 5  # lines that are named


def measurement_of(
    source: Source, table: Sheet, options: Options, *, kind: str = "table", unit: str | None = None
) -> Measurement:
    """The measurement in a table of named columns; `unit` is that of angles whose names have none.

    Raises InputError.
    """
    notes = [Finding("lines-skipped", f"skipped {text}") for text in table.notes[:SKIPPED]]
    notes += table.findings
    table, chosen = _groups.selected(source, table, options.select)
    notes += chosen
    columns = _roles.mapped(table, options, source)
    table = _derived.filled_down(table, columns, notes)
    table, columns = _derived.one_angle_a_row(source, table, columns, notes)
    given = _roles.assigned(table, columns, options, source)
    found = row_directions(source, table, given, options, unit, notes)
    given = used_columns(given, found)
    if not np.all(found.rows):
        table = table.rows(found.rows)
    kept, copied = _groups.rows_once(table, given.columns, found.degrees)
    if copied:
        table, found = table.rows(kept), replace(found, degrees=found.degrees[:, kept])
        notes += copied
    values = values_of(source, table, given, found.degrees, notes)
    given = values.left
    notes += _apart(source, table, given, found, values)
    notes += _roles.ignored(given.columns)
    notes += (*given.findings, *(given.of_wavelength if values.by_constant else ()))
    notes.insert(0, _read(given, found))
    if table.sections:
        names = " and ".join(f"'{name[:40]}'" for name in table.sections)
        notes.insert(1, Finding("columns-read", f"lines between the rows give {names} of those below"))
    theta_i, phi_i, theta_r, phi_r = values.angles
    result = measurement(
        source,
        kind,
        theta_i,
        phi_i,
        theta_r,
        phi_r,
        values.brdf,
        channels=values.channels,
        wavelength=values.um,
        stderr=values.stderr,
        findings=notes,
    )
    if options.wavelength_nm is not None:
        result = result.noting(*overruled(prose.wavelength_in(table.comments), options.wavelength_nm))
    result = _scaled(result, table, given, options)
    side = any(comment.replace(" ", "").startswith("mirror-side:phi=180") for comment in table.comments)
    # before the side is judged: a cosine would hide the brighter one
    result = with_stated_quantity(source, result, given, table, options)
    return on_its_side(result, found.azimuths, options, side)


def _scaled(result: Measurement, table: Sheet, given: Assigned, options: Options) -> Measurement:
    """Times the factor that comments state, unless --scale or a column's name says it."""
    factor = prose.scale_in(table.comments)
    if factor in {column.factor for column in given.all("value")}:
        factor = None  # the same unit, said twice
    elif factor is None and all(not column.scale and column.factor == 1 for column in given.all("value")):
        factor = prose.unit_of_values_in(table.comments)
    if factor not in (None, 1.0) and options.scale is None:
        text = f"the comments state a scale of {factor:g}: values multiplied by it"
        stderr = None if result.stderr is None else result.stderr * factor
        result = replace(result, brdf=result.brdf * factor, stderr=stderr)
        return result.noting(Finding("scale-stated", text, option="--scale"))
    return result


def _apart(source: Source, table: Sheet, given: Assigned, found: RowDirections, values: Values) -> list[Finding]:
    """Whether rows that are alike belong together; see `_groups.told_apart`."""
    column = given.one("wavelength") or given.one("wavenumber")
    rows = len(table.values)
    if column is not None and column.place in table.texts:
        cells = table.texts[column.place]
        number = {cell: place for place, cell in enumerate(dict.fromkeys(cells))}
        wavelength = np.array([number[cell] for cell in cells], float)
    else:
        wavelength = table.values[:, column.place] if column is not None else np.zeros(rows)
    return _groups.told_apart(source, table, given.columns, found.degrees, wavelength, values.by_row)


def _read(given: Assigned, found: RowDirections) -> Finding:
    """The note on what was made of each column."""
    parts = []
    for column in given.columns:
        if column.role in ("value", "stderr", None, "ignore"):
            continue
        in_unit = f" in {column.unit}" if column.unit and column.role == "wavelength" else ""
        parts.append(f"'{column.name[:40]}' as {column.role}{in_unit}")
    values, doubts = given.all("value"), given.all("stderr")
    parts.append(_several(values, "values"))
    if doubts:
        parts.append(_several(doubts, "standard errors"))
    said = f"; {found.unit}" if found.unit else ""
    return Finding("columns-read", f"columns read: {', '.join(parts)}{said}")


def _several(columns: list[Column], what: str) -> str:
    names = [f"'{column.name[:40]}'" for column in columns]
    shown = ", ".join(names) if len(names) < 4 else f"{names[0]} to {names[-1]}"
    return f"{shown} as {what}" if len(names) < 4 else f"{len(names)} columns {shown} as {what}"
