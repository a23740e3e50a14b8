"""A dense table of ln f over three angles, and what is left of it in few numbers: wavelets, and separable sums.

Cells without a value are filled with the mean of those that vary least about them, and never counted.
"""

import numpy as np

from ..physics.geometry import Geometry
from ..records import dataclass

HALF, DIFFERENCE, AROUND = 90, 90, 180  # cells in sqrt(theta_h), theta_d and phi_d, as MERL's tables have them
CUBE = 64  # cells along each angle of the wavelets' table: a power of two
LEAST_FILLED = 0.4  # share of the cells that must have a value
TURNS = 4  # of filling gaps by the sum itself


def half_difference_cell(geom: Geometry) -> np.ndarray:
    """The cell of half and difference angles that each pair lies in, (samples,)."""
    theta_h = np.arctan(np.sqrt(np.ravel(geom.tan2_h)))
    theta_d = np.arccos(np.minimum(np.ravel(geom.cos_d), 1.0))
    size = np.sin(theta_h) * np.sin(theta_d)
    cosine = np.ravel(-0.5 * geom.cos_difference) / np.where(size > 0, size, 1.0)
    phi_d = np.arccos(np.clip(cosine, -1, 1))
    half = (np.sqrt(theta_h / (np.pi / 2)) * HALF).astype(int).clip(0, HALF - 1)
    difference = (theta_d / (np.pi / 2) * DIFFERENCE).astype(int).clip(0, DIFFERENCE - 1)
    return (half * DIFFERENCE + difference) * AROUND + (phi_d / np.pi * AROUND).astype(int).clip(0, AROUND - 1)


def binned(cells: np.ndarray, ln: np.ndarray, count: int) -> np.ndarray:
    """Mean ln f of each of `count` cells, NaN where there is none."""
    known = np.isfinite(ln)
    many = np.bincount(cells[known], minlength=count)
    total = np.bincount(cells[known], ln[known], minlength=count)
    return np.where(many > 0, total / np.maximum(many, 1), np.nan)


def half_difference_table(geom: Geometry, ln: np.ndarray) -> np.ndarray:
    """(HALF, DIFFERENCE x AROUND) of one channel."""
    return binned(half_difference_cell(geom), ln, HALF * DIFFERENCE * AROUND).reshape(HALF, -1)


def angle_cube(geom: Geometry, table: np.ndarray, highest_deg: float) -> np.ndarray:
    """ln f over theta_i, theta_r and phi at the centres of CUBE³ cells up to `highest_deg`, looked up in a table of
    half and difference angles; NaN where it has none.
    """
    theta = (np.arange(CUBE) + 0.5) / CUBE * highest_deg
    phi = (np.arange(CUBE) + 0.5) / CUBE * 180
    theta_i, theta_r, phi_r = (each.ravel() for each in np.meshgrid(theta, theta, phi, indexing="ij"))
    return table.ravel()[half_difference_cell(Geometry.from_degrees(theta_i, 0.0, theta_r, phi_r))].reshape(
        CUBE, CUBE, CUBE
    )


def haar(values: np.ndarray) -> np.ndarray:
    """Orthonormal Haar transform of a cube whose side is a power of two: all three angles halved in turn."""
    values, side = values.copy(), len(values)
    while side > 1:
        part = values[:side, :side, :side]
        for axis in range(3):
            part = np.moveaxis(part, axis, 0)
            part = np.moveaxis(np.concatenate([part[::2] + part[1::2], part[::2] - part[1::2]]) / np.sqrt(2), 0, axis)
        values[:side, :side, :side] = part
        side //= 2
    return values


def unhaar(coefficients: np.ndarray) -> np.ndarray:
    """The cube back."""
    values, side = coefficients.copy(), 2
    while side <= len(values):
        part = values[:side, :side, :side]
        for axis in (2, 1, 0):
            part = np.moveaxis(part, axis, 0)
            mean, apart = part[: side // 2], part[side // 2 :]
            joined = np.empty_like(part)
            joined[::2], joined[1::2] = (mean + apart) / np.sqrt(2), (mean - apart) / np.sqrt(2)
            part = np.moveaxis(joined, 0, axis)
        values[:side, :side, :side] = part
        side *= 2
    return values


def largest(coefficients: np.ndarray, count: int) -> np.ndarray:
    """The same with all but the `count` largest at 0."""
    size = np.abs(coefficients).ravel()
    least = np.partition(size, -count)[-count]
    return np.where(np.abs(coefficients) >= least, coefficients, 0.0)


def filled(table: np.ndarray) -> np.ndarray:
    """A table (rows, columns) whose gaps hold the mean of their row and column."""
    known = np.isfinite(table)
    of_all = float(table[known].mean())
    zero = np.where(known, table, 0.0)
    rows = zero.sum(axis=1) / np.maximum(known.sum(axis=1), 1)
    columns = zero.sum(axis=0) / np.maximum(known.sum(axis=0), 1)
    rows, columns = (np.where(known.any(axis=axis), each, of_all) for axis, each in ((1, rows), (0, columns)))
    return np.where(known, table, rows[:, None] + columns - of_all)


@dataclass(frozen=True, eq=False)
class Separable:
    """ln f as a sum of products of a function of one angle and one of the other two."""

    left: np.ndarray  # (rows, rank)
    right: np.ndarray  # (rank, columns)

    @property
    def table(self) -> np.ndarray:
        return self.left @ self.right

    @property
    def count(self) -> int:
        return self.left.size + self.right.size


def separable(table: np.ndarray, rank: int) -> Separable:
    """The closest sum of `rank` products to the cells that have a value."""
    known, whole = np.isfinite(table), filled(table)
    for _ in range(TURNS):
        values, vectors = np.linalg.eigh(whole @ whole.T)  # of few rows and very many columns
        left = vectors[:, np.argsort(values)[-rank:]]
        found = Separable(left, left.T @ whole)
        whole = np.where(known, table, found.table)
    return found
