"""What data in the plane of incidence cost: how far off their law is expected to be elsewhere.

    error² = (a error_in)² + (b doubt)²

error_in, what the recommended law misses in the plane; doubt, what its parameters' standard errors are worth outside. a
and b were found on made surfaces, none of them a law's exactly (benchmarks/off_plane_price.py), and hold for values
with the noise of those in the plane. Where another law ties in the plane and parts from it outside, one of the two is
wrong there by as much as they part: then that is told beside it, with the directions.
"""

from dataclasses import dataclass

import numpy as np

from ..data.measurement import Measurement
from ..models.surface import Surface
from ..physics.aperture import Instrument
from ..physics.geometry import Geometry
from .cross_validation import thinned
from .goniometer import hemisphere
from .next_measurement import knowledge
from .objective import SMALLEST
from .ranked import Ranking
from .reading import reading

IN_PLANE, DOUBT = 0.96, 3.0
OFF_DEG = 10.0  # from the plane of incidence, beyond which a direction lies outside
NEAR = 1.25  # times the best error, up to which a law is a rival
MOST_RIVALS = 5
PARTS = 0.1  # ln, by which a rival parts from the recommended law outside more than inside: 10 % (ours)
FAR = 3  # directions named where they part most


@dataclass(frozen=True)
class Apart:
    """A law that ties in the plane and parts outside it, and where it does so most, angles in degrees."""

    name: str
    rms_ln: float
    then: float  # rms of ln that is expected of the recommended law if this one is right
    at: tuple[tuple[float, ...], ...]  # theta_i, theta_r, phi (mirror at 180), ln(rival/recommended)


@dataclass(frozen=True)
class Price:
    """The expected error outside the plane of incidence, rms of ln, what it rests on, and ties that would change it."""

    rms_ln: float
    in_plane: float
    spread: float
    doubt: float
    apart: tuple[Apart, ...] = ()


def off_plane_price(ranking: Ranking, measurement: Measurement) -> Price | None:
    """The price of the recommended law; None for data that leave the plane of incidence."""
    if not measurement.in_plane or len(measurement.brdf) < 4:
        return None
    there, weights = outside_plane(measurement)
    best = ranking.recommended.fit
    chosen = _ln(best.surface, there)
    rivals = [
        row for row in ranking.rows if row.fit is not best and (row.tied or row.rms_ln <= NEAR * ranking.rows[0].rms_ln)
    ][:MOST_RIVALS]
    differences = {row.fit.name: _ln(row.fit.surface, there) - chosen for row in rivals}
    spread = float(np.median([np.sqrt(weights @ each**2) for each in differences.values()])) if rivals else 0.0
    known = knowledge(best, thinned(measurement), there)
    variance = np.einsum("dcp,pq,dcq->d", known.ahead, known.covariance, known.ahead) / known.ahead.shape[1]
    doubt = float(np.sqrt(weights @ np.minimum(variance, 1.0)))
    expected = float(np.hypot(IN_PLANE * ranking.recommended.rms_ln, DOUBT * doubt))
    apart = [_apart(name, each, weights, there.geom, expected) for name, each in differences.items()]
    tied = {row.fit.name for row in rivals if row.tied}
    return Price(
        expected,
        ranking.recommended.rms_ln,
        spread,
        doubt,
        tuple(each for each in apart if each.name in tied and each.rms_ln > PARTS),
    )


def outside_plane(measurement: Measurement) -> tuple[Instrument, np.ndarray]:
    """Directions outside the plane, as far from the normal as the data go, and weights that add up to 1."""
    highest = np.max([measurement.geom.theta_i_deg.max(), measurement.geom.theta_r_deg.max()])
    geom, weights = hemisphere(float(np.clip(highest, 45.0, 80.0)))
    off = geom.off_plane_deg[:, 0] >= OFF_DEG
    geom = geom[off].at(measurement.geom.wavelength)
    return Instrument(geom, measurement.solid_angle), weights[off] / weights[off].sum()


def _ln(surface: Surface, there: Instrument) -> np.ndarray:
    """ln of what the instrument reads, mean over the channels, (directions,)."""
    return np.mean(np.log(np.maximum(reading(surface, there), SMALLEST)), axis=1)


def _apart(name: str, difference: np.ndarray, weights: np.ndarray, geom: Geometry, expected: float) -> Apart:
    order = np.argsort(-np.abs(difference), kind="stable")[:FAR]
    angles = np.concatenate([geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg], axis=1)
    places = tuple((*np.round(angles[row], 1).tolist(), float(difference[row])) for row in order)
    parts = float(np.sqrt(weights @ difference**2))
    return Apart(name, parts, float(np.hypot(expected, parts)), places)
