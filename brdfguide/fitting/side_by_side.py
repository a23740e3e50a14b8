"""Two surfaces side by side, each a model with values, a table or measured directions: S (`physics.seen`), and where on
the sphere it comes from.
"""

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from ..data.measurement import Measurement
from ..data.seen_weights import seen_weights
from ..errors import InputError
from ..models import looks
from ..models.surface import Surface
from ..physics import seen
from ..physics.aperture import Instrument
from ..physics.geometry import Geometry
from ..records import dataclass

SAME_DEG = 0.05  # between two directions that are one


@dataclass(frozen=True, eq=False)
class OneOfTwo:
    """One of two: its value [1/sr] at an instrument's directions (samples, channels), and what the channels are."""

    name: str
    read: Callable[[Instrument], np.ndarray]
    colours: np.ndarray  # (channels, colours), as `seen.colours` gives them
    turns: bool = False  # whether it changes as it is turned
    measured: Measurement | None = None  # the only directions that it has values at
    solid_angle: float | None = None  # of the detector [sr] that it was measured or fitted through
    through_apertures: bool = False  # whether an aperture changes what is read of it

    def lightness(self, instrument: Instrument) -> np.ndarray:
        """[L*], (samples, colours)."""
        return seen.lightness(self.read(instrument) @ self.colours, instrument.geom.cos_i)


def of_surface(surface: Surface, name: str, solid_angle: float | None = None) -> OneOfTwo:
    """A model with values."""

    def read(instrument: Instrument) -> np.ndarray:
        return looks.instrument_reading(surface, instrument)

    mixture, turned = looks.mixture(surface), looks.turns(surface)
    return OneOfTwo(name, read, mixture, turned, solid_angle=solid_angle, through_apertures=True)


def of_function(function: Callable[[Geometry], np.ndarray], channels: Sequence[str], name: str) -> OneOfTwo:
    """A table that has a value at every direction, NaN where it holds none."""
    um = np.array([_wavelength(channel) for channel in channels])
    return OneOfTwo(name, lambda instrument: function(instrument.geom), seen.colours(channels, um))


def of_measurement(measurement: Measurement, name: str) -> OneOfTwo:
    """Measured directions; between them there is nothing."""
    colours = seen.colours(measurement.channels, measurement.geom.wavelength)
    return OneOfTwo(
        name, lambda instrument: measurement.brdf, colours, measured=measurement, solid_angle=measurement.solid_angle
    )


def _wavelength(channel: str) -> float:
    """[µm] of a channel such as 550nm; of a colour it does not matter."""
    return float(channel.removesuffix("nm")) / 1000 if channel.endswith("nm") else 0.55


@dataclass(frozen=True, eq=False)
class Pair:
    """Lightness of two surfaces on the directions that stand for a sphere."""

    names: tuple[str, str]
    values: tuple[np.ndarray, np.ndarray]  # [1/sr] in colours
    instrument: Instrument
    weights: np.ndarray
    kind: str  # of the weights: quadrature, ring, neighbours

    @cached_property
    def lightness(self) -> tuple[np.ndarray, np.ndarray]:
        """Of each [L*], (samples, colours)."""
        cos_i = self.instrument.geom.cos_i
        return seen.lightness(self.values[0], cos_i), seen.lightness(self.values[1], cos_i)

    @cached_property
    def seen(self) -> float:
        """S [L*]."""
        return seen.apart(*self.lightness, self.weights)

    @cached_property
    def brighter(self) -> np.ndarray:
        """How much lighter the second is at each direction [L*], the mean over colours; NaN where one has no value."""
        return np.mean(self.lightness[1] - self.lightness[0], axis=1)

    @property
    def mean_brighter(self) -> float:
        """How much lighter the second is on average [L*]."""
        counted = np.where(np.isfinite(self.brighter), self.weights, 0.0)
        return float(counted @ np.nan_to_num(self.brighter) / max(counted.sum(), 1e-300))

    @cached_property
    def rms_ln(self) -> float:
        """rms of ln(second/first) over the same directions, all alike; NaN where there is none to compare."""
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = np.log(self.values[1] / self.values[0])[self.weights > 0]
        return float(np.sqrt(np.mean(ratio[np.isfinite(ratio)] ** 2))) if np.isfinite(ratio).any() else float("nan")


def pair(one: OneOfTwo, other: OneOfTwo, solid_angle: float | None = None) -> Pair:
    """Two sides on the sphere, or on the directions that one of them was measured at; read through `solid_angle` [sr],
    or through what a measured one was read through.

    Raises InputError for two measurements at other directions.
    """
    data = [side.measured for side in (one, other) if side.measured is not None]
    if len(data) == 2 and not _alike(data[0].geom, data[1].geom):
        raise InputError(
            f"{one.name} and {other.name} were measured at different directions, and between them there is nothing; "
            "fit one of them and compare its JSON"
        )
    if data:
        solid_angle = solid_angle or one.solid_angle or other.solid_angle
        standing = seen_weights(data[0])
        instrument, weights, kind = Instrument(data[0].geom, solid_angle), standing.of_rows, standing.kind
    else:
        sphere = looks.sphere_for(one.turns or other.turns, solid_angle)
        instrument, weights, kind = Instrument(sphere.geom, solid_angle), sphere.weights, "quadrature"
    values = tuple(side.read(instrument) @ side.colours for side in (one, other))
    return Pair((one.name, other.name), values, instrument, weights, kind)


def seconds_apart(one: Pair, other: Pair) -> float:
    """S [L*] between the seconds of two pairs; NaN where these were taken over different directions."""
    if len(one.weights) != len(other.weights):
        return float("nan")
    return seen.apart(one.lightness[1], other.lightness[1], one.weights)


def _alike(one: Geometry, other: Geometry) -> bool:
    """Whether two measurements have the same directions in the same order."""
    if len(one) != len(other):
        return False
    angles = [(geom.theta_i_deg, geom.theta_r_deg, np.remainder(geom.phi_deg, 360.0)) for geom in (one, other)]
    near = np.cos(np.radians(SAME_DEG))
    theta = all(np.all(np.abs(a - b) < SAME_DEG) for a, b in zip(angles[0][:2], angles[1][:2], strict=True))
    flat = (one.sin_i < 1e-6) | (one.sin_r < 1e-6)  # an azimuth of the normal says nothing
    return theta and bool(np.all(flat | (np.cos(np.radians(angles[0][2] - angles[1][2])) > near)))


# --- where it comes from ---------------------------------------------------------------------------------


@dataclass(frozen=True)
class Part:
    """Some of the directions: what they add to the difference."""

    where: str
    share: float  # of S²
    seen: float  # S of these directions alone [L*]
    brighter: float  # how much lighter the second is, on average [L*]


@dataclass(frozen=True)
class Greatest:
    """The direction where lightness differs most."""

    theta_i_deg: float
    theta_r_deg: float
    phi_deg: float
    brighter: float  # [L*]


@dataclass(frozen=True)
class Middle:
    """Where half of the difference (of S²) lies."""

    within_deg: float  # of the mirror direction
    theta_i_deg: tuple[float, float]  # its middle half
    theta_r_deg: tuple[float, float]


def middle(found: Pair) -> Middle | None:
    """None where nothing differs."""
    squares, geom = _squares(found), found.instrument.geom
    if not squares.sum() > 0:
        return None

    def at(angle, share: float) -> float:
        order = np.argsort(angle)
        below = np.cumsum(squares[order])
        return float(angle[order][np.searchsorted(below, share * below[-1])])

    theta_i, theta_r = geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0]
    return Middle(
        at(from_mirror_deg(geom), 0.5),
        (at(theta_i, 0.25), at(theta_i, 0.75)),
        (at(theta_r, 0.25), at(theta_r, 0.75)),
    )


def from_mirror_deg(geom: Geometry) -> np.ndarray:
    """Angle (samples,) from the mirror direction to the eye [deg]."""
    return np.degrees(2 * np.arcsin(np.minimum(np.sqrt(geom.mirror_distance2) / 2, 1.0)))[:, 0]


def _squares(found: Pair) -> np.ndarray:
    """What each direction adds to S², not normalised."""
    return found.weights * np.nan_to_num(seen.local(*found.lightness)) ** 2


def parts(found: Pair) -> dict[str, list[Part]]:
    """S by distance from the mirror direction, by place on the sphere, and by where the lamp stands."""
    geom = found.instrument.geom
    from_mirror = from_mirror_deg(geom)
    lamp = 2 * np.degrees(np.arccos(np.minimum(geom.cos_d, 1.0)))[:, 0]
    return {
        "from_mirror_direction": _banded(found, from_mirror, (0, 5, 15, 40, 180), "{:g} to {:g} deg from the mirror"),
        "on_the_sphere": _banded(
            found, geom.theta_r_deg[:, 0], (0, 30, 60, 80.001), "{:g} to {:g} deg from its centre"
        ),
        "lamp_from_eye": _banded(found, lamp, (0, 60, 120, 180.001), "lamp {:g} to {:g} deg from the eye"),
    }


def _banded(found: Pair, angle, edges, words: str) -> list[Part]:
    squares = _squares(found)
    counts = np.where(np.isfinite(found.brighter), found.weights, 0.0)
    out = []
    for low, high in zip(edges[:-1], edges[1:], strict=True):
        inside = (angle >= low) & (angle < high)
        weight = float(counts[inside].sum())
        if weight > 0:
            brighter = counts[inside] @ np.nan_to_num(found.brighter)[inside] / weight
            own = float(squares[inside].sum())
            share = own / max(float(squares.sum()), 1e-300)
            out.append(Part(words.format(low, round(high)), share, float(np.sqrt(own / weight)), float(brighter)))
    return out


def greatest(found: Pair) -> Greatest | None:
    """Where, of the directions that count, lightness differs most; None where none does."""
    counted = np.where(found.weights > 0, np.nan_to_num(seen.local(*found.lightness)), 0.0)
    place, geom = int(np.argmax(counted)), found.instrument.geom
    if not counted[place] > 0:
        return None
    phi = float(np.remainder(geom.phi_deg[place, 0], 360.0))
    angles = float(geom.theta_i_deg[place, 0]), float(geom.theta_r_deg[place, 0])
    return Greatest(*angles, phi, float(found.brighter[place]))
