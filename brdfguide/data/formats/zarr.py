"""zarr: a folder with a group of 1-D arrays named as columns, or a 2-D array whose attribute names them. Needs zarr."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from warnings import catch_warnings, simplefilter

from ...opening import ARRAY_FOLDER
from ..measurement import Measurement
from . import _named_arrays
from ._tables import damage_told, library
from .format import Format, Options, Source

KIND = "zarr table"


def recognises(head: bytes) -> bool:
    return head.startswith(ARRAY_FOLDER)


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a damaged folder, for one without a table or with several, and as tables do."""
    return _named_arrays.read_table(source, _tables(source), options)


def groups(source: Source, options: Options, column: str) -> tuple[str, ...]:
    """The values of a column, in the order in which they come. Raises InputError where they are no groups."""
    return _named_arrays.groups_of(source, _tables(source), options, column)


def is_large(source: Source) -> bool:
    """Whether it is read in pieces. Raises InputError for a damaged folder."""
    return _named_arrays.is_large(_tables(source))


def parts(source: Source, options: Options) -> Iterator[Measurement]:
    """The same as `read` gives, in pieces. Raises InputError as `read`."""
    return _named_arrays.parts_of(source, _tables(source), options)


def _tables(source: Source) -> list[_named_arrays.ArrayTable]:
    zarr = library("zarr", "zarr", source, "a zarr folder")
    if source.place is None:
        raise source.error("a zarr folder is read where it lies, not from a stream")
    with damage_told(source, KIND):
        root = zarr.open(str(source.place), mode="r", use_consolidated=False)  # what is there, not what a list says
    return _named_arrays.tables_in(source, KIND, root, partial(_members, source), partial(_stored, source.place))


def _members(source: Source, group) -> dict:
    """Arrays and groups by name. Raises InputError for a folder that lost what says what it is."""
    with catch_warnings():
        simplefilter("ignore")  # of plain files that are no part of it
        found = dict(group.members())
    for each in sorted((source.place / group.path).iterdir()):
        if each.is_dir() and each.name not in found and not each.name.startswith("."):
            raise source.error(f"'{each.name[:40]}' in it is a folder that is neither an array nor a group")
    return {name: found[name] for name in _named_arrays.sorted_names(found)}


def _stored(folder: Path, array) -> int:
    """Bytes of the files that hold an array."""
    return sum(each.stat().st_size for each in (folder / array.path).rglob("*"))


FORMAT = Format(
    "zarr",
    (".zarr",),
    recognises,
    read,
    own_side=False,
    groups=groups,
    options=("columns", "unit", "select", "rotation_sense"),
    parts=parts,
    is_large=is_large,
    in_place=True,
)
