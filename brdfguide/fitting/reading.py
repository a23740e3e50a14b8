"""What an instrument reads of a surface: the mean over its aperture, and the mirror beam that falls into it.

    f = Σ w brdf(r_w) + ρ(θi)/(cos θi Ω) where the mirror direction lies in the detector's cone Ω

The only place that says it, so that fits, residuals, curves and reports cannot differ. A point reads no mirror beam.
"""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import TypeGuard

import numpy as np

from ..formed import formed
from ..models.model import Model, Parameter
from ..models.surface import Surface
from ..physics.aperture import Instrument
from ..physics.geometry import Directions, Geometry
from ..records import dataclass
from .layout import Layout, from_coordinate, slope_of_coordinate, to_coordinate

LARGE = 32_768  # directions beyond which blocks and threads pay
THREADS = 2
MOST_KEPT = 1024  # directions of a list whose readings are kept
TOGETHER = 8192  # values up to which the terms of one law are evaluated in one call
STEP = 1e-5  # of a coordinate, for central differences


def reading(surface: Surface, instrument: Instrument) -> np.ndarray:
    """BRDF [1/sr] as the detector reports it, (samples, channels); 0 below the horizon."""
    known = kept_of(surface, instrument)
    if known is not None:
        return known.reading
    if instrument.solid_angle is None:
        return evaluate(surface, instrument.geom)
    total = np.zeros((len(instrument.geom), len(surface.channels)))
    for weight, geom in instrument.views:
        total += weight * evaluate(surface, geom)
    return total + surface.mirror(instrument.geom) * instrument.beam if surface.model.has_mirror else total


def with_slopes(layout: Layout, surface: Surface, instrument: Instrument) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """`reading`, and its derivative with respect to each free coordinate; the mirror beam's by central differences."""
    known = kept_of(surface, instrument)
    if known is not None and known.layout is layout:
        return known.reading, known.slopes
    total, slopes = _with_slopes(layout, surface, instrument)
    return total, layout.walked(slopes, surface.values)


@dataclass(frozen=True, eq=False)
class Kept:
    """What an instrument reads of a surface, and the slopes of that."""

    layout: Layout
    surface: Surface
    reading: np.ndarray  # (samples, channels)
    slopes: dict[str, np.ndarray]


def keep(layout: Layout, surface: Surface, instrument: Instrument) -> Kept | None:
    """`with_slopes`, which answers again for as long as the directions are there; None of long lists."""
    if instrument.geom.shape[0] > MOST_KEPT:
        return None
    found = Kept(layout, surface, *with_slopes(layout, surface, instrument))
    _all_kept(instrument.geom)[id(surface.values), instrument.solid_angle] = found
    return found


@formed
def _all_kept(to: Directions) -> dict[tuple[int, float | None], Kept]:
    """By the identity of the surface's values, which are kept with it, and the solid angle."""
    return {}


def kept_of(surface: Surface, instrument: Instrument) -> Kept | None:
    """What `keep` has of a surface with these very values."""
    if instrument.geom.shape[0] > MOST_KEPT:
        return None
    found = _all_kept(instrument.geom).get((id(surface.values), instrument.solid_angle))
    if found is None or found.surface.model is not surface.model:
        return None
    return found if np.array_equal(found.surface.wavelength, surface.wavelength) else None


def _with_slopes(layout: Layout, surface: Surface, instrument: Instrument) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """The same by the coordinate of each parameter by itself."""
    if instrument.solid_angle is None:
        return _finite_with_slopes(layout, surface, instrument.geom)
    total = np.zeros((len(instrument.geom), len(surface.channels)))
    slopes = {key: np.zeros_like(total) for key in layout.parameters}
    for weight, geom in instrument.views:
        part, part_slopes = _finite_with_slopes(layout, surface, geom)
        total += weight * part
        for key, slope in part_slopes.items():
            slopes[key] += weight * slope
    if not surface.model.has_mirror:
        return total, slopes
    total += surface.mirror(instrument.geom) * instrument.beam
    for key, parameter in layout.parameters.items():
        at = to_coordinate(parameter, np.asarray(surface.values[key], float))
        ends = (surface.with_value(key, from_coordinate(parameter, at + step)) for step in (STEP, -STEP))
        above, below = (end.mirror(instrument.geom) for end in ends)
        slopes[key] += (above - below) / (2 * STEP) * instrument.beam
    return total, slopes


def evaluate(surface: Surface, geom: Geometry) -> np.ndarray:
    """The finite part (samples, channels), in blocks that fit the cache; two threads for a large table."""
    geom, values = geom.at(surface.wavelength), _channels_first(surface.values)
    shape = len(geom), len(surface.channels)
    if len(geom) <= LARGE:
        return np.broadcast_to(surface.model(geom.channels_first, values).T, shape)
    out = np.empty(shape)

    def fill(block) -> None:
        rows, part = block
        out[rows] = surface.model(part.channels_first, values).T

    with ThreadPoolExecutor(THREADS) as pool:
        list(pool.map(fill, geom.blocks()))
    return out


def _finite_with_slopes(layout: Layout, surface: Surface, geom: Geometry) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """The finite part and its derivative with respect to each free coordinate, (samples, channels)."""
    geom = geom.at(surface.wavelength).channels_first
    total, slopes = _terms_with_slopes(layout, _channels_first(surface.values), geom)
    total = np.transpose(total)
    if total.shape[1] != len(surface.channels):  # nothing that tells channels apart
        total = np.broadcast_to(total, (len(total), len(surface.channels)))
    return total, {key: np.transpose(slope) for key, slope in slopes.items()}


def many_with_slopes(layout: Layout, values: Mapping, instrument: Instrument, constant: dict):
    """`reading` and its slopes for many surfaces of one model, at the wavelengths of the instrument's directions.

    Takes  values (surfaces, 1, 1), or (surfaces, channels, 1) where each channel has its own; no mirror beam; a dict
    that keeps from call to call, of one layout and instrument, what no searched value changes.
    Gives  arrays that broadcast to (surfaces, channels, samples).
    """
    if instrument.solid_angle is None:
        return _terms_with_slopes(layout, values, instrument.geom.channels_first, constant)
    total, slopes = 0.0, dict.fromkeys(layout.parameters, 0.0)
    for view, (weight, geom) in enumerate(instrument.views):
        part, part_slopes = _terms_with_slopes(layout, values, geom.channels_first, constant.setdefault(view, {}))
        total = total + weight * part
        slopes = {key: slope + weight * part_slopes[key] for key, slope in slopes.items()}
    return total, slopes


def many(layout: Layout, values: Mapping, instrument: Instrument) -> np.ndarray:
    """The same without slopes, (surfaces, channels, samples)."""
    total = sum(weight * layout.model(geom.channels_first, values) for weight, geom in instrument.views)
    surfaces = max((len(each) for each in values.values() if np.ndim(each) == 3), default=1)
    return np.broadcast_to(total, (surfaces, layout.channels, len(instrument.geom)))


def _terms_with_slopes(layout: Layout, values: Mapping, geom: Geometry, constant: dict | None = None):
    """The finite part and its derivative with respect to each free coordinate, amplitudes taken out of the laws; in
    what directions (1, samples), wavelengths (channels, 1) and values broadcast to.

    A law without an analytic gradient is differenced centrally in the coordinate of its parameter.
    """
    total: np.ndarray | float = 0.0
    slopes: dict[str, np.ndarray] = {}
    evaluated = _of_laws(layout, values, geom) if layout.by_law else {}
    for place, (model, keys, free) in enumerate(layout.by_term):
        of_term = {name: values[key] for name, key in keys.items()}
        amplitude = model.amplitude
        height = of_term.get(amplitude, 1.0)
        unit = {**of_term, amplitude: 1.0} if amplitude else of_term
        wanted = [name for name in free if name != amplitude]
        if constant is not None and not wanted and amplitude in free:
            if place not in constant:
                constant[place] = _shape_and_slopes(model, geom, wanted, unit)
            shape, known = constant[place]
        else:
            shape, known = evaluated.get(place) or _shape_and_slopes(model, geom, wanted, unit)
        total = total + height * shape
        slopes_of_term = {amplitude: shape} if amplitude in free else {}
        for name in wanted:
            parameter = layout.parameters[keys[name]]
            if name in known:
                slopes_of_term[name] = known[name] * (slope_of_coordinate(parameter, of_term[name]) * height)
            else:
                slopes_of_term[name] = height * _difference(model, geom, unit, name, parameter)
        for name, slope in slopes_of_term.items():  # a parameter that terms share has a slope through each of them
            slopes[keys[name]] = slopes[keys[name]] + slope if keys[name] in slopes else slope
    return total, slopes


def _of_laws(layout: Layout, values: Mapping, geom: Geometry) -> dict[int, tuple[np.ndarray, dict]]:
    """Values at unit amplitude and known slopes of terms of one law, of many surfaces, in one call."""
    found = {}
    for places in layout.by_law:
        model, _, free = layout.by_term[places[0]]
        terms = [
            {name: 1.0 if name == model.amplitude else values[key] for name, key in layout.by_term[place][1].items()}
            for place in places
        ]
        surfaces = {len(each) for term in terms for each in term.values() if _of_many(each)}
        count = max(surfaces, default=0)
        if len(surfaces) != 1 or len(terms) * count * geom.shape[-1] > TOGETHER:
            continue
        unit = {name: _stacked(terms, name, count) for name in terms[0]}
        shape, known = _shape_and_slopes(model, geom, [name for name in free if name != model.amplitude], unit)
        for turn, place in enumerate(places):
            part = slice(turn * count, (turn + 1) * count)
            parts = [
                each[part] if _of_many(each) and len(each) == count * len(terms) else each
                for each in (shape, *known.values())
            ]
            found[place] = parts[0], dict(zip(known, parts[1:], strict=True))
    return found


def _of_many(value) -> TypeGuard[np.ndarray]:
    """Whether a value is that of many surfaces, (surfaces, ., .)."""
    return isinstance(value, np.ndarray) and value.ndim == 3


def _stacked(terms: list[dict], name: str, surfaces: int):
    """The values of a parameter of several terms one after another; a number where it is the same of all."""
    each = [term[name] for term in terms]
    if all(map(_of_many, each)) and len({value.shape for value in each}) == 1:
        return np.concatenate(each)
    if not any(map(np.ndim, each)) and len(set(map(float, each))) == 1:
        return each[0]
    channels = max(np.shape(value)[1] if np.ndim(value) == 3 else 1 for value in each)
    return np.concatenate([np.broadcast_to(value, (surfaces, channels, 1)) for value in each])


def _shape_and_slopes(model: Model, geom: Geometry, wanted: list[str], unit: Mapping) -> tuple[np.ndarray, dict]:
    known = model.gradient(geom, wanted, **unit) if model.gradient and wanted else {}
    return known[model.amplitude] if model.amplitude in known else model(geom, **unit), known


def _channels_first(values: Mapping) -> dict:
    """Values of each channel (channels,) as (channels, 1), to go with `Geometry.channels_first`."""
    return {key: np.reshape(value, (-1, 1)) if np.ndim(value) else value for key, value in values.items()}


def _difference(model, geom: Geometry, values: dict, name: str, parameter: Parameter):
    """Central difference in the coordinate, one-sided at a bound."""
    at = to_coordinate(parameter, np.asarray(values[name], float))
    low, high = to_coordinate(parameter, parameter.low), to_coordinate(parameter, parameter.high)
    above, below = np.minimum(at + STEP, high), np.maximum(at - STEP, low)
    if np.ndim(at) == 3 and len(at) * geom.shape[-1] <= TOGETHER:  # both ends of many surfaces in one call
        count = len(at)
        twice = {key: np.concatenate((each, each)) if np.ndim(each) == 3 else each for key, each in values.items()}
        both = model(geom, **{**twice, name: from_coordinate(parameter, np.concatenate((above, below)))})
        return (both[:count] - both[count:]) / (above - below)
    ends = [model(geom, **{**values, name: from_coordinate(parameter, end)}) for end in (above, below)]
    return (ends[0] - ends[1]) / (above - below)
