"""Speos' binary `.anisotropicbsdf`: the same content as the text, little-endian, its arrays in LZ4 blocks.

After the title's line: the mode as a digit, a number of the layout, lengths of comment and description, the anisotropy
vector, flags, then arrays as (size u64, size u32, packed size u32, block). Checked on one file of version 9 against the
same table as text; what that file does not show is refused, not guessed.

Source: a file of the public test assets of Ansys' own Python client, MIT licence.
"""

import struct

import numpy as np

from ._lz4 import unpacked
from ._speos import MOST_ANGLES, Table, ascending, refuse_transmission
from .format import Source

MOST_BYTES = 2**27  # of one array


class Bytes:
    """The content behind the title, piece by piece. Raises InputError where it ends."""

    def __init__(self, source: Source):
        self.source, self.data = source, bytes(source.data)
        self.at = self.data.index(b"\n") + 1

    def take(self, layout: str, wanted: str) -> tuple:
        size = struct.calcsize("<" + layout)
        if self.at + size > len(self.data):
            raise self.source.error(f"truncated: it ends where {wanted} was wanted")
        self.at += size
        return struct.unpack_from("<" + layout, self.data, self.at - size)

    def text(self, wanted: str) -> None:
        """Skips a text behind its length."""
        (size,) = self.take("I", f"the length of {wanted}")
        self.take(f"{size}s", wanted)

    def array(self, count: int, wanted: str) -> np.ndarray:
        """An array of `count` numbers."""
        whole, size, packed = self.take("QII", wanted)
        if not 0 < count <= MOST_BYTES // 8 or whole != size or size != 8 * count:
            raise self.source.error(f"{wanted}: found {whole} bytes, wanted {8 * count}")
        (block,) = self.take(f"{packed}s", wanted)
        try:
            return np.frombuffer(unpacked(block, size), "<f8")
        except ValueError as error:
            raise self.source.error(f"{wanted}: its LZ4 block is damaged: {error}") from None

    def count(self, wanted: str) -> int:
        (number,) = self.take("I", wanted)
        if not 0 < number <= MOST_ANGLES:
            raise self.source.error(f"found {number}, wanted {wanted}")
        return number


def read_binary(source: Source):
    """kind, rotations, incidences of each rotation, where the total was measured, nm, percent, tables.

    Raises InputError for transmission, for what is damaged, and for a layout that is not known.
    """
    data = Bytes(source)
    mode, layout, _ = data.take("1sII", "the mode and the layout")
    if mode != b"1" or layout != 3:
        raise _unknown(source)
    data.text("the comment")
    data.text("the description")
    data.take("B3d", "the anisotropy vector")
    reflection, transmission = data.take("BB", "the flags")
    refuse_transmission(source, bool(reflection), bool(transmission))
    data.take("2d", "the header")
    kind, other = data.take("BB", "the kind of value")
    if kind or other:
        raise _unknown(source)
    rotations = data.array(data.count("the number of rotations"), "the rotations")
    incidences = [data.array(data.count("the number of incidences"), "the incidences") for _ in rotations]
    measured = float(data.take("2d", "where the total was measured")[0])
    data.text("the description of the spectrum")
    waves = data.count("the number of wavelengths")
    nm = np.array(data.take(f"{waves}d", "the wavelengths"))
    percent = np.array(data.take(f"{waves}d", "the reflectances"))
    tables = [[_table(source, data, angle) for angle in angles] for angles in incidences]
    return 0, rotations, incidences, measured, nm, percent, tables


def _table(source: Source, data: Bytes, angle: float) -> Table:
    wanted = f"the table at {angle:g} degrees"
    shape = data.count(f"theta angles of {wanted}"), data.count(f"phi angles of {wanted}")
    theta, phi = (data.array(count, f"angles of {wanted}") for count in shape)
    return ascending(source, Table(theta, phi, data.array(shape[0] * shape[1], wanted).reshape(shape)))


def _unknown(source: Source):
    return source.error(
        "a binary layout of Speos that was never seen here; open it in Speos' editor and save it as text"
    )
