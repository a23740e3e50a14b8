"""Errors of fits over a table too large to be held: sums of blocks, which add up in any order and on any machine."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..data.blocks import Blocks
from ..data.examine import as_corrected
from ..data.measurement import Measurement
from ..models.surface import Surface
from ..records import dataclass
from .ranked import Ranking, Row
from .residuals import BLOCK, ln_residuals

TENTHS = 901  # of a degree of incidence: 0 to 90
MOST_ANGLES = 20  # told each by itself, as `ranking.incidence_bins` does; more in bands of 10 degrees


@dataclass(frozen=True, eq=False)
class Sums:
    """Of ln(model/data) of some surfaces, by incidence: how many values count, and the sum of squares."""

    counts: np.ndarray  # (TENTHS,)
    squares: np.ndarray  # (surfaces, TENTHS)

    @classmethod
    def of_none(cls, surfaces: int) -> "Sums":
        return cls(np.zeros(TENTHS), np.zeros((surfaces, TENTHS)))

    def __add__(self, other: "Sums") -> "Sums":
        return Sums(self.counts + other.counts, self.squares + other.squares)

    def rms(self) -> list[float]:
        """Of each surface, over all values."""
        return np.sqrt(self.squares.sum(axis=1) / self.counts.sum()).tolist()

    def by_theta_i(self, place: int) -> dict[float, float]:
        """Of one surface, incidence [deg] -> rms; in bands of 10 degrees where there are more than twenty."""
        angles = np.arange(TENTHS) / 10
        if np.count_nonzero(self.counts) > MOST_ANGLES:
            angles = np.round(angles / 10) * 10
        angles, bins = np.unique(angles, return_inverse=True)
        counts, squares = np.bincount(bins, self.counts), np.bincount(bins, self.squares[place])
        there = np.flatnonzero(counts)
        return {float(angles[each]): float(np.sqrt(squares[each] / counts[each])) for each in there}


def block_sums(surfaces: Sequence[Surface], block: Measurement) -> Sums:
    """Of one block, in pieces that fit the processor's cache."""
    counts, sums = np.zeros(TENTHS), np.zeros((len(surfaces), TENTHS))
    for start in range(0, len(block.brdf), BLOCK):
        part = block[start : start + BLOCK]
        angles = np.rint(part.geom.theta_i_deg[:, 0] * 10).astype(int)
        counts += np.bincount(angles, np.count_nonzero(part.clear, axis=1), TENTHS)
        for place, surface in enumerate(surfaces):
            left = ln_residuals(surface, part)
            squares = (
                np.nan_to_num(np.einsum("sc,sc->s", left, left)) if part.clear.all() else np.nansum(left**2, axis=1)
            )
            sums[place] += np.bincount(angles, squares, TENTHS)
    return Sums(counts, sums)


def sums_over(surfaces: Sequence[Surface], blocks: Iterable[Measurement]) -> Sums:
    """Of all blocks, one at a time."""
    total = Sums.of_none(len(surfaces))
    for block in blocks:
        total += block_sums(surfaces, block)
    return total


def with_errors_over(
    ranked: Ranking, blocks: Blocks, sample: Measurement, progress: Callable[[str], None] = lambda what: None
) -> Ranking:
    """The ranking of a sample with errors in ln over all blocks; models far behind keep those over the sample.

    Takes  sample, as it was fitted: what was put right of it is put right of every block.    Raises InputError where
    that cannot be.
    """
    told = [row for row in ranked.rows if not row.fit.has("coarse")]
    progress(f"errors over all of {blocks.name}")
    surfaces = [row.fit.surface for row in told]
    sums = sums_over(surfaces, (as_corrected(block, sample) for block in blocks))
    errors = sums.rms()
    changed = {id(row.fit): _with_error(row, errors[place], sums.by_theta_i(place)) for place, row in enumerate(told)}
    rows = tuple(changed.get(id(row.fit), row) for row in ranked.rows)
    return replace(ranked, rows=rows, recommended=changed.get(id(ranked.recommended.fit), ranked.recommended))


def _with_error(row: Row, error: float, by_theta_i: dict[float, float]) -> Row:
    return replace(
        row,
        fit=replace(row.fit, rms_ln=error),
        rms_ln=error,
        rms_ln_by_theta_i=by_theta_i,
        errors={**row.errors, "ln": error},
    )
