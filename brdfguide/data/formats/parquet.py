"""Apache Parquet: columns read as those of a table of text are. Needs pyarrow."""

import io

import numpy as np

from ..measurement import Measurement
from . import _groups, _meaning
from ._sheet import Sheet
from ._tables import library
from .format import Format, Options, Source

MOST_CELLS = 50_000_000


def recognises(head: bytes) -> bool:
    return head[:4] == b"PAR1"


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a damaged file, for columns within columns, and as tables do."""
    return _meaning.measurement_of(source, _sheet(source), options, kind="Parquet table")


def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
    """The values of a column, in the order in which they come. Raises InputError where they are no groups."""
    table, _ = _groups.selected(source, _sheet(source), options.select)
    return _groups.values_of_group(source, table, column)


def _sheet(source: Source) -> Sheet:
    library("pyarrow", "parquet", source, "a Parquet table")
    parquet = library("pyarrow.parquet", "parquet", source, "a Parquet table")
    try:
        file = parquet.ParquetFile(io.BytesIO(bytes(source.data)))
        rows, columns = file.metadata.num_rows, len(file.schema_arrow)
        if rows * columns > MOST_CELLS:
            raise source.error(f"{rows} rows of {columns} columns are more than a measurement honestly holds")
        table = file.read()
        names = [str(name) for name in table.column_names]
        lists = [column.to_pylist() for column in table.columns]
    except (OSError, ValueError, ArithmeticError, KeyError, TypeError) as error:  # Arrow's own errors are of these
        raise source.error(f"a damaged Parquet file: {str(error)[:100]}") from None
    if not rows or not columns:
        raise source.error("there is no row in it")
    if any(len(cells) != rows for cells in lists):
        raise source.error(f"a damaged Parquet file: not every column holds the {rows} rows that it promises")
    values, texts = np.full((rows, columns), np.nan), {}
    for place, cells in enumerate(lists):
        if any(isinstance(cell, (dict, list, tuple, bytes)) for cell in cells):
            raise source.error(f"the column '{names[place][:40]}' holds no plain numbers or words")
        numbers = [float(cell) if isinstance(cell, (int, float)) else np.nan for cell in cells]
        values[:, place] = numbers
        if any(cell is not None and not isinstance(cell, (int, float)) for cell in cells):
            texts[place] = ["" if cell is None else str(cell) for cell in cells]
            values[:, place] = [_number(cell) for cell in texts[place]]
    return Sheet(names, values, np.arange(1, rows + 1), [], [], texts=texts)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")


FORMAT = Format(
    "parquet",
    (".parquet",),
    recognises,
    read,
    own_side=False,
    groups=groups,
    options=("columns", "unit", "select", "rotation_sense"),
)
