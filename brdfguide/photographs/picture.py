"""A photograph: the codes that its file holds, and the light that they stand for."""

from dataclasses import field
from functools import cached_property

import numpy as np

from ..finding import Finding
from ..records import dataclass

TRANSFERS = ("srgb", "adobe", "linear")
ADOBE_GAMMA = 563 / 256  # Adobe RGB (1998) Color Image Encoding, section 4.3.4.2
STRIP = 256  # rows that are decoded at once
FEWEST_STEPS = 8
HALF_STEP = 2.0**-24  # of the least half floats (IEEE 754)
PLATEAU = 8  # pixels that stand at the greatest code alike, before it is believed to be a limit (ours)


@dataclass(frozen=True)
class Exposure:
    """How a picture was taken; None where nobody says. Light per code goes as N²/(t ISO)."""

    seconds: float | None = None
    iso: float | None = None
    f_number: float | None = None

    def over(self, other: "Exposure") -> tuple[float, tuple[str, ...]]:
        """How many times as much this exposure makes of the same light as the other; and what only one of them says."""
        ratio, untold = 1.0, []
        for name, power in (("seconds", 1), ("iso", 1), ("f_number", -2)):
            mine, theirs = getattr(self, name), getattr(other, name)
            if mine is not None and theirs is not None:
                ratio *= (mine / theirs) ** power
            elif mine is not None or theirs is not None:
                untold.append(name)
        return ratio, tuple(untold)


@dataclass(frozen=True, eq=False)
class Photograph:
    """Codes (rows, columns, 3) of red, green and blue, as the file holds them; the first row is the uppermost.

    `transfer` says how integer codes stand for light, `white` from which code on a pixel is clipped.
    """

    name: str
    codes: np.ndarray
    transfer: str = "linear"
    white: float = np.inf
    exposure: Exposure = Exposure()
    findings: tuple[Finding, ...] = field(default=())

    @property
    def size(self) -> tuple[int, int]:
        """(columns, rows)."""
        return self.codes.shape[1], self.codes.shape[0]

    @cached_property
    def _table(self) -> np.ndarray | None:
        """Light of every code, 1 at the largest; None for codes that are light."""
        if self.codes.dtype.kind != "u":
            return None
        top = np.iinfo(self.codes.dtype).max
        return decoded(np.arange(top + 1) / top, self.transfer).astype(np.float32)

    @property
    def least(self) -> float:
        """Light below which fewer than eight steps of the codes count it, so that it is known to no better than 4 %."""
        if self._table is not None:
            return float(self._table[FEWEST_STEPS])
        return FEWEST_STEPS * HALF_STEP if self.codes.dtype == np.float16 else 0.0

    def light(self, *place) -> np.ndarray:
        """Linear light of the codes at a slice or at index arrays, float32, (..., 3)."""
        codes = self.codes[place]
        if self._table is not None:
            return self._table[codes]
        light = codes.astype(np.float32)
        return light if self.transfer == "linear" else decoded(light, self.transfer).astype(np.float32)

    def clipped(self, *place) -> np.ndarray:
        """Where any channel is at the file's white; (...)."""
        return np.any(self.codes[place] >= self.white, axis=-1)

    def reduced(self, window: "Window") -> tuple[np.ndarray, np.ndarray]:
        """Light (rows, columns, 3), float32, and clipped pixels of a window, blocks of pixels averaged."""
        k = window.block
        light = np.empty((window.rows, window.columns, 3), np.float32)
        clipped = np.empty((window.rows, window.columns), bool)
        columns = slice(window.left, window.left + k * window.columns)
        for start in range(0, window.rows, max(STRIP // k, 1)):
            stop = min(start + max(STRIP // k, 1), window.rows)
            part = (slice(window.top + k * start, window.top + k * stop), columns)
            shape = (stop - start, k, window.columns, k)
            light[start:stop] = self.light(*part).reshape(*shape, 3).mean(axis=(1, 3))
            clipped[start:stop] = self.clipped(*part).reshape(shape).any(axis=(1, 3))
        return light, clipped


@dataclass(frozen=True)
class Window:
    """A part of a picture, in blocks of `block` x `block` pixels."""

    left: int
    top: int
    columns: int  # of blocks
    rows: int
    block: int = 1

    @classmethod
    def around(cls, centre, half_width: float, half_height: float, size, most: int) -> "Window":
        """The part of a picture of `size` (columns, rows) about a centre [px], at most `most` blocks wide or high."""
        left, top = (max(int(np.floor(c - h)), 0) for c, h in zip(centre, (half_width, half_height), strict=True))
        right, bottom = (
            min(int(np.ceil(c + h)), limit) for c, h, limit in zip(centre, (half_width, half_height), size, strict=True)
        )
        block = max(1, -(-max(right - left, bottom - top) // most))
        return cls(left, top, max(right - left, 0) // block, max(bottom - top, 0) // block, block)

    def middles(self) -> tuple[np.ndarray, np.ndarray]:
        """Where the blocks' middles lie in the picture [px], x (columns,) and y (rows,)."""
        half = self.block / 2
        return (
            self.left + half + self.block * np.arange(self.columns),
            self.top + half + self.block * np.arange(self.rows),
        )


def decoded(code, transfer: str) -> np.ndarray:
    """Light 0..1 of codes 0..1.

    sRGB: IEC 61966-2-1; Adobe RGB (1998): a power of 563/256.
    """
    code = np.asarray(code, float)
    if transfer == "linear":
        return code
    if transfer == "adobe":
        return np.maximum(code, 0.0) ** ADOBE_GAMMA
    bright = ((np.maximum(code, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.where(code <= 0.04045, code / 12.92, bright)


def clip_level(light: np.ndarray, quantum: float) -> float:
    """The level at which the values (pixels,) of a channel were cut off; inf where they were not.

    Near a smooth maximum the number of pixels grows evenly below it: as many stand in the first step of the size
    `quantum` (relative) as in the next. Where light was clipped, the greatest value has more than the four steps below.
    """
    if not light.size:
        return np.inf
    top = float(light.max())
    at_top = int(np.count_nonzero(light >= top * (1 - 0.5 * quantum)))
    below = int(np.count_nonzero(light >= top * (1 - 4.5 * quantum))) - at_top
    return top if top > 0 and at_top >= PLATEAU and at_top > below else np.inf
