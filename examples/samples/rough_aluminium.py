"""Stand-in for the report's rough aluminium (section 4.1): diffraction by a rough metal with a soft exponential
correlation.

Level L1: the same physics as the He-Torrance model, other statistics; a comparison of that model with the rest is
tilted its way. Variant a as specified, variant b a sharper-cornered correlation of the same slope.
"""

import numpy as np
from kirchhoff import reflected, soft_exponential

ABOUT = "rough aluminium: diffraction, sigma 0.40 um, slope sd 0.177, n 0.958+6.69i"
LEVEL = "L1"
VARIANTS = {"a": (3.94, 1.3), "b": (7.87, 0.65)}  # length, rounding [um]; both 1/(length rounding) = 0.195
SIGMA, N, K, WAVELENGTH, HALF_ANGLE_DEG = 0.40, 0.958, 6.69, 0.55, 1.5


def truth(thetas_i, thetas_r, variant="a"):
    """BRDF [1/sr] without noise, (theta_i, theta_r)."""
    length, rounding = VARIANTS[variant]
    f = reflected(
        thetas_i, thetas_r, sigma=SIGMA, correlation=soft_exponential(length, rounding), radius=14 * length,
        slope_sd=SIGMA / np.sqrt(length * rounding), n=N, k=K, wavelength=WAVELENGTH, half_angle_deg=HALF_ANGLE_DEG,
    )  # fmt: skip
    return f + 0.03 / np.pi  # light reflected more than once
