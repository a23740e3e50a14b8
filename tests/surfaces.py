"""Synthetic goniometer runs over made-up surfaces, with noise; and the ways in which files lie about them."""

import numpy as np

from brdfguide.physics.geometry import Geometry, rows

# name: albedo, width of the lobe, reflectance at normal incidence
SURFACES = {
    "white paint": (0.80, 0.30, 0.04),
    "rough gold": (0.0, 0.40, 0.85),
    "plaster": (0.88, 0.60, 0.03),
    "satin plastic": (0.60, 0.15, 0.04),
    "bead-blasted steel": (0.05, 0.30, 0.60),
    "egg-shell white": (0.72, 0.22, 0.04),
    "black rubber": (0.03, 0.35, 0.04),
}


def value(geom: Geometry, albedo: float, width: float, f0: float) -> np.ndarray:
    """A facet lobe with Schlick's Fresnel factor over a diffuse body [1/sr]; reciprocal."""
    fresnel = f0 + (1 - f0) * (1 - geom.cos_d) ** 5
    facets = width**2 / (np.pi * (geom.tan2_h + width**2) ** 2) * (1 + geom.tan2_h) ** 2

    def mask(cos):
        return 2 * cos / (cos + np.sqrt(width**2 + (1 - width**2) * cos**2))

    lobe = fresnel * facets * mask(geom.cos_i) * mask(geom.cos_r) / (4 * geom.cos_i * geom.cos_r)
    return albedo / np.pi * (1 - f0) ** 2 + lobe


def in_plane_run(name: str, seed: int, noise: float = 0.01):
    """theta_i, signed theta_r (positive: mirror side) [deg] and noisy values of a run in the plane of incidence."""
    theta_i, theta_r = (
        a.ravel() for a in np.meshgrid(np.arange(15.0, 76.0, 15.0), np.arange(-80.0, 81.0, 5.0), indexing="ij")
    )
    geom = Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0))
    return (
        theta_i,
        theta_r,
        value(geom, *SURFACES[name]) * np.exp(noise * np.random.default_rng(seed).standard_normal(len(theta_i))),
    )


def dome_run(name: str, seed: int, noise: float = 0.01):
    """theta_i, theta_r, phi_r (mirror at 180) [deg] and noisy values of a run over the hemisphere."""
    grid = np.meshgrid([0.0, 20.0, 40.0, 60.0, 75.0], np.r_[0.0:81.0:5.0], np.arange(0.0, 181.0, 30.0), indexing="ij")
    theta_i, theta_r, phi = (a.ravel() for a in grid)
    geom = Geometry.from_degrees(theta_i, 0.0, theta_r, phi)
    return (
        theta_i,
        theta_r,
        phi,
        value(geom, *SURFACES[name]) * np.exp(noise * np.random.default_rng(seed).standard_normal(len(theta_i))),
    )


def geometry(theta_i, theta_r, phi) -> Geometry:
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def table(header, *columns) -> str:
    """The columns as CSV."""
    lines = [",".join(f"{cell:.8g}" for cell in line) for line in zip(*columns, strict=True)]
    return "\n".join([",".join(header), *lines]) + "\n"
