"""What laws miss of a surface, how probable each of them is with that, and what it then says elsewhere.

Any of the laws near the best may be the right one, and none is exactly:

    ln data = ln f + J b + δ + noise

J, its derivatives by ln of its parameters; δ, what it misses, smooth in the directions and known from the residuals
(`numerics.gaussian_process`). The kernel's widths are those that make what laws miss of nine measured tables
most probable (benchmarks/what_laws_miss.py); how large δ is beforehand, and how far a parameter that the data leave
loose moves the surface elsewhere, are those by which scans taken of these tables foretell their rest
(benchmarks/off_plane_tables.py).
"""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from ..data.measurement import SMALLEST, Measurement
from ..numerics.gaussian_process import Places, Weighed, weighed
from ..physics.aperture import Instrument
from ..physics.directions import Directions
from ..physics.geometry import Geometry
from ..records import dataclass
from . import starting_grid
from .fit import Fit
from .goniometer import hemisphere
from .layout import layout_of
from .ln_slopes import ln_with_slopes
from .prepared import few_channels
from .ranked import Row
from .reading import reading

LEAST_SAMPLES = 4
FEW = 100  # directions up to which the most probable law counts, beyond that with least error (ours)
FEW_IN_PLANE = 32  # the same in the plane of incidence, where scans tell more of what lies between them (ours)
SAMPLES = 300  # measured directions that count
TILT = 0.1  # tan of the half vector's tilt up to which what is missed changes with the tilt, beyond with its logarithm
# of the kernel: asinh(tan tilt/TILT), angle from light to half vector [deg], θi + θr [deg], sin θi sin θr cos φ
WIDTHS = (0.85, 25.0, 200.0, 0.5)
MISSED = 0.05  # ln, how large what a law misses usually is
MOVES = 0.1  # ln, rms over the directions elsewhere: how far a parameter usually moves the surface from the fitted one
DARKEST = 0.5  # of the least value in a channel that was too dark elsewhere: what is darker cannot be read
# Lobes about the mirror direction fit measured surfaces less often (Ngan et al. 2005, "Experimental analysis of BRDF
# models"), and in the plane are often the twins of lobes about the half vector: how probable beforehand
ABOUT_MIRROR = 0.1  # ours


def highest_deg(measurement: Measurement) -> float:
    """How far from the normal directions elsewhere are looked at: as the data go, between 45 and 80 degrees."""
    highest = np.max([measurement.geom.theta_i_deg.max(), measurement.geom.theta_r_deg.max()])
    return float(np.clip(highest, 45.0, 80.0))


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


def few_directions(measurement: Measurement) -> bool:
    """Whether directions lie too far apart for neighbours to tell of each other, enough that laws can be compared."""
    count = int(np.count_nonzero(measurement.has_value))
    return LEAST_SAMPLES <= count <= (FEW_IN_PLANE if measurement.in_plane else FEW)


def likelihoods(rows: Sequence[Row], measurement: Measurement) -> dict[int, float] | None:
    """How probable each of some laws is, by the identity of its row's fit; None for data of so many directions that
    least error and angles left out tell more, and for too few that every law is compared with."""
    if not few_directions(measurement) or len(rows) < 2:
        return None
    geom = _everywhere(highest_deg(measurement))
    there = Instrument(geom.at(measurement.geom.wavelength), measurement.solid_angle)
    known = LawsOnData.of(measurement, rows, there)
    if not known.channels:
        return None
    found = probabilities([known.law(place, row.fit) for place, row in enumerate(rows)], rows)
    return {id(row.fit): float(each) for row, each in zip(rows, found, strict=True)}


@lru_cache(maxsize=4)  # the next file's too
def _everywhere(highest: float) -> Geometry:
    return hemisphere(highest)[0]


def probabilities(said: "Sequence[OneLaw]", rows: Sequence[Row]) -> np.ndarray:
    """How probable each of the laws is, (laws,): together one of them is right."""
    ln = np.array([each.evidence + _beforehand(row) for each, row in zip(said, rows, strict=True)])
    probable = np.exp(ln - ln.max())
    return probable / probable.sum()


def _beforehand(row: Row) -> float:
    """ln of how probable a law is before the data."""
    return float(np.log(ABOUT_MIRROR)) if any(term.model.about_mirror for term in row.fit.model.terms) else 0.0


@dataclass(frozen=True, eq=False)
class OneLaw:
    """What one law says: ln f elsewhere (directions, channels) and its derivatives, by how much a parameter may be off
    (directions, channels, parameters); what the values say of it, by channel that counts; how probable it makes
    them."""

    ln: np.ndarray
    onward: np.ndarray
    weighed: tuple[Weighed, ...]
    evidence: float


@dataclass(frozen=True, eq=False)
class LawsOnData:
    """Few channels and measured directions with a value, and those elsewhere."""

    inside: Instrument
    there: Instrument
    thinned: int  # how many channels
    channels: tuple[int, ...]  # of these, those with enough values that every law is compared with
    rows: np.ndarray  # (directions, thinned channels): where every law is
    darkest: np.ndarray  # (thinned channels,): ln of what can be read
    places: tuple[Places, ...]  # by channel that counts
    left: list[np.ndarray]  # by each law, ln(data/model) (directions, thinned channels)

    @classmethod
    def of(cls, measurement: Measurement, laws: Sequence[Row], there: Instrument) -> "LawsOnData":
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

    def law(self, place: int, fit: Fit) -> OneLaw:
        """What the law at this place says, and the values of it."""
        layout, surface = layout_of(fit.model, self.thinned), fit.thinned
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
        return OneLaw(ln, onward * off, tuple(known), evidence)

    def counted(self, best: OneLaw, weights: np.ndarray) -> np.ndarray:
        """Weights (directions, thinned channels) of what can be read where the recommended law is right."""
        counts = np.isin(np.arange(self.thinned), self.channels)
        return weights[:, None] * (counts & (best.ln >= self.darkest))

    def squares(self, said: OneLaw, best: OneLaw) -> np.ndarray:
        """Square of ln (directions, thinned channels) by which the recommended law is off if this one is right."""
        squares = np.zeros_like(said.ln)
        gap = np.maximum(said.ln, self.darkest) - np.maximum(best.ln, self.darkest)
        for channel, known in zip(self.channels, said.weighed, strict=True):
            missed = known.elsewhere(said.onward[:, channel])
            squares[:, channel] = (gap[:, channel] + missed.mean) ** 2 + missed.variance + missed.noise
        return squares

    def ln_of(self, fit: Fit, said: OneLaw, there: Instrument) -> np.ndarray:
        """ln of what the instrument reads outside, mean over all channels, (directions,)."""
        if self.thinned == len(fit.surface.channels):
            return np.mean(said.ln, axis=1)
        return np.mean(np.log(np.maximum(reading(fit.surface, there), SMALLEST)), axis=1)


def _darkest(brdf: np.ndarray) -> np.ndarray:
    """ln of the least that can be read, by channel; below every number where nothing was too dark, or all."""
    read = brdf > 0
    least = np.min(np.where(read, brdf, np.inf), axis=0)
    return np.where(read.all(axis=0) | ~read.any(axis=0), -np.inf, np.log(DARKEST * least))
