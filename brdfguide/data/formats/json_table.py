"""Table in JSON: rows with names, in a list or one a line, `{"theta_i": 10, "theta_r": -5, "brdf": 0.1}`; columns by
name, `{"theta_i": [...], ...}`; or `columns` and `data`, as pandas writes them. Words beside it count as comments.
"""

import json

from ..measurement import Measurement
from . import _groups, _meaning
from ._json import ROWS, is_table
from ._sheet import Sheet
from ._stated import with_stated
from ._tables import sheet_of_columns
from .format import OF_TABLES, Format, Options, Source

LIMIT = 2**24  # bytes: what Python makes of it takes up to sixty times as much
NAMES = ("columns", "names", "header", "fields")  # keys of the columns' names
WANTED = 'wanted rows with names, [{"theta_i": 10, ...}], or columns by name, {"theta_i": [...]}'


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for JSON that is no table, and as tables of text do."""
    return _meaning.measurement_of(source, _sheet(source), options, kind="JSON table")


def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
    """The values of a column, in the order in which they come. Raises InputError where they are no groups."""
    table, _ = _groups.selected(source, _sheet(source), options.select)
    return _groups.values_of_group(source, table, column)


def _sheet(source: Source) -> Sheet:
    document = _document(source)
    comments: tuple[str, ...] = ()
    names: list = []
    if isinstance(document, dict):
        plain = {key: each for key, each in document.items() if isinstance(each, (str, int, float))}
        comments = tuple(f"{key}: {line}" for key, each in plain.items() for line in str(each)[:1000].splitlines())
        names = next((each for key in NAMES if isinstance(each := document.get(key), list)), [])
        rows = next((each for key in ROWS if _are_rows(each := document.get(key))), None)
        document = _by_column(document) if rows is None else rows
    columns = _columns(source, document, [str(each) for each in names])
    if not columns:
        raise source.error(f"JSON without a table; {WANTED}")
    return with_stated(source, sheet_of_columns(source, list(columns), list(columns.values()), 1, comments))


def _document(source: Source):
    """What the text holds; rows that stand one a line as a list of them."""
    try:
        return json.loads(source.text)
    except (ValueError, RecursionError) as error:
        lines = [line for line in source.lines if line.strip()]
        if len(lines) < 2 or not all(line.strip()[0] == "{" for line in lines[:2]):
            raise source.error(f"not valid JSON: {error}") from None
    found = []
    for number, line in enumerate(source.lines, 1):
        try:
            found += [json.loads(line)] if line.strip() else []
        except (ValueError, RecursionError) as error:
            raise source.error(f"not valid JSON: {error}", number) from None
    return found


def _are_rows(value) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], (dict, list))


def _by_column(document: dict) -> dict[str, list]:
    """The columns in an object: lists, or numbers by the row's name."""
    found = {key: list(each.values()) if isinstance(each, dict) else each for key, each in document.items()}
    return {key: each for key, each in found.items() if isinstance(each, list)}


def _columns(source: Source, document, names: list[str]) -> dict[str, list]:
    """The cells of each column. Raises InputError for rows and columns that do not go together."""
    if isinstance(document, dict):
        lengths = {key: len(each) for key, each in document.items()}
        first = next(iter(lengths), "")
        for key, length in lengths.items():
            if length != lengths[first]:
                text = f"found {lengths[first]} values of '{first[:40]}' and {length} of '{key[:40]}'"
                raise source.error(f"{text}; wanted columns of one length")
        return document if any(lengths.values()) else {}
    if not _are_rows(document):
        return {}
    if isinstance(document[0], dict):
        names = list(dict.fromkeys(key for row in document if isinstance(row, dict) for key in row))
        rows = [[row.get(name) for name in names] if isinstance(row, dict) else [] for row in document]
    else:
        if not names and all(isinstance(each, str) for each in document[0]):
            names, document = document[0], document[1:]
        rows = [row if isinstance(row, list) else [] for row in document]
    for place, row in enumerate(rows, 1):
        if len(row) != len(names):
            raise source.error(f"row {place}: found {len(row)} values, wanted {len(names)} ({', '.join(names)[:80]})")
    return {name: list(cells) for name, cells in zip(names, zip(*rows, strict=True), strict=True)}


FORMAT = Format(
    "json-table", (".json", ".jsonl"), is_table, read, LIMIT, own_side=False, groups=groups, options=OF_TABLES
)
