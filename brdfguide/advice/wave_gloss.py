"""Gloss units of He and Torrance's surface: what a glossmeter reads of a lobe out of which a mirror image grows.

    G = 100 F(θ)/F_standard (L + M) + albedo D,   L the lobe's share of a smooth surface's light in the receptor,
    M = e^-g S² cos²θ the mirror's (He et al. 1991),   D what a Lambertian body adds (`gloss.DIFFUSE`)

L is read from a table over sigma and slope that benchmarks/wave_gloss.py integrates (n = 1.5, 550 nm, which the
instrument's eye-like filter means); between its entries ln L by cubics, right to 0.1 units.
"""

from functools import lru_cache
from math import cos, log, radians
from pathlib import Path

import numpy as np

from ..models import get
from ..physics import gloss
from ..physics.fresnel import fresnel
from ..physics.geometry import in_plane

SIGMA_UM = (0.003, 30.0)  # rms heights that the table spans
SLOPE = (1e-3, 1.0)  # sigma/tau
STEPS = (48, 36)  # between
WAVELENGTH_UM = 0.55
N = 1.5


def wave_share(angle: int, sigma, slope):
    """L + M, dimensionless, at sigma [µm] and sigma/tau, which broadcast: 1 for a smooth surface.

    Both are taken at the table's ends where they lie beyond.
    """
    return np.exp(_ln_lobe(angle, sigma, slope)) + mirror_share(angle, sigma, slope)


def mirror_share(angle_deg: float, sigma, slope, wavelength: float = WAVELENGTH_UM):
    """M = e^-g S² cos²θ: what the roughness leaves of a smooth surface's mirror image at this angle [deg]."""
    sigma, slope = np.broadcast_arrays(sigma, slope)
    law, geom, smooth = _at_mirror(angle_deg, wavelength)
    return np.reshape(law(geom, sigma=sigma, slope=slope, n=N, k=0.0, scale=1.0), sigma.shape) / smooth


@lru_cache(maxsize=64)
def _at_mirror(angle_deg: float, wavelength: float):
    """The law of the mirror part, its directions, and what a smooth surface reflects there."""
    geom = in_plane(angle_deg, angle_deg, wavelength)
    return get("he-torrance").terms[0].model.mirror, geom, float(fresnel(cos(radians(angle_deg)), N))


def integrated_lobe(angle: int, sigma, slope: float, nodes: int = 11):
    """L by integration over the receptor, for heights (S,) [µm] at one slope: what the table was made by."""
    geom, weight = gloss.receptor_directions(angle, 2, nodes)
    model = get("he-torrance").terms[0].model
    lobe = model.brdf(geom.at(WAVELENGTH_UM), sigma=np.asarray(sigma), slope=slope, n=N, k=0.0, scale=1.0)
    return np.sum(weight * lobe, axis=0) / float(fresnel(cos(radians(angle)), N))


def axes() -> tuple[np.ndarray, np.ndarray]:
    """The table's heights [µm] and slopes."""
    return np.geomspace(*SIGMA_UM, STEPS[0] + 1), np.geomspace(*SLOPE, STEPS[1] + 1)


@lru_cache(maxsize=1)
def _table() -> np.ndarray:
    """ln L (angles, heights, slopes)."""
    return np.load(Path(__file__).with_suffix(".npy")).astype(float)


def _ln_lobe(angle: int, sigma, slope):
    table = _table()[gloss.ANGLES.index(angle)]
    rows, by_row = _cubic(sigma, SIGMA_UM, STEPS[0])
    columns, by_column = _cubic(slope, SLOPE, STEPS[1])
    total = 0.0
    for row in range(4):
        for column in range(4):
            total = total + by_row[row] * by_column[column] * table[rows + row, columns + column]
    return total


def _cubic(value, ends: tuple[float, float], steps: int):
    """(place of the first of four entries, their weights) of values on an axis that is even in the logarithm."""
    x = np.clip(np.log(np.asarray(value, float) / ends[0]) / log(ends[1] / ends[0]), 0.0, 1.0) * steps
    first = np.clip(x.astype(int) - 1, 0, steps - 3)
    t = x - first
    return first, (
        -(t - 1) * (t - 2) * (t - 3) / 6,
        t * (t - 2) * (t - 3) / 2,
        -t * (t - 1) * (t - 3) / 2,
        t * (t - 1) * (t - 2) / 6,
    )
