"""A body and free factors of half angle, difference angle and of both directions: the form of every microfacet law.

    f = ρ/π + exp(d(u) + e(θd) + g(θi) + g(θr))

d, e and g are cubic splines, 24 in u, 10 in θd and 10 in θ; several channels have ρ and e of their own, d and g in
common. A constant may move between d, e and g, and in the plane of incidence a square of the angle: what bends and what
is large costs a little, so that factors of two surfaces at the same directions may be compared.

Source: Bagher, Snyder and Nowrouzezahrai 2016, "A non-parametric factor microfacet model for isotropic BRDFs".
"""

from math import pi

import numpy as np

from ..numerics import bsplines, least_squares
from ..physics.geometry import Geometry
from ..records import dataclass
from . import smooth

TILTS, DIFFERENCES, ANGLES = 24, 10, 10  # splines of d, e and g
SHARED, PER_CHANNEL = TILTS + ANGLES, DIFFERENCES + 1
COUNT = SHARED + PER_CHANNEL
BENT, LARGE = 1e-2, 1e-3  # roots of the penalties on second differences and on size
DARK = 3.0  # percentile of pi f with which rho begins
LOWEST, HIGHEST = -60.0, 60.0  # of a coefficient
TOLERANCE, MOST = 1e-4, 40


@dataclass(frozen=True, eq=False)
class Factors:
    """The factors with their coefficients."""

    tilt: np.ndarray  # (TILTS,)
    angle: np.ndarray  # (ANGLES,)
    difference: np.ndarray  # (DIFFERENCES, channels)
    ln_albedo: np.ndarray  # (channels,)
    scale: float

    @property
    def albedo(self) -> np.ndarray:
        """rho, (channels,)."""
        return np.exp(self.ln_albedo)

    def ln_of_tilt(self, tan_h) -> np.ndarray:
        """d at tangents of the half vector's tilt."""
        steepest = np.tan(smooth.STEEPEST)
        u = np.arcsinh(np.minimum(tan_h, steepest) / self.scale) / np.arcsinh(steepest / self.scale)
        return bsplines.cubic(u, TILTS) @ self.tilt

    def ln_of_difference(self, theta_d) -> np.ndarray:
        """e at difference angles [rad], (N, channels)."""
        return bsplines.cubic(np.asarray(theta_d) / (pi / 2), DIFFERENCES) @ self.difference

    def ln_of_angle(self, theta) -> np.ndarray:
        """g at angles from the normal [rad]."""
        return bsplines.cubic(np.asarray(theta) / (pi / 2), ANGLES) @ self.angle

    def __call__(self, geom: Geometry) -> np.ndarray:
        """BRDF [1/sr], (samples, channels)."""
        return self.at(Columns(geom, self.scale))

    def at(self, columns: "Columns") -> np.ndarray:
        """The same, of splines that were formed."""
        lobe = np.exp((columns.shared @ np.r_[self.tilt, self.angle])[:, None] + columns.difference @ self.difference)
        return self.albedo / pi + lobe


class Columns:
    """The splines at some directions."""

    def __init__(self, geom: Geometry, scale: float = smooth.SCALE):
        self.scale = scale
        self.tilt = bsplines.cubic(smooth.tilt_coordinate(geom, scale), TILTS)
        self.difference = bsplines.cubic(smooth.difference_coordinate(geom), DIFFERENCES)
        angles = (np.arctan2(np.ravel(sin), np.ravel(cos)) / (pi / 2) for sin, cos in _cosines(geom))
        self.angle = sum(bsplines.cubic(angle, ANGLES) for angle in angles)
        self.shared = np.concatenate([self.tilt, self.angle], axis=1)


def _cosines(geom: Geometry):
    return (geom.sin_i, geom.cos_i), (geom.sin_r, geom.cos_r)


def fit_factors(
    columns: Columns, ln: np.ndarray, weights: np.ndarray | None = None, start: Factors | None = None
) -> Factors:
    """The factors closest to ln f.

    Takes  ln (samples, channels), NaN where there is no value, weights (samples,) with mean 1, and factors to begin
    with.
    """
    problem = _Problem(columns, ln, weights)
    begin = problem.begin() if start is None else problem.coordinates(start)
    low, high = np.full(SHARED, LOWEST), np.full(SHARED, HIGHEST)
    own = np.full((ln.shape[1], PER_CHANNEL), HIGHEST)
    found = least_squares.minimise(
        problem,
        *begin,
        low=low,
        high=high,
        per_channel_low=-own,
        per_channel_high=own,
        tolerance=TOLERANCE,
        most=MOST,
    )
    return problem.factors(found.shared, found.per_channel)


class _Problem:
    """Residuals in ln f, then what bends, then what is large, as `least_squares` wants them. Slopes stand in arrays
    that the next call fills anew."""

    def __init__(self, columns: Columns, ln: np.ndarray, weights: np.ndarray | None):
        self.columns, self.known = columns, np.isfinite(ln)
        self.ln = np.where(self.known, ln, 0.0)
        root = np.ones(len(ln)) if weights is None else np.sqrt(weights)
        self.root = np.where(self.known, root[:, None], 0.0)
        share = 1 / np.sqrt(ln.shape[1])  # what all channels have costs once
        shared = [bsplines.bends(TILTS), bsplines.bends(ANGLES)]
        bent = np.zeros((sum(map(len, shared)), SHARED))
        bent[: TILTS - 2, :TILTS], bent[TILTS - 2 :, TILTS:] = shared
        self.shared_cost = share * np.concatenate([BENT * bent, LARGE * np.eye(SHARED)])
        own = np.concatenate([BENT * bsplines.bends(DIFFERENCES), LARGE * np.eye(DIFFERENCES)])
        self.own_cost = np.concatenate([own, np.zeros((len(own), 1))], axis=1)
        values, costs = len(ln), len(self.shared_cost)
        tall = ln.shape[1], values + costs + len(self.own_cost)
        self.by_shared, self.by_own = np.zeros((*tall, SHARED)), np.zeros((*tall, PER_CHANNEL))
        self.by_shared[:, values : values + costs], self.by_own[:, values + costs :] = self.shared_cost, self.own_cost

    def begin(self):
        """The logarithms alone, without a body."""
        channels = self.ln.shape[1]
        shared, own = np.zeros(SHARED), np.zeros((channels, PER_CHANNEL))
        mean = self.ln.sum(axis=1) / np.maximum(self.known.sum(axis=1), 1)
        both = np.concatenate([self.columns.shared, self.columns.difference], axis=1)
        cost = np.zeros((len(self.shared_cost) + len(self.own_cost), COUNT - 1))
        cost[: len(self.shared_cost), :SHARED] = self.shared_cost
        cost[len(self.shared_cost) :, SHARED:] = self.own_cost[:, :-1]
        weight = self.root.max(axis=1)[:, None]
        tall = np.concatenate([both * weight, cost])
        target = np.concatenate([mean * weight[:, 0], np.zeros(len(cost))])
        found = np.linalg.solve(tall.T @ tall + 1e-9 * np.eye(COUNT - 1), tall.T @ target)
        shared[:], own[:, :-1] = found[:SHARED], found[SHARED:]
        for channel in range(channels):
            own[channel, -1] = np.percentile(self.ln[self.known[:, channel], channel], DARK) + np.log(0.5 * pi)
        return shared, own

    def coordinates(self, factors: Factors):
        own = np.concatenate([factors.difference.T, factors.ln_albedo[:, None]], axis=1)
        return np.r_[factors.tilt, factors.angle], own

    def factors(self, shared, own) -> Factors:
        return Factors(shared[:TILTS], shared[TILTS:], own[:, :-1].T, own[:, -1], self.columns.scale)

    def __call__(self, shared, own, want_jacobian: bool):
        channels = len(own)
        exponent = (self.columns.shared @ shared)[:, None] + self.columns.difference @ own[:, :-1].T
        lobe, body = np.exp(np.minimum(exponent, 200.0)), np.exp(own[:, -1]) / pi
        f = lobe + body
        costs = (self.shared_cost @ shared)[:, None] * np.ones(channels), self.own_cost @ own.T
        residual = np.concatenate([self.root * (np.log(f) - self.ln), *costs])
        if not want_jacobian:
            return residual
        share = (self.root * lobe / f).T[:, :, None]
        of_body = (self.root * body / f).T[:, :, None]
        values = slice(len(self.ln))
        np.multiply(share, self.columns.shared, out=self.by_shared[:, values])
        np.multiply(share, self.columns.difference, out=self.by_own[:, values, :-1])
        self.by_own[:, values, -1:] = of_body
        return residual, self.by_shared, self.by_own
