"""The cheapest model, and the fewest parts of it, that a scene cannot tell from the whole.

    every cut of the model → amplitudes refitted → JND over the picture, and its measured time
    pick   = the cheapest within the tolerance, whose saving can be measured
    check  = the same picture drawn afresh, until one draw foretells the next; and with every angle 10 % smaller and larger

What may differ is said by the scene; what was assumed where it is silent is `scene.DEFAULT`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from . import costs, quadrature, reach, screens, search
from .costs import Saving, Time
from .errors import NoAnswer
from .geometry import Geometry
from .measurement import Finding
from .models._base import Sum
from .parts import NOTHING, Cut, Part, Parts
from .picture import Errors, Picture, lobe_width
from .scene import Scene
from .search import Candidate

FIRST_PIXELS, ENOUGH_PIXELS, MOST_PIXELS = 750, 3000, 8000
MOST_WORK = 3e8  # additions to judge all ways to keep all terms once: some half second
RGB_UM = (0.61, 0.55, 0.46)  # dominant wavelengths of red, green and blue
MOST_DRAWS, MOST_MORE = 4, 8  # fresh draws of a picture, until one foretells the next; their pixels, times those searched with
STRAY = (0.9, 1.1)


@dataclass(frozen=True)
class Single:
    """One part left out alone, the rest refitted."""

    part: Part
    errors: Errors
    saving: Saving  # per direction
    left_out: bool
    screen: float | None = None  # closed-form upper bound [JND]


@dataclass(frozen=True, eq=False)
class Pruned:
    """What is left, what that costs and what it saves."""

    scene: Scene
    whole: Sum
    whole_values: Mapping
    sum: Sum
    values: Mapping  # of `sum`, refitted over the scene
    cut: Cut  # what was left out
    stand_in: bool  # whether another law takes the place of the lobes
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
    other_laws: bool = True,
    timing: bool = True,
) -> Pruned:
    """The least of `sum_` that `scene` needs.

    Takes  values of the sum's parameters, scalars or (channels,); wavelength [µm] (channels,), by default the data's;
    geom_of_data, the directions that the values were fitted to, only to say where the scene goes beyond them;
    other_laws, whether a simpler law may stand in for the lobes; timing, whether times decide what is worth leaving out, or
    operations alone, so that two runs give the same.
    Gives  Pruned.    Raises NoAnswer if the scene shows no lit surface.
    """
    parts = Parts(sum_, values, _wavelengths(values, wavelength, geom_of_data))
    width = lobe_width(sum_, values, parts.wavelength)
    draw = lambda scene_, size, seed_: _picture(parts, scene_, size, seed_, width)  # noqa: E731
    clock = costs.times if timing else costs.counted
    progress("drawing the scene")
    picture, singles, convergence = _converged(draw, scene, seed)
    progress("leaving parts out")
    cuts = search.cuts(picture)
    candidates = [*cuts.values(), *search.near_misses(picture, cuts.values())]
    if other_laws:
        progress("trying simpler laws")
        candidates += search.other_laws(picture, candidates)
    progress("checking on fresh directions")
    pick, fresh, moved, refused = _picked(picture, candidates, cuts, draw, seed, clock)
    progress("timing what is left")
    whole, rows = cuts[NOTHING], search.rows(picture)
    laws = search.law(whole.sum, whole.values), search.law(pick.sum, pick.values)
    candidates = [each for each in candidates if each.values is not pick.values] + [pick]
    savings, front = search.times(picture, singles, search.front(candidates), clock)
    whole_time, time = (clock({"": laws[0]}, rows)[""],) * 2 if pick.whole else costs.compare(*laws, rows, clock)
    bounds = screens.bounds(picture)
    findings = (
        *refused, *reach.unsettled(scene, convergence, len(picture.weights)), *reach.at_bounds(pick.sum, pick.values), *reach.strays(scene, moved),
        *reach.beyond_data(picture.quadrature, geom_of_data), *(reach.over_budget(scene, time, front) if timing else ()),
    )  # fmt: skip
    return Pruned(
        scene, sum_, dict(values), pick.sum, pick.values, pick.cut, pick.stand_in, pick.errors, fresh, moved, whole_time, time,
        tuple(costs.operations(each, rows[: costs.COUNTED]) for each in laws),
        tuple(Single(part, errors, savings[part], search.is_out(part, pick.cut), bounds.get(part)) for part, errors in singles.items()),
        front, picture.quadrature.box(), len(picture.quadrature), convergence, int(np.sum(picture.weights == 0)), seed, findings,
    )  # fmt: skip


def _wavelengths(values: Mapping, wavelength, geom_of_data) -> np.ndarray:
    """One for each channel [µm]; three channels without any are red, green and blue."""
    shapes = [np.shape(np.atleast_1d(value)) for value in values.values()]
    if wavelength is None:
        wavelength = RGB_UM if geom_of_data is None and (3,) in shapes else 0.55 if geom_of_data is None else geom_of_data.wavelength
    return np.array(np.broadcast_to(np.asarray(wavelength, float), np.broadcast_shapes(np.shape(np.atleast_1d(wavelength)), *shapes)))


def _picture(parts: Parts, scene: Scene, size: int, seed: int, width: float) -> Picture | None:
    """The model seen through `scene`; None if nothing is lit and seen."""
    drawn = quadrature.draw(scene, size, seed, width)
    if not len(drawn):
        return None
    picture = Picture(parts, drawn.at(parts.wavelength))
    return picture if picture.weights.any() else None


def _converged(draw, scene: Scene, seed: int):
    """The picture with enough pixels: doubling them no longer changes what decides by a quarter of the tolerance."""
    least = 0.25 * max(min(scene.tolerance.worst, scene.tolerance.p95), 0.04)
    most = 4 * max(scene.tolerance.worst, 0.25)  # beyond, an error decides nothing by its size
    size, before = FIRST_PIXELS, None
    while True:
        picture = draw(scene, size, seed)
        if picture is None:
            raise NoAnswer(f"{scene.name}: nothing is both lit and seen, or the model is black there; widen the camera's or the lights' angles")
        work = search.work_of_ways(picture) if before is None else work
        singles = _singles(picture)
        now = np.array([min(value, most) for errors in singles.values() for value in (errors.visible, errors.p95)])
        change = 0.0 if before is None else float(np.max(np.abs(now - before), initial=0.0))
        settled = change < least and size >= ENOUGH_PIXELS
        if scene.pairs or before is not None and (settled or size * 2 > MOST_PIXELS or 2 * len(search.rows(picture)) * work > MOST_WORK):
            return picture, singles, change
        size, before = size * 2, now


def _singles(picture: Picture) -> dict[Part, Errors]:
    """Each part left out alone."""
    cuts = {part: NOTHING.without(part) for part in picture.parts.all()}
    return {part: picture.cut_errors(cut, picture.refitted(cut)) for part, cut in cuts.items() if picture.parts.provided(cut)}


def _picked(picture: Picture, candidates, cuts: dict, draw, seed: int, clock):
    """The cheapest candidate within the tolerance that stands the checks, its errors there, and what was refused on the way."""
    scene, size, whole = picture.quadrature.scene, len(picture.weights), cuts[NOTHING]
    # only the pick and the whole are judged now, so that many more pixels can be had, and rare ones are found
    more = int(np.clip(MOST_WORK / (4 * whole.work * len(search.rows(picture))), 1, MOST_MORE))
    afresh = lru_cache(lambda step: draw(scene, more * size, seed + step))
    strayed = lru_cache(lambda factor: draw(scene.scaled(factor), size, seed))
    seen = set()
    refused: tuple[Finding, ...] = ()
    for each in sorted((each for each in candidates if each.errors.within(scene.tolerance)), key=lambda each: each.work):
        each = _worth_it(picture, each, cuts, clock)
        if each.whole:
            break
        if id(each) in seen:
            continue
        seen.add(id(each))
        each, fresh = _foretold(each, picture, afresh)
        moved = {factor: check.errors(check.radiance(each.sum, each.values)) for factor in STRAY if (check := strayed(factor))}
        if not fresh.within(scene.tolerance):
            why = f"{fresh.visible:.2g} at worst and {fresh.p95:.2g} for 95 % of the picture on fresh directions"
        elif scene.camera_moves and not all(errors.within(scene.tolerance) for errors in moved.values()):
            why = f"{max(errors.visible for errors in moved.values()):.2g} at worst with the angles 10 % off, and the camera moves"
        else:
            return each, fresh, moved, refused
        if len(refused) < 3:
            refused += (Finding("pruned-refused", f"{each} would do on the drawn directions, but not when checked: {why}"),)
    return whole, whole.errors, dict.fromkeys(STRAY, whole.errors), refused


def _foretold(each: Candidate, picture: Picture, afresh) -> tuple[Candidate, Errors]:
    """The candidate with its errors on as many draws as it takes until they foretell the next, and the errors on that one.

    Takes  afresh(step), the picture drawn afresh.
    """
    for step in range(1, MOST_DRAWS + 1):
        check = afresh(step) or picture
        fresh = check.errors(check.radiance(each.sum, each.values))
        if each.errors.foretells(fresh) or not fresh.within(picture.tolerance):
            break
        each = replace(each, errors=each.errors.or_worse(fresh))
    return each, fresh


def _worth_it(picture: Picture, pick: Candidate, cuts: dict, clock) -> Candidate:
    """The pick with every part back whose absence saves no time that can be measured."""
    back = [NOTHING] if pick.stand_in else [pick.cut.restoring(part) for part in sorted(pick.cut.out, reverse=True)]
    fuller = (search.judge(picture, cut, cuts) for cut in back)
    for each in fuller:
        if each is None or not each.errors.within(picture.tolerance):
            continue
        longer, shorter = costs.compare(search.law(each.sum, each.values), search.law(pick.sum, pick.values), search.rows(picture), clock)
        if not longer.over(shorter).measurable:
            return _worth_it(picture, each, cuts, clock)
    return pick
