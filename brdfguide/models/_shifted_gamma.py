"""The constant of Bagher's shifted-gamma distribution, an incomplete gamma function whose order may be negative."""

import numpy as np

NODES = 300  # even in ln x, of the trapezoidal rule: for alpha = 1e-6 e^-50 is left
LOWEST = 37.0  # ln x from ln alpha - 37: below, x adds to alpha what rounding does
HIGHEST = 3.75  # ln x to 3.75: beyond, e^-x is 3e-19


def norm(alpha, p):
    """I = ∫ e^-x (alpha + x)^-p dx from 0 on = e^alpha Γ(1 - p, alpha), and its derivatives by alpha and by p.

    Takes  alpha > 0 and p (...), which broadcast.    Gives  three arrays (...), to 1e-14.
    The K of the publication is 1/(alpha Γ(1 - p, alpha)) = e^alpha/(alpha I).
    """
    alpha, p = (np.asarray(each, float)[..., None] for each in (alpha, p))
    low = np.log(np.minimum(alpha, 1.0)) - LOWEST
    step = (HIGHEST - low) / (NODES - 1)
    x = np.exp(low + step * np.arange(NODES))
    ln_base = np.log(alpha + x)
    part = step * x * np.exp(-x - p * ln_base)
    return part.sum(axis=-1), -(p * part * np.exp(-ln_base)).sum(axis=-1), -(part * ln_base).sum(axis=-1)
