"""Stand-in for the report's rough plastic (section 4.2): a rough dielectric interface over a scattering body.

Level L2: an explicit random height field, exact Fresnel, shadowing and up to four reflections; no reflectance model
that is fitted later. Body: light that enters, 0.55 of it back, evenly inside, leaving through the same interface.
Variant a has more fine detail than a Gaussian surface, variant b is Gaussian.
"""

import numpy as np
from heightfield import Map, first_reflection, gaussian, later_reflections, soft_tailed

ABOUT = "rough plastic: height field, slope sd 0.228 per axis, n 1.5, body 0.55"
LEVEL = "L2"
VARIANTS = {"a": soft_tailed, "b": gaussian}
N, SLOPE_SD, BODY = 1.5, 0.228, 0.55


def truth(thetas_i, thetas_r, variant="a", seed=20041, maps=24):
    """BRDF [1/sr] without noise, (theta_i, theta_r)."""
    interface, passed = rough_interface(thetas_i, thetas_r, VARIANTS[variant], SLOPE_SD, seed, maps)
    leaving = passed(np.abs(thetas_r))
    mean = np.trapezoid(
        passed(np.arange(0, 90)) * np.sin(np.radians(2 * np.arange(0, 90))), np.radians(np.arange(0, 90))
    )
    return interface + BODY / np.pi * passed(thetas_i)[:, None] * leaving[None, :] / mean


def rough_interface(thetas_i, thetas_r, spectrum, slope_sd, seed, maps, n=N, k=0.0):
    """BRDF of the interface alone, and a function theta_deg -> share of the light that enters."""
    rng = np.random.default_rng(seed)
    surfaces = [Map(spectrum, slope_sd, rng) for _ in range(maps)]
    once = first_reflection(surfaces, thetas_i, thetas_r, n, k)
    more, _ = later_reflections(surfaces[:2], thetas_i, thetas_r, n, k, rng=rng)
    grid = np.array([0.0, 15, 30, 45, 60, 70, 80, 85])
    share = [np.mean([_entering(each, theta, n, k, rng) for each in surfaces[:2]]) for theta in grid]
    return once + more, lambda theta_deg: np.interp(theta_deg, grid, share)


def _entering(surface, theta, n, k, rng, rays=20_000):
    from heightfield import trace

    return trace(surface, theta, n, k, rays, rng)[1]
