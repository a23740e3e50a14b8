"""Linear bases of BRDFs from functions of one direction: what is reciprocal, isotropic and mirror-symmetric.

    f = Σ a_nkm (Z_n^m(i) Z_k^m(r) + Z_k^m(i) Z_n^m(r)) cos m(φ_r - φ_i),   k <= n, both of m's parity

Up to an even order N there are (N/2 + 1)(N/2 + 2)(N + 3)/6 of them. The coefficients make f right in ratio, not in
height: Σ ((Σ a p - f)/f)² is least.
"""

from collections.abc import Callable

import numpy as np

from ..physics.geometry import Geometry
from ..records import dataclass
from .harmonics import even
from .zernike import zernike

Functions = Callable[..., dict[tuple[int, int], np.ndarray]]
BASES: dict[str, Functions] = {"sh": even, "zernike": zernike}
RIDGE = 1e-6


def count(order: int) -> int:
    """How many pairs there are up to an even order."""
    return (order // 2 + 1) * (order // 2 + 2) * (order + 3) // 6


def pairs(geom: Geometry, functions: Functions, order: int) -> np.ndarray:
    """Every pair at every direction, (samples, count)."""
    of_i = functions(np.ravel(geom.cos_i), np.ravel(geom.sin_i), order)
    of_r = functions(np.ravel(geom.cos_r), np.ravel(geom.sin_r), order)
    phi, columns = np.radians(np.ravel(geom.phi_deg)), []
    for m in range(order + 1):
        around = np.cos(m * phi)
        degrees = [n for n, of in of_i if of == m]
        for n in degrees:
            for k in (each for each in degrees if each <= n):
                columns.append((of_i[n, m] * of_r[k, m] + of_i[k, m] * of_r[n, m]) * around)
    return np.stack(columns, axis=1)


@dataclass(frozen=True, eq=False)
class Linear:
    """A sum of pairs with its coefficients, (count, channels)."""

    basis: str
    order: int
    coefficients: np.ndarray

    def __call__(self, geom: Geometry) -> np.ndarray:
        """BRDF [1/sr], (samples, channels); it may be negative."""
        return pairs(geom, BASES[self.basis], self.order) @ self.coefficients


def fit_pairs(basis: str, order: int, geom: Geometry, brdf: np.ndarray, weights: np.ndarray | None = None) -> Linear:
    """The sum closest in ratio to `brdf` (samples, channels), NaN where there is no value."""
    columns = pairs(geom, BASES[basis], order)
    found = np.zeros((columns.shape[1], brdf.shape[1]))
    for channel, values in enumerate(brdf.T):
        known = np.isfinite(values) & (values > 0)
        root = 1.0 if weights is None else np.sqrt(weights[known])
        scaled = columns[known] * (root / values[known])[:, None]
        size = np.maximum(np.linalg.norm(scaled, axis=0), 1e-300)
        scaled /= size
        normal = scaled.T @ scaled + RIDGE * np.eye(len(size))
        found[:, channel] = np.linalg.solve(normal, scaled.T @ (root * np.ones(len(scaled)))) / size
    return Linear(basis, order, found)
