"""The cheapest model, and the fewest parts of it, that a scene cannot tell from the whole.

    every ablation of the model → amplitudes refitted → JND over the picture, and its measured time
    pick   = the cheapest within the tolerance, whose saving can be measured
    check  = the same picture sampled afresh, until one sample reproduces the next; and with every angle 10 % smaller
    and larger

What may differ is said by the scene; what was assumed where it is silent is `scene.DEFAULT`.
"""

from collections.abc import Callable, Mapping
from dataclasses import field, replace
from functools import cached_property, lru_cache, partial

import numpy as np

from ..errors import NoAnswer
from ..finding import Finding
from ..models import cost
from ..models.cost import Saving, Time
from ..models.looks import seen_difference, turns
from ..models.surface import Surface
from ..physics.geometry import Geometry
from ..records import dataclass
from . import bounds as analytic
from . import radiance, search, validity
from .difference import Errors, Picture, lobe_width
from .features import NOTHING, Ablation, Feature, Features
from .scene import Scene
from .search import Candidate

FIRST_PIXELS = 750  # drawn; then twice as many, until nothing changes
ENOUGH_PIXELS = 3000  # from which nothing need change any more
MOST_PIXELS = 8000
MOST_WORK = 3e8  # additions to judge all variants of all terms once: some half second
MOST_SAMPLES = 4  # fresh samples of a picture, until one reproduces the next
MOST_MORE = 8  # their pixels, times those searched with
MOST_SURROUNDED = 8000  # pixels for which surroundings are looked up in all directions
MOST_REFUSED = 3  # named
PERTURBED = (0.9, 1.1)


@dataclass(frozen=True)
class Single:
    """One part left out alone, the rest refitted."""

    feature: Feature
    errors: Errors
    saving: Saving  # per direction
    left_out: bool
    bound: float | None = None  # closed-form upper bound [JND]


@dataclass(frozen=True, eq=False)
class Pruned:
    """What is left, what that costs and what it saves."""

    scene: Scene
    whole: Surface
    surface: Surface  # what is left, refitted over the scene
    ablation: Ablation  # what was left out
    substitute: bool  # whether another law takes the place of the lobes
    errors: Errors
    fresh: Errors  # on other pixels of the same scene
    moved: Mapping[float, Errors]  # with every angle times this, where there is light then
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
    findings: tuple[Finding, ...] = ()

    @cached_property
    def seen(self) -> float:
        """S [L*] between the whole and what is left, on a sphere under lamps all around."""
        return seen_difference(self.whole, self.surface)

    @property
    def saving(self) -> Saving:
        return self.whole_time.over(self.time)


def prune(
    surface: Surface,
    scene: Scene,
    geom_of_data: Geometry | None = None,
    seed: int = 0,
    progress: Callable[[str], None] = lambda text: None,
    substitutes: bool = True,
    timing: bool = True,
) -> Pruned:
    """The least of `surface` that `scene` needs.

    Takes  geom_of_data, the directions that the values were fitted to, only to say where the scene goes beyond them;
    substitutes, whether a simpler law may take the place of the lobes; timing, whether times decide what is worth
    leaving out, or operations alone, so that two runs give the same.
    Gives  Pruned.    Raises NoAnswer if the scene shows no lit surface.
    """
    features, width = Features(surface), lobe_width(surface)

    def sample(scene_, size, seed_):
        return _picture(features, scene_, size, seed_, width)

    clock = cost.times if timing else cost.counted
    progress("drawing the scene")
    picture, singles, convergence = _converged(sample, scene, seed)
    progress("leaving parts out")
    ablations = search.ablations(picture)
    checks = _Checks(picture, ablations, sample, seed, clock)
    pick, fresh, moved, candidates = _picked(checks, substitutes, progress)
    # of one that stands with other shapes it is not said that it does not
    refused = tuple(each for each in checks.refused if not each.text.startswith(f"{pick} would"))[:MOST_REFUSED]
    progress("timing what is left")
    evaluators = search.evaluator(ablations[NOTHING].surface), search.evaluator(pick.surface)
    rows = search.cost_directions(picture)
    others = [each for each in candidates if each.surface is not pick.surface]
    savings, front = search.timed(picture, singles, search.pareto_front([*others, pick]), clock)
    operations = partial(cost.operations, geom=search.counted_directions(picture))
    times = (clock({"": evaluators[0]}, rows)[""],) * 2 if pick.whole else cost.compare_times(*evaluators, rows, clock)
    found = Pruned(
        scene=scene,
        whole=surface,
        surface=pick.surface,
        ablation=pick.ablation,
        substitute=pick.substitute,
        errors=pick.errors,
        fresh=fresh,
        moved=moved,
        whole_time=times[0],
        time=times[1],
        operations=(operations(evaluators[0]), operations(evaluators[1])),
        singles=_beside_their_bounds(picture, singles, savings, pick.ablation),
        pareto=front,
        box_deg=picture.quadrature.box(),
        pixels=len(picture.quadrature),
        convergence=convergence,
        skipped=int(np.sum(picture.weights == 0)),
        seed=seed,
    )
    return replace(found, findings=(*refused, *_doubts(found, picture, geom_of_data, timing)))


def _beside_their_bounds(picture: Picture, singles, savings, ablation: Ablation) -> tuple[Single, ...]:
    """Each part left out alone, with what that saves and what a closed form says of it."""
    bounds = analytic.analytic_bounds(picture)
    return tuple(
        Single(feature, errors, savings[feature], search.is_out(feature, ablation), bounds.get(feature))
        for feature, errors in singles.items()
    )


def _doubts(found: Pruned, picture: Picture, geom_of_data: Geometry | None, timing: bool):
    yield from validity.unsettled(found.scene, found.convergence, len(picture.weights))
    yield from validity.at_bounds(found.surface)
    yield from validity.of_perturbed_views(found.scene, found.moved)
    yield from validity.beyond_data(picture.quadrature, geom_of_data)
    if timing:
        yield from validity.over_budget(found.scene, found.time, found.pareto)


def _picture(features: Features, scene: Scene, size: int, seed: int, width: float) -> Picture | None:
    """The model seen through `scene`; None if nothing is lit and seen."""
    sampled = radiance.sample(scene, size, seed, width, turns(features.surface))
    if not len(sampled):
        return None
    picture = Picture(features, sampled)
    return picture if picture.weights.any() else None


def _converged(sample, scene: Scene, seed: int):
    """The picture with enough pixels: doubling them no longer changes what decides by a quarter of the tolerance."""
    least = 0.25 * max(min(scene.tolerance.worst, scene.tolerance.p95), 0.04)
    most = 4 * max(scene.tolerance.worst, 0.25)  # beyond, an error decides nothing by its size
    size, before, work = FIRST_PIXELS, None, 0.0
    while True:
        picture = sample(scene, size, seed)
        if picture is None:
            raise NoAnswer(
                f"{scene.name}: nothing is both lit and seen, or the model is black there; widen the camera's or "
                f"the lights' angles"
            )
        if before is None:
            work = search.work_of_variants(picture)
        singles = _singles(picture)
        now = np.array([min(value, most) for errors in singles.values() for value in (errors.visible, errors.p95)])
        change = 0.0 if before is None else float(np.max(np.abs(now - before), initial=0.0))
        settled = change < least and size >= ENOUGH_PIXELS
        if (
            scene.pairs
            or before is not None
            and (settled or size * 2 > MOST_PIXELS or 2 * len(search.cost_directions(picture)) * work > MOST_WORK)
        ):
            return picture, singles, change
        size, before = size * 2, now


def _singles(picture: Picture) -> dict[Feature, Errors]:
    """Each part left out alone."""
    ablations = {feature: NOTHING.without(feature) for feature in picture.features.all()}
    return {
        feature: picture.ablation_errors(ablation, picture.refitted(ablation))
        for feature, ablation in ablations.items()
        if picture.features.provided(ablation)
    }


def _picked(checks: "_Checks", substitutes: bool, progress: Callable[[str], None]):
    """The cheapest candidate that stands the checks, its errors on fresh directions and with the angles moved, and all
    candidates."""
    picture, ablations = checks.picture, checks.ablations.values()
    candidates = [*ablations, *search.near_misses(picture, ablations, search.cheapest(picture, ablations))]
    if substitutes:
        progress("trying simpler laws")
        candidates += search.substituted(picture, search.cheapest(picture, candidates))
    progress("checking on fresh directions")
    pick, fresh, moved = checks.first_that_stands(candidates)
    if checks.refused:  # by one that does not stand it was measured what else is worth trying
        beside = search.near_misses(picture, ablations, pick)
        beside += search.substituted(picture, pick) if substitutes else []
        cheaper = [each for each in beside if each.work < pick.work]
        pick, fresh, moved = checks.first_that_stands(cheaper, (pick, fresh, moved))
        candidates += beside
    return pick, fresh, moved, candidates


@dataclass(frozen=True, eq=False)
class _Checks:
    """What a candidate has to stand before it is picked, and those that did not."""

    picture: Picture
    ablations: dict
    sample: Callable
    seed: int
    clock: Callable
    refused: list[Finding] = field(default_factory=list)
    tried: set[int] = field(default_factory=set)

    @property
    def _whole(self) -> Candidate:
        return self.ablations[NOTHING]

    def first_that_stands(self, candidates, otherwise: tuple | None = None) -> tuple[Candidate, Errors, Mapping]:
        """The cheapest candidate within the tolerance that stands the checks, its errors on fresh directions and with
        the angles moved; the whole, or `otherwise`, where none does."""
        tolerance = self.picture.tolerance
        good = (each for each in candidates if each.errors.within(tolerance))
        for each in sorted(good, key=lambda each: each.work):
            each = _worth_it(self.picture, each, self.ablations, self.clock)
            if each.whole:
                break
            if id(each) in self.tried:
                continue
            self.tried.add(id(each))
            each, fresh = _reproduced(each, self.picture, self._afresh)
            moved = self._moved(each)
            why = self._why_not(fresh, moved)
            if not why:
                return each, fresh, moved
            text = f"{each} would do on the drawn directions, but not when checked: {why}"
            self.refused.append(Finding("pruned-refused", text))
        return otherwise or (self._whole, self._whole.errors, dict.fromkeys(PERTURBED, self._whole.errors))

    def _moved(self, each: Candidate) -> dict[float, Errors]:
        views = {factor: self._perturbed(factor) for factor in PERTURBED}
        return {factor: view.errors(view.radiance(each.surface)) for factor, view in views.items() if view}

    def _why_not(self, fresh: Errors, moved: Mapping[float, Errors]) -> str:
        tolerance = self.picture.tolerance
        if not fresh.within(tolerance):
            return f"{fresh.visible:.2g} at worst and {fresh.p95:.2g} for 95 % of the picture on fresh directions"
        if self.picture.quadrature.scene.camera_moves and not all(each.within(tolerance) for each in moved.values()):
            worst = max(errors.visible for errors in moved.values())
            return f"{worst:.2g} at worst with the angles 10 % off, and the camera moves"
        return ""

    @cached_property
    def _afresh(self) -> Callable[[int], Picture | None]:
        """The picture sampled afresh. Only the pick and the whole are judged on it, so that many more pixels can be
        had, and rare ones are found."""
        picture, size = self.picture, len(self.picture.weights)
        directions = len(search.cost_directions(picture))
        more = int(np.clip(MOST_WORK / (4 * self._whole.work * directions), 1, MOST_MORE))
        if picture.quadrature.to_world is not None:
            more = max(min(more, MOST_SURROUNDED // size), 1)
        return lru_cache(lambda step: self.sample(picture.quadrature.scene, more * size, self.seed + step))

    @cached_property
    def _perturbed(self) -> Callable[[float], Picture | None]:
        scene, size = self.picture.quadrature.scene, len(self.picture.weights)
        return lru_cache(lambda factor: self.sample(scene.scaled(factor), size, self.seed))


def _reproduced(each: Candidate, picture: Picture, afresh) -> tuple[Candidate, Errors]:
    """The candidate with its errors on as many samples as it takes until they reproduce the next, and the errors on
    that one.

    Takes  afresh(step), the picture sampled afresh.
    """
    for step in range(1, MOST_SAMPLES + 1):
        check = afresh(step) or picture
        fresh = check.errors(check.radiance(each.surface))
        if each.errors.reproduces(fresh) or not fresh.within(picture.tolerance):
            break
        each = replace(each, errors=each.errors.or_worse(fresh))
    return each, fresh


def _worth_it(picture: Picture, pick: Candidate, ablations: dict, clock) -> Candidate:
    """The pick with every part back whose absence saves no time that can be measured."""
    back = (
        [NOTHING]
        if pick.substitute
        else [pick.ablation.restoring(feature) for feature in sorted(pick.ablation.out, reverse=True)]
    )
    fuller = (search.judge(picture, ablation, ablations) for ablation in back)
    for each in fuller:
        if each is None or not each.errors.within(picture.tolerance):
            continue
        longer, shorter = cost.compare_times(
            search.evaluator(each.surface), search.evaluator(pick.surface), search.cost_directions(picture), clock
        )
        if not longer.over(shorter).measurable:
            return _worth_it(picture, each, ablations, clock)
    return pick
