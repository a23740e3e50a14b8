"""He and Torrance's sum over orders of scattering, term by term: the reference that everything faster is built from.

    S(g, y) = sum over m >= 1 of  g^m e^-g / (m! m) · e^(-y/m),     y = (2π tau/λ)² |v_xy|² / 4

The logarithms of the terms are concave in m, so the summand has one peak. With u = W(2y/g²)/2 its top is m* = g e^u
and its width w = √(m*/(1 + 2u)). A narrow peak is summed over its whole numbers. A wide one is as good as its
integral, to exp(-2π²w²), which needs few nodes in t, m = m* (1 + wt/(p m*))^p, p = 3/2 + 3u, where the peak has no
skew.
"""

from math import factorial, log, pi

import numpy as np

from ..numerics.special import horner, lambert_w

WIDE = 7.0  # width of the peak from which the integral stands for the sum
NODES = np.arange(-8.4, 8.41, 0.6)
PSI = tuple((j - 1) / factorial(j) for j in range(2, 16))
STIRLING = (1 / 12, -1 / 360, 1 / 1260, -1 / 1680)
LONGEST = 4096
STEP = 8  # orders by which a cell's window grows
LN_FACTORIAL_M = np.concatenate([[0.0], np.cumsum(np.log(np.arange(1.0, LONGEST)))]) + np.log(
    np.maximum(np.arange(LONGEST), 1)
)


def by_terms(g, y, derivatives: bool = True):
    """ln S to 3e-13, with its derivatives by ln g and by y: three rows, or one. Takes flat g > 0 and y >= 0."""
    u, top, width = peak_of_summand(g, y)
    result = np.empty((3 if derivatives else 1, g.size))
    order = np.argsort(width, kind="stable")
    first_wide = np.searchsorted(width[order], WIDE)
    for start in range(0, first_wide, 512):  # neighbours in width need windows of one length
        part = order[start : min(start + 512, first_wide)]
        result[:, part] = _over_orders(g[part], y[part], top[part], width[part], derivatives)
    for start in range(first_wide, g.size, 512):
        part = order[start : start + 512]
        result[:, part] = _integral(g[part], y[part], u[part], top[part], width[part], derivatives)
    return result


def by_products(g, y):
    """ln S of every g (cells, n) with every y (cells, k) of its cell, (cells, n, k), to 3e-13 or 2e-15 of it.

    For monotone g <= 4 and y < 4 · 2^16 within a cell of `_series_cells`, where the peak is narrow and does not move
    far: its terms are products of g^m and e^(-y/m), the sums a product of matrices, with a seventh of the exponentials.
    What a cell is does not depend on the others.
    """
    corner_g, corner_y = np.broadcast_arrays(g[:, (0, -1), None], y[:, None, (0, -1)])
    _, top, width = peak_of_summand(corner_g, corner_y)
    first, last = _window(top, width)
    first, steps = first.min(axis=(1, 2)), -(-(last.max(axis=(1, 2)) - first.min(axis=(1, 2))) // STEP)
    out = np.empty((*g.shape, y.shape[1]))
    for each in sorted({*steps.ravel().tolist()}):  # NumPy's own `unique` loads its masked arrays
        part = np.flatnonzero(steps == each)
        m = first[part, None] + np.arange(STEP * each)
        middle_g, middle_y = np.sqrt(g[part, :1] * g[part, -1:]), 0.5 * (y[part, :1] + y[part, -1:])
        exponent = m * np.log(middle_g) - _ln_factorial_m(m) - middle_y / m
        highest, peak = exponent.max(axis=1), np.take_along_axis(m, exponent.argmax(axis=1)[:, None], axis=1)
        ln_g = np.log(g[part] / middle_g)
        rising = np.exp(ln_g[:, :, None] * (m - peak)[:, None] + (exponent - highest[:, None])[:, None])
        fading = np.exp((middle_y - y[part])[:, None] / m[:, :, None])
        out[part] = np.log(rising @ fading)
        out[part] += (highest[:, None] + peak * ln_g - g[part])[:, :, None]
    return out


def peak_of_summand(g, y):
    """Where the peak of the summand is: u, its top m* and its width."""
    scale = np.maximum(g, 1e-120)  # squared without underflow; this only places windows and nodes
    u = 0.5 * lambert_w(2 * (y / scale) / scale)
    top = scale * np.exp(u)
    return u, top, np.sqrt(top / (1 + 2 * u))


def _over_orders(g, y, top, width, derivatives):
    """The sum over the whole numbers around a narrow peak; to the last digit the same whatever else is summed."""
    first, last = _window(top, width)
    orders = np.arange(-(-int(np.max(last - first)) // STEP) * STEP)
    whole = first[:, None] + orders
    m = whole.astype(float)
    exponent = m * np.log(g)[:, None]
    exponent -= _ln_factorial_m(whole)
    exponent -= y[:, None] / m
    exponent = np.where(orders < (last - first)[:, None], exponent, -np.inf)
    highest, term, _ = _scaled(exponent)
    total = _sum_in_steps(term)
    value = highest - g + np.log(total)
    return (value, _sum_in_steps(term * m) / total - g, -_sum_in_steps(term / m) / total) if derivatives else (value,)


def _sum_in_steps(terms):
    """The sum of each row, whose last digit zeros behind it do not move."""
    return terms.reshape(len(terms), -1, STEP).sum(axis=1).sum(axis=1)


def _window(top, width):
    """The first order that counts, and the one behind the last: what lies outside adds less than 1e-16 of the sum."""
    first = np.maximum(np.floor(top - 8.5 * width - 2), 1).astype(int)
    return first, np.ceil(top + 9 * width + 10).astype(int)


def _ln_factorial_m(m):
    """ln(m! m), beyond the table by Stirling's series."""
    if m.max(initial=0) < LONGEST:
        return LN_FACTORIAL_M.take(m)
    known = LN_FACTORIAL_M[np.minimum(m, LONGEST - 1)]
    return np.where(m < LONGEST, known, (m + 1.5) * np.log(m) - m + 0.5 * log(2 * pi) + 1 / (12 * m))


def _integral(g, y, u, top, width, derivatives):
    """The trapezoidal rule over a wide peak; the exponent by differences that lose no digits at g = 1e8."""
    p = (1.5 + 3 * u)[:, None]
    ln_stretch = np.log1p(width[:, None] / (p * top[:, None]) * NODES)
    l = u[:, None] + p * ln_stretch  # noqa: E741  ln(m/g)
    r = np.exp(l)
    g = g[:, None]
    one_over_m = 1 / (g * r)
    exponent = _psi(l, r)
    exponent *= -g
    exponent -= y[:, None] * one_over_m
    exponent -= 1.5 * l
    exponent -= one_over_m * horner(STIRLING, one_over_m**2)
    exponent += (p - 1) * ln_stretch
    highest, term, total = _scaled(exponent)
    value = highest + np.log(total * (NODES[1] - NODES[0])) + np.log(width) - 1.5 * np.log(g[:, 0]) - 0.5 * log(2 * pi)
    return (
        (value, (term * (g * np.expm1(l))).sum(axis=1) / total, -(term * one_over_m).sum(axis=1) / total)
        if derivatives
        else (value,)
    )


def _psi(l, r):  # noqa: E741
    """l e^l - (e^l - 1) of l and r = e^l."""
    near = np.abs(l) < 0.35
    if near.all():
        return l * l * horner(PSI, l)
    psi = l * r
    psi -= np.expm1(l)
    small = l[near]
    psi[near] = small * small * horner(PSI, small)
    return psi


def _scaled(exponent):
    """The largest exponent of each row, the terms relative to it, which take the exponents' place, and their sum."""
    highest = exponent.max(axis=1)
    exponent -= highest[:, None]
    np.maximum(exponent, -60.0, out=exponent)
    term = np.exp(exponent, out=exponent)
    return highest, term, term.sum(axis=1)
