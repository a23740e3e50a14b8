"""What sixteen directions of a table can do at best, and what they do by chance: how good a plan may hope to be.

    python benchmarks/plan_bounds.py [--draws 300] [--only WORD]

Near the fit of a law to a whole table its residuals are r + J u; a fit to the rows S has u = -(JᵀJ)⁻¹ Jᵀr over S, and
so an error over the table that is known without a fit. Of random draws of 8 and of 16 rows the quantiles of that error
over the whole table's are told, the median over the laws, and the share within the bars. Then sixteen rows are
exchanged one by one, the values of all being known, until nothing helps: the best there is, told after real fits.
"""

import argparse
import os
import sys
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from benchmarks.given_tables import rms, tables
from benchmarks.plans import LAWS
from brdfguide.data.measurement import Measurement
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.fit import Fit, ln_residuals
from brdfguide.fitting.layout import Layout
from brdfguide.fitting.ln_slopes import ln_with_slopes

ROWS = 1500  # to choose from
RIDGE = 0.02  # of the mean information of a value, so that what no row tells stays where it is
WEAK = 1e-6  # of the largest strength, of a combination of parameters
SWEEPS = 5
MEAN = 0.2  # how much the mean over the laws counts beside their median in the exchange
BARS = {8: 1.15, 16: 1.05}


@dataclass(frozen=True, eq=False)
class Linear:
    """One law about its fit to a whole table, in coordinates in which the table's own information is 1."""

    squares: np.ndarray  # (rows, parameters, parameters) of JᵀJ
    toward: np.ndarray  # (rows, parameters) of Jᵀr
    values: np.ndarray  # (rows,) that are told
    channels: int
    variance: float  # of r over the table

    @classmethod
    def of(cls, found: Fit, judged: Measurement, some: Measurement) -> "Linear":
        jacobian, left, known = _parts(found, judged)
        count = known.sum()
        strength, vectors = np.linalg.eigh(np.einsum("ncp,ncq->pq", jacobian, jacobian) / count)
        upright = vectors / np.sqrt(np.maximum(strength, WEAK * strength[-1]))
        step = -upright @ (upright.T @ np.einsum("ncp,nc->p", jacobian, left) / count)
        variance = float(np.sum(np.where(known, left + jacobian @ step, 0.0) ** 2) / count)
        jacobian, left, known = _parts(found, some)
        left = np.where(known, left + jacobian @ step, 0.0)
        jacobian = jacobian @ upright
        squares = np.einsum("ncp,ncq->npq", jacobian, jacobian)
        toward = np.einsum("ncp,nc->np", jacobian, left)
        return cls(squares, toward, known.sum(axis=1), known.shape[1], variance)

    def ratio(self, squares, toward, values) -> np.ndarray:
        """(sets,): error over the whole table's, from sums over the rows of each set."""
        ridge = (RIDGE / self.channels) * values[:, None, None] * np.eye(toward.shape[1])
        step = np.linalg.solve(squares + ridge, toward[:, :, None])[:, :, 0]
        return np.sqrt(1 + np.sum(step**2, axis=1) / self.variance)

    def of_sets(self, sets) -> np.ndarray:
        """The same of sets of rows (sets, rows)."""
        return self.ratio(self.squares[sets].sum(axis=1), self.toward[sets].sum(axis=1), self.values[sets].sum(axis=1))

    def weighed(self, rows, weights) -> float:
        """The same of some rows that count unlike."""
        sums = (np.tensordot(weights, each[rows], 1)[None] for each in (self.squares, self.toward, self.values))
        return float(self.ratio(*sums)[0])

    def with_each(self, rest) -> np.ndarray:
        """The same of some rows with one more, for each."""
        sums = (each[rest].sum(axis=0) + each for each in (self.squares, self.toward, self.values))
        return self.ratio(*sums)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--draws", type=int, default=300, help="of 8 and of 16 rows")
    parser.add_argument("--only", default="", help="tables with this in their names")
    asked = parser.parse_args()
    print("| table | best 16 | 16 by chance: 10, 50, 90 % | within 1.05 | 8 by chance | within 1.15 |")
    print("|---|---|---|---|---|---|")
    for name, table, judged in tables():
        if asked.only in name:
            _of_table(name, table, judged, asked.draws)


def _of_table(name: str, table: Measurement, judged: Measurement, draws: int) -> None:
    random = np.random.default_rng(26)
    some = table[np.sort(random.choice(len(table.brdf), min(ROWS, len(table.brdf)), replace=False))]
    whole = fitting.fit_all(LAWS, judged)
    laws = [Linear.of(each, judged, some) for each in whole]
    cells, begin = [], np.zeros(0, int)
    for count in (16, 8):
        sets = random.integers(0, len(some.brdf), (draws, count))
        ratios = np.median([each.of_sets(sets) for each in laws], axis=0)
        begin = sets[np.argmin(ratios)] if count == 16 else begin
        told = ", ".join(f"{each:.2f}" for each in np.quantile(ratios, (0.1, 0.5, 0.9)))
        cells += [told, f"{np.mean(ratios <= BARS[count]):.0%}"]
    rows = np.unique(exchanged(laws, list(begin)))
    found = fitting.fit_all(LAWS, some[rows])
    best = np.median(
        [rms(ln_residuals(a.surface, judged)) / rms(b.residuals) for a, b in zip(found, whole, strict=True)]
    )
    print(f"| {name} | {best:.3f} | {' | '.join(cells)} |", flush=True)


def exchanged(laws: list[Linear], rows: list[int]) -> list[int]:
    """Rows exchanged one by one for better ones while that helps."""
    least = np.inf
    for _ in range(SWEEPS):
        before = least
        for place in range(len(rows)):
            rest = [*rows[:place], *rows[place + 1 :]]
            ratios = np.array([each.with_each(rest) for each in laws])
            error = np.median(ratios, axis=0) + MEAN * np.mean(ratios, axis=0)
            error[rest] = np.inf
            if error.min() < least * (1 - WEAK):
                rows[place], least = int(np.argmin(error)), float(error.min())
        if least == before:
            break
    return rows


def _parts(found: Fit, data: Measurement) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """∂ ln f/∂u (rows, channels, parameters), ln(model/data) and which of them is told; 0 where none is."""
    channels = len(data.channels)
    layout = Layout(found.model, channels)
    slopes = ln_with_slopes(layout, found.surface, data.instrument)[1]
    shared, own = len(layout.shared), len(layout.per_channel)
    left = ln_residuals(found.surface, data)
    known = np.isfinite(left)
    jacobian = np.zeros((*left.shape, shared + own * channels))
    jacobian[:, :, :shared] = slopes[:, :, :shared]
    for channel in range(channels):
        start = shared + channel * own
        jacobian[:, channel, start : start + own] = slopes[:, channel, shared:]
    jacobian[~known] = 0.0
    return jacobian, np.where(known, left, 0.0), known


if __name__ == "__main__":
    main()
