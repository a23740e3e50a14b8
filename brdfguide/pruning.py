"""The cheapest model, and the fewest parts of it, that a scene cannot tell from the whole.

    every cut of the model → amplitudes refitted → JND over the picture, and its measured time
    pick   = the cheapest within the tolerance, whose saving can be measured
    check  = the same picture drawn afresh, and with every angle 10 % smaller and larger

What may differ is said by the scene; what was assumed where it is silent is `scene.DEFAULT`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from . import costs, quadrature, reach
from .costs import NO_TIME, Saving, Time
from .errors import NoAnswer
from .geometry import Geometry
from .measurement import Finding
from .models._base import Sum
from .parts import MIRROR, NOTHING, Cut, Part, Parts
from .picture import Errors, Picture, lobe_width
from .scene import Scene

FIRST_PIXELS, MOST_PIXELS = 1500, 12000
MOST_WORK = 4e8  # additions to judge all ways to keep all terms once: some half second
MOST_CUTS = 256  # tried one by one; with more, parts are left out greedily
RGB_UM = (0.61, 0.55, 0.46)  # dominant wavelengths of red, green and blue
FRESH_FACTOR = 1.5  # how far the worst pixel of a picture drawn afresh may lie above the tolerance
STRAY = (0.9, 1.1)
NEAR_MISS = 8.0  # times the tolerance: worth refitting the shapes too


@dataclass(frozen=True)
class Single:
    """One part left out alone, the rest refitted."""

    part: Part
    errors: Errors
    saving: Saving  # per direction
    left_out: bool
    screen: float | None = None  # closed-form upper bound [JND]


@dataclass(frozen=True, eq=False)
class Candidate:
    """A cut with its picture's errors and its cost."""

    cut: Cut
    errors: Errors
    work: float  # operations per direction, in additions: the same in every run, so it decides which is cheaper
    factors: Mapping
    time: Time = NO_TIME  # measured for those that are shown


@dataclass(frozen=True, eq=False)
class Pruned:
    """What is left, what that costs and what it saves."""

    scene: Scene
    whole: Sum
    whole_values: Mapping
    sum: Sum
    values: Mapping  # of `sum`, refitted over the scene
    cut: Cut
    errors: Errors
    fresh: Errors  # on other pixels of the same scene
    moved: tuple[Errors, ...]  # with every angle 10 % smaller, and larger
    whole_time: Time
    time: Time
    operations: tuple[Mapping, Mapping]  # of the whole and of what is left
    singles: tuple[Single, ...]
    pareto: tuple[Candidate, ...]  # cheapest first
    box_deg: Mapping[str, tuple[float, float]]
    pixels: int
    convergence: float  # change of the deciding numbers [JND] when the pixels were doubled
    skipped: int  # pixels too dark to compare
    seed: int
    findings: tuple[Finding, ...]

    @property
    def saving(self) -> Saving:
        return self.whole_time.over(self.time)


def prune(
    sum_: Sum,
    values: Mapping,
    scene: Scene,
    geom_of_data: Geometry | None = None,
    seed: int = 0,
    wavelength=None,
    progress: Callable[[str], None] = lambda text: None,
) -> Pruned:
    """The least of `sum_` that `scene` needs.

    Takes  values of the sum's parameters, scalars or (channels,); wavelength [µm] (channels,), by default the data's;
    geom_of_data, the directions that the values were fitted to, only to say where the scene goes beyond them.
    Gives  Pruned.    Raises NoAnswer if the scene shows no lit surface.
    """
    parts = Parts(sum_, values, _wavelengths(values, wavelength, geom_of_data))
    width = lobe_width(sum_, values, parts.wavelength)
    draw = lambda scene_, size, seed_: _picture(parts, scene_, size, seed_, width)  # noqa: E731
    progress("drawing the scene")
    picture, singles, convergence = _converged(draw, scene, seed)
    progress("leaving parts out")
    works = _works(picture)
    candidates = _candidates(picture, works)
    progress("checking on fresh directions")
    pick, fresh, moved, refused = _picked(picture, candidates, draw, scene, seed)
    progress("timing what is left")
    pruned, kept = parts.pruned(pick.cut), picture.values(pick.cut, pick.factors)
    laws = _law(sum_, parts.values), _law(pruned, kept)
    whole_time, time = costs.compare(*laws, _rows(picture)) if pick.cut.out else (costs.times({"": laws[0]}, _rows(picture))[""],) * 2
    front = _front(candidates.values())
    way_times = _way_times(picture, [NOTHING, *(NOTHING.without(part) for part in singles), *(each.cut for each in front)])
    front = tuple(replace(each, time=_cut_time(parts, way_times, each.cut)) for each in front)
    findings = (
        *refused, *reach.at_bounds(pruned, kept), *reach.strays(scene, moved), *reach.beyond_data(picture.quadrature, geom_of_data),
        *_over_budget(scene, time, front),
    )  # fmt: skip
    return Pruned(
        scene, sum_, dict(values), pruned, kept, pick.cut, pick.errors, fresh, moved, whole_time, time,
        tuple(costs.operations(law, _rows(picture)[:256]) for law in laws),
        tuple(Single(part, errors, _saving(way_times, part), _is_out(part, pick.cut)) for part, errors in singles.items()),
        front, picture.quadrature.box(), len(picture.quadrature), convergence, int(np.sum(picture.weights == 0)), seed, findings,
    )  # fmt: skip


def _wavelengths(values: Mapping, wavelength, geom_of_data) -> np.ndarray:
    """One for each channel [µm]; three channels without any are red, green and blue."""
    shapes = [np.shape(np.atleast_1d(value)) for value in values.values()]
    if wavelength is None:
        wavelength = RGB_UM if geom_of_data is None and (3,) in shapes else 0.55 if geom_of_data is None else geom_of_data.wavelength
    return np.array(np.broadcast_to(np.asarray(wavelength, float), np.broadcast_shapes(np.shape(np.atleast_1d(wavelength)), *shapes)))


def _picture(parts: Parts, scene: Scene, size: int, seed: int, width: float) -> Picture:
    drawn = quadrature.draw(scene, size, seed, width)
    if not len(drawn):
        raise NoAnswer(f"{scene.name}: no surface is both lit and seen; widen the camera's or the lights' angles")
    picture = Picture(parts, drawn.at(parts.wavelength))
    if not picture.weights.any():
        raise NoAnswer(f"{scene.name}: the model is black wherever the scene looks")
    return picture


def _converged(draw, scene: Scene, seed: int):
    """The picture with enough pixels: doubling them no longer changes what decides by a quarter of the tolerance."""
    least = 0.25 * max(min(scene.tolerance.worst, scene.tolerance.p95), 0.04)
    most = 4 * max(scene.tolerance.worst, 0.25)  # beyond, an error decides nothing by its size
    size, before = FIRST_PIXELS, None
    while True:
        picture = draw(scene, size, seed)
        singles = _singles(picture)
        now = np.array([min(value, most) for errors in singles.values() for value in (errors.visible, errors.p95)])
        change = np.inf if before is None else float(np.max(np.abs(now - before), initial=0.0))
        if scene.pairs or change < least or size * 2 > MOST_PIXELS or 2 * len(_rows(picture)) * sum(_works(picture).values()) > MOST_WORK:
            return picture, singles, 0.0 if scene.pairs else change
        size, before = size * 2, now


def _singles(picture: Picture) -> dict[Part, Errors]:
    """Each part left out alone."""
    cuts = {part: NOTHING.without(part) for part in picture.parts.all()}
    return {part: picture.cut_errors(cut, picture.refitted(cut)) for part, cut in cuts.items() if picture.parts.provided(cut)}


# --- time -------------------------------------------------------------------------------------------


def _rows(picture: Picture) -> Geometry:
    return picture.quadrature.lit[0]


def _law(sum_: Sum, values: Mapping):
    """The whole of a sum as one law of the geometry: what a renderer would call."""
    if not sum_.has_mirror:
        return lambda geom: sum_(geom, values)
    return lambda geom: (sum_(geom, values), sum_.mirror(geom, values))


def _way_law(picture: Picture, label: str, way: frozenset[str]):
    """One term kept one way, as a law."""
    term = next(term for term in picture.parts.sum.terms if term.label == label)
    alone = Sum(term.model.name, (replace(term, model=picture.parts.model(term, way)),))
    return _law(alone, {f"{label}.{name}": value for name, value in picture.parts.of(term).items()})


def _works(picture: Picture) -> dict:
    """Operations of every way to keep every term."""
    ways = [(term.label, way) for term in picture.parts.sum.terms for way in picture.parts.ways(term)]
    return {each: costs.work(costs.operations(_way_law(picture, *each), _rows(picture)[:256])) for each in ways}


def _way_times(picture: Picture, cuts) -> dict:
    """Time of the ways that occur in `cuts`, and of each mirror part by itself."""
    ways = {(term.label, cut.way(term.label)) for cut in cuts for term in picture.parts.sum.terms if cut.keeps(term.label)}
    laws = {way: _way_law(picture, *way) for way in sorted(ways, key=str)}
    for term in picture.parts.sum.terms:
        if term.model.mirror is not None:
            laws[term.label, MIRROR] = partial(term.model.mirror, **picture.parts.of(term))
    return costs.times(laws, _rows(picture))


def _cut_time(parts: Parts, way_times: Mapping, cut: Cut) -> Time:
    return sum((way_times[term.label, cut.way(term.label)] for term in parts.sum.terms if cut.keeps(term.label)), NO_TIME)


def _saving(way_times: Mapping, part: Part) -> Saving:
    """What leaving out one part alone saves: the time of its term, or a difference of two ways to keep it."""
    if part.feature == MIRROR:
        return way_times[part.label, MIRROR].over(NO_TIME)
    left = way_times[part.label, frozenset({part.feature})] if part.feature else NO_TIME
    return way_times[part.label, frozenset()].over(left)


# --- search -----------------------------------------------------------------------------------------


def _candidates(picture: Picture, works: Mapping) -> dict[Cut, Candidate]:
    """All cuts judged; where there are too many, those on the way down from the whole."""

    def judged(cut: Cut) -> Candidate:
        factors = picture.refitted(cut)
        kept = [term.label for term in picture.parts.sum.terms if cut.keeps(term.label)]
        work = sum(works[label, cut.way(label)] for label in kept) + len(kept) - 1
        return Candidate(cut, picture.cut_errors(cut, factors), work, factors)

    every = picture.parts.cuts()
    if len(every) <= MOST_CUTS:
        return {cut: judged(cut) for cut in every}
    found = {NOTHING: judged(NOTHING)}
    here = NOTHING
    while True:
        ways = [here.without(part) for part in picture.parts.all() if not _is_out(part, here)]
        swaps = [way.restoring(part) for way in ways for part in here.out]
        tried = [found.setdefault(cut, judged(cut)) for cut in {*ways, *swaps} - found.keys() if picture.parts.provided(cut)]
        good = [each for each in tried if each.errors.within(picture.quadrature.scene.tolerance) and each.work < found[here].work]
        if not good:
            return found
        here = min(good, key=lambda each: each.work).cut


def _picked(picture: Picture, candidates: Mapping, draw, scene: Scene, seed: int):
    """The cheapest candidate within the tolerance that stands the checks, its errors there, and what was refused on the way."""
    within = sorted((each for each in candidates.values() if each.errors.within(scene.tolerance)), key=lambda each: each.work)
    checks, seen = None, set()
    refused: tuple[Finding, ...] = ()
    for each in within:
        each = _worth_it(picture, each, candidates)
        if not each.cut.out:
            break
        if each.cut in seen:
            continue
        seen.add(each.cut)
        if checks is None:
            size = len(picture.weights)
            checks = [draw(scene, size, seed + 1), *(draw(scene.scaled(factor), size, seed) for factor in STRAY)]
        fresh, *moved = (check.cut_errors(each.cut, each.factors) for check in checks)
        if not fresh.within(scene.tolerance, FRESH_FACTOR):
            why = f"{fresh.visible:.2g} JND at worst on fresh directions"
        elif scene.camera_moves and not all(errors.within(scene.tolerance) for errors in moved):
            why = f"{max(errors.visible for errors in moved):.2g} JND at worst with the angles 10 % off, and the camera moves"
        else:
            return each, fresh, tuple(moved), refused
        if len(refused) < 3:
            refused += (Finding("pruned-refused", f"without {each.cut} would do on the drawn directions, but not when checked: {why}"),)
    whole = candidates[NOTHING]
    return whole, whole.errors, (whole.errors,) * len(STRAY), refused


def _worth_it(picture: Picture, pick: Candidate, candidates: Mapping) -> Candidate:
    """The pick with every part back whose absence saves no time that can be measured."""
    for part in sorted(pick.cut.out, reverse=True):
        fuller = candidates.get(pick.cut.restoring(part))
        if fuller is None or not fuller.errors.within(picture.quadrature.scene.tolerance):
            continue
        laws = (_law(picture.parts.pruned(each.cut), picture.values(each.cut, each.factors)) for each in (fuller, pick))
        longer, shorter = costs.compare(*laws, _rows(picture))
        if not longer.over(shorter).measurable:
            return _worth_it(picture, fuller, candidates)
    return pick


def _is_out(part: Part, cut: Cut) -> bool:
    return part in cut.out or not cut.keeps(part.label)


def _front(candidates) -> tuple[Candidate, ...]:
    """Those that no other beats in both cost and worst visible error, cheapest first."""
    front: list[Candidate] = []
    for each in sorted(candidates, key=lambda each: (each.work, each.errors.visible)):
        if not front or each.errors.visible < 0.9 * front[-1].errors.visible - 1e-9 or (not each.cut.out and front[-1].cut.out):
            front.append(each)
        if not each.cut.out or each.errors.visible < 1e-9:
            break
    return tuple(front)


def _over_budget(scene: Scene, time: Time, front) -> tuple[Finding, ...]:
    """What the budget would buy, where the pick costs more."""
    if scene.budget_ns is None or time.ns <= scene.budget_ns:
        return ()
    cheap = min((each for each in front if each.time.ns <= scene.budget_ns), key=lambda each: each.errors.visible, default=None)
    says = f"without {cheap.cut} it would, and differ by {cheap.errors.visible:.2g} JND at worst" if cheap else "no part of the model does"
    return (Finding("over-budget", f"{time.ns:.0f} ns per evaluation do not fit the budget of {scene.budget_ns:g}; {says}", "warning"),)
