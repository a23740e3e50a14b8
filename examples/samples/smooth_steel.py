"""Stand-in for the report's nearly smooth steel (section 4.4): sigma 0.08 um at 633 nm, soft exponential correlations.

Level L1: the same physics as the He-Torrance model, other statistics. Variants: correlation length and rounding.
"""

import numpy as np
from kirchhoff import reflected, soft_exponential

ABOUT = "nearly smooth steel: diffraction, sigma 0.08 um, n 2.9+3.1i, receiver half angle 0.4 deg"
LEVEL = "L1"
VARIANTS = {"a": (1.52, 0.3), "b": (1.0, 0.5)}
WAVELENGTH_NM = 633
THETAS_I = np.array([4.0, 15, 30, 45, 54])
THETAS_R = np.arange(-85.0, 85.1, 0.5)


def truth(thetas_i, thetas_r, variant="a"):
    """BRDF [1/sr] without noise, (theta_i, theta_r)."""
    length, rounding = VARIANTS[variant]
    return reflected(
        thetas_i, thetas_r, sigma=0.08, correlation=soft_exponential(length, rounding), radius=14 * length,
        slope_sd=0.08 / np.sqrt(length * rounding), n=2.9, k=3.1, wavelength=0.633, half_angle_deg=0.4,
    )  # fmt: skip
