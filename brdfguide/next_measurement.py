"""Where to measure next: the directions that would best tell tied models apart, or pin the loosest parameter."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from . import fitting
from .fitting import Fit
from .geometry import Geometry, rows
from .measurement import Measurement
from .misfit import SMALLEST, Layout, Misfit, evaluate, metric, with_slopes
from .ranking import Ranking
from .validation import thinned

STEP_DEG, LEAST_REACH_DEG, MOST_REACH_DEG = 5.0, 80.0, 85.0
SHADOW_DEG = 8.0  # nearer to the light than this the detector stands in its way (ours)
APART_DEG = 15.0  # between two proposals: closer ones would measure nearly the same
PROPOSALS = 3
LITTLE = 0.9  # of the standard error left, beyond which a single value is hardly worth the trouble (ours)
TELLING = 0.5  # noises: models that differ by less everywhere are one model, and no measurement tells them apart (ours)


@dataclass(frozen=True)
class Direction:
    """One more measurement, angles in degrees, mirror direction at phi 180."""

    theta_i_deg: float
    theta_r_deg: float
    phi_deg: float
    gain: float  # "separate": |ln ratio| in standard deviations of one value; "pin": standard error after over before


@dataclass(frozen=True)
class Next:
    """What one more measurement is for, and where to make it, best first."""

    purpose: str  # separate, pin
    subject: tuple[str, ...]  # the two models, or the parameter
    directions: tuple[Direction, ...]

    @property
    def text(self) -> str:
        """One sentence, and a line for each direction."""
        if self.purpose == "separate":
            head = f"to tell {self.subject[0]} from {self.subject[1]}, measure next at"
            gain = lambda value: f"they differ by {value:.2g} times the noise of one value"  # noqa: E731
        else:
            head = f"to pin {self.subject[0]}, measure next at"
            gain = lambda value: f"one value there leaves {100 * value:.3g} % of its standard error"  # noqa: E731
        places = [f"theta_i {each.theta_i_deg:g}, theta_r {each.theta_r_deg:g}, phi {each.phi_deg:g} deg: {gain(each.gain)}" for each in self.directions]
        if self.purpose == "pin" and self.directions[0].gain > LITTLE:
            places.append("no single value narrows it much: repeat whole scans")
        return "\n  ".join([head, *places])


def propose(ranking: Ranking, measurement: Measurement) -> Next:
    """Separates the two tied models that differ most somewhere; pins a parameter where nothing ties or ties are one model.

    Every 5 degrees up to the highest measured angle, at least 80; out of the plane of incidence only if the
    instrument has been there. One more value is given the noise of the present ones.
    """
    few = thinned(measurement)
    geom = reachable(measurement).at(few.geom.wavelength)
    tied = [row.fit for row in ranking.rows if row.tied]
    noise = max(ranking.noise, 1e-4)
    if len(tied) > 1:
        pairs = [(one, other, _difference(one, other, few, geom) / noise) for one, other in combinations(tied, 2)]
        one, other, gain = max(pairs, key=lambda pair: np.max(pair[2]))
        if np.max(gain) > TELLING:
            return Next("separate", (one.name, other.name), _best(geom, gain, -gain))
    key, left = shrinkage(ranking.recommended.fit, few, geom)
    return Next("pin", (key,), _best(geom, left, left))


def reachable(measurement: Measurement) -> Geometry:
    """The directions among which to choose, rows of one column."""
    highest = max(float(np.max(measurement.geom.theta_i_deg)), float(np.max(measurement.geom.theta_r_deg)), LEAST_REACH_DEG)
    angles = np.arange(STEP_DEG, min(highest, MOST_REACH_DEG) + 1e-6, STEP_DEG)
    azimuths = np.array([0.0, 180.0]) if measurement.in_plane else np.arange(0.0, 181.0, 15.0)
    geom = rows(Geometry.from_degrees(*np.meshgrid(angles, 0.0, np.r_[0.0, angles], azimuths, indexing="ij")))
    between = np.degrees(np.arccos(np.clip(geom.dot_xy + geom.cos_cos, -1, 1)))[:, 0]
    return geom[between >= SHADOW_DEG]


def shrinkage(fit: Fit, measurement: Measurement, geom: Geometry) -> tuple[str, np.ndarray]:
    """The loosest parameter of a fit, and its standard error after a value at each direction over that before.

        C' = C - C Jᵀ (s² + J C Jᵀ)⁻¹ J C,   J = ∂ ln f/∂u at the direction, all channels at once

    C is what `measurement` leaves of the parameters, none wider than its bounds; s the rms of the fit's residuals.
    """
    values = _of_channels(fit, measurement)
    layout = Layout(fit.model, measurement.brdf.shape[1])
    noise = max(float(np.sqrt(np.nanmean(fit.residuals**2))), 1e-4)
    misfit = Misfit(layout, measurement, metric("ln"), np.ones_like(measurement.brdf))
    seen = _dense(*misfit(*layout.encode(values), True)[1:])
    span = np.concatenate([np.subtract(*layout.bounds(layout.shared)[::-1]), np.tile(np.subtract(*layout.bounds(layout.own)[::-1]), layout.channels)])
    before = np.linalg.inv(np.einsum("csp,csq->pq", seen, seen) / noise**2 + np.diag(1 / span**2))
    f, slopes = with_slopes(layout, geom, values)
    factor = 1 / np.maximum(f, SMALLEST)
    column = lambda key: np.broadcast_to(slopes[key] * factor, (len(geom), layout.channels)).T  # noqa: E731
    stacks = [np.stack([column(key) for key in keys], axis=2) if keys else np.zeros((layout.channels, len(geom), 0)) for keys in (layout.shared, layout.own)]
    ahead = np.swapaxes(_dense(*stacks), 0, 1)  # (directions, channels, parameters)
    lever = ahead @ before
    inside = lever @ np.swapaxes(ahead, 1, 2) + noise**2 * np.eye(layout.channels)
    gained = np.einsum("dcp,dcp->dp", lever, np.linalg.solve(inside, lever))
    keys = [*layout.shared, *(layout.own * layout.channels)]
    size = np.array([1.0 if layout.parameters[key].log else max(float(np.mean(np.abs(values[key]))), 1e-3) for key in keys])
    loosest = int(np.argmax(np.sqrt(np.diag(before)) / size))
    return keys[loosest], np.sqrt(np.maximum(1 - gained[:, loosest] / before[loosest, loosest], 0.0))


def _dense(shared, own) -> np.ndarray:
    """(channels, samples, p) and (channels, samples, q) as (channels, samples, p + channels q)."""
    channels, samples, each = own.shape
    out = np.zeros((channels, samples, shared.shape[2] + channels * each))
    out[:, :, : shared.shape[2]] = shared
    for channel in range(channels):
        start = shared.shape[2] + channel * each
        out[channel, :, start : start + each] = own[channel]
    return out


def _difference(one: Fit, other: Fit, measurement: Measurement, geom: Geometry) -> np.ndarray:
    """|ln ratio| of two fitted models at each direction, rms over the channels."""
    logs = [np.log(np.maximum(evaluate(fit.model, geom, _of_channels(fit, measurement)), SMALLEST)) for fit in (one, other)]
    return np.sqrt(np.mean((logs[0] - logs[1]) ** 2, axis=1))


def _of_channels(fit: Fit, measurement: Measurement) -> dict:
    """The fitted values of the channels that `thinned` left."""
    picked = fitting.few_channels(fit.residuals.shape[1])
    return {key: value[picked] if np.ndim(value) else value for key, value in fit.values.items()}


def _best(geom: Geometry, gain, order) -> tuple[Direction, ...]:
    """The first few by `order` that lie apart in either direction."""
    angles = np.concatenate((geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg), axis=1)
    picked: list[int] = []
    for place in np.argsort(order, kind="stable"):
        if all(np.max(np.abs(angles[place, :2] - angles[other, :2])) >= APART_DEG for other in picked):
            picked.append(int(place))
        if len(picked) == PROPOSALS:
            break
    return tuple(Direction(*(float(angle) for angle in angles[place]), float(gain[place])) for place in picked)
