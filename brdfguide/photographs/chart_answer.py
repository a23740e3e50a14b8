"""What a surface beside a ColorChecker reflects, from one photograph or from two with the lamp moved between them."""

import numpy as np

from ..errors import InputError
from ..finding import Finding
from ..physics.colour import LUMINANCE
from ..records import dataclass
from .chart_found import Shown, by_corners, find_chart, read_chart, sample_reflectance
from .readers import read_picture

GLOSS = 0.03  # by which two pictures differ, from which that is gloss
BLOCK = 4  # pixels on a side that are averaged before the lesser of two is taken, so that noise is not


@dataclass(frozen=True, eq=False)
class ChartAnswer:
    """Reflectance (3,) in linear sRGB with its relative doubt (3,), by the data set asked for and by the other."""

    value: np.ndarray
    doubt: np.ndarray
    others: dict[str, np.ndarray]
    each: np.ndarray  # (pictures, 3)
    differ: float | None  # of two pictures, relative
    shown: tuple[Shown, ...]
    data_set: str

    @property
    def luminance(self) -> float:
        return float(LUMINANCE @ self.value)

    @property
    def is_albedo(self) -> bool:
        """Whether gloss was looked for, so that what is left may be called an albedo."""
        return self.differ is not None

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What the number holds beside the body's reflectance."""
        if self.differ is None:
            text = "includes whatever gloss fell into this picture: up to a third too bright on a glossy surface"
            return (Finding("includes-gloss", text, consequence="a second picture with the lamp moved tells"),)
        if self.differ > GLOSS:
            text = f"the two pictures differ by {self.differ:.0%}: gloss; the lesser was taken at each place"
            return (Finding("gloss", text, "warning", "what gloss both pictures share is still in it"),)
        return ()


def chart_answer(files, corners, area, data_sets) -> ChartAnswer:
    """The answer of one or two pictures.

    Takes  their files, the chart's corners (4, 2) [px] or None to find it, the sample's area (x, y, width, height)
    [px], the data sets with the one that counts first.    Raises InputError for pictures of different size and for what
    cannot be read or found.
    """
    shown = []
    for file in files:
        picture = read_picture(file)
        placed = find_chart(picture) if corners is None else by_corners(corners)
        shown.append(read_chart(picture, placed, data_sets))
    if len({each.picture.size for each in shown}) > 1:
        raise InputError("the two pictures differ in size: between them the lamp moves, and the camera stands still")
    values = {name: _lesser([sample_reflectance(each, name, area)[0] for each in shown]) for name in data_sets}
    asked = data_sets[0]
    seen = [sample_reflectance(each, asked, area) for each in shown]
    each = np.stack([pixels.mean(axis=(0, 1)) for pixels, _ in seen])
    return ChartAnswer(
        value=values[asked],
        doubt=np.max([doubt for _, doubt in seen], axis=0),
        others={name: values[name] for name in data_sets[1:]},
        each=each,
        differ=_difference([pixels for pixels, _ in seen], values[asked]) if len(seen) > 1 else None,
        shown=tuple(shown),
        data_set=asked,
    )


def _blocks(pixels: np.ndarray) -> np.ndarray:
    """Means (n, 3) over blocks of pixels (rows, columns, 3); over all where there are too few."""
    rows, columns = (size // BLOCK for size in pixels.shape[:2])
    if not rows or not columns:
        return pixels.mean(axis=(0, 1))[None]
    whole = pixels[: rows * BLOCK, : columns * BLOCK]
    return whole.reshape(rows, BLOCK, columns, BLOCK, 3).mean(axis=(1, 3)).reshape(-1, 3)


def _lesser(pictures) -> np.ndarray:
    """Mean (3,) over the surface of the lesser of the pictures at each place: gloss only ever adds."""
    return np.min([_blocks(each) for each in pictures], axis=0).mean(axis=0)


def _difference(pictures, value) -> float:
    """How far two pictures differ, in the worst channel, relative to the lesser."""
    apart = np.abs(_blocks(pictures[0]) - _blocks(pictures[1])).mean(axis=0)
    return float(np.max(apart / np.maximum(value, 1e-3)))
