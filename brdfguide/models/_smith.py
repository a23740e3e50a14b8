"""Smith's masking of slope distributions that leave it as an integral, kept as Chebyshev series.

Smith's cos θ Λ is the mean height that facets rise over a plane seen edge-on from θ. Of slopes that look alike in every
azimuth, P(t) with t the squared slope and π ∫ P dt = 1,

    cos θ Λ = sin θ H(cot θ),   H(c) = ∫ (x - c) p(x) dx from c on = 2 ∫ (y - c atan(y/c)) y P(c² + y²) dy from 0 on

p is the density of the slope along a line. The integrand is smooth in ln y, so that the trapezoidal rule in it
converges exponentially; the integral is smooth in asinh(c/scale), scale the width of the core.
"""

import numpy as np


def rise_above_slope(y, c):
    """y - c atan(y/c): how far slopes of size √(c² + y²), in every azimuth, rise above a line of slope c, over 2."""
    return y - c * np.arctan2(y, c)
