"""What data in the plane of incidence cost: how far off their law is expected to be elsewhere.

Any of the laws near the best may be the right one, and none is exactly:

    ln data = ln f + J b + δ + noise

J, its derivatives by ln of its parameters; δ, what it misses, smooth in the directions and known from the residuals in
the plane (`numerics.gaussian_process`). The kernel's widths are those that make what laws miss of nine measured tables
most probable (benchmarks/what_laws_miss.py); how large δ is beforehand, and how far a parameter that the plane leaves
loose moves the surface outside, are those by which scans taken of these tables foretell their rest
(benchmarks/off_plane_tables.py). Nothing is fitted to the made surfaces that it is judged by as well
(benchmarks/off_plane_price.py). Each law foretells the surface outside, and so the error there of the recommended one;
told is the one within 25 % of which it most probably lies, for values with the noise of those in the plane. Laws that
tie in the plane, or may as well be right, and by which the error is another are told beside it. Toward grazing, where
laws miss most and least evenly, it is a number of its own. Where a channel was too dark to be read in the plane, its
directions outside that are as dark count for nothing: nobody reads them there either.
"""

from functools import lru_cache

import numpy as np

from ..data.measurement import SMALLEST, Measurement
from ..numerics.gaussian_process import Places, Weighed, weighed
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
GRAZING_DEG = 130.0  # of θi + θr, beyond which a direction is told apart
MISSED = 0.05  # ln, how large what a law misses usually is
MOVES = 0.1  # ln, rms over the directions outside: how far one parameter usually moves the surface from the fitted one
DARKEST = 0.5  # of the least value in a channel that was too dark elsewhere: what is darker cannot be read
NEAR = 4.0  # times the recommended law's error, up to which another may be right once what it misses is smooth
MOST_LAWS = 12
# Lobes about the mirror direction fit measured surfaces less often (Ngan et al. 2005, "Experimental analysis of BRDF
# models"), and in the plane are often the twins of lobes about the half vector: how probable beforehand
ABOUT_MIRROR = 0.1  # ours
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
    known = _Known.of(measurement, laws, there)
    if not known.channels:
        return None
    best = next(place for place, row in enumerate(laws) if row is ranking.recommended)
    said = [known.law(place, row.fit) for place, row in enumerate(laws)]
    weights = known.counted(said[best], weights)
    steep = toward_grazing(there.geom)
    if not np.any(weights[~steep]):
        return None
    probable = np.array([each.evidence + _beforehand(row) for each, row in zip(said, laws, strict=True)])
    probable = np.exp(probable - probable.max())
    probable /= probable.sum()
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
    highest = np.max([measurement.geom.theta_i_deg.max(), measurement.geom.theta_r_deg.max()])
    geom, weights = _outside(float(np.clip(highest, 45.0, 80.0)))
    return Instrument(geom.at(measurement.geom.wavelength), measurement.solid_angle), weights


@lru_cache(maxsize=4)  # the next file's too
def _outside(highest: float) -> tuple[Geometry, np.ndarray]:
    geom, weights = hemisphere(highest)
    off = geom.off_plane_deg[:, 0] >= OFF_DEG
    return geom[off], weights[off] / weights[off].sum()


def toward_grazing(geom: Geometry) -> np.ndarray:
    """(directions,): whether both angles add up to more than what is told as one."""
    return (geom.theta_i_deg + geom.theta_r_deg)[:, 0] > GRAZING_DEG


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
    """What one law says: ln f outside (directions, channels) and its derivatives, by how much a parameter may be off
    (directions, channels, parameters); what the values say of it, by channel that counts; how probable it makes
    them."""

    ln: np.ndarray
    onward: np.ndarray
    weighed: tuple[Weighed, ...]
    evidence: float


@dataclass(frozen=True, eq=False)
class _Known:
    """Few channels and directions in the plane with a value, and those outside."""

    inside: Instrument
    there: Instrument
    thinned: int  # how many channels
    channels: tuple[int, ...]  # of these, those with enough values that every law is compared with
    rows: np.ndarray  # (directions, thinned channels): where every law is
    darkest: np.ndarray  # (thinned channels,): ln of what can be read
    places: tuple[Places, ...]  # by channel that counts
    left: list[np.ndarray]  # by each law, ln(data/model) (directions, thinned channels)

    @classmethod
    def of(cls, measurement: Measurement, laws: list[Row], there: Instrument) -> "_Known":
        rows = np.flatnonzero(measurement.has_value)
        rows = rows[starting_grid.spread_rows(measurement[rows], SAMPLES)]
        part = measurement if len(rows) == len(measurement.brdf) else measurement[rows]
        thinned = few_channels(measurement.brdf.shape[1])
        left = [
            -(
                row.fit.residuals[rows]
                if len(row.fit.residuals) == len(measurement.brdf)
                else row.fit.residuals_on(part)
            )[:, thinned]
            for row in laws
        ]
        shared = np.all([np.isfinite(each) for each in left], axis=0)
        channels = tuple(int(each) for each in np.flatnonzero(shared.sum(axis=0) >= LEAST_SAMPLES))
        geom = part.of_channels(thinned).geom
        there = Instrument(there.geom.at(geom.wavelength), there.solid_angle)
        onward, which = there.geom.formed(_places_once)
        points: np.ndarray = places_of_missed(geom)
        alike: dict[bytes, Places] = {}
        for channel in channels:  # mostly all channels have the same directions
            key = shared[:, channel].tobytes()
            if key not in alike:
                alike[key] = Places.between(points[shared[:, channel]], onward, which)
        places = tuple(alike[shared[:, channel].tobytes()] for channel in channels)
        inside, darkest = Instrument(geom, part.solid_angle), _darkest(measurement.brdf[:, thinned])
        return cls(inside, there, len(thinned), channels, shared, darkest, places, left)

    def law(self, place: int, fit: Fit) -> _Said:
        """What the law at this place says, and the values of it."""
        layout, surface = layout_of(fit.model, self.thinned), thinned_surface(fit)
        ln, onward = ln_with_slopes(layout, surface, self.there)
        onward = np.where((ln < self.darkest)[:, :, None], 0.0, onward)
        moves = np.sqrt(np.mean(onward**2, axis=(0, 1)))
        off = np.minimum(1.0, MOVES / np.maximum(moves, MOVES))
        _, slopes = ln_with_slopes(layout, surface, self.inside)
        known = []
        for channel, places in zip(self.channels, self.places, strict=True):
            rows = self.rows[:, channel]
            known.append(weighed(places, self.left[place][rows, channel], slopes[rows, channel] * off, MISSED))
        # of one channel, since all tell of the same directions
        evidence = float(np.mean([each.evidence for each in known]))
        return _Said(ln, onward * off, tuple(known), evidence)

    def counted(self, best: _Said, weights: np.ndarray) -> np.ndarray:
        """Weights (directions, thinned channels) of what can be read where the recommended law is right."""
        counts = np.isin(np.arange(self.thinned), self.channels)
        return weights[:, None] * (counts & (best.ln >= self.darkest))

    def squares(self, said: _Said, best: _Said) -> np.ndarray:
        """Square of ln (directions, thinned channels) by which the recommended law is off if this one is right."""
        squares = np.zeros_like(said.ln)
        gap = np.maximum(said.ln, self.darkest) - np.maximum(best.ln, self.darkest)
        for channel, known in zip(self.channels, said.weighed, strict=True):
            missed = known.elsewhere(said.onward[:, channel])
            squares[:, channel] = (gap[:, channel] + missed.mean) ** 2 + missed.variance + missed.noise
        return squares

    def ln_of(self, fit: Fit, said: _Said, there: Instrument) -> np.ndarray:
        """ln of what the instrument reads outside, mean over all channels, (directions,)."""
        if self.thinned == len(fit.surface.channels):
            return np.mean(said.ln, axis=1)
        return np.mean(np.log(np.maximum(reading(fit.surface, there), SMALLEST)), axis=1)


def _darkest(brdf: np.ndarray) -> np.ndarray:
    """ln of the least that can be read, by channel; below every number where nothing was too dark, or all."""
    read = brdf > 0
    least = np.min(np.where(read, brdf, np.inf), axis=0)
    return np.where(read.all(axis=0) | ~read.any(axis=0), -np.inf, np.log(DARKEST * least))


def _apart(row: Row, difference: np.ndarray, then: float, weights: np.ndarray, there: Instrument) -> Apart:
    order, geom = np.argsort(-np.abs(difference) * (weights > 0), kind="stable")[:FAR], there.geom
    angles = np.concatenate([geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg], axis=1)
    places = tuple((*np.round(angles[each], 1).tolist(), float(difference[each])) for each in order)
    rms = np.sqrt(weights @ difference**2 / max(weights.sum(), SMALLEST))
    return Apart(row.fit.name, float(rms), then, places, row.tied)
