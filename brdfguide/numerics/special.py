"""Functions that NumPy lacks: the scaled complementary error function, Lambert's W, and the logarithm of Gamma and its
derivative.
"""

from math import lgamma

import numpy as np

# (1 + 2x) erfcx(x) as a polynomial in (x - 3.75)/(x + 3.75): Chebyshev series of degree 24 at 40 digits, rewritten in
# powers
ERFCX = (
    1.2375126308378275,
    -0.14024059858554697,
    0.003585415485463775,
    0.08227673849014516,
    -0.10880393014171785,
    0.09230432116037876,
    -0.058693398590212366,
    0.028362277418940665,
    -0.009746579552504244,
    0.0017556258530017268,
    0.0002937136342850092,
    -0.0002901540809795316,
    5.1649211390697915e-05,
    2.2384240314237298e-05,
    -1.1444412439157509e-05,
    -9.735619015423254e-07,
    1.7520579701397284e-06,
    -5.721597253081514e-08,
    -2.5910696874751066e-07,
    2.3261913254778616e-08,
    3.896545252476255e-08,
    -3.743568024291194e-09,
    -5.284286969305236e-09,
    3.110310702636281e-10,
    4.434959050997238e-10,
)


# Stirling's series of the digamma function: B_2k/(2k), k = 1, 2...
DIGAMMA = (1 / 12, -1 / 120, 1 / 252, -1 / 240, 1 / 132, -691 / 32760, 1 / 12)


def horner(coefficients, t):
    """The polynomial with these coefficients, lowest first, at `t`."""
    total = np.full(np.shape(t), coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        total *= t
        total += coefficient
    return total


def erfcx(x):
    """exp(x²) erfc(x) for x >= 0, to 5e-16."""
    x = np.asanyarray(x, float)
    return horner(ERFCX, (x - 3.75) / (x + 3.75)) / (1 + 2 * x)


def lambert_w(z):
    """W with W e^W = z for z >= 0, to 1e-15: Winitzki's estimate (1 %), then twice Halley."""
    p = np.log(1 + z)  # good enough to start from, and several times faster than log1p
    w = p * (1 - np.log(1 + p) / (2 + p))
    for _ in range(2):
        miss = w - z * np.exp(-w)
        w = w - miss / (1 + w - miss * (2 + w) / (2 + 2 * w))
    return w


def ln_gamma(x):
    """ln Γ(x) for x > 0; for parameters, not for directions: one call of the C library for each value."""
    x = np.asarray(x, float)
    return np.reshape([lgamma(each) for each in x.ravel().tolist()], x.shape)


def digamma(x):
    """d ln Γ/dx for x > 0, to 1e-14 of max(1, |ψ|): ψ(x) = ψ(x + 1) - 1/x up to x = 10, then Stirling's series."""
    x = np.asarray(x, float)
    steps = np.maximum(np.ceil(10 - x), 0)
    below = np.arange(10)
    down = np.where(below < steps[..., None], 1 / (x[..., None] + below), 0.0).sum(axis=-1)
    x = x + steps
    square = 1 / (x * x)
    return np.log(x) - 0.5 / x - square * horner(DIGAMMA, square) - down
