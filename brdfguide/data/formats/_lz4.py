"""The block format of LZ4: literals and copies of what was written before.

Source: "LZ4 block format description" (Collet, BSD licence).
"""

LONGEST = 15  # a length of four bits that goes on in the next bytes
LEAST_COPY = 4


def unpacked(block: bytes, size: int) -> bytes:
    """The `size` bytes that a block holds. Raises ValueError where it holds others."""
    out, at = bytearray(), 0
    while at < len(block):
        token = block[at]
        count, at = _length(block, at + 1, token >> 4)
        if count > len(block) - at or len(out) + count > size:
            raise ValueError("its literals go beyond the block")
        out += block[at : at + count]
        at += count
        if at >= len(block):
            break
        if at + 2 > len(block):
            raise ValueError("it ends within a copy")
        back = block[at] | block[at + 1] << 8
        count, at = _length(block, at + 2, token & LONGEST)
        count += LEAST_COPY
        if not 0 < back <= len(out) or len(out) + count > size:
            raise ValueError("a copy goes beyond what there is")
        start = len(out) - back
        piece = bytes(out[start : start + min(back, count)])
        out += (piece * (count // len(piece) + 1))[:count]
    if len(out) != size:
        raise ValueError(f"it holds {len(out)} bytes of {size}")
    return bytes(out)


def _length(block: bytes, at: int, low: int) -> tuple[int, int]:
    """A length whose four bits may go on, and where the block goes on."""
    if low < LONGEST:
        return low, at
    while True:
        if at >= len(block):
            raise ValueError("it ends within a length")
        low += block[at]
        at += 1
        if block[at - 1] < 255:
            return low, at
