"""Standard errors of a row's parameters, once more: from its laws' derivatives, its residuals and its neighbours.

    variance of p = σ² w ρ c (JᵀJ)⁻¹,   σ² = Σ r²/(values - free numbers),   w ρ = (1 + ρ)/(1 - ρ)

ρ is the largest correlation between neighbours over four orders of the directions and c how many channels say the same,
for what all channels share. Where neighbours are alike beyond chance, at least what blocks of them pull a parameter by:
(JᵀJ)⁻¹ Σ (Jᵀr)(Jᵀr)ᵀ (JᵀJ)⁻¹ (White 1980; Liang and Zeger 1986). J is taken by differences of the laws in the precision
of the caller, by the parameters themselves: a linear change of coordinates changes no standard error.
"""

from collections import defaultdict
from collections.abc import Sequence
from functools import cached_property
from math import hypot
from statistics import median

from mpmath import asinh, cbrt, exp, fdot, fsum, matrix, mpf, sqrt

from ..records import dataclass
from . import textbook_shaders
from .exact_errors import LARGEST, SMALLEST, Readings
from .exact_neighbours import alike_neighbours, orders_of_neighbours, ways_to_cut, with_values
from .exact_scan_gains import GainsUndecided, scans_of_turns, variances_by_gains
from .exact_surface import ExactSurface
from .rederived import Comparisons

MOST_SAMPLES = 2000  # directions, of which slopes take their time
DISCREPANT = 3.5  # standard deviations of the correlation
MOST_CORRELATED = 0.95
EVEN = {"spread", "k", "sigma"}  # of which laws know the square
LEAST_ERROR, MOST_ERROR = 1e-12, 1e6  # relative, of a stated standard error
LEAST_DOUBT = 1e-12  # [1/sr]
SUREST = 1e-12  # of the mean variance
DOUBLE = 1e-14  # what a double loses in each step of an inverse, times its condition
STEEP = 1e-8  # relative, of slopes formed in doubles
BY_DIFFERENCES = 3e-5  # of shaders, whose slopes are differences, and of coats, whose mean reflectance is interpolated
SLOPE = 1e-11  # the same of a slope, over what a change of the number by its own size does to a residual
OWN = 10  # times as much of its own standard error as of the others'
LEAST_TOLD = 1e-4  # relative, of a standard error that can be compared at all


@dataclass(frozen=True, eq=False)
class FittedRow:
    """A row's surface and residuals ln(model/data), and how it was fitted."""

    parameters: dict  # as printed
    surface: ExactSurface
    residuals: list[list]
    refined: bool
    metric: str


def compare_stderrs(row: FittedRow, place: str, data: Readings, found: Comparisons) -> None:
    """Every standard error that follows; nothing where the fit looked at more than the answer tells."""
    dim = any(data.limits)
    if len(data.angles) > MOST_SAMPLES or data.robust or data.faults:
        return
    if dim and (data.by_scan or data.missed is None or row.metric not in ("ln", "seen")):
        return
    try:
        errors = _Equations(row, _Part(*with_values(data, row.residuals), row.metric)).stderrs()
    except GainsUndecided:
        return
    rough = any(each.coated or each.law in textbook_shaders.LAWS for each in row.surface.parts)
    close = BY_DIFFERENCES if rough else STEEP
    for key, channel, right, lost in errors:
        told = row.parameters[key]["stderr"]
        if lost > LEAST_TOLD or told is None:
            continue
        many = isinstance(told, list)
        name = f"{place}.parameters.{key}.stderr" + (f"[{channel}]" if many else "")
        found.check(name, told[channel] if many else told, right, close + lost)


@dataclass(frozen=True, eq=False)
class _Part:
    """The directions with a value: which they are of all, and what was measured there."""

    data: Readings
    residuals: list[list]
    metric: str


@dataclass(frozen=True, eq=False)
class _Equations:
    """Normal equations of all free numbers: those that channels share, then those of each channel in turn."""

    row: FittedRow
    part: _Part

    @cached_property
    def keys(self) -> tuple[list[str], list[str]]:
        """Of what all channels share, and of what each has for itself."""
        free = [key for key, each in self.row.parameters.items() if each.get("fitted")]
        own = [key for key in free if isinstance(self.row.parameters[key]["value"], list)]
        return [key for key in free if key not in own], own

    @cached_property
    def channels(self) -> range:
        return range(len(self.part.data.wavelengths))

    @cached_property
    def weights(self) -> list[list]:
        """Of each value, mean 1 over those that are told; 0 where none is."""
        data = self.part.data
        raw = [
            [mpf(share) if known else mpf(0) for known in row]
            for share, row in zip(data.share, data.looked_at, strict=True)
        ]
        if data.by_error:
            by_error = _by_stated_errors(data)
            raw = [[a * b for a, b in zip(*pair, strict=True)] for pair in zip(raw, by_error, strict=True)]
        mean = fsum(v for row in raw for v in row) / len(self.values)
        return [[v / mean for v in row] for row in raw]

    @cached_property
    def values(self) -> list[tuple[int, int]]:
        """Sample and channel of each value that the fit looked at."""
        return [(s, c) for s, row in enumerate(self.part.data.looked_at) for c, known in enumerate(row) if known]

    @cached_property
    def weighed(self) -> tuple[dict, dict]:
        """By sample and channel: the residual that was made small, and what makes slopes of f slopes of it."""
        residual, factor = {}, {}
        for s, c in self.values:
            r, slope = self._scaled(s, c)
            root = sqrt(self.weights[s][c])
            residual[s, c], factor[s, c] = root * r, root * slope
        return residual, factor

    def _scaled(self, s: int, c: int):
        data = self.part.data
        if any(data.limits):
            f, twice = data.sights[s].reading(self.row.surface, c, data.wavelengths[c]), 2 * self._floors[c]
            return asinh(f / twice) - asinh(mpf(data.values[s][c]) / twice), 1 / sqrt(f**2 + twice**2)
        value = data.exact[s][c]
        assert value is not None
        left = self.part.residuals[s][c]
        f = value * exp(left)
        if self.part.metric == "cube-root":
            return cbrt(f) - cbrt(value), cbrt(f) / (3 * f)
        if self.part.metric == "relative":
            return f / value - 1, 1 / value
        if self.part.metric == "cosine":
            cosines = data.sights[s].pair.cos_i * data.sights[s].pair.cos_r
            return cosines * (f - value), cosines
        return left, 1 / max(f, SMALLEST)

    def _read(self, s: int, c: int):
        """What the law gives there."""
        data, left = self.part.data, self.part.residuals[s][c]
        if left is None or any(data.limits):
            return data.sights[s].reading(self.row.surface, c, data.wavelengths[c])
        return data.exact[s][c] * exp(left)

    @cached_property
    def _floors(self) -> list:
        """c of the generalised logarithm asinh(f/2c), by channel."""
        missed = mpf(self.part.data.missed or 1)
        return [max(mpf(doubt) / missed, mpf(LEAST_DOUBT)) for doubt in self.part.data.doubt]

    @cached_property
    def _unlike(self) -> dict | None:
        """Variance of each residual over their mean, where they differ: directions that count more say how much a value
        counts and not how sure it is, and near the dark level a residual is surer than that of ln."""
        data = self.part.data
        if data.by_scan:
            return {(s, c): mpf(data.share[s]) for s, c in self.values}
        if not any(data.limits):
            return None
        squares = [v * v for row in self.part.residuals for v in row if v is not None]
        variance, found = fsum(squares) / len(squares), {}
        for s, c in self.values:
            value, floor = mpf(data.values[s][c]), self._floors[c]
            found[s, c] = (variance * value**2 + mpf(data.doubt[c]) ** 2) / (value**2 + 4 * floor**2)
        mean = fsum(found.values()) / len(found)
        return {at: max(each / mean, mpf(SUREST)) for at, each in found.items()}

    @cached_property
    def columns(self) -> list[dict]:
        """d residual/d p of each free number, by sample and channel; those of a channel only there."""
        shared, own = self.keys
        factor = self.weighed[1]
        slopes = {key: _slopes(self.row.surface, key, self.part.data, self.values) for key in (*shared, *own)}
        out = [{at: factor[at] * slopes[key][at] for at in self.values} for key in shared]
        for channel in self.channels:
            at_channel = [at for at in self.values if at[1] == channel]
            out += [{at: factor[at] * slopes[key][at] for at in at_channel} for key in own]
        return out

    @cached_property
    def inverse(self):
        """(JᵀJ)⁻¹, and a bound of the condition of JᵀJ scaled to ones; None where it has none."""
        sizes = [sqrt(fsum(v * v for v in column.values())) for column in self.columns]
        if not all(sizes):
            return None
        scaled = matrix(len(sizes))
        for i, one in enumerate(self.columns):
            for j in range(i + 1):
                scaled[i, j] = scaled[j, i] = _product(one, self.columns[j]) / (sizes[i] * sizes[j])
        try:
            inverse = scaled**-1
        except ZeroDivisionError:
            return None
        if any(inverse[i, i] <= 0 for i in range(len(sizes))):  # rounding, of columns that are parallel
            return None
        condition = len(sizes) * fsum(inverse[i, i] for i in range(len(sizes)))
        for i, one in enumerate(sizes):
            for j, other in enumerate(sizes):
                inverse[i, j] /= one * other
        return inverse, condition

    def stderrs(self) -> list[tuple[str, int, mpf, float]]:
        """Key, channel, standard error and the relative part of it that doubles may have lost."""
        shared, own = self.keys
        if not self.columns or any(self._at_its_end(key) for key in (*shared, *own)) or self.inverse is None:
            return []
        inverse, condition = self.inverse
        residual = self.weighed[0]
        free = len(self.columns)
        variance = fsum(r * r for r in residual.values()) / max(len(self.values) - free, 1)
        correlation, score, common = alike_neighbours(self.part.residuals, orders_of_neighbours(self.part.data))
        wider = (1 + correlation) / (1 - min(correlation, mpf(MOST_CORRELATED)))
        variances = [wider * variance * each for each in self._spread(inverse)]
        variances[: len(shared)] = [common * each for each in variances[: len(shared)]]
        if self.row.refined:
            residual, factor = self.weighed
            by_ln = {(s, c): each * self._read(s, c) for (s, c), each in factor.items()}
            gains = variances_by_gains(self.part.data, residual, by_ln, self.columns, inverse)
            variances = [a + b for a, b in zip(variances, gains, strict=True)]
        if self.row.refined and score >= DISCREPANT:
            variances = [max(pair) for pair in zip(variances, self._pulled(inverse), strict=True)]
        names = [(key, 0) for key in shared] + [(key, channel) for channel in self.channels for key in own]
        slopes = self._of_slopes(names)
        lost = DOUBLE * float(min(condition, mpf(10) ** 30)) + max(slopes)
        return [
            (*name, sqrt(each), lost + OWN * of_slope)
            for name, each, of_slope in zip(names, variances, slopes, strict=True)
        ]

    def _of_slopes(self, names: list[tuple[str, int]]) -> list[float]:
        """What doubles lose of the slope by each number: much of one that hardly changes f."""
        sizes = [
            abs(self.row.surface.at(*name)) * sqrt(fsum(v * v for v in column.values()) / len(column))
            for name, column in zip(names, self.columns, strict=True)
        ]
        return [float(SLOPE / (each or mpf(1))) for each in sizes]

    def _at_its_end(self, key: str) -> bool:
        """Whether the laws have no slope left by a number that is 0, so that rounding alone says how sure it is."""
        value = self.row.parameters[key]["value"]
        zero = any(each == 0 for each in (value if isinstance(value, list) else [value]))
        return zero and key.rpartition(".")[2] in EVEN

    def _spread(self, inverse) -> list:
        """The diagonal of (JᵀJ)⁻¹; where residuals are not alike, of (JᵀJ)⁻¹ Jᵀ D J (JᵀJ)⁻¹, D their variances."""
        count, unlike = len(self.columns), self._unlike
        if unlike is None:
            return [inverse[i, i] for i in range(count)]
        roots = {at: sqrt(each) for at, each in unlike.items()}
        counted = [{at: roots[at] * v for at, v in column.items()} for column in self.columns]
        middle = matrix(count)
        for i, one in enumerate(counted):
            for j in range(i + 1):
                middle[i, j] = middle[j, i] = _product(one, counted[j])
        both = inverse * middle * inverse
        return [both[i, i] for i in range(count)]

    def _pulled(self, inverse) -> list:
        """What blocks of neighbours pull each number by, squared; the most over the ways to cut blocks."""
        residual, count = self.weighed[0], len(self.columns)
        pulls = [{at: residual[at] * v for at, v in column.items()} for column in self.columns]
        most = [mpf(0)] * count
        whole = scans_of_turns(self.part.data)
        for blocks in [*ways_to_cut(self.part.data), *([whole] if whole else [])]:
            sums: dict[int, list] = defaultdict(lambda: [mpf(0)] * count)
            for place, column in enumerate(pulls):
                for (s, _), v in column.items():
                    sums[blocks[s]][place] += v
            moved = [[fdot(zip(inverse[i, :], each, strict=True)) for i in range(count)] for each in sums.values()]
            most = [max(before, fsum(each[i] ** 2 for each in moved)) for i, before in enumerate(most)]
        return most


def _product(one: dict, other: dict):
    few, many = (one, other) if len(one) <= len(other) else (other, one)
    return fdot((v, many[at]) for at, v in few.items() if at in many)


def _slopes(surface: ExactSurface, key: str, data: Readings, values: Sequence[tuple[int, int]]) -> dict:
    """d reading/d p of one parameter, by sample and channel."""
    return {(s, c): surface.slope(key, data.sights[s], c, data.wavelengths[c]) for s, c in values}


def _by_stated_errors(data: Readings) -> list[list]:
    """1/relative²; none surer than ten times the median, and none of a value near the dark level's doubt."""
    assert data.stated is not None
    relative = [
        [
            error / hypot(value, 2 * max(doubt, LEAST_DOUBT)) if known and 0 <= error < LARGEST else None
            for error, value, known, doubt in zip(*each, data.doubt, strict=True)
        ]
        for each in zip(data.stated, data.values, data.looked_at, strict=True)
    ]
    clear = [
        v for row, told in zip(relative, data.told, strict=True) for v, known in zip(row, told, strict=True) if known
    ]
    least = max(0.1 * median(v for v in clear if v is not None), LEAST_ERROR)
    return [[mpf(0) if v is None else 1 / mpf(min(max(v, least), MOST_ERROR)) ** 2 for v in row] for row in relative]
