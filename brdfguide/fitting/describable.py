"""How well anything could describe a measurement: a smooth reciprocal function, and a body under free factors.

Both speak of directions between those that were measured, and predict nothing beyond.
"""

from math import pi

import numpy as np

from ..bases import factored, smooth
from ..data import subsample
from ..data.measurement import Measurement
from ..flags import Effect
from ..models.surface import Surface
from ..physics import colour
from ..physics.geometry import in_plane
from ..physics.geometry import rows as rows_of
from ..records import dataclass
from . import weights
from .floor import Floor, Unlike
from .ranked import Ranking
from .residuals import rms

MOST_DIRECTIONS = 4000
MOST_CHANNELS = 4  # with more the luminance and both ends of the spectrum stand for them
FEWEST = 2 * factored.COUNT  # values of a channel from which a floor is told
FEWEST_INCIDENCES = 2
FAINT = 0.005  # share of the luminance that a channel must have to be looked at in it
ABOVE = 1.25  # times the best model's error, up to which it is a floor itself, being smooth and reciprocal (ours)
TRADED = 3.0  # times the spread of the whole lobe's ratio, from which a factor's is made up for by others (ours)
PLACES = (0.1, 0.5, 0.9)  # quantiles of the angles at which factors are compared
LOBE_DEG = 20.0  # incidence at which the width of the model's lobe is looked at
NARROWER = 3.0  # times than alpha that the scale of the tilt is
ALPHA_PER_HALF_WIDTH = 1.55  # of GGX: 1/√(√2 - 1)


def floor_of(ranking: Ranking, measurement: Measurement) -> Floor | None:
    """The floor under the best model; None where there are too few values, one incidence only, or where no
    floor is found below it.
    """
    rows = subsample.representative_rows(measurement, MOST_DIRECTIONS, among=measurement.clear.any(axis=1))
    data = measurement[rows]
    if len(data.theta_i_groups) < FEWEST_INCIDENCES:
        return None
    counted = _weights(measurement, rows)
    best = min((row.fit for row in ranking.rows), key=lambda fit: fit.rms_ln)
    looked = _Looked.at(data, best.residuals_on(data))
    if not looked.names:
        return None
    scale, model = min(smooth.SCALE, lobe_alpha(best.surface) / NARROWER), _rms(looked.residuals, counted)
    harmonics = (0,) if data.in_plane else smooth.HARMONICS
    found = smooth.fit_smooth(smooth.design(data.geom, scale, harmonics), looked.ln, counted)
    least = looked.together(found.gcv)
    if not least <= ABOVE * model:
        return None
    form, unlike = _of_the_form(data, looked, counted, scale)
    return Floor(
        candidate=best.name,
        model=model,
        smooth=min(least, model),
        factored=min(form, model) if form <= ABOVE * model else None,
        noise=ranking.noise,
        coefficients=float(np.mean(found.edf)),
        stiffness=float(np.median(found.stiffness)),
        residual=_rms(found.fitted - looked.ln, counted),
        of=looked.names,
        directions=len(rows),
        unlike=unlike,
        one_way=_one_way(data, looked, counted, scale),
    )


@dataclass(frozen=True, eq=False)
class _Looked:
    """What stands for the channels: all of them, or the luminance and both ends."""

    names: tuple[str, ...]
    ln: np.ndarray  # of the data, (samples, channels), NaN where a value is missing
    residuals: np.ndarray  # ln(model/data)

    @classmethod
    def at(cls, data: Measurement, residuals: np.ndarray) -> "_Looked":
        ln = np.where(data.clear, data.ln, np.nan)
        residuals = np.where(data.clear, residuals, np.nan)
        if ln.shape[1] <= MOST_CHANNELS:
            return cls(data.channels, ln, residuals)._with_enough()
        share = _luminance(data)
        counted = share > FAINT
        value, model = (np.exp(each[:, counted]) @ share[counted] for each in (ln, ln + residuals))
        ends = [0, ln.shape[1] - 1]
        return cls(
            ("luminance", *(data.channels[end] for end in ends)),
            np.column_stack([np.log(value), ln[:, ends]]),
            np.column_stack([np.log(model / value), residuals[:, ends]]),
        )._with_enough()

    def _with_enough(self) -> "_Looked":
        """The channels that have values enough."""
        kept = np.flatnonzero(np.isfinite(self.ln).sum(axis=0) >= FEWEST)
        return _Looked(tuple(self.names[place] for place in kept), self.ln[:, kept], self.residuals[:, kept])

    def together(self, errors: np.ndarray) -> float:
        """One error of all channels, each counted by its values as in the model's own."""
        return float(np.sqrt(np.average(np.square(errors), weights=np.isfinite(self.ln).sum(axis=0))))


def _luminance(data: Measurement) -> np.ndarray:
    """Weights of the channels, none negative, with sum 1; all alike where they carry no colour."""
    um = np.atleast_1d(data.geom.wavelength)
    if len(um) != len(data.channels) or not colour.spans_the_visible(um):
        return np.full(len(data.channels), 1 / len(data.channels))
    share = np.maximum(colour.LUMINANCE @ colour.of_wavelengths(um, tables=False)[0], 0.0)
    return share / share.sum()


def _weights(measurement: Measurement, rows) -> np.ndarray | None:
    """How often each direction counts, (samples,) with mean 1; None where all do."""
    counted = weights.sample_weights(measurement)
    if counted is None:
        return None
    counted = counted[rows, 0]
    return counted / counted.mean()


def _rms(residuals, counted) -> float:
    return rms(residuals, None if counted is None else counted[:, None])


def lobe_alpha(surface: Surface) -> float:
    """alpha of the GGX lobe that is as wide, at half height, as a surface's own; infinite where it has none."""
    aside = np.geomspace(0.02, 60.0, 60)
    f = surface.brdf(rows_of(in_plane(LOBE_DEG, np.r_[LOBE_DEG, LOBE_DEG + aside]))).max(axis=1)
    below = np.flatnonzero(f[1:] < 0.5 * f[0])
    return float(np.tan(np.radians(aside[below[0]] / 2)) * ALPHA_PER_HALF_WIDTH) if len(below) else np.inf


def _of_the_form(data: Measurement, looked: _Looked, counted, scale: float) -> tuple[float, Unlike | None]:
    """Q, each channel by itself, and the factor in which the model differs most, in the channel where it errs most."""
    columns, squares, apart, free = factored.Columns(data.geom, scale), [], [], None
    for channel in range(looked.ln.shape[1]):
        ln, residuals = looked.ln[:, [channel]], looked.residuals[:, [channel]]
        free = factored.fit_factors(columns, ln, counted, free)
        left = _rms(np.log(free.at(columns)) - ln, counted)
        squares.append((left / (1 - factored.COUNT / np.count_nonzero(np.isfinite(ln)))) ** 2)
        apart.append((_rms(residuals, counted), channel, free))
    _, worst, free = max(apart, key=lambda each: each[0])
    of_model = factored.fit_factors(columns, looked.ln[:, [worst]] + looked.residuals[:, [worst]], counted, free)
    share = np.minimum(*(1 - each.albedo[0] / (pi * each.at(columns)[:, 0]) for each in (free, of_model)))
    return looked.together(np.sqrt(squares)), _most_unlike(columns, data, free, of_model, share**2)


def _most_unlike(
    columns: factored.Columns, data: Measurement, free: factored.Factors, of_model: factored.Factors, share
) -> Unlike | None:
    """Of lobe, Fresnel's factor and masking the one whose ratio to the model's varies most over the data; each
    direction counts by the squared share of the lobe in it. None where no direction holds a lobe, and where factors
    only stand in for each other.
    """
    if not np.sum(share) > 0:
        return None
    geom = data.geom
    tilt, difference = np.arctan(np.sqrt(np.ravel(geom.tan2_h))), np.arccos(np.minimum(np.ravel(geom.cos_d), 1.0))
    theta_i, theta_r = np.radians(np.ravel(geom.theta_i_deg)), np.radians(np.ravel(geom.theta_r_deg))
    ratios = [
        columns.tilt @ (free.tilt - of_model.tilt),
        columns.difference @ (free.difference - of_model.difference)[:, 0],
        columns.angle @ (free.angle - of_model.angle),
    ]
    # in the plane θi² + θr² = 2 (θh² + θd²), so that a square may stand in either
    squares = [2 * tilt**2, 2 * difference**2, -(theta_i**2 + theta_r**2)]
    moved = _least(ratios, squares, share) if data.in_plane else 0.0
    lobe, fresnel, masking = (ratio + moved * square for ratio, square in zip(ratios, squares, strict=True))
    of_all = lobe + fresnel + masking
    named = (
        ("lobe", "half vector", tilt, lobe),
        ("Fresnel factor", "light to half vector", difference, fresnel),
        ("masking", "light and detector", np.maximum(theta_i, theta_r), masking),
    )
    worst = max((_unlike(*each, share) for each in named), key=lambda each: each.rms_ln)
    return worst if worst.rms_ln < TRADED * _spread(of_all, share) else None


def _least(ratios, squares, share) -> float:
    """How much of the squares makes the ratios vary least."""
    along, size = 0.0, 0.0
    for ratio, square in zip(ratios, squares, strict=True):
        about = square - np.average(square, weights=share)
        along, size = along + np.sum(share * about * ratio), size + np.sum(share * about**2)
    return float(-along / size) if size > 0 else 0.0


def _unlike(factor: str, of: str, angle, ln_ratio, share) -> Unlike:
    order = np.argsort(angle)
    reached = np.cumsum(share[order])
    places = [order[min(int(np.searchsorted(reached, part * reached[-1])), len(order) - 1)] for part in PLACES]
    about = ln_ratio - np.average(ln_ratio, weights=share)
    return Unlike(
        factor,
        of,
        tuple(float(np.degrees(angle[place])) for place in places),
        tuple(float(np.exp(about[place])) for place in places),
        _spread(ln_ratio, share),
    )


def _spread(values, share) -> float:
    """Standard deviation, each counted by its share."""
    return float(np.sqrt(np.average((values - np.average(values, weights=share)) ** 2, weights=share)))


def _one_way(data: Measurement, looked: _Looked, counted, scale: float) -> float | None:
    """S where exchange may matter, for data that are not reciprocal; None for others."""
    if not any(finding.effect is Effect.OF_DIM_VALUES for finding in data.findings):
        return None
    harmonics = (0, 1) if data.in_plane else (0, 1, 2, 3, 4)
    found = smooth.fit_smooth(smooth.design(data.geom, scale, harmonics), looked.ln, counted)
    return looked.together(found.gcv)
