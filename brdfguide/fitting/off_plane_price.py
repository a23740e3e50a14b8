"""What data in the plane of incidence cost: how far off their law is expected to be elsewhere.

Any of the laws near the best may be the right one, and none is exactly (`missed`). Nothing is fitted to the made
surfaces that the price is judged by (benchmarks/off_plane_price.py). Each law foretells the surface outside, and so the
error there of the recommended one; told is the one within 25 % of which it most probably lies, for values with the
noise of those in the plane. Laws that tie in the plane, or may as well be right, and by which the error is another are
told beside it. Toward grazing, where laws miss most and least evenly, it is a number of its own. Where a channel was
too dark to be read in the plane, its directions outside that are as dark count for nothing: nobody reads them there
either.
"""

from functools import lru_cache

import numpy as np

from ..data.measurement import SMALLEST, Measurement
from ..physics.aperture import Instrument
from ..physics.geometry import Geometry
from ..records import dataclass
from .goniometer import hemisphere
from .missed import LEAST_SAMPLES, LawsOnData, highest_deg, probabilities
from .ranked import Ranking, Row

OFF_DEG = 10.0  # from the plane of incidence, beyond which a direction lies outside
GRAZING_DEG = 130.0  # of θi + θr, beyond which a direction is told apart
NEAR = 4.0  # times the recommended law's error, up to which another may be right once what it misses is smooth
MOST_LAWS = 12
LEAST_PROBABLE = 0.01  # of a law that counts
AS_WELL = 0.05  # probability from which a law that does not tie is told beside
WITHIN = np.log(1.25)  # errors so near are one
PARTS = 0.1  # ln, by which a rival parts from the recommended law outside: 10 % (ours)
DIGITS = 6
FAR = 3  # directions named where they part most


@dataclass(frozen=True)
class Apart:
    """A law by which the error outside is another, and where it parts from the recommended one most, in degrees."""

    name: str
    rms_ln: float
    then: float  # rms of ln that is expected of the recommended law if this one is right
    at: tuple[tuple[float, ...], ...]  # theta_i, theta_r, phi (mirror at 180), ln(rival/recommended)
    ties: bool


@dataclass(frozen=True)
class IfRight:
    """How probable a law is after the data, and the recommended one's error outside if it is right; toward grazing,
    None where no direction is."""

    name: str
    probability: float
    rms_ln: float
    grazing: float | None = None


@dataclass(frozen=True)
class Price:
    """The expected error outside the plane of incidence, rms of ln, what it rests on, and laws that would change it."""

    rms_ln: float
    probability: float  # that the law that is right is one by which the error is within 25 % of it
    in_plane: float
    by_law: tuple[IfRight, ...]  # most probable first
    grazing: float | None  # the same toward grazing, by the same laws; None where no direction is
    apart: tuple[Apart, ...] = ()


def off_plane_price(ranking: Ranking, measurement: Measurement) -> Price | None:
    """The price of the recommended law; None for data that leave the plane of incidence, and for too few that every
    law is compared with in every channel."""
    if not measurement.in_plane or len(measurement.brdf) < LEAST_SAMPLES:
        return None
    there, weights = outside_plane(measurement)
    laws = _laws(ranking)
    known = LawsOnData.of(measurement, laws, there)
    if not known.channels:
        return None
    best = next(place for place, row in enumerate(laws) if row is ranking.recommended)
    said = [known.law(place, row.fit) for place, row in enumerate(laws)]
    weights = known.counted(said[best], weights)
    steep = toward_grazing(there.geom)
    if not np.any(weights[~steep]):
        return None
    probable = probabilities(said, laws)
    by_place = {}
    for place, row in enumerate(laws):
        if probable[place] >= LEAST_PROBABLE or row.tied or place == best:
            squares = known.squares(said[place], said[best])
            grazing = _rms(squares, weights, steep) if np.any(weights[steep]) else None
            by_place[place] = IfRight(row.fit.name, _rounded(probable[place]), _rms(squares, weights, ~steep), grazing)
    by_law = tuple(sorted(by_place.values(), key=lambda each: -each.probability))
    expected, probability, grazing = most_probable(by_law)
    rivals = [
        (place, row)
        for place, row in sorted(enumerate(laws), key=lambda each: -probable[each[0]])
        if place != best and (row.tied or probable[place] >= AS_WELL)
    ]
    seen = np.where(steep, 0.0, weights.min(axis=1))
    ln = {place: known.ln_of(laws[place].fit, said[place], there) for place in (best, *(each[0] for each in rivals))}
    apart = [_apart(row, ln[place] - ln[best], by_place[place].rms_ln, seen, there) for place, row in rivals]
    told = tuple(each for each in apart if each.rms_ln > PARTS and abs(np.log(each.then / expected)) > WITHIN)
    return Price(expected, probability, ranking.recommended.rms_ln, by_law, grazing, told)


def most_probable(by_law: tuple[IfRight, ...]) -> tuple[float, float, float | None]:
    """The error of the group of laws, alike within 25 % to one of them, that is most probable: rms over it by
    probability; how probable it is of all that count; and the group's error toward grazing."""

    def group(of: IfRight) -> list[IfRight]:
        return [each for each in by_law if abs(np.log(each.rms_ln / of.rms_ln)) <= WITHIN]

    def weight(some) -> float:
        return sum(each.probability for each in some)

    best = max((group(each) for each in by_law), key=weight)
    mean = sum(each.probability * each.rms_ln**2 for each in best) / weight(best)
    steep = [each.probability * each.grazing**2 for each in best if each.grazing is not None]
    grazing = float(np.sqrt(sum(steep) / weight(best))) if steep else None
    return float(np.sqrt(mean)), float(weight(best) / weight(by_law)), grazing


def _rms(squares: np.ndarray, weights: np.ndarray, here: np.ndarray) -> float:
    """Over the directions that are asked for, in all channels."""
    return _rounded(np.sqrt(np.sum(weights[here] * squares[here]) / np.sum(weights[here])))


def _rounded(number) -> float:
    """To the digits that are the same in every run: the order of sums in linear algebra is not."""
    return float(f"{number:.{DIGITS}g}") if number > 1e-12 else 0.0


def outside_plane(measurement: Measurement) -> tuple[Instrument, np.ndarray]:
    """Directions outside the plane, as far from the normal as the data go, and weights that add up to 1."""
    geom, weights = _outside(highest_deg(measurement))
    return Instrument(geom.at(measurement.geom.wavelength), measurement.solid_angle), weights


@lru_cache(maxsize=4)  # the next file's too
def _outside(highest: float) -> tuple[Geometry, np.ndarray]:
    geom, weights = hemisphere(highest)
    off = geom.off_plane_deg[:, 0] >= OFF_DEG
    return geom[off], weights[off] / weights[off].sum()


def toward_grazing(geom: Geometry) -> np.ndarray:
    """(directions,): whether both angles add up to more than what is told as one."""
    return (geom.theta_i_deg + geom.theta_r_deg)[:, 0] > GRAZING_DEG


def _laws(ranking: Ranking) -> list[Row]:
    """The recommended one, those that tie with the best, and those with least error."""
    best = ranking.recommended
    near = [row for row in ranking.rows if row.rms_ln <= NEAR * best.rms_ln and row is not best]
    return [best, *sorted(near, key=lambda row: (not row.tied, row.rms_ln))[: MOST_LAWS - 1]]


def _apart(row: Row, difference: np.ndarray, then: float, weights: np.ndarray, there: Instrument) -> Apart:
    order, geom = np.argsort(-np.abs(difference) * (weights > 0), kind="stable")[:FAR], there.geom
    angles = np.concatenate([geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg], axis=1)
    places = tuple((*np.round(angles[each], 1).tolist(), float(difference[each])) for each in order)
    rms = np.sqrt(weights @ difference**2 / max(weights.sum(), SMALLEST))
    return Apart(row.fit.name, float(rms), then, places, row.tied)
