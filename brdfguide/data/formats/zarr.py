"""zarr: a folder, or a ZIP of one, with a group of 1-D arrays named as columns, or a 2-D array whose attribute names
them. Needs zarr.
"""

import re
from functools import partial
from pathlib import Path
from warnings import catch_warnings, simplefilter

from ...opening import ARRAY_FOLDER, ARRAY_FOLDERS
from . import _named_arrays
from ._tables import damage_told, library
from .format import Source

KIND = "zarr table"
MOST_SWELLING = 200  # of a ZIP: chunks are packed by themselves
ZIPPED = re.compile(  # an entry of a ZIP: a name that zarr gives, or a folder that is called so
    rb"PK\x03\x04.{26}(?:[^\0]{0,200}/)?(?:zarr\.json|\.zgroup|\.zarray|\.zattrs|\.zmetadata|[^\0/]{1,80}\.zarr/)",
    re.DOTALL,
)


def recognises(head: bytes) -> bool:
    return head.startswith(ARRAY_FOLDER) or head.startswith(b"PK\x03\x04") and bool(ZIPPED.search(head))


def _tables(source: Source) -> list[_named_arrays.ArrayTable]:
    zarr = library("zarr", "zarr", source, "a zarr folder")
    if source.place is None:
        raise source.error("a zarr folder, or a ZIP of one, is read where it lies, not from a stream")
    import logging

    logging.getLogger("asyncio").addFilter(_of_others)
    with damage_told(source, KIND):
        if source.place.is_dir():
            files, store = _folder(source.place), str(source.place)
        else:
            files, store = _archive(source), zarr.storage.ZipStore(source.place, mode="r")
        top = _top(source, files)
        root = zarr.open(store, mode="r", path=top, use_consolidated=False)  # what is there, not what a list says
    return _named_arrays.tables_in(source, KIND, root, partial(_members, source, files), partial(_stored, files))


def _of_others(record) -> bool:
    """Whether it is no second error of a damaged folder, beside the one that is told."""
    return "zarr" not in record.getMessage()


def _folder(folder: Path) -> dict[str, int]:
    """Every file in it, and its bytes."""
    return {each.relative_to(folder).as_posix(): each.stat().st_size for each in folder.rglob("*") if each.is_file()}


def _archive(source: Source) -> dict[str, int]:
    """The same of a ZIP, as packed. Raises InputError for one that swells more than any of measured values."""
    from zipfile import ZipFile

    assert source.place
    with ZipFile(source.place) as archive:
        entries = [each for each in archive.infolist() if not each.is_dir()]
    packed, size = (sum(getattr(each, of) for each in entries) for of in ("compress_size", "file_size"))
    if size > 2**20 + MOST_SWELLING * packed:
        raise source.error(f"unpacks to more than {MOST_SWELLING} times its size, which no measurement does")
    return {each.filename: each.compress_size for each in entries}


def _top(source: Source, files: dict[str, int]) -> str:
    """Where the zarr folder lies in an archive: nowhere else, or the one folder that is one. Raises InputError for
    several."""
    if any(mark in files for mark in ARRAY_FOLDERS):
        return ""
    tops = dict.fromkeys(name.partition("/")[0] for name in files)
    found = [top for top in tops if any(f"{top}/{mark}" in files for mark in ARRAY_FOLDERS)]
    if len(found) > 1:
        raise source.error(f"{len(found)} zarr folders in it ({', '.join(found)[:80]}); wanted one")
    return "".join(found)


def _members(source: Source, files: dict[str, int], group) -> dict:
    """Arrays and groups by name. Raises InputError for a folder that lost what says what it is."""
    with catch_warnings():
        simplefilter("ignore")  # of plain files that are no part of it
        found = dict(group.members())
    inside = f"{group.path}/" if group.path else ""
    parts = [name[len(inside) :].partition("/") for name in files if name.startswith(inside)]
    for name in sorted({first for first, parted, _ in parts if parted}):
        if name not in found and not name.startswith(".") and name != "__MACOSX":
            raise source.error(f"'{name[:40]}' in it is a folder that is neither an array nor a group")
    return {name: found[name] for name in _named_arrays.sorted_names(found)}


def _stored(files: dict[str, int], array) -> int:
    """Bytes of the files that hold an array."""
    return sum(size for name, size in files.items() if name.startswith(f"{array.path}/" if array.path else ""))


FORMAT = _named_arrays.format_of("zarr", (".zarr", ".zarr.zip"), recognises, _tables)
