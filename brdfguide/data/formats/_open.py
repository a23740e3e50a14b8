"""Opening a file that may be compressed, without ever holding more than its format can honestly need."""

import sys
from contextlib import contextmanager
from pathlib import Path

from ... import opening
from ...errors import InputError
from ...finding import Finding
from . import _zip
from .format import Format, Source, wide_encoding

MAGIC = {b"\x1f\x8b": "gzip", b"\xfd7zXZ\0": "xz", b"BZh": "bzip2"}
PIECE = 2**20  # bytes of content read at once
PACKED_PIECE = 2**14  # bytes of a compressed file read at once
SLICE = 2**12  # bytes of these unpacked at once
HONEST_SWELLING = 200  # numbers as text shrink to a third or a tenth


@contextmanager
def stream(path, name: str):
    """A binary stream of the file's content, decompressed. Raises InputError where it cannot be read."""
    if str(path) == "-" and not isinstance(path, opening.Held):
        yield _Unpacked(sys.stdin.buffer, name)
        return
    with opening.open_for_reading(path, name) as raw, _zip.one_file(raw, name) as (content, packed):
        yield _Unpacked(content, name, packed)


def plain_head(head: bytes) -> bytes:
    """The first bytes as UTF-8 without a byte order mark, for readers that look for words."""
    if wide := wide_encoding(head):
        return head[: len(head) // 2 * 2].decode(wide, "replace").encode("utf-8", "replace")
    return head.removeprefix(b"\xef\xbb\xbf")


def whole_content(stream, head: bytes, limit: int, name: str, swells: bool = False) -> bytearray:
    """`head` and the rest of the stream. Raises InputError when it goes on beyond `limit` bytes.

    Where no table of a known size is unpacked, it may not swell more than 200 times: `swells` says that it may.
    """
    content = bytearray(head)
    while piece := stream.read(PIECE):
        content += piece
        if len(content) > limit:
            raise _beyond(name, limit)
        if stream.consumed and not swells and len(content) > PIECE + HONEST_SWELLING * stream.consumed:
            raise InputError(
                f"{name}: unpacks to more than {HONEST_SWELLING} times its size, which no measurement does"
            )
    return content


def _beyond(name: str, limit: int) -> InputError:
    return InputError(f"{name}: goes on beyond {limit / 1e6:.0f} MB, more than such a file can honestly hold")


def source_of(path, stream, head: bytes, format: Format, name: str) -> Source:
    """The content of a file, or left where it lies if the format wants that and it is not packed.

    Never mapped to memory: who cuts a mapped file short ends the process. Raises InputError as `whole_content`.
    """
    lies_there = not isinstance(path, opening.Held) and str(path) != "-" and opening.is_plain(path)
    if lies_there and not stream.consumed and format.in_place:
        return Source(name, b"", place=Path(path))
    data = whole_content(stream, head, format.limit, name, swells=format.whole_table)
    return Source(name, data, left_behind(stream))


def left_behind(stream) -> tuple[Finding, ...]:
    """The note on bytes that follow a compressed file's last member."""
    if not stream.behind:
        return ()
    text = f"{stream.behind} bytes behind the {stream.kind} content belong to none and were left out"
    return (Finding("bytes-behind", text, "warning", numbers=(("bytes", stream.behind),)),)


class _Unpacked:
    """read(size) over a raw stream, decompressing gzip, xz and bzip2 piece by piece, one member after the other.

    `packed` are the bytes that the stream takes in a ZIP; `behind` says how many follow the last member that are none.
    """

    def __init__(self, raw, name: str, packed: int = 0):
        self.raw, self.name = raw, name
        self.packed = raw.read(6)  # read, and not yet unpacked
        self.kind = next((kind for magic, kind in MAGIC.items() if self.packed.startswith(magic)), None)
        self.magic = next((magic for magic in MAGIC if self.packed.startswith(magic)), b"")
        self.machine = _machine(self.kind)
        self.done = False
        self.consumed = packed or len(self.packed) * bool(self.kind)  # bytes of what is packed; 0 where nothing is
        self.behind = 0

    def read(self, size: int) -> bytes:
        piece = self._piece(size)
        if not piece or len(piece) == size:
            return piece
        got = bytearray(piece)
        while len(got) < size and (piece := self._piece(size - len(got))):
            got += piece
        return bytes(got)

    def _piece(self, size: int) -> bytes:
        if self.kind is None:
            piece, self.packed = self.packed[:size], self.packed[size:]
            return piece or self.raw.read(size)
        while not self.done:
            fresh = self._fresh()
            try:
                piece = self.machine.decompress(fresh, size)
            except Exception as error:  # zlib.error, LZMAError, OSError: each library has its own
                raise InputError(f"{self.name}: its {self.kind} compression is damaged: {error}") from None
            if self.machine.eof:
                self._next_member()
            if piece:
                return piece
            if not fresh and not self.done and not self._holding():
                raise InputError(f"{self.name}: truncated: its {self.kind} compression ends early")
        return b""

    def _next_member(self) -> None:
        """Another member of the same kind, or the end; zeros may pad either."""
        self.packed = self.machine.unused_data + self.packed
        while True:
            self.packed = self.packed.lstrip(b"\0")
            if len(self.packed) >= len(self.magic) or not self._filled():
                break
        if self.packed.startswith(self.magic):
            self.machine = _machine(self.kind)
            return
        self.done, self.behind = True, len(self.packed)
        while piece := self.raw.read(PACKED_PIECE):
            self.behind += len(piece)

    def _filled(self) -> bool:
        piece = self.raw.read(PACKED_PIECE)
        self.consumed += len(piece)
        self.packed += piece
        return bool(piece)

    def _holding(self) -> bool:
        return bool(getattr(self.machine, "unconsumed_tail", b""))

    def _fresh(self) -> bytes:
        """What the machine is given next: what it left, or a slice, so that a member's rest is never long."""
        if self.kind == "gzip":
            if tail := self.machine.unconsumed_tail:
                return tail
        elif not self.machine.needs_input:
            return b""
        if not self.packed:
            self._filled()
        fresh, self.packed = self.packed[:SLICE], self.packed[SLICE:]
        return fresh


def _machine(kind: str | None):
    if kind == "gzip":
        import zlib

        return zlib.decompressobj(wbits=31)
    if kind == "xz":
        import lzma

        return lzma.LZMADecompressor(memlimit=128 * 2**20)
    if kind == "bzip2":
        import bz2

        return bz2.BZ2Decompressor()
    return None
