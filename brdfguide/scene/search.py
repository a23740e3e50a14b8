"""Everything that a scene might get by with: ablations of the model, and cheaper laws in place of its lobes.

Operations decide which of two is cheaper, since they are the same in every run; times are measured for what is shown.
"""

from dataclasses import replace
from functools import lru_cache, partial, reduce

from ..models import cost
from ..models.cost import NO_TIME, Saving, Time
from ..models.surface import Surface
from ..numerics import pareto
from ..physics.geometry import Geometry
from ..records import dataclass
from . import bounds, radiance, substitutes
from .difference import Errors, Picture
from .features import MIRROR, NOTHING, Ablation, Feature, Features
from .scene import Scene, Tolerance

MOST_ABLATIONS = 256  # tried one by one; with more, parts are left out greedily
NEAR_MISS = 6.0  # times the tolerance: worth refitting the shapes too
MOST_NEAR_MISSES = 3
COUNTED_PIXELS = 500  # of the scene, on whose directions operations are counted


@dataclass(frozen=True, eq=False)
class Candidate:
    """What might do, with the picture's errors and its cost."""

    ablation: Ablation
    surface: Surface
    errors: Errors
    work: float  # operations per direction, in additions
    time: Time = NO_TIME
    substitute: bool = False  # another law takes the place of the lobes, which the ablation leaves out

    @property
    def whole(self) -> bool:
        """Whether nothing is left out."""
        return self.ablation == NOTHING

    def __str__(self) -> str:
        return f"{self.surface.model.name} instead" if self.substitute else f"without {self.ablation}"


def evaluator(surface: Surface):
    """The whole of a surface as one function of the geometry: what a renderer would call."""
    model, values = surface.model, surface.values
    if not model.has_mirror:
        return lambda geom: model(geom, values)
    return lambda geom: (model(geom, values), model.mirror(geom, values))


def cost_directions(picture: Picture) -> Geometry:
    """The directions on which costs are taken: to the lights, or all around where none is seen."""
    return picture.quadrature.representative.at(picture.features.surface.wavelengths)


def counted_directions(picture: Picture) -> Geometry:
    """A few directions of the scene on which operations are counted, whatever was drawn for the picture since."""
    q = picture.quadrature
    scene = replace(q.scene, tolerance=Tolerance())
    return _counted(scene, q.seed, q.width, q.turns).at(picture.features.surface.wavelengths)


@lru_cache(maxsize=4)
def _counted(scene: Scene, seed: int, width: float, turns: bool) -> Geometry:
    return radiance.sample(scene, COUNTED_PIXELS, seed, width, turns).representative[: cost.COUNTED]


def is_out(feature: Feature, ablation: Ablation) -> bool:
    return feature in ablation.out or not ablation.keeps(feature.label)


# --- candidates -------------------------------------------------------------------------------------


def ablations(picture: Picture) -> dict[Ablation, Candidate]:
    """All ablations judged, but for parts that closed forms settle; of too many, those on a way down from the whole."""
    found: dict[Ablation, Candidate] = {}
    every = picture.features.ablations(bounds.negligible(picture))
    if len(every) <= MOST_ABLATIONS:
        for ablation in (NOTHING, *every):
            judge(picture, ablation, found)
        return found
    judge(picture, NOTHING, found)
    here = found[NOTHING]
    while True:
        fewer = [
            here.ablation.without(feature) for feature in picture.features.all() if not is_out(feature, here.ablation)
        ]
        swapped = [ablation.restoring(feature) for ablation in fewer for feature in here.ablation.out]
        tried = [judge(picture, ablation, found) for ablation in {*fewer, *swapped} - found.keys()]
        good = [each for each in tried if each and each.errors.within(picture.tolerance) and each.work < here.work]
        if not good:
            return found
        here = min(good, key=lambda each: each.work)


def judge(picture: Picture, ablation: Ablation, found: dict[Ablation, Candidate]) -> Candidate | None:
    """The candidate of a cut, from those `found` or added to them; None where no law provides it."""
    if ablation not in found and picture.features.provided(ablation):
        factors = picture.refitted(ablation)
        surface = picture.surface(ablation, factors)
        found[ablation] = Candidate(
            ablation, surface, picture.ablation_errors(ablation, factors), work_per_direction(picture, surface)
        )
    return found.get(ablation)


def near_misses(picture: Picture, candidates, enough: Candidate) -> list[Candidate]:
    """Ablations cheaper than one that will do and nearly as good, their shapes refitted as well."""
    near = [each for each in candidates if each.work < enough.work and each.errors.within(picture.tolerance, NEAR_MISS)]
    best = sorted(near, key=lambda each: each.errors.visible)[:MOST_NEAR_MISSES]
    return [judged_whole(picture, each.ablation, substitutes.reshaped(picture, each.surface)) for each in best]


def substituted(picture: Picture, enough: Candidate) -> list[Candidate]:
    """Simple lobes in place of those of a candidate that will do, where they would be cheaper still."""
    lobes = [Feature(term.label) for term in picture.features.terms if not term.model.is_body]
    ablation, found = reduce(Ablation.without, lobes, enough.ablation), []
    for start in substitutes.of(enough.surface, picture.quadrature.width):
        if work_per_direction(picture, start) < 0.9 * enough.work:
            found.append(
                replace(judged_whole(picture, ablation, substitutes.reshaped(picture, start)), substitute=True)
            )
    return found


def judged_whole(picture: Picture, ablation: Ablation, surface: Surface) -> Candidate:
    """A candidate evaluated as a whole."""
    return Candidate(ablation, surface, picture.errors(picture.radiance(surface)), work_per_direction(picture, surface))


def cheapest(picture: Picture, candidates) -> Candidate:
    """The cheapest candidate within the tolerance."""
    return min((each for each in candidates if each.errors.within(picture.tolerance)), key=lambda each: each.work)


def pareto_front(candidates) -> tuple[Candidate, ...]:
    """Those that no other beats in both cost and worst visible error, cheapest first; of near twins the cheapest."""
    candidates = sorted(candidates, key=lambda each: (each.work, each.errors.visible))
    on_front = pareto.on_front([(each.work, each.errors.visible) for each in candidates])
    found: list[Candidate] = []
    for each in (each for each, unbeaten in zip(candidates, on_front, strict=True) if unbeaten or each.whole):
        if not found or each.errors.visible < 0.9 * found[-1].errors.visible - 1e-9 or each.whole:
            found.append(each)
        if each.whole or each.errors.visible < 1e-9:
            break
    return tuple(found)


# --- cost -------------------------------------------------------------------------------------------


def work_per_direction(picture: Picture, surface: Surface) -> float:
    """Operations per direction, in additions, on directions that are the same for every tolerance."""
    return cost.work(cost.operations(evaluator(surface), counted_directions(picture)))


def work_of_variants(picture: Picture) -> float:
    """Operations per direction of keeping every term in every variant: what judging a picture costs."""
    features = picture.features
    evaluators = (
        _variant_evaluator(features, term.label, variant)
        for term in features.terms
        for variant in features.variants(term)
    )
    return sum(cost.work(cost.operations(each, counted_directions(picture))) for each in evaluators)


def timed(picture: Picture, singles, shown, clock) -> tuple[dict[Feature, Saving], tuple[Candidate, ...]]:
    """What each part in `singles` saves when left out alone, and the candidates in `shown` with times by `clock`."""
    features = picture.features
    evaluators: dict = {index: evaluator(each.surface) for index, each in enumerate(shown)}
    for feature in singles:
        evaluators[feature.label, frozenset()] = _variant_evaluator(features, feature.label, frozenset())
        if feature.name == MIRROR:
            term = features.surface.model.term(feature.label)
            evaluators[feature] = term.model.mirror and partial(term.model.mirror, **features.surface.values_of(term))
        elif feature.name:
            evaluators[feature] = _variant_evaluator(features, feature.label, frozenset({feature.name}))
    measured = clock(evaluators, cost_directions(picture))
    savings = {}
    for feature in singles:
        if feature.name == MIRROR:
            savings[feature] = measured[feature].over(NO_TIME)
        else:
            savings[feature] = measured[feature.label, frozenset()].over(measured[feature] if feature.name else NO_TIME)
    return savings, tuple(replace(each, time=measured[index]) for index, each in enumerate(shown))


def _variant_evaluator(features: Features, label: str, variant: frozenset[str]):
    """One term in one variant, as such a function."""
    term = features.surface.model.term(label)
    return evaluator(features.surface.alone(replace(term, model=features.model(term, variant))))
