"""Where to begin a fit: every shape of a grid, with the amplitudes that suit it best.

Amplitudes enter linearly, so each shape needs one small non-negative least-squares problem instead of a search.
"""

from collections.abc import Mapping
from itertools import combinations, product

import numpy as np

from .geometry import once
from .measurement import Measurement
from .misfit import SMALLEST, Layout
from .models import Sum

GRID_SAMPLES = 160  # directions on which the grid is judged
MOST_SHAPES = 20_000  # of a sum; beyond, the finer axes are thinned
FAINTEST = 1e-12  # of the largest value: what is darker decides nothing about where to begin
SPREAD = 6  # values along a parameter that names no starts of its own


@np.errstate(over="ignore", divide="ignore", invalid="ignore")  # values far from any reflectance
def grid_starts(layout: Layout, measurement: Measurement, count: int = 2) -> list[dict]:
    """The best `count` starts that lie apart on the grid, best first, and that of the brightest parts; values as in `Fit.values`.

    Judged by the rms of ln(model/data) over a few hundred well-spread directions, all channels averaged, and by cube roots.
    """
    few, geom, data = _judged(measurement)
    axes, bases = zip(*(_term_grid(layout, term, geom) for term in layout.model.terms))
    shapes = [shape for shape in product(*(range(len(axis)) for axis in axes)) if _in_order(layout, shape)]
    if len(shapes) > MOST_SHAPES:
        shapes = shapes[:: len(shapes) // MOST_SHAPES + 1]
    places = np.array(shapes)
    columns = np.stack([basis[places[:, term]] for term, basis in enumerate(bases)], axis=2)  # (shapes, samples, terms)
    fixed = np.array([_is_fixed(layout, term) for term in layout.model.terms])
    limits = np.array([term.model.parameter(term.model.amplitude).high if term.model.amplitude else 1.0 for term in layout.model.terms])
    amplitudes = non_negative(columns / data[:, None], fixed, limits)
    model = np.einsum("gst,gt->gs", columns, amplitudes)
    error = np.sqrt(np.mean(np.log(np.maximum(model, SMALLEST) / data) ** 2, axis=1))
    picked: list[int] = []
    for candidate in np.argsort(error, kind="stable"):
        if all(np.sum(places[candidate] != places[other]) and _apart(places[candidate], places[other], axes) for other in picked):
            picked.append(int(candidate))
        if len(picked) == count:
            break
    # a narrow lobe without a body falls by decades: every wrong width is far off in ln, and its peak finds it better
    brightest = int(np.argmin(np.sum((np.cbrt(model) - np.cbrt(data)) ** 2, axis=1)))
    if all(_apart(places[brightest], places[other], axes) for other in picked):
        picked.append(brightest)
    return [amplitudes_by_channel(layout, few, _values(layout.model, axes, places[each], amplitudes[each])) for each in picked]


@once
def _judged(measurement: Measurement):
    """Few of the directions: all channels, and the directions and values of the mean channel."""
    few = measurement[spread_rows(measurement, GRID_SAMPLES)]
    data, usable = _channel_mean(few)
    data, geom = data[usable], few.geom.at(np.atleast_1d(np.mean(few.geom.wavelength)))[usable]
    return few, geom, np.maximum(data, FAINTEST * np.max(data))


def amplitudes_by_channel(layout: Layout, measurement: Measurement, values: dict) -> dict:
    """The same shape with the amplitudes that suit each channel by itself."""
    channels = measurement.brdf.shape[1]
    terms = layout.model.terms
    unit = {**values, **{f"{t.label}.{t.model.amplitude}": 1.0 for t in terms if t.model.amplitude and not _is_fixed(layout, t)}}
    shapes = [t.model(measurement.geom, **layout.model.of_term(t, unit)) for t in terms]
    data = np.where(measurement.usable, measurement.brdf, np.inf)  # a missing value asks for nothing
    data = np.maximum(data, FAINTEST * np.max(data[measurement.usable], initial=0.0))
    columns = np.stack([(np.broadcast_to(shape, measurement.brdf.shape) / data).T for shape in shapes], axis=2)
    # where nothing is asked for, the target of 1 must not be missed either
    seen = measurement.usable.T
    fixed = np.array([_is_fixed(layout, term) for term in terms])
    limits = np.array([term.model.parameter(term.model.amplitude).high if term.model.amplitude else 1.0 for term in terms])
    amplitudes = non_negative(columns, fixed, limits, seen)
    # a start of exactly 0 would sit on its bound; where all are 0, a thousandth of what would carry the data by itself
    lowest = 1e-6 * np.max(amplitudes, axis=0)
    lowest = np.where(lowest > 0, lowest, np.minimum(1e-3 / np.maximum(np.mean(columns, axis=(0, 1)), 1e-300), 0.5 * limits))
    for place, term in enumerate(terms):
        if not fixed[place]:
            values[f"{term.label}.{term.model.amplitude}"] = np.maximum(amplitudes[:, place], lowest[place]) * np.ones(channels)
    return values


def spread_rows(measurement: Measurement, count: int) -> np.ndarray:
    """Row numbers of about `count` directions: every incidence angle, spread in order of distance from the mirror direction."""
    if len(measurement.brdf) <= count:
        return np.arange(len(measurement.brdf))
    groups = list(measurement.theta_i_groups.values())
    if len(groups) > count // 8:
        groups = [groups[place] for place in np.linspace(0, len(groups) - 1, count // 8).round().astype(int)]
    share = max(count // len(groups), 4)
    picked = []
    for rows in groups:
        by_distance = rows[np.argsort(measurement.geom.mirror_distance2[rows, 0], kind="stable")]
        # quadratic spacing: dense where lobes are steep
        places = np.unique((np.linspace(0, 1, share) ** 1.5 * (len(rows) - 1)).astype(int))
        picked.append(by_distance[places])
    return np.sort(np.concatenate(picked))


def non_negative(columns: np.ndarray, fixed: np.ndarray, limits: np.ndarray, seen=True) -> np.ndarray:
    """Amplitudes (shapes, terms) in 0..limits that bring columns (shapes, samples, terms) closest to 1 where `seen`; fixed ones stay 1.

    The terms are few, so every subset of them is solved and the best feasible one kept.
    """
    shapes, _, terms = columns.shape
    squares = np.swapaxes(columns, 1, 2) @ columns
    target = np.where(seen, 1 - columns[:, :, fixed].sum(axis=2), 0.0)
    right = np.einsum("gst,gs->gt", columns, target)
    best = np.where(fixed, 1.0, 0.0) * np.ones((shapes, terms))
    best_cost = np.zeros(shapes)
    loose = [term for term in range(terms) if not fixed[term]]
    for size in range(1, len(loose) + 1):
        for subset in combinations(loose, size):
            part = squares[np.ix_(range(shapes), subset, subset)]
            scale = np.sqrt(np.maximum(np.einsum("gtt->gt", part), SMALLEST))
            scaled = part / (scale[:, :, None] * scale[:, None, :]) + 1e-12 * np.eye(size)
            solved = np.linalg.solve(scaled, (right[:, subset] / scale)[:, :, None])[:, :, 0] / scale
            solved = np.minimum(solved, limits[list(subset)])
            cost = np.einsum("gt,gtu,gu->g", solved, part, solved) - 2 * np.einsum("gt,gt->g", right[:, subset], solved)
            better = np.all(solved >= 0, axis=1) & (cost < best_cost)
            best[np.ix_(better, subset)] = solved[better]
            others = [term for term in loose if term not in subset]
            best[np.ix_(better, others)] = 0.0
            best_cost[better] = cost[better]
    return best


def _term_grid(layout: Layout, term, geom):
    """The shapes of one term [(name, value)...] and its values at unit amplitude, (shapes, samples)."""
    names = [p.name for p in term.model.parameters if f"{term.label}.{p.name}" in layout.parameters and not p.linear]
    base = {**term.model.defaults(), **layout.model.of_term(term, layout.model.defaults())}
    base = {name: float(np.mean(value)) for name, value in base.items()}
    if term.model.amplitude and f"{term.label}.{term.model.amplitude}" in layout.parameters:
        base[term.model.amplitude] = 1.0
    grid = list(product(*(_along(term.model.parameter(name), layout.model.start.get(f"{term.label}.{name}")) for name in names)))
    values = term.model(geom, **{**base, **dict(zip(names, np.array(grid).T))})  # shapes stand where channels do
    return [dict(zip(names, each)) for each in grid], np.broadcast_to(values, (len(geom), len(grid))).T


def _along(parameter, start) -> tuple[float, ...]:
    """Values to try along one parameter: its own, or spread evenly in its coordinate; and where a guideline would begin."""
    if parameter.starts:
        values = parameter.starts
    elif parameter.log:
        low, high = max(parameter.low - parameter.origin, 1e-4), min(parameter.high - parameter.origin, 1e4)
        values = tuple(parameter.origin + np.geomspace(low, high, SPREAD + 2)[1:-1])
    else:
        values = tuple(np.linspace(parameter.low, parameter.high, SPREAD + 2)[1:-1])
    return values if start is None else tuple(sorted({*values, float(np.mean(start))}))


def _in_order(layout: Layout, shape) -> bool:
    """Of lobes that may be exchanged only one order is tried."""
    labels = [term.label for term in layout.model.terms]
    alike = [[shape[labels.index(label)] for label in group] for group in layout.alike]
    return all(places == sorted(places) for places in alike)


def _is_fixed(layout: Layout, term) -> bool:
    """Whether the term has no amplitude to solve for."""
    return f"{term.label}.{term.model.amplitude}" not in layout.parameters


def _apart(one, other, axes) -> bool:
    """Whether two shapes lie more than one grid step apart in some parameter."""
    for term, axis in enumerate(axes):
        for name in axis[0]:
            values = sorted({shape[name] for shape in axis})
            if abs(values.index(axis[one[term]][name]) - values.index(axis[other[term]][name])) > 1:
                return True
    return False


def _values(model: Sum, axes, places, amplitudes) -> Mapping:
    values = model.defaults()
    for term, axis, place, amplitude in zip(model.terms, axes, places, amplitudes):
        values.update({f"{term.label}.{name}": float(value) for name, value in axis[place].items()})
        if term.model.amplitude and term.model.parameter(term.model.amplitude).free:
            values[f"{term.label}.{term.model.amplitude}"] = float(amplitude)
    return values


def _channel_mean(measurement: Measurement):
    """Geometric mean over the channels that were measured, (samples,), and where there is any."""
    usable = measurement.usable
    logs = np.where(usable, np.log(np.where(usable, measurement.brdf, 1.0)), 0.0)
    count = usable.sum(axis=1)
    return np.exp(logs.sum(axis=1) / np.maximum(count, 1)), count > 0
