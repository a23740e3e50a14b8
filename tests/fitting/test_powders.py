"""Dark powders, whose grains scatter once: told as such, and not as a lobe as wide as the hemisphere."""

import numpy as np
import pytest

from brdfguide import fit
from brdfguide.data.measurement import Measurement
from brdfguide.physics.geometry import in_plane, rows


def soil(noise: float, w: float = 0.4) -> Measurement:
    """f = w/(4π (cos θi + cos θr)), as I/F of planetary work reads it."""
    angles = np.meshgrid([0.0, 15.0, 30.0, 45.0, 60.0, 75.0], np.arange(-75.0, 76.0, 15.0))
    theta_i, theta_r = (each.T.ravel() for each in angles)
    values = w / (4 * np.pi * (np.cos(np.radians(theta_i)) + np.cos(np.radians(theta_r))))
    values = values * np.exp(noise * np.random.default_rng(1).standard_normal(len(values)))
    return Measurement(rows(in_plane(theta_i, theta_r)), values[:, None], ("550 nm",))


@pytest.mark.parametrize("noise", [0.0, 0.03])
def test_soil_is_told_by_its_grains_seed_1(noise):
    found = fit(soil(noise)).recommended
    assert found.name == "lommel-seeliger" and not found.warnings
    assert found.values["lommel-seeliger.w"] == pytest.approx(0.4, rel=0.02)
