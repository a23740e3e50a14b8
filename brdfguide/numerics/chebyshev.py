"""Chebyshev series of functions that are dear to compute, kept for each value of a law's parameters."""

from collections.abc import Callable
from functools import cache

import numpy as np

from ..records import dataclass

TOGETHER = 16_384  # values that are summed in one call, which fit the processor's cache
CHOP = 1e-15  # of the greatest coefficient: smaller ones at the end of a series are dropped


@dataclass(frozen=True, eq=False)
class Series:
    """Functions of one variable in -1..1, each as coefficients of Chebyshev's polynomials, (functions, degree + 1)."""

    coefficients: np.ndarray

    def __call__(self, x, count: int) -> list[np.ndarray]:
        """The first `count` functions."""
        columns = self.coefficients[:count].T.reshape(-1, count, *(1,) * np.ndim(x))
        if count * np.size(x) <= TOGETHER:
            return list(_clenshaw(columns, x))
        return [_clenshaw(columns[:, place], x) for place in range(count)]


@dataclass(frozen=True, eq=False)
class Stretched:
    """A Series in a variable of its own, which is -1..1 where x is what it is kept for."""

    series: Series
    variable: Callable[[np.ndarray], np.ndarray]

    def __call__(self, x, count: int) -> list[np.ndarray]:
        """The first `count` functions."""
        return self.series(self.variable(x), count)


def _clenshaw(columns, x) -> np.ndarray:
    """Σ c_k T_k(x) by Clenshaw's recurrence, b_k = 2x b_(k+1) - b_(k+2) + c_k; c_k (...) broadcasts to x (...)."""
    twice = x + x
    above = beyond = np.zeros(np.broadcast_shapes(columns.shape[1:], np.shape(x)))
    for column in columns[:0:-1]:
        following = twice * above
        following -= beyond
        following += column
        above, beyond = following, above
    return x * above - beyond + columns[0]


def _side_by_side(tables: list[Stretched], x, count: int) -> list[np.ndarray]:
    """The first `count` functions of each table at its own x, (tables, ...)."""
    longest = max(each.series.coefficients.shape[1] for each in tables)
    columns = np.zeros((longest, count, len(tables), *(1,) * (x.ndim - 1)))  # a zero more at the end changes nothing
    for place, each in enumerate(tables):
        known = each.series.coefficients[:count]
        columns[: known.shape[1], :, place] = known.T.reshape(*known.T.shape, *(1,) * (x.ndim - 1))
    return list(_clenshaw(columns, np.stack([each.variable(part) for each, part in zip(tables, x, strict=True)])))


def series(functions: Callable[[np.ndarray], np.ndarray], count: int) -> Series:
    """The Series through `count` Chebyshev nodes. Takes functions(x (nodes,)) -> (functions, nodes)."""
    return chopped(functions(nodes(count)) @ transform(count).T)


def chopped(coefficients: np.ndarray) -> Series:
    """The Series of these coefficients (functions, degree + 1) without what is rounding at its end."""
    size = np.abs(coefficients)
    kept = np.flatnonzero((size > CHOP * size.max(axis=1, keepdims=True)).any(axis=0)).max()
    return Series(coefficients[:, : kept + 1])


def powers(functions: Callable[[np.ndarray], np.ndarray], degree: int) -> np.ndarray:
    """The polynomial through `degree` + 1 Chebyshev nodes as coefficients of 1, x, x²...: what a shader holds.

    Takes functions(x (nodes,)) -> (nodes,).    Of a degree of 20 it keeps nine digits fewer than the series.
    """
    return np.polynomial.chebyshev.cheb2poly(functions(nodes(degree + 1)) @ transform(degree + 1).T)


@cache
def nodes(count: int) -> np.ndarray:
    """Zeros of Chebyshev's polynomial of this degree, descending, (count,)."""
    return np.cos(np.pi * (np.arange(count) + 0.5) / count)


@cache
def transform(count: int) -> np.ndarray:
    """What makes coefficients (count,) of values at the `nodes`, (count, count)."""
    matrix = np.cos(np.pi * np.arange(count)[:, None] * (np.arange(count) + 0.5) / count) * 2 / count
    matrix[0] /= 2
    return matrix


def by_value(table: Callable[..., Callable], x, count: int, *parameters) -> list[np.ndarray]:
    """The first `count` functions of `table(*values)` at x, for parameters that are numbers or one for each channel.

    x and the parameters broadcast; a table is asked for once for each combination of values that occurs.
    """
    if not any(map(np.ndim, parameters)):
        return table(*map(float, parameters))(x, count)
    together = np.stack(np.broadcast_arrays(*parameters), axis=-1)
    shape = np.broadcast_shapes(np.shape(x), together.shape[:-1])
    x, found = np.broadcast_to(x, shape), [np.empty(shape) for _ in range(count)]
    if len(shape) == together.ndim - 1 and together.size == len(together) * len(parameters):  # one for each first place
        tables = [table(*values) for values in together.reshape(-1, len(parameters)).tolist()]
        stretched = [each for each in tables if isinstance(each, Stretched)]
        if len(stretched) == len(tables) and count * x.size <= TOGETHER:
            return _side_by_side(stretched, x, count)
        for place, each in enumerate(tables):
            for whole, part in zip(found, each(x[place], count), strict=True):
                whole[place] = part
        return found
    for values in np.unique(together.reshape(-1, len(parameters)), axis=0):
        here = np.broadcast_to(np.all(together == values, axis=-1), shape)
        for whole, part in zip(found, table(*values.tolist())(x[here], count), strict=True):
            whole[here] = part
    return found


def over_logarithms(functions: Callable, scale: float, end: float) -> Stretched:
    """Functions of x in 0..end as Series in asinh(x/scale), for those whose nearest singularity is at ±i scale.

    Takes functions(x (nodes,)) -> (functions, nodes).    Gives table(x, count), the first `count` of them.
    """
    half = 0.5 * np.arcsinh(end / scale)
    ratio = 0.5 * np.pi / half
    count = int(30 / np.log(ratio + np.hypot(ratio, 1.0))) + 4  # e^-30 is left of the ellipse of that strip
    found = series(lambda x: functions(scale * np.sinh(half * (x + 1))), count)
    return Stretched(found, lambda x: np.arcsinh(x / scale) / half - 1)
