"""From a surface and a target's laws to numbers that may be written, with what they cost.

Where the model's own parameters mean the same in the target they are written as they are; otherwise the target's law
is fitted. The residual is always measured with the rounded numbers that the file holds.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from ..models.model import Composite, Model
from ..physics.geometry import Geometry
from ..records import dataclass
from ._directions import judged_over
from ._refit import Goal, TargetModel, least_of_amplitude, refit, settled_over_many
from ._shown import Shown, beside_mirror, seen_of
from .exporter import EXACT, ColouredSurface, Statement, number, numbers, status_of

FACETS = {"alpha", "n", "k", "scale"}  # parameters of a law whose numbers the targets' own facets may take over
GRAINED = FACETS - {"alpha"} | {"alpha_x", "alpha_y", "axis"}
GOOD = 0.1  # rms ln within which a target is taken to hold a surface
ONE_LOBE = "lobes become one"
SIMPLER = 1.02  # a law with fewer parts is taken if it is no worse than this
NEAR_BEST = 1.3  # a law that is worse than this many times the best over a few directions is not settled over all


@dataclass(frozen=True)
class Choice:
    """The law taken, its numbers as they will be written, and their cost."""

    name: str
    values: dict
    rms_ln: float
    directions: int
    over: str
    brdf: Callable[[Geometry], np.ndarray] | None = None  # the law with these numbers; None where it is a mirror's
    mirror: Callable[[Geometry], np.ndarray] | None = None  # its reflectance at theta_i; None: the surface's own
    spectral: bool = False  # whether its columns are the surface's channels, not colours

    def statement(
        self, target: str, surface: ColouredSurface, *, lost=(), notes=(), mirror: float = 0.0, colour: str = ""
    ) -> Statement:
        """The Statement; `mirror` is the residual of an ideal mirror written beside the law."""
        worst = max(self.rms_ln, mirror)
        status = status_of(worst, lost)
        return Statement(
            target,
            status,
            worst,
            self.directions,
            self.over,
            dict(self.values),
            tuple(lost),
            tuple(notes),
            colour or surface.colour.how,
            *self._seen(surface),
        )

    def _seen(self, surface: ColouredSurface) -> tuple[float | None, Shown | None]:
        """S between the surface and what the numbers show, and that as a function."""
        shown = self.shown(surface)
        return None if shown is None else seen_of(surface, shown), shown

    def shown(self, surface: ColouredSurface) -> Shown | None:
        """What the numbers show in linear sRGB, with a mirror's image; None of a mirror alone."""
        if self.brdf is None:
            return None
        brdf, mixing = self.brdf, surface.colour.matrix.T if self.spectral else np.eye(3)

        def finite(geom: Geometry) -> np.ndarray:
            f = brdf(geom)
            return np.broadcast_to(f, (len(geom), len(mixing))) @ mixing

        return beside_mirror(surface, finite, self.mirror)


def choose(
    surface: ColouredSurface, geom: Geometry | None, targets: Mapping[str, TargetModel], *, spectral: bool = False
) -> Choice:
    """The best of `targets`, simplest first, with parameters rounded as they will be written."""
    geom, wanted, over = judged_over(surface, geom, spectral)
    goal = Goal(geom, wanted)
    return replace(best_of(targets, goal, known_values(surface, spectral), over), spectral=spectral)


def best_of(targets: Mapping[str, TargetModel], goal: Goal, known: Mapping | None, over: str) -> Choice:
    """The same for directions and wanted values that are there already."""
    directions, colours = int(goal.counted.any(axis=1).sum()), goal.wanted.shape[1]
    found: list[Choice] = []
    for name, (target, values) in _worth_settling(targets, goal, known).items():
        written = _written(target, values, colours)
        rms = goal.error(target.at(goal.geom, written))
        if not found or rms * SIMPLER + 1e-9 < found[-1].rms_ln:
            brdf = partial(target.at, values=written)
            found.append(Choice(name, {**target.fixed, **written}, rms, directions, over, brdf))
    return found[-1]


def _worth_settling(
    targets: Mapping[str, TargetModel], goal: Goal, known: Mapping | None
) -> dict[str, tuple[TargetModel, Mapping]]:
    """Laws with the values that come nearest, in order: those that hold a model's own values, and those that come near
    the best of them over a few directions."""
    for name, target in targets.items():
        own = _as_known(target, known, goal) if target.parameters else None
        if own is not None:
            return {name: (target, own)}  # none is better
    bounds = {name: least_of_amplitude(target, goal) for name, target in targets.items()}
    tried: dict[str, tuple[float, Mapping]] = {}
    for name in sorted(targets, key=lambda each: bounds[each] > 0):
        least = min((error for error, _ in tried.values()), default=np.inf)
        if bounds[name] <= NEAR_BEST * least:
            tried[name] = refit(targets[name], goal) if targets[name].parameters else (0.0, {})
    least = min(error for error, _ in tried.values())
    return {
        name: (target, settled_over_many(target, tried[name][1], goal))
        for name, target in targets.items()
        if name in tried and tried[name][0] <= NEAR_BEST * least
    }


def _as_known(target: TargetModel, known: Mapping | None, goal: Goal) -> dict | None:
    """The model's own values, if the law takes exactly these and then equals the model."""
    if known is None:
        return None
    values = {p.name: known.get(p.name) for p in target.parameters}
    if any(
        value is None or np.any(value < p.low) or np.any(value > p.high)
        for p, value in zip(target.parameters, values.values(), strict=True)
    ):
        return None
    return values if goal.error(target.at(goal.geom, values)) <= EXACT / 10 else None


def _written(target: TargetModel, values: Mapping, colours: int) -> dict:
    """Nine digits, within the bounds, per-channel ones for each colour."""
    written: dict[str, np.ndarray | float] = {}
    for p in target.parameters:
        if p.per_channel:
            written[p.name] = np.array(
                numbers(np.broadcast_to(np.ravel(values[p.name]), (colours,)), p.low, p.high, p.name)
            )
        else:
            written[p.name] = number(np.ravel(values[p.name])[0], p.low, p.high, p.name)
    return written


def known_values(surface: ColouredSurface, spectral: bool = False) -> dict | None:
    """albedo, scale, n, k by colour and alpha, or the wider and the narrower of two, of a Lambertian body and at most
    one facet lobe; else None."""
    finite = [term for term in surface.model.terms if not term.model.is_mirror]
    bodies = [term for term in finite if term.model.name == "lambertian"]
    lobes = [term for term in finite if term.model.defaults().keys() in (FACETS, GRAINED)]
    if len(lobes) > 1 or len(bodies) > 1 or len(lobes) + len(bodies) < len(finite):
        return None
    by_colour = (
        (lambda value: np.broadcast_to(np.ravel(value), (len(surface.channels),))) if spectral else surface.linear
    )
    values: dict = {"albedo": by_colour(surface.values_of(bodies[0])["albedo"]) if bodies else by_colour(0.0)}
    values["base_color"] = values["albedo"]  # as shaders call it
    if lobes:
        of_lobe = surface.values_of(lobes[0])
        values["scale"] = by_colour(of_lobe["scale"])
        for name in ("n", "k"):
            values[name] = by_colour(of_lobe[name]) if spectral else surface.nonlinear(of_lobe[name])
        widths = [np.ravel(of_lobe[name]) for name in ("alpha", "alpha_x", "alpha_y") if name in of_lobe]
        if all(np.ptp(each) == 0 for each in widths):
            values["alpha"] = values["alpha_y"] = float(min(each[0] for each in widths))
            values["alpha_x"] = float(max(each[0] for each in widths))
        values["amount"] = 1.0 if not bodies and np.all(values["scale"] == 1) else None
    return values


def fresnel_index(surface: ColouredSurface, spectral: bool = False) -> tuple[np.ndarray, ...] | None:
    """n and k by colour of the one term that has them, if these mean something in the target's colours."""
    owners = [term for term in surface.model.terms if term.model.has_index]
    if not owners:
        return None
    of_term = surface.values_of(owners[0])
    if spectral:
        each = (len(surface.channels),)
        return tuple(np.broadcast_to(np.ravel(of_term[name]), each).astype(float) for name in ("n", "k"))
    n, k = surface.nonlinear(of_term["n"]), surface.nonlinear(of_term["k"])
    return None if n is None or k is None else (n, k)


def in_order_for(surfaces: Sequence[ColouredSurface], lobe: str = "") -> list[ColouredSurface]:
    """Of candidates for one surface, best first, those that keep what the first has: the mirror of a coat over
    something, a body or none, a highlight of some width, a grain, light sent back, a rim of fibres; of these alone
    those whose lobes are the target's own, where it has one alone and there are such."""
    first = surfaces[0].model
    coated = len(first.terms) > 1 and any(term.model.is_mirror or term.model.is_coat for term in first.terms)
    kept = [each for each in surfaces if each.has_mirror] if coated else []
    kept = [each for each in kept or surfaces if _kinds(first) <= _kinds(each.model)] or list(kept or surfaces)
    return [each for each in kept if lobe and _has_lobe_of(each, lobe)] or kept


def _kinds(model: Composite) -> set[str]:
    """What the lobes of a sum are and do."""
    terms = [term.model for term in model.terms]
    has = {
        "body" if any(each.is_body for each in terms) else "no body": True,
        "width": any(each.is_lobe for each in terms),
        "grain": model.turns,
        "sent back": any(each.returns_light for each in terms),
        "fibres": any(each.family == "fabric" for each in terms),
    }
    return {kind for kind, found in has.items() if found}


def _has_lobe_of(surface: ColouredSurface, lobe: str) -> bool:
    """Whether every lobe is of that law, with or without a grain."""
    found = [term.model for term in surface.model.terms if term.model.is_lobe]
    return all((each.base or each).name.removesuffix("-aniso") == lobe for each in found)


def has_body(surface: ColouredSurface) -> bool:
    """Whether a diffuse body may be written: not for a bare interface, a shader set as a metal, or a black body."""
    return any(_may_be_body(term.model, surface.values_of(term)) for term in surface.model.terms)


def _may_be_body(law: Model, values: Mapping) -> bool:
    if "subsurface" not in law.roles or (law.is_body and np.max(values.get("albedo", 1.0)) == 0):
        return False
    metal = law.settings.get("metal")
    defaults = law.defaults()
    return metal is None or any(
        np.any(values[name] != value) for name, value in metal.fixed.items() if value != defaults[name]
    )


def has_lobe(surface: ColouredSurface) -> bool:
    """Whether a lobe may be written: for a lobe, and for a body that is not the same in all directions."""
    finite = [term.model for term in surface.model.terms if not term.model.is_mirror]
    return any(model.is_lobe or any(not p.linear for p in model.parameters) for model in finite)


def what_is_lost(surface: ColouredSurface) -> tuple[str, ...]:
    """Sentences for what a body and one facet lobe cannot hold."""
    lost = []
    lobes = [term for term in surface.model.terms if term.model.is_lobe]
    if len(lobes) > 1:
        lost.append(f"{len(lobes)} {ONE_LOBE}")
    for term in lobes:
        of_term = surface.values_of(term)
        beyond = term.model.beyond_facets(**of_term) if term.model.beyond_facets else ""
        lost += [beyond] if beyond else []
        shapes = [p.name for p in term.model.parameters if not p.per_channel and np.ptp(of_term[p.name]) > 0]
        if shapes:
            lost.append(f"{', '.join(shapes)} differing between channels become one")
    return tuple(lost)
