"""What the figures and the terminal draw of a ranking: which models, which directions, which channel. Loads no plotting library."""

from dataclasses import dataclass

import numpy as np

from .. import predict
from ..geometry import in_plane, rows
from ..measurement import Measurement

NOMINAL_UM = 0.55  # the wavelength the report shows
FAMILIES = ("he-torrance", "phong", "ward", "lafortune")  # the report's four, drawn beside the best
MOST_LINES = 5
# (azimuth off the plane, spread of theta_i) [deg]: as narrow a slice of the data as still has points in it
SLICES = ((0.1, 0.05), (2.0, 0.5), (5.0, 2.5), (10.0, 5.0))
LEAST_POINTS = 5


@dataclass(frozen=True)
class Line:
    """A fitted model as the figures need it."""

    name: str
    model: object
    values: dict
    rms_ln: float | None
    ns: float | None = None
    on_front: bool = False
    recommended: bool = False


def lines_of(ranking) -> list[Line]:
    """Every row of a Ranking, best first."""
    pick = getattr(ranking, "recommended", None)
    return [Line(r.fit.name, r.fit.model, r.fit.values, r.rms_ln, r.ns_per_sample, r.on_front, r is pick) for r in ranking.rows]


def chosen(lines: list[Line]) -> list[Line]:
    """The best, the recommended, and the best of the report's families: more lines than that cannot be told apart."""
    if len(lines) <= MOST_LINES:
        return list(lines)
    wanted = [lines[0].name] + [line.name for line in lines if line.recommended]
    for family in FAMILIES:
        words = lambda line: {word.partition(":")[0] for word in line.name.split("+")}  # noqa: E731
        wanted += [line.name for line in lines if family in words(line)][:1]
    wanted = list(dict.fromkeys(wanted))[:MOST_LINES]
    return [line for line in lines if line.name in wanted]


def nominal_channel(measurement: Measurement) -> int:
    """The channel nearest 550 nm among those with values."""
    wavelength = np.broadcast_to(measurement.geom.wavelength, (len(measurement.channels),))
    filled = measurement.usable.any(axis=0)
    return int(np.argmin(np.where(filled, np.abs(wavelength - NOMINAL_UM), np.inf)))


def slices(measurement: Measurement, channel: int, most: int = 3) -> tuple[list[tuple[float, np.ndarray]], tuple[float, float]]:
    """Well-spread incidence angles with their rows in or near the plane of incidence, and how near."""
    theta_i = measurement.geom.theta_i_deg[:, 0]
    off, usable = measurement.geom.off_plane_deg[:, 0], measurement.usable[:, channel]
    found = []
    for off_plane, spread in SLICES:
        near = usable & (off <= off_plane)
        centres = np.unique(np.round(theta_i[near], 1))
        taken = [(float(c), np.flatnonzero(near & (np.abs(theta_i - c) <= spread))) for c in centres]
        found = [(c, picked) for c, picked in taken if picked.size >= LEAST_POINTS]
        if len(found) >= min(most, np.unique(np.round(theta_i[usable] / 5)).size):
            break
    angles = np.array([c for c, _ in found])
    wanted = np.linspace(angles.min(), angles.max(), min(most, len(found))) if found else []
    places = sorted({int(np.argmin(np.abs(angles - target))) for target in wanted})
    return [found[place] for place in places], (off_plane, spread)


def at_channel(values: dict, channel: int) -> dict:
    """Scalars, of parameters that have one value per channel."""
    return {key: np.asarray(v)[channel] if np.ndim(v) else v for key, v in values.items()}


def curve(line: Line, theta_i: float, theta_r, wavelength, channel: int, solid_angle=None) -> np.ndarray:
    """The model in the plane of incidence; with its mirror part where the detector's solid angle is known."""
    return seen(line, rows(in_plane(theta_i, theta_r, np.array([wavelength]))), channel, solid_angle)


def seen(line: Line, geom, channel: int, solid_angle=None) -> np.ndarray:
    """What the model gives, as the detector reads it, in one channel (samples,)."""
    values = at_channel(line.values, channel)
    if solid_angle is None:
        return line.model(geom, values)[:, 0]
    return predict.reading(line.model, geom, values, solid_angle)[:, 0]
