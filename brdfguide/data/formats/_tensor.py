"""The `tensor_file` container: named arrays of numbers at stated offsets, little-endian.

12 bytes "tensor_file\\0", u8 major, u8 minor, u32 count; for each field u16 length of its name, the name, u16 number of
dimensions, u8 type, u64 offset from the start of the file, u64 lengths of the dimensions.
"""

import struct

import numpy as np

from .format import Source

MAGIC = b"tensor_file\0"
TYPES = {1: "u1", 2: "i1", 3: "<u2", 4: "<i2", 5: "<u4", 6: "<i4", 7: "<u8", 8: "<i8", 9: "<f2", 10: "<f4", 11: "<f8"}
MOST_FIELDS = 256  # in one file; the database's have about a dozen
MOST_DIMENSIONS = 16  # of one field; the database's have up to five


def tensor_fields(source: Source) -> dict[str, np.ndarray]:
    """Views of the arrays in the file. Raises InputError for anything that reaches beyond its end, or into another."""
    data, size = source.data, len(source.data)

    def take(form: str, at: int):
        if at + struct.calcsize(form) > size:
            raise source.error(f"truncated: its list of fields ends at byte {size}")
        return struct.unpack_from(form, data, at), at + struct.calcsize(form)

    (major, minor, count), at = take("<BBI", len(MAGIC))
    if major != 1:
        raise source.error(f"tensor_file version {major}.{minor}; this reader knows 1.x")
    if count > MOST_FIELDS:
        raise source.error(f"it promises {count} fields; a reflectance table has about a dozen")
    found: dict[str, np.ndarray] = {}
    places = []
    for _ in range(count):
        (length,), at = take("<H", at)
        (raw,), at = take(f"{length}s", at)
        name = raw.decode("latin-1")
        (dimensions, kind), at = take("<HB", at)
        if dimensions > MOST_DIMENSIONS or kind not in TYPES:
            raise source.error(f"field '{name[:40]}': type {kind} with {dimensions} dimensions is not known")
        (offset, *shape), at = take(f"<Q{dimensions}Q", at)
        values = 1
        for each in shape:
            values *= each
        end = offset + values * np.dtype(TYPES[kind]).itemsize
        if end > size or max(shape, default=0) > size:
            raise source.error(
                f"field '{name[:40]}' of shape {shape} would end at byte {end}; the file has {size}: truncated "
                f"or damaged"
            )
        if name in found:
            raise source.error(f"field '{name[:40]}' stands there twice: damaged")
        found[name] = np.frombuffer(data, TYPES[kind], count=values, offset=offset).reshape(shape)
        places += [(offset, end, name)] if values else []
    _check_apart(source, [(0, at, "the list of fields"), *sorted(places)])
    return found


def _check_apart(source: Source, places: list[tuple[int, int, str]]) -> None:
    """Raises InputError where two of (begin, end, name) share a byte: a damaged offset, type or length."""
    for (_, end, name), (begin, _, other) in zip(places, places[1:], strict=False):
        if begin < end:
            raise source.error(f"field '{other[:40]}' begins at byte {begin}, where '{name[:40]}' is: damaged")
