"""What values of a smooth unknown beside a linear model at some places say of it at others.

    r = J b + δ + noise,   b ~ N(0, 1),   δ ~ N(0, s² k),   noise ~ N(0, n²)

with k a kernel between places. n is the most probable one for every s/n; s/n is averaged over, by how probable it makes
the values (Rasmussen and Williams 2006, "Gaussian processes for machine learning", chapters 2 and 5; as what a model
lacks, Kennedy and O'Hagan 2001, "Bayesian calibration of computer models").
"""

from functools import cached_property

import numpy as np

from ..records import dataclass

RATIOS = np.geomspace(0.1, 1e4, 16)  # (s/n)²
LEAST_NOISE = 1e-8  # n²
ROUNDS = 4  # in which n² settles
COUNTS = 0.01  # probability of an s/n below which it is left out


@dataclass(frozen=True, eq=False)
class Places:
    """The kernel's eigenvalues (N,) and eigenvectors (N, N) between the places with values, and that from M others to
    them, by eigenvectors (M, N)."""

    strength: np.ndarray
    vectors: np.ndarray
    onward: np.ndarray

    @cached_property
    def onward_squares(self) -> np.ndarray:
        return self.onward**2

    @classmethod
    def between(cls, known: np.ndarray, others: np.ndarray) -> "Places":
        """Of places as points (N, d) and (M, d) of which the kernel is exp(-distance²/2)."""
        strength, vectors = np.linalg.eigh(gaussian_kernel(known, known))
        return cls(np.maximum(strength, 0.0), vectors, gaussian_kernel(others, known) @ vectors)


@dataclass(frozen=True, eq=False)
class Foretold:
    """What values say: ln of how probable they are, and of J b + δ elsewhere the mean and the variance (M,); n²."""

    evidence: float
    mean: np.ndarray
    variance: np.ndarray
    noise: float


def foretold(places: Places, values: np.ndarray, slopes: np.ndarray, onward_slopes: np.ndarray) -> Foretold:
    """Takes  values r (N,), slopes J (N, p) where they are and (M, p) elsewhere."""
    q, j = places.vectors.T @ values, places.vectors.T @ slopes
    count, unit = len(values), np.eye(j.shape[1])
    weight = 1 / (1 + RATIOS[:, None] * places.strength)
    products, pull, power = np.einsum("kn,np,nq->kpq", weight, j, j), (weight * q) @ j, weight @ q**2
    noise = np.maximum(power / count, LEAST_NOISE)
    for _ in range(ROUNDS):
        moved = _solved(products + noise[:, None, None] * unit, pull)
        noise = np.maximum((power - np.sum(pull * moved, axis=1)) / count, LEAST_NOISE)
    inside = products + noise[:, None, None] * unit
    moved = _solved(inside, pull)
    determinant = np.linalg.slogdet(inside)[1] - j.shape[1] * np.log(noise) - np.log(weight).sum(axis=1)
    left = (power - np.sum(pull * moved, axis=1)) / noise
    evidence = -0.5 * (count * np.log(noise) + determinant + left)
    probable = np.exp(evidence - evidence.max())
    total = np.log(np.mean(probable)) + evidence.max()
    probable = np.where(probable >= COUNTS * probable.max(), probable, 0.0) / probable.sum()
    kept = np.flatnonzero(probable)
    probable, ratio, weight, noise = probable[kept], RATIOS[kept], weight[kept], noise[kept]
    inside, moved = inside[kept], moved[kept]
    here = onward_slopes @ moved.T + places.onward @ (ratio[:, None] * weight * (q - moved @ j.T)).T
    loose = onward_slopes - places.onward @ ((ratio[:, None] * weight)[:, :, None] * j)
    of_unknown = ratio * (1 - ratio * (places.onward_squares @ weight.T))
    of_slopes = np.sum(loose * np.linalg.solve(inside, loose.transpose(0, 2, 1)).transpose(0, 2, 1), axis=2).T
    mean = here @ probable
    square = (here**2 + noise * np.maximum(of_unknown + of_slopes, 0.0)) @ probable
    share = probable.sum()
    mean, square = mean / share, square / share
    return Foretold(float(total), mean, np.maximum(square - mean**2, 0.0), float(probable @ noise / share))


def _solved(matrices: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """(k, p) of matrices (k, p, p) and vectors (k, p)."""
    return np.linalg.solve(matrices, vectors[:, :, None])[:, :, 0]


def gaussian_kernel(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """exp(-distance²/2) between points (N, d) and (M, d), (N, M)."""
    squares = np.sum(one**2, axis=1)[:, None] + np.sum(other**2, axis=1) - 2 * one @ other.T
    return np.exp(-0.5 * np.maximum(squares, 0.0))
