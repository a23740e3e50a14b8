"""HDF5: a group of 1-D datasets named as columns, or a 2-D dataset whose attribute names them. Needs h5py.

Links to other files and datasets that keep their numbers in some are refused.
"""

import io
import os
import signal
import subprocess
import sys
from functools import partial
from hashlib import sha256

from . import _hdf5_trial, _named_arrays
from ._tables import damage_told, library
from .format import Source

KIND = "HDF5 table"
MAGIC = b"\x89HDF\r\n\x1a\n"
REMEMBERED = 8  # files that were tried already
_TRIED: dict[tuple, None] = {}


def recognises(head: bytes) -> bool:
    return head.startswith(MAGIC)


def _tables(source: Source) -> list[_named_arrays.ArrayTable]:
    h5py = library("h5py", "hdf5", source, "an HDF5 file")
    _try_beforehand(source)
    with damage_told(source, KIND):
        content = _Content(source)
        root = _Node(h5py.File(io.BufferedReader(content), "r"), h5py)
    return _named_arrays.tables_in(source, KIND, root, partial(_members, source, h5py), _stored)


def _try_beforehand(source: Source) -> None:
    """Raises InputError for a damaged file that keeps the library busy for ever, or ends the process that reads it."""
    key = _what_it_is(source)
    if key in _TRIED:
        return
    command = [sys.executable, "-I", _hdf5_trial.__file__, "-" if source.place is None else str(source.place)]
    held = source.data if source.place is None else None
    ended = subprocess.run(command, input=held, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
    if ended.returncode < 0:
        endless = -ended.returncode == getattr(signal, "SIGPROF", 0)
        what = "does not end" if endless else "ends the process that does it"
        raise source.error(f"a damaged {KIND}: reading it {what}")
    _TRIED[key] = None
    while len(_TRIED) > REMEMBERED:
        del _TRIED[next(iter(_TRIED))]


def _what_it_is(source: Source) -> tuple:
    if source.place is None:
        return (sha256(source.data).digest(),)
    found = os.stat(source.place)
    return found.st_dev, found.st_ino, found.st_mtime_ns, found.st_size


def _members(source: Source, h5py, inside) -> dict:
    """Datasets and groups by name, in the order in which they were made where the file says it."""
    group = inside.node
    names = list(group)
    for name in names:
        if isinstance(name, bytes):
            raise source.error(f"the name {str(name)[1:42]} in it is not UTF-8; wanted names that are")
    if not group.id.get_create_plist().get_link_creation_order():
        names = _named_arrays.sorted_names(names)
    found: dict[str, _Node] = {}
    for name in names:
        if not isinstance(group.get(name, getlink=True), h5py.HardLink):
            raise source.error(f"'{name[:40]}' is a link to another place or file; wanted the data themselves")
        node = group[name]
        if isinstance(node, h5py.Dataset) and (node.is_virtual or node.external):
            raise source.error(f"'{name[:40]}' keeps its numbers in other files; wanted them in this one")
        if isinstance(node, h5py.Dataset):
            found[name] = _Array(node, h5py)
        elif isinstance(node, h5py.Group):
            found[name] = _Node(node, h5py)
    return found


def _stored(array) -> int:
    """Bytes of the file that a dataset takes."""
    return array.node.id.get_storage_size()


class _Node:
    """A group, or what a group and a dataset have in common: attributes that are numbers or words."""

    def __init__(self, node, h5py):
        self.node, self.attrs = node, {}
        for name in node.attrs:
            if isinstance(name, str) and _hdf5_trial.holds_numbers_or_words(node.attrs.get_id(name).get_type(), h5py):
                self.attrs[name] = node.attrs[name]


class _Array(_Node):
    """A dataset, whose cells are numbers or text."""

    def __init__(self, dataset, h5py):
        super().__init__(dataset, h5py)
        self.shape, self.chunks = dataset.shape, dataset.chunks
        self.plain = _hdf5_trial.holds_numbers_or_words(dataset.id.get_type(), h5py)
        self.has_filter = h5py.h5z.filter_avail
        self.words = bool(h5py.check_string_dtype(dataset.dtype))

    def __getitem__(self, rows: slice):
        if not self.plain:
            raise TypeError(f"'{self.node.name[:40]}' holds {str(self.node.dtype)[:40]}, wanted numbers or words")
        packing = self.node.id.get_create_plist()
        for code, _, _, name in map(packing.get_filter, range(packing.get_nfilters())):
            if not self.has_filter(code):
                raise LookupError(f"filter {code} ({name.decode('latin-1')[:40]}) is not registered")
        return self.node.asstr("utf-8", "replace")[rows] if self.words else self.node[rows]


class _Content(io.RawIOBase):
    """The content of a file that lies there or is held, as a stream that goes back and forth without a copy.

    Not mapped to memory: of a large file all that was read would be counted as the program's.
    """

    def __init__(self, source: Source):
        self.handle = None if source.place is None else os.open(source.place, os.O_RDONLY | getattr(os, "O_BINARY", 0))
        self.held, self.at = memoryview(source.data), 0
        self.size = len(self.held) if self.handle is None else os.fstat(self.handle).st_size

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        self.at = offset + (0, self.at, self.size)[whence]
        return self.at

    def tell(self) -> int:
        return self.at

    def readinto(self, into) -> int:
        if self.handle is None:
            piece: bytes | memoryview = self.held[self.at : self.at + len(into)]
        else:
            os.lseek(self.handle, self.at, os.SEEK_SET)
            piece = os.read(self.handle, len(into))
            if not piece and self.at < self.size:  # else the library takes what lies in memory for numbers
                raise OSError("the file was cut short while it was read")
        into[: len(piece)] = piece
        self.at += len(piece)
        return len(piece)

    def close(self) -> None:
        if self.handle is not None:
            os.close(self.handle)
            self.handle = None
        super().close()


FORMAT = _named_arrays.format_of("hdf5", (".h5", ".hdf5", ".nc"), recognises, _tables)
