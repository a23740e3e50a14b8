"""Roughness, index and albedo from all observations together: every law by itself, then the law to go by.

A law that meets all readings goes before one that does not; of these the plainest that comes about as near, unless
what was observed is a matter of waves. Where no law meets all, the one reading without which a law meets the rest is
set aside and named; where several would do, the least direct.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from math import inf, log, sqrt

import numpy as np

from ..records import dataclass
from .evidence import Evidence, Observation
from .laws import BARE_SIGMA_UM, FAMILIES, Cells, Family, SeenBy
from .posterior import (
    Posterior,
    beyond,
    coarse,
    doubt_of,
    finest,
    gloss_angles,
    index_at,
    index_left,
    through_nuisances,
    units_and_slopes,
)

MIDDLE, LOW, HIGH = 0.5, 0.025, 0.975  # of what is probable: the value, and the ends of an interval of 95 %
FARTHEST = 3.0  # doubts by which a law may miss a single reading and still meet it
PRICE = 1.0  # squares of doubts that one more open number has to save: a plainer law misses no reading by more than one
DECIDES = 1.3  # how many times wider the interval is without the reading that decides
FLAT = 0.3  # of the greatest probability: about as probable
UNTOLD = 0.75  # of the usual spread: so much is left where the readings say nothing of a number
# which reading is set aside before another where either would do: a look first, an instrument last
LEAST_DIRECT = ("sharpness", "emergence", "haze", "width", "tau", "dimming", "sigma", "gloss")


@dataclass(frozen=True)
class Estimate:
    """A number with the interval that holds it with 95 % probability; open where the readings set no end to it."""

    value: float
    low: float | None
    high: float | None
    decided_by: str = ""  # key of the observation without which the interval would grow most; "": none of them

    def times(self, factor: float) -> "Estimate":
        """The same of a number that is so many times it."""
        low, high = (None if end is None else factor * end for end in (self.low, self.high))
        return replace(self, value=factor * self.value, low=low, high=high)


@dataclass(frozen=True)
class LawEstimate:
    """What one law makes of the evidence."""

    name: str
    numbers: Mapping[str, Estimate]  # alpha, slope; sigma and tau [µm] of waves; n where readings bear on it
    misses: Mapping[str, float]  # key -> how far the law misses this reading, in its doubts; "index" of what is usual
    predicted: Mapping[str, float]  # key -> what the law's numbers read, as the observation counts
    unexplained: tuple[str, ...]  # keys of observations that this law cannot make

    @property
    def meets(self) -> bool:
        """Whether it explains all readings: as many doubts as they have, by chance (98 %)."""
        count = len(self.misses)
        return not self.unexplained and self.squares <= count + 2 * sqrt(2 * count) and self.worst <= FARTHEST

    @property
    def squares(self) -> float:
        """Sum of the squares of all misses."""
        return sum(z * z for z in self.misses.values())

    @property
    def worst(self) -> float:
        return max(map(abs, self.misses.values()), default=0.0)


@dataclass(frozen=True)
class Inference:
    """What all observations say together."""

    given: Evidence
    evidence: Evidence  # what the numbers rest on: all but what was set aside
    laws: tuple[LawEstimate, ...]  # the law to go by first
    set_aside: Mapping[str, tuple[float, float]]  # key -> (what the others make probable, by how many of its doubts)

    @property
    def law(self) -> LawEstimate:
        return self.laws[0]

    def numbers_of(self, name: str) -> dict[str, float]:
        """A law's own numbers; none where it cannot make what was read."""
        found = next((each for each in self.laws if each.name == name and not each.unexplained), None)
        return {key: each.value for key, each in found.numbers.items()} if found else {}


@lru_cache(maxsize=512)
def infer(evidence: Evidence) -> Inference:
    """The laws' numbers, the law to go by, and the reading that contradicts the others, if one does."""
    laws = _laws(evidence)
    if laws[0].meets or len(_keys(evidence)) < 2:
        return _decided(Inference(evidence, evidence, laws, {}))
    trials = []
    for key, rest in _promising(evidence):
        found = _laws(rest)
        quantity = next(each.quantity for each in evidence.observations if each.key == key)
        trials.append((not found[0].meets, LEAST_DIRECT.index(quantity), key, rest, found))
    fails, rank, key, rest, found = min(trials, key=lambda each: each[:2])
    alike = [trial for trial in trials if trial[:2] == (False, rank)]
    if fails or len(alike) > 1:  # nothing tells which of them is wrong
        return _decided(Inference(evidence, evidence, laws, {}))
    return _decided(Inference(evidence, rest, found, {key: _against(key, evidence, rest, found[0].name)}))


def _promising(evidence: Evidence) -> list[tuple[str, Evidence]]:
    """Keys without which the rest agrees about best, and the rest."""
    rests = [(key, evidence.without(key)) for key in _keys(evidence)]
    agree = [max(_agreement(family, rest) for family in FAMILIES) for _, rest in rests]
    return [each for each, value in zip(rests, agree, strict=True) if value > max(agree) - 8.0]


def _agreement(family: Family, evidence: Evidence) -> float:
    """ln of how probable all readings are at the law's best, on the coarse grid; least where it cannot make one."""
    if _cannot(family, evidence):
        return -inf
    return float(coarse(family, evidence).ln_probable.max())


def _cannot(family: Family, evidence: Evidence) -> tuple[str, ...]:
    """Keys of what this law cannot make."""
    sight, cells = SeenBy.of(evidence), {axis.name: np.array([axis.low]) for axis in family.axes}
    asked = (each for each in evidence.observations if each.quantity != "gloss")
    return tuple(dict.fromkeys(each.key for each in asked if family.predicted(each, sight, cells) is None))


def _decided(found: Inference) -> Inference:
    """With the observation that tells each number, of the law to go by."""
    family = next(each for each in FAMILIES if each.name == found.law.name)
    by = {axis.name: _decider(family, found.evidence, place) for place, axis in enumerate(family.axes)}
    by |= {"tau": by.get("sigma", ""), "alpha": by.get("alpha", by.get("slope", ""))}
    by["slope"] = by["alpha"]
    numbers = {
        name: replace(each, decided_by=by.get(name, each.decided_by)) for name, each in found.law.numbers.items()
    }
    return replace(found, laws=(replace(found.law, numbers=numbers), *found.laws[1:]))


def _keys(evidence: Evidence) -> list[str]:
    return list(dict.fromkeys(each.key for each in evidence.observations))


@lru_cache(maxsize=1024)
def _laws(evidence: Evidence) -> tuple[LawEstimate, ...]:
    """All laws, the one to go by first."""
    waves = any(
        each.quantity in ("emergence", "dimming", "sigma") and each.side != "at least" for each in evidence.observations
    )
    order = [family.name for family in FAMILIES][:: -1 if waves else 1]
    open_numbers = {family.name: len(family.axes) for family in FAMILIES}

    def rank(law: LawEstimate) -> tuple:
        price = round(law.squares + PRICE * open_numbers[law.name])
        return (
            not law.meets,
            len(law.unexplained),
            price if law.meets and not waves else law.worst,
            order.index(law.name),
        )

    return tuple(sorted((_estimate(family, evidence) for family in FAMILIES), key=rank))


def _against(key: str, evidence: Evidence, rest: Evidence, law: str) -> tuple[float, float]:
    """What the others make of a reading, and how far it lies from that, in the doubts of both."""
    family = next(each for each in FAMILIES if each.name == law)
    grid, farthest, sight = finest(family, rest), (0.0, 0.0), SeenBy.of(evidence)
    for asked in (each for each in evidence.observations if each.key == key):
        predicted = _readings_of(family, rest, asked, grid.cells, grid.nuisances)
        if np.isnan(predicted).any():
            return asked.value, inf
        mean = float(np.sum(grid.weights * predicted))
        spread = float(np.sum(grid.weights * (predicted - mean) ** 2))
        z = (asked.value - mean) / sqrt(doubt_of(asked, family, sight) ** 2 + spread)
        farthest = max(farthest, (mean, z), key=lambda each: abs(each[1]))
    return farthest


# --- one law -----------------------------------------------------------------------------------------


def _estimate(family: Family, evidence: Evidence) -> LawEstimate:
    cannot = _cannot(family, evidence)
    if cannot:
        return LawEstimate(family.name, {}, {}, {}, cannot)
    grid = finest(family, evidence)
    last = len(grid.axes) - 1
    held = (family.axes[last].name,) if last and _untold(grid, last) else ()
    at, v = _settled(family, evidence, _representative(grid), held)
    sight, cells = SeenBy.of(evidence), {name: np.array([value]) for name, value in at.items()}
    misses: dict[str, float] = {}
    predicted: dict[str, float] = {}
    for asked in evidence.observations:
        read = _readings_of(family, evidence, asked, cells, v[:, None])
        z = float(beyond((read - asked.value) / doubt_of(asked, family, sight), asked.side)[0])
        if abs(z) >= abs(misses.get(asked.key, 0.0)):
            misses[asked.key], predicted[asked.key] = z, float(read[0])
    if gloss_angles(evidence):
        misses["index"] = float(v[0])
    return LawEstimate(family.name, _numbers(grid, at, v), misses, predicted, ())


def _readings_of(family: Family, evidence: Evidence, asked: Observation, cells: Cells, v) -> np.ndarray:
    """What surfaces with these nuisances read. NaN where the law cannot make the reading."""
    if asked.quantity == "gloss":
        return units_and_slopes(evidence, int(asked.angle), family.share(int(asked.angle), cells), v)[0]
    found = family.predicted(asked, SeenBy.of(evidence), cells)
    return np.full(np.shape(v[0]), np.nan) if found is None else found


def _untold(grid: Posterior, place: int) -> bool:
    """Whether the readings say nothing of a number beyond what is usual."""
    axis = grid.family.axes[place]
    return axis.usual is not None and grid.spread(place) > UNTOLD * log(axis.factor)


def _representative(grid: Posterior) -> dict[str, float]:
    """One surface to stand for all that are probable.

    The middle slope, the usual one where nothing tells it, and the middle height of those with it. Where the readings
    set no upper end to the heights: one so rough that only the slope shows, if that is probable.
    """
    last = len(grid.axes) - 1
    axis = grid.family.axes[last]
    heights = grid.margin(0)
    if last and grid.open_ends(0)[1] and heights[-1] > FLAT * heights.max():
        height = max(log(BARE_SIGMA_UM), grid.quantile(0, LOW) + log(1.5))
        if np.interp(height, grid.axes[0], heights) > FLAT * heights.max():
            slope = grid.quantile(1, MIDDLE, grid.across(0, height))
            return {grid.family.axes[0].name: float(np.exp(height)), axis.name: float(np.exp(slope))}
    value = grid.quantile(last, MIDDLE)
    if axis.usual is not None and _untold(grid, last):
        value = log(axis.usual)
    found = {axis.name: float(np.exp(value))}
    if last:
        height = grid.quantile(0, MIDDLE, grid.across(1, value))
        found[grid.family.axes[0].name] = float(np.exp(height))
    return found


def _settled(
    family: Family, evidence: Evidence, at: Mapping[str, float], held: tuple[str, ...]
) -> tuple[dict[str, float], np.ndarray]:
    """The surface nearest to `at` that meets the readings best, with its nuisances: Gauss and Newton, damped.

    What is `held` stays.
    """
    open_axes = [axis for axis in family.axes if axis.name not in held]
    low, high = (np.array([log(getattr(axis, end)) for axis in open_axes]) for end in ("low", "high"))
    count, sight = len(open_axes), SeenBy.of(evidence)

    def surfaces(x: np.ndarray) -> dict[str, np.ndarray]:
        numbers = {name: np.full(len(x), value) for name, value in at.items()}
        return numbers | {axis.name: np.exp(each) for axis, each in zip(open_axes, x.T, strict=False)}

    def residuals(x: np.ndarray) -> np.ndarray:
        """(surfaces, residuals) of rows of open numbers and nuisances."""
        found, cells, v = [], surfaces(x), x.T[count:]
        for asked in evidence.observations:
            read = _readings_of(family, evidence, asked, cells, v)
            found.append(beyond((read - asked.value) / doubt_of(asked, family, sight), asked.side))
        return np.stack([*found, *v], axis=1)

    shares = _shares(family, evidence, at)
    start = [log(at[axis.name]) for axis in open_axes]
    x = np.concatenate([start, through_nuisances(evidence, shares, (1,))[1][:, 0]])
    steps, damping = 1e-4 * np.eye(len(x)), 1e-3
    here, *others = residuals(np.vstack([x, x + steps]))
    for _ in range(20):
        if here @ here < 1e-9:
            break
        slopes = np.stack([(other - here) / 1e-4 for other in others], axis=1)
        step = -np.linalg.solve(slopes.T @ slopes + damping * np.eye(len(x)), slopes.T @ here)
        tried = x + np.clip(step, -0.3, 0.3)
        tried[:count] = np.clip(tried[:count], low, high)
        there, *near = residuals(np.vstack([tried, tried + steps]))
        gained = here @ here - there @ there
        if gained <= 0:
            damping *= 10
            continue
        x, here, others, damping = tried, there, near, damping / 3
        if gained < 1e-6:
            break
    return {name: float(value[0]) for name, value in surfaces(x[None]).items()}, x[count:]


def _shares(family: Family, evidence: Evidence, at: Mapping[str, float]) -> dict[int, np.ndarray]:
    """What one surface brings to the receptor at each angle that was read."""
    cells = {name: np.array([value]) for name, value in at.items()}
    return {angle: family.share(angle, cells) for angle in gloss_angles(evidence)}


def _numbers(grid: Posterior, at: Mapping[str, float], v: np.ndarray) -> dict[str, Estimate]:
    """Every number of the law with its interval."""
    found = {}
    for place, axis in enumerate(grid.family.axes):
        value, ends = at[axis.name], grid.open_ends(place)
        low, high = (float(np.exp(grid.quantile(place, share))) for share in (LOW, HIGH))
        found[axis.name] = _enclosing(value, None if ends[0] else low, None if ends[1] else high)
    if "sigma" in found:
        found["tau"] = _length(grid, at)
        found["alpha"] = found["slope"].times(2.0)
    else:
        found["slope"] = found["alpha"].times(0.5)
    return found | _index(grid, at, v)


def _enclosing(value: float, low: float | None, high: float | None, by: str = "") -> Estimate:
    return Estimate(value, low and min(low, value), high and max(high, value), by)


def _length(grid: Posterior, at: Mapping[str, float]) -> Estimate:
    """The correlation length, sigma over slope."""
    ln_tau = (grid.axes[0][:, None] - grid.axes[1][None, :]).ravel()
    order = np.argsort(ln_tau)
    passed = np.cumsum(grid.weights.ravel()[order])
    low, high = (float(np.exp(np.interp(share, passed, ln_tau[order]))) for share in (LOW, HIGH))
    (low_height, high_height), (low_slope, high_slope) = grid.open_ends(0), grid.open_ends(1)
    return _enclosing(
        at["sigma"] / at["slope"],
        None if low_height or high_slope else low,
        None if high_height or low_slope else high,
    )


def _index(grid: Posterior, at: Mapping[str, float], v: np.ndarray) -> dict[str, Estimate]:
    """The index, where gloss readings bear on it: what they leave at each surface, and how it differs between them."""
    evidence = grid.evidence
    readings = [each.key for each in evidence.observations if each.quantity == "gloss"]
    if (evidence.base and not evidence.coated) or not readings:
        return {}
    mean = float(np.sum(grid.weights * grid.nuisances[0]))
    between = float(np.sum(grid.weights * (grid.nuisances[0] - mean) ** 2))
    spread = sqrt(between + index_left(evidence, _shares(grid.family, evidence, at), v))
    value, low, high = (float(index_at(evidence, each)) for each in (v[0], mean - 1.96 * spread, mean + 1.96 * spread))
    return {"n": _enclosing(value, low, high, readings[0] if spread < 0.7 else "")}


def _decider(family: Family, evidence: Evidence, place: int) -> str:
    """The observation without which the number would be least known; "" where none makes much of a difference."""
    whole, widest = coarse(family, evidence).spread(place), ("", DECIDES)
    for key in _keys(evidence):
        wider = coarse(family, evidence.without(key)).spread(place) / whole
        if wider > widest[1]:
            widest = key, wider
    return widest[0]
