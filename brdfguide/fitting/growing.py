"""Candidates that grow from what the best so far leaves: one thing more at a time, until angles it has not seen say
that it is no better.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

import numpy as np

from ..data import noise
from ..data.measurement import Measurement
from ..models.candidates import candidate_label, containing
from ..models.extensions import Extension, edges, extensions, is_metallic, revived
from ..models.surface import Surface
from ..physics.geometry import Geometry
from ..records import dataclass
from . import cross_validation
from .coarse_search import Given, Search, Sought, free_count, search_all
from .diagnostics import standard_errors
from .fit_options import FitOptions
from .missed import few_directions
from .plausible import lobe_too_bright
from .prepared import Prepared, few_channels
from .ranked import BETTER, Step, Tried
from .ranking import stated_noise
from .residuals import NO_ERROR, ln_residuals, rms

MOST_STEPS = 4
ALIKE = 1.03  # times the least held-out error up to which the simpler step is taken
VALUES_EACH = 3  # for each free number, the least with which one grows
MOST_BEHIND = 3.0  # times the error of the best body and lobe, up to which a metal comes near (ours)
FOLLOWED = 3  # candidates of a step whose held-out error is formed
MAY_BE_BEST = 1.5  # times the error of the best metal of n = 1, up to which another may be better with its edge (ours)
PEAK, SHOULDER = 0.5, 0.05  # of the value in the mirror direction, down to which a lobe has its peak and its shoulder
LOW_DEG, HIGH_DEG = 30.0, 60.0  # incidence
TOWARD_LIGHT_DEG = 15.0
BEYOND = 3.0  # times the noise of single values, from which on a misfit is none (ours)
NOISY = 0.1  # ln: noise of single values, where nothing tells it, beyond which a misfit is something missed (ours)
NOISE = "what it leaves is noise"


@dataclass(frozen=True, eq=False)
class State:
    """A candidate that may grow, and its error at angles left out."""

    search: Search
    held_out: float

    @property
    def name(self) -> str:
        return candidate_label(self.search.layout.model)


def grow(
    searches: list[Search],
    data: Prepared,
    options: FitOptions,
    kind: str | None,
    progress: Callable[[str], None] = lambda name: None,
) -> tuple[list[Search], tuple[Step, ...]]:
    """What grew from the best of `searches`, for a surface of this kind (None: not known), and the steps.

    Nothing grows where no candidate can, where there is one incidence only, or where what the best leaves is noise; but
    beside one that is as bright as no dielectric a metal with an edge of its own.
    """
    known = {candidate_label(each.layout.model): each for each in searches}
    used, root = cross_validation.thinned(data.whole), _root(searches, data)
    if not root:
        return [], ()
    if not cross_validation.can_hold_out(used):
        return _where_nothing_grows(searches, data, options, kind), ()
    shown, steps = _shown(root, data), list[Step]()
    if not shown:
        step = Step(candidate_label(root.layout.model), root.rms, None, shown, because=NOISE)
        return _where_nothing_grows(searches, data, options, kind), (step,)
    held = cross_validation.held_out_from([(root.layout.model, root.values)], used, options)[0]
    assert held is not None
    state, taken = State(root, held.rms_ln), _metal_with_edge(root, searches, data, options)
    while len(steps) < MOST_STEPS:
        shown = shown if state.search is root else _shown(state.search, data)
        step = Step(state.name, state.search.rms, state.held_out, shown)
        if not shown:
            steps.append(replace(step, because=NOISE))
            break
        progress(f"growing {state.name}")
        tried = _tried(state, data, options, kind, known)
        further, step = _chosen(state, step, tried, used, options)
        steps.append(step)
        if not further:
            break
        taken += [each.search for each in further]
        state = further[-1]
    return [each for each in taken if all(each is not other for other in searches)], tuple(steps)


def _root(searches: Iterable[Search], data: Prepared) -> Search | None:
    """The best of the simplest that can grow: one lobe, of a law that is a case of another, on a body that has no other
    for a case. Judged on more directions than it was searched on, among which those near the mirror direction abound.
    """
    return min(filter(_can_grow, searches), key=lambda each: rms(_residuals(each, data)[1]), default=None)


def _metal_with_edge(root: Search, searches: Sequence[Search], data: Prepared, options: FitOptions) -> list[Search]:
    """Beside a root with a body, or one of a law that another metal's is better than, the best metal, where it comes
    near, with an edge of its own: a metal of n = 1 has a steeper rise toward grazing than most, which a body or a
    height would be taken for. The root's own edge is grown."""
    return _edges_near(_best(searches) if is_metallic(root.layout.model) else root, root, searches, data, options)


def _edges_near(
    best: Search, root: Search | None, searches: Iterable[Search], data: Prepared, options: FitOptions
) -> list[Search]:
    """The metals that come near the best of them, and near `best`, with an edge of their own, where they gain by it."""
    metals = [each for each in searches if is_metallic(each.layout.model) and each is not root]
    least = min((each.rms for each in metals), default=0.0)
    near = [each for each in metals if each.rms <= min(MAY_BE_BEST * least, MOST_BEHIND * best.rms)]
    sought = [
        Sought(each.model, Given(each.starts, each.levels, metal.rms))
        for metal in near
        for each in edges(metal.layout.model, metal.values)
    ]
    return [each for each in search_all(sought, data, options) if each.rms < BETTER * least]


def _best(searches: Iterable[Search]) -> Search:
    return min(searches, key=lambda each: each.rms)


def _where_nothing_grows(
    searches: Sequence[Search], data: Prepared, options: FitOptions, kind: str | None
) -> list[Search]:
    """A metal with an edge of its own, where a metal of n = 1 leaves more than noise or something else is as bright as
    no dielectric and nobody says that it is one."""
    best, lowest = _best(searches), cross_validation.mirror_from_deg(data.whole)
    if is_metallic(best.layout.model):
        wanted = bool(_shown(best, data))
    else:
        wanted = lowest is not None and lobe_too_bright(best.layout.model, best.values, lowest) is not None
    return _edges_near(best, None, searches, data, options) if wanted and kind != "dielectric" else []


def _can_grow(search: Search) -> bool:
    terms = search.layout.model.terms
    lobes = [term.model for term in terms if term.model.is_lobe]
    plain = not any(term.model.candidacy and term.model.candidacy.contains for term in terms)
    return plain and len(lobes) == 1 and bool(containing(lobes[0]))


def _tried(
    state: State, data: Prepared, options: FitOptions, kind: str | None, known: dict[str, Search]
) -> list[tuple[Extension, Search]]:
    """Every extension of a candidate, followed on few directions; best first."""
    values, channels = int(np.count_nonzero(data.whole.usable)), data.whole.brdf.shape[1]
    tried = {
        candidate_label(each.model): each
        for each in extensions(state.search.layout.model, state.search.values, kind)
        if VALUES_EACH * free_count(each.model, channels, options) <= values
    }
    sought = {
        name: Sought(each.model, Given(each.starts, each.levels, state.search.rms))
        for name, each in tried.items()
        if name not in known
    }
    known |= zip(sought, search_all(tuple(sought.values()), data, options), strict=True)
    again = {  # a lobe that ended at nothing has no slope left to follow
        name: Sought(known[name].layout.model, Given(starts))
        for name in sought
        if (starts := revived(known[name].layout.model, known[name].values))
    }
    for name, found in zip(again, search_all(tuple(again.values()), data, options), strict=True):
        known[name] = min(known[name], found, key=lambda each: each.rms)
    return sorted(((each, known[name]) for name, each in tried.items()), key=lambda each: each[1].rms)


def _chosen(
    state: State, step: Step, tried: list[tuple[Extension, Search]], used: Measurement, options: FitOptions
) -> tuple[list[State], Step]:
    """The step to take last, the simplest of those that hold out about as well as the best; before it the others that
    are better than what there is, which are ranked beside it; nothing where none is.
    """
    better = [each for each in tried if each[1].rms < BETTER * state.search.rms][:FOLLOWED]
    found = cross_validation.held_out_from(
        [(extension.model, search.values) for extension, search in better], used, options
    )
    held = {id(search): each.rms_ln if each else np.inf for (_, search), each in zip(better, found, strict=True)}
    rows = tuple(
        Tried(candidate_label(extension.model), extension.adds, search.rms, held.get(id(search)))
        for extension, search in tried
    )
    step = replace(step, tried=rows)
    least = min(held.values(), default=np.inf)
    if not least < BETTER * state.held_out:
        return [], replace(step, because=_stopped(state, better, least))
    near = [search for _, search in better if held[id(search)] <= ALIKE * least]
    pick = min(near, key=lambda each: (each.layout.count, each.rms))
    taken = State(pick, held[id(pick)])
    because = (
        f"at angles left out it is {_off(taken.held_out)} in place of {_off(state.held_out)}, at all "
        f"{_off(pick.rms)} in place of {_off(state.search.rms)}"
    )
    others = [
        State(each, held[id(each)])
        for _, each in better
        if each is not pick and held[id(each)] < BETTER * state.held_out
    ]
    return [*others, taken], replace(step, taken=taken.name, because=because)


def _stopped(state: State, better: list, least: float) -> str:
    if not better:
        return f"nothing is closer to the data by {100 * (1 - BETTER):.0f} % of its error or more"
    return (
        f"{candidate_label(better[0][0].model)} is closer, {_off(better[0][1].rms)} in place of "
        f"{_off(state.search.rms)}, but nothing is at angles left out: {_off(least)} in place of {_off(state.held_out)}"
    )


def _off(rms_ln: float) -> str:
    """A typical error in words."""
    return f"{100 * np.expm1(rms_ln):.2g} % off"


def _shown(search: Search, data: Prepared) -> str:
    """What the residuals of a candidate show, where they are larger and more alike than noise leaves them; "" where
    they are not.
    """
    surface, residuals = _residuals(search, data)
    few = _few(data)
    correlation, score = standard_errors.serial_correlation(residuals, standard_errors.orderings(few))
    if rms(residuals) < NO_ERROR:
        return ""
    if not standard_errors.discrepancy(residuals, correlation, score) and _may_be_noise(rms(residuals), few, data):
        return ""
    known = np.isfinite(residuals)
    mean = np.where(known, residuals, 0.0).sum(axis=1) / np.maximum(known.sum(axis=1), 1)
    peak = surface.brdf(_in_mirror_direction(few.geom)).mean(axis=1)
    share = surface.brdf(few.geom).mean(axis=1) / np.maximum(peak, 1e-300)
    theta, away = few.geom.theta_i_deg[:, 0], np.degrees(np.arccos(np.clip(_cos_between(few.geom), -1, 1)))
    zones = {
        "its peak near the normal": (share > PEAK) & (theta < LOW_DEG),
        "its peak at middle incidence": (share > PEAK) & (theta >= LOW_DEG) & (theta < HIGH_DEG),
        "its peak toward grazing": (share > PEAK) & (theta >= HIGH_DEG),
        "the shoulder of its lobe": (share > SHOULDER) & (share <= PEAK),
        "what lies far from its lobe": (share <= SHOULDER) & (away >= TOWARD_LIGHT_DEG),
        "what it sends back toward the light": (share <= PEAK) & (away < TOWARD_LIGHT_DEG),
    }
    means = {name: (float(np.mean(mean[rows])), np.count_nonzero(rows)) for name, rows in zones.items() if rows.any()}
    name, (size, _) = max(means.items(), key=lambda each: each[1][0] ** 2 * np.sqrt(each[1][1]))
    return f"{name} is {_percent(size)}"


def _may_be_noise(error: float, few: Measurement, data: Prepared) -> bool:
    """Whether single values may scatter so much. Of directions far apart the misfit of none is like its neighbour's, so
    that its size has to tell; of others that tells."""
    if not few_directions(data.whole):
        return True
    worth, stated = noise.estimated_noise(few), stated_noise(few)
    known = worth.relative is not None or stated > 0
    return error <= (BEYOND * max(worth.expected(few.brdf, few.clear), stated) if known else NOISY)


def _residuals(search: Search, data: Prepared) -> tuple[Surface, np.ndarray]:
    """Where a search ended, and ln(model/data) of it at `_few` directions."""
    few = _few(data)
    layout = replace(search.layout, channels=few.brdf.shape[1])
    surface = layout.surface(*layout.encode(search.values), few)
    return surface, ln_residuals(surface, few)


def _few(data: Prepared) -> Measurement:
    return data.near.measurement.of_channels(few_channels(data.whole.brdf.shape[1]))


def _percent(ln_ratio: float) -> str:
    """A ratio of model to data in words."""
    if ln_ratio > np.log(2):
        return f"{np.exp(ln_ratio):.2g} times too bright"
    return f"{100 * abs(np.expm1(ln_ratio)):.2g} % too {'bright' if ln_ratio > 0 else 'dark'}"


def _in_mirror_direction(geom: Geometry) -> Geometry:
    return Geometry.from_degrees(geom.theta_i_deg, 0.0, geom.theta_i_deg, 180.0, geom.wavelength)


def _cos_between(geom: Geometry) -> np.ndarray:
    """Cosine of the angle between light and detector, (samples,)."""
    return (geom.dot_xy + geom.cos_cos)[:, 0]
