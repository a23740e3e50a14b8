"""What values of a smooth unknown beside a linear model at some places say of it at others.

    r = J b + δ + noise,   b ~ N(0, 1),   δ ~ N(0, s² k),   noise ~ N(0, n²)

with k a kernel between places. n is the most probable one for every s/n; s/n is averaged over, by how probable it makes
the values, and s is beforehand, half a Gaussian (Rasmussen and Williams 2006, "Gaussian processes for machine
learning", chapters 2 and 5; as what a model lacks, Kennedy and O'Hagan 2001, "Bayesian calibration of computer
models").
"""

from functools import cached_property

import numpy as np

from ..records import dataclass

SILENT = 1e-15  # of the largest eigenvalue, up to which an eigenvector says nothing of other places
RATIOS = np.geomspace(0.1, 1e4, 16)  # (s/n)²
LEAST_NOISE = 1e-8  # n²
ROUNDS = 4  # in which n² settles
COUNTS = 0.01  # probability of an s/n below which it is left out


@dataclass(frozen=True, eq=False)
class Places:
    """The kernel's R eigenvalues (R,) and eigenvectors (N, R) between the places with values that say something,
    smallest first, and that from others to them, by these eigenvectors (M', R); and which of these rows each of M
    others has, since many may stand at one place."""

    strength: np.ndarray
    vectors: np.ndarray
    onward: np.ndarray
    which: np.ndarray  # (M,)

    @cached_property
    def onward_squares(self) -> np.ndarray:
        return self.onward**2

    @cached_property
    def ln_weights(self) -> np.ndarray:
        """Sums of ln 1/(1 + (s/n)² strength) for each of RATIOS."""
        return -np.log1p(RATIOS[:, None] * self.strength).sum(axis=1)

    @classmethod
    def between(cls, known: np.ndarray, others: np.ndarray, which: np.ndarray | None = None) -> "Places":
        """Of places as points (N, d) and (M', d) of which the kernel is exp(-distance²/2); `which` (M,) of the latter
        each other is, None: each is one."""
        which = np.arange(len(others)) if which is None else which
        strength, vectors = np.linalg.eigh(gaussian_kernel(known, known))
        first = int(np.searchsorted(strength, SILENT * strength[-1])) if len(strength) else 0
        vectors = vectors[:, first:]
        return cls(np.maximum(strength[first:], 0.0), vectors, gaussian_kernel(others, known) @ vectors, which)


@dataclass(frozen=True, eq=False)
class Foretold:
    """What values say of J b + δ elsewhere: the mean and the variance (M,); and n²."""

    mean: np.ndarray
    variance: np.ndarray
    noise: float


@dataclass(frozen=True, eq=False)
class Weighed:
    """What values say at their own places: ln of how probable they are, and of each (s/n)² that counts how probable it
    is, n², the equations of b and their solution; values and slopes by the R eigenvectors that say something."""

    places: Places
    evidence: float
    probable: np.ndarray  # (K,)
    ratio: np.ndarray  # (K,)
    weight: np.ndarray  # (K, R)
    noise: np.ndarray  # (K,)
    inside: np.ndarray  # (K, p, p)
    moved: np.ndarray  # (K, p)
    values: np.ndarray  # (R,)
    slopes: np.ndarray  # (R, p)

    def elsewhere(self, onward_slopes: np.ndarray) -> Foretold:
        """Takes  slopes J (M, p) elsewhere."""
        onward, which = self.places.onward, self.places.which
        q, j, pull = self.values, self.slopes, self.ratio[:, None] * self.weight
        here = onward_slopes @ self.moved.T + (onward @ (pull * (q - self.moved @ j.T)).T)[which]
        count, p = len(pull), j.shape[1]
        moved = (pull[:, :, None] * j).transpose(1, 0, 2).reshape(len(q), count * p)  # at once: one product of matrices
        loose = onward_slopes - (onward @ moved).reshape(len(onward), count, p)[which].transpose(1, 0, 2)
        of_unknown = self.ratio * (1 - self.places.onward_squares @ pull.T)[which]
        # lᵀ A⁻¹ l by the inverse of A's triangular factor, which has no rows of right hand sides to solve for
        of_slopes = np.square(loose @ np.linalg.inv(np.linalg.cholesky(self.inside)).transpose(0, 2, 1)).sum(axis=2).T
        mean = here @ self.probable
        square = (here**2 + self.noise * np.maximum(of_unknown + of_slopes, 0.0)) @ self.probable
        share = self.probable.sum()
        mean, square = mean / share, square / share
        return Foretold(mean, np.maximum(square - mean**2, 0.0), float(self.probable @ self.noise / share))


def weighed(places: Places, values: np.ndarray, slopes: np.ndarray, usual: float = np.inf) -> Weighed:
    """Takes  values r (N,), and slopes J (N, p) where they are; the s that is usual, of which most are smaller: the
    width of the half Gaussian."""
    q, j = places.vectors.T @ values, places.vectors.T @ slopes
    count, unit = len(values), np.eye(j.shape[1])
    # by the other eigenvectors values are noise alone, and count once: of them the sums are enough
    silent = slopes.T @ slopes - j.T @ j, slopes.T @ values - j.T @ q, values @ values - q @ q
    weight = 1 / (1 + RATIOS[:, None] * places.strength)
    pairs = (j[:, :, None] * j[:, None, :]).reshape(len(q), j.shape[1] ** 2)
    products = (weight @ pairs).reshape(len(weight), *silent[0].shape) + silent[0]
    pull, power = (weight * q) @ j + silent[1], np.maximum(weight @ q**2 + silent[2], 0.0)
    noise = np.maximum(power / count, LEAST_NOISE)
    for _ in range(ROUNDS):
        moved = _solved(products + noise[:, None, None] * unit, pull)
        noise = np.maximum((power - np.sum(pull * moved, axis=1)) / count, LEAST_NOISE)
    inside = products + noise[:, None, None] * unit
    moved = _solved(inside, pull)
    determinant = np.linalg.slogdet(inside)[1] - j.shape[1] * np.log(noise) - places.ln_weights
    left = (power - np.sum(pull * moved, axis=1)) / noise
    evidence = -0.5 * (count * np.log(noise) + determinant + left + RATIOS * noise / usual**2)
    probable = np.exp(evidence - evidence.max())
    total = float(np.log(np.mean(probable)) + evidence.max())
    probable = np.where(probable >= COUNTS * probable.max(), probable, 0.0) / probable.sum()
    kept = np.flatnonzero(probable)
    probable, ratio, weight, noise = probable[kept], RATIOS[kept], weight[kept], noise[kept]
    return Weighed(places, total, probable, ratio, weight, noise, inside[kept], moved[kept], q, j)


def _solved(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """(k, p) of matrices (k, p, p) and vectors (k, p)."""
    return np.linalg.solve(matrices, vectors[:, :, None])[:, :, 0]


def gaussian_kernel(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """exp(-distance²/2) between points (N, d) and (M, d), (N, M)."""
    squares = np.sum(one**2, axis=1)[:, None] + np.sum(other**2, axis=1) - 2 * one @ other.T
    return np.exp(-0.5 * np.maximum(squares, 0.0))
