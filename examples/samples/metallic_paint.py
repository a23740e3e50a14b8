"""Stand-in for the report's metallic paint (section 4.5): tilted flakes under a smooth clear coat, its mirror image
left out.

    f = T(i) T(r)/n² [R D(h') / (4 cos i' cos r') + 0.04/pi],   primes: inside the coat

Level L2: explicit flakes seen through refraction; no model that is fitted later has a coat. Variant a: Gaussian tilts,
variant b: tilts with an exponential tail of the same mean square.
"""

import numpy as np
from heightfield import fresnel

ABOUT = "metallic paint: flakes of tilt 0.13 and reflectance 0.75 under a coat of n 1.5, coat mirror excluded"
LEVEL = "L2"
N, R, M = 1.5, 0.75, 0.13
VARIANTS = {
    "a": lambda s: np.exp(-((s / M) ** 2)) / (np.pi * M**2),
    "b": lambda s: np.exp(-np.sqrt(6) * s / M) * 6 / (2 * np.pi * M**2),
}


def truth(thetas_i, thetas_r, variant="a"):
    """BRDF [1/sr] without noise, (theta_i, theta_r)."""
    i, r = np.radians(thetas_i)[:, None], np.radians(thetas_r)[None, :]
    inside_i, inside_r = np.arcsin(np.sin(i) / N), np.arcsin(np.sin(r) / N)
    passed = (1 - fresnel(np.cos(i), N)) * (1 - fresnel(np.cos(r), N))
    slope = np.abs(np.sin(inside_i) - np.sin(inside_r)) / (np.cos(inside_i) + np.cos(inside_r))
    flakes = R * VARIANTS[variant](slope) * (1 + slope**2) ** 2 / (4 * np.cos(inside_i) * np.cos(inside_r))
    return passed / N**2 * (flakes + 0.04 / np.pi)
