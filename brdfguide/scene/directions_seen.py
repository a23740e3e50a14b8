"""Which pairs of directions a scene shows, and how much of the picture each makes."""

import numpy as np

from ..errors import InputError
from ..physics.geometry import Directions, Geometry, rows
from .radiance import sample
from .scene import Scene

PIXELS = 1200
WIDTH = 0.2  # of the lobe [rad] near whose highlight pixels are drawn more often
SEED = 26


def directions_seen(scene: Scene, theta_max_deg: float) -> tuple[Geometry, np.ndarray]:
    """Directions (pixels times lights, 1) up to an angle, and their weights, which add up to 1.

    Raises InputError for a scene that shows none: one without lamps, or with all of it beyond the angle.
    """
    picture = sample(scene, PIXELS // max(len(scene.lights), 1), SEED, WIDTH)
    found = []
    for light in range(picture.to_lights.shape[1]):
        to = picture.to_lights[:, light]
        lit = to[:, 2] > 0
        pair = Directions.from_vectors(to[lit], picture.to_camera[lit])
        shown = picture.weights[lit] * to[lit, 2]
        found.append((np.stack([_deg(pair.cos_i), _deg(pair.cos_r), pair.phi_deg], axis=1), shown))
    angles = np.concatenate([each[0] for each in found] or [np.zeros((0, 3))])
    weights = np.concatenate([each[1] for each in found] or [np.zeros(0)])
    kept = (np.max(angles[:, :2], axis=1, initial=0.0) <= theta_max_deg) & (weights > 0)
    if not kept.any():
        raise InputError(f"the scene shows no lamp's light within {theta_max_deg:g} degrees of the normal")
    whole = np.round(angles[kept])
    geom = rows(Geometry.from_degrees(whole[:, 0], 0.0, whole[:, 1], np.abs(whole[:, 2])))
    return geom, weights[kept] / weights[kept].sum()


def _deg(cosine) -> np.ndarray:
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))
