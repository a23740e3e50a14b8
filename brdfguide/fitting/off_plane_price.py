"""What data in the plane of incidence cost: how far off their law is expected to be elsewhere.

Any of the laws near the best may be the right one, and none is exactly:

    ln data = ln f + J b + δ + noise

J, its derivatives by ln of its parameters; δ, what it misses, smooth in the directions and known from the residuals in
the plane (`numerics.gaussian_process`). The kernel's widths are those that make what laws miss of nine measured tables
most probable (benchmarks/what_laws_miss.py); nothing is fitted to the made surfaces that it is judged by
(benchmarks/off_plane_price.py). Each law foretells the surface outside, and so the error there of the recommended one;
told is the one within 25 % of which it most probably lies, for values with the noise of those in the plane. Laws that
tie in the plane, or may as well be right, and by which the error is another are told beside it.
"""

from functools import lru_cache

import numpy as np

from ..data.measurement import SMALLEST, Measurement
from ..numerics.gaussian_process import Foretold, Places, Weighed, weighed
from ..physics.aperture import Instrument
from ..physics.directions import Directions
from ..physics.geometry import Geometry
from ..records import dataclass
from . import starting_grid
from .cross_validation import thinned_surface
from .fit import Fit
from .goniometer import hemisphere
from .layout import layout_of
from .ln_slopes import ln_with_slopes
from .prepared import few_channels
from .ranked import Ranking, Row
from .reading import reading

OFF_DEG = 10.0  # from the plane of incidence, beyond which a direction lies outside
LEAST_SAMPLES = 4
SAMPLES = 300  # directions in the plane that count
TILT = 0.1  # tan of the half vector's tilt up to which what is missed changes with the tilt, beyond with its logarithm
# of the kernel: asinh(tan tilt/TILT), angle from light to half vector [deg], θi + θr [deg], sin θi sin θr cos φ
WIDTHS = (0.85, 25.0, 200.0, 0.5)
NEAR = 4.0  # times the recommended law's error, up to which another may be right once what it misses is smooth
MOST_LAWS = 12
# Lobes about the mirror direction fit measured surfaces less often (Ngan et al. 2005, "Experimental analysis of BRDF
# models"), and in the plane are often the twins of lobes about the half vector: how probable beforehand
ABOUT_MIRROR = 0.5  # ours
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
    """How probable a law is after the data, and the recommended one's error outside if it is right."""

    name: str
    probability: float
    rms_ln: float


@dataclass(frozen=True)
class Price:
    """The expected error outside the plane of incidence, rms of ln, what it rests on, and laws that would change it."""

    rms_ln: float
    probability: float  # that the law that is right is one by which the error is within 25 % of it
    in_plane: float
    by_law: tuple[IfRight, ...]  # most probable first
    apart: tuple[Apart, ...] = ()


def off_plane_price(ranking: Ranking, measurement: Measurement) -> Price | None:
    """The price of the recommended law; None for data that leave the plane of incidence, and for too few that every
    law is compared with in every channel."""
    if not measurement.in_plane or len(measurement.brdf) < LEAST_SAMPLES:
        return None
    there, weights = outside_plane(measurement)
    laws = _laws(ranking)
    known = _Known.of(measurement, laws, there)
    if len(known.part.brdf) < LEAST_SAMPLES:
        return None
    known_there = [known.weighs(place, row.fit) for place, row in enumerate(laws)]
    best = next(place for place, row in enumerate(laws) if row is ranking.recommended)
    probable = np.array([known.evidence(each) + _beforehand(row) for each, row in zip(known_there, laws, strict=True)])
    probable = np.exp(probable - probable.max())
    probable /= probable.sum()
    count = [place for place, row in enumerate(laws) if probable[place] >= LEAST_PROBABLE or row.tied or place == best]
    said = {place: known.foretells(laws[place].fit, known_there[place]) for place in count}
    then = {place: _rounded(known.error(each, each.ln - said[best].ln, weights)) for place, each in said.items()}
    counted = [IfRight(laws[place].fit.name, _rounded(probable[place]), then[place]) for place in count]
    by_law = tuple(sorted(counted, key=lambda each: -each.probability))
    expected, probability = most_probable(by_law)
    rivals = [
        (place, row)
        for place, row in sorted(enumerate(laws), key=lambda each: -probable[each[0]])
        if place != best and (row.tied or probable[place] >= AS_WELL)
    ]
    ln = {place: known.ln_of(laws[place].fit, said[place], there) for place in (best, *(each[0] for each in rivals))}
    apart = [_apart(row, ln[place] - ln[best], then[place], weights, there) for place, row in rivals]
    told = tuple(each for each in apart if each.rms_ln > PARTS and abs(np.log(each.then / expected)) > WITHIN)
    return Price(expected, probability, ranking.recommended.rms_ln, by_law, told)


def most_probable(by_law: tuple[IfRight, ...]) -> tuple[float, float]:
    """The error of the group of laws, alike within 25 % to one of them, that is most probable: rms over it by
    probability; and how probable it is of all that count."""

    def group(of: IfRight) -> list[IfRight]:
        return [each for each in by_law if abs(np.log(each.rms_ln / of.rms_ln)) <= WITHIN]

    def weight(some) -> float:
        return sum(each.probability for each in some)

    best = max((group(each) for each in by_law), key=weight)
    mean = sum(each.probability * each.rms_ln**2 for each in best) / weight(best)
    return float(np.sqrt(mean)), float(weight(best) / weight(by_law))


def _rounded(number) -> float:
    """To the digits that are the same in every run: the order of sums in linear algebra is not."""
    return float(f"{number:.{DIGITS}g}") if number > 1e-12 else 0.0


def outside_plane(measurement: Measurement) -> tuple[Instrument, np.ndarray]:
    """Directions outside the plane, as far from the normal as the data go, and weights that add up to 1."""
    highest = np.max([measurement.geom.theta_i_deg.max(), measurement.geom.theta_r_deg.max()])
    geom, weights = _outside(float(np.clip(highest, 45.0, 80.0)))
    return Instrument(geom.at(measurement.geom.wavelength), measurement.solid_angle), weights


@lru_cache(maxsize=4)  # the next file's too
def _outside(highest: float) -> tuple[Geometry, np.ndarray]:
    geom, weights = hemisphere(highest)
    off = geom.off_plane_deg[:, 0] >= OFF_DEG
    return geom[off], weights[off] / weights[off].sum()


def places_of_missed(geom: Geometry) -> np.ndarray:
    """(directions, 4): points whose distances say how alike what a law misses is."""
    tilt = np.arcsinh(np.sqrt(geom.tan2_h) / TILT)
    difference = np.degrees(np.arccos(np.minimum(geom.cos_d, 1.0)))
    columns = (tilt, difference, geom.theta_i_deg + geom.theta_r_deg, geom.dot_xy)
    return np.concatenate(columns, axis=1) / np.array(WIDTHS)


def _places_once(to: Directions) -> tuple[np.ndarray, np.ndarray]:
    """Places without those that are alike, as exchanged directions' are, and which of them each direction has."""
    places = places_of_missed(Geometry(to))
    _, first, which = np.unique(np.round(places, 9), axis=0, return_index=True, return_inverse=True)
    return places[first], which.reshape(-1)


def _laws(ranking: Ranking) -> list[Row]:
    """The recommended one, those that tie with the best, and those with least error."""
    best = ranking.recommended
    near = [row for row in ranking.rows if row.rms_ln <= NEAR * best.rms_ln and row is not best]
    return [best, *sorted(near, key=lambda row: (not row.tied, row.rms_ln))[: MOST_LAWS - 1]]


def _beforehand(row: Row) -> float:
    """ln of how probable a law is before the data."""
    return float(np.log(ABOUT_MIRROR)) if any(term.model.about_mirror for term in row.fit.model.terms) else 0.0


@dataclass(frozen=True, eq=False)
class _Said:
    """What one law says of the directions outside: ln f (directions, channels), and what it misses, by channel."""

    ln: np.ndarray
    missed: tuple[Foretold, ...]


@dataclass(frozen=True, eq=False)
class _Known:
    """Few channels and directions in the plane with a value that every law is compared with, and those outside."""

    part: Measurement
    channels: np.ndarray
    inside: Instrument
    there: Instrument
    places: Places
    left: list[np.ndarray]  # by each law, ln(data/model) (directions, channels)

    @classmethod
    def of(cls, measurement: Measurement, laws: list[Row], there: Instrument) -> "_Known":
        rows = np.flatnonzero(measurement.has_value)
        rows = rows[starting_grid.spread_rows(measurement[rows], SAMPLES)]
        part = measurement if len(rows) == len(measurement.brdf) else measurement[rows]
        channels = few_channels(measurement.brdf.shape[1])
        left = [
            -(
                row.fit.residuals[rows]
                if len(row.fit.residuals) == len(measurement.brdf)
                else row.fit.residuals_on(part)
            )[:, channels]
            for row in laws
        ]
        clear = np.all([np.isfinite(each).all(axis=1) for each in left], axis=0)
        part = part if clear.all() else part[clear]
        geom = part.of_channels(channels).geom
        there = Instrument(there.geom.at(geom.wavelength), there.solid_angle)
        places = Places.between(places_of_missed(geom), *there.geom.formed(_places_once))
        return cls(part, channels, Instrument(geom, part.solid_angle), there, places, [each[clear] for each in left])

    def weighs(self, place: int, fit: Fit) -> tuple[Weighed, ...]:
        """What the values say of the law at this place, by channel."""
        _, slopes = ln_with_slopes(layout_of(fit.model, len(self.channels)), thinned_surface(fit), self.inside)
        left = self.left[place]
        return tuple(weighed(self.places, left[:, c], slopes[:, c]) for c in range(len(self.channels)))

    def foretells(self, fit: Fit, known: tuple[Weighed, ...]) -> _Said:
        """What a law says outside, and what it misses there."""
        ln, onward = ln_with_slopes(layout_of(fit.model, len(self.channels)), thinned_surface(fit), self.there)
        return _Said(ln, tuple(each.elsewhere(onward[:, c]) for c, each in enumerate(known)))

    def ln_of(self, fit: Fit, said: _Said, there: Instrument) -> np.ndarray:
        """ln of what the instrument reads outside, mean over all channels, (directions,)."""
        if len(self.channels) == len(fit.surface.channels):
            return np.mean(said.ln, axis=1)
        return np.mean(np.log(np.maximum(reading(fit.surface, there), SMALLEST)), axis=1)

    def evidence(self, known: tuple[Weighed, ...]) -> float:
        """ln of how probable a law makes the values: of one channel, since all tell of the same directions."""
        return float(np.mean([each.evidence for each in known]))

    def error(self, said: _Said, gap: np.ndarray, weights: np.ndarray) -> float:
        """rms of ln of the recommended law outside if this one is right, which lies `gap` above it."""
        squares = [
            (gap[:, channel] + each.mean) ** 2 + each.variance + each.noise for channel, each in enumerate(said.missed)
        ]
        return float(np.sqrt(np.mean(squares, axis=0) @ weights))


def _apart(row: Row, difference: np.ndarray, then: float, weights: np.ndarray, there: Instrument) -> Apart:
    order, geom = np.argsort(-np.abs(difference), kind="stable")[:FAR], there.geom
    angles = np.concatenate([geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg], axis=1)
    places = tuple((*np.round(angles[each], 1).tolist(), float(difference[each])) for each in order)
    return Apart(row.fit.name, float(np.sqrt(weights @ difference**2)), then, places, row.tied)
