"""A surface in the plane of incidence as columns, written and read, and whether what was read is the surface's."""

import numpy as np

from brdfguide import models
from brdfguide.data import formats
from brdfguide.physics.geometry import Geometry, rows

MODEL = models.get("lambertian+ggx")
TRUTH = {"ggx.alpha": 0.3, "ggx.n": 1.5, "lambertian.albedo": 0.25}
THETA_I, THETA_R = (each.ravel() for each in np.meshgrid([10.0, 30.0, 50.0], np.r_[-75.0:76.0:5.0], indexing="ij"))


def law(theta_i, theta_r, phi) -> np.ndarray:
    """BRDF [1/sr] of the surface, (rows,)."""
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))
    return np.broadcast_to(MODEL(geom, TRUTH), (len(geom), 1))[:, 0]


PLANE = law(THETA_I, np.abs(THETA_R), np.where(THETA_R < 0, 0.0, 180.0))


def lines(*columns, sep=",") -> str:
    return "".join(sep.join(f"{cell:.9g}" for cell in row) + "\n" for row in zip(*columns, strict=True))


def read(tmp_path, text: str, **options):
    path = tmp_path / "table.csv"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return formats.read(path, **options)


def agrees(found, channel: int = 0, factor: float = 1.0) -> None:
    """Every value is the law's for the directions that were read."""
    shape = found.brdf[:, channel].shape
    angles = [np.broadcast_to(each, (len(found.geom), 1))[:, 0] for each in angles_of(found.geom)]
    assert shape == THETA_I.shape
    np.testing.assert_allclose(found.brdf[:, channel], factor * law(*angles), rtol=1e-5)


def angles_of(geom):
    return geom.theta_i_deg, geom.theta_r_deg, geom.phi_deg
