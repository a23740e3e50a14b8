"""Surfaces that may be in front of the instrument: what a plan must be good for before, or after, it was measured."""

from dataclasses import replace

import numpy as np

from ..models import Composite, candidates
from ..models.facts import Facets
from ..models.surface import Surface
from ..records import dataclass
from .layout import Layout, coordinate_bounds, from_coordinate, to_coordinate
from .ranked import Ranking

ALPHAS = (0.02, 0.06, 0.15, 0.35)  # of a surface of which nothing is known: gloss to matt (ours)
BODIES = (0.05, 0.3, 0.7)
METALS = (0.5, 0.9)  # F0
NEAR = 1.5  # times the error of the best, up to which a law may be the right one
MOST_LAWS = 5
AROUND = (-1.0, 0.0, 1.0)  # standard errors from the fitted values
SPAN = 0.15  # of a parameter's range, the most that it is moved
FEW = 16  # directions; what fits fewer may fit nowhere else (ours)
DOUBTED = 5  # one in so many of the surfaces of which nothing is known stays possible after few directions (ours)


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """One channel of a surface that may be the right one, and the parameters that a fit would search for."""

    layout: Layout
    surface: Surface

    @classmethod
    def of(cls, surface: Surface) -> "Hypothesis":
        whole = replace(surface, values={**surface.model.defaults(), **surface.values})
        return cls(Layout(surface.model, 1), whole.middle)


def unknown() -> tuple[Hypothesis, ...]:
    """Every law of the default ranking on surfaces from gloss to matt, from dark to white, and of metal."""
    found = []
    for place, model in enumerate(filter(_has_lobe, candidates.of_kind(None))):
        has_body = any(term.model.is_body for term in model.terms)
        for number, alpha in enumerate(ALPHAS):
            f0 = 0.04 if has_body else METALS[(place + number) % len(METALS)]
            albedo = BODIES[(place + number) % len(BODIES)] if has_body else None
            found.append(Hypothesis.of(Surface(model, _start(model, alpha, f0, albedo))))
    return tuple(found)


def _has_lobe(model: Composite) -> bool:
    return any(term.model.is_lobe and not term.model.is_body for term in model.terms)


def _start(model: Composite, alpha: float, f0: float, albedo: float | None) -> dict:
    """Values for a described surface, one channel."""
    root = np.sqrt(f0)
    index = (1 + root) / (1 - root) if albedo is not None else 1.0
    k = 0.0 if albedo is not None else float(2 * np.sqrt(f0 / (1 - f0)))
    facets = Facets(
        alpha,
        (f0,),
        n=(float(index),),
        k=(k,),
        sigma=0.3,
        slope=alpha / 2,
        albedo=None if albedo is None else (albedo,),
    )
    values = dict(model.defaults())
    for term in model.terms:
        for name, value in term.model.started(facets).items():
            parameter, key = term.model.parameter(name), term.key(name)
            if key not in model.fixed:
                values[key] = float(np.clip(np.ravel(value)[0], parameter.low, parameter.high))
    return values


def after(ranking: Ranking) -> tuple[Hypothesis, ...]:
    """The laws that the data leave, each where it was fitted and a standard error to either side; after fewer than
    `FEW` directions surfaces of which nothing is known beside them."""
    best = ranking.rows[0].rms_ln
    found = []
    for row in [each for each in ranking.rows if each.tied or each.rms_ln <= NEAR * best][:MOST_LAWS]:
        layout = Layout(row.fit.model, 1)
        surface, errors = row.fit.surface.middle, row.fit.stderr
        found += [
            Hypothesis(layout, _moved(surface, layout, errors, step, number)) for number, step in enumerate(AROUND)
        ]
    if np.count_nonzero(np.isfinite(ranking.rows[0].fit.residuals).any(axis=1)) < FEW:
        found += unknown()[::DOUBTED]
    return tuple(found)


def _moved(surface: Surface, layout: Layout, errors, step: float, number: int) -> Surface:
    """Parameters moved by a standard error, in turn up and down."""
    values = dict(surface.values)
    for place, (key, parameter) in enumerate(layout.parameters.items()):
        at = float(to_coordinate(parameter, np.asarray(values[key], float)))
        low, high = (float(end[0]) for end in coordinate_bounds([parameter]))
        error = float(np.median(np.nan_to_num(errors.get(key, 0.0), posinf=1e9)))
        slope = max(abs(float(values[key]) - parameter.origin), 1e-12) if parameter.log else 1.0
        move = step * (1 if (place + number) % 2 else -1) * min(error / slope, SPAN * (high - low))
        values[key] = float(from_coordinate(parameter, np.clip(at + move, low, high)))
    return replace(surface, values=values)
