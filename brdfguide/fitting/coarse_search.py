"""Where the starts of models end: the first, coarse part of a fit, on few directions and channels."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from time import perf_counter

import numpy as np

from ..models import Composite
from ..models.candidates import candidate_label, has_edge, without_edge
from ..models.extensions import edge_starts
from ..records import dataclass
from . import starting_grid
from .fit_options import FitOptions
from .followed import End, Following, follow
from .layout import Layout, layout_of
from .objective import Misfit, metric
from .prepared import Prepared, Subset

WARM_UP_BUDGET = 8  # evaluations after which a start that lies far behind is followed no further
MOST_EVALUATIONS = 100
TOLERANCE = 1e-5
GIVEN_FOLLOWED = 2  # of the starts that one is given, those that are followed beyond the warm-up
OUTRUN = 1.5  # times the best rms: so far behind; such a model settles on SETTLE_SAMPLES


@dataclass(frozen=True, eq=False)
class Search:
    """Where the starts of one model ended, on few directions and channels."""

    layout: Layout
    ends: list  # (shared, per_channel, rms), best first
    evaluations: int
    seconds: float
    last: tuple[Misfit, End] | None = None  # the best of them where descents may go on, and what it looked at

    def known_on(self, on: Subset) -> list[End] | None:
        """Where the best ended, if it looked at this part of the data."""
        if self.last is None:
            return None
        misfit, end = self.last
        return [end] if misfit.measurement is on.measurement and misfit.weights is on.weights else None

    @property
    def rms(self) -> float:
        return self.ends[0][2]

    @property
    def values(self) -> dict:
        """Where the best of them ended, in the few channels."""
        shared, per_channel, _ = self.ends[0]
        return replace(self.layout, channels=len(per_channel)).decode(shared, per_channel)


def _with_options(model: Composite, options: FitOptions) -> Composite:
    """The sum with those of the user's fixed and start values that it has; `fit_all` refuses a name that none has."""
    fixed, start = _its(model, options.fixed), _its(model, options.start)
    if not (fixed or start):
        return model
    free = tuple(key for key in model.free if key not in fixed)
    return replace(model, fixed={**model.fixed, **fixed}, start={**model.start, **start}, free=free)


def free_count(model: Composite, channels: int, options: FitOptions) -> int:
    """How many numbers a fit of the sum searches for."""
    return layout_of(_with_options(model, options), channels, options.shape_per_channel).count


def _its(model: Composite, wanted: Mapping[str, float]) -> dict[str, float]:
    """Those of the user's values that belong to a parameter of this sum, by their full names."""
    return model.qualified({name: value for name, value in wanted.items() if model.has(name)})


@dataclass(frozen=True)
class Given:
    """Where to begin in place of a grid, and for how long to go on."""

    starts: tuple[Mapping, ...] = ()  # in the few channels; none: the grid all the same
    levels: bool = True  # whether their amplitudes are to be solved for
    worth: float = np.inf  # rms that one has to reach in the warm-up to be followed further


AT_THE_GRID = Given()


@dataclass(frozen=True)
class Sought:
    """A model to search for."""

    model: Composite
    given: Given = AT_THE_GRID


def search(model: Composite, data: Prepared, options: FitOptions, given: Given = AT_THE_GRID) -> Search:
    """Follows the starts of a grid, or those given, and the user's, on few directions and channels."""
    return search_all([Sought(model, given)], data, options)[0]


def search_all(
    sought: Sequence[Sought], data: Prepared, options: FitOptions, progress: Callable[[str], None] = lambda name: None
) -> list[Search]:
    """The same of many models, whose descents take their steps side by side."""
    begun = []
    for each in sought:
        progress(f"searching {candidate_label(each.model)}")
        begun.append(_begin(each.model, data, options, each.given))
    began = perf_counter()
    first = follow([each.following for each in begun], TOLERANCE, WARM_UP_BUDGET)
    ahead = [_ahead(each, found) for each, found in zip(begun, first, strict=True)]
    further = [each.further(found) for each, found in zip(begun, ahead, strict=True)]
    followed = follow(
        [
            each.from_ends([found[place] for place in places])
            for each, found, places in zip(begun, ahead, further, strict=True)
        ],
        TOLERANCE,
        MOST_EVALUATIONS,
    )
    spent = [sum(end.evaluations for end in (*one, *more)) for one, more in zip(first, followed, strict=True)]
    each_takes = (perf_counter() - began) / max(sum(spent), 1)
    return [
        each.ended(dict(enumerate(found)) | dict(zip(places, more, strict=True)), count, each_takes * count)
        for each, found, places, more, count in zip(begun, ahead, further, followed, spent, strict=True)
    ]


@dataclass(frozen=True, eq=False)
class _Begun:
    """A model with the places where its descents begin."""

    layout: Layout
    narrow: Layout  # of few channels
    misfit: Misfit
    starts: Sequence[Mapping]
    given: Given
    seconds: float

    @property
    def following(self) -> Following:
        return Following(self.misfit, [self.narrow.encode(start) for start in self.starts])

    def from_ends(self, ends: Sequence[End]) -> Following:
        return Following.on(self.misfit, ends)

    def further(self, ahead: list[End]) -> list[int]:
        """Which ends of the warm-up are worth following."""
        most = min(OUTRUN**2 * ahead[0].cost, self.given.worth**2 * _looked_at(self.misfit))
        return [place for place, end in enumerate(ahead) if not end.converged and end.cost <= most]

    def ended(self, found: Mapping[int, End], evaluations: int, seconds: float) -> Search:
        ends = list(found.values())
        return Search(
            self.layout, _best_first(self.misfit, ends), evaluations, self.seconds + seconds, _last(self.misfit, ends)
        )


def _looked_at(misfit: Misfit) -> int:
    """How many values a descent looks at."""
    return max(int(np.count_nonzero(misfit.measurement.weighed)), 1)


def _best_first(misfit: Misfit, ends: Iterable[End]) -> list:
    """(shared, per_channel, rms) of ends, as a fit goes on from them."""
    layout, count, found = misfit.layout, _looked_at(misfit), []
    for end in ends:
        at = end.shared, end.per_channel
        if layout.walks:
            at = layout.standing().encode(layout.decode(*at))
        found.append((*layout.in_order(*at), float(np.sqrt(end.cost / count))))
    return sorted(found, key=lambda each: each[2])


def _last(misfit: Misfit, ends: Iterable[End]) -> tuple[Misfit, End] | None:
    """The best end, with what it looked at; None where it is told in other coordinates."""
    best = min(ends, key=lambda end: end.cost)
    layout, at = misfit.layout, (best.shared, best.per_channel)
    stays = not layout.walks and all(map(np.array_equal, at, layout.in_order(*at)))
    return (misfit, best) if stays else None


def _begin(model: Composite, data: Prepared, options: FitOptions, given: Given) -> _Begun:
    began, few = perf_counter(), data.search.measurement
    layout = layout_of(_with_options(model, options), data.settle.weights.shape[1], options.shape_per_channel)
    narrow = layout_of(layout.model, few.brdf.shape[1], layout.shape_per_channel).walking()
    misfit = data.search.misfit(narrow, metric(options.metric))
    if has_edge(narrow.model) and not given.starts:
        held = search(without_edge(narrow.model), data, options)
        given = Given(edge_starts(narrow.model, held.values))
    starts = [dict(start) for start in given.starts]
    if given.levels:
        starts = starting_grid.amplitudes_by_channel(narrow, few, starts)
    starts = starts or starting_grid.grid_starts(narrow, few)
    if users := _its(model, options.start):  # the rest as in the grid's best
        starts.append({**starting_grid.amplitudes_by_channel(narrow, few, [{**starts[0], **users}])[0], **users})
    return _Begun(layout, narrow, misfit, starts, given, perf_counter() - began)


def _ahead(begun: _Begun, found: list[End]) -> list[End]:
    """The ends of the warm-up that count, best first."""
    return sorted(found, key=lambda end: end.cost)[: GIVEN_FOLLOWED if begun.given.starts else None]


def followed_on(searches: Sequence[Search], data: Prepared, options: FitOptions) -> list[Search]:
    """Searches that go on from where they ended, on values that count otherwise than when they began."""
    began, few = perf_counter(), data.search.measurement
    narrow = [replace(each.layout, channels=few.brdf.shape[1]) for each in searches]
    misfits = [data.search.misfit(layout, metric(options.metric)) for layout in narrow]
    found = follow(
        [
            Following(misfit, [(shared, per_channel) for shared, per_channel, _ in each.ends])
            for misfit, each in zip(misfits, searches, strict=True)
        ],
        TOLERANCE,
        MOST_EVALUATIONS,
    )
    seconds = (perf_counter() - began) / max(len(searches), 1)
    return [
        Search(
            each.layout,
            _best_first(misfit, ends),
            each.evaluations + sum(end.evaluations for end in ends),
            each.seconds + seconds,
            _last(misfit, ends),
        )
        for misfit, each, ends in zip(misfits, searches, found, strict=True)
    ]
