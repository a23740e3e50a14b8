"""Where to begin a fit: every shape of a grid, with the amplitudes that suit it best.

Amplitudes enter linearly, so each shape needs one small non-negative least-squares problem instead of a search.
"""

from collections.abc import Sequence
from itertools import product

import numpy as np

from ..data.lobe_ellipse import lobe_ellipse
from ..data.measurement import SMALLEST, Measurement
from ..data.turning import turn_of_each
from ..formed import formed
from ..models import Composite
from ..numerics.nonnegative import non_negative
from ..physics.geometry import Geometry
from ..records import dataclass
from .layout import Layout

GRID_SAMPLES = 160  # directions on which the grid is judged
MOST_SHAPES = 20_000  # of a sum; beyond, the finer axes are thinned
FAINTEST = 1e-12  # of the largest value: what is darker decides nothing about where to begin
STREAK = 4.5  # length over width, exp(1.5), with which a grain is looked for along each of STREAKS [rad]
STREAKS = (0.0, 0.25 * np.pi, 0.5 * np.pi, 0.75 * np.pi)
SPREAD = 6  # values along a parameter that names no starts of its own


@np.errstate(over="ignore", divide="ignore", invalid="ignore")  # values far from any reflectance
def grid_starts(layout: Layout, measurement: Measurement, count: int = 2) -> list[dict]:
    """The best `count` starts that lie apart on the grid, best first, and that of the brightest parts; values as in
    `Fit.values`.

    Judged by the rms of ln(model/data) over a few hundred well-spread directions, all channels averaged, and by cube
    roots.
    """
    judged = _judged(measurement)
    few, data = judged.few, judged.data
    axes, bases, steps = zip(*(_term_grid(layout, term, judged) for term in layout.model.terms), strict=True)
    places = np.indices([len(axis) for axis in axes]).reshape(len(axes), -1).T
    places = places[_in_order(layout, places)]
    if len(places) > MOST_SHAPES:
        places = places[:: len(places) // MOST_SHAPES + 1]
    columns = np.empty((len(places), len(axes), len(data))).swapaxes(1, 2)  # over the data
    for term, basis in enumerate(bases):
        columns[:, :, term] = basis[places[:, term]]
    fixed, limits = _fixed_and_limits(layout)
    amplitudes = non_negative(columns, fixed, limits)
    ratio = (columns @ amplitudes[:, :, None])[:, :, 0]
    error = np.sqrt(np.mean(np.log(np.maximum(ratio, SMALLEST / data)) ** 2, axis=1))
    along = np.concatenate([each[places[:, term]] for term, each in enumerate(steps)], axis=1)
    picked: list[int] = []
    for candidate in np.argsort(error, kind="stable"):
        if _apart(along, candidate, picked):
            picked.append(int(candidate))
        if len(picked) == count:
            break
    # a narrow lobe without a body falls by decades: every wrong width is far off in ln, and its peak finds it better
    brightest = int(np.argmin((np.cbrt(ratio) - 1) ** 2 @ np.cbrt(data) ** 2))
    if _apart(along, brightest, picked):
        picked.append(brightest)
    starts = [_values(layout.model, axes, places[each], amplitudes[each]) for each in picked]
    starts += [{**starts[0], **grained} for grained in _grains(layout, measurement, starts[0])]
    return amplitudes_by_channel(layout, few, starts)


def _grains(layout: Layout, measurement: Measurement, best: dict) -> list[dict]:
    """Widths and axis of each grain that is searched for: those of the lobe's own ellipse, and a streak along each of
    four axes."""
    if not (layout.walks and layout.grains):
        return []
    ellipse, found = lobe_ellipse(measurement), []
    for grain, keys in layout.grains:
        wide, narrow = grain.widths(*(float(np.mean(best[key])) for key in keys[:2]))
        shapes = [(np.sqrt(wide * narrow), STREAK, axis) for axis in STREAKS]
        if ellipse is not None:
            shapes.insert(0, (np.sqrt(ellipse.alpha_x * ellipse.alpha_y), ellipse.ratio, ellipse.axis))
        for alpha, ratio, axis in shapes:
            widths = grain.values(alpha * ratio**0.5, alpha * ratio**-0.5)
            inside = [
                float(np.clip(value, layout.parameters[key].low, layout.parameters[key].high))
                for key, value in zip(keys, widths, strict=False)
            ]
            found.append(dict(zip(keys, (*inside, axis), strict=True)))
    return found


@dataclass(frozen=True, eq=False)
class _Judged:
    """Few of the directions, on which grids are judged."""

    few: Measurement  # all channels
    geom: Geometry  # of the mean channel
    data: np.ndarray  # its values
    grids: dict  # of each term that was looked at


@formed
def _judged(measurement: Measurement) -> _Judged:
    few = measurement[spread_rows(measurement, GRID_SAMPLES)]
    data, usable = _channel_mean(few)
    data, geom = data[usable], few.geom.at(np.atleast_1d(np.mean(few.geom.wavelength)))[usable]
    return _Judged(few, geom, np.maximum(data, FAINTEST * np.max(data)), {})


def amplitudes_by_channel(layout: Layout, measurement: Measurement, starts: Sequence[dict]) -> list[dict]:
    """The same shapes with the amplitudes that suit each channel by itself."""
    if not starts:
        return []
    terms, (samples, channels) = layout.model.terms, measurement.brdf.shape
    data, usable = _asked(measurement)
    columns = np.empty((len(starts), channels, len(terms), samples)).swapaxes(2, 3)
    for place, term in enumerate(terms):
        unit = {} if _is_fixed(layout, term) else {term.model.amplitude: 1.0}
        of_starts = [{**layout.model.of_term(term, start), **unit} for start in starts]
        together = {name: _in_rows([each[name] for each in of_starts], channels) for name in of_starts[0]}
        columns[:, :, :, place] = term.model(measurement.geom.channels_first, **together) / data.T
    fixed, limits = _fixed_and_limits(layout)
    # where nothing is asked for, the target of 1 must not be missed either
    flat = columns.reshape(-1, samples, len(terms))
    amplitudes = non_negative(flat, fixed, limits, np.concatenate([usable] * len(starts)))
    amplitudes = amplitudes.reshape(len(starts), channels, len(terms))
    # a start of exactly 0 would sit on its bound; where all are 0, a thousandth of what would carry the data by itself
    lowest = 1e-6 * np.max(amplitudes, axis=1)
    alone = 1e-3 / np.maximum(np.mean(columns, axis=(1, 2)), 1e-300)
    lowest = np.where(lowest > 0, lowest, np.minimum(alone, 0.5 * limits))
    amplitudes = np.maximum(amplitudes, lowest[:, None])
    keys = [(place, _amplitude_key(term)) for place, term in enumerate(terms) if not fixed[place]]
    return [
        {**start, **{key: found[:, place].copy() for place, key in keys}}
        for start, found in zip(starts, amplitudes, strict=True)
    ]


def _in_rows(values: list, channels: int):
    """Values of several starts as (starts, channels or 1, 1); a number where all have the same."""
    if not any(map(np.ndim, values)):
        each = [float(value) for value in values]
        return each[0] if len(set(each)) == 1 else np.array(each)[:, None, None]
    return np.stack([np.broadcast_to(value, (channels,)) for value in values])[:, :, None]


@formed
def _asked(measurement: Measurement) -> tuple[np.ndarray, np.ndarray]:
    """The values that amplitudes are to meet (samples, channels), a missing one asks for nothing; and where there are
    any, (channels, samples)."""
    data = np.where(measurement.weighed, measurement.level, np.inf)
    data = np.maximum(data, FAINTEST * np.max(data[measurement.weighed], initial=0.0))
    return data, measurement.weighed.T


def spread_rows(measurement: Measurement, count: int) -> np.ndarray:
    """Row numbers of about `count` directions: every incidence, spread by distance from the mirror direction."""
    if len(measurement.brdf) <= count:
        return np.arange(len(measurement.brdf))
    groups = [rows for rows in _scans(measurement) if len(rows)]
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


def _scans(measurement: Measurement):
    """The rows of each incidence; under each turn of the sample by itself."""
    turns = turn_of_each(measurement.geom)
    for rows in measurement.theta_i_groups.values():
        yield from [rows] if turns is None else (rows[turns[rows] == each] for each in np.unique(turns[rows]))


def _term_grid(layout: Layout, term, judged: _Judged):
    """The shapes of one term [(name, value)...] and its values at unit amplitude over the data, (shapes, samples);
    and which step each takes along each name, (shapes, names); formed once for all sums that hold the law."""
    searched = [p for p in term.model.parameters if term.key(p.name) in layout.parameters and not p.linear]
    names = [p.name for p in searched if p.name not in term.shared]  # what is shared is tried where it belongs
    base = {**term.model.defaults(), **layout.model.of_term(term, layout.model.defaults())}
    base = {name: float(np.mean(value)) for name, value in base.items()}
    if not _is_fixed(layout, term):
        base[term.model.amplitude] = 1.0
    along = tuple(_along(term.model.parameter(name), layout.model.start.get(term.key(name))) for name in names)
    asked = term.model, tuple(names), along, tuple(base.items())
    if asked not in judged.grids:
        grid = list(product(*along))
        at = dict(zip(names, np.array(grid).T, strict=True))  # shapes stand where channels do
        values = np.transpose(term.model(judged.geom, **{**base, **at}))
        values = np.broadcast_to(values, (len(grid), len(judged.geom))) / judged.data
        axes = [{value: step for step, value in enumerate(sorted(set(axis)))} for axis in along]
        steps = [[axis[value] for axis, value in zip(axes, each, strict=True)] for each in grid]
        shapes = [dict(zip(names, each, strict=True)) for each in grid]
        judged.grids[asked] = shapes, values, np.reshape(steps, (len(grid), len(names))).astype(int)
    return judged.grids[asked]


def _along(parameter, start) -> tuple[float, ...]:
    """Values to try along one parameter: its own, or even in its coordinate; and where a guideline would begin."""
    if parameter.starts:
        values = parameter.starts
    elif parameter.log:
        low, high = max(parameter.low - parameter.origin, 1e-4), min(parameter.high - parameter.origin, 1e4)
        values = tuple(parameter.origin + np.geomspace(low, high, SPREAD + 2)[1:-1])
    else:
        values = tuple(np.linspace(parameter.low, parameter.high, SPREAD + 2)[1:-1])
    return values if start is None else tuple(sorted({*values, float(np.mean(start))}))


def _in_order(layout: Layout, places) -> np.ndarray:
    """Which shapes, rows of places along the axes of terms: of lobes that may be exchanged only one order is tried."""
    labels, kept = [term.label for term in layout.model.terms], np.ones(len(places), bool)
    for group in layout.alike:
        kept &= np.all(np.diff(places[:, [labels.index(label) for label in group]], axis=1) >= 0, axis=1)
    return kept


def _fixed_and_limits(layout: Layout) -> tuple[np.ndarray, np.ndarray]:
    """Which terms have no amplitude to solve for, and how high those of the others may be."""
    models = [term.model for term in layout.model.terms]
    limits = [model.parameter(model.amplitude).high if model.amplitude else 1.0 for model in models]
    return np.array([_is_fixed(layout, term) for term in layout.model.terms]), np.array(limits)


def _is_fixed(layout: Layout, term) -> bool:
    """Whether the term has no amplitude to solve for."""
    return _amplitude_key(term) not in layout.parameters


def _amplitude_key(term) -> str:
    """The key of the term's amplitude; of nothing where it has none."""
    return term.key(term.model.amplitude or "")


def _apart(along, one: int, others: list[int]) -> bool:
    """Whether a shape lies more than one grid step from each of others in some parameter."""
    return all(np.abs(along[one] - along[other]).max(initial=0) > 1 for other in others)


def _values(model: Composite, axes, places, amplitudes) -> dict:
    values = model.defaults()
    for term, axis, place, amplitude in zip(model.terms, axes, places, amplitudes, strict=True):
        values.update({term.key(name): float(value) for name, value in axis[place].items()})
        if term.model.amplitude and term.model.parameter(term.model.amplitude).free:
            values[_amplitude_key(term)] = float(amplitude)
    return values


def _channel_mean(measurement: Measurement):
    """Geometric mean over the channels that were measured, (samples,), and where there is any."""
    usable = measurement.weighed
    logs = np.where(usable, np.log(np.where(usable, measurement.level, 1.0)), 0.0)
    count = usable.sum(axis=1)
    return np.exp(logs.sum(axis=1) / np.maximum(count, 1)), count > 0
