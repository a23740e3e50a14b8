"""Apache Parquet: columns read as those of a table of text are. Needs pyarrow."""

from collections.abc import Iterator

from ...errors import NothingLeft
from ..measurement import Measurement
from . import _groups, _meaning
from ._sheet import Sheet
from ._stated import with_stated
from ._tables import damage_told, library, sheet_of_columns, with_unit
from .format import OF_TABLES, Format, Options, Source

MOST_CELLS = 50_000_000
LARGEST_CELLS = 8_000_000  # beyond, a fit reads it in pieces
TOGETHER = 65_536  # rows of a piece
KIND = "Parquet table"
FILE = "Parquet file"
NUMBERS = ("double", "float", *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)))


def recognises(head: bytes) -> bool:
    return head[:4] == b"PAR1"


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a damaged file, for columns within columns, and as tables do."""
    return _meaning.measurement_of(source, _sheet(source), options, kind=KIND)


def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
    """The values of a column, in the order in which they come. Raises InputError where they are no groups."""
    table, _ = _groups.selected(source, _sheet(source), options.select)
    return _groups.values_of_group(source, table, column)


def is_large(source: Source) -> bool:
    """Whether it is read row group by row group. Raises InputError for a damaged file."""
    with damage_told(source, FILE):
        about = _opened(source).metadata
        return about.num_rows * about.num_columns > LARGEST_CELLS


def parts(source: Source, options: Options) -> Iterator[Measurement]:
    """The same as `read` gives, in pieces of so many rows. Raises InputError as `read`."""
    first = 1
    with damage_told(source, FILE):
        batches = _opened(source).iter_batches(batch_size=TOGETHER)
    while True:
        with damage_told(source, FILE):
            batch = next(batches, None)
            columns = [] if batch is None else [_cells(column) for column in batch.columns]
        if batch is None:
            return
        sheet = with_stated(source, sheet_of_columns(source, _names(source, batch.schema), columns, first))
        first += batch.num_rows
        try:
            yield _meaning.measurement_of(source, sheet, options, kind=KIND)
        except NothingLeft:
            continue


def _opened(source: Source):
    pyarrow = library("pyarrow", "parquet", source, "a Parquet table")
    parquet = library("pyarrow.parquet", "parquet", source, "a Parquet table")
    held = pyarrow.OSFile(str(source.place)) if source.place else pyarrow.BufferReader(pyarrow.py_buffer(source.data))
    return parquet.ParquetFile(held)


def _sheet(source: Source) -> Sheet:
    with damage_told(source, FILE):
        file = _opened(source)
        rows, columns = file.metadata.num_rows, len(file.schema_arrow)
        if rows * columns > MOST_CELLS:
            raise source.error(f"{rows} rows of {columns} columns are more than is read at once")
        table = file.read()
    if not rows or not columns:
        raise source.error("there is no row in it")
    if any(len(column) != rows for column in table.columns):
        raise source.error(f"a damaged Parquet file: not every column holds the {rows} rows that it promises")
    with damage_told(source, FILE):
        cells = [_cells(column) for column in table.columns]
    return with_stated(source, sheet_of_columns(source, _names(source, table.schema), cells, 1))


def _names(source: Source, schema) -> list[str]:
    """Columns as they are called, with the unit that a field's metadata give."""
    units = [(field.metadata or {}).get(b"units", b"").decode("utf-8", "replace").strip() for field in schema]
    return [with_unit(source, str(field.name), unit) for field, unit in zip(schema, units, strict=True)]


def _cells(column):
    """The numbers of a column of Arrow, or its cells."""
    if str(column.type) in NUMBERS:
        return column.to_numpy(zero_copy_only=False).astype(float)
    return column.to_pylist()


FORMAT = Format(
    "parquet",
    (".parquet",),
    recognises,
    read,
    own_side=False,
    groups=groups,
    options=OF_TABLES,
    parts=parts,
    is_large=is_large,
    in_place=True,
)
