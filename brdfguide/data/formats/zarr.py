"""zarr: a folder with a group of 1-D arrays named as columns, or a 2-D array whose attribute names them. Needs zarr."""

from functools import partial
from pathlib import Path
from warnings import catch_warnings, simplefilter

from ...opening import ARRAY_FOLDER
from . import _named_arrays
from ._tables import damage_told, library
from .format import Source

KIND = "zarr table"


def recognises(head: bytes) -> bool:
    return head.startswith(ARRAY_FOLDER)


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


FORMAT = _named_arrays.format_of("zarr", (".zarr",), recognises, _tables)
