"""Rows that belong to different samples, bands or polarisations: picked by a column's value, or told apart by it."""

import numpy as np

from ...errors import BrdfguideError, InputError, NoAnswer, choices
from ...finding import Finding
from ..columns.facts import Column, facts, spelt_out
from ..columns.vocabulary import COLOURS, word_set
from ._cells import is_number
from ._roles import first_names
from ._sheet import Sheet
from .format import Source

MOST_GROUPS = 50  # a column with more different values names no groups
UNEQUAL = 0.15  # rms of ln over repeated directions beyond which they are not one surface's
TOLD_APART = 0.05  # the same where a column tells them apart that does not merely count runs
LEAST_REPEATS = 4
LEAST_COPIES = 8  # rows that others repeat in every cell
COPIED = 0.9  # share of these in what repeats a direction
AT_THE_NORMAL_DEG = 0.05  # where any azimuth is the same direction
MOST_MARKS = 10  # different values of a column that marks rows as good or bad
LABELS = word_set(
    "sample samples specimen material coating paint colour color side face piece panel part tile pol polarisation "
    "polarization polariser polarizer band filter batch lot"
)
MARKS_ROWS = word_set(
    "mask masked valid invalid flag flags flagged quality qc outlier outliers reject rejected exclude excluded "
    "saturated saturation bad good usable ok keep"
)
OF_A_REPEAT = word_set("run scan repeat repetition rep cycle no number nr index id count shot frame")
OF_THE_RUN = word_set(
    "time date timestamp datetime clock hour comment comments remark remarks note notes operator file"
)


def selected(source: Source, table: Sheet, conditions) -> tuple[Sheet, list[Finding]]:
    """The rows that have these values in these columns. Raises InputError where none has."""
    notes = []
    for name, value in conditions:
        place = _column(source, table, name)
        cells = cells_of_column(table, place)
        kept = np.array([same(cell, value) for cell in cells], bool)
        if not np.any(kept):
            raise choices(f"value of '{table.names[place]}' in {source.name}", value, distinct(cells)[:MOST_GROUPS])
        text = f"{np.count_nonzero(kept)} of {len(kept)} rows: those whose {table.names[place]} is {value}"
        numbers = (("rows", int(np.count_nonzero(kept))), ("of", len(kept)))
        notes.append(Finding("rows-selected", text, option="--select", numbers=numbers))
        table = table.rows(kept)
    return table, notes


def values_of_group(source: Source, table: Sheet, name: str) -> tuple[str, ...]:
    """The different values of a column. Raises InputError where they are too many to be groups."""
    place = _column(source, table, name)
    found = distinct(cells_of_column(table, place))
    if len(found) > MOST_GROUPS:
        raise source.error(f"--group {name}: {len(found)} different values; wanted at most {MOST_GROUPS}")
    return tuple(found)


def rows_once(table: Sheet, columns, angles) -> tuple[np.ndarray, list[Finding]]:
    """Which rows to keep, (rows,), and the note on the others: those that repeat one above digit for digit in every
    cell, where nearly all that repeat a direction do. No two readings are so; a file that was joined with itself is."""
    waves = next((each.place for each in columns if each.role in ("wavelength", "wavenumber")), None)
    texts = [np.unique(cells, return_inverse=True)[1] for cells in table.texts.values()]
    whole = _hashed([*np.ascontiguousarray(table.values.T).view(np.uint64), *texts])
    copies = len(whole) - len(np.unique(whole))
    if copies < LEAST_COPIES:
        return np.ones(len(whole), bool), []
    oblique = np.min(np.abs([angles[0], angles[2]]), axis=0) > AT_THE_NORMAL_DEG
    directions = _same_direction(angles, np.zeros(len(whole)) if waves is None else table.values[:, waves])
    counts = np.unique(whole[oblique], return_counts=True)[1]
    repeated = np.count_nonzero(oblique) - len(np.unique(directions[oblique]))
    if np.count_nonzero(counts > 1) < LEAST_COPIES or np.sum(counts - 1) < COPIED * repeated:
        return np.ones(len(whole), bool), []
    kept = np.zeros(len(whole), bool)
    kept[np.unique(whole, return_index=True)[1]] = True
    text = f"{copies} of {len(whole)} rows repeat others digit for digit in every cell: they count once"
    return kept, [Finding("rows-copied", text, "warning", numbers=(("rows", copies), ("of", len(whole))))]


def told_apart(source: Source, table: Sheet, columns, angles, wavelength, values) -> list[Finding]:
    """A note where repeated directions have unequal values and no column says why.

    Raises InputError where a column that is ignored names different samples, NoAnswer where equal directions have
    unequal values besides, or such a column tells them apart.
    """
    left = [column for column in columns if column.role is None]
    row = _same_direction(angles, wavelength)
    spread, repeats = _spread(row, values)
    unequal = repeats >= LEAST_REPEATS and spread >= UNEQUAL
    for column in left:
        groups = _groups(table, column)
        if groups and _words_of(column) & MARKS_ROWS and len(groups) <= MOST_MARKS:
            raise _choose_marked(source, column, groups)
        if groups and _is_label(table, column):
            names = f"the column '{column.name[:40]}' names {len(groups)} groups"
            raise _choose(source, column, groups, names, NoAnswer if unequal else InputError)
    if repeats < LEAST_REPEATS or spread < TOLD_APART:
        return []
    apart = f"{repeats} rows repeat a direction, and their values differ by {np.expm1(spread):.0%} (rms)"
    for column in left:
        groups, counts_runs = _groups(table, column), bool(_words_of(column) & OF_A_REPEAT)
        if not groups or spread < UNEQUAL and counts_runs:
            continue
        if _varies_within(row, cells_of_column(table, column.place)):
            tells = f"the column '{column.name[:40]}', which is ignored, tells them apart"
            raise _choose(source, column, groups, f"{apart}; {tells}", NoAnswer)
    if spread < UNEQUAL:
        return []
    text = f"{apart}: not one surface, or not all of the directions is said"
    consequence, numbers = "models are fitted to their mean", (("rms_ln", spread),)
    ignored = any(column.role == "ignore" for column in columns)
    settles = ("repeats",) if ignored else ()
    return [Finding("repeats-differ", text, "warning", consequence, numbers=numbers, settles=settles)]


def _same_direction(angles, wavelength) -> np.ndarray:
    """A number for each row, the same for rows of one direction and wavelength to 0.001."""
    steps = []
    for column in (*angles, wavelength):
        sane = np.where(np.abs(column) < 1e12, column, 0.0)  # what is larger is refused later, or no number
        steps.append(np.round(sane * 1000).astype(np.int64))
    return np.unique(_hashed(steps), return_inverse=True)[1].reshape(-1)


def _hashed(columns) -> np.ndarray:
    """64 bits for each row of some columns of integers."""
    key = np.zeros(len(columns[0]), np.uint64)
    for column in columns:
        key = (key ^ column.astype(np.uint64)) * np.uint64(0x9E3779B97F4A7C15)  # the golden ratio's odd multiplier
        key ^= key >> np.uint64(29)
    return key


def as_channels(table: Sheet, place: int) -> list[str] | None:
    """A channel for each row where every cell of a text column is a wavelength or a colour; None where one is not."""
    meaning: dict[str, str | None] = {}
    for cell in distinct(table.texts.get(place, [])):
        column = facts(cell)[0]
        plain = [token.text for token in spelt_out(cell)]
        colour = COLOURS.get(plain[0]) if len(plain) == 1 else None
        meaning[cell] = f"{1000 * column.um:.9g}nm" if column.um is not None else colour
    if not meaning or None in meaning.values():
        return None
    return [meaning[cell] or "" for cell in table.texts[place]]


def distinct(cells) -> list[str]:
    return list(dict.fromkeys(cell for cell in cells if cell))


def cells_of_column(table: Sheet, place: int) -> list[str]:
    """The cells of a column as text; numbers in their shortest form, nothing for a missing one."""
    if place in table.texts:
        return table.texts[place]
    return ["" if value != value else f"{value:.9g}" for value in table.values[:, place].tolist()]


def same(cell: str, value: str) -> bool:
    """Whether a cell holds what was asked for: the same number, or the same text whatever the case of its letters."""
    try:
        return abs(float(cell) - float(value)) <= 1e-9 * abs(float(value))
    except ValueError:
        return cell.strip().lower() == value.strip().lower()


def _column(source: Source, table: Sheet, name: str) -> int:
    lower = [each.lower().strip() for each in table.names]
    if name.lower().strip() not in lower:
        raise choices(f"column in {source.name}", name, table.names)
    return lower.index(name.lower().strip())


def _groups(table: Sheet, column: Column) -> list[str]:
    """The values of a column that names groups of rows: several, few, and most of them more than once."""
    if column.place not in table.texts and len(np.unique(table.values[:, column.place])) > MOST_GROUPS + 1:
        return []
    found = distinct(cells_of_column(table, column.place))
    return found if 1 < len(found) <= min(MOST_GROUPS, len(table.values) // 2) else []


def _words_of(column: Column) -> set[str]:
    return {token.text for token in spelt_out(column.name)}


def _is_label(table: Sheet, column: Column) -> bool:
    """Whether the column names what was measured: by its name, or since it holds text that is not about the run."""
    said = _words_of(column)
    text = [cell for cell in table.texts.get(column.place, ()) if cell and not is_number(cell)]
    return bool(said & LABELS or len(text) > len(table.values) // 2 and not said & OF_THE_RUN)


def _spread(row, values) -> tuple[float, int]:
    """rms of ln (value / mean) over rows of one direction, and how many repeat one."""
    with np.errstate(invalid="ignore"):
        good = np.all(np.isfinite(values) & (values > 0), axis=1)
    row, level = row[good], np.log(values[good]).mean(axis=1)
    counts = np.bincount(row)
    mean = np.bincount(row, level) / np.maximum(counts, 1)
    repeated = counts[row] > 1
    freedom = np.count_nonzero(repeated) - np.count_nonzero(counts > 1)
    if not freedom:
        return 0.0, 0
    return float(np.sqrt(np.sum((level - mean[row])[repeated] ** 2) / freedom)), int(freedom)


def _varies_within(row, cells) -> bool:
    """Whether rows of one direction mostly differ in this column."""
    number = {cell: place for place, cell in enumerate(dict.fromkeys(cells))}
    both = np.unique(np.column_stack([row, [number[cell] for cell in cells]]), axis=0)
    return len(both) - len(np.unique(row)) > 0.5 * (len(row) - len(np.unique(row)))


def _choose_marked(source: Source, column: Column, groups: list[str]) -> InputError:
    name = column.name if " " not in column.name else f'"{column.name}"'
    return InputError(
        f"{source.name}: the column '{column.name[:40]}' marks rows ({first_names(groups)}), and which are good is not "
        f"said: take some with --select {name}={groups[0]}, or all with --columns ignore={name}"
    )


def _choose(source: Source, column: Column, groups: list[str], sentence: str, kind: type[BrdfguideError]):
    name = column.name if " " not in column.name else f'"{column.name}"'
    first = groups[0] if " " not in groups[0] else f'"{groups[0]}"'
    return kind(
        f"{source.name}: {sentence} ({first_names(groups)}): fit one with --select {name}={first}, each with "
        f"--group {name}, or all as one surface with --columns ignore={name}"
    )
