"""How probable each value of a law's open numbers is, given all readings: a grid that is made finer where it matters.

    p(law's numbers | readings) ~ prior Π exp(-z²/2),   z = (predicted - read)/doubt

What a glossmeter reads depends besides on the index and on the body's albedo, or on the reflectance below a coat.
These are normal, in their doubts from what is usual, and are integrated out at each cell, with the reading linear in
them (twice corrected). Nothing is drawn at random: the same description gives the same digits.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property, lru_cache
from math import cos, hypot, log, radians

import numpy as np

from ..physics import gloss
from ..physics.fresnel import fresnel
from ..records import dataclass
from .evidence import Evidence, Observation
from .laws import Axis, Cells, Family, SeenBy

COARSE = {1: 512, 2: 64}  # cells along each axis of a law with so many open numbers
ROUNDS = 4  # of making the grid finer
FAR = 12.0  # ln of the probability below the best at which a cell no longer counts
ENDS = 0.01  # of the greatest probability: so much at the end of the range, and the readings set no end


@dataclass(frozen=True, eq=False)
class Posterior:
    """Cells of a law and how probable each is."""

    family: Family
    evidence: Evidence
    axes: tuple[np.ndarray, ...]  # ln of the numbers along each
    ln_probable: np.ndarray  # of the shape of the axes; prior times likelihood
    nuisances: np.ndarray  # (2, ...), the most probable ones of each cell
    cells: Cells

    @cached_property
    def weights(self) -> np.ndarray:
        """The share of the probability that each cell has."""
        weights = np.exp(self.ln_probable - self.ln_probable.max())
        return weights / weights.sum()

    def margin(self, place: int) -> np.ndarray:
        """The share along one axis."""
        return self.weights.sum(axis=1 - place) if len(self.axes) > 1 else self.weights

    def quantile(self, place: int, share: float, weights: np.ndarray | None = None) -> float:
        """ln of the number below which a share of the probability lies."""
        axis, weights = self.axes[place], self.margin(place) if weights is None else weights
        step = axis[1] - axis[0]
        edges = np.concatenate([[axis[0]], axis[:-1] + step / 2, [axis[-1]]])
        passed = np.concatenate([[0.0], np.cumsum(weights)])
        return float(np.interp(share * passed[-1], passed, edges))

    def spread(self, place: int) -> float:
        """Standard deviation of ln of the number; at least a quarter of a cell."""
        axis, weights = self.axes[place], self.margin(place)
        mean = float(np.sum(weights * axis))
        return float(max(np.sqrt(np.sum(weights * (axis - mean) ** 2)), (axis[1] - axis[0]) / 4))

    def open_ends(self, place: int) -> tuple[bool, bool]:
        """Whether what is probable runs out of the law's range, below and above."""
        axis, limit, weights = self.axes[place], self.family.axes[place], self.margin(place)
        below = axis[0] <= log(limit.low) + 1e-9 and weights[0] > ENDS * weights.max()
        above = axis[-1] >= log(limit.high) - 1e-9 and weights[-1] > ENDS * weights.max()
        return bool(below), bool(above)

    def across(self, place: int, value: float) -> np.ndarray:
        """The shares along the other axis where this one's ln has a value."""
        axis = self.axes[place]
        at = float(np.clip((value - axis[0]) / (axis[1] - axis[0]), 0, len(axis) - 1.001))
        first, share = int(at), at - int(at)
        ln = np.moveaxis(self.ln_probable, place, 0)
        ln = ln[first] * (1 - share) + ln[first + 1] * share
        weights = np.exp(ln - ln.max())
        return weights / weights.sum()


@lru_cache(maxsize=1024)
def coarse(family: Family, evidence: Evidence) -> Posterior:
    """The grid over the law's whole range; what each reading makes of it is kept."""
    sight, (axes, cells) = SeenBy.of(evidence), _whole(family)
    shares = {angle: _known_share(family, angle) for angle in gloss_angles(evidence)}
    return _posterior(family, evidence, axes, cells, lambda asked: _known_miss(family, asked, sight), shares)


@lru_cache
def _whole(family: Family) -> tuple[tuple[np.ndarray, ...], Cells]:
    return _cells(family, [(log(axis.low), log(axis.high)) for axis in family.axes])


@lru_cache(maxsize=512)
def _known_miss(family: Family, asked: Observation, sight: SeenBy) -> np.ndarray | None:
    return missed(family, asked, sight, _whole(family)[1])


@lru_cache
def _known_share(family: Family, angle: int) -> np.ndarray:
    return family.share(angle, _whole(family)[1])


@lru_cache(maxsize=256)
def finest(family: Family, evidence: Evidence) -> Posterior:
    """The grid that has its cells where something is probable."""
    grid = coarse(family, evidence)
    for _ in range(ROUNDS):
        likely = np.argwhere(grid.ln_probable > grid.ln_probable.max() - FAR)
        ends, finer = [], False
        for place, axis in enumerate(grid.axes):
            first, last = max(likely[:, place].min() - 1, 0), min(likely[:, place].max() + 1, len(axis) - 1)
            finer = finer or last - first < 0.7 * len(axis)
            ends.append((float(axis[first]), float(axis[last])))
        if not finer:
            break
        grid = _grid(family, evidence, ends)
    return grid


def _cells(family: Family, ends: Sequence[tuple[float, float]]) -> tuple[tuple[np.ndarray, ...], Cells]:
    axes = tuple(np.linspace(low, high, COARSE[len(ends)]) for low, high in ends)
    mesh = np.meshgrid(*axes, indexing="ij")
    return axes, {axis.name: np.exp(each) for axis, each in zip(family.axes, mesh, strict=True)}


def _grid(family: Family, evidence: Evidence, ends: Sequence[tuple[float, float]]) -> Posterior:
    axes, cells = _cells(family, ends)
    shares = {angle: family.share(angle, cells) for angle in gloss_angles(evidence)}
    return _posterior(
        family, evidence, axes, cells, lambda asked: missed(family, asked, SeenBy.of(evidence), cells), shares
    )


def _posterior(family, evidence, axes, cells, miss, shares) -> Posterior:
    total = np.zeros(next(iter(cells.values())).shape)
    for axis in family.axes:
        total -= 0.5 * from_usual(axis, np.log(cells[axis.name])) ** 2
    for asked in evidence.observations:
        z = None if asked.quantity == "gloss" else miss(asked)
        total -= 0.0 if z is None else 0.5 * z * z
    by_gloss, nuisances = through_nuisances(evidence, shares, total.shape)
    return Posterior(family, evidence, axes, total + by_gloss, nuisances, cells)


def gloss_angles(evidence: Evidence) -> list[int]:
    """Where a glossmeter read."""
    return sorted({int(each.angle) for each in evidence.observations if each.quantity == "gloss"})


def from_usual(axis: Axis, ln_value):
    """How far a number lies from what is usual, in doubts of that."""
    return 0.0 * ln_value if axis.usual is None else (ln_value - log(axis.usual)) / log(axis.factor)


def missed(family: Family, asked: Observation, sight: SeenBy, cells: Cells) -> np.ndarray | None:
    """How far a law misses a reading that is not a glossmeter's, in doubts; None where it cannot make it."""
    predicted = family.predicted(asked, sight, cells)
    if predicted is None:
        return None
    return beyond((predicted - asked.value) / doubt_of(asked, family, sight), asked.side)


def doubt_of(asked: Observation, family: Family, sight: SeenBy) -> float:
    """A correlation length tells a facet law sigma/tau, with the doubt of both; else the reading's own."""
    return hypot(asked.doubt, sight.sigma_doubt) if asked.quantity == "tau" and len(family.axes) == 1 else asked.doubt


def beyond(z: np.ndarray, side: str) -> np.ndarray:
    """Of a bound only what lies on the wrong side of it."""
    if side == "at least":
        return np.minimum(z, 0.0)
    return np.maximum(z, 0.0) if side == "at most" else z


# --- what a glossmeter reads -------------------------------------------------------------------------


def through_nuisances(evidence: Evidence, shares: Mapping[int, np.ndarray], shape) -> tuple[np.ndarray, np.ndarray]:
    """ln of the mean likelihood of all gloss readings at each cell, and the most probable nuisances (2, ...).

    `shares` of a smooth surface's light by angle, of this shape.
    """
    v = np.zeros((2, *shape))
    readings = [(each, shares[int(each.angle)]) for each in evidence.observations if each.quantity == "gloss"]
    if not readings:
        return np.zeros(shape), v
    for _ in range(3):
        a, b, c, d, e = np.ones(shape), np.zeros(shape), np.ones(shape), np.zeros(shape), np.zeros(shape)
        for each, share in readings:
            predicted, *slopes = units_and_slopes(evidence, int(each.angle), share, v)
            by_index, by_base = (slope / each.doubt for slope in slopes)
            miss = (each.value - predicted) / each.doubt + by_index * v[0] + by_base * v[1]
            a, b, c = a + by_index**2, b + by_index * by_base, c + by_base**2
            d, e = d + by_index * miss, e + by_base * miss
        det = a * c - b * b
        v = np.clip(np.stack([(c * d - b * e) / det, (a * e - b * d) / det]), -4.0, 4.0)
    total = -0.5 * (v[0] ** 2 + v[1] ** 2) - 0.5 * np.log(det)
    for each, share in readings:
        predicted, *_ = units_and_slopes(evidence, int(each.angle), share, v)
        total = total - 0.5 * ((predicted - each.value) / each.doubt) ** 2
    return total, v


def units_and_slopes(evidence: Evidence, angle: int, share, v) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Gloss units of a surface whose lobe brings `share` of a smooth one's light, and their slopes by the nuisances.

    v[0]: the index (of the coat), by its doubt in ln(n - 1); v[1]: by their doubts the body's albedo, or ln of the
    reflectance of the metal or of what lies under the coat.
    """
    scale, place = 100 / gloss.black_glass(angle), gloss.ANGLES.index(angle)
    if evidence.base and not evidence.coated:
        metal = scale * evidence.base[place] * np.exp(evidence.base_doubt * v[1]) * share
        return metal, np.zeros_like(metal), evidence.base_doubt * metal
    step = evidence.n_doubt / (evidence.n - 1)
    at, reflectance, slope = _interface(angle)
    ln_index = log(evidence.n - 1) + step * v[0]
    f, by_v = np.interp(ln_index, at, reflectance), step * np.interp(ln_index, at, slope)
    if not evidence.coated:
        body = gloss.DIFFUSE[angle] * (evidence.albedo + evidence.albedo_doubt * v[1])
        by_albedo = np.full_like(f, gloss.DIFFUSE[angle] * evidence.albedo_doubt)
        return scale * f * share + body, scale * by_v * share, by_albedo
    below = scale * evidence.base[place] * np.exp(evidence.base_doubt * v[1]) * share
    through = (1 - f) ** 2
    return scale * f + through * below, by_v * (scale - 2 * (1 - f) * below), evidence.base_doubt * through * below


def index_at(evidence: Evidence, v):
    """The index that a nuisance stands for."""
    return 1 + (evidence.n - 1) * np.exp(evidence.n_doubt / (evidence.n - 1) * np.asarray(v))


@lru_cache(maxsize=len(gloss.ANGLES))
def _interface(angle: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """ln(n - 1), F(angle) of a dielectric, and dF/d ln(n - 1)."""
    at = np.linspace(log(0.05), log(3.0), 300)
    reflectance = fresnel(cos(radians(angle)), 1 + np.exp(at))
    return at, reflectance, np.gradient(reflectance, at)


def index_left(evidence: Evidence, shares: Mapping[int, np.ndarray], v: np.ndarray) -> float:
    """Variance of the index' nuisance that the readings leave at one surface."""
    a, b, c = 1.0, 0.0, 1.0
    for each in evidence.observations:
        if each.quantity == "gloss":
            _, *slopes = units_and_slopes(evidence, int(each.angle), shares[int(each.angle)], v[:, None])
            by_index, by_base = (float(slope[0]) / each.doubt for slope in slopes)
            a, b, c = a + by_index**2, b + by_index * by_base, c + by_base**2
    return c / (a * c - b * b)
