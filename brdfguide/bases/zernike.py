"""Zernike's polynomials on the hemisphere, as Koenderink and van Doorn made bases of BRDFs of them.

    x = √2 sin(θ/2);   Z_n^m = √((n + 1)/π) R_n^m(x),   R_n^m = x^m P_j^(0,m)(2x² - 1),   j = (n - m)/2

x is the radius of an equal-area disc, 1 at the horizon; Z cos mφ and Z sin mφ have norm 1 over the hemisphere for
m > 0, √2 for m = 0. P are Jacobi's polynomials by their three-term recurrence: the sum of factorials of the papers
loses all digits by order 100.

Source: Koenderink and van Doorn 1998, "Phenomenological description of bidirectional surface reflection".
"""

from math import pi, sqrt

import numpy as np


def zernike(cos, sin, order: int) -> dict[tuple[int, int], np.ndarray]:
    """Z of every n up to `order` and m of its parity, by (n, m), in the shape of the cosine and sine of θ."""
    x2 = sin * sin / (1 + cos)
    t, found = 2 * x2 - 1, {}
    for m in range(order + 1):
        power = x2 ** (0.5 * m)
        for j, polynomial in enumerate(_jacobi(t, m, (order - m) // 2)):
            n = m + 2 * j
            found[n, m] = sqrt((n + 1) / pi) * power * polynomial
    return found


def _jacobi(t, m: int, most: int):
    """P_j^(0,m)(t) for j from 0 to `most`."""
    before, now = np.zeros_like(t), np.ones_like(t)
    yield now
    for j in range(most):
        if j == 0:
            before, now = now, 0.5 * ((m + 2) * t - m)
        else:
            a = 2 * j + m
            following = (a + 1) * (a * (a + 2) * t - m * m) * now - 2 * j * (j + m) * (a + 2) * before
            before, now = now, following / (2 * (j + 1) * (j + m + 1) * a)
        yield now
