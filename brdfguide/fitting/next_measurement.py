"""Where to measure next: the directions that would best tell tied models apart, or pin the loosest parameter."""

from dataclasses import replace
from itertools import combinations

import numpy as np

from ..data.height_against_width import is_too_high
from ..data.lobe_ellipse import two_azimuths
from ..data.measurement import SMALLEST, Measurement
from ..physics.aperture import Instrument
from ..physics.geometry import Geometry, rows
from ..records import dataclass
from .cross_validation import thinned
from .fit import Fit
from .layout import Layout
from .objective import Misfit, metric
from .ranked import Ranking
from .reading import reading

STEP_DEG = 5.0  # between the directions that may be proposed
LEAST_REACH_DEG = 80.0  # they go up to here, whatever was measured
MOST_REACH_DEG = 85.0  # and no further
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
class Scan:
    """One more scan of the detector in the plane of incidence, angles in degrees, positive on the mirror side."""

    theta_i_deg: float
    theta_r_deg: tuple[float, float]
    step_deg: float
    gain: float  # standard error after over before


@dataclass(frozen=True)
class Next:
    """What one more measurement is for, and where to make it, best first."""

    purpose: str  # separate, pin
    subject: tuple[str, ...]  # the two models, or the parameter
    directions: tuple[Direction, ...]
    scans: tuple[Scan, ...] = ()  # where no single value narrows it much
    turns_deg: tuple[float, ...] = ()  # by which to turn the sample for more scans: its grain is not told

    @property
    def narrows(self) -> bool:
        """Whether a single value is worth the trouble."""
        return self.purpose == "separate" or self.directions[0].gain <= LITTLE


def propose(ranking: Ranking, measurement: Measurement) -> Next:
    """Separates the two tied models that differ most somewhere; pins a parameter where nothing ties or ties are one
    model.

    Every 5 degrees up to the highest measured angle, at least 80; out of the plane of incidence only if the
    instrument has been there. One more value is given the noise of the present ones.
    """
    return replace(_proposed(ranking, measurement), turns_deg=turns_wanted(measurement))


def turns_wanted(measurement: Measurement) -> tuple[float, ...]:
    """By which turns [deg] a sample is to be scanned again: across, and between, of one scan that is too high for its
    width; between, of two."""
    if is_too_high(measurement):
        return (90.0, 45.0)
    two = two_azimuths(measurement)
    return () if two is None else (float(np.degrees(np.mean(two)) % 180),)


def _proposed(ranking: Ranking, measurement: Measurement) -> Next:
    few = thinned(measurement)
    there = Instrument(reachable(measurement), measurement.solid_angle)
    tied = [row.fit for row in ranking.rows if row.tied]
    noise = max(ranking.noise, 1e-4)
    if len(tied) > 1:
        pairs = [(one, other, difference_at(one, other, there) / noise) for one, other in combinations(tied, 2)]
        one, other, gain = max(pairs, key=lambda pair: np.max(pair[2]))
        if np.max(gain) > TELLING:
            return Next("separate", (one.name, other.name), _best(there.geom, gain, -gain))
    known = knowledge(ranking.recommended.fit, few, there)
    left = known.left_by_each()
    found = Next("pin", (known.loosest,), _best(there.geom, left, left))
    return found if found.narrows else replace(found, scans=_best_scans(known, there.geom))


def reachable(measurement: Measurement) -> Geometry:
    """The directions among which to choose, rows of one column."""
    highest = max(
        float(np.max(measurement.geom.theta_i_deg)), float(np.max(measurement.geom.theta_r_deg)), LEAST_REACH_DEG
    )
    angles = np.arange(STEP_DEG, min(highest, MOST_REACH_DEG) + 1e-6, STEP_DEG)
    azimuths = np.array([0.0, 180.0]) if measurement.in_plane else np.arange(0.0, 181.0, 15.0)
    geom = rows(Geometry.from_degrees(*np.meshgrid(angles, 0.0, np.r_[0.0, angles], azimuths, indexing="ij")))
    between = np.degrees(np.arccos(np.clip(geom.dot_xy + geom.cos_cos, -1, 1)))[:, 0]
    return geom[between >= SHADOW_DEG]


@dataclass(frozen=True, eq=False)
class Knowledge:
    """What a fit's data leave open of its parameters, in its coordinates, and what values elsewhere would tell."""

    keys: tuple[str, ...]  # of the parameters (p,)
    size: np.ndarray  # (p,), by which a standard error is loose or not
    covariance: np.ndarray  # (p, p), none wider than its bounds
    ahead: np.ndarray  # (directions, channels, p) of ∂ ln f/∂u
    noise: float  # of ln f, the rms of the fit's residuals

    @property
    def place(self) -> int:
        return int(np.argmax(np.sqrt(np.diag(self.covariance)) / self.size))

    @property
    def loosest(self) -> str:
        """The parameter that is known least."""
        return self.keys[self.place]

    def left_by_each(self) -> np.ndarray:
        """(directions,): standard error of the loosest parameter after a value there over that before.

        C' = C - C Jᵀ (s² + J C Jᵀ)⁻¹ J C,   J all channels at once
        """
        coupling = self.ahead @ self.covariance
        inside = coupling @ np.swapaxes(self.ahead, 1, 2) + self.noise**2 * np.eye(self.ahead.shape[1])
        gained = np.einsum("dcp,dcp->dp", coupling, np.linalg.solve(inside, coupling))
        place = self.place
        return np.sqrt(np.maximum(1 - gained[:, place] / self.covariance[place, place], 0.0))

    def with_values(self, rows) -> "Knowledge":
        """The same once values at these directions are known as well."""
        ahead = self.ahead[rows].reshape(-1, len(self.keys))
        information = np.linalg.inv(self.covariance) + ahead.T @ ahead / self.noise**2
        return replace(self, covariance=np.linalg.inv(information))


def knowledge(fit: Fit, measurement: Measurement, there: Instrument) -> Knowledge:
    """What `measurement`, thinned, leaves open of a fit's parameters, and what values at `there` would tell."""
    surface = fit.thinned
    layout = Layout(fit.model, measurement.brdf.shape[1])
    noise = max(float(np.sqrt(np.nanmean(fit.residuals**2))), 1e-4)
    geom = there.geom.at(measurement.geom.wavelength)
    expected = Measurement(geom, reading(surface, there), measurement.channels, solid_angle=there.solid_angle)
    measured, ahead = (
        _dense(*Misfit(layout, each, metric("ln"), np.ones_like(each.brdf))(*layout.encode(surface.values), True)[1:])
        for each in (measurement, expected)
    )
    shared, per_channel = (np.subtract(*layout.bounds(keys)[::-1]) for keys in (layout.shared, layout.per_channel))
    span = np.r_[shared, np.tile(per_channel, layout.channels)]
    covariance = np.linalg.inv(np.einsum("csp,csq->pq", measured, measured) / noise**2 + np.diag(1 / span**2))
    keys = (*layout.shared, *(layout.per_channel * layout.channels))
    size = np.array(
        [1.0 if layout.parameters[key].log else max(float(np.mean(np.abs(surface.values[key]))), 1e-3) for key in keys]
    )
    return Knowledge(keys, size, covariance, np.swapaxes(ahead, 0, 1), noise)


def shrinkage(fit: Fit, measurement: Measurement, there: Instrument) -> tuple[str, np.ndarray]:
    """The loosest parameter of a fit, and its standard error after a value at each direction over that before."""
    known = knowledge(fit, measurement, there)
    return known.loosest, known.left_by_each()


def _best_scans(known: Knowledge, geom: Geometry) -> tuple[Scan, ...]:
    """Whole scans in the plane of incidence that narrow the loosest parameter most, best first, apart in incidence."""
    before = known.covariance[known.place, known.place]
    flat, theta_i, scans = geom.off_plane_deg[:, 0] < 0.1, np.round(geom.theta_i_deg[:, 0], 1), []
    for theta in np.unique(theta_i[flat]):
        rows = np.flatnonzero(flat & (theta_i == theta))
        after = known.with_values(rows).covariance[known.place, known.place]
        reached = geom.signed_theta_r_deg[rows, 0]
        ends = float(reached.min()), float(reached.max())
        scans.append(Scan(float(theta), ends, STEP_DEG, float(np.sqrt(after / before))))
    best: list[Scan] = []
    for scan in sorted(scans, key=lambda each: each.gain):
        if all(abs(scan.theta_i_deg - other.theta_i_deg) >= APART_DEG for other in best):
            best.append(scan)
    return tuple(best[:PROPOSALS])


def _dense(shared, per_channel) -> np.ndarray:
    """(channels, samples, p) and (channels, samples, q) as (channels, samples, p + channels q)."""
    channels, samples, each = per_channel.shape
    out = np.zeros((channels, samples, shared.shape[2] + channels * each))
    out[:, :, : shared.shape[2]] = shared
    for channel in range(channels):
        start = shared.shape[2] + channel * each
        out[channel, :, start : start + each] = per_channel[channel]
    return out


def difference_at(one: Fit, other: Fit, there: Instrument) -> np.ndarray:
    """|ln ratio| of two fitted models at each direction, rms over the channels that `thinned` leaves."""
    logs = [np.log(np.maximum(reading(fit.thinned, there), SMALLEST)) for fit in (one, other)]
    return np.sqrt(np.mean((logs[0] - logs[1]) ** 2, axis=1))


def _best(geom: Geometry, gain, order) -> tuple[Direction, ...]:
    """The first few by `order` that lie apart in either direction."""
    angles = np.concatenate((geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg), axis=1)
    picked: list[int] = []
    for place in np.argsort(order, kind="stable"):
        if all(np.max(np.abs(angles[place, :2] - angles[other, :2])) >= APART_DEG for other in picked):
            picked.append(int(place))
        if len(picked) == PROPOSALS:
            break
    return tuple(Direction(*map(float, (*angles[place], gain[place]))) for place in picked)
