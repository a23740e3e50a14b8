"""What the explorer's page knows: surfaces with their knobs, a measurement's points, the contours of emergence."""

from collections.abc import Mapping, Sequence
from dataclasses import field

import numpy as np

from ...data.measurement import Measurement
from ...errors import InputError, NoAnswer
from ...exporters.exporter import ColouredSurface
from ...exporters.live import Live, live
from ...fitting.prepared import prepare
from ...models.model import Parameter
from ...physics import emergence
from ...printable import label
from ...records import dataclass
from .. import render
from ..figures.lines import nominal_channel
from ..figures.panels import panels
from ..toward_light import shines_back
from .shaders import sources, squeezed

ANGLES = np.degrees(np.arccos(np.geomspace(0.65, 0.02, 26)))  # of the contours [deg], even in ln cos
SLOPES = np.geomspace(0.02, 0.5, 24)
MOST_POINTS = 20_000  # directions of a page
DIGITS = 6


@dataclass(frozen=True)
class Turned:
    """A surface of the page, and how sure its numbers are by key, where a fit says."""

    surface: ColouredSurface
    stderr: Mapping[str, float] = field(default_factory=dict)


def explorer_state(shown: Sequence[Turned], measurement: Measurement | None = None) -> dict:
    """The page's knowledge as a document; `twins` are JavaScript and stand beside it, never in it.

    Raises NoAnswer for a law that states no formula or turns with the surface.
    """
    surfaces = [_three_colours(each.surface) for each in shown]
    laws = [_written_out(each) for each in surfaces]
    return {
        "schema": "brdfguide/explorer/1",
        "models": [
            {
                "name": label(each.surface.name, 60),
                "law": surface.model.name,
                "knobs": _knobs(surface, law, each),
                "numbers": law.numbers,
                "back": int(shines_back(surface)),
                "glsl": squeezed(law.glsl),
            }
            for each, surface, law in zip(shown, surfaces, laws, strict=True)
        ],
        "twins": [squeezed(law.javascript) for law in laws],
        "sources": sources(),
        "world": {
            "zenith": render.ZENITH.tolist(),
            "horizon": render.HORIZON.tolist(),
            "ground": render.GROUND.tolist(),
            "sun": render.SUN.tolist(),
            "scale": render.SCALE_HEIGHT,
            "exposure": render.EXPOSURE,
        },
        "lights": {name: render.sun_direction(name).tolist() for name in render.LIGHTS_DEG},
        "table": [render.THETAS, render.ROLLS, render.RINGS, render.SPOKES],
        "contours": _contours() if any(_on_contour(surface) for surface in surfaces) else None,
        "data": None if measurement is None else _points(measurement),
    }


def _written_out(surface: ColouredSurface) -> Live:
    for term in surface.model.terms:
        formula = term.model.formula
        if formula is None or bool(formula.mirror) != (term.model.mirror is not None):
            raise NoAnswer(f"{surface.name}: {term.model.name} states no formula for shaders, so a page cannot turn it")
        if term.model.turns:
            raise NoAnswer(
                f"{surface.name}: {term.model.name} changes as the surface turns, which the page cannot show"
            )
    return live(surface)


def _three_colours(surface: ColouredSurface) -> ColouredSurface:
    """Grey in one channel, or red, green and blue: a spectrum's amplitudes go to sRGB, its shapes to 550 nm's."""
    if len(surface.channels) == 1 or not surface.colour.mixes:
        return surface
    nearest = surface.channel(int(np.argmin(np.abs(surface.wavelengths - emergence.WAVELENGTH))))
    values = dict(nearest.values)
    for term in surface.model.terms:
        key = term.key(term.model.amplitude) if term.model.amplitude else None
        if key and np.size(surface.values.get(key, 0.0)) > 1:
            values[key] = surface.linear(surface.values[key])
    given = {key: value for key, value in values.items() if key in surface.model.parameters}
    return type(surface)(surface.model, given, ("R", "G", "B"), nearest.wavelengths[0], name=surface.name)


def _knobs(surface: ColouredSurface, law: Live, shown: Turned) -> list[dict]:
    given = {**surface.model.defaults(), **surface.model.start, **surface.model.fixed, **surface.values}
    return [
        _knob(key, parameter, given[key], law, shown.stderr.get(key))
        for key, parameter in surface.model.parameters.items()
    ]


def _knob(key: str, parameter: Parameter, value, law: Live, stderr: float | None) -> dict:
    """One number as people read it, with its bounds; inside it is `scale` times that."""
    values = [float(f"{each:.9g}") for each in np.ravel(parameter.outside(np.asarray(value, float)))]
    low, high = float(parameter.outside(parameter.least)), float(parameter.outside(parameter.high))
    return {
        "key": key,
        "id": law.ids[key],
        "unit": parameter.outside_unit,
        "low": min(low, *values),
        "high": max(high, *values),
        "log": parameter.log,
        "origin": parameter.origin,
        "scale": float(parameter.inside(1.0)) if parameter.unit == "rad" else 1.0,
        "linear": parameter.linear,
        "held": key in law.held,
        "minor": not parameter.free,
        "value": values,
        "stderr": None if stderr is None else float(f"{float(parameter.outside(stderr)):.4g}"),
    }


def _on_contour(surface: ColouredSurface) -> bool:
    """Whether a law has a place on a contour: a height and a slope, or facets whose alpha is twice their slope."""
    return any({"sigma", "slope"} <= set(term.keys) or "alpha" in term.keys for term in surface.model.terms)


def _contours() -> dict:
    """ln sigma [um] at 550 nm of `emergence.crossing` over angles and slopes."""
    table = [[round(float(np.log(emergence.crossing(a, s)[0])), 4) for s in SLOPES.tolist()] for a in ANGLES.tolist()]
    return {
        "ln_cos": [round(float(np.log(np.cos(np.radians(each)))), 7) for each in ANGLES],
        "slopes": [float(f"{each:.6g}") for each in SLOPES],
        "ln_sigma": table,
        "wavelength": emergence.WAVELENGTH,
    }


def _points(measurement: Measurement) -> dict:
    """Points of the drawn panels, and every direction that the error is taken over, of the drawn channel.

    Each view of a detector of finite size is a direction of its own. Raises InputError where there is no value.
    """
    if not measurement.usable.any():
        raise InputError(f"{measurement.name or 'the data'}: no positive value above the horizon to show")
    channel = nominal_channel(measurement)
    ready = prepare(measurement)
    part, weights = ready.compared, ready.compared_weights
    rows = np.flatnonzero(part.clear[:, channel])
    every = max(1, -(-len(rows) // MOST_POINTS))
    rows = rows[::every]
    views = [
        [_rounded(geom.cos_i), _rounded(geom.cos_r), _rounded(geom.vxy2), _rounded(_dot(geom)), weight]
        for weight, geom in part[rows].instrument.views
    ]
    beam = part[rows].instrument.beam[:, 0]
    return {
        "file": label(measurement.name.rsplit("/", 1)[-1], 60),
        "channel": label(measurement.channels[channel], 40),
        "place": channel,
        "channels": len(measurement.channels),
        "panels": [
            {"theta_i": each.theta_i, "theta_r": _rounded(each.theta_r), "value": _rounded(each.value)}
            for each in panels(measurement, channel).shown
        ],
        "views": views,
        "beam": _rounded(beam) if np.any(beam) else None,
        "ln": _rounded(part.ln[rows, channel]),
        "weights": None if weights is None else _rounded(np.broadcast_to(weights, part.brdf.shape)[rows, channel]),
        "every": every,
    }


def _dot(geom):
    """i_xy · r_xy."""
    return geom.sin_i * geom.sin_r * np.cos(np.radians(geom.phi_deg))


def _rounded(values) -> list[float]:
    return [float(f"{each:.{DIGITS + 3}g}") for each in np.ravel(values)]
