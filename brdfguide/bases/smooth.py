"""A smooth reciprocal function of half and difference angles: what any law that varies slowly could be.

    ln f = Σ c_abk B_a(u) B_b(θd/90°) w_k cos(2k φd),   w_0 = 1, w_k = (sin θh sin θd)²
    u = asinh(tan θh/s)/asinh(tan 1.5/s)

B are cubic B-splines, 14 in u, 8 in θd; k = 0, 1, 2, in the plane of incidence 0 alone. Exchange of light and detector
is φd + 180°, so that it is reciprocal; cosines alone make it isotropic and mirror-symmetric. Odd multiples of φd beside
them are what a surface cannot have. The coefficients bend as little as generalised cross-validation allows.

Source: ours; Rusinkiewicz 1998 for the angles, Craven and Wahba 1979 for the cross-validation.
"""

from functools import lru_cache

import numpy as np

from ..numerics import bsplines
from ..physics.geometry import Geometry
from ..records import dataclass

TILTS, DIFFERENCES = 14, 8  # splines in u and in theta_d
HARMONICS = (0, 2, 4)  # multiples of phi_d
ODD = (1, 3)  # those that exchange of light and detector turns into their opposite
SCALE = 0.02  # s: lobes with alpha from here on are resolved
STEEPEST = 1.5  # rad: half vectors beyond count as there
RIDGE = 1e-6
STIFFNESSES = np.logspace(-6, 2, 33)  # lambda


def tilt_coordinate(geom: Geometry, scale: float = SCALE) -> np.ndarray:
    """u, 0 for a half vector along the normal, 1 at 1.5 rad; in the shape of `geom`."""
    steepest = np.tan(STEEPEST)
    return np.arcsinh(np.minimum(np.sqrt(geom.tan2_h), steepest) / scale) / np.arcsinh(steepest / scale)


def difference_coordinate(geom: Geometry) -> np.ndarray:
    """theta_d over 90°, in the shape of `geom`."""
    return np.arccos(np.minimum(geom.cos_d, 1.0)) / (np.pi / 2)


def design(geom: Geometry, scale: float = SCALE, harmonics=HARMONICS) -> np.ndarray:
    """Every product at every pair of directions, (samples, harmonics x TILTS x DIFFERENCES)."""
    in_u = bsplines.cubic(tilt_coordinate(geom, scale), TILTS)
    in_d = bsplines.cubic(difference_coordinate(geom), DIFFERENCES)
    out = np.empty((len(in_u), len(harmonics), TILTS, DIFFERENCES))
    for place, multiple in enumerate(harmonics):
        np.multiply((in_u * around(geom, multiple)[:, None])[:, :, None], in_d[:, None, :], out=out[:, place])
    return out.reshape(len(in_u), -1)


def around(geom: Geometry, multiple: int) -> np.ndarray:
    """w cos(m φd), (samples,): from -½ (cos θi - cos θr) = sin θh sin θd cos φd."""
    if multiple == 0:
        return np.ones(geom.cos_i.size)
    sin2_h, sin2_d = np.ravel(geom.tan2_h / (1 + geom.tan2_h)), np.ravel(np.maximum(1 - geom.cos_d**2, 0.0))
    size = np.sqrt(sin2_h * sin2_d)
    cosine = np.ravel(-0.5 * geom.cos_difference) / np.where(size > 0, size, 1.0)
    return size ** min(multiple, 2) * np.cos(multiple * np.arccos(np.clip(cosine, -1.0, 1.0)))


@lru_cache(maxsize=8)
def _penalty(harmonics: int) -> np.ndarray:
    """Squared second differences along u and along θd."""
    along_u, along_d = (bsplines.bends(count) for count in (TILTS, DIFFERENCES))
    one = np.kron(along_u.T @ along_u, np.eye(DIFFERENCES)) + np.kron(np.eye(TILTS), along_d.T @ along_d)
    return np.kron(np.eye(harmonics), one)


@dataclass(frozen=True, eq=False)
class Smooth:
    """Fitted to some channels."""

    fitted: np.ndarray  # ln f, (samples, channels), NaN where there was no value
    coefficients: np.ndarray  # (p, channels), about the mean
    mean: np.ndarray  # of ln f, (channels,)
    edf: np.ndarray  # effective coefficients, (channels,)
    stiffness: np.ndarray  # lambda, (channels,)
    gcv: np.ndarray  # rms ln that is expected of further values, (channels,)


def fit_smooth(columns: np.ndarray, ln: np.ndarray, weights: np.ndarray | None = None) -> Smooth:
    """Least squares in ln f, with the stiffness of least generalised cross-validation: rms/(1 - edf/N).

    Takes  columns (samples, p) of `design`, ln (samples, channels), NaN where there is no value, and weights (samples,)
    with mean 1.    Gives  a Smooth.
    """
    known, parts = np.isfinite(ln), {}
    fitted, coefficients = np.full(ln.shape, np.nan), np.zeros((columns.shape[1], ln.shape[1]))
    mean, edf, stiffness, gcv = (np.zeros(ln.shape[1]) for _ in range(4))
    for channel in range(ln.shape[1]):
        rows = known[:, channel]
        key = rows.tobytes()
        if key not in parts:
            there = slice(None) if rows.all() else rows  # of what is whole no copy
            parts[key] = _Spectrum(columns[there], None if weights is None else weights[there])
        found = parts[key]
        coefficients[:, channel], mean[channel], edf[channel], stiffness[channel], gcv[channel] = found.fit(
            ln[rows, channel]
        )
        fitted[rows, channel] = found.columns @ coefficients[:, channel] + mean[channel]
    return Smooth(fitted, coefficients, mean, edf, stiffness, gcv)


class _Spectrum:
    """The normal equations of some rows, in the basis in which every stiffness is diagonal."""

    def __init__(self, columns, weights):
        self.columns, self.weights = columns, np.ones(len(columns)) if weights is None else weights
        self.weighed = columns if weights is None else columns * weights[:, None]
        normal = self.weighed.T @ columns
        lower = np.linalg.cholesky(normal + RIDGE * np.eye(len(normal)))
        penalty = _penalty(columns.shape[1] // (TILTS * DIFFERENCES))
        inverse = np.linalg.inv(lower)
        self.bent, vectors = np.linalg.eigh(inverse @ penalty @ inverse.T)
        self.back = inverse.T @ vectors

    def fit(self, ln):
        """Coefficients, the mean that they are about, how many they are in effect, stiffness and cross-validation."""
        mean, count = np.average(ln, weights=self.weights), len(ln)
        about = ln - mean
        along = self.back.T @ (self.weighed.T @ about)
        total = float(np.sum(self.weights * about**2))
        kept = 1 / (1 + STIFFNESSES[:, None] * np.maximum(self.bent, 0.0))
        left = np.maximum(total - (along**2 * kept * (2 - kept)).sum(axis=1), 0.0)
        edf = kept.sum(axis=1)
        gcv = np.sqrt(left / count) / np.maximum(1 - edf / count, 1e-3)
        best = int(np.argmin(gcv))
        found = self.back @ (along * kept[best])
        rms = np.sqrt(np.mean(self.weights * (about - self.columns @ found) ** 2))
        return found, mean, edf[best], STIFFNESSES[best], rms / max(1 - edf[best] / count, 1e-3)
