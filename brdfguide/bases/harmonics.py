"""Spherical harmonics, continued evenly below the horizon: the first general basis of BRDFs.

    Θ_l^m = √((2l + 1)/4π (l - m)!/(l + m)!) P_l^m(cos θ), without (-1)^m

Only l + m even: a function that stops at the horizon would ring there. Upward recurrence in l from the diagonal.

Source: Sillion, Arvo, Westin and Greenberg 1991; Westin, Arvo and Torrance 1992.
"""

from math import pi, sqrt

import numpy as np


def legendre(cos, sin, order: int) -> dict[tuple[int, int], np.ndarray]:
    """Θ of every l up to `order` and m up to l, by (l, m), in the shape of the cosine and sine of θ."""
    found, diagonal = {}, np.ones_like(cos) / sqrt(4 * pi)
    for m in range(order + 1):
        if m:
            diagonal = diagonal * sin * sqrt((2 * m + 1) / (2 * m))
        before, now = np.zeros_like(cos), diagonal
        found[m, m] = now
        for degree in range(m + 1, order + 1):
            less = degree - 1
            back = sqrt((less * less - m * m) / (4 * less * less - 1)) if less else 0.0
            rest = degree * degree - m * m
            before, now = now, sqrt((4 * degree * degree - 1) / rest) * (cos * now - back * before)
            found[degree, m] = now
    return found


def even(cos, sin, order: int) -> dict[tuple[int, int], np.ndarray]:
    """Those that are even about the horizon: l + m even."""
    return {key: value for key, value in legendre(cos, sin, order).items() if sum(key) % 2 == 0}
