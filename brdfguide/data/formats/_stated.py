"""What the cells of a column state beside their numbers: errors, units, limits. Errors become a column of their own."""

from dataclasses import replace

import numpy as np

from ...finding import Finding
from ..columns.facts import facts
from ..columns.grammar import understood
from ..columns.vocabulary import LENGTH_UNITS
from ._cells import is_missing
from ._sections import opens_a_section, with_sections
from ._sheet import Sheet, read_sheet
from ._tables import with_unit
from ._written import BOTH, Style, Written, number_in, tidy, unit_of
from .format import Options, Source


def sheet_of(source: Source, options: Options) -> Sheet:
    """The table in a text, with what its cells and the lines between its rows state as columns. Raises InputError."""
    headerless = options.columns if isinstance(options.columns, tuple) else None
    return with_sections(with_stated(source, read_sheet(source, headerless, opens_a_section)))


def with_stated(source: Source, table: Sheet) -> Sheet:
    """The table with the numbers of cells that state more than one, such as `0.10 ± 0.01` or `45 %`.

    Raises InputError for a column of several units, or of another than its name says.
    """
    names, values, texts = list(table.names), table.values, dict(table.texts)
    notes: list[Finding] = []
    style = _with_thousands(table)
    for place, cells in table.texts.items():
        found = _all_written(cells, style)
        if found is None or _names_bands(names[place], found):
            continue
        del texts[place]
        values = values.copy() if values is table.values else values
        values[:, place] = [each.number for each in found]
        names[place] = name = _with_unit(source, table, place, found)
        notes += _limits(name, cells, found)
        if any(each.error is not None for each in found):
            errors, note = _errors(source, table, place, found, name)
            notes.append(note)
            if errors is not None:
                names.append(f"u({name})")
                values = np.column_stack([values, errors])
    return replace(table, names=names, values=values, texts=texts, findings=(*table.findings, *notes))


def _with_thousands(table: Sheet) -> Style:
    """The style, with thousands parted by a mark where some cell, `1,234.5`, has both marks."""
    both = BOTH["," if table.style.decimal == "." else "."]
    has_both = any(both.search(cell) for cells in table.texts.values() for cell in cells)
    return replace(table.style, thousands=True) if has_both else table.style


def _all_written(cells: list[str], style: Style) -> list[Written] | None:
    """What every cell says, NaN where it is missing; None where one holds something else, or all are missing."""
    found = []
    for cell in cells:
        missing = Written(float("nan")) if is_missing(cell) else None
        each = missing or number_in(cell, style) or number_in(tidy(cell), style)
        if each is None:
            return None
        found.append(each)
    return found if any(np.isfinite(each.number) for each in found) else None


def _names_bands(name: str, found: list[Written]) -> bool:
    """Whether the column names the band of each row, `450 nm`, under a name that is no wavelength."""
    units = {unit_of(each.unit) for each in found if each.unit}
    return understood(name).role is None and any(each is not None and each.unit in LENGTH_UNITS for each in units)


def _with_unit(source: Source, table: Sheet, place: int, found: list[Written]) -> str:
    """The column's name with the unit of its cells. Raises InputError for several, and for another than the name's."""
    name = table.names[place]
    rows = [row for row, each in enumerate(found) if each.unit or np.isfinite(each.number) and each.number != 0]
    kinds = {_kind(found[row].unit): row for row in reversed(rows)}
    cells = table.texts[place]
    if len(kinds) > 1:
        first, other = sorted(kinds.values())[:2]
        text = f"column '{name[:60]}': found '{cells[other][:40]}' and above it '{cells[first][:40]}'"
        raise source.error(f"{text}; wanted one unit for all", int(table.lines[other]))
    row = next(iter(kinds.values()), 0)
    unit = found[row].unit
    says, named = unit_of(unit), facts(name)[0]
    if says is None or says.unit and says.unit == named.unit:
        return name
    if says.scale and named.scale == says.scale or says.per_sr and named.per_sr and named.factor == says.factor:
        return name
    if says.scale and named.scale or says.per_sr and named.per_sr:
        text = f"column '{name[:60]}': found '{cells[row][:40]}', which is in another unit than the name says"
        raise source.error(f"{text}; correct one of them", int(table.lines[row]))
    return with_unit(source, name, unit)


def _kind(unit: str) -> tuple:
    says = unit_of(unit)
    return () if says is None else (says.unit, says.scale, says.per_sr, says.factor)


def _limits(name: str, cells: list[str], found: list[Written]) -> list[Finding]:
    limits = [cell for cell, each in zip(cells, found, strict=True) if each.limit]
    if not limits:
        return []
    text = f"{len(limits)} of {len(cells)} cells of '{name[:40]}' are limits, such as '{limits[0][:20]}'"
    numbers = (("values", len(limits)), ("of", len(cells)))
    consequence = "they take no part in a fit"
    return [Finding("marks-missing", f"{text}: taken as missing", consequence=consequence, numbers=numbers)]


def _errors(source: Source, table: Sheet, place: int, found: list[Written], name: str):
    """The column of the errors that cells state, or None where nothing is made of them, and the note on it.

    Raises InputError for errors in percent of a logarithm.
    """
    column = understood(name)
    if column.role not in ("value", None):
        text = f"the errors in the cells of '{name[:40]}' were left out: directions are taken as exact"
        return None, Finding("columns-ignored", text)
    doubts = [each for each in map(understood, table.names) if each.role == "stderr"]
    if any(each.channel == column.channel and each.at == column.at for each in doubts):
        text = f"the errors in the cells of '{name[:40]}' were left out: a column gives them"
        return None, Finding("columns-ignored", text)
    percent = next((row for row, each in enumerate(found) if each.percent), None)
    if percent is not None and column.scale not in ("", "%"):
        cell = table.texts[place][percent][:40]
        raise source.error(f"column '{name[:60]}': found '{cell}', percent of a logarithm", int(table.lines[percent]))
    text = f"the errors in the cells of '{name[:40]}' are taken as standard errors"
    note = Finding("stderr-read", text, option="--columns", numbers=(("coverage_factor", 1.0),))
    return np.array([_error(each) for each in found]), note


def _error(cell: Written) -> float:
    if cell.error is None:
        return float("nan")
    return abs(cell.number) * cell.error / 100 if cell.percent else abs(cell.error)
