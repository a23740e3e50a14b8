"""Everything that a scene might get by with: cuts of the model, and cheaper laws in place of its lobes.

Operations decide which of two is cheaper, since they are the same in every run; times are measured for what is shown.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial, reduce

from . import costs, screens, stand_ins
from .costs import NO_TIME, Saving, Time
from .geometry import Geometry
from .models._base import Sum
from .parts import MIRROR, NOTHING, Cut, Part, Parts
from .picture import Errors, Picture

MOST_CUTS = 256  # tried one by one; with more, parts are left out greedily
NEAR_MISS = 6.0  # times the tolerance: worth refitting the shapes too
MOST_NEAR_MISSES = 3


@dataclass(frozen=True, eq=False)
class Candidate:
    """What might do, with the picture's errors and its cost."""

    cut: Cut
    sum: Sum
    values: Mapping
    errors: Errors
    work: float  # operations per direction, in additions
    time: Time = NO_TIME
    stand_in: bool = False  # another law takes the place of the lobes, which the cut leaves out

    @property
    def whole(self) -> bool:
        """Whether nothing is left out."""
        return self.cut == NOTHING

    def __str__(self) -> str:
        return f"{self.sum.name} instead" if self.stand_in else f"without {self.cut}"


def law(sum_: Sum, values: Mapping):
    """The whole of a sum as one law of the geometry: what a renderer would call."""
    if not sum_.has_mirror:
        return lambda geom: sum_(geom, values)
    return lambda geom: (sum_(geom, values), sum_.mirror(geom, values))


def rows(picture: Picture) -> Geometry:
    """The directions on which costs are taken: to the lights, or all around where none is seen."""
    to_lights = picture.quadrature.lit[0]
    return to_lights if len(to_lights) else picture.quadrature.around[0]


def is_out(part: Part, cut: Cut) -> bool:
    return part in cut.out or not cut.keeps(part.label)


# --- candidates -------------------------------------------------------------------------------------


def cuts(picture: Picture) -> dict[Cut, Candidate]:
    """All cuts judged, but for parts that closed forms settle; where there are too many, those on the way down from the whole."""
    found: dict[Cut, Candidate] = {}
    every = picture.parts.cuts(screens.negligible(picture))
    if len(every) <= MOST_CUTS:
        for cut in (NOTHING, *every):
            judge(picture, cut, found)
        return found
    here = judge(picture, NOTHING, found)
    while True:
        fewer = [here.cut.without(part) for part in picture.parts.all() if not is_out(part, here.cut)]
        swapped = [cut.restoring(part) for cut in fewer for part in here.cut.out]
        tried = [judge(picture, cut, found) for cut in {*fewer, *swapped} - found.keys() if picture.parts.provided(cut)]
        good = [each for each in tried if each.errors.within(picture.tolerance) and each.work < here.work]
        if not good:
            return found
        here = min(good, key=lambda each: each.work)


def judge(picture: Picture, cut: Cut, found: dict[Cut, Candidate]) -> Candidate | None:
    """The candidate of a cut, from those `found` or added to them; None where no law provides it."""
    if cut not in found and picture.parts.provided(cut):
        factors = picture.refitted(cut)
        sum_, values = picture.parts.pruned(cut), picture.values(cut, factors)
        found[cut] = Candidate(cut, sum_, values, picture.cut_errors(cut, factors), work(picture, sum_, values))
    return found.get(cut)


def near_misses(picture: Picture, candidates) -> list[Candidate]:
    """Cuts cheaper than the cheapest that will do and nearly as good, their shapes refitted as well."""
    enough = cheapest(picture, candidates)
    near = [each for each in candidates if each.work < enough.work and each.errors.within(picture.tolerance, NEAR_MISS)]
    best = sorted(near, key=lambda each: each.errors.visible)[:MOST_NEAR_MISSES]
    return [judged(picture, each.cut, each.sum, stand_ins.reshaped(picture, each.sum, each.values)) for each in best]


def other_laws(picture: Picture, candidates) -> list[Candidate]:
    """Simple lobes in place of those of the cheapest cut that will do, where they would be cheaper still."""
    enough = cheapest(picture, candidates)
    lobes = [Part(term.label) for term in picture.parts.sum.terms if term.model.roles != ("subsurface",)]
    cut, found = reduce(Cut.without, lobes, enough.cut), []
    for sum_, start in stand_ins.of(enough.sum, enough.values, picture.quadrature.width, picture.parts.wavelength):
        if work(picture, sum_, start) < 0.9 * enough.work:
            found.append(replace(judged(picture, cut, sum_, stand_ins.reshaped(picture, sum_, start)), stand_in=True))
    return found


def judged(picture: Picture, cut: Cut, sum_: Sum, values: Mapping) -> Candidate:
    """A candidate evaluated as a whole."""
    return Candidate(cut, sum_, values, picture.errors(picture.radiance(sum_, values)), work(picture, sum_, values))


def cheapest(picture: Picture, candidates) -> Candidate:
    """The cheapest candidate within the tolerance."""
    return min((each for each in candidates if each.errors.within(picture.tolerance)), key=lambda each: each.work)


def front(candidates) -> tuple[Candidate, ...]:
    """Those that no other beats in both cost and worst visible error, cheapest first."""
    found: list[Candidate] = []
    for each in sorted(candidates, key=lambda each: (each.work, each.errors.visible)):
        if not found or each.errors.visible < 0.9 * found[-1].errors.visible - 1e-9 or each.whole:
            found.append(each)
        if each.whole or each.errors.visible < 1e-9:
            break
    return tuple(found)


# --- cost -------------------------------------------------------------------------------------------


def work(picture: Picture, sum_: Sum, values: Mapping) -> float:
    """Operations per direction of a sum, in additions."""
    return costs.work(costs.operations(law(sum_, values), rows(picture)[: costs.COUNTED]))


def work_of_ways(picture: Picture) -> float:
    """Operations per direction of keeping every term in every way: what judging a picture costs."""
    parts = picture.parts
    laws = (_way_law(parts, term.label, way) for term in parts.sum.terms for way in parts.ways(term))
    return sum(costs.work(costs.operations(each, rows(picture)[: costs.COUNTED])) for each in laws)


def times(picture: Picture, singles, shown, clock) -> tuple[dict[Part, Saving], tuple[Candidate, ...]]:
    """What each part in `singles` saves when left out alone, and the candidates in `shown` with their times, by `clock`."""
    parts = picture.parts
    laws: dict = {index: law(each.sum, each.values) for index, each in enumerate(shown)}
    for part in singles:
        laws[part.label, frozenset()] = _way_law(parts, part.label, frozenset())
        if part.feature == MIRROR:
            term = next(term for term in parts.sum.terms if term.label == part.label)
            laws[part] = partial(term.model.mirror, **parts.of(term))
        elif part.feature:
            laws[part] = _way_law(parts, part.label, frozenset({part.feature}))
    measured = clock(laws, rows(picture))
    savings = {}
    for part in singles:
        whole = measured[part.label, frozenset()]
        savings[part] = measured[part].over(NO_TIME) if part.feature == MIRROR else whole.over(measured[part] if part.feature else NO_TIME)
    return savings, tuple(replace(each, time=measured[index]) for index, each in enumerate(shown))


def _way_law(parts: Parts, label: str, way: frozenset[str]):
    """One term kept one way, as a law."""
    term = next(term for term in parts.sum.terms if term.label == label)
    alone = Sum(term.model.name, (replace(term, model=parts.model(term, way)),))
    return law(alone, {f"{label}.{name}": value for name, value in parts.of(term).items()})
