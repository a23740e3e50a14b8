"""Which directions to measure so that a law fitted to them is right everywhere, or that tell laws apart.

A law that is not quite right, fitted to a few directions, follows what it misses there. Its error over all directions
is then larger than that of a fit to all of them by

    error² = error_all² (1 + E),   E = mean over laws of |∫ J̃ δ dw - mean_S J̃ δ|²

with J̃ the derivatives of ln f by the law's parameters, orthonormal under the measure w of all directions, and δ what
the law misses: smooth in the tilt of the half vector, the angle from it to the light and toward grazing, and by
another part that changes within degrees. E is formed over every such δ at once as a kernel, and small where the
directions stand for w in every J̃ δ (`numerics.herding`). Nothing of it is fitted to any table; the widths of the
kernel are ours. Where a file says how the directions lie, how quickly δ changes is what is left unknown, and in the
plane of incidence the rest lies far off: there the kernel is the mean over lengths from half to twice these.
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from ..data import subsample
from ..data.measurement import Measurement
from ..errors import InputError
from ..numerics.gaussian_process import gaussian_kernel
from ..numerics.herding import Groups, representatives
from ..physics.aperture import Instrument
from ..physics.geometry import Geometry
from ..records import dataclass
from .cross_validation import thinned
from .goniometer import Goniometer
from .hypotheses import Hypothesis
from .ln_slopes import ln_with_slopes
from .lobe_bands import MIRROR_DEG, lobe_bands, lobe_rows, tilts_deg
from .next_measurement import difference_at, knowledge, reachable
from .ranked import Ranking

TILT = 0.1  # tan of the half vector's tilt up to which what is missed changes with the tilt, beyond with its logarithm
WIDTHS = (1.2, 50.0, 50.0)  # of the kernel: asinh(tan tilt/TILT), angle from light to half vector, to grazing [deg]
LENGTHS = (0.5, 1.0, 2.0)  # times these widths, alike probable among a file's directions and in the plane (ours)
ROUGH = 1.0  # variance of what changes within degrees over that of what does not
ROUGH_DEG = 5.0  # within so many
SQUARES = 0.5  # how much it counts that the derivatives' own products are right
LEAST = 1e-6  # of the largest strength, of a combination of parameters
APART_DEG = 3.0  # between two directions of a plan
SEES_MIRROR = 16  # directions from which one is the mirror's, unless a file offers them: narrow lobes are seen there
BLOCK = 8  # directions after which one may stop, and plan again
MOST_OFFERED = 1500  # directions to choose from
MOST_MEASURED = 400  # directions of earlier data that count
PURPOSES = ("error", "tell", "pin")


@dataclass(frozen=True, eq=False)
class PlannedBlock:
    """Directions to measure together, and what is expected before and after them."""

    geom: Geometry
    scans: tuple[tuple[float, float], ...]  # incidence and plane [deg]; none: single directions
    before: float | None  # None: nothing is known yet
    after: float
    seconds: float


@dataclass(frozen=True, eq=False)
class MeasurementPlan:
    """What to measure, in order, and what for."""

    purpose: str
    subject: tuple[str, ...]  # the two models, or the parameter
    blocks: tuple[PlannedBlock, ...]
    measured: int  # directions that were there before

    @property
    def geom(self) -> Geometry:
        """All directions in order, rows of one column."""
        return joined_rows([each.geom for each in self.blocks])

    @property
    def seconds(self) -> float:
        return sum(each.seconds for each in self.blocks)


def joined_rows(parts: Iterable[Geometry]) -> Geometry:
    """The directions of several geometries, one after another."""
    angles = [
        np.concatenate([each.theta_i_deg, each.phi_i_deg, each.theta_r_deg, each.phi_i_deg + each.phi_deg], axis=1)
        for each in parts
    ]
    every = np.concatenate(angles)
    return Geometry.from_degrees(*(column[:, None] for column in every.T))


@dataclass(frozen=True, eq=False)
class Everywhere:
    """Directions that a law must be right at, their weights, and how wrong it may be after others were measured."""

    geom: Geometry
    weights: np.ndarray  # 0 for those that may be measured, and count nothing
    hypotheses: tuple[Hypothesis, ...]
    solid_angle: float | None = None
    lengths: tuple[float, ...] = (1.0,)  # times WIDTHS, alike probable

    @cached_property
    def _tangents(self) -> tuple[np.ndarray, np.ndarray]:
        """Mean over the laws of J̃ J̃ᵀ between directions, and of its square."""
        size = len(self.weights)
        products, squares = np.zeros((size, size)), np.zeros((size, size))
        for each in self.hypotheses:
            jacobian = self._jacobian(each)
            strength, vectors = np.linalg.eigh(jacobian.T @ (self.weights[:, None] * jacobian))
            upright = jacobian @ vectors / np.sqrt(np.maximum(strength, LEAST * max(strength[-1], 1e-300)))
            product = upright @ upright.T
            products += product
            squares += product * product
        return products / len(self.hypotheses), squares / len(self.hypotheses)

    def _jacobian(self, hypothesis: Hypothesis) -> np.ndarray:
        """∂ ln f/∂u, (directions, parameters)."""
        there = Instrument(self.geom, self.solid_angle)
        return ln_with_slopes(hypothesis.layout, hypothesis.surface, there)[1][:, 0]

    @cached_property
    def _alike(self) -> np.ndarray:
        """How alike what a law misses is between directions."""
        geom = self.geom
        difference = np.degrees(np.arccos(np.minimum(geom.cos_d, 1.0)))
        grazing = np.maximum(geom.theta_i_deg, geom.theta_r_deg)
        tilt = np.arcsinh(np.sqrt(geom.tan2_h) / TILT)
        place = np.concatenate([tilt, difference, grazing], axis=1) / np.array(WIDTHS)
        near = _vectors(geom) / np.radians(ROUGH_DEG)
        smooth = sum(gaussian_kernel(place / each, place / each) for each in self.lengths) / len(self.lengths)
        return smooth + ROUGH * gaussian_kernel(near, near)

    def groups(self, numbers: list[np.ndarray], squares: bool) -> Groups:
        """Groups of its directions, by what their union would miss."""
        products, of_squares = self._tangents
        kernel = products * self._alike + (SQUARES * of_squares if squares else 0.0)
        return Groups.of_points(kernel, self.weights, numbers)


def _vectors(geom: Geometry) -> np.ndarray:
    """(directions, 5): light in the plane y = 0 and detector on one side of it, so that distances are angles."""
    turn = np.radians(geom.phi_deg)
    parts = (geom.sin_i, geom.cos_i, geom.sin_r * np.cos(turn), geom.sin_r * np.abs(np.sin(turn)), geom.cos_r)
    return np.concatenate(parts, axis=1)


def plan_everywhere(
    target: tuple[Geometry, np.ndarray],
    reach: Goniometer,
    hypotheses: tuple[Hypothesis, ...],
    budget: int,
    *,
    scans: bool = False,
    among: Geometry | None = None,
    measured: Geometry | None = None,
) -> MeasurementPlan:
    """Directions, or whole scans, after which a law is expected to be right over the target.

    Takes  target, directions and weights that add up to 1; among, the directions to choose from in place of the
    target's; measured, those that are there already.    Raises InputError where the instrument reaches too few.
    """
    offered = reach.scans() if scans else []
    parts = [target[0], *([among] if among is not None else []), *(each[2] for each in offered)]
    parts += [measured] if measured is not None else []
    starts = np.cumsum([0, *map(len, parts)])
    everywhere = Everywhere(
        joined_rows(parts),
        np.r_[target[1], np.zeros(starts[-1] - starts[1])],
        hypotheses,
        reach.solid_angle,
        LENGTHS if among is not None or reach.in_plane else (1.0,),
    )
    choice = _choice(everywhere.geom, reach, starts, scans, among is not None, len(offered))
    fixed = [np.arange(starts[-2], starts[-1])] if measured is not None else []
    if len(choice) < budget:
        raise InputError(
            f"the instrument reaches {len(choice)} {'scans' if scans else 'directions'} of those that are offered; "
            f"wanted at least the {budget} of the budget"
        )
    numbers = [*choice, *fixed]
    there = list(range(len(choice), len(numbers)))
    allowed = np.arange(len(numbers)) < len(choice)
    near = _too_near(everywhere.geom, numbers)
    one_of = None if scans or among is not None else _mirror(everywhere.geom, numbers, allowed, budget)
    groups = everywhere.groups(numbers, squares=True)

    def pick(count: int, free) -> list[int]:
        return representatives(groups, count, free, near, there, one_of)

    of_file = among is not None and not scans
    picked, beside = _with_lobe(everywhere.geom, numbers, allowed, budget, pick, of_file)
    blocks = _planned_blocks(everywhere, reach, numbers, picked, there, beside=beside, scans=offered)
    return MeasurementPlan("error", (), blocks, 0 if measured is None else len(measured))


def plan_of(
    geom: Geometry,
    target: tuple[Geometry, np.ndarray],
    reach: Goniometer,
    hypotheses: tuple[Hypothesis, ...],
    measured: Geometry | None = None,
) -> MeasurementPlan:
    """The plan that takes these directions in their order, beside those that are there, and what is expected of them.

    Raises InputError where the instrument does not reach one.
    """
    beyond = np.count_nonzero(~reach.reaches(geom))
    if beyond:
        raise InputError(f"{beyond} of the directions are beyond the instrument's reach; wanted none")
    before = [] if measured is None else [measured]
    every = joined_rows([target[0], geom, *before])
    weights = np.r_[target[1], np.zeros(len(every) - len(target[1]))]
    lengths = LENGTHS if reach.in_plane else (1.0,)
    everywhere = Everywhere(every, weights, hypotheses, reach.solid_angle, lengths)
    ends = len(target[1]), len(target[1]) + len(geom)
    numbers = [np.array([row]) for row in range(*ends)] + [np.arange(ends[1], len(every)) for _ in before]
    there = [len(geom)] if before else []
    blocks = _planned_blocks(everywhere, reach, numbers, list(range(len(geom))), there)
    return MeasurementPlan("error", (), blocks, 0 if measured is None else len(measured))


def _planned_blocks(
    everywhere: Everywhere,
    reach: Goniometer,
    numbers: list[np.ndarray],
    picked: list[int],
    there: list[int],
    *,
    beside: Collection[int] = (),
    scans: Sequence = (),
) -> tuple[PlannedBlock, ...]:
    """What is picked, scan by scan or in blocks, with the error expected before and after each; those `beside` the mean
    do not count in it."""
    told = everywhere.groups(numbers, squares=False)

    def expected(some: list[int]) -> float | None:
        some = [each for each in some if each not in beside]
        return float(np.sqrt(1 + max(told.distance(some), 0.0) / (1 + ROUGH))) if some else None

    blocks, size = [], 1 if scans else BLOCK
    for start in range(0, len(picked), size):
        chosen = picked[start : start + size]
        geom = everywhere.geom[np.concatenate([numbers[each] for each in chosen])]
        geom = geom if scans else geom[in_order(geom)]
        before, now = expected([*there, *picked[:start]]), expected([*there, *picked[: start + len(chosen)]])
        named = tuple(scans[each][:2] for each in chosen) if scans else ()
        blocks.append(PlannedBlock(geom, named, before, now or 1.0, reach.seconds(geom)))
    return tuple(blocks)


def _choice(geom, reach: Goniometer, starts, scans: bool, among: bool, count: int) -> list[np.ndarray]:
    """Row numbers of what may be measured: scans, or directions one by one, each once."""
    if scans:
        first = 2 if among else 1
        return [np.arange(starts[first + place], starts[first + place + 1]) for place in range(count)]
    rows = np.arange(starts[1], starts[2]) if among else np.arange(starts[1])
    angles = np.round(np.concatenate([geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg], axis=1)[rows], 3)
    once = np.sort(np.unique(angles, axis=0, return_index=True)[1])
    return [np.array([row]) for row in rows[once] if reach.reaches(geom[[row]])[0]]


def _with_lobe(
    geom: Geometry, numbers: list[np.ndarray], allowed, budget: int, pick, of_file: bool
) -> tuple[list[int], list[int]]:
    """What `pick` (how many, of which) takes and, last and by themselves, single directions of a file from which a
    narrow lobe is seen, where the former do not see it: no mean over all directions is to be made right by them."""
    single, beside = np.flatnonzero(allowed), list[int]()
    measured = [each for each, free in zip(numbers, allowed, strict=True) if not free]
    offered = geom[np.array([numbers[each][0] for each in single])]
    wanted = lobe_bands(offered, budget + sum(map(len, measured))) if of_file else []
    while True:
        picked = pick(budget - len(beside), allowed & ~np.isin(np.arange(len(allowed)), beside))
        if not wanted or len(beside) == budget:
            return [*picked, *beside], beside
        seen = geom[np.concatenate([*measured, *(numbers[each] for each in (*picked, *beside))])]
        missing = [int(single[each.best]) for each in wanted if not each.holds(seen)]
        if not missing:
            return [*picked, *beside], beside
        beside = [*beside, *missing][:budget]


def _mirror(geom: Geometry, numbers: list[np.ndarray], allowed, budget: int) -> np.ndarray | None:
    """(groups,): those allowed that are nearest to the mirror direction; None where none of these is needed, for few
    directions or beside one that is measured."""
    tilt = tilts_deg(geom)
    least = np.array([tilt[rows].min() for rows in numbers])
    highest = least[allowed].min() + MIRROR_DEG
    count = budget + sum(len(rows) for rows, free in zip(numbers, allowed, strict=True) if not free)
    if count < SEES_MIRROR or np.any(least[~allowed] <= highest):
        return None
    return allowed & (least <= highest)


def _too_near(geom: Geometry, numbers: list[np.ndarray]) -> np.ndarray:
    """(groups, groups): the same, or single directions within `APART_DEG` of each other."""
    near = np.eye(len(numbers), dtype=bool)
    single = np.array([place for place, rows in enumerate(numbers) if len(rows) == 1], int)
    vectors = _vectors(geom[np.array([numbers[place][0] for place in single], int)])
    squares = np.sum((vectors[:, None] - vectors) ** 2, axis=2)
    near[np.ix_(single, single)] |= squares < np.radians(APART_DEG) ** 2
    return near


def in_order(geom: Geometry) -> np.ndarray:
    """Row numbers by incidence, plane and detector: few moves."""
    return np.lexsort((geom.signed_theta_r_deg[:, 0], geom.phi_deg[:, 0], geom.theta_i_deg[:, 0]))


def measured_part(measurement: Measurement) -> Geometry:
    """The directions with a value; of many those that stand for all."""
    geom = measurement.geom[measurement.has_value]
    every = -(-len(geom) // MOST_MEASURED)
    return geom[in_order(geom)[::every]].at(np.atleast_1d(geom.wavelength)[:1])


def plan_to_tell(ranking: Ranking, measurement: Measurement, reach: Goniometer, budget: int) -> MeasurementPlan:
    """Directions at which the tied pair of laws that is told apart worst differs most, one after another: what
    `fit --next` names is the first.

    Expected is by how many noises of one value that pair differs in all. Raises InputError where no two laws tie.
    """
    from_fits = [row.fit for row in ranking.rows if row.tied]
    if len(from_fits) < 2:
        raise InputError(
            "no two models tie after these data: there is nothing to tell apart; plan to pin, or for error"
        )
    there = Instrument(reachable(measurement), measurement.solid_angle)
    there = replace(there, geom=there.geom[reach.reaches(there.geom)])
    noise = max(ranking.noise, 1e-4)
    pairs = [(a, b) for place, a in enumerate(from_fits) for b in from_fits[place + 1 :]]
    squares = np.array([(difference_at(a, b, there) / noise) ** 2 for a, b in pairs])
    first = int(np.argmax(squares.max(axis=1)))
    total, picked = np.zeros(len(pairs)), list[int]()
    for number in range(min(budget, len(there.geom))):
        pair = first if number == 0 else int(np.argmin(total + squares.max(axis=1) * 1e-9))
        gain = squares[pair].copy()
        gain[picked] = -1.0
        picked.append(int(np.argmax(gain)))
        total = total + squares[:, picked[-1]]
    worst = int(np.argmin(total))
    gains = np.sqrt(np.r_[0.0, np.cumsum(squares[worst, picked])])
    subject = (pairs[worst][0].name, pairs[worst][1].name)
    return _in_blocks("tell", subject, there.geom, picked, gains, measurement, reach)


def plan_to_pin(ranking: Ranking, measurement: Measurement, reach: Goniometer, budget: int) -> MeasurementPlan:
    """Directions after which the recommended model's loosest parameter is known best, one after another.

    Expected is its standard error over that of today.
    """
    there = Instrument(reachable(measurement), measurement.solid_angle)
    there = replace(there, geom=there.geom[reach.reaches(there.geom)])
    known = knowledge(ranking.recommended.fit, thinned(measurement), there)
    place, subject = known.place, (known.loosest,)
    today, picked, gains = known.covariance[place, place], list[int](), [1.0]
    size = np.where(np.arange(len(known.size)) == place, 1e-12, known.size)  # the same one to the end
    known = replace(known, size=size)
    for _ in range(min(budget, len(there.geom))):
        left = known.left_by_each()
        left[picked] = np.inf
        picked.append(int(np.argmin(left)))
        known = known.with_values([picked[-1]])
        gains.append(float(np.sqrt(known.covariance[place, place] / today)))
    return _in_blocks("pin", subject, there.geom, picked, np.array(gains), measurement, reach)


def _in_blocks(purpose, subject, geom, picked, gains, measurement, reach: Goniometer) -> MeasurementPlan:
    blocks = []
    for start in range(0, len(picked), BLOCK):
        rows = picked[start : start + BLOCK]
        part = geom[rows]
        part = part[in_order(part)]
        ends = float(gains[start]), float(gains[start + len(rows)])
        blocks.append(PlannedBlock(part, (), ends[0], ends[1], reach.seconds(part)))
    return MeasurementPlan(purpose, subject, tuple(blocks), int(np.count_nonzero(measurement.has_value)))


def some_directions(measurement: Measurement) -> Geometry:
    """The directions of a measurement; of a large table those that stand for all, and the few of its highlight that a
    plan takes."""
    part = subsample.representative_rows(measurement, MOST_OFFERED)
    part = np.union1d(part, np.array(lobe_rows(measurement.geom), int))
    geom = measurement.geom[part]
    return geom.at(np.atleast_1d(geom.wavelength)[:1])


def evenly(geom: Geometry, theta_max_deg: float) -> tuple[Geometry, np.ndarray]:
    """Directions up to an angle and weights, alike, that add up to 1. Raises InputError where there are none."""
    kept = np.max(np.concatenate([geom.theta_i_deg, geom.theta_r_deg], axis=1), axis=1) <= theta_max_deg
    if not kept.any():
        raise InputError(f"--among: no direction lies within {theta_max_deg:g} degrees of the normal")
    return geom[kept], np.full(np.count_nonzero(kept), 1 / np.count_nonzero(kept))
