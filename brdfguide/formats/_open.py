"""Opening a file that may be compressed, without ever holding more than its format can honestly need."""

import sys
from contextlib import contextmanager
from pathlib import Path

from ..errors import InputError, no_such_file

MAGIC = {b"\x1f\x8b": "gzip", b"\xfd7zXZ\0": "xz", b"BZh": "bzip2"}
PIECE, PACKED_PIECE = 2**20, 2**16
HONEST_SWELLING = 200  # numbers as text shrink to a third or a tenth


@contextmanager
def stream(path, name: str):
    """A binary stream of the file's content, decompressed. Raises InputError where it cannot be read."""
    try:
        if str(path) == "-":
            yield _Unpacked(sys.stdin.buffer, name)
            return
        path = Path(path)
        if path.is_dir():
            raise InputError(f"{name} is a directory; wanted a file with measured values")
        with path.open("rb") as raw:
            yield _Unpacked(raw, name)
    except FileNotFoundError:
        raise no_such_file(path, name) from None
    except OSError as error:
        raise InputError(f"{name}: cannot be read: {error.strerror or error}") from None


def plain_head(head: bytes) -> bytes:
    """The first bytes as UTF-8 without a byte order mark, for readers that look for words."""
    if head[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return head[: len(head) // 2 * 2].decode("utf-16", "replace").encode("utf-8", "replace")
    return head.removeprefix(b"\xef\xbb\xbf")


def whole(stream, head: bytes, limit: int, name: str, swells: bool = False) -> bytearray:
    """`head` and the rest of the stream. Raises InputError when it goes on beyond `limit` bytes.

    Where no table of a known size is unpacked, it may not swell more than 200 times: `swells` says that it may.
    """
    content = bytearray(head)
    while piece := stream.read(PIECE):
        content += piece
        if len(content) > limit:
            raise InputError(f"{name}: goes on beyond {limit / 1e6:.0f} MB, more than such a file can honestly hold")
        if stream.kind and not swells and len(content) > PIECE + HONEST_SWELLING * stream.consumed:
            raise InputError(f"{name}: unpacks to more than {HONEST_SWELLING} times its size, which no measurement does")
    return content


class _Unpacked:
    """read(size) over a raw stream, decompressing gzip, xz and bzip2 piece by piece."""

    def __init__(self, raw, name: str):
        self.raw, self.name = raw, name
        self.pending = raw.read(6)
        self.kind = next((kind for magic, kind in MAGIC.items() if self.pending.startswith(magic)), None)
        self.machine = _machine(self.kind)
        self.done = False
        self.consumed = len(self.pending)

    def read(self, size: int) -> bytes:
        got = bytearray()
        while len(got) < size:
            piece = self._piece(size - len(got))
            if not piece:
                break
            got += piece
        return bytes(got)

    def _piece(self, size: int) -> bytes:
        if self.kind is None:
            piece, self.pending = self.pending[:size], self.pending[size:]
            return piece or self.raw.read(size)
        while not self.done:
            try:
                fresh = self._fresh()
                piece = self._decompress(fresh, size)
            except Exception as error:  # zlib.error, LZMAError, OSError: each library has its own
                raise InputError(f"{self.name}: its {self.kind} compression is damaged: {error}") from None
            if self.machine.eof:
                self.done = True
            if piece:
                return piece
            if not fresh and not self.machine.eof and not self._holding():
                raise InputError(f"{self.name}: truncated: its {self.kind} compression ends early")
        return b""

    def _holding(self) -> bool:
        return bool(getattr(self.machine, "unconsumed_tail", b""))

    def _fresh(self) -> bytes:
        if self.kind == "gzip":
            if tail := self.machine.unconsumed_tail:
                return tail
        elif not self.machine.needs_input:
            return b""
        fresh, self.pending = self.pending, b""
        if not fresh:
            fresh = self.raw.read(PACKED_PIECE)
            self.consumed += len(fresh)
        return fresh

    def _decompress(self, fresh: bytes, size: int) -> bytes:
        return self.machine.decompress(fresh, size)


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
