"""How well a smooth reciprocal function describes data in the plane of incidence, once more: the floor under any law.

    ln f = mean + Σ c_ab B_a(u) B_b(θd/90°),   u = asinh(tan θh/s)/asinh(tan 1.5/s)
    (A + λ P) c = Bᵀ W (ln f - mean),   A = Bᵀ W B + 1e-6,   gcv = rms/(1 - edf/N),   edf = tr (A + λ P)⁻¹ A

B are cubic B-splines, 14 in u and 8 in θd, P squared second differences; λ is the one of 33 with the least gcv, found
in doubles, where each is told from the next by far more than they lose (Craven and Wahba 1979).
"""

from collections import Counter
from math import nan
from statistics import median

import numpy as np
from mpmath import acos, asinh, fdot, fsum, mpf, pi, radians, sqrt, tan

from ..records import dataclass
from .exact_errors import APART_DEG, HELD_DEG, Readings
from .exact_surface import ExactReading, ExactSurface
from .rederived import Comparisons

ACROSS, ALONG, ORDER = 14, 8, 4  # splines in u and in θd; cubic
STEEPEST, SCALE = mpf("1.5"), mpf("0.02")
RIDGE = mpf("1e-6")
STIFFNESSES = [10.0 ** (-6 + place / 4) for place in range(33)]
MOST_DIRECTIONS, MOST_CHANNELS, FEWEST, FEWEST_INCIDENCES = 2000, 4, 90, 2
OFF_PLANE_DEG = 0.1
AT_DEG, NARROWER, PER_HALF_WIDTH = 20.0, 3, mpf("1.55")  # where a lobe's width is looked at; α over it
ALIKE, MOST_WEIGHT, LEAST_SCAN = 2, 10, 5  # of scans: how unlike they may be; times that one counts more; directions
DIGITS = 4
HALF = 0.0005 * (1 + 1e-6)  # of the last of three decimals
CLOSE = 1e-6  # relative, of what doubles keep of the normal equations
AS_GOOD = 1e-7
LEAST_LEFT = mpf("1e-3")


@dataclass(frozen=True, eq=False)
class FloorOfChannel:
    """What a smooth function leaves of one channel."""

    gcv: mpf
    edf: mpf
    stiffness: float
    left: list  # (weight, squared residual)


def compare_floor(
    answer: dict, surface: ExactSurface, residuals: list[list], data: Readings, found: Comparisons
) -> None:
    """The floor's numbers that follow from the data and from the row it is under; nothing out of the plane of
    incidence, of more than four channels, and of more directions than are looked at one by one."""
    floor, rows = answer["floor"], [place for place, row in enumerate(data.told) if any(row)]
    if len(data.angles) > MOST_DIRECTIONS or len(data.wavelengths) > MOST_CHANNELS or not _in_plane(data):
        return
    counted = _counted(data, rows)
    columns = [c for c in range(len(data.wavelengths)) if sum(data.told[row][c] for row in rows) >= FEWEST]
    model = _rms([(w, residuals[row][c]) for row, w in zip(rows, counted, strict=True) for c in columns])
    scale = min(SCALE, _alpha(surface, data) / NARROWER)
    splines = [_products(data.sights[row], scale) for row in rows]
    told = floor["lambda"] if isinstance(floor.get("lambda"), float | int) else nan
    each = [_smooth(splines, [data.ln[row][c] for row in rows], counted, told) for c in columns]
    counts = [len(one.left) for one in each]
    together = sqrt(fsum(n * one.gcv**2 for n, one in zip(counts, each, strict=True)) / sum(counts))
    smooth = min(together, model)
    found.check("floor.directions", floor.get("directions"), len(rows))
    rights = {"model": model, "smooth": smooth, "gcv": smooth, "lambda": median(one.stiffness for one in each)}
    rights["coefficients"] = fsum(one.edf for one in each) / len(each)
    rights["residual"] = sqrt(fsum(w * square for one in each for w, square in one.left) / sum(counts))
    rights["reducible"] = _removed(smooth, model)
    for name, right in rights.items():
        found.rounded(f"floor.{name}", floor.get(name), right, DIGITS, CLOSE)
    _compare_warnings(answer.get("warnings", []), rights["reducible"], found)
    if floor.get("factored") is None:
        return
    by_form, steps = _removed(mpf(floor["factored"]), model), mpf(10) ** -DIGITS * 5
    allowed = float(2 * steps * (mpf(floor["factored"]) / model) ** 2 + steps)
    found.check("floor.by_form", floor.get("by_form"), by_form, 0.0, allowed)
    found.check("floor.beyond_form", floor.get("beyond_form"), max(rights["reducible"] - by_form, mpf(0)), 0.0, allowed)


def _compare_warnings(warnings: list[dict], reducible, found: Comparisons) -> None:
    """The share of the squared misfit that another law would remove, to three decimals in what the answer warns of."""
    for place, each in enumerate(warnings):
        told = (each.get("numbers") or {}).get("reducible")
        if told is not None:
            found.check(f"warnings[{place}].numbers.reducible", told, reducible, 0.0, HALF)


def _removed(left, model):
    return min(max(1 - (left / model) ** 2, mpf(0)), mpf(1)) if model > 0 else mpf(0)


def _rms(pairs: list[tuple]):
    known = [(w, v) for w, v in pairs if v is not None]
    return sqrt(fsum(w * v * v for w, v in known) / len(known))


def _in_plane(data: Readings) -> bool:
    turns = ((each[3] - each[1]) % 180 for each in data.angles if min(each[0], each[2]) > 1e-7)
    return all(min(turn, 180 - turn) < OFF_PLANE_DEG for turn in turns)


def _counted(data: Readings, rows: list[int]) -> list:
    """How much each direction counts, mean 1, so that every incidence counts alike; 1 where scans are alike."""
    order = sorted(range(len(data.angles)), key=lambda row: data.angles[row][0])
    number, numbers, first, wandered = 0, {}, data.angles[order[0]][0], 0.0
    for before, row in zip([order[0], *order], order, strict=False):
        if data.angles[row][0] - data.angles[before][0] > APART_DEG:
            number, first = number + 1, data.angles[row][0]
        numbers[row] = number
        wandered = max(wandered, data.angles[row][0] - first)
    known = [row for row, each in enumerate(data.looked_at) if any(each)]
    held = Counter(numbers[row] for row in known)
    if wandered > HELD_DEG or median(held.values()) < LEAST_SCAN:
        return [mpf(1)] * len(rows)
    most = max(held.values())
    counts = {each: most if held[each] < LEAST_SCAN else held[each] for each in numbers.values()}
    if most <= ALIKE * min(counts[numbers[row]] for row in known):
        return [mpf(1)] * len(rows)
    raw = [min(mpf(most) / counts[numbers[row]], mpf(MOST_WEIGHT)) for row in rows]
    mean = fsum(raw) / len(raw)
    return [each / mean for each in raw]


def _alpha(surface: ExactSurface, data: Readings):
    """Of the GGX lobe that is as wide at half height; no narrower than the splines resolve anyway where it is wide."""

    def brightest(aside):
        pair = ExactReading((AT_DEG, 0.0, float(AT_DEG + aside), 180.0)).pair
        return max(surface.brdf(pair, c, um) for c, um in enumerate(data.wavelengths))

    top = brightest(mpf(0))
    for place in range(60):
        aside = mpf("0.02") * mpf(3000) ** (mpf(place) / 59)
        alpha = tan(radians(aside / 2)) * PER_HALF_WIDTH
        if alpha > NARROWER * SCALE or brightest(aside) < top / 2:
            return alpha
    return mpf(1)


# --- splines -----------------------------------------------------------------------------------------


def _products(sight: ExactReading, scale) -> dict[int, mpf]:
    """Those of the products that are not 0 at one pair of directions, by their number."""
    pair, steepest = sight.pair, tan(STEEPEST)
    u = asinh(min(sqrt(max(pair.tan2_h, mpf(0))), steepest) / scale) / asinh(steepest / scale)
    v = acos(min(pair.cos_d, mpf(1))) / (pi / 2)
    in_u, in_v = _splines(u, ACROSS), _splines(v, ALONG)
    return {ALONG * a + b: x * y for a, x in in_u for b, y in in_v}


def _splines(x, count: int) -> list[tuple[int, mpf]]:
    """The four cubic B-splines on clamped even knots that are not 0 at x, by the recurrence of Cox and de Boor."""
    x, spans = min(max(x, mpf(0)), mpf(1)), count - ORDER + 1
    knots = [mpf(min(max(place - ORDER + 1, 0), spans)) / spans for place in range(count + ORDER)]
    span = min(int(x * spans), spans - 1) + ORDER - 1
    value = {span: mpf(1)}
    for degree in range(1, ORDER):
        raised = {}
        for place in range(span - degree, span + 1):
            up, down = knots[place + degree] - knots[place], knots[place + degree + 1] - knots[place + 1]
            rising = (x - knots[place]) / up * value.get(place, 0) if up else mpf(0)
            falling = (knots[place + degree + 1] - x) / down * value.get(place + 1, 0) if down else mpf(0)
            raised[place] = rising + falling
        value = raised
    return sorted(value.items())


def _penalty() -> dict[tuple[int, int], int]:
    """Squared second differences along u and along θd, by numbers of products; the lower half."""
    out: Counter[tuple[int, int]] = Counter()
    bent = [(ALONG * a + b, ALONG) for a in range(ACROSS - 2) for b in range(ALONG)]
    bent += [(ALONG * a + b, 1) for a in range(ACROSS) for b in range(ALONG - 2)]
    for first, step in bent:
        difference = ((first, 1), (first + step, -2), (first + 2 * step, 1))
        for one, times in difference:
            for other, again in difference:
                if one >= other:
                    out[one, other] += times * again
    return dict(out)


PENALTY = _penalty()
COUNT = ACROSS * ALONG


def _smooth(splines: list[dict], ln: list, counted: list, told: float) -> FloorOfChannel:
    """The smooth function closest to one channel."""
    known = [each for each in zip(splines, ln, counted, strict=True) if each[1] is not None]
    mean = fsum(w * v for _, v, w in known) / fsum(w for *_, w in known)
    normal = {(i, i): RIDGE for i in range(COUNT)}
    right = [mpf(0)] * COUNT
    for row, v, w in known:
        for i, x in row.items():
            right[i] += w * x * (v - mean)
            for j, y in row.items():
                if j <= i:
                    normal[i, j] = normal.get((i, j), mpf(0)) + w * x * y
    stiffness = _stiffness(normal, right, fsum(w * (v - mean) ** 2 for _, v, w in known), len(known), told)
    factor = _Banded(normal, mpf(stiffness))
    edf = factor.trace_with(normal)
    solved = factor.solve(right)
    left = [(w, (v - mean - fsum(x * solved[i] for i, x in row.items())) ** 2) for row, v, w in known]
    rms = sqrt(fsum(w * square for w, square in left) / len(left))
    return FloorOfChannel(rms / max(1 - edf / len(left), LEAST_LEFT), edf, stiffness, left)


def _stiffness(normal: dict, right: list, total, count: int, told: float) -> float:
    """The one of least generalised cross-validation; of those as good the one nearest to what was told."""
    plain, bent = np.zeros((COUNT, COUNT)), np.zeros((COUNT, COUNT))
    for (i, j), value in normal.items():
        plain[i, j] = plain[j, i] = float(value)
    for (i, j), times in PENALTY.items():
        bent[i, j] = bent[j, i] = times
    along, found = np.array([float(v) for v in right]), []
    for stiffness in STIFFNESSES:
        both = np.linalg.solve(plain + stiffness * bent, np.column_stack([plain, along]))
        edf, solved = np.trace(both[:, :-1]), both[:, -1]
        left = max(float(total) - 2 * solved @ along + solved @ plain @ solved, 0.0)
        found.append(np.sqrt(left / count) / max(1 - edf / count, 1e-3))
    least = min(found)
    good = [each for each, value in zip(STIFFNESSES, found, strict=True) if value <= least * (1 + AS_GOOD)]
    return min(good, key=lambda each: abs(each - told))


class _Banded:
    """L of the normal equations at one stiffness, M = L Lᵀ; its rows from their first number that is not 0."""

    def __init__(self, normal: dict, stiffness):
        self.first = [min(j for i, j in (*normal, *PENALTY) if i == row) for row in range(COUNT)]
        self.rows: list[list] = []
        for i in range(COUNT):
            row: list = []
            for j in range(self.first[i], i + 1):
                value = normal.get((i, j), mpf(0)) + stiffness * PENALTY.get((i, j), 0)
                value -= self._common(row, self.first[i], j) if j < i else fsum(each * each for each in row)
                row.append(value / self.rows[j][-1] if j < i else sqrt(value))
            self.rows.append(row)

    def _common(self, row: list, first: int, j: int):
        """Product of a row that is being formed with an earlier one, before number j."""
        begin = max(first, self.first[j])
        return fdot(row[begin - first : j - first], self.rows[j][begin - self.first[j] : j - self.first[j]])

    def forward(self, right: list, begin: int = 0) -> list:
        """L⁻¹ of numbers that are 0 before `begin`."""
        out = [mpf(0)] * COUNT
        for i in range(begin, COUNT):
            low = max(self.first[i], begin)
            part = fdot(self.rows[i][low - self.first[i] : -1], out[low:i])
            out[i] = (right[i] - part) / self.rows[i][-1]
        return out

    def solve(self, right: list) -> list:
        """M⁻¹ of some numbers."""
        out = self.forward(right)
        for i in reversed(range(COUNT)):
            out[i] /= self.rows[i][-1]
            for j in range(self.first[i], i):
                out[j] -= self.rows[i][j - self.first[i]] * out[i]
        return out

    def trace_with(self, normal: dict):
        """tr(M⁻¹ A) = Σ A_ij M⁻¹_ij, with M⁻¹ = Σ of the outer products of rows of L⁻¹."""
        inverse = [self.forward([mpf(i == k) for i in range(COUNT)], k) for k in range(COUNT)]
        total = mpf(0)
        for (i, j), value in normal.items():
            total += (2 if i != j else 1) * value * fdot(inverse[i][i:], inverse[j][i:])
        return total
