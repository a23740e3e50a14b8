"""Which picture to take next: the phase at which a photograph would best tell tied models apart, or pin a parameter."""

from itertools import combinations

import numpy as np

from ..data.measurement import Measurement
from ..physics.aperture import Instrument
from ..physics.directions import Directions
from ..physics.geometry import Geometry, rows
from ..records import dataclass
from .cross_validation import thinned
from .next_measurement import APART_DEG, PROPOSALS, TELLING, difference_at, shrinkage
from .ranked import Ranking

PHASES_DEG = np.arange(10.0, 141.0, 10.0)  # beyond, hardly a crescent is lit
THETA_MAX_DEG = 78.0  # of the points of the ball that are used
SAME_DEG = 5.0  # between difference angles: one phase's spread by less, where lamp and camera are near (ours)
TILTS_DEG = (0.5, 80.0)  # of the normals from the half vector, evenly in ln tan θh
RINGS = 14
SPOKES = 16


@dataclass(frozen=True)
class Phase:
    """One more picture, lamp and camera far away."""

    phase_deg: float
    gain: float  # "separate": rms of |ln ratio| over the ball, in noises; "pin": standard error after over before


@dataclass(frozen=True)
class NextPicture:
    """What one more picture is for, and at which phases, best first."""

    purpose: str  # separate, pin
    subject: tuple[str, ...]
    phases: tuple[Phase, ...]


def propose_picture(ranking: Ranking, measurement: Measurement) -> NextPicture:
    """The phases that best separate the two tied models that differ most on a ball.

    Where all values are of one difference angle, any law with the right lobe fits: there the best is separated from the
    first behind it. Where nothing needs telling apart, those that pin the best model's loosest parameter.
    """
    few = thinned(measurement)
    balls = [Instrument(ball(phase), measurement.solid_angle) for phase in PHASES_DEG]
    noise = max(ranking.noise, 1e-4)
    tied = [row.fit for row in ranking.rows if row.tied]
    if _one_difference_angle(measurement):
        tied = tied[:1] + [row.fit for row in ranking.rows if not row.tied][:1]
    best: tuple[float, NextPicture] | None = None
    for one, other in combinations(tied, 2):
        gain = np.array([np.sqrt(np.mean(difference_at(one, other, there) ** 2)) for there in balls]) / noise
        if best is None or gain.max() > best[0]:
            best = float(gain.max()), NextPicture("separate", (one.name, other.name), _best(gain, -gain))
    if best is not None and best[0] > TELLING:
        return best[1]
    found = [shrinkage(ranking.rows[0].fit, few, there) for there in balls]
    left = np.array([_together(each) for _, each in found])
    return NextPicture("pin", (found[0][0],), _best(left, left))


def ball(phase_deg: float) -> Geometry:
    """Directions (n, 1) at points of a ball under a lamp far away, evenly over the lobe; angles up to 78 degrees."""
    low, high = np.log(np.tan(np.radians(TILTS_DEG)))
    steps = np.linspace(low, high, RINGS)
    theta_h, phi_d = np.meshgrid(np.arctan(np.exp(steps)), 2 * np.pi * np.arange(SPOKES) / SPOKES)
    geom = rows(Geometry(Directions.from_half_difference(theta_h, np.radians(phase_deg / 2), phi_d)))
    least = np.cos(np.radians(THETA_MAX_DEG))
    return geom[((geom.cos_i > least) & (geom.cos_r > least))[:, 0]]


def _one_difference_angle(measurement: Measurement) -> bool:
    theta_d = np.degrees(np.arccos(np.minimum(measurement.geom.cos_d, 1.0)))
    return float(np.ptp(theta_d)) < SAME_DEG


def _together(left: np.ndarray) -> float:
    """Standard error left by all the values of a picture, from what each would leave: their information adds."""
    return float(1 / np.sqrt(1 + np.sum(1 / np.maximum(left, 1e-6) ** 2 - 1)))


def _best(gain: np.ndarray, order: np.ndarray) -> tuple[Phase, ...]:
    """The first few by `order` that lie apart."""
    picked: list[int] = []
    for place in np.argsort(order, kind="stable"):
        if all(abs(PHASES_DEG[place] - PHASES_DEG[other]) >= APART_DEG for other in picked):
            picked.append(int(place))
        if len(picked) == PROPOSALS:
            break
    return tuple(Phase(float(PHASES_DEG[place]), float(gain[place])) for place in picked)
